//! Whether the address of a read can be beyond the last word of its memory, as far as the circuit says.
//!
//! For each node an interval that holds all values that it ever has. Registers begin with what they start from, and grow with what they take
//! until no interval changes; a choice is looked at with what its condition says, so that a counter that begins anew at a limit stays below it.

use crate::verilog::order::operands_first;
use crate::verilog::reads::can_exceed;
use std::collections::{BTreeMap, BTreeSet};
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Binary, Init, Memory, Module, NodeId, Op, Relation, Shift, Unary};

/// A choice in a choice is looked at so deep.
const DEEPEST: u32 = 8;
/// For one node no more nodes than this are looked at.
const MOST_WORK: u32 = 1024;
/// After so many rounds a register that still grows may have any value.
const PATIENT_ROUNDS: usize = 12;
/// After so many rounds nothing is known.
const MOST_ROUNDS: usize = 40;
/// The range of a node that has wider values is not looked for.
const WIDEST: u32 = 63;

/// For each memory and read port, whether the address can be beyond the last word.
pub fn beyond(module: &Module) -> Vec<Vec<bool>> {
    let by_width = |memory: &Memory| {
        memory.reads.iter().map(|read| can_exceed(module, memory, read.address)).collect::<Vec<bool>>()
    };
    let mut beyond: Vec<Vec<bool>> = module.memories.iter().map(by_width).collect();
    if beyond.iter().flatten().any(|&can| can)
        && let Some(ranges) = Ranges::of(module, &cone(module, &beyond))
    {
        for (memory, ports) in module.memories.iter().zip(&mut beyond) {
            for (read, can) in memory.reads.iter().zip(ports) {
                *can &= ranges.all[read.address.0 as usize].high >= u64::from(memory.depth);
            }
        }
    }
    beyond
}

/// What those addresses follow from, operands first.
fn cone(module: &Module, beyond: &[Vec<bool>]) -> Vec<NodeId> {
    let reads = module.memories.iter().zip(beyond).flat_map(|(memory, beyond)| memory.reads.iter().zip(beyond));
    let mut stack: Vec<NodeId> = reads.filter(|(_, can)| **can).map(|(read, _)| read.address).collect();
    let mut is_in = vec![false; module.nodes.len()];
    while let Some(id) = stack.pop() {
        if std::mem::replace(&mut is_in[id.0 as usize], true) {
            continue;
        }
        match &module.node(id).op {
            Op::Register(register) => {
                let register = &module.registers[register.0 as usize];
                stack.extend(register.enable.into_iter().chain([register.next]));
            }
            op => op.for_each_operand(|operand| stack.push(operand)),
        }
    }
    operands_first(module).into_iter().filter(|id| is_in[id.0 as usize]).collect()
}

/// The values from `low` to `high`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Range {
    low: u64,
    high: u64,
}

impl Range {
    fn one(value: u64) -> Range {
        Range { low: value, high: value }
    }

    fn of_width(width: u32) -> Range {
        Range { low: 0, high: highest(width) }
    }

    fn of_constant(value: &Bits) -> Range {
        value.to_u64().map_or(Range::of_width(64), Range::one)
    }

    fn with(self, other: Range) -> Range {
        Range { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// What is in both, if there is anything.
    fn within(self, other: Range) -> Option<Range> {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        (low <= high).then_some(Range { low, high })
    }

    /// Without a value, which has to be at an end.
    fn without(self, value: u64) -> Option<Range> {
        match self {
            Range { low, high } if low == high && low == value => None,
            Range { low, high } if low == value => Some(Range { low: low + 1, high }),
            Range { low, high } if high == value => Some(Range { low, high: high - 1 }),
            range => Some(range),
        }
    }
}

fn highest(width: u32) -> u64 {
    if width >= 64 { u64::MAX } else { (1 << width) - 1 }
}

/// All bits up to the highest one of a value.
fn mask(value: u64) -> u64 {
    highest(64 - value.leading_zeros())
}

struct Ranges<'a> {
    module: &'a Module,
    /// By node, whatever holds.
    all: Vec<Range>,
    /// By node, where the conditions hold that are taken for granted, and what to go back to.
    known: BTreeMap<NodeId, Range>,
    before: Vec<(NodeId, Option<Range>)>,
    /// How many more nodes are looked at for the one at hand.
    work: u32,
}

impl<'a> Ranges<'a> {
    /// The ranges of all nodes, if they are found soon.
    fn of(module: &'a Module, order: &[NodeId]) -> Option<Ranges<'a>> {
        let is_wanted: BTreeSet<NodeId> = order.iter().copied().collect();
        let limits = limits(module);
        let all = module.nodes.iter().map(|node| Range::of_width(node.width)).collect();
        let mut ranges = Ranges { module, all, known: BTreeMap::new(), before: Vec::new(), work: 0 };
        for register in module.registers.iter().filter(|register| is_wanted.contains(&register.node)) {
            let width = module.width(register.node);
            let reset = register.reset.iter().flat_map(|reset| match reset {
                Init::Each(values) => values.clone(),
                reset => vec![reset.lane(0).clone()],
            });
            let start = reset.chain(register.initial.clone()).map(|value| Range::of_constant(&value));
            // What has neither starts from anything.
            let start = start.reduce(Range::with).filter(|_| width <= WIDEST);
            ranges.all[register.node.0 as usize] = start.unwrap_or(Range::of_width(width));
        }
        for round in 0..MOST_ROUNDS {
            // Where lanes chain, a node comes before what it is computed from, of which nothing is known then.
            for &id in order {
                if !matches!(module.node(id).op, Op::Register(_)) {
                    ranges.all[id.0 as usize] = Range::of_width(module.width(id));
                }
            }
            for &id in order {
                if !matches!(module.node(id).op, Op::Register(_)) {
                    ranges.work = MOST_WORK;
                    // What is below is known; but not what a choice's condition says of it.
                    let is_choice = matches!(module.node(id).op, Op::Mux { .. } | Op::Select { .. } | Op::Case { .. });
                    let range = ranges.range(id, if is_choice { DEEPEST } else { 1 });
                    ranges.all[id.0 as usize] = range.unwrap_or(Range::of_width(module.width(id)));
                }
            }
            if !ranges.grow(&is_wanted, round, &limits) {
                return Some(ranges);
            }
        }
        None
    }

    /// Lets registers have what they take, too; whether that is more than before.
    fn grow(&mut self, is_wanted: &BTreeSet<NodeId>, round: usize, limits: &BTreeSet<u64>) -> bool {
        let module = self.module;
        let mut grown = false;
        for register in module.registers.iter().filter(|register| is_wanted.contains(&register.node)) {
            self.work = MOST_WORK;
            let taken = match register.enable {
                Some(enable) => self.where_it_is(enable, true, register.next, DEEPEST),
                None => self.range(register.next, DEEPEST),
            };
            let Some(taken) = taken else { continue };
            let own = &mut self.all[register.node.0 as usize];
            let all = own.with(taken);
            if all == *own {
                continue;
            }
            grown = true;
            let width = Range::of_width(module.width(register.node));
            let next = limits.range(all.high..).next().copied().unwrap_or(width.high).min(width.high);
            let high = if all.high == own.high { own.high } else { next };
            let low = if all.low == own.low { own.low } else { 0 };
            *own = if round < PATIENT_ROUNDS { Range { low, high } } else { width };
        }
        grown
    }

    /// The range of a node where a condition is so; none if it never is.
    fn where_it_is(&mut self, condition: NodeId, so: bool, id: NodeId, depth: u32) -> Option<Range> {
        let mark = self.before.len();
        let range = if self.assume(condition, so, depth) { self.range(id, depth) } else { None };
        self.forget(mark);
        range
    }

    fn forget(&mut self, mark: usize) {
        for (id, range) in self.before.drain(mark..).rev() {
            match range {
                Some(range) => _ = self.known.insert(id, range),
                None => _ = self.known.remove(&id),
            }
        }
    }

    /// Takes for granted that a condition is so; whether it can be.
    fn assume(&mut self, condition: NodeId, so: bool, depth: u32) -> bool {
        if !self.narrow(condition, Some(Range::one(so.into()))) {
            return false;
        }
        if depth == 0 {
            return true;
        }
        match self.module.node(condition).op {
            Op::Wire(of) | Op::QuasiStatic(of, _) => self.assume(of, so, depth - 1),
            Op::Unary(Unary::Not, of) => self.assume(of, !so, depth - 1),
            Op::Binary(Binary::And, a, b) if so => self.assume(a, so, depth - 1) && self.assume(b, so, depth - 1),
            Op::Binary(Binary::Or, a, b) if !so => self.assume(a, so, depth - 1) && self.assume(b, so, depth - 1),
            Op::Compare { relation, signed, operands } => {
                self.assume_relation(relation, signed, operands, so, depth - 1)
            }
            _ => true,
        }
    }

    fn assume_relation(&mut self, relation: Relation, signed: bool, [a, b]: [NodeId; 2], so: bool, depth: u32) -> bool {
        let (Some(left), Some(right)) = (self.range(a, depth), self.range(b, depth)) else { return false };
        let is_wide = self.module.width(a) > WIDEST;
        if is_wide || signed && !matches!(relation, Relation::Eq | Relation::Ne) {
            return true;
        }
        // `a < b`, and `a <= b`.
        let less = |this: &mut Self, (a, left): (NodeId, Range), (b, right): (NodeId, Range), apart: u64| {
            let below = right.high.checked_sub(apart).map(|high| Range { low: 0, high });
            let above = left.low.checked_add(apart).map(|low| Range { low, high: u64::MAX });
            this.narrow(a, below) && this.narrow(b, above)
        };
        let (a, b) = ((a, left), (b, right));
        match (relation, so) {
            (Relation::Eq, true) | (Relation::Ne, false) => {
                self.narrow(a.0, Some(right)) && self.narrow(b.0, Some(left))
            }
            (Relation::Ne, true) | (Relation::Eq, false) => {
                let other = |one: Range, of: Range| if of.low == of.high { one.without(of.low) } else { Some(one) };
                self.narrow(a.0, other(left, right)) && self.narrow(b.0, other(right, left))
            }
            (Relation::Lt, true) | (Relation::Ge, false) => less(self, a, b, 1),
            (Relation::Le, true) | (Relation::Gt, false) => less(self, a, b, 0),
            (Relation::Gt, true) | (Relation::Le, false) => less(self, b, a, 1),
            (Relation::Ge, true) | (Relation::Lt, false) => less(self, b, a, 0),
        }
    }

    /// Takes for granted that a node's value is in a range; whether it can be.
    fn narrow(&mut self, mut id: NodeId, range: Option<Range>) -> bool {
        let Some(range) = range else { return false };
        loop {
            let now = self.known.get(&id).copied();
            let Some(both) = now.unwrap_or(self.all[id.0 as usize]).within(range) else { return false };
            self.before.push((id, now));
            self.known.insert(id, both);
            match self.module.node(id).op {
                Op::Wire(of) | Op::QuasiStatic(of, _) | Op::Extend { of, signed: false } => id = of,
                _ => return true,
            }
        }
    }

    /// The range of a node under what is taken for granted; none if that contradicts itself.
    fn range(&mut self, id: NodeId, depth: u32) -> Option<Range> {
        let all = self.all[id.0 as usize];
        self.work = self.work.saturating_sub(1);
        let range = match depth {
            0 => all,
            _ if self.work == 0 => all,
            _ if self.module.width(id) > WIDEST => all,
            depth => self.of_operator(id, depth - 1)?.within(all)?,
        };
        match self.known.get(&id) {
            Some(known) => range.within(*known),
            None => Some(range),
        }
    }

    fn of_operator(&mut self, id: NodeId, depth: u32) -> Option<Range> {
        let module = self.module;
        let node = module.node(id);
        let width = Range::of_width(node.width);
        let lanes = |this: &Self, parts: &[NodeId]| {
            parts.iter().map(|part| this.all[part.0 as usize]).reduce(Range::with).unwrap_or(width)
        };
        Some(match &node.op {
            Op::Const(value) => Range::of_constant(value),
            Op::Register(_) => self.all[id.0 as usize],
            Op::Wire(of) | Op::QuasiStatic(of, _) => self.range(*of, depth)?,
            Op::Unary(Unary::Not, of) => {
                let of = self.range(*of, depth)?;
                Range { low: width.high - of.high, high: width.high - of.low }
            }
            Op::Binary(operator, a, b) => {
                let (a, b) = (self.range(*a, depth)?, self.range(*b, depth)?);
                of_binary(*operator, a, b, width)
            }
            Op::Shift(Shift::Right, a, amount) => {
                let (a, amount) = (self.range(*a, depth)?, self.range(*amount, depth)?);
                let by = |value: u64, amount: u64| if amount > 63 { 0 } else { value >> amount };
                Range { low: by(a.low, amount.high), high: by(a.high, amount.low) }
            }
            Op::Mux { select, on_true, on_false } => {
                let on_true = self.where_it_is(*select, true, *on_true, depth);
                let on_false = self.where_it_is(*select, false, *on_false, depth);
                [on_true, on_false].into_iter().flatten().reduce(Range::with)?
            }
            Op::Select { arms, default } => self.of_choice(arms, *default, depth)?,
            Op::Case { subject, arms, default } => {
                let mut taken = self.range(*default, depth);
                for (key, arm) in arms {
                    let mark = self.before.len();
                    let arm = if self.narrow(*subject, Some(Range::of_constant(key))) {
                        self.range(*arm, depth)
                    } else {
                        None
                    };
                    self.forget(mark);
                    taken = [taken, arm].into_iter().flatten().reduce(Range::with);
                }
                taken?
            }
            Op::Slice { of, low } if module.width(*of) <= WIDEST => {
                let of = self.range(*of, depth)?;
                let (from, to) = (of.low >> low, of.high >> low);
                if to <= width.high { Range { low: from, high: to } } else { width }
            }
            Op::Concat(parts) => {
                let mut all = Range::one(0);
                for &part in parts {
                    let (part, width) = (self.range(part, depth)?, module.width(part));
                    all = Range { low: all.low << width | part.low, high: all.high << width | part.high };
                }
                all
            }
            Op::Extend { of, signed } => {
                let inner = self.range(*of, depth)?;
                if *signed && inner.high > highest(module.width(*of) - 1) { width } else { inner }
            }
            // Of another lane, nothing is known that is so in this one.
            Op::Broadcast { of, .. } | Op::Lane { of, .. } | Op::Map { of, edge: None, .. } => lanes(self, &[*of]),
            Op::Map { of, edge: Some(edge), .. } => lanes(self, &[*of, *edge]),
            Op::Stack { parts, .. } | Op::Interleave { parts, .. } => lanes(self, parts),
            Op::Pick { of, .. } => lanes(self, &[*of]).with(Range::one(0)),
            _ => width,
        })
    }

    fn of_choice(&mut self, arms: &[(NodeId, NodeId)], default: NodeId, depth: u32) -> Option<Range> {
        let (mark, mut taken, mut is_reached) = (self.before.len(), None::<Range>, true);
        for &(condition, value) in arms {
            let arm = self.where_it_is(condition, true, value, depth);
            taken = [taken, arm].into_iter().flatten().reduce(Range::with);
            is_reached = self.assume(condition, false, depth);
            if !is_reached {
                break;
            }
        }
        let last = if is_reached { self.range(default, depth) } else { None };
        self.forget(mark);
        [taken, last].into_iter().flatten().reduce(Range::with)
    }
}

fn of_binary(operator: Binary, a: Range, b: Range, width: Range) -> Range {
    match operator {
        Binary::And => Range { low: 0, high: a.high.min(b.high) },
        Binary::Or => Range { low: a.low.max(b.low), high: mask(a.high | b.high) },
        Binary::Xor => Range { low: 0, high: mask(a.high | b.high) },
        Binary::Add if a.high + b.high <= width.high => Range { low: a.low + b.low, high: a.high + b.high },
        Binary::Sub if a.low >= b.high => Range { low: a.low - b.high, high: a.high - b.low },
        // As wide as both together, so that it fits.
        Binary::Mul => Range { low: a.low * b.low, high: a.high * b.high },
        _ => width,
    }
}

/// The numbers that a growing register is looked at: what is compared with, and its neighbours.
fn limits(module: &Module) -> BTreeSet<u64> {
    let mut limits: BTreeSet<u64> = module.memories.iter().map(|memory| u64::from(memory.depth) - 1).collect();
    for node in &module.nodes {
        let Op::Compare { operands, .. } = &node.op else { continue };
        for &operand in operands {
            if let Op::Const(value) = &module.node(operand).op
                && let Some(value) = value.to_u64()
            {
                limits.extend([value.saturating_sub(1), value, value.saturating_add(1)]);
            }
        }
    }
    limits
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verilog::fold::fold;
    use tilewright_hdl::*;

    bundle! {
        struct In<T> { a: T, b: T }
        struct Out<T> { y: T, z: T }
    }

    /// Two registers of 4 bits and what a random walk makes of them.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Walk {
        seed: u64,
    }

    impl Block for Walk {
        type In = In;
        type Out = Out;

        fn inputs(&self) -> In<Width> {
            In { a: bits(1), b: bits(4) }
        }

        fn build(&self, m: tilewright_hdl::Module, i: In) -> Out {
            let mut state = self.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
            let mut below = |count: u64| {
                state ^= state << 13;
                state ^= state >> 7;
                state ^= state << 17;
                (state >> 20) % count
            };
            let (p, q) = (m.reg("p", 4).reset(below(8)), m.reg("q", 4).reset(below(8)));
            let (mut flags, mut values) = (vec![i.a], vec![*p, *q, i.b & 3]);
            for _ in 0..14 {
                let (v, w, f, g) = (
                    values[below(values.len() as u64) as usize],
                    values[below(values.len() as u64) as usize],
                    flags[below(flags.len() as u64) as usize],
                    flags[below(flags.len() as u64) as usize],
                );
                let number = below(16);
                match below(16) {
                    0 => flags.push(v.lt(number)),
                    1 => flags.push(v.ge(w)),
                    2 | 3 => flags.push(v.eq(number)),
                    4 => flags.push(v.ne(w)),
                    5 => flags.push(f & !g),
                    6 => flags.push(f | g),
                    7 => values.push(v + 1),
                    8 => values.push(v - 1),
                    9 => values.push(v + w),
                    10 => values.push(mux(f, v, w)),
                    11 => values.push(mux(v.eq(number), w, v + 1)),
                    12 => values.push(select([(f, v), (g, w)], number)),
                    13 => values.push(case(v, [(number, w), (number ^ 3, v)], lit(4, below(16)))),
                    14 => values.push(cat![v.slice(1..4), f]),
                    _ => values.push((v ^ w) & number),
                }
            }
            let mut pick = || values[values.len() - 1 - below(values.len() as u64 / 2 + 1) as usize];
            p.when(flags[flags.len() - 1], pick()).when(flags[0], pick());
            q.next(pick());
            let y = values.iter().copied().reduce(|a, b| a ^ b).unwrap();
            Out { y: y ^ *p ^ *q ^ i.b, z: flags.into_iter().reduce(|a, b| a ^ b).unwrap() }
        }
    }

    /// The values of all nodes.
    fn values(module: &ir::Module, order: &[NodeId], registers: &[u64], inputs: [u64; 2]) -> Vec<u64> {
        let mut all = vec![0u64; module.nodes.len()];
        for &id in order {
            let node = module.node(id);
            let of = |id: NodeId| all[id.0 as usize];
            let value = match &node.op {
                Op::Const(value) => value.to_u64().unwrap(),
                Op::Input(input) => inputs[*input as usize],
                Op::Register(register) => registers[register.0 as usize],
                Op::Wire(a) | Op::Extend { of: a, signed: false } => of(*a),
                Op::Unary(Unary::Not, a) => !of(*a),
                Op::Binary(Binary::And, a, b) => of(*a) & of(*b),
                Op::Binary(Binary::Or, a, b) => of(*a) | of(*b),
                Op::Binary(Binary::Xor, a, b) => of(*a) ^ of(*b),
                Op::Binary(Binary::Add, a, b) => of(*a).wrapping_add(of(*b)),
                Op::Binary(Binary::Sub, a, b) => of(*a).wrapping_sub(of(*b)),
                Op::Compare { relation, operands: [a, b], .. } => {
                    let (a, b) = (of(*a), of(*b));
                    u64::from(match relation {
                        Relation::Eq => a == b,
                        Relation::Ne => a != b,
                        Relation::Lt => a < b,
                        Relation::Le => a <= b,
                        Relation::Gt => a > b,
                        Relation::Ge => a >= b,
                    })
                }
                Op::Mux { select, on_true, on_false } => of(if of(*select) == 1 { *on_true } else { *on_false }),
                Op::Select { arms, default } => {
                    of(arms.iter().find(|(condition, _)| of(*condition) == 1).map_or(*default, |arm| arm.1))
                }
                Op::Case { subject, arms, default } => {
                    let is_subject = |key: &Bits| key.to_u64() == Some(of(*subject));
                    of(arms.iter().find(|(key, _)| is_subject(key)).map_or(*default, |arm| arm.1))
                }
                Op::Slice { of: a, low } => of(*a) >> low,
                Op::Concat(parts) => parts.iter().fold(0, |all, part| all << module.width(*part) | of(*part)),
                Op::Repeat(a, times) => {
                    if of(*a) == 0 {
                        0
                    } else {
                        highest(*times * module.width(*a))
                    }
                }
                op => unreachable!("no walk makes {op:?}"),
            };
            all[id.0 as usize] = value & highest(node.width);
        }
        all
    }

    /// Every value of every node in every state that a run of any inputs comes to is in the node's range; and ranges say something.
    #[test]
    fn no_value_is_out_of_its_range() {
        let (mut tight, mut nodes) = (0, 0);
        for seed in 1..150 {
            let Ok(design) = elaborate(&Walk { seed }) else { continue };
            let folded = fold(&design, design.top());
            let module = &folded.module;
            let order = operands_first(module);
            let Some(ranges) = Ranges::of(module, &order) else { continue };
            let start = |register: &ir::Register| register.reset.as_ref().unwrap().lane(0).to_u64().unwrap();
            let mut states = vec![module.registers.iter().map(start).collect::<Vec<u64>>()];
            let mut seen: BTreeSet<Vec<u64>> = states.iter().cloned().collect();
            while let Some(state) = states.pop() {
                for inputs in (0..32).map(|input| [input & 1, input >> 1]) {
                    let all = values(module, &order, &state, inputs);
                    for (index, (value, range)) in all.iter().zip(&ranges.all).enumerate() {
                        let holds = (range.low..=range.high).contains(value);
                        assert!(
                            holds,
                            "seed {seed}: node {index}, {:?}, is {value}, not in {range:?}",
                            module.nodes[index].op
                        );
                    }
                    let next = |(index, register): (usize, &ir::Register)| match register.enable {
                        Some(enable) if all[enable.0 as usize] == 0 => state[index],
                        _ => all[register.next.0 as usize],
                    };
                    let next: Vec<u64> = module.registers.iter().enumerate().map(next).collect();
                    if seen.insert(next.clone()) {
                        states.push(next);
                    }
                }
            }
            let is_tight = |(id, range): (usize, &Range)| range.high < highest(module.nodes[id].width);
            tight += ranges.all.iter().enumerate().filter(|it| is_tight(*it)).count();
            nodes += ranges.all.len();
        }
        assert!(nodes > 1000 && tight > nodes / 10, "{tight} of {nodes}");
    }
}

//! Ranges of random circuits compared with every value in a run of them.

use super::interval::highest;
use super::*;
use crate::verilog::fold::fold;
use tilewright_circuit::ir::{Binary, Relation, Shift, Unary};
use tilewright_hdl::*;

block! {
    /// Two registers of 4 bits with random logic.
    struct Walk { seed: u64 }
    in In { a: bits(1), b: bits(4) }
    out Out { y: _, z: _ }
}

impl Walk {
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
            match below(19) {
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
                15 => values.push(v.slice(0..3).sext(4)),
                16 => values.push(v >> w),
                17 => values.push(v.slice(0..2) * w.slice(2..4)),
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
            Op::Extend { of: a, signed: true } => {
                let sign = 1 << (module.width(*a) - 1);
                (of(*a) ^ sign).wrapping_sub(sign)
            }
            Op::Unary(Unary::Not, a) => !of(*a),
            Op::Binary(Binary::And, a, b) => of(*a) & of(*b),
            Op::Binary(Binary::Or, a, b) => of(*a) | of(*b),
            Op::Binary(Binary::Xor, a, b) => of(*a) ^ of(*b),
            Op::Binary(Binary::Add, a, b) => of(*a).wrapping_add(of(*b)),
            Op::Binary(Binary::Mul, a, b) => of(*a) * of(*b),
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
            Op::Shift(Shift::Right, a, by) => of(*a) >> of(*by),
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

/// Every value of every node in every reachable state is in the node's range; and ranges are not trivial.
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

//! Makes a module printable: constants are folded, so that no linter meets `a >= 8'd0`; shifts by a constant become
//! slices; nodes that only pass a value on disappear unless they have a name.

use super::constant;
use super::order::{map_operands, operands_first};
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Binary, Contents, Module, Node, NodeId, Op, Reduction, Relation, Shift, Unary};

/// Shift amounts above this width are cut, with the fill where a dropped bit is set: some tools take no more.
const WIDEST_AMOUNT: u32 = 16;

/// The same circuit, simplified. Nodes keep their ids; new ones are appended.
pub fn fold(module: &Module) -> Module {
    let mut fold = Fold { module: module.clone(), same: (0..module.nodes.len() as u32).map(NodeId).collect() };
    for id in operands_first(module) {
        fold.visit(id);
    }
    fold.rewire();
    fold.settle_memories();
    fold.module
}

struct Fold {
    module: Module,
    /// For each node, the node that stands for it.
    same: Vec<NodeId>,
}

/// What a node turns out to be.
enum Outcome {
    /// An operator on other nodes.
    Op(Op),
    /// Another node.
    Same(NodeId),
}

use Outcome::{Op as Is, Same};

impl Fold {
    fn visit(&mut self, id: NodeId) {
        let op = map_operands(&self.module.node(id).op, |operand| self.same[operand.0 as usize]);
        let outcome = self.simplify(id, op);
        let named = self.module.node(id).name.is_some();
        match outcome {
            Is(Op::Wire(to)) | Is(Op::QuasiStatic(to, _)) | Same(to) if !named => self.same[id.0 as usize] = to,
            Same(to) => self.module.nodes[id.0 as usize].op = Op::Wire(to),
            Is(op) => self.module.nodes[id.0 as usize].op = op,
        }
    }

    /// Lets registers, memories, instances, outputs and asserts refer to the nodes that are left.
    fn rewire(&mut self) {
        let same = &self.same;
        let to = |id: &mut NodeId| *id = same[id.0 as usize];
        let module = &mut self.module;
        let constant = |nodes: &[Node], id: NodeId| match &nodes[id.0 as usize].op {
            Op::Const(bits) => Some(!bits.is_zero()),
            _ => None,
        };
        for register in &mut module.registers {
            to(&mut register.next);
            register.enable.iter_mut().for_each(to);
            match register.enable.and_then(|enable| constant(&module.nodes, enable)) {
                Some(true) => register.enable = None,
                Some(false) => (register.enable, register.next) = (None, register.node),
                None => {}
            }
        }
        for memory in &mut module.memories {
            for read in &mut memory.reads {
                to(&mut read.address);
                read.enable.iter_mut().for_each(to);
                if read.enable.and_then(|enable| constant(&module.nodes, enable)) == Some(true) {
                    read.enable = None;
                }
            }
            for write in &mut memory.writes {
                [&mut write.enable, &mut write.address, &mut write.data].into_iter().for_each(to);
            }
        }
        module.instances.iter_mut().flat_map(|instance| &mut instance.inputs).for_each(to);
        module.outputs.iter_mut().for_each(|output| to(&mut output.node));
        module.asserts.iter_mut().for_each(|assert| to(&mut assert.condition));
    }

    /// Drops writes that never happen. A memory that is never written is zero, rather than undriven. A constant write
    /// address gets a net, for Yosys takes a memory with a literal one apart into registers.
    fn settle_memories(&mut self) {
        for index in 0..self.module.memories.len() {
            let mut memory = self.module.memories[index].clone();
            let depth = u64::from(memory.depth);
            memory.writes.retain(|write| {
                let address = self.constant(write.address);
                let never = self.constant(write.enable).is_some_and(|enable| enable.is_zero());
                !never && address.is_none_or(|address| address.to_u64().is_some_and(|address| address < depth))
            });
            for write in &mut memory.writes {
                if let Op::Const(_) = self.module.node(write.address).op {
                    let node = Node { op: Op::Wire(write.address), ..self.module.node(write.address).clone() };
                    write.address = NodeId(self.module.nodes.len() as u32);
                    self.module.nodes.push(node);
                }
            }
            if memory.writes.is_empty() && memory.contents == Contents::Unknown {
                memory.contents = Contents::Fill(Bits::zero(memory.width));
            }
            self.module.memories[index] = memory;
        }
    }

    /// The value of a node that is constant, also behind a name.
    fn constant(&self, mut id: NodeId) -> Option<Bits> {
        loop {
            match &self.module.node(id).op {
                Op::Const(bits) => return Some(bits.clone()),
                Op::Wire(to) | Op::QuasiStatic(to, _) => id = *to,
                _ => return None,
            }
        }
    }

    fn width(&self, id: NodeId) -> u32 {
        self.module.width(id)
    }

    /// A new unnamed node, in the place of `of`.
    fn add(&mut self, of: NodeId, width: u32, op: Op) -> NodeId {
        let id = NodeId(self.module.nodes.len() as u32);
        let loc = self.module.node(of).loc;
        self.module.nodes.push(Node { op, width, lanes: None, name: None, loc });
        self.same.push(id);
        self.visit(id);
        self.same[id.0 as usize]
    }

    fn simplify(&mut self, id: NodeId, op: Op) -> Outcome {
        let width = self.width(id);
        match op {
            Op::Unary(unary, a) => self.unary(unary, a),
            Op::Binary(binary, a, b) => self.binary(binary, a, b),
            Op::Compare { relation, signed, operands: [a, b] } => self.compare(relation, signed, a, b),
            Op::Shift(shift, a, amount) => self.shift(id, shift, a, amount),
            Op::Mux { select, on_true, on_false } => self.mux(select, on_true, on_false),
            Op::Select { arms, default } => self.select(arms, default),
            Op::Case { subject, arms, default } => match self.constant(subject) {
                Some(value) => Same(arms.iter().find(|(key, _)| *key == value).map_or(default, |&(_, value)| value)),
                None if arms.iter().all(|&(_, value)| value == default) => Same(default),
                None => Is(Op::Case { subject, arms, default }),
            },
            Op::Slice { of, low } => self.slice(of, low, width),
            Op::Concat(parts) => self.concat(parts),
            Op::Repeat(a, 1) => Same(a),
            Op::Repeat(a, times) => match self.constant(a) {
                Some(value) => Is(Op::Const((1..times).fold(value.clone(), |all, _| all.concat(&value)))),
                None => Is(Op::Repeat(a, times)),
            },
            Op::Extend { of, signed } => match self.constant(of) {
                _ if self.width(of) == width => Same(of),
                Some(value) if signed => Is(Op::Const(value.sext(width))),
                Some(value) => Is(Op::Const(value.resize(width))),
                None => Is(Op::Extend { of, signed }),
            },
            Op::Shifted { by: 0, of, .. } => Same(of),
            Op::Shifted { by, edge, .. } if Some(by.unsigned_abs()) >= self.module.node(id).lanes => {
                Is(Op::Broadcast(edge))
            }
            Op::Shifted { of, by, edge } => match self.module.node(of).op.clone() {
                Op::Broadcast(plain) if plain == edge => Same(of),
                Op::PerLane(_) | Op::Broadcast(_) => {
                    let lanes = self.module.node(id).lanes.expect("a shifted value has lanes");
                    Is(Op::PerLane((0..lanes).map(|lane| self.shifted_lane(of, lane, by, edge, lanes)).collect()))
                }
                _ => Is(Op::Shifted { of, by, edge }),
            },
            Op::PerLane(parts) if parts.iter().all(|&part| part == parts[0]) => Is(Op::Broadcast(parts[0])),
            Op::Lane(of, lane) => self.lane(of, lane),
            Op::Reduce(reduction, of) => self.reduce(id, reduction, of),
            other => Is(other),
        }
    }

    fn unary(&self, unary: Unary, a: NodeId) -> Outcome {
        match self.constant(a) {
            Some(value) => Is(Op::Const(constant::unary(unary, &value))),
            None if unary != Unary::Not && self.width(a) == 1 => Same(a),
            None => match self.module.node(a) {
                Node { op: Op::Unary(Unary::Not, inner), name: None, .. } if unary == Unary::Not => Same(*inner),
                Node { op: Op::Compare { relation, signed, operands }, name: None, .. } if unary == Unary::Not => {
                    Is(Op::Compare { relation: opposite(*relation), signed: *signed, operands: *operands })
                }
                _ => Is(Op::Unary(unary, a)),
            },
        }
    }

    fn binary(&self, binary: Binary, a: NodeId, b: NodeId) -> Outcome {
        let values = (self.constant(a), self.constant(b));
        if let (Some(a), Some(b)) = &values
            && let Some(value) = constant::binary(binary, a, b)
        {
            return Is(Op::Const(value));
        }
        let zero = |value: &Option<Bits>| value.as_ref().is_some_and(Bits::is_zero);
        let ones = |value: &Option<Bits>| value.as_ref().is_some_and(|value| value.not().is_zero());
        match binary {
            Binary::Xor | Binary::Sub if a == b => Is(Op::Const(Bits::zero(self.width(a)))),
            Binary::And | Binary::Or if a == b => Same(a),
            Binary::And if self.are_opposite(a, b) => Is(Op::Const(Bits::zero(self.width(a)))),
            Binary::Or | Binary::Xor if self.are_opposite(a, b) => Is(Op::Const(Bits::ones(self.width(a)))),
            Binary::Mul | Binary::MulSigned if zero(&values.0) || zero(&values.1) => {
                Is(Op::Const(Bits::zero(self.width(a) + self.width(b))))
            }
            Binary::Add | Binary::Or | Binary::Xor if zero(&values.0) => Same(b),
            Binary::Add | Binary::Sub | Binary::Or | Binary::Xor if zero(&values.1) => Same(a),
            Binary::And if zero(&values.0) || ones(&values.1) => Same(a),
            Binary::And if zero(&values.1) || ones(&values.0) => Same(b),
            Binary::Or if ones(&values.0) => Same(a),
            Binary::Or if ones(&values.1) => Same(b),
            _ => Is(Op::Binary(binary, a, b)),
        }
    }

    /// Whether one is the other inverted.
    fn are_opposite(&self, a: NodeId, b: NodeId) -> bool {
        let inverts = |a, b| self.module.node(a).op == Op::Unary(Unary::Not, b);
        inverts(a, b) || inverts(b, a)
    }

    fn compare(&self, relation: Relation, signed: bool, a: NodeId, b: NodeId) -> Outcome {
        let width = self.width(a);
        let (lowest, highest) = constant::range(width, signed);
        let truth = |value: bool| Is(Op::Const(Bits::from(value)));
        let is = |value: &Option<Bits>, what: &Bits| value.as_ref() == Some(what);
        let (left, right) = (self.constant(a), self.constant(b));
        if let (Some(left), Some(right)) = (&left, &right) {
            return truth(constant::compare(relation, signed, left, right));
        }
        if a == b {
            return truth(matches!(relation, Relation::Eq | Relation::Le | Relation::Ge));
        }
        match relation {
            Relation::Lt if is(&right, &lowest) || is(&left, &highest) => truth(false),
            Relation::Gt if is(&right, &highest) || is(&left, &lowest) => truth(false),
            Relation::Le if is(&right, &highest) || is(&left, &lowest) => truth(true),
            Relation::Ge if is(&right, &lowest) || is(&left, &highest) => truth(true),
            Relation::Eq | Relation::Ne if width == 1 && (left.is_some() || right.is_some()) => {
                let (value, other) = if let Some(value) = left { (value, b) } else { (right.expect("a constant"), a) };
                match (relation == Relation::Eq) != value.is_zero() {
                    true => Same(other),
                    false => self.unary(Unary::Not, other),
                }
            }
            _ => Is(Op::Compare { relation, signed, operands: [a, b] }),
        }
    }

    fn mux(&self, select: NodeId, on_true: NodeId, on_false: NodeId) -> Outcome {
        if let Some(select) = self.constant(select) {
            return Same(if select.is_zero() { on_false } else { on_true });
        }
        if on_true == on_false {
            return Same(on_true);
        }
        let bit = |id: NodeId| (self.width(id) == 1).then(|| self.constant(id)).flatten().map(|value| !value.is_zero());
        match (bit(on_true), bit(on_false)) {
            (Some(true), Some(false)) => Same(select),
            (Some(false), Some(true)) => self.unary(Unary::Not, select),
            _ => Is(Op::Mux { select, on_true, on_false }),
        }
    }

    fn select(&self, arms: Vec<(NodeId, NodeId)>, default: NodeId) -> Outcome {
        let (mut kept, mut default) = (Vec::with_capacity(arms.len()), default);
        for (condition, value) in arms {
            match self.constant(condition) {
                Some(never) if never.is_zero() => {}
                Some(_) => {
                    default = value;
                    break;
                }
                None => kept.push((condition, value)),
            }
        }
        while kept.last().is_some_and(|&(_, value)| value == default) {
            kept.pop();
        }
        match kept[..] {
            [] => Same(default),
            [(select, on_true)] => self.mux(select, on_true, default),
            _ => Is(Op::Select { arms: kept, default }),
        }
    }

    fn slice(&self, of: NodeId, low: u32, width: u32) -> Outcome {
        if width == self.width(of) {
            return Same(of);
        }
        if let Some(value) = self.constant(of) {
            return Is(Op::Const(value.slice(low..low + width)));
        }
        let node = self.module.node(of);
        if node.name.is_some() {
            return Is(Op::Slice { of, low });
        }
        match &node.op {
            Op::Slice { of: inner, low: base } => self.slice(*inner, base + low, width),
            Op::Extend { of: inner, .. } if low + width <= self.width(*inner) => self.slice(*inner, low, width),
            Op::Extend { of: inner, signed: false } if low >= self.width(*inner) => Is(Op::Const(Bits::zero(width))),
            Op::Concat(parts) => {
                let mut base = 0;
                for &part in parts.iter().rev() {
                    let part_width = self.width(part);
                    if low >= base && low + width <= base + part_width {
                        return self.slice(part, low - base, width);
                    }
                    base += part_width;
                }
                Is(Op::Slice { of, low })
            }
            _ => Is(Op::Slice { of, low }),
        }
    }

    fn concat(&self, parts: Vec<NodeId>) -> Outcome {
        if let [part] = parts[..] {
            return Same(part);
        }
        let values: Option<Vec<Bits>> = parts.iter().map(|&part| self.constant(part)).collect();
        match values.and_then(|values| values.into_iter().reduce(|high, low| high.concat(&low))) {
            Some(value) => Is(Op::Const(value)),
            None => Is(Op::Concat(parts)),
        }
    }

    fn shift(&mut self, id: NodeId, shift: Shift, a: NodeId, amount: NodeId) -> Outcome {
        let width = self.width(a);
        if let Some(amount) = self.constant(amount) {
            let amount = amount.to_u64().map_or(width, |amount| amount.min(u64::from(width)) as u32);
            return self.shift_by(id, shift, a, amount);
        }
        if self.constant(a).is_some_and(|value| value.is_zero()) {
            return Same(a);
        }
        let amount_width = self.width(amount);
        if amount_width <= WIDEST_AMOUNT || width >= 1 << WIDEST_AMOUNT {
            return Is(Op::Shift(shift, a, amount));
        }
        let high = self.add(id, amount_width - WIDEST_AMOUNT, Op::Slice { of: amount, low: WIDEST_AMOUNT });
        let beyond = self.add(id, 1, Op::Unary(Unary::AnyOne, high));
        let low = self.add(id, WIDEST_AMOUNT, Op::Slice { of: amount, low: 0 });
        let shifted = self.add(id, width, Op::Shift(shift, a, low));
        let filling = self.shift_by(id, shift, a, width);
        let filling = self.settle(id, width, filling);
        self.mux(beyond, filling, shifted)
    }

    /// The node of an outcome.
    fn settle(&mut self, of: NodeId, width: u32, outcome: Outcome) -> NodeId {
        match outcome {
            Same(id) => id,
            Is(op) => self.add(of, width, op),
        }
    }

    fn shift_by(&mut self, id: NodeId, shift: Shift, a: NodeId, amount: u32) -> Outcome {
        let width = self.width(a);
        if amount == 0 {
            return Same(a);
        }
        if amount >= width {
            if shift != Shift::RightSigned {
                return Is(Op::Const(Bits::zero(width)));
            }
            let sign = self.add(id, 1, Op::Slice { of: a, low: width - 1 });
            return if width == 1 { Same(a) } else { Is(Op::Repeat(sign, width)) };
        }
        let low = if shift == Shift::Left { 0 } else { amount };
        let kept = self.add(id, width - amount, Op::Slice { of: a, low });
        match shift {
            Shift::Left => {
                let zeros = self.add(id, amount, Op::Const(Bits::zero(amount)));
                Is(Op::Concat(vec![kept, zeros]))
            }
            Shift::Right => Is(Op::Extend { of: kept, signed: false }),
            Shift::RightSigned => Is(Op::Extend { of: kept, signed: true }),
        }
    }

    fn lane(&self, of: NodeId, lane: u32) -> Outcome {
        match self.module.node(of).op.clone() {
            Op::Broadcast(plain) => Same(plain),
            Op::PerLane(parts) => Same(parts[lane as usize]),
            Op::Wire(inner) => self.lane(inner, lane),
            Op::Shifted { of: inner, by, edge } => {
                let lanes = self.module.node(of).lanes.expect("a shifted value has lanes");
                match source_lane(lane, by, lanes) {
                    Some(from) => self.lane(inner, from),
                    None => Same(edge),
                }
            }
            _ => Is(Op::Lane(of, lane)),
        }
    }

    /// A lane of a shifted value whose lanes are plain nodes.
    fn shifted_lane(&self, of: NodeId, lane: u32, by: i32, edge: NodeId, lanes: u32) -> NodeId {
        match source_lane(lane, by, lanes).map(|from| self.lane(of, from)) {
            Some(Same(plain)) => plain,
            _ => edge,
        }
    }

    /// Only outputs of arrays are reduced by the array's own tree; anything else is written out lane by lane.
    fn reduce(&mut self, id: NodeId, reduction: Reduction, of: NodeId) -> Outcome {
        let node = self.module.node(of);
        let lanes = node.lanes.expect("a reduced value has lanes");
        if lanes > 1 && matches!(node.op, Op::Output(..)) {
            return Is(Op::Reduce(reduction, of));
        }
        let (width, binary) = (node.width, plain_operator(reduction));
        let mut level: Vec<NodeId> = (0..lanes).map(|lane| self.add(id, width, Op::Lane(of, lane))).collect();
        while level.len() > 1 {
            let pairs: Vec<Vec<NodeId>> = level.chunks(2).map(<[NodeId]>::to_vec).collect();
            level = pairs
                .into_iter()
                .map(|pair| match pair[..] {
                    [a, b] => self.add(id, width, Op::Binary(binary, a, b)),
                    _ => pair[0],
                })
                .collect();
        }
        Same(level[0])
    }
}

/// The relation that holds where this one does not.
fn opposite(relation: Relation) -> Relation {
    match relation {
        Relation::Eq => Relation::Ne,
        Relation::Ne => Relation::Eq,
        Relation::Lt => Relation::Ge,
        Relation::Ge => Relation::Lt,
        Relation::Gt => Relation::Le,
        Relation::Le => Relation::Gt,
    }
}

/// The operator that combines two lanes.
pub fn plain_operator(reduction: Reduction) -> Binary {
    match reduction {
        Reduction::And => Binary::And,
        Reduction::Or => Binary::Or,
        Reduction::Xor => Binary::Xor,
        Reduction::Add => Binary::Add,
    }
}

/// The lane that reaches `lane` when all move by `by`.
fn source_lane(lane: u32, by: i32, lanes: u32) -> Option<u32> {
    u32::try_from(i64::from(lane) - i64::from(by)).ok().filter(|&from| from < lanes)
}

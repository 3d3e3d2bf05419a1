//! Expressions as text. Both sides of an operator have equal widths and every change of width is explicit, so no
//! context rule of Verilog extends or truncates anything. An operand that is itself an operator has parentheses.

use super::lane_values::values;
use super::literal::{self, Style, literal};
use super::plan::Form;
use super::printer::Printer;
use super::reads::constant_address;
use tilewright_circuit::ir::{Binary, Kind, Memory, MemoryId, NodeId, Op, Relation, Shift, Unary};
use tilewright_circuit::{Bits, Radix};

impl Printer<'_> {
    /// The expression for a use of a node: its name if it has one.
    pub fn value(&mut self, id: NodeId) -> String {
        self.value_as(id, Style::Count)
    }

    /// A value that is assigned: a negative constant has its sign. Elsewhere, as in an index, the sign would count.
    pub fn assigned(&mut self, id: NodeId) -> String {
        match self.inline_constant(id) {
            Some((value, kind)) => number(value, kind, Style::Count),
            None => self.value(id),
        }
    }

    /// The constant as which a node is printed, and its kind.
    fn inline_constant(&self, id: NodeId) -> Option<(&Bits, Kind)> {
        let of = self.printed(id);
        match (&self.module.node(of).op, self.plan.form(of)) {
            (Op::Const(value), Form::Inline) => Some((value, self.module.node(of).kind)),
            _ => None,
        }
    }

    fn value_as(&mut self, id: NodeId, style: Style) -> String {
        match self.plan.form(id) {
            Form::Declared | Form::Net | Form::Block | Form::Constants => self.part(id, 0, self.module.width(id)),
            _ => self.expression(id, style),
        }
    }

    /// The operator of a node, even if it has a name.
    pub fn expression(&mut self, id: NodeId, style: Style) -> String {
        let module = self.module;
        let node = module.node(id);
        match &node.op {
            Op::Const(value) => literal(value, style),
            Op::Unary(unary, a) => self.unary(*unary, *a),
            Op::Binary(binary, a, b) => self.binary(*binary, *a, *b, node.width),
            Op::Compare { relation, signed, operands } => self.compare(*relation, *signed, *operands),
            Op::Shift(Shift::RightSigned, a, amount) => {
                let (a, amount) = (self.value(*a), self.operand(*amount, Style::Count));
                format!("$signed({a}) >>> {amount}")
            }
            Op::Shift(shift, a, amount) => {
                let operator = if *shift == Shift::Left { "<<" } else { ">>" };
                format!("{} {operator} {}", self.operand(*a, style), self.operand(*amount, Style::Count))
            }
            Op::Mux { select, on_true, on_false } => {
                let states = self.states.of(id);
                let select = self.operand(*select, style);
                let on_true = self.state_text(*on_true, states).unwrap_or_else(|| self.operand(*on_true, style));
                let on_false = self.state_text(*on_false, states).unwrap_or_else(|| self.operand(*on_false, style));
                format!("{select} ? {on_true} : {on_false}")
            }
            Op::Slice { of, low } => self.slice(*of, *low, node.width),
            Op::Concat(_) | Op::Extend { signed: false, .. } => format!("{{{}}}", self.joined(id).join(", ")),
            Op::Repeat(a, times) => format!("{{{times}{{{}}}}}", self.value_as(*a, Style::Pattern)),
            Op::Extend { of, signed: true } => self.extend_signed(*of, node.width),
            Op::Wire(_) | Op::QuasiStatic(..) | Op::Broadcast { .. } | Op::Lane { .. } | Op::Map { edge: None, .. } => {
                let (of, at) = self.operand_place(id).expect("it names a place");
                self.at(at, |printer| printer.value_as(of, style))
            }
            Op::Unpack { .. } => self.vector_part(id, 0, node.width),
            Op::Read(memory, port) => self.asynchronous_read(*memory, *port),
            Op::Reduce { .. } | Op::Select { .. } | Op::Case { .. } => unreachable!("printed as a net of its own"),
            Op::Input(_) | Op::Register(_) | Op::Output(..) => self.value(id),
            Op::Stack { .. } | Op::Map { .. } | Op::Interleave { .. } | Op::Pick { .. } | Op::Pack { .. } => {
                unreachable!("printed as a net of its own")
            }
        }
    }

    /// The parts of a concatenation, including those of nested concatenations.
    fn joined(&mut self, id: NodeId) -> Vec<String> {
        let parts = match &self.module.node(id).op {
            Op::Concat(parts) => parts.clone(),
            Op::Extend { of, signed: false } => vec![*of],
            _ => return vec![self.value_as(id, Style::Pattern)],
        };
        let zeros = self.module.width(id) - parts.iter().map(|&part| self.module.width(part)).sum::<u32>();
        let zeros = (zeros > 0).then(|| format!("{zeros}'d0"));
        let mut joined: Vec<String> = zeros.into_iter().collect();
        for part in parts {
            match self.plan.form(part) {
                Form::Inline => joined.extend(self.joined(part)),
                _ => joined.push(self.value_as(part, Style::Pattern)),
            }
        }
        joined
    }

    /// The node whose operator is printed for `inner`.
    fn printed(&self, mut inner: NodeId) -> NodeId {
        while let (
            Form::Inline,
            Op::Wire(to)
            | Op::QuasiStatic(to, _)
            | Op::Broadcast { of: to, .. }
            | Op::Lane { of: to, .. }
            | Op::Map { of: to, edge: None, .. },
        ) = (self.plan.form(inner), &self.module.node(inner).op)
        {
            inner = *to;
        }
        inner
    }

    /// The expression of an operand, in parentheses if it is an operator.
    pub fn operand(&mut self, id: NodeId, style: Style) -> String {
        let inner = self.printed(id);
        let text = self.value_as(id, style);
        let operator = match &self.module.node(inner).op {
            Op::Unary(unary, _) => *unary != Unary::Not,
            Op::Binary(..) | Op::Compare { .. } | Op::Shift(..) | Op::Mux { .. } => true,
            _ => false,
        };
        if operator && self.plan.form(inner) == Form::Inline { format!("({text})") } else { text }
    }

    fn unary(&mut self, unary: Unary, a: NodeId) -> String {
        let operator = match unary {
            Unary::Not if self.module.width(a) == 1 => "!",
            Unary::Not => "~",
            Unary::AllOnes => "&",
            Unary::AnyOne => "|",
            Unary::Parity => "^",
        };
        let operand = self.operand(a, Style::Pattern);
        // `^~b` would be a single, different operator.
        if operand.starts_with(['~', '!']) { format!("{operator}({operand})") } else { format!("{operator}{operand}") }
    }

    fn binary(&mut self, binary: Binary, a: NodeId, b: NodeId, width: u32) -> String {
        let operator = match binary {
            Binary::And => "&",
            Binary::Or => "|",
            Binary::Xor => "^",
            Binary::Add => "+",
            Binary::Sub => "-",
            Binary::Mul => return format!("{} * {}", self.widened(a, width), self.widened(b, width)),
            Binary::MulSigned => return format!("{} * {}", self.signed(a, width), self.signed(b, width)),
        };
        let style = if matches!(binary, Binary::Add | Binary::Sub) { Style::Count } else { Style::Pattern };
        // `a | b | c` is read from the left.
        let left = self.printed(a);
        let is_same = matches!(self.module.node(left).op, Op::Binary(left, ..) if left == binary);
        let left = match is_same && self.plan.form(left) == Form::Inline {
            true => self.value_as(a, style),
            false => self.operand(a, style),
        };
        format!("{left} {operator} {}", self.operand(b, style))
    }

    /// A factor of an unsigned product, at the product's width.
    fn widened(&mut self, a: NodeId, width: u32) -> String {
        match &self.module.node(a).op {
            Op::Const(value) => literal(&value.resize(width), Style::Count),
            _ => format!("{{{}'d0, {}}}", width - self.module.width(a), self.value(a)),
        }
    }

    fn compare(&mut self, relation: Relation, signed: bool, [a, b]: [NodeId; 2]) -> String {
        let operator = match relation {
            Relation::Eq => "==",
            Relation::Ne => "!=",
            Relation::Lt => "<",
            Relation::Le => "<=",
            Relation::Gt => ">",
            Relation::Ge => ">=",
        };
        let is_order = !matches!(relation, Relation::Eq | Relation::Ne);
        if is_order && signed || !is_order && (self.is_negative(a) || self.is_negative(b)) {
            let width = self.module.width(a);
            return format!("{} {operator} {}", self.signed(a, width), self.signed(b, width));
        }
        let (left, right) = (self.state_or_operand(a, b), self.state_or_operand(b, a));
        format!("{left} {operator} {right}")
    }

    /// Whether an operand is printed as a constant with a minus, which linters compare with signed operands only.
    fn is_negative(&self, id: NodeId) -> bool {
        let constant = self.inline_constant(id);
        constant.is_some_and(|(value, kind)| number(value, kind, Style::Count).starts_with('-'))
    }

    /// An operand of an operator that computes with signed numbers of this width. A negative constant has the width
    /// itself: a minus is an operator, and linters complain where its operand is extended.
    fn signed(&mut self, id: NodeId, width: u32) -> String {
        let constant = self.inline_constant(id).filter(|(value, _)| value.radix() == Radix::Any);
        let number = constant.and_then(|(value, _)| literal::signed(&value.sext(width)));
        number.unwrap_or_else(|| format!("$signed({})", self.value(id)))
    }

    /// An operand of a comparison: a constant that is compared with a state is printed by the state's name.
    fn state_or_operand(&mut self, id: NodeId, other: NodeId) -> String {
        self.state_text(id, self.states.of(other)).unwrap_or_else(|| self.operand(id, Style::Count))
    }

    /// The state's name for a constant where a state of that enum is expected.
    pub fn state_text(&mut self, id: NodeId, states: Option<usize>) -> Option<String> {
        match (&self.module.node(id).op, self.plan.form(id), states) {
            (Op::Const(value), Form::Inline, Some(states)) => Some(self.states.name(states, value)),
            _ => None,
        }
    }

    fn slice(&mut self, of: NodeId, low: u32, width: u32) -> String {
        // `x[0]` of one bit is `x`.
        if width == self.module.width(of) { self.value(of) } else { self.part(of, low, width) }
    }

    fn extend_signed(&mut self, of: NodeId, width: u32) -> String {
        let (id, inner, missing) = (of, self.module.width(of), width - self.module.width(of));
        let value = self.value(of);
        let sign = match self.module.node(of).op {
            _ if inner == 1 => return format!("{{{width}{{{value}}}}}"),
            Op::Slice { of, low } if self.plan.form(id) == Form::Inline => self.part(of, low + inner - 1, 1),
            _ => self.part(id, inner - 1, 1),
        };
        match missing {
            1 => format!("{{{sign}, {value}}}"),
            _ => format!("{{{{{missing}{{{sign}}}}}, {value}}}"),
        }
    }

    /// `address < depth`.
    pub fn inside(&mut self, memory: &Memory, address: NodeId) -> String {
        let depth = literal(&Bits::new(self.module.width(address), u64::from(memory.depth)), Style::Count);
        self.below(address, &depth)
    }

    /// `index < count`, for a literal of the index's width.
    pub fn below(&mut self, index: NodeId, count: &str) -> String {
        let is_constant = !self.module.shape(index).is_plain() && values(self.module, index).is_some();
        let index = self.operand(index, Style::Count);
        match is_constant {
            // Linters complain about a lane in which the comparison is constant; with more bits it looks like any
            // other.
            true => format!("$signed({{2'd0, {index}}}) < $signed({{2'd0, {count}}})"),
            false => format!("{index} < {count}"),
        }
    }

    /// The word at an address, which is zero at a constant address beyond the depth.
    pub fn word(&mut self, memory: &Memory, address: NodeId) -> String {
        match constant_address(self.module, address) {
            Some(address) if address >= u64::from(memory.depth) => literal(&Bits::zero(memory.width), Style::Count),
            _ => {
                self.usage.memories.insert(memory.name.clone());
                format!("{}[{}]", memory.name, self.value(address))
            }
        }
    }

    /// The word of an asynchronous port, zero beyond the depth.
    pub fn asynchronous_read(&mut self, memory: MemoryId, port: u32) -> String {
        let (module, beyond) = (self.module, self.beyond[memory.0 as usize][port as usize]);
        let memory = &module.memories[memory.0 as usize];
        let address = memory.reads[port as usize].address;
        let word = self.word(memory, address);
        if !beyond {
            return word;
        }
        let zero = literal(&Bits::zero(memory.width), Style::Count);
        format!("({}) ? {word} : {zero}", self.inside(memory, address))
    }
}

/// A constant of this kind; a negative one has its sign.
pub fn number(value: &Bits, kind: Kind, style: Style) -> String {
    let is_negative = kind == Kind::Signed && style == Style::Count && value.bit(value.width() - 1);
    literal::signed(value).filter(|_| is_negative).unwrap_or_else(|| literal(value, style))
}

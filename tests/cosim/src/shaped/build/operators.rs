//! Elementwise operators, and constants.

use super::*;
use std::collections::HashSet;
use tilewright_hdl::Bits;

impl Builder<'_> {
    pub fn compare(&mut self, relation: Relation, signed: bool, left: NodeId, right: NodeId) -> NodeId {
        self.build.node(Op::Compare { relation, signed, operands: [left, right] }, 1, self.build.shape(left))
    }

    /// Several values of one shape, that of the first.
    pub fn alike(&mut self, picks: &[Pick]) -> Vec<NodeId> {
        let first = self.any(picks[0]);
        let shape = self.build.shape(first);
        let others = picks[1..].iter().map(|pick| {
            let (value, how) = self.choose(*pick, shape);
            self.in_shape(value, shape, how)
        });
        let others: Vec<NodeId> = others.collect();
        [first].into_iter().chain(others).collect()
    }

    /// A constant for each lane.
    pub fn table(&mut self, width: u32, seed: Option<u64>, shape: Shape) -> NodeId {
        let mut numbers = seed.map(Numbers);
        let lanes: Vec<NodeId> = (0..shape.lanes())
            .map(|lane| {
                let number = || Bits::from_limbs(width, &[u64::from(lane), 0, 0, 0, 0][..width.div_ceil(64) as usize]);
                let bits = numbers.as_mut().map_or_else(number, |numbers| numbers.bits(width));
                self.build.node(Op::Const(bits), width, Shape::Plain)
            })
            .collect();
        match shape {
            Shape::Plain => lanes[0],
            Shape::Row(_) => self.build.stack(&lanes, 0),
            Shape::Grid(_, columns) => {
                let rows = lanes.chunks(columns as usize).map(|row| self.build.stack(row, 0));
                let rows: Vec<NodeId> = rows.collect();
                self.build.stack(&rows, 0)
            }
        }
    }

    pub fn operator(&mut self, make: &Make) -> NodeId {
        match make {
            Make::Constant { width, pattern, shape } => {
                self.build.node(Op::Const(pattern.bits(*width)), *width, self.shape(*shape))
            }
            Make::Table { width, seed, shape } => self.table(*width, *seed, self.shape(*shape)),
            Make::Unary(op, a) => {
                let a = self.any(*a);
                let width = if *op == Unary::Not { self.build.width(a) } else { 1 };
                self.build.node(Op::Unary(*op, a), width, self.build.shape(a))
            }
            Make::Binary(op @ (Binary::Mul | Binary::MulSigned), a, b) => {
                let operands = self.alike(&[*a, *b]);
                self.build.binary(*op, operands[0], operands[1])
            }
            Make::Binary(op, a, b) => {
                let a = self.any(*a);
                let b = self.fit(*b, self.build.width(a), self.build.shape(a));
                self.build.binary(*op, a, b)
            }
            Make::Compare { relation, signed, operands: [a, b] } => {
                let a = self.any(*a);
                let b = self.fit(*b, self.build.width(a), self.build.shape(a));
                self.compare(*relation, *signed, a, b)
            }
            Make::Shift { shift, of, by } => {
                let operands = self.alike(&[*of, *by]);
                let (width, shape) = (self.build.width(operands[0]), self.build.shape(operands[0]));
                self.build.node(Op::Shift(*shift, operands[0], operands[1]), width, shape)
            }
            Make::ShiftBy { shift, of, by } => {
                let of = self.any(*of);
                let (width, shape) = (self.build.width(of), self.build.shape(of));
                let by = self.build.constant(7, (*by).into(), shape);
                self.build.node(Op::Shift(*shift, of, by), width, shape)
            }
            Make::Slice { of, low, width } => {
                let of = self.any(*of);
                let has = self.build.width(of);
                let low = low % has;
                self.build.node(Op::Slice { of, low }, (*width).min(has - low), self.build.shape(of))
            }
            Make::Extend { of, by, signed } => {
                let of = self.any(*of);
                let width = self.build.width(of) + by.max(&1);
                self.build.node(Op::Extend { of, signed: *signed }, width, self.build.shape(of))
            }
            Make::Concat(parts) => {
                let parts = self.alike(parts);
                let width = parts.iter().map(|part| self.build.width(*part)).sum();
                let shape = self.build.shape(parts[0]);
                self.build.node(Op::Concat(parts), width, shape)
            }
            Make::Repeat(of, times) => {
                let of = self.any(*of);
                self.build.node(Op::Repeat(of, *times), self.build.width(of) * times, self.build.shape(of))
            }
            Make::Name(of) => {
                let of = self.any(*of);
                self.build.node(Op::Wire(of), self.build.width(of), self.build.shape(of))
            }
            other => self.choice(other),
        }
    }

    fn choice(&mut self, make: &Make) -> NodeId {
        match make {
            Make::Mux { select, on_true, on_false } => {
                let on_true = self.any(*on_true);
                let (width, shape) = (self.build.width(on_true), self.build.shape(on_true));
                let (select, on_false) = (self.fit(*select, 1, shape), self.fit(*on_false, width, shape));
                self.build.mux(select, on_true, on_false)
            }
            Make::Select { arms, default } => {
                let default = self.any(*default);
                let (width, shape) = (self.build.width(default), self.build.shape(default));
                let arm = |(condition, value): &(Pick, Pick)| {
                    (self.fit(*condition, 1, shape), self.fit(*value, width, shape))
                };
                let arms = arms.iter().map(arm).collect();
                self.build.node(Op::Select { arms, default }, width, shape)
            }
            Make::Case { subject, arms, default } => {
                let default = self.any(*default);
                let (width, shape) = (self.build.width(default), self.build.shape(default));
                let (subject, how) = self.choose(*subject, shape);
                let subject = self.in_shape(subject, shape, how);
                let mut keys = HashSet::new();
                let key_width = self.build.width(subject);
                let mut taken = Vec::new();
                for (key, value) in arms {
                    let key = Pattern::Number(*key).bits(key_width);
                    if keys.insert(key.clone()) {
                        taken.push((key, self.fit(*value, width, shape)));
                    }
                }
                self.build.node(Op::Case { subject, arms: taken, default }, width, shape)
            }
            Make::Lookup { subject, bits, width, words } => {
                let subject = self.any(*subject);
                let shape = self.build.shape(subject);
                let subject = self.in_width(subject, *bits, false);
                let mut constant = |pattern: &Pattern| self.build.node(Op::Const(pattern.bits(*width)), *width, shape);
                let default = constant(&words[0]);
                let words = words[1..].iter().take(1 << (*bits).min(8)).map(&mut constant);
                let words: Vec<NodeId> = words.collect();
                self.build.case(subject, &words, default)
            }
            other => unreachable!("no operator: {other:?}"),
        }
    }
}

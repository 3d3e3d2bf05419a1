//! Edits of how a value is computed.

use crate::same::{exclusive, is_guard, is_neutral};
use crate::site::{Sites, always, near, not, observed};
use tilewright_hdl::ir::{Affine, Binary, Module, NodeId, Op, Reduction, Relation, Shift, Unary};

/// Adds the mutants in which one value that can be observed is computed otherwise.
pub(crate) fn edit(sites: &mut Sites) {
    let (module, observed) = (sites.module, observed(sites.module));
    for id in (0..module.nodes.len() as u32).map(NodeId).filter(|id| observed[id.0 as usize]) {
        let mut waits = false;
        module.node(id).op.for_each_operand(|operand| waits |= is_guard(module, operand));
        if !waits {
            Value { id, sites }.edit();
        }
    }
}

/// A value, and the mutants so far.
struct Value<'s, 'm> {
    id: NodeId,
    sites: &'s mut Sites<'m>,
}

impl Value<'_, '_> {
    /// Adds a mutant of this value.
    fn add(&mut self, change: impl Into<String>, edit: impl FnOnce(&mut Module, NodeId)) {
        let (id, node) = (self.id, self.sites.module.node(self.id));
        let what = node.name.as_deref().unwrap_or(kind(&node.op));
        self.sites.add(what, node.loc, change, |module| edit(module, id));
    }

    /// Adds a mutant in which the value has another operation.
    fn becomes(&mut self, change: impl Into<String>, op: Op) {
        self.add(change, |module, id| module.nodes[id.0 as usize].op = op);
    }

    fn edit(&mut self) {
        let module = self.sites.module;
        let op = &module.node(self.id).op;
        match op.clone() {
            Op::Const(bits) => near(&bits).into_iter().for_each(|(change, bits)| self.becomes(change, Op::Const(bits))),
            Op::Unary(operator, of) => self.unary(operator, of),
            Op::Binary(operator, a, b) => self.binary(operator, a, b),
            Op::Compare { relation, signed, operands } => self.compare(relation, signed, operands),
            Op::Shift(operator, a, b) => {
                let other = if operator == Shift::Left { Shift::Right } else { Shift::Left };
                self.becomes("the other direction", Op::Shift(other, a, b));
                if operator != Shift::Left {
                    let other = if operator == Shift::Right { Shift::RightSigned } else { Shift::Right };
                    self.becomes("the other filling", Op::Shift(other, a, b));
                }
            }
            Op::Mux { select, on_true, on_false } => {
                self.becomes("arms exchanged", Op::Mux { select, on_true: on_false, on_false: on_true });
                self.becomes("always the first arm", Op::Wire(on_true));
                self.becomes("always the second arm", Op::Wire(on_false));
            }
            Op::Select { arms, default } => self.select(&arms, default),
            Op::Case { arms, .. } => self.case(arms.len()),
            Op::Slice { of, low } => {
                let width = module.width(self.id);
                if low + width < module.width(of) {
                    self.becomes("a bit higher", Op::Slice { of, low: low + 1 });
                }
                if low > 0 {
                    self.becomes("a bit lower", Op::Slice { of, low: low - 1 });
                }
            }
            Op::Extend { of, signed } => self.becomes("sign taken for zeros", Op::Extend { of, signed: !signed }),
            Op::Concat(parts) | Op::Stack { parts, .. } | Op::Interleave { parts, .. } => self.parts(parts.len()),
            Op::Map { of, axis, index, edge } => {
                for (change, add) in [("a lane up", index.add + 1), ("a lane down", index.add - 1)] {
                    self.becomes(change, Op::Map { of, axis, index: Affine { add, ..index }, edge });
                }
            }
            Op::Lane { of, axis, index } => {
                self.becomes("the next lane", Op::Lane { of, axis, index: index + 1 });
                if index > 0 {
                    self.becomes("the lane before", Op::Lane { of, axis, index: index - 1 });
                }
            }
            Op::Reduce { by, of, axis } => {
                use Reduction::{Add, And, Max, Min, Or, Xor};
                let others = [And, Or, Xor, Add, Min, Max].into_iter().filter(|other| *other != by);
                others.for_each(|by| self.becomes(format!("{by:?}"), Op::Reduce { by, of, axis }));
            }
            _ => {}
        }
    }

    fn unary(&mut self, operator: Unary, of: NodeId) {
        match operator {
            Unary::Not => self.becomes("inversion dropped", Op::Wire(of)),
            Unary::AnyOne => self.becomes("all for any", Op::Unary(Unary::AllOnes, of)),
            Unary::AllOnes | Unary::Parity => self.becomes("any instead", Op::Unary(Unary::AnyOne, of)),
        }
    }

    fn binary(&mut self, operator: Binary, a: NodeId, b: NodeId) {
        use Binary::{Add, And, Mul, MulSigned, Or, Sub, Xor};
        let others: &[Binary] = match operator {
            And => &[Or, Xor],
            Or => &[And, Xor],
            Xor => &[And, Or],
            Add => &[Sub],
            Sub => &[Add],
            Mul => &[MulSigned],
            MulSigned => &[Mul],
        };
        let module = self.sites.module;
        let [is_a, is_b] = [a, b].map(|operand| is_neutral(module, operator, operand));
        let never_both = exclusive(module, a, b) || operator == Or && (is_a || is_b);
        for other in others {
            if (operator, *other) != (Or, Xor) || !never_both {
                self.becomes(format!("{operator:?} becomes {other:?}"), Op::Binary(*other, a, b));
            }
        }
        if !matches!(operator, Mul | MulSigned) {
            if !is_b {
                self.becomes("the left operand alone", Op::Wire(a));
            }
            if !is_a || operator == Sub {
                self.becomes("the right operand alone", Op::Wire(b));
            }
        }
    }

    fn compare(&mut self, relation: Relation, signed: bool, operands: [NodeId; 2]) {
        use Relation::{Eq, Ge, Gt, Le, Lt, Ne};
        let others: &[Relation] = match relation {
            Eq => &[Ne],
            Ne => &[Eq],
            Lt => &[Le, Ge],
            Le => &[Lt, Gt],
            Gt => &[Ge, Le],
            Ge => &[Gt, Lt],
        };
        for other in others {
            let change = format!("{relation:?} becomes {other:?}");
            self.becomes(change, Op::Compare { relation: *other, signed, operands });
        }
        if !matches!(relation, Eq | Ne) {
            self.becomes("sign taken otherwise", Op::Compare { relation, signed: !signed, operands });
        }
        for holds in [false, true] {
            self.add(format!("always {holds}"), |module, id| {
                let constant = always(module, id, holds);
                module.nodes[id.0 as usize].op = Op::Wire(constant);
            });
        }
    }

    fn select(&mut self, arms: &[(NodeId, NodeId)], default: NodeId) {
        for i in 0..arms.len() {
            let mut others = arms.to_vec();
            others.remove(i);
            let op = if others.is_empty() { Op::Wire(default) } else { Op::Select { arms: others, default } };
            self.becomes(format!("arm {i} dropped"), op);
            self.add(format!("the condition of arm {i} inverted"), |module, id| {
                let condition = not(module, arms[i].0);
                if let Op::Select { arms, .. } = &mut module.nodes[id.0 as usize].op {
                    arms[i].0 = condition;
                }
            });
            if i > 0 && !exclusive(self.sites.module, arms[i - 1].0, arms[i].0) {
                let mut others = arms.to_vec();
                others.swap(i - 1, i);
                self.becomes(format!("arms {} and {i} exchanged", i - 1), Op::Select { arms: others, default });
            }
        }
    }

    fn case(&mut self, count: usize) {
        for i in 0..count {
            self.add(format!("arm {i} dropped"), |module, id| {
                if let Op::Case { arms, default, .. } = &mut module.nodes[id.0 as usize].op {
                    arms.remove(i);
                    if arms.is_empty() {
                        let default = *default;
                        module.nodes[id.0 as usize].op = Op::Wire(default);
                    }
                }
            });
            self.add(format!("the key of arm {i} is another"), |module, id| {
                if let Op::Case { arms, .. } = &mut module.nodes[id.0 as usize].op {
                    let keys: Vec<_> = arms.iter().map(|(key, _)| key.clone()).collect();
                    // A key that another arm has is exchanged with that one's.
                    if let Some((_, other)) = near(&keys[i]).into_iter().next() {
                        if let Some(twin) = keys.iter().position(|key| *key == other) {
                            arms[twin].0 = keys[i].clone();
                        }
                        arms[i].0 = other;
                    }
                }
            });
        }
        self.add("the default is the first arm's", |module, id| {
            if let Op::Case { arms, default, .. } = &mut module.nodes[id.0 as usize].op
                && let Some((_, first)) = arms.first()
            {
                *default = *first;
            }
        });
    }

    fn parts(&mut self, count: usize) {
        for i in 1..count {
            self.add(format!("parts {} and {i} exchanged", i - 1), |module, id| {
                if let Op::Concat(parts) | Op::Stack { parts, .. } | Op::Interleave { parts, .. } =
                    &mut module.nodes[id.0 as usize].op
                {
                    parts.swap(i - 1, i);
                }
            });
        }
    }
}

/// What a value without a name is called.
fn kind(op: &Op) -> &'static str {
    match op {
        Op::Const(_) => "a constant",
        Op::Unary(Unary::Not, _) => "!",
        Op::Binary(operator, ..) => operator.symbol(),
        Op::Compare { relation, .. } => relation.method(),
        Op::Shift(operator, ..) => operator.symbol(),
        Op::Mux { .. } => "mux",
        Op::Select { .. } => "a choice by conditions",
        Op::Case { .. } => "a choice by codes",
        Op::Slice { .. } => "a part",
        Op::Extend { .. } => "a widened value",
        Op::Concat(_) => "cat",
        _ => "an expression",
    }
}

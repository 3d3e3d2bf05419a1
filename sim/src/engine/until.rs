//! The condition that ends a run.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::Relation;

use crate::engine::program::ValueId;
use tilewright_circuit::limbs;

/// The comparison of a value with a number, both unsigned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    Is,
    IsNot,
    Below,
    AtLeast,
}

impl Order {
    /// The relation that is true if this one is not.
    pub fn otherwise(self) -> Relation {
        match self {
            Order::Is => Relation::Ne,
            Order::IsNot => Relation::Eq,
            Order::Below => Relation::Ge,
            Order::AtLeast => Relation::Lt,
        }
    }
}

/// A condition on a value of one lane.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Until {
    pub value: ValueId,
    pub order: Order,
    /// As wide as the value.
    pub number: Bits,
}

impl Until {
    /// Whether the condition is true for this value.
    pub fn holds(&self, value: &[u64]) -> bool {
        let order = limbs::compare(value, self.number.limbs());
        match self.order {
            Order::Is => order.is_eq(),
            Order::IsNot => order.is_ne(),
            Order::Below => order.is_lt(),
            Order::AtLeast => order.is_ge(),
        }
    }
}

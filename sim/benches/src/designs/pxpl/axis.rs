//! One axis of the tree: at place i, the base plus i times the coefficient, one bit a clock, the least significant
//! first.

use tilewright_hdl::{Module, Signal, bit, bits, block, interleave, row};

block! {
    /// The tree for rows or columns.
    pub struct Axis {
        /// A power of two.
        pub edge: u32,
    }
    in AxisIn {
        rst: bit(),
        /// The first bit.
        first: bit(),
        base: bit(),
        coefficient: bit(),
    }
    out(self) AxisOut {
        values: bit().of(row(self.edge)),
    }
}

impl Axis {
    fn build(&self, m: Module, i: AxisIn) -> AxisOut {
        let levels = self.edge.trailing_zeros();
        let held = |name: &str, value: Signal| {
            let reg = m.reg(name, bit().of(value.shape()));
            reg.when(i.rst, 0).otherwise(value);
            *reg
        };
        let (mut values, mut coefficient, mut first) = (i.base.of(row(1)), i.coefficient, i.first);
        for level in 0..levels {
            // A right child adds the coefficient times half its parent's span: shifted by that many bits, with zeros
            // before.
            let later = levels - 1 - level;
            let weighted = match later {
                0 => coefficient,
                _ => {
                    let delay = m.reg(&format!("delay{level}"), bits(later));
                    let shifted = tilewright_hdl::concat(&[*delay, coefficient]).trunc(later);
                    delay.when(i.rst | first, 0).otherwise(shifted);
                    delay.msb()
                }
            };
            let carry = m.reg(&format!("carry{level}"), bit().of(values.shape()));
            let carried = carry & !first;
            carry.when(i.rst, 0).otherwise((values & weighted) | (values & carried) | (carried & weighted));
            let left = held(&format!("left{level}"), values);
            let right = held(&format!("right{level}"), values ^ weighted ^ carried);
            values = interleave([left, right]);
            coefficient = held(&format!("coefficient{level}"), coefficient);
            first = held(&format!("first{level}"), first);
        }
        AxisOut { values }
    }
}

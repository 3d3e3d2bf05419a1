//! What each operation means. There is no second definition: the reference engine computes by it, constants are folded by
//! it, and generated code is compared with it.

mod elementwise;
mod lanes;

use crate::engine::program::{Cell, ValueId};

/// An operand in one lane; the bits above the width are zero.
#[derive(Clone, Copy)]
pub(crate) struct Number<'a> {
    pub limbs: &'a [u64],
    pub width: u32,
}

/// Computes one lane of a cell into `out`, whose limbs hold its width; `operand` gives a lane of a value.
///
/// State and words of memories are not computed from values.
pub(crate) fn lane<'a>(cell: &Cell, lane: u32, out: &mut [u64], operand: impl Fn(ValueId, u32) -> Number<'a>) {
    match cell.kind.is_elementwise() {
        true => elementwise::evaluate(&cell.kind, cell.width, out, |id| operand(id, lane)),
        false => lanes::evaluate(cell, lane, out, operand),
    }
}

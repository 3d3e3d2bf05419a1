//! What each operation means. There is no second definition: the reference engine computes by it, constants are folded by
//! it, and generated code is compared with it.

mod elementwise;
mod lanes;

use crate::engine::program::{Cell, Kind, Lowered, ValueId};

/// An operand in one lane; the bits above the width are zero.
#[derive(Clone, Copy)]
pub(crate) struct Number<'a> {
    pub limbs: &'a [u64],
    pub width: u32,
}

/// Computes one lane of a cell into `out`, whose limbs hold its width; `operand` gives a lane of a value.
///
/// State is not computed, and words of memories are not computed from values alone: [`lane_with_words`] has those.
pub(crate) fn lane<'a>(cell: &Cell, lane: u32, out: &mut [u64], operand: impl Fn(ValueId, u32) -> Number<'a>) {
    match cell.kind.is_elementwise() {
        true => elementwise::evaluate(&cell.kind, cell.width, out, |id| operand(id, lane)),
        false => lanes::evaluate(cell, lane, out, operand),
    }
}

/// As [`lane`], with memories: `word` gives the word of a lane of one, by its index, at an address, as it stands there, or
/// zero beyond the depth.
pub(crate) fn lane_with_words<'a>(
    cell: &Cell,
    lane: u32,
    out: &mut [u64],
    operand: impl Fn(ValueId, u32) -> Number<'a>,
    word: impl Fn(u32, u32, Number, &mut [u64]),
) {
    match cell.kind {
        Kind::Read { memory, address } | Kind::Lowered(Lowered::Word { memory, address }) => {
            word(memory, lane, operand(address, lane), out);
        }
        Kind::Lowered(Lowered::WordOf { memory, address, at }) => {
            word(memory, operand(at, lane).limbs[0] as u32, operand(address, 0), out);
        }
        _ => self::lane(cell, lane, out, operand),
    }
}

//! The meaning of each cell, by that of operations in the circuit. There is no second definition: the reference engine
//! and constant folding use it, and generated code is compared with it.

mod elementwise;
mod lanes;

pub(crate) use tilewright_circuit::limbs::Number;

use crate::engine::program::{Cell, Kind, Lowered, ValueId};

/// Computes one lane of a cell into `out`, which has the limbs of its width; `operand` returns a lane of a value.
///
/// State is not computed, and words of memories depend on more than values: for those use [`lane_with_words`].
pub(crate) fn lane<'a>(cell: &Cell, lane: u32, out: &mut [u64], operand: impl Fn(ValueId, u32) -> Number<'a>) {
    match cell.kind.is_elementwise() {
        true => elementwise::evaluate(&cell.kind, cell.width, out, |id| operand(id, lane)),
        false => lanes::evaluate(cell, lane, out, operand),
    }
}

/// Like [`lane`], with memories: `word` returns the stored form of the word in a lane of a memory, by its index, at
/// an address, or zero beyond the depth.
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

//! Choices between constants become tables, and the two parts of a value in the other order a rotation.

use tilewright_hdl::Bits;

use crate::engine::program::{Cell, Circuit, Kind, ValueId};
use crate::engine::rewrite::Rewriter;

/// The widest number that constants are looked up by.
const LOOKED_UP_BY: u32 = 8;
/// From how many arms on a choice between constants is looked up.
const ARMS: usize = 4;

/// A choice between constants, in one lane, as a look-up in a table.
pub(super) fn lookup(
    rewriter: &mut Rewriter,
    cell: &Cell,
    subject: ValueId,
    arms: &[(Bits, ValueId)],
    default: ValueId,
) -> Option<ValueId> {
    let circuit = rewriter.circuit();
    let is_constant = |value: ValueId| circuit.constant(value).is_some();
    let by = circuit[subject].width;
    let all = is_constant(default) && arms.iter().all(|(_, value)| is_constant(*value));
    if !all || cell.lanes > 1 || arms.len() < ARMS || by > LOOKED_UP_BY || cell.width > 64 {
        return None;
    }
    let mut parts = vec![default; 1 << by];
    arms.iter().for_each(|(key, value)| parts[key.limbs()[0] as usize] = *value);
    let of = rewriter.add(Kind::Stack { parts, inner: 1 }, 1 << by, cell.width);
    Some(rewriter.add(Kind::Gather { of, at: subject }, 1, cell.width))
}

/// What a concatenation of the two parts of a value rotates, and by how much to the left, if the machine has integers
/// of its width.
pub(super) fn rotation(circuit: &Circuit, parts: &[ValueId]) -> Option<Kind> {
    let &[upper, lower] = parts else { return None };
    match (&circuit[upper].kind, &circuit[lower].kind) {
        (&Kind::Slice(of, 0), &Kind::Slice(other, low)) => {
            let width = circuit[of].width;
            let widths = (circuit[upper].width, circuit[lower].width);
            let is_whole = of == other && widths == (low, width - low);
            (is_whole && matches!(width, 8 | 16 | 32 | 64)).then_some(Kind::Rotate(of, width - low))
        }
        _ => None,
    }
}

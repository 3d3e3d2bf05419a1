//! Circuits made anew, operation by operation.

use rustc_hash::FxHashMap;

use super::Rewriter;
use crate::engine::program::{Cell, Circuit, ValueId};

/// Makes these values of a circuit, and everything that they are computed from, anew with `make`. `became` has the
/// values that are known in the new circuit, such as state and constants; the new values of the others are entered
/// there.
pub(crate) fn rebuild(
    circuit: &Circuit,
    roots: impl IntoIterator<Item = ValueId>,
    became: &mut FxHashMap<ValueId, ValueId>,
    rewriter: &mut Rewriter,
    mut make: impl FnMut(&mut Rewriter, Cell) -> ValueId,
) {
    let mut open: Vec<(ValueId, bool)> = Vec::new();
    for root in roots {
        open.push((root, false));
        while let Some((id, is_ready)) = open.pop() {
            if became.contains_key(&id) {
                continue;
            }
            if is_ready {
                let mut cell = circuit[id].clone();
                cell.kind.rewrite(|operand| *operand = became[operand]);
                let made = make(rewriter.at(circuit.loc(id)), cell);
                became.insert(id, made);
            } else {
                open.push((id, true));
                circuit[id].kind.for_each_operand(|operand| open.push((operand, false)));
            }
        }
    }
}

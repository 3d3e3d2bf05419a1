//! Operations on constants.

use tilewright_circuit::{Bits, limbs_for};

use super::super::{Rewrite, Rewriter};
use crate::engine::program::{Cell, Kind};
use crate::engine::semantics::{self, Number};

/// `2 + 3` is `5`.
pub(super) fn fold(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let circuit = rewriter.circuit();
    let (mut is_known, mut operands) = (gives_one_value(&cell.kind), 0);
    cell.kind.for_each_operand(|operand| {
        is_known &= circuit.constant(operand).is_some();
        operands += 1;
    });
    if !is_known || operands == 0 {
        return None;
    }
    let mut limbs = vec![0; limbs_for(cell.width)];
    semantics::lane(cell, 0, &mut limbs, |of, _| {
        let bits = circuit.constant(of).expect("every operand is constant");
        Number { limbs: bits.limbs(), width: bits.width() }
    });
    Some(Rewrite::As(Kind::Const(Bits::from_limbs(cell.width, &limbs))))
}

/// Whether an operation on operands that are the same in all lanes has the same result in all lanes.
fn gives_one_value(kind: &Kind) -> bool {
    let across = matches!(
        kind,
        Kind::Broadcast { .. }
            | Kind::Map { edge: None, .. }
            | Kind::Lane { .. }
            | Kind::Pick { .. }
            | Kind::Reduce { .. }
            | Kind::Pack { .. }
    );
    across || kind.is_elementwise()
}

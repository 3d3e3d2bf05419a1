//! Constants computed at compile time.

use tilewright_hdl::{Bits, limbs_for};

use super::netlist::Netlist;
use super::{Kind, ValueId};
use crate::lane::{Number, evaluate};

/// The value of a cell whose operands are all constant, the same in every lane.
pub(super) fn fold(netlist: &Netlist, id: ValueId) -> Option<Bits> {
    let cell = netlist.cell(id);
    let constant = |of: ValueId| match &netlist.cell(of).kind {
        Kind::Const(bits) => Some(bits),
        _ => None,
    };
    match &cell.kind {
        Kind::Broadcast(of, _) | Kind::Tile(of, _) | Kind::Lane { of, .. } => constant(*of).cloned(),
        kind if kind.is_elementwise() => {
            let mut known = true;
            kind.for_each_operand(|operand| known &= constant(operand).is_some());
            known.then(|| {
                let mut limbs = vec![0; limbs_for(cell.width)];
                evaluate(kind, cell.width, &mut limbs, |of| {
                    let bits = constant(of).expect("every operand is constant");
                    Number { limbs: bits.limbs(), width: bits.width() }
                });
                Bits::from_limbs(cell.width, &limbs)
            })
        }
        _ => None,
    }
}

//! The operands that decide some bits of an operation's result: the rules for operations across lanes and for reads of
//! memories.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::Reduction;

use super::mask;
use super::operation::{Asked, Demand, at_most};
use crate::engine::program::{Axis, Kind, ValueId};

/// What decides these bits.
pub(super) fn demands(asked: &Asked, value: &mut dyn FnMut(ValueId, u32) -> Bits) -> Vec<Demand> {
    let &Asked { circuit, cell, lane, bits } = asked;
    let same = |of: ValueId, lane: u32| vec![Demand::data(of, lane, bits.clone())];
    if let Some((of, from)) = cell.kind.source(lane) {
        return same(of, from);
    }
    match &cell.kind {
        Kind::Pick { of, axis, index } => {
            let number = at_most(&value(*index, lane), axis.count);
            let mut all = vec![Demand::control(*index, lane, mask::all(circuit[*index].width))];
            if number < axis.count {
                all.extend(same(*of, axis.at(lane, number)));
            }
            all
        }
        Kind::Reduce { by, of, axis } => reduced(*by, asked, *of, *axis, value),
        Kind::Pack { of, axis } => {
            let width = circuit[*of].width;
            let part = |number: u32| bits.slice(number * width..(number + 1) * width);
            (0..axis.count).map(|number| Demand::data(*of, axis.at(lane, number), part(number))).collect()
        }
        Kind::Unpack { of, axis } => {
            let (number, rest) = axis.split(lane);
            vec![Demand::data(*of, rest, mask::placed(bits, circuit[*of].width, number * cell.width))]
        }
        // The word itself is added where memories are known.
        Kind::Read { address, .. } => vec![Demand::control(*address, lane, mask::all(circuit[*address].width))],
        _ => unreachable!("no operation of a program across lanes: {cell:?}"),
    }
}

/// Of an AND of all lanes, for each bit that is 0 a lane in which it is, and for an OR the same with 1.
fn reduced(
    by: Reduction,
    asked: &Asked,
    of: ValueId,
    axis: Axis,
    value: &mut dyn FnMut(ValueId, u32) -> Bits,
) -> Vec<Demand> {
    let &Asked { lane, bits, .. } = asked;
    let lanes = (0..axis.count).map(|number| axis.at(lane, number));
    let each = |bits: Bits| lanes.clone().map(|lane| Demand::data(of, lane, bits.clone())).collect::<Vec<_>>();
    let deciding = match by {
        Reduction::And => 0,
        Reduction::Or => 1,
        Reduction::Xor => return each(bits.clone()),
        Reduction::Add => return each(mask::up_to_highest(bits, bits.width())),
        Reduction::Min | Reduction::Max => return each(mask::all(bits.width())),
    };
    let (mut undecided, mut all) = (bits.clone(), Vec::new());
    for lane in lanes.clone() {
        let here = value(of, lane);
        let here = mask::and(&undecided, &if deciding == 1 { here } else { here.not() });
        undecided = mask::and(&undecided, &here.not());
        all.push(Demand::data(of, lane, here));
    }
    // A bit that no lane decides is as it is because of all.
    all.iter_mut().for_each(|demand| demand.bits = mask::or(&demand.bits, &undecided));
    all
}

//! Operations on values of any width, lane by lane.

use tilewright_hdl::ir::Reduction;

use crate::engine::program::{Kind, Program, Value, ValueId};
use crate::engine::semantics::{self, Number};
use crate::limbs;

/// Computes `result` in all lanes.
pub(super) fn evaluate(program: &Program, kind: &Kind, result: ValueId, storage: &mut [u64]) {
    let value = program.value(result);
    let (before, rest) = storage.split_at_mut(value.offset);
    let out = &mut rest[..value.range().len()];
    let at = |id: ValueId, lane: usize| lane_of(program.value(id), before, lane);
    for (lane, out) in out.chunks_exact_mut(value.limbs()).enumerate() {
        match kind {
            Kind::Broadcast(of, n) => out.copy_from_slice(at(*of, lane / *n as usize)),
            Kind::Tile(of, _) => out.copy_from_slice(at(*of, lane % program.value(*of).lanes as usize)),
            Kind::PerLane(parts) => out.copy_from_slice(at(parts[lane % parts.len()], lane / parts.len())),
            Kind::Shifted { of, by, edge, group } => {
                let (outer, inner) = (lane / *group as usize, lane % *group as usize);
                match inner.checked_add_signed(-*by as isize).filter(|&from| from < *group as usize) {
                    Some(from) => out.copy_from_slice(at(*of, outer * *group as usize + from)),
                    None => out.copy_from_slice(at(*edge, outer)),
                }
            }
            Kind::Lane { of, index, group } => out.copy_from_slice(at(*of, lane * *group as usize + *index as usize)),
            Kind::Reduce { by, of, group } => {
                let group = *group as usize;
                reduce(*by, value, out, (lane * group..(lane + 1) * group).map(|from| at(*of, from)));
            }
            _ => semantics::evaluate(kind, value.width, out, |id| Number {
                limbs: at(id, lane),
                width: program.value(id).width,
            }),
        }
    }
}

fn lane_of<'a>(value: &Value, storage: &'a [u64], lane: usize) -> &'a [u64] {
    let start = value.offset + lane * value.limbs();
    &storage[start..start + value.limbs()]
}

fn reduce<'a>(by: Reduction, value: &Value, out: &mut [u64], mut lanes: impl Iterator<Item = &'a [u64]>) {
    out.copy_from_slice(lanes.next().expect("a group has a lane"));
    for lane in lanes {
        let bitwise = |combine: fn(u64, u64) -> u64, out: &mut [u64]| {
            out.iter_mut().zip(lane).for_each(|(out, lane)| *out = combine(*out, *lane));
        };
        match by {
            Reduction::And => bitwise(|a, b| a & b, out),
            Reduction::Or => bitwise(|a, b| a | b, out),
            Reduction::Xor => bitwise(|a, b| a ^ b, out),
            Reduction::Add => {
                let sum = out.to_vec();
                limbs::add(out, &sum, lane, false);
            }
        }
    }
    *out.last_mut().expect("a value has a limb") &= tilewright_hdl::top_mask(value.width);
}

//! Arrays in memory that are collected: from scalars, from shorter arrays, or from the limbs of a value.

use super::{Emitter, offset};
use crate::engine::layout::Place;
use crate::engine::program::{Kind, ValueId};

impl Emitter<'_, '_> {
    /// Stores scalars, or the lanes of shorter arrays, side by side; rows one after another; or the limbs of a value
    /// as lanes.
    pub(super) fn collect_array(&mut self, id: ValueId) {
        let place = self.addresses.of(id);
        match &self.function.cell(id).kind {
            Kind::Unpack { of, .. } => {
                self.want(*of);
                self.scalars.store(self.builder, *of, 64, self.state, offset(place.offset));
            }
            Kind::Stack { parts, inner: 1 } => {
                let lanes = self.function.cell(parts[0]).lanes;
                for (i, &part) in (0..).zip(parts) {
                    self.collect_lanes(part, lanes, place, |lane| lane * parts.len() as u32 + i);
                }
            }
            Kind::Stack { parts, inner } => {
                for (i, &part) in (0..).zip(parts) {
                    match self.addresses.has(part) {
                        true => self.copy_row(self.addresses.of(part), place, i * inner),
                        false => self.collect_lanes(part, *inner, place, |lane| i * inner + lane),
                    }
                }
            }
            _ => unreachable!("only these are collected"),
        }
    }

    /// Stores a scalar, or each lane of an array, at lane `at(i)` of a place.
    fn collect_lanes(&mut self, part: ValueId, lanes: u32, place: Place, at: impl Fn(u32) -> u32) {
        for lane in 0..lanes {
            let value = match lanes {
                1 => {
                    self.want(part);
                    part
                }
                _ => self.element(part, lane),
            };
            self.scalars.store(self.builder, value, place.integer(), self.state, offset(place.lane(at(lane))));
        }
    }

    /// Copies an array with the same element size, in whole vectors, to the lanes of another one from `first` on.
    fn copy_row(&mut self, from: Place, to: Place, first: u32) {
        let base = self.base(from);
        for at in (0..from.lanes as usize * from.bytes()).step_by(self.builder.vector_bits() as usize / 8) {
            let ty = self.builder.vector(from.integer());
            let vector = self.builder.load(ty, base, offset(from.offset + at));
            self.builder.store(vector, self.state, offset(to.lane(first) + at));
        }
    }

    /// One lane, known at compile time, of an array, as a scalar. What is stored is read: another function may have
    /// stored it, and what it repeats may have changed since.
    fn element(&mut self, of: ValueId, lane: u32) -> ValueId {
        let id = self.id();
        let is_stored = self.addresses.has(of);
        match &self.function.cell(of).kind {
            Kind::Const(bits) => self.scalars.constant(self.builder, id, bits),
            Kind::Broadcast { of: plain, .. } if !is_stored && self.function.cell(*plain).lanes == 1 => {
                self.want(*plain);
                return *plain;
            }
            Kind::Broadcast { of: row, axis } if !is_stored && axis.inner > 1 => {
                return self.element(*row, lane % axis.inner);
            }
            _ => {
                let place = self.addresses.of(of);
                let (base, at) = (self.base(place), offset(place.lane(lane)));
                self.scalars.load(self.builder, id, place.width, place.integer(), base, at);
            }
        }
        id
    }
}

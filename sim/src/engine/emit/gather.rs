//! Lanes that a strip takes from other lanes.

use super::lanes::Span;
use super::strip_values::Strip;
use super::{Emitter, offset};
use crate::engine::layout::Place;
use crate::engine::plan::access::{Access, Number};
use crate::engine::plan::clamp::Clamp;
use crate::engine::program::{Cell, Kind, ValueId};
use crate::engine::strips::{Type, Value};

impl Emitter<'_, '_> {
    /// Takes the lanes of a cell from others.
    pub(super) fn take(&mut self, strip: &mut Strip, id: ValueId, access: Access) {
        match access {
            Access::Uniform => self.singles(strip, id),
            Access::Constant(of) => {
                let Kind::Const(bits) = &self.function.cell(of).kind else { unreachable!("a constant") };
                strip.lanes.constant(id, bits);
            }
            Access::OfRow(of) => {
                let place = self.addresses.of(of);
                let address = self.address(place, strip.within.expect("it has begun"));
                // Its own strips have other sizes.
                let aligned = (strip.size() * place.element).is_multiple_of(self.builder.vector_bits());
                self.load_span(strip, id, address, place, 0, aligned);
            }
            Access::Near(of, by) => {
                let place = self.addresses.of(of);
                let address = self.strip_address(strip, place);
                self.load_span(strip, id, address, place, by, false);
            }
            Access::Groups(of, times) => self.repeat_lanes(strip, id, of, times),
            Access::Regular { of, lanes, step } => self.gather_regular(strip, id, of, &lanes, step),
            Access::Each(of, number, clamp) => self.each(strip, id, (of, number), clamp),
            Access::Words(word) => self.read_together(strip, id, word),
            Access::EachWord(word) => self.read_each(strip, id, word),
            Access::WordOf(word, from, clamp) => self.read_of(strip, id, word, (from, clamp)),
        }
    }

    /// Loads adjacent lanes, `by` lanes before those at an address.
    fn load_span(&mut self, strip: &mut Strip, id: ValueId, address: Value, place: Place, by: i32, aligned: bool) {
        let offset = offset(place.offset) - by * place.bytes() as i32;
        let side = Span { storage: place.element, address, offset, aligned };
        strip.lanes.load(self.builder, id, self.function.cell(id).width, side);
    }

    /// Loads a lane for each lane of the strip.
    fn each(&mut self, strip: &mut Strip, id: ValueId, (of, number): (ValueId, Number), clamp: Clamp) {
        let total = strip.division.lanes;
        match number {
            Number::Group(group) => self.collect(strip, id, of, |emitter, lane| emitter.divided(lane, total, group).0),
            Number::Within(group) => self.collect(strip, id, of, |emitter, lane| emitter.divided(lane, total, group).1),
            Number::Member { group, index } => self.collect(strip, id, of, |emitter, lane| {
                let start = emitter.scaled(lane, group as usize);
                emitter.builder.add_constant(start, i64::from(index))
            }),
            Number::Before(by) => self.collect(strip, id, of, |emitter, lane| {
                let from = emitter.builder.add_constant(lane, -i64::from(by));
                emitter.clamped(from, lane, clamp)
            }),
            Number::Given(at) => {
                let numbers = (0..strip.size()).map(|lane| self.lane_number(strip, at, lane, clamp));
                let mut numbers = numbers.collect::<Vec<Value>>().into_iter();
                self.collect(strip, id, of, |_, _| numbers.next().expect("a number for each lane"));
            }
        }
    }

    /// The number of a lane, or what takes its place; `own` is that of the lane which asks.
    pub(super) fn clamped(&mut self, number: Value, own: Value, clamp: Clamp) -> Value {
        let most = match clamp {
            Clamp::None => return number,
            Clamp::Last(last) => self.builder.constant(Type::I64, i64::from(last)),
            Clamp::Own => own,
        };
        self.builder.min(number, most)
    }

    /// Loads one lane of `of` by number for each lane of the strip.
    fn collect(
        &mut self,
        strip: &mut Strip,
        id: ValueId,
        of: ValueId,
        mut from: impl FnMut(&mut Self, Value) -> Value,
    ) {
        let width = self.function.cell(id).width;
        for lane in 0..strip.size() {
            let at = self.existing(strip, lane);
            let from = from(self, at);
            let mut single = std::mem::take(&mut self.scalars);
            self.load_lane(id, of, from);
            std::mem::swap(&mut single, &mut self.scalars);
            strip.singles[lane as usize].define(id, single.get(id).expect("it was loaded").clone());
        }
        if width <= 64 {
            self.vector(strip, id);
        }
    }

    /// The number of a lane of the strip, or of the last existing lane.
    pub(super) fn existing(&mut self, strip: &Strip, lane: u32) -> Value {
        let at = self.builder.add_constant(strip.first.expect("it has begun"), i64::from(lane));
        self.clamped(at, at, Clamp::of_strip(strip.division))
    }

    /// Loads the lanes that are each repeated in the strip.
    pub(super) fn repeat_lanes(&mut self, strip: &mut Strip, id: ValueId, of: ValueId, times: u32) {
        let (first, _) = self.divided(strip.first.expect("it has begun"), strip.division.lanes, times);
        let mut single = std::mem::take(&mut self.scalars);
        for group in 0..strip.size() / times {
            // Padding lanes may load what follows the last lane.
            let lane = self.builder.add_constant(first, i64::from(group));
            self.load_lane(id, of, lane);
            let loaded = self.scalars.get(id).expect("it was loaded").clone();
            let lanes = (group * times) as usize..((group + 1) * times) as usize;
            strip.singles[lanes].iter_mut().for_each(|single| single.define(id, loaded.clone()));
        }
        std::mem::swap(&mut single, &mut self.scalars);
        if self.function.cell(id).width <= 64 {
            self.vector(strip, id);
        }
    }

    /// Loads the strip of a row that has several strips.
    pub(super) fn tile_whole(&mut self, strip: &mut Strip, id: ValueId) {
        let of = self.source(id);
        let Cell { lanes, width, .. } = *self.function.cell(of);
        let row: Vec<Value> = (0..lanes)
            .map(|lane| {
                let (lane, loaded) = (self.builder.constant(Type::I64, i64::from(lane)), self.id());
                self.load_lane(loaded, of, lane);
                self.scalars.clean(self.builder, loaded)[0]
            })
            .collect();
        let all: Vec<Value> = row.iter().copied().cycle().take(strip.size() as usize).collect();
        strip.lanes.gather(self.builder, id, width, &all);
    }

    /// The number in a lane of `at`, kept among those that exist.
    pub(super) fn lane_number(&mut self, strip: &mut Strip, at: ValueId, lane: u32, clamp: Clamp) -> Value {
        let number = if self.function.is_table(at) {
            self.singles(strip, at);
            strip.singles[lane as usize].clean(self.builder, at)[0]
        } else {
            self.limbs(strip, at, lane)[0]
        };
        self.clamped(number, number, clamp)
    }

    /// Loads these lanes for the first strip, and lanes `step` further on for each following one.
    fn gather_regular(&mut self, strip: &mut Strip, id: ValueId, of: ValueId, lanes: &[u32], step: u32) {
        let (number, _) = self.divided(strip.first.expect("it has begun"), strip.division.lanes, strip.size());
        let (place, before) = (self.addresses.of(of), self.scaled(number, step as usize));
        let address = self.address(place, before);
        let of_vectors = lanes.chunks((self.builder.vector_bits() / place.integer()) as usize);
        let are_together = of_vectors.clone().all(|lanes| lanes.windows(2).all(|pair| pair[0] + 1 == pair[1]));
        if place.width <= 64 && strip.lanes.element(place.width) == place.element && are_together {
            let offsets: Vec<i32> = of_vectors.map(|lanes| offset(place.lane(lanes[0]))).collect();
            return strip.lanes.load_parts(self.builder, id, place.width, address, &offsets);
        }
        for (single, &lane) in strip.singles.iter_mut().zip(lanes) {
            single.load(self.builder, id, place.width, place.integer(), address, offset(place.lane(lane)));
        }
        if place.width <= 64 {
            self.vector(strip, id);
        }
    }
}

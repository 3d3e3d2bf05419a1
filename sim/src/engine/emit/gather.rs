//! Lanes that a strip takes from other lanes.

use super::strip_values::Strip;
use crate::engine::emit::{Emitter, offset};
use crate::engine::program::{Cell, Kind, ValueId};
use crate::engine::strips::{Type, Value};

impl Emitter<'_, '_> {
    /// Loads the lanes that are each repeated in the strip.
    pub(super) fn repeat_lanes(&mut self, strip: &mut Strip, id: ValueId, of: ValueId, times: u32) {
        let (first, _) = self.divided(strip.first.expect("it has begun"), strip.total, times);
        let mut single = std::mem::take(&mut self.scalars);
        for group in 0..strip.size / times {
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
        let all: Vec<Value> = row.iter().copied().cycle().take(strip.size as usize).collect();
        strip.lanes.gather(self.builder, id, width, &all);
    }

    /// Loads, for each lane of the strip, the lane of `of` with the number in `at`.
    pub(super) fn gather(&mut self, strip: &mut Strip, id: ValueId, of: ValueId, at: ValueId) {
        if self.addresses.has(of)
            && let Some((lanes, step)) = self.regular(strip, at)
        {
            return self.gather_regular(strip, id, of, &lanes, step);
        }
        let numbers: Vec<Value> = (0..strip.size).map(|lane| self.lane_number(strip, at, lane, of)).collect();
        let mut numbers = numbers.into_iter();
        self.collect(strip, id, of, |_, _| numbers.next().expect("a number for each lane"));
    }

    /// The number in a lane of `at`, of a lane of `of`.
    fn lane_number(&mut self, strip: &mut Strip, at: ValueId, lane: u32, of: ValueId) -> Value {
        if self.function.is_table(at) && !strip.lanes.has(at) {
            // All numbers of a table are known to be numbers of lanes.
            self.singles(strip, at);
            return strip.singles[lane as usize].clean(self.builder, at)[0];
        }
        let number = self.limbs(strip, at, lane)[0];
        self.of_lanes(number, self.function.cell(at).width, self.function.cell(of).lanes)
    }

    /// The numbers of a table for the first strip, and the step from each strip to the next, if it is constant.
    fn regular(&self, strip: &Strip, at: ValueId) -> Option<(Vec<u32>, u32)> {
        let Kind::Stack { parts, inner: 1 } = &self.function.cell(at).kind else { return None };
        let number = |part: &ValueId| Some(self.function.circuit().constant(*part)?.limbs()[0] as u32);
        let all = parts.iter().map(number).collect::<Option<Vec<u32>>>()?;
        let (first, rest) = all.split_at_checked(strip.size as usize)?;
        let step = rest.first().map_or(Some(0), |next| next.checked_sub(first[0]))?;
        let is_regular = all.iter().zip(rest).all(|(before, after)| before + step == *after);
        let is_whole = parts.len() == strip.total as usize && !strip.is_padded();
        (is_regular && is_whole).then(|| (first.to_vec(), step))
    }

    /// Loads these lanes for the first strip, and lanes `step` further on for each following one.
    fn gather_regular(&mut self, strip: &mut Strip, id: ValueId, of: ValueId, lanes: &[u32], step: u32) {
        let (number, _) = self.divided(strip.first.expect("it has begun"), strip.total, strip.size);
        let (place, before) = (self.addresses.of(of), self.scaled(number, step as usize));
        let address = self.address(place, before);
        let of_vectors = lanes.chunks(128 / place.integer() as usize);
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

//! The values of one strip of lanes: up to 64 bits in vectors; wider ones, and those computed with them, lane by
//! lane.

use std::collections::{BTreeMap, HashMap};

use tilewright_circuit::ir::Reduction;

use super::lanes::{Lanes, Span, operator};
use super::scalar::{Scalar, Scalars};
use super::{Emitter, offset};
use crate::engine::layout::Place;
use crate::engine::plan::access::{Access, Word};
use crate::engine::plan::clamp::Clamp;
use crate::engine::plan::nest::{Division, Nest};
use crate::engine::program::{Kind, ValueId};
use crate::engine::strips::{Comparison, Type, Value};

/// A strip while its code is emitted.
#[derive(Debug)]
pub(super) struct Strip {
    pub division: Division,
    /// From the last lanes to the first.
    descends: bool,
    /// How it takes lanes from other lanes.
    taken: BTreeMap<ValueId, Access>,
    pub lanes: Lanes,
    /// The values lane by lane.
    pub(super) singles: Vec<Scalars>,
    /// The first lane, and the first lane within the row.
    pub first: Option<Value>,
    pub within: Option<Value>,
    /// The state's address plus the first lane's distance, for each lane size in bytes and whether places move; a
    /// place's offset is added to it.
    addresses: HashMap<(usize, bool), Value>,
    /// The first lane's words, by the address of their memory.
    pub memories: HashMap<usize, Value>,
    /// The words of all lanes, by memory and address, and that address.
    pub words: HashMap<Word, (Value, Value)>,
}

impl Strip {
    /// The strips of these loops, in vectors of so many bits.
    pub fn new(nest: &Nest, vector: u32) -> Strip {
        let &Nest { division, descends, .. } = nest;
        let singles = Vec::new();
        let (addresses, memories, words) = (HashMap::new(), HashMap::new(), HashMap::new());
        let lanes = Lanes::new(division.strip, vector);
        Strip {
            division,
            descends,
            taken: nest.taken.clone(),
            lanes,
            singles,
            first: None,
            within: None,
            addresses,
            memories,
            words,
        }
    }

    /// Lanes at a time.
    pub fn size(&self) -> u32 {
        self.division.strip
    }

    /// Defines a value in one lane.
    pub fn define_single(&mut self, lane: u32, id: ValueId, scalar: Scalar) {
        self.singles[lane as usize].define(id, scalar);
    }

    /// The values lane by lane, to be restored after the branch that uses them.
    pub fn save(&self) -> Vec<Scalars> {
        self.singles.clone()
    }

    /// Restores the result of [`Strip::save`].
    pub fn restore(&mut self, singles: Vec<Scalars>) {
        self.singles = singles;
    }
}

impl Emitter<'_, '_> {
    /// Begins the strip at offset `within` of the row that starts at `start`.
    pub(super) fn enter(&mut self, strip: &mut Strip, start: Option<Value>, within: Value) {
        strip.singles = vec![Scalars::default(); strip.size() as usize];
        strip.addresses.clear();
        strip.memories.clear();
        strip.within = Some(within);
        strip.first = Some(match start {
            None => within,
            Some(start) => self.builder.add(start, within),
        });
    }

    /// The state's address plus a lane's distance at a place, whose offset is added to it.
    pub(super) fn address(&mut self, place: Place, lane: Value) -> Value {
        let by = self.scaled(lane, place.bytes());
        let base = self.base(place);
        self.builder.add(base, by)
    }

    /// A number times a constant.
    pub(super) fn scaled(&mut self, number: Value, by: usize) -> Value {
        match by {
            1 => number,
            _ if by.is_power_of_two() => {
                let by = self.builder.constant(Type::I64, i64::from(by.ilog2()));
                self.builder.shl(number, by)
            }
            _ => {
                let by = self.builder.constant(Type::I64, by as i64);
                self.builder.mul(number, by)
            }
        }
    }

    /// The address of a strip's first lane, without the offset.
    pub(super) fn strip_address(&mut self, strip: &mut Strip, place: Place) -> Value {
        let key = (place.bytes(), place.moves);
        if let Some(address) = strip.addresses.get(&key) {
            return *address;
        }
        let address = self.address(place, strip.first.expect("it has begun"));
        strip.addresses.insert(key, address);
        address
    }

    fn side(&mut self, strip: &mut Strip, place: Place) -> Span {
        let address = self.strip_address(strip, place);
        Span { storage: place.element, address, offset: offset(place.offset), aligned: true }
    }

    /// Makes an operand available as a vector.
    pub(super) fn vector(&mut self, strip: &mut Strip, id: ValueId) {
        if strip.lanes.has(id) {
            return;
        }
        let cell = self.function.cell(id);
        if strip.singles[0].get(id).is_some() {
            let singles = strip.singles.iter_mut();
            let lanes: Vec<Value> = singles.map(|single| single.clean(self.builder, id)[0]).collect();
            strip.lanes.gather(self.builder, id, cell.width, &lanes);
            return;
        }
        match &cell.kind {
            Kind::Const(bits) => strip.lanes.constant(id, bits),
            // Its source may have changed since another loop stored it.
            Kind::Broadcast { .. } if !self.addresses.has(id) => self.lane_cell(strip, id),
            _ => {
                let side = self.side(strip, self.addresses.of(id));
                strip.lanes.load(self.builder, id, cell.width, side);
            }
        }
    }

    /// Makes an operand available lane by lane.
    pub(super) fn singles(&mut self, strip: &mut Strip, id: ValueId) {
        if strip.singles[0].get(id).is_some() {
            return;
        }
        let cell = self.function.cell(id);
        // Numbers of a table are read one by one: the bounds of a vector are its bits, which allow more than the table has.
        let is_taken = strip.lanes.has(id) && !self.function.is_table(id);
        for lane in 0..strip.size() {
            if is_taken {
                let clean = strip.lanes.extract(self.builder, id, lane);
                strip.singles[lane as usize].define(id, Scalar::clean(cell.width, clean));
                continue;
            }
            match &cell.kind {
                Kind::Const(bits) => strip.singles[lane as usize].constant(self.builder, id, bits),
                Kind::Broadcast { of, .. } if self.function.cell(*of).lanes == 1 => {
                    let uniform = self.scalars.get(*of).expect("it was made available before the loop").clone();
                    strip.singles[lane as usize].define(id, uniform);
                }
                Kind::Broadcast { .. } if !self.addresses.has(id) => {
                    self.lane_cell(strip, id);
                    return self.singles(strip, id);
                }
                _ => {
                    let place = self.addresses.of(id);
                    let at = self.strip_address(strip, place);
                    let offset = offset(place.lane(lane));
                    let single = &mut strip.singles[lane as usize];
                    single.load(self.builder, id, place.width, place.integer(), at, offset);
                }
            }
        }
    }

    /// Makes an operand available in the form for its width.
    pub(super) fn available(&mut self, strip: &mut Strip, id: ValueId) {
        if self.function.cell(id).width <= 64 { self.vector(strip, id) } else { self.singles(strip, id) }
    }

    /// An operand's clean limbs in one lane; it has up to [`LONGEST`](super::scalar::LONGEST) bits.
    pub(super) fn limbs(&mut self, strip: &mut Strip, id: ValueId, lane: u32) -> Vec<Value> {
        if self.function.cell(id).width <= 64 {
            self.vector(strip, id);
            return vec![strip.lanes.extract(self.builder, id, lane)];
        }
        self.singles(strip, id);
        strip.singles[lane as usize].clean(self.builder, id)
    }

    /// Stores a value of more than [`LONGEST`](super::scalar::LONGEST) bits in one lane.
    pub(super) fn store_long(&mut self, strip: &mut Strip, id: ValueId, lane: u32, at: Value, offset: i32) {
        self.singles(strip, id);
        strip.singles[lane as usize].store(self.builder, id, 64, at, offset);
    }

    /// Stores the lanes of a value.
    pub(super) fn store_lanes(&mut self, strip: &mut Strip, id: ValueId, place: Place) {
        if place.width <= 64 {
            self.vector(strip, id);
            let side = self.side(strip, place);
            strip.lanes.store(self.builder, id, side);
            return;
        }
        self.singles(strip, id);
        let at = self.strip_address(strip, place);
        for lane in 0..strip.size() {
            let offset = offset(place.lane(lane));
            strip.singles[lane as usize].store(self.builder, id, 64, at, offset);
        }
    }

    /// Computes an elementwise operation.
    pub(super) fn elementwise(&mut self, strip: &mut Strip, id: ValueId, kind: &Kind, width: u32) {
        let mut is_narrow = width <= 64;
        kind.for_each_operand(|operand| is_narrow &= self.function.cell(operand).width <= 64);
        if is_narrow {
            kind.for_each_operand(|operand| self.vector(strip, operand));
            strip.lanes.evaluate(self.builder, id, kind, width);
            return;
        }
        kind.for_each_operand(|operand| self.singles(strip, operand));
        for single in &mut strip.singles {
            single.evaluate(self.builder, id, kind, width);
        }
        if width <= 64 {
            let singles = strip.singles.iter_mut();
            let lanes: Vec<Value> = singles.map(|single| single.clean(self.builder, id)[0]).collect();
            strip.lanes.gather(self.builder, id, width, &lanes);
        }
    }

    /// Computes a cell of a kernel.
    pub(super) fn lane_cell(&mut self, strip: &mut Strip, id: ValueId) {
        let cell = self.function.cell(id);
        match &cell.kind {
            // Made available before the loop.
            Kind::Broadcast { .. } if strip.lanes.has(id) => {}
            Kind::Reduce { by, of, axis } => return self.accumulate(strip, id, *by, *of, axis.count),
            kind => match strip.taken.get(&id).cloned() {
                Some(access) => self.take(strip, id, access),
                None => self.elementwise(strip, id, kind, cell.width),
            },
        }
        if self.plan.live_out.contains(&id) {
            self.store_lanes(strip, id, self.addresses.of(id));
        }
    }

    /// Combines a strip's lanes, one by one, into the groups' results in memory.
    fn accumulate(&mut self, strip: &mut Strip, id: ValueId, by: Reduction, of: ValueId, group: u32) {
        self.singles(strip, of);
        let (place, width) = (self.addresses.of(id), self.function.cell(id).width);
        for number in 0..strip.size() {
            let lane = if strip.descends { strip.size() - 1 - number } else { number };
            let at = self.builder.add_constant(strip.first.expect("it has begun"), i64::from(lane));
            // With one group, padding lanes add nothing to it.
            let (target, within) = match group == strip.division.lanes {
                true => (self.builder.constant(Type::I64, 0), at),
                false => {
                    let (target, within) = self.divided(at, strip.division.lanes, group);
                    let clamp = Clamp::of_group(strip.division, place.lanes);
                    (self.clamped(target, target, clamp), within)
                }
            };
            let at = self.address(place, target);
            let (before, both, first, all) = (self.id(), self.id(), self.id(), self.id());
            let first_within = if strip.descends { i64::from(group) - 1 } else { 0 };
            let first_within = self.builder.constant(Type::I64, first_within);
            let is_first = self.builder.compare(Comparison::Equal, within, first_within);
            let single = &mut strip.singles[lane as usize];
            let b = &mut *self.builder;
            single.load(b, before, width, place.integer(), at, offset(place.offset));
            single.evaluate(b, both, &Kind::Binary(operator(by), before, of), width);
            single.define_flag(first, is_first);
            single.evaluate(b, all, &Kind::Mux { select: first, on_true: of, on_false: both }, width);
            single.store(b, all, place.integer(), at, offset(place.offset));
        }
    }

    /// The group of a lane in an array of `total` lanes, and its index there.
    pub(super) fn divided(&mut self, lane: Value, total: u32, group: u32) -> (Value, Value) {
        // By a reciprocal, which is exact for lanes below 2 to the 20 in groups below that.
        const SHIFT: u32 = 40;
        let quotient = if group.is_power_of_two() {
            let by = self.builder.constant(Type::I64, i64::from(group.ilog2()));
            self.builder.shr(lane, by)
        } else if total < 1 << 19 {
            let reciprocal = (1u64 << SHIFT) / u64::from(group) + 1;
            let scaled = self.builder.mul_constant(lane, reciprocal as i64);
            let by = self.builder.constant(Type::I64, i64::from(SHIFT));
            self.builder.shr(scaled, by)
        } else {
            let group = self.builder.constant(Type::I64, i64::from(group));
            self.builder.div(lane, group)
        };
        let start = self.builder.mul_constant(quotient, i64::from(group));
        (quotient, self.builder.sub(lane, start))
    }
}

//! From a planned function to its strip program.

mod addresses;
mod gather;
pub(super) mod kernel;
pub(super) mod lanes;
pub(super) mod memory;
pub(super) mod scalar;
pub(super) mod strip_values;
pub(super) mod together;
pub(super) mod versions;

use crate::engine::function::{Function, Sink};
use crate::engine::layout::Place;
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::plan::Plan;
use crate::engine::plan::clamp::Clamp;
use crate::engine::plan::sequence::Step;
use crate::engine::program::{Kind, Lowered, ValueId};
use crate::engine::strips::{Builder, Comparison, Loop, Type, Value};
pub(crate) use addresses::Addresses;
use scalar::{Scalar, Scalars};
use versions::TableAt;

/// Emits a function.
pub(super) struct Emitter<'a, 'b> {
    pub(super) function: &'a Function,
    pub(super) plan: &'a Plan,
    pub(super) addresses: &'a Addresses,
    pub(super) memories: &'a [MemoryAt],
    pub(super) strips: &'a StripSizes,
    pub(super) builder: &'b mut Builder,
    pub(super) state: Value,
    /// The distance of the present unit's state from that of the first one.
    unit: Value,
    /// The place where code notes a write to a memory, if it does.
    wrote: Option<usize>,
    /// For each loop that may get versions, the table in which to look them up, if any.
    pub(super) versions: &'a [TableAt],
    /// Values of one lane.
    pub(super) scalars: Scalars,
    /// The next id that no cell has.
    fresh: u32,
    /// The scalar registers that have changed, each with its new value.
    changed: Vec<(ValueId, ValueId)>,
}

impl<'a, 'b> Emitter<'a, 'b> {
    pub fn new(
        function: &'a Function,
        plan: &'a Plan,
        addresses: &'a Addresses,
        memories: &'a [MemoryAt],
        strips: &'a StripSizes,
        builder: &'b mut Builder,
        state: Value,
    ) -> Self {
        let fresh = function.circuit().len() as u32;
        let (scalars, changed) = (Scalars::default(), Vec::new());
        let (unit, wrote, versions) = (state, None, [].as_slice());
        Emitter {
            function,
            plan,
            addresses,
            memories,
            strips,
            builder,
            state,
            unit,
            wrote,
            versions,
            scalars,
            fresh,
            changed,
        }
    }

    /// Looks versions of loops up there.
    pub fn with_versions(mut self, versions: &'a [TableAt]) -> Self {
        self.versions = versions;
        self
    }

    /// Sets the address of the unit to which the code belongs, and `wrote`, where it notes a write to a memory.
    pub fn of_unit(mut self, unit: Value, wrote: usize) -> Self {
        (self.unit, self.wrote) = (unit, Some(wrote));
        self
    }

    /// The base address for the offset of a place.
    pub(super) fn base(&self, place: Place) -> Value {
        if place.moves { self.unit } else { self.state }
    }

    /// The address of a memory.
    pub(super) fn memory_base(&mut self, memory: MemoryAt) -> Value {
        match memory.table {
            None => self.builder.address(memory.address),
            Some(at) => self.builder.load(Type::I64, self.unit, offset(at)),
        }
    }

    /// Notes a write to a memory.
    pub(super) fn note_write(&mut self) {
        if let Some(at) = self.wrote {
            let one = self.builder.constant(Type::I64, 1);
            self.builder.store(one, self.state, offset(at));
        }
    }

    /// The registers of up to 64 bits that have changed, in machine registers: later code need not wait for their
    /// memory.
    pub fn changed(&self) -> Vec<(ValueId, Scalar)> {
        let scalar = |&(state, value): &(ValueId, ValueId)| Some((state, self.scalars.get(value)?.clone()));
        self.changed.iter().filter_map(scalar).filter(|(_, scalar)| scalar.width <= 64).collect()
    }

    /// Emits these steps.
    pub fn steps(&mut self, steps: &[Step]) {
        let plan = self.plan;
        for &step in steps {
            match step {
                Step::Single(id) => {
                    self.single(id);
                    if plan.live_out.contains(&id) {
                        let place = self.addresses.of(id);
                        self.store_single(id, place, self.state, place.offset);
                    }
                }
                Step::Collect(id) => self.collect_array(id),
                Step::Kernel(stage, lanes) => self.kernel(lanes, &plan.stages[stage].kernels[&lanes]),
                Step::Sink(index) => self.sink(index),
            }
        }
    }

    /// Ends a function: late arrays change. Returns the condition of the assertions, if there are any.
    pub fn end(&mut self) -> Option<Value> {
        for (state, waiting) in &self.addresses.waiting {
            let place = self.addresses.of(*state);
            self.copy(*waiting, place);
        }
        let held = self.function.sinks.iter().find_map(|sink| match sink {
            Sink::ContinueIf(value) => Some(*value),
            _ => None,
        });
        held.map(|value| {
            self.want(value);
            self.scalars.flag(self.builder, value)
        })
    }

    /// An id for a value that is not a cell.
    pub(super) fn id(&mut self) -> ValueId {
        self.fresh += 1;
        ValueId(self.fresh - 1)
    }

    /// Makes a value of one lane available to later code.
    pub(super) fn want(&mut self, id: ValueId) {
        if self.scalars.get(id).is_some() {
            return;
        }
        match &self.function.cell(id).kind {
            Kind::Const(bits) => self.scalars.constant(self.builder, id, bits),
            _ => {
                let place = self.addresses.of(id);
                let base = self.base(place);
                self.scalars.load(self.builder, id, place.width, place.integer(), base, offset(place.offset));
            }
        }
    }

    fn single(&mut self, id: ValueId) {
        let cell = self.function.cell(id);
        match &cell.kind {
            Kind::Lowered(Lowered::Word { memory, address }) => {
                self.want(*address);
                self.read(id, *memory, *address);
            }
            Kind::Lane { of, index, .. } => {
                if let Kind::Const(bits) = &self.function.cell(*of).kind {
                    return self.scalars.constant(self.builder, id, bits);
                }
                let place = self.addresses.of(*of);
                let (base, at) = (self.base(place), offset(place.lane(*index)));
                self.scalars.load(self.builder, id, place.width, place.integer(), base, at);
            }
            // Its limbs are the lanes.
            Kind::Pack { of, .. } => {
                let place = self.addresses.of(*of);
                let base = self.base(place);
                self.scalars.load(self.builder, id, cell.width, 64, base, offset(place.offset));
            }
            Kind::Lowered(Lowered::Gather { of, at }) => {
                self.want(*at);
                let number = self.scalars.clean(self.builder, *at)[0];
                let clamp = Clamp::of_numbers(self.function, *at, self.function.cell(*of).lanes);
                let number = self.clamped(number, number, clamp);
                self.load_lane(id, *of, number);
            }
            Kind::Lowered(Lowered::Rotate { of, left }) => {
                self.want(*of);
                self.scalars.rotate(self.builder, id, *of, *left);
            }
            kind => {
                kind.for_each_operand(|operand| self.want(operand));
                self.scalars.evaluate(self.builder, id, kind, cell.width);
            }
        }
    }

    /// Executes a sink of scalars.
    fn sink(&mut self, index: usize) {
        let function = self.function;
        let sink = &function.sinks[index];
        sink.for_each_operand(|operand| self.want(operand));
        match *sink {
            Sink::Register { state, next, enable } => {
                let value = match enable {
                    None => next,
                    Some(select) => {
                        self.want(state);
                        let value = self.id();
                        let kind = Kind::Mux { select, on_true: next, on_false: state };
                        self.scalars.evaluate(self.builder, value, &kind, function.cell(state).width);
                        value
                    }
                };
                let place = self.addresses.of(state);
                self.store_single(value, place, self.base(place), place.offset);
                self.changed.push((state, value));
            }
            Sink::Write { memory, enable, address, data } => self.write(memory, enable, address, data),
            Sink::Row { row, at, value } => {
                let row = self.scalars.clean(self.builder, row)[0];
                self.scalars.store(self.builder, value, 64, row, offset(8 * at));
            }
            // It is stored where it is computed.
            Sink::Show(_) | Sink::ContinueIf(_) => {}
        }
    }

    /// Loads the lane with this number of an array in memory.
    pub(super) fn load_lane(&mut self, id: ValueId, of: ValueId, lane: Value) {
        if let Kind::Const(bits) = &self.function.cell(of).kind {
            return self.scalars.constant(self.builder, id, bits);
        }
        let place = self.addresses.of(of);
        let at = self.address(place, lane);
        self.scalars.load(self.builder, id, place.width, place.integer(), at, offset(place.offset));
    }

    /// Stores a scalar.
    pub(super) fn store_single(&mut self, id: ValueId, place: Place, at: Value, bytes: usize) {
        self.scalars.store(self.builder, id, place.integer(), at, offset(bytes));
    }

    /// Copies an array, by vectors.
    fn copy(&mut self, from: Place, to: Place) {
        let size = self.builder.vector_bits() as usize / 8;
        let bytes = (from.lanes as usize * from.bytes()).next_multiple_of(size);
        let count = Count { limit: bytes as i64, step: size as i64, descends: false };
        self.count(count, &[], |emitter, at, _| {
            let [source, target] = [from, to].map(|place| {
                let base = emitter.base(place);
                emitter.builder.add(base, at)
            });
            let ty = emitter.builder.vector(from.integer());
            let vector = emitter.builder.load(ty, source, offset(from.offset));
            emitter.builder.store(vector, target, offset(to.offset));
            Vec::new()
        });
    }

    /// A loop: `body` gets each number of the count and its own result for the previous one, at first `start`.
    /// Returns the last result.
    pub(super) fn count(
        &mut self,
        count: Count,
        start: &[Value],
        body: impl FnOnce(&mut Self, Value, Vec<Value>) -> Vec<Value>,
    ) -> Vec<Value> {
        let start: Vec<Value> = [count.start(self.builder)].iter().chain(start).copied().collect();
        let types: Vec<Type> = start.iter().map(|value| self.builder.type_of(*value)).collect();
        let parameters: Vec<Value> = types.into_iter().map(|ty| self.builder.parameter(ty)).collect();
        self.builder.open();
        let carried = body(self, parameters[0], parameters[1..].to_vec());
        let (next, more) = count.next(self.builder, parameters[0]);
        let next = [next].iter().chain(&carried).copied().collect();
        let (body, again) = (self.builder.close(), Some((more, next)));
        self.builder.repeat(Loop { parameters, start, body, again, end: Vec::new(), results: Vec::new() });
        carried
    }
}

/// The numbers 0, `step`, `2 * step` and so on below `limit`, or the same in reverse.
#[derive(Debug, Clone, Copy)]
pub(super) struct Count {
    pub limit: i64,
    pub step: i64,
    pub descends: bool,
}

impl Count {
    /// The first number.
    pub fn start(self, b: &mut Builder) -> Value {
        let last = (self.limit - 1) / self.step * self.step;
        b.constant(Type::I64, if self.descends { last } else { 0 })
    }

    /// The number after one, and whether there is one.
    pub fn next(self, b: &mut Builder, at: Value) -> (Value, Value) {
        if self.descends {
            return (b.add_constant(at, -self.step), at);
        }
        let next = b.add_constant(at, self.step);
        let limit = b.constant(Type::I64, self.limit);
        (next, b.compare(Comparison::UnsignedLessThan, next, limit))
    }
}

/// An offset in the form that instructions take.
pub(super) fn offset(bytes: usize) -> i32 {
    i32::try_from(bytes).expect("the state of a circuit is smaller than 2 GB; memories are apart from it")
}

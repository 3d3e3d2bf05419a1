//! Loops over lanes, one lane at a time.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{InstBuilder, Value, types};

use super::function::{Emitter, combining, offset};
use super::graph::Sink;
use super::layout::Place;
use super::plan::Kernel;
use super::scalar::Scalars;
use crate::program::{Kind, ValueId};

impl Emitter<'_, '_, '_> {
    /// Runs a kernel.
    pub(super) fn kernel(&mut self, lanes: u32, kernel: &Kernel) {
        self.want_uniforms(kernel);
        let outer = std::mem::take(&mut self.scalars);
        self.count(i64::from(lanes), 1, |emitter, lane| {
            kernel.cells.iter().for_each(|&id| emitter.lane_cell(&outer, id, lane));
            emitter.lane_sinks(&outer, kernel, lane);
        });
        self.scalars = outer;
    }

    /// Makes the single values that a kernel takes in all lanes available.
    fn want_uniforms(&mut self, kernel: &Kernel) {
        let graph = self.graph;
        let mut plain = Vec::new();
        let mut visit = |operand: ValueId| match graph.cell(operand).kind {
            Kind::Broadcast(of, _) if graph.cell(of).lanes == 1 => plain.push(of),
            _ if graph.cell(operand).lanes == 1 => plain.push(operand),
            _ => {}
        };
        kernel.cells.iter().for_each(|&id| graph.cell(id).kind.for_each_operand(&mut visit));
        kernel.sinks.iter().for_each(|&sink| graph.sinks[sink].for_each_operand(&mut visit));
        plain.into_iter().for_each(|id| self.want(id));
    }

    /// Makes an operand available in this lane.
    fn want_lane(&mut self, outer: &Scalars, id: ValueId, lane: Value) {
        if self.scalars.get(id).is_some() {
            return;
        }
        match &self.graph.cell(id).kind {
            Kind::Const(bits) => self.scalars.constant(self.builder, id, bits),
            Kind::Broadcast(of, _) if self.graph.cell(*of).lanes == 1 => {
                let uniform = outer.get(*of).expect("it was made available before the loop").clone();
                self.scalars.define(id, uniform);
            }
            _ => self.load_lane(id, id, lane),
        }
    }

    /// Loads a lane, by its number, of an array in memory.
    fn load_lane(&mut self, id: ValueId, of: ValueId, lane: Value) {
        if let Kind::Const(bits) = &self.graph.cell(of).kind {
            return self.scalars.constant(self.builder, id, bits);
        }
        let place = self.addresses.of(of);
        let at = self.address(lane, place);
        self.scalars.load(self.builder, id, place.width, place.element.min(64), at, offset(place.offset));
    }

    /// The address of the state plus that of a lane within an array.
    fn address(&mut self, lane: Value, place: Place) -> Value {
        let bytes = self.builder.ins().iconst(types::I64, place.bytes() as i64);
        let within = self.builder.ins().imul(lane, bytes);
        self.builder.ins().iadd(self.state, within)
    }

    fn store_lane(&mut self, id: ValueId, place: Place, lane: Value) {
        let at = self.address(lane, place);
        self.scalars.store(self.builder, id, place.element.min(64), at, offset(place.offset));
    }

    fn lane_cell(&mut self, outer: &Scalars, id: ValueId, lane: Value) {
        let cell = self.graph.cell(id);
        match &cell.kind {
            Kind::Read { memory, address } => {
                self.want_lane(outer, *address, lane);
                let at = self.scalars.clean(self.builder, *address);
                let base = self.lane_base(*memory, lane);
                self.read(id, *memory, &at, base);
            }
            Kind::Broadcast(of, _) if self.graph.cell(*of).lanes == 1 => {
                let uniform = outer.get(*of).expect("it was made available before the loop").clone();
                self.scalars.define(id, uniform);
            }
            Kind::Broadcast(of, n) => {
                let lane = self.divided(lane, *n).0;
                self.load_lane(id, *of, lane);
            }
            Kind::Lane { of, index, group } => {
                let start = self.times(lane, *group);
                let index = self.builder.ins().iconst(types::I64, i64::from(*index));
                let from = self.builder.ins().iadd(start, index);
                self.load_lane(id, *of, from);
            }
            Kind::Shifted { of, by, edge, group } => self.shifted(outer, id, *of, *by, *edge, *group, lane),
            Kind::Reduce { by, of, group } => {
                self.want_lane(outer, *of, lane);
                let (target, within) = self.divided(lane, *group);
                let (before, both, first) = (self.id(), self.id(), self.id());
                let place = self.addresses.of(id);
                let at = self.address(target, place);
                self.scalars.load(self.builder, before, cell.width, place.element.min(64), at, offset(place.offset));
                self.scalars.evaluate(self.builder, both, &Kind::Binary(combining(*by), before, *of), cell.width);
                let is_first = self.equals(within, 0);
                self.scalars.define_flag(first, is_first);
                let kind = Kind::Mux { select: first, on_true: *of, on_false: both };
                self.scalars.evaluate(self.builder, id, &kind, cell.width);
                self.scalars.store(self.builder, id, place.element.min(64), at, offset(place.offset));
                return;
            }
            kind => {
                kind.for_each_operand(|operand| self.want_lane(outer, operand, lane));
                self.scalars.evaluate(self.builder, id, kind, cell.width);
            }
        }
        if self.plan.stored.contains(&id) {
            self.store_lane(id, self.addresses.of(id), lane);
        }
    }

    /// A neighbour's value, or that of the edge.
    #[allow(clippy::too_many_arguments, reason = "the fields of one operation")]
    fn shifted(&mut self, outer: &Scalars, id: ValueId, of: ValueId, by: i32, edge: ValueId, group: u32, lane: Value) {
        let (row, within) = self.divided(lane, group);
        let distance = self.builder.ins().iconst(types::I64, i64::from(by));
        let from = self.builder.ins().isub(within, distance);
        let limit = self.builder.ins().iconst(types::I64, i64::from(group));
        let inside = self.builder.ins().icmp(IntCC::UnsignedLessThan, from, limit);
        let other = self.builder.ins().isub(lane, distance);
        let safe = self.builder.ins().select(inside, other, lane);
        let (neighbour, end, select) = (self.id(), self.id(), self.id());
        self.load_lane(neighbour, of, safe);
        match (&self.graph.cell(edge).kind, self.graph.cell(edge).lanes) {
            (Kind::Const(bits), _) => self.scalars.constant(self.builder, end, bits),
            (_, 1) => self.scalars.define(end, outer.get(edge).expect("made available before the loop").clone()),
            (Kind::Broadcast(plain, _), _) if self.graph.cell(*plain).lanes == 1 => {
                self.scalars.define(end, outer.get(*plain).expect("made available before the loop").clone());
            }
            _ => self.load_lane(end, edge, row),
        }
        self.scalars.define_flag(select, inside);
        let kind = Kind::Mux { select, on_true: neighbour, on_false: end };
        self.scalars.evaluate(self.builder, id, &kind, self.graph.cell(id).width);
    }

    fn lane_sinks(&mut self, outer: &Scalars, kernel: &Kernel, lane: Value) {
        let graph = self.graph;
        let sinks = || kernel.sinks.iter().map(|&index| &graph.sinks[index]);
        let mut taken = Vec::new();
        for sink in sinks() {
            sink.for_each_operand(|operand| self.want_lane(outer, operand, lane));
            let &Sink::Register { state, next, enable } = sink else { continue };
            let value = match enable {
                None => next,
                Some(select) => {
                    self.want_lane(outer, state, lane);
                    let value = self.id();
                    let kind = Kind::Mux { select, on_true: next, on_false: state };
                    self.scalars.evaluate(self.builder, value, &kind, graph.cell(state).width);
                    value
                }
            };
            let waiting = self.addresses.waiting.iter().find(|(id, _)| *id == state).map(|(_, place)| *place);
            taken.push((value, waiting.unwrap_or_else(|| self.addresses.of(state))));
        }
        for sink in sinks() {
            if let &Sink::Write { memory, enable, address, data } = sink {
                let base = self.lane_base(memory, lane);
                self.write(memory, enable, address, data, base);
            }
        }
        taken.into_iter().for_each(|(value, place)| self.store_lane(value, place, lane));
    }

    /// Where a lane's words of a memory begin.
    fn lane_base(&mut self, memory: u32, lane: Value) -> Value {
        let memory = self.memories[memory as usize];
        let stride = self.builder.ins().iconst(types::I64, memory.words.stride as i64);
        let start = self.builder.ins().imul(lane, stride);
        let base = self.builder.ins().iconst(types::I64, memory.address as i64);
        self.builder.ins().iadd(base, start)
    }

    /// A lane's group and its place there.
    fn divided(&mut self, lane: Value, group: u32) -> (Value, Value) {
        let n = self.builder.ins().iconst(types::I64, i64::from(group));
        (self.builder.ins().udiv(lane, n), self.builder.ins().urem(lane, n))
    }

    fn times(&mut self, lane: Value, n: u32) -> Value {
        let n = self.builder.ins().iconst(types::I64, i64::from(n));
        self.builder.ins().imul(lane, n)
    }

    fn equals(&mut self, a: Value, number: i64) -> Value {
        let number = self.builder.ins().iconst(types::I64, number);
        self.builder.ins().icmp(IntCC::Equal, a, number)
    }
}

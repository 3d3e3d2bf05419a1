//! Loops over lanes, as a [`Nest`] has them.

use tilewright_circuit::ir::Reduction;

use super::lanes::Vector;
use super::scalar::Scalar;
use super::strip_values::Strip;
use super::{Count, Emitter};
use crate::engine::function::Sink;
use crate::engine::plan::Kernel;
use crate::engine::plan::nest::{Division, Nest, Work};
use crate::engine::program::{Kind, ValueId};
use crate::engine::strips::Value;

/// A reduction and its result so far, in the form of [`Lanes::carried`](super::lanes::Lanes::carried).
struct Sum {
    id: ValueId,
    by: Reduction,
    of: ValueId,
    so_far: Option<Vector>,
}

impl Emitter<'_, '_> {
    /// Runs a kernel, or a version of it.
    pub(crate) fn kernel(&mut self, lanes: u32, kernel: &Kernel) {
        match kernel.versioned.filter(|_| !self.versions.is_empty()) {
            Some(index) => self.version_or(index, |emitter| emitter.branched(lanes, kernel)),
            None => self.branched(lanes, kernel),
        }
    }

    /// Runs a kernel, or that of a branch.
    fn branched(&mut self, lanes: u32, kernel: &Kernel) {
        if !kernel.parts.is_empty() {
            return kernel.parts.iter().for_each(|part| self.kernel(lanes, part));
        }
        let Some(switch) = &kernel.switch else { return self.loops(lanes, kernel) };
        self.want(switch.subject);
        let subject = self.scalars.clean(self.builder, switch.subject)[0];
        let mut regions = Vec::with_capacity(switch.kernels.len());
        for kernel in &switch.kernels {
            self.builder.open();
            let before = self.scalars.clone();
            self.kernel(lanes, kernel);
            self.scalars = before;
            regions.push(self.builder.close());
        }
        self.builder.switch(subject, switch.table.clone(), regions);
    }

    /// Loops over the rows and strips of a kernel.
    fn loops(&mut self, lanes: u32, kernel: &Kernel) {
        if kernel.cells.is_empty() && kernel.sinks.is_empty() {
            return;
        }
        let nest = Nest::of((self.function, self.plan), self.memories, self.strips, lanes, kernel);
        let (outer, scratch) = (self.scalars.clone(), self.builder.taken());
        let mut strip = Strip::new(&nest, self.builder.vector_bits());
        nest.uniforms.iter().for_each(|&id| self.splat_uniform(&mut strip, id));
        nest.tiles.iter().for_each(|&id| self.tile_whole(&mut strip, id));
        nest.words.iter().for_each(|&word| self.begin_words(&mut strip, word));
        let sums = match nest.division.rows() {
            1 => self.row(&mut strip, &nest, None, &mut Vec::new()),
            rows => {
                let mut totals = self.sums(&nest.totals);
                let count = Count { limit: i64::from(rows), step: 1, descends: nest.descends };
                self.carry(count, &mut strip, &mut totals, |emitter, strip, totals, row| {
                    let mark = strip.lanes.mark();
                    nest.of_row.iter().for_each(|&id| emitter.splat_of_row(strip, id, row));
                    for (id, sum) in emitter.row(strip, &nest, Some(row), totals) {
                        let at = emitter.address(emitter.addresses.of(id), row);
                        emitter.sum(id, sum, at);
                    }
                    strip.lanes.forget(mark);
                });
                self.reduced(&mut strip, totals)
            }
        };
        self.scalars = outer;
        self.builder.give_back(scratch);
        for (id, sum) in sums {
            self.sum(id, sum, self.state);
        }
    }

    /// Stores the result of a reduction.
    fn sum(&mut self, id: ValueId, sum: Value, at: Value) {
        self.scalars.define(id, Scalar::clean(self.function.cell(id).width, sum));
        let place = self.addresses.of(id);
        self.store_single(id, place, at, place.offset);
    }

    /// Makes a scalar available that a kernel takes in all lanes.
    fn splat_uniform(&mut self, strip: &mut Strip, id: ValueId) {
        let of = self.source(id);
        self.want(of);
        let width = self.function.cell(id).width;
        if width <= 64 {
            let limbs = self.scalars.clean(self.builder, of);
            strip.lanes.splat(self.builder, id, width, limbs[0]);
        }
    }

    /// Makes available what is the same in a row.
    fn splat_of_row(&mut self, strip: &mut Strip, id: ValueId, row: Value) {
        let (of, loaded) = (self.source(id), self.id());
        self.load_lane(loaded, of, row);
        let limbs = self.scalars.clean(self.builder, loaded);
        strip.lanes.splat(self.builder, id, self.function.cell(id).width, limbs[0]);
    }

    /// What is the same in several lanes.
    pub(super) fn source(&self, id: ValueId) -> ValueId {
        let Kind::Broadcast { of, .. } = self.function.cell(id).kind else { unreachable!("it is the same in lanes") };
        of
    }

    /// Reductions with nothing combined yet.
    fn sums(&self, ids: &[ValueId]) -> Vec<Sum> {
        let sum = |&id: &ValueId| {
            let (by, of) = self.reduction(id);
            Sum { id, by, of, so_far: None }
        };
        ids.iter().map(sum).collect()
    }

    /// The operation and the operand of a reduction.
    fn reduction(&self, id: ValueId) -> (Reduction, ValueId) {
        let Kind::Reduce { by, of, .. } = self.function.cell(id).kind else { unreachable!("a reduction") };
        (by, of)
    }

    /// A loop that carries the results so far.
    fn carry(
        &mut self,
        count: Count,
        strip: &mut Strip,
        sums: &mut Vec<Sum>,
        body: impl FnOnce(&mut Self, &mut Strip, &mut Vec<Sum>, Value),
    ) {
        let mut start = Vec::new();
        for sum in sums.iter_mut() {
            let width = self.function.cell(sum.id).width;
            let before = sum.so_far.take().unwrap_or_else(|| strip.lanes.neutral(self.builder, sum.by, width));
            start.extend_from_slice(&before.parts);
            sum.so_far = Some(before);
        }
        self.count(count, &start, |emitter, at, carried| {
            let mut carried = carried.into_iter();
            for sum in sums.iter_mut() {
                let before = sum.so_far.as_ref().expect("it has begun");
                let parts = carried.by_ref().take(before.parts.len()).collect();
                sum.so_far = Some(strip.lanes.shape(before.width, parts));
            }
            body(emitter, strip, sums, at);
            sums.iter().filter_map(|sum| sum.so_far.as_ref()).flat_map(|vector| vector.parts.clone()).collect()
        });
    }

    /// Each result, clean.
    fn reduced(&mut self, strip: &mut Strip, sums: Vec<Sum>) -> Vec<(ValueId, Value)> {
        let sums = sums.into_iter().map(|Sum { id, by, so_far, .. }| {
            (id, strip.lanes.reduce(self.builder, by, &so_far.expect("there has been a strip")))
        });
        sums.collect()
    }

    /// Runs the strips of a row, which also combines into `totals`; returns the reductions over the row, clean.
    fn row(
        &mut self,
        strip: &mut Strip,
        nest: &Nest,
        row: Option<Value>,
        totals: &mut Vec<Sum>,
    ) -> Vec<(ValueId, Value)> {
        let mut sums = self.sums(&nest.sums);
        let of_row = sums.len();
        sums.append(totals);
        let mark = strip.lanes.mark();
        let start = row.map(|row| self.scaled(row, nest.division.row as usize));
        let body = |emitter: &mut Self, strip: &mut Strip, sums: &mut Vec<Sum>, within: Value| {
            emitter.strip(strip, nest, start, within);
            for sum in sums {
                emitter.vector(strip, sum.of);
                let vector = strip.lanes.carried(emitter.builder, sum.of);
                sum.so_far = Some(match &sum.so_far {
                    None => vector,
                    Some(before) => strip.lanes.combine(emitter.builder, sum.by, before, &vector),
                });
            }
        };
        let Division { row: length, strip: size, .. } = nest.division;
        let count = Count { limit: length.into(), step: size.into(), descends: nest.descends };
        if length <= size {
            let zero = count.start(self.builder);
            body(self, strip, &mut sums, zero);
        } else {
            self.carry(count, strip, &mut sums, body);
        }
        strip.lanes.forget(mark);
        totals.extend(sums.split_off(of_row));
        self.reduced(strip, sums)
    }

    /// The work of a strip.
    fn strip(&mut self, strip: &mut Strip, nest: &Nest, start: Option<Value>, within: Value) {
        self.enter(strip, start, within);
        for &work in &nest.work {
            match work {
                Work::Cell(id) => self.lane_cell(strip, id),
                Work::Combine(id) => self.vector(strip, self.reduction(id).1),
                Work::Register { sink, keeps } => self.register(strip, sink, keeps),
                Work::Write(sink) => self.write_lanes(strip, sink),
            }
        }
    }

    /// A register takes its next value. If it keeps the old one, that is loaded before.
    fn register(&mut self, strip: &mut Strip, index: usize, keeps: bool) {
        let &Sink::Register { state, next, enable } = &self.function.sinks[index] else { unreachable!("a register") };
        if keeps {
            self.available(strip, state);
        }
        let cell = self.function.cell(state);
        let value = match enable {
            None => next,
            Some(select) => {
                let value = self.id();
                let kind = Kind::Mux { select, on_true: next, on_false: state };
                self.elementwise(strip, value, &kind, cell.width);
                value
            }
        };
        let waiting = self.addresses.waiting.iter().find(|(id, _)| *id == state).map(|(_, place)| *place);
        let place = waiting.unwrap_or_else(|| self.addresses.of(state));
        self.store_lanes(strip, value, place);
    }
}

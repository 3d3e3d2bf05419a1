//! Loops over lanes, one strip at a time.
//!
//! The lanes of a kernel may form *rows*, the groups of an array of arrays. Then one loop goes over the rows, and one
//! within it over the strips of a row, so that values common to a row are loaded once.

use std::collections::{BTreeMap, BTreeSet};

use tilewright_circuit::ir::Reduction;

use super::lanes::Vector;
use super::scalar::Scalar;
use super::strip_values::Strip;
use super::{Count, Emitter};
use crate::engine::function::Sink;
use crate::engine::plan::Kernel;
use crate::engine::program::{Axis, Cell, Kind, Lowered, ValueId};
use crate::engine::strips::Value;

/// The sequence within a strip: cells, and after each the sinks that may run then.
struct Order {
    /// Before any cell.
    first: Vec<usize>,
    after: BTreeMap<usize, Vec<usize>>,
}

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
        let (outer, scratch) = (self.scalars.clone(), self.builder.taken());
        let row = self.row_length(lanes, kernel);
        let mut strip = Strip::new(self.strips.strip(lanes), lanes, row, kernel.descends);
        self.splat_uniforms(&mut strip, kernel);
        self.tile_short_rows(&mut strip, kernel);
        self.begin_memories(&mut strip, kernel);
        let sums = match strip.rows() {
            1 => self.row(&mut strip, kernel, None, &mut Vec::new()),
            rows => {
                let mut totals = self.sums(kernel, lanes);
                let count = Count { limit: i64::from(rows), step: 1, descends: kernel.descends };
                self.carry(count, &mut strip, &mut totals, |emitter, strip, totals, row| {
                    let mark = strip.lanes.mark();
                    emitter.splat_row(strip, kernel, row);
                    for (id, sum) in emitter.row(strip, kernel, Some(row), totals) {
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

    /// The group size that most of a kernel works with, if it consists of whole strips; all lanes otherwise.
    fn row_length(&self, lanes: u32, kernel: &Kernel) -> u32 {
        let strip = self.strips.strip(lanes);
        let mut uses: BTreeMap<u32, usize> = BTreeMap::new();
        let mut count = |id: ValueId| {
            let cell = self.function.cell(id);
            // Operands may have other lanes than the kernel: those of lane selections, and of other kernels'
            // reductions.
            let (of_lanes, group) = match cell.kind {
                Kind::Broadcast { axis, .. } if axis.inner > 1 => (cell.lanes, axis.inner),
                Kind::Broadcast { of, axis } if self.function.cell(of).lanes > 1 => (cell.lanes, axis.count),
                Kind::Reduce { of, axis, .. } if cell.lanes > 1 => (self.function.cell(of).lanes, axis.count),
                _ => return,
            };
            if of_lanes != lanes {
                return;
            }
            if group % strip == 0 && group < lanes {
                *uses.entry(group).or_default() += 1;
            }
        };
        self.taken(kernel).into_iter().for_each(&mut count);
        uses.into_iter().max_by_key(|&(group, count)| (count, group)).map_or(lanes, |(group, _)| group)
    }

    /// The inputs of a kernel.
    fn taken(&self, kernel: &Kernel) -> BTreeSet<ValueId> {
        let mut taken = BTreeSet::new();
        let mut visit = |id: ValueId| {
            taken.insert(id);
        };
        for &id in &kernel.cells {
            visit(id);
            self.function.cell(id).kind.for_each_operand(&mut visit);
        }
        kernel.sinks.iter().for_each(|&sink| self.function.sinks[sink].for_each_operand(&mut visit));
        taken
    }

    /// Makes available the scalars that a kernel uses in all lanes.
    fn splat_uniforms(&mut self, strip: &mut Strip, kernel: &Kernel) {
        for id in self.taken(kernel) {
            let cell = self.function.cell(id);
            if let Kind::Broadcast { of, .. } = cell.kind
                && self.function.cell(of).lanes == 1
            {
                self.want(of);
                if cell.width <= 64 {
                    let limbs = self.scalars.clean(self.builder, of);
                    strip.lanes.splat(self.builder, id, cell.width, limbs[0]);
                }
            }
        }
    }

    /// Makes rows available that are shorter than a strip.
    fn tile_short_rows(&mut self, strip: &mut Strip, kernel: &Kernel) {
        for id in self.taken(kernel) {
            let cell = self.function.cell(id);
            if let Kind::Broadcast { of, axis } = cell.kind
                && axis.inner > 1
                && axis.inner < strip.size
                && strip.size.is_multiple_of(axis.inner)
                && (cell.lanes, self.function.cell(of).lanes) == (strip.total, axis.inner)
                && cell.width <= 64
                && self.is_current(kernel, id)
            {
                self.tile_whole(strip, id, of);
            }
        }
    }

    /// Whether a stored derived value is up to date: another loop may have stored it before its source changed.
    fn is_current(&self, kernel: &Kernel, id: ValueId) -> bool {
        kernel.cells.contains(&id) || !self.addresses.has(id)
    }

    /// Finds the words of memories that have one address in all lanes.
    fn begin_memories(&mut self, strip: &mut Strip, kernel: &Kernel) {
        for &id in &kernel.cells {
            let Kind::Lowered(lowered) = &self.function.cell(id).kind else { continue };
            if let Lowered::Word { memory, address } | Lowered::WordOf { memory, address, .. } = *lowered {
                self.begin_words(strip, memory, address);
            }
        }
        for &sink in &kernel.sinks {
            if let Sink::Write { memory, address, .. } = self.function.sinks[sink] {
                self.begin_words(strip, memory, address);
            }
        }
    }

    /// Makes available what is the same in a row.
    fn splat_row(&mut self, strip: &mut Strip, kernel: &Kernel, row: Value) {
        for id in self.taken(kernel) {
            let cell = self.function.cell(id);
            if let Kind::Broadcast { of, axis: Axis { count, inner: 1 } } = cell.kind
                && count == strip.row
                && cell.lanes == strip.total
                && cell.width <= 64
                && self.is_current(kernel, id)
                && self.function.cell(of).lanes > 1
            {
                let loaded = self.id();
                self.load_lane(loaded, of, row);
                let limbs = self.scalars.clean(self.builder, loaded);
                strip.lanes.splat(self.builder, id, cell.width, limbs[0]);
            }
        }
    }

    /// Reductions of this number of lanes each, with nothing combined yet.
    fn sums(&self, kernel: &Kernel, lanes: u32) -> Vec<Sum> {
        let sum = |&id: &ValueId| match self.function.cell(id) {
            &Cell { kind: Kind::Reduce { by, of, axis }, width: ..=64, .. } if axis.count == lanes => {
                Some(Sum { id, by, of, so_far: None })
            }
            _ => None,
        };
        kernel.cells.iter().filter_map(sum).collect()
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

    /// Whether a reduction's result is carried around the loop over a row, or over all rows.
    fn is_loop_carried(&self, strip: &Strip, id: ValueId) -> bool {
        let cell = self.function.cell(id);
        let is_whole = |count| count == strip.row || count == strip.total;
        matches!(cell.kind, Kind::Reduce { axis, .. } if is_whole(axis.count) && cell.width <= 64)
    }

    /// Runs the strips of a row, which also combines into `totals`; returns the reductions over the row, clean.
    fn row(
        &mut self,
        strip: &mut Strip,
        kernel: &Kernel,
        row: Option<Value>,
        totals: &mut Vec<Sum>,
    ) -> Vec<(ValueId, Value)> {
        let order = self.order(kernel);
        let mut sums = self.sums(kernel, strip.row);
        let of_row = sums.len();
        sums.append(totals);
        let mark = strip.lanes.mark();
        let start = row.map(|row| self.scaled(row, strip.row as usize));
        let body = |emitter: &mut Self, strip: &mut Strip, sums: &mut Vec<Sum>, within: Value| {
            emitter.strip(strip, kernel, &order, start, within);
            for sum in sums {
                emitter.vector(strip, sum.of);
                let vector = strip.lanes.carried(emitter.builder, sum.of);
                sum.so_far = Some(match &sum.so_far {
                    None => vector,
                    Some(before) => strip.lanes.combine(emitter.builder, sum.by, before, &vector),
                });
            }
        };
        let count = Count { limit: strip.row.into(), step: strip.size.into(), descends: kernel.descends };
        if strip.row <= strip.size {
            let zero = count.start(self.builder);
            body(self, strip, &mut sums, zero);
        } else {
            self.carry(count, strip, &mut sums, body);
        }
        strip.lanes.forget(mark);
        totals.extend(sums.split_off(of_row));
        self.reduced(strip, sums)
    }

    /// Cells and sinks of a strip.
    fn strip(&mut self, strip: &mut Strip, kernel: &Kernel, order: &Order, start: Option<Value>, within: Value) {
        self.enter(strip, start, within);
        let mut open: BTreeSet<usize> = kernel.sinks.iter().copied().collect();
        order.first.iter().for_each(|&sink| self.register(strip, sink, &mut open));
        for (index, &id) in kernel.cells.iter().enumerate() {
            match self.function.cell(id).kind {
                // Taken at the end, but before registers change.
                Kind::Reduce { of, .. } if self.is_loop_carried(strip, id) => self.vector(strip, of),
                _ => self.lane_cell(strip, id),
            }
            for &sink in order.after.get(&index).into_iter().flatten() {
                self.register(strip, sink, &mut open);
            }
        }
        for &index in &kernel.sinks {
            if matches!(self.function.sinks[index], Sink::Write { .. }) {
                self.write_lanes(strip, index);
            }
        }
    }

    /// Registers change as early as possible, so that few values are live at a time: after their inputs are computed,
    /// when no cell reads their old values. Memories are written at the end.
    fn order(&self, kernel: &Kernel) -> Order {
        let mut last = BTreeMap::new();
        for (index, &id) in kernel.cells.iter().enumerate() {
            last.insert(id, index);
            self.function.cell(id).kind.for_each_operand(|operand| {
                last.insert(operand, index);
            });
        }
        let mut order = Order { first: Vec::new(), after: BTreeMap::new() };
        for &index in &kernel.sinks {
            let sink = &self.function.sinks[index];
            let &Sink::Register { state, .. } = sink else { continue };
            let mut position = last.get(&state).copied();
            sink.for_each_operand(|operand| position = position.max(last.get(&operand).copied()));
            match position {
                Some(position) => order.after.entry(position).or_default().push(index),
                None => order.first.push(index),
            }
        }
        order
    }

    /// A register takes its next value; old values that other sinks need later are loaded before.
    fn register(&mut self, strip: &mut Strip, index: usize, open: &mut BTreeSet<usize>) {
        open.remove(&index);
        let &Sink::Register { state, next, enable } = &self.function.sinks[index] else { unreachable!("a register") };
        let mut seen = false;
        for &other in open.iter() {
            self.function.sinks[other].for_each_operand(|operand| seen |= operand == state);
        }
        if seen {
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

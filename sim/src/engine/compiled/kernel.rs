//! Loops over lanes, a strip of them at a time.
//!
//! The lanes of a kernel may stand in *rows*, the groups of an array of arrays: then one loop goes over the rows and
//! one within it over the strips of a row, so that what is the same in a row is loaded once.

use std::collections::{BTreeMap, BTreeSet};

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{BlockArg, BlockCall, InstBuilder, JumpTableData, Value, types};

use super::emitter::Emitter;
use super::function::Sink;
use super::lanes::Vector;
use super::plan::Kernel;
use super::scalar::Scalar;
use super::strip::Strip;
use crate::engine::program::{Axis, Kind, ValueId};

/// The order within a strip: cells, and after each the sinks that may run then.
struct Order {
    /// Before any cell.
    first: Vec<usize>,
    after: BTreeMap<usize, Vec<usize>>,
}

impl Emitter<'_, '_, '_> {
    /// Runs a kernel, or the one of a branch.
    pub(super) fn kernel(&mut self, lanes: u32, kernel: &Kernel) {
        let Some(switch) = &kernel.switch else { return self.loops(lanes, kernel) };
        self.want(switch.subject);
        let subject = self.scalars.clean(self.builder, switch.subject)[0];
        let done = self.builder.create_block();
        let blocks: Vec<_> = switch.kernels.iter().map(|_| self.builder.create_block()).collect();
        match (switch.table.as_slice(), blocks.as_slice()) {
            (_, &[only]) => {
                self.builder.ins().jump(only, &[]);
            }
            (&[zero, one], _) => {
                self.builder.ins().brif(subject, blocks[one], &[], blocks[zero], &[]);
            }
            (table, _) => {
                let pool = &mut self.builder.func.dfg.value_lists;
                let calls: Vec<BlockCall> =
                    table.iter().map(|&index| BlockCall::new(blocks[index], std::iter::empty(), pool)).collect();
                let table = self.builder.create_jump_table(JumpTableData::new(calls[0], &calls));
                let subject = self.builder.ins().ireduce(types::I32, subject);
                self.builder.ins().br_table(subject, table);
            }
        }
        for (kernel, block) in switch.kernels.iter().zip(blocks) {
            self.builder.switch_to_block(block);
            let before = self.scalars.clone();
            self.kernel(lanes, kernel);
            self.scalars = before;
            self.builder.ins().jump(done, &[]);
        }
        self.builder.switch_to_block(done);
    }

    /// Loops over the rows and strips of a kernel.
    fn loops(&mut self, lanes: u32, kernel: &Kernel) {
        if kernel.cells.is_empty() && kernel.sinks.is_empty() {
            return;
        }
        let (outer, scratch) = (self.scalars.clone(), self.builder.taken());
        let row = self.row_length(lanes, kernel);
        let mut strip = Strip::new(self.strips.strip(lanes), lanes, row);
        self.splat_uniforms(&mut strip, kernel);
        self.begin_memories(&mut strip, kernel);
        let sums = match strip.rows() {
            1 => self.row(&mut strip, kernel, None),
            rows => {
                self.count(i64::from(rows), 1, |emitter, row| {
                    let mark = strip.lanes.mark();
                    emitter.splat_row(&mut strip, kernel, row);
                    let sums = emitter.row(&mut strip, kernel, Some(row));
                    for (id, sum) in sums {
                        let at = emitter.address(row, emitter.addresses.of(id).bytes());
                        emitter.sum(id, sum, at);
                    }
                    strip.lanes.forget(mark);
                });
                Vec::new()
            }
        };
        self.scalars = outer;
        self.builder.give_back(scratch);
        for (id, sum) in sums {
            self.sum(id, sum, self.state);
        }
    }

    /// Stores what has been reduced.
    fn sum(&mut self, id: ValueId, sum: Value, at: Value) {
        self.scalars.define(id, Scalar::clean(self.function.cell(id).width, sum));
        let place = self.addresses.of(id);
        self.store_single(id, place, at, place.offset);
    }

    /// The group size that most of a kernel works with, if it is made of whole strips; all lanes otherwise.
    fn row_length(&self, lanes: u32, kernel: &Kernel) -> u32 {
        let strip = self.strips.strip(lanes);
        let mut uses: BTreeMap<u32, usize> = BTreeMap::new();
        let mut count = |id: ValueId| {
            let cell = self.function.cell(id);
            // Operands may have other lanes than the kernel: what it collects from, and the reductions of others.
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

    /// What a kernel takes that it does not compute.
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

    /// Makes the single values that a kernel takes in all lanes available.
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

    /// Finds the words of memories that have one address in all lanes.
    fn begin_memories(&mut self, strip: &mut Strip, kernel: &Kernel) {
        for &id in &kernel.cells {
            if let Kind::Word { memory, address } = self.function.cell(id).kind {
                self.begin_words(strip, memory, address);
            }
        }
        for &sink in &kernel.sinks {
            if let Sink::Write { memory, address, .. } = self.function.sinks[sink] {
                self.begin_words(strip, memory, address);
            }
        }
    }

    /// Makes what is the same in a row available.
    fn splat_row(&mut self, strip: &mut Strip, kernel: &Kernel, row: Value) {
        let computed: BTreeSet<ValueId> = kernel.cells.iter().copied().collect();
        for id in self.taken(kernel) {
            let cell = self.function.cell(id);
            // What another loop has stored may be made from what has changed since.
            let is_current = computed.contains(&id) || !self.addresses.has(id);
            if let Kind::Broadcast { of, axis: Axis { count, inner: 1 } } = cell.kind
                && count == strip.row
                && cell.lanes == strip.total
                && cell.width <= 64
                && is_current
                && self.function.cell(of).lanes > 1
            {
                let loaded = self.id();
                self.load_lane(loaded, of, row);
                let limbs = self.scalars.clean(self.builder, loaded);
                strip.lanes.splat(self.builder, id, cell.width, limbs[0]);
            }
        }
    }

    /// Whether a reduction's result is carried around the loop over a row.
    fn is_loop_carried(&self, strip: &Strip, id: ValueId) -> bool {
        let cell = self.function.cell(id);
        matches!(cell.kind, Kind::Reduce { axis, .. } if axis.count == strip.row && cell.width <= 64)
    }

    /// Runs the strips of a row; gives what is reduced over them, clean.
    fn row(&mut self, strip: &mut Strip, kernel: &Kernel, row: Option<Value>) -> Vec<(ValueId, Value)> {
        let order = self.order(kernel);
        let sums: Vec<ValueId> = kernel.cells.iter().copied().filter(|&id| self.is_loop_carried(strip, id)).collect();
        let sum = |emitter: &Self, id: ValueId| match emitter.function.cell(id).kind {
            Kind::Reduce { by, of, .. } => (by, of),
            _ => unreachable!("a sum is a reduction"),
        };
        let mark = strip.lanes.mark();
        let strips = strip.row.div_ceil(strip.size);
        if strips == 1 {
            let zero = self.builder.ins().iconst(types::I64, 0);
            self.strip(strip, kernel, &order, row, zero);
            let sums = sums.into_iter().map(|id| {
                let (by, of) = sum(self, id);
                self.vector(strip, of);
                let vector = strip.lanes.carried(self.builder, of);
                (id, strip.lanes.reduce(self.builder, by, &vector))
            });
            let sums = sums.collect();
            strip.lanes.forget(mark);
            return sums;
        }
        let (block, done) = (self.builder.create_block(), self.builder.create_block());
        self.builder.append_block_param(block, types::I64);
        let zero = self.builder.ins().iconst(types::I64, 0);
        let mut start: Vec<BlockArg> = vec![zero.into()];
        let mut carried: Vec<Vector> = Vec::new();
        for &id in &sums {
            let neutral = strip.lanes.neutral(self.builder, sum(self, id).0, self.function.cell(id).width);
            let mut parts = Vec::new();
            for part in neutral.parts {
                start.push(part.into());
                let kind = self.builder.func.dfg.value_type(part);
                parts.push(self.builder.append_block_param(block, kind));
            }
            carried.push(strip.lanes.shape(neutral.width, parts));
        }
        self.builder.ins().jump(block, &start);
        self.builder.switch_to_block(block);
        let within = self.builder.block_params(block)[0];
        self.strip(strip, kernel, &order, row, within);
        for (&id, before) in sums.iter().zip(&mut carried) {
            let (by, of) = sum(self, id);
            self.vector(strip, of);
            let vector = strip.lanes.carried(self.builder, of);
            *before = strip.lanes.combine(self.builder, by, before, &vector);
        }
        let next = self.builder.ins().iadd_imm_s(within, i64::from(strip.size));
        let limit = self.builder.ins().iconst(types::I64, i64::from(strip.row));
        let more = self.builder.ins().icmp(IntCC::UnsignedLessThan, next, limit);
        let mut again: Vec<BlockArg> = vec![next.into()];
        again.extend(carried.iter().flat_map(|vector| vector.parts.iter().map(|&part| BlockArg::from(part))));
        self.builder.ins().brif(more, block, &again, done, &[]);
        self.builder.switch_to_block(done);
        strip.lanes.forget(mark);
        let sums = sums.into_iter().zip(&carried);
        sums.map(|(id, vector)| (id, strip.lanes.reduce(self.builder, sum(self, id).0, vector))).collect()
    }

    /// Cells and sinks of a strip.
    fn strip(&mut self, strip: &mut Strip, kernel: &Kernel, order: &Order, row: Option<Value>, within: Value) {
        self.enter(strip, row, within);
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

    /// Registers change as early as they may, so that few values are held at a time: when what they take is computed
    /// and no cell looks at what they were. Memories are written at the end.
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

    /// A register takes its next value; what other sinks have yet to see of it is loaded before.
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

//! The steps of a function in sequence, and its division into several functions.
//!
//! Scalar registers and memories change as early as possible: after their inputs are computed and their old values
//! have been read. So few values are live at a time, and a cut separates few related steps.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use super::{Kernel, Plan};
use crate::engine::function::{Function, Sink};
use crate::engine::program::{Kind, Lowered, ValueId};

/// A step of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Step {
    /// Computes a single value.
    Single(ValueId),
    /// Stores scalars, or lanes of other arrays, side by side.
    Collect(ValueId),
    /// Runs the kernel with this number of lanes of a stage.
    Kernel(usize, u32),
    /// Executes a sink of scalars.
    Sink(usize),
}

/// The steps of each function: a single function, unless it would be longer than `longest` operations, above which
/// Cranelift's time grows faster than the function. Values passed between functions are stored.
pub(super) fn sequence(function: &mut Function, plan: &mut Plan, longest: usize) -> Vec<Vec<Step>> {
    name_states(function, plan);
    let steps = interleaved(function, plan);
    let weight = |step: &Step| match *step {
        Step::Kernel(stage, lanes) => kernel_weight(&plan.stages[stage].kernels[&lanes]),
        Step::Single(id) | Step::Collect(id) => cell_weight(&function.cell(id).kind),
        Step::Sink(_) => 1,
    };
    if steps.iter().map(weight).sum::<usize>() <= longest {
        return vec![steps];
    }
    let mut pieces: Vec<Vec<Step>> = vec![Vec::new()];
    let mut size = 0;
    for step in steps {
        let weight = weight(&step);
        if size > 0 && size + weight > longest / 2 {
            pieces.push(Vec::new());
            size = 0;
        }
        size += weight;
        pieces.last_mut().expect("there is one").push(step);
    }
    store_between(function, plan, &pieces);
    pieces
}

/// The approximate number of machine operations; a few operands count nothing.
fn cell_weight(kind: &Kind) -> usize {
    const FEW: usize = 4;
    match kind {
        Kind::Select { arms, .. } => arms.len().div_ceil(FEW),
        Kind::Case { arms, .. } => arms.len().div_ceil(FEW),
        Kind::Concat(parts) | Kind::Stack { parts, .. } => parts.len().div_ceil(FEW),
        _ => 1,
    }
}

fn kernel_weight(kernel: &Kernel) -> usize {
    match &kernel.switch {
        _ if !kernel.parts.is_empty() => kernel.parts.iter().map(kernel_weight).sum(),
        Some(switch) => switch.kernels.iter().map(kernel_weight).sum(),
        None => kernel.operations(),
    }
}

/// Gives a sink that reads a state directly a cell for it, so that only cells read states.
fn name_states(function: &mut Function, plan: &mut Plan) {
    let mut names: FxHashMap<ValueId, ValueId> = FxHashMap::default();
    let mut added = Vec::new();
    for index in 0..function.sinks.len() {
        let mut sink = function.sinks[index].clone();
        if sink.lanes(function.circuit()) > 1 || matches!(sink, Sink::Show(_) | Sink::ContinueIf(_)) {
            continue;
        }
        sink.rewrite(|operand| {
            if function.cell(*operand).kind == Kind::State {
                *operand = *names.entry(*operand).or_insert_with(|| {
                    let name = function.rewriter.copy(*operand);
                    added.push(name);
                    name
                });
            }
        });
        function.sinks[index] = sink;
    }
    plan.singles_first(added);
}

/// The values that a step reads.
fn for_each_read(function: &Function, plan: &Plan, step: Step, mut visit: impl FnMut(ValueId)) {
    match step {
        Step::Single(id) => function.cell(id).kind.for_each_operand(visit),
        Step::Collect(id) => function.cell(id).kind.for_each_operand(|part| {
            visit(part);
            if let Kind::Broadcast { of, .. } = function.cell(part).kind {
                visit(of);
            }
        }),
        Step::Kernel(stage, lanes) => kernel_reads(function, plan, &plan.stages[stage].kernels[&lanes], &mut visit),
        // The old value of a disabled register is its own.
        Step::Sink(index) => function.sinks[index].for_each_operand(&mut visit),
    }
}

fn kernel_reads(function: &Function, plan: &Plan, kernel: &Kernel, visit: &mut dyn FnMut(ValueId)) {
    let mut look = |id: ValueId| {
        visit(id);
        if let Kind::Broadcast { of, .. } = function.cell(id).kind {
            visit(of);
        }
    };
    for &id in &kernel.cells {
        look(id);
        function.cell(id).kind.for_each_operand(&mut look);
    }
    kernel.sinks.iter().for_each(|&sink| function.sinks[sink].for_each_operand(&mut look));
    if let Some(index) = kernel.versioned {
        plan.versioned[index].subjects.iter().for_each(|subject| visit(*subject));
    }
    if let Some(switch) = &kernel.switch {
        visit(switch.subject);
        switch.kernels.iter().for_each(|kernel| kernel_reads(function, plan, kernel, visit));
    }
    kernel.parts.iter().for_each(|part| kernel_reads(function, plan, part, visit));
}

/// All steps, with sinks as early as possible.
fn interleaved(function: &Function, plan: &Plan) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    for (number, stage) in plan.stages.iter().enumerate() {
        steps.extend(stage.single.iter().map(|&id| Step::Single(id)));
        steps.extend(stage.collected.iter().map(|&id| Step::Collect(id)));
        steps.extend(stage.loops().into_iter().map(|(lanes, _)| Step::Kernel(number, lanes)));
    }
    // For each value, the step after which it is available and no longer read.
    let mut last: FxHashMap<ValueId, usize> = FxHashMap::default();
    let mut words: FxHashMap<u32, usize> = FxHashMap::default();
    for (position, &step) in steps.iter().enumerate() {
        for_each_read(function, plan, step, |id| {
            last.insert(id, position);
        });
        let computed: &[ValueId] = match step {
            Step::Single(id) | Step::Collect(id) => &[id],
            Step::Kernel(stage, lanes) => &plan.stages[stage].kernels[&lanes].cells,
            Step::Sink(_) => &[],
        };
        for &id in computed {
            last.insert(id, position);
            if let Kind::Lowered(Lowered::Word { memory, .. }) = function.cell(id).kind {
                words.insert(memory, position);
            }
        }
    }
    let mut after: BTreeMap<Option<usize>, Vec<usize>> = BTreeMap::new();
    for (index, sink) in function.sinks.iter().enumerate().filter(|(_, sink)| sink.lanes(function.circuit()) == 1) {
        let mut position = None;
        sink.for_each_operand(|operand| position = position.max(last.get(&operand).copied()));
        match *sink {
            Sink::Register { state, .. } => position = position.max(last.get(&state).copied()),
            Sink::Write { memory, .. } => {
                position = position.max(words.get(&memory).copied());
                // Ports write one after another.
                words.extend(position.map(|position| (memory, position)));
            }
            Sink::Show(_) | Sink::Row { .. } => {}
            Sink::ContinueIf(_) => continue,
        }
        after.entry(position).or_default().push(index);
    }
    let sinks = |position| after.get(&position).into_iter().flatten().map(|&index| Step::Sink(index));
    let rest =
        steps.into_iter().enumerate().flat_map(|(position, step)| [step].into_iter().chain(sinks(Some(position))));
    sinks(None).chain(rest).collect()
}

/// Stores the scalars that one function computes and another reads.
fn store_between(function: &Function, plan: &mut Plan, pieces: &[Vec<Step>]) {
    let mut made: FxHashMap<ValueId, usize> = FxHashMap::default();
    let mut stored = BTreeSet::new();
    for (number, piece) in pieces.iter().enumerate() {
        for &step in piece {
            for_each_read(function, plan, step, |id| {
                if made.get(&id).is_some_and(|&maker| maker != number) {
                    stored.insert(id);
                }
            });
            if let Step::Single(id) = step {
                made.insert(id, number);
            }
        }
    }
    for sink in &function.sinks {
        if let Sink::ContinueIf(value) = sink
            && made.get(value).is_some_and(|&maker| maker + 1 != pieces.len())
        {
            stored.insert(*value);
        }
    }
    plan.live_out.extend(stored);
}

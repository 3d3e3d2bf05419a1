//! The effect of the passes on the functions for edges, in words.

use std::fmt::Write;

use tilewright_circuit::Bits;

use super::loops::Loops;
use super::{Names, Pass, Text};
use crate::engine::emit::{Addresses, Emitter};
use crate::engine::function::split::{From, Part, Split, Units, split};
use crate::engine::function::{Function, Held, Maker, Sink};
use crate::engine::layout::Layout;
use crate::engine::layout::bank;
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::plan::planned::{self, Seen};
use crate::engine::plan::sequence::Step;
use crate::engine::plan::{Kernel, Plan};
use crate::engine::program::{Program, UnitId, ValueId};
use crate::engine::running::held_inputs;
use crate::engine::running::units;
use crate::engine::strips::{self, Builder, Notes};

/// The result of each pass for an edge of each clock.
pub(super) fn explain(program: &Program) -> Vec<(Pass, String)> {
    let passes =
        [Pass::Edge, Pass::Hold, Pass::Lower, Pass::Plan, Pass::Branch, Pass::Sequence, Pass::Loops, Pass::Strips];
    let mut all: Vec<(Pass, String)> = passes.map(|pass| (pass, String::new())).to_vec();
    for (clock, declared) in program.clocks.iter().enumerate() {
        for (pass, text) in edge(program, clock) {
            let (_, all) = all.iter_mut().find(|(other, _)| *other == pass).expect("each pass is there");
            let _ = write!(all, "an edge of {}:\n{text}", declared.name);
        }
    }
    all
}

fn edge(program: &Program, clock: usize) -> Vec<(Pass, String)> {
    let names = Names::of(program);
    let (function, became) = Maker::new(program).edge(&[clock]);
    let names = names.renamed(&became);
    let units = units(program, &function, &names);
    let mut all = vec![(Pass::Edge, text(program, &function, &names) + &units)];
    let held: Held = held_inputs(program).map(|id| (id, Bits::zero(program.circuit[id].width))).collect();
    let (special, became) = Maker::new(program).hold(&held).edge(&[clock]);
    all.push((Pass::Hold, text(program, &special, &Names::of(program).renamed(&became))));

    let strips = StripSizes::of(program, program.passes.target.vector());
    let (memories, _banks) = bank::banks(program, &strips);
    let mut layout = Layout::new(strips.clone());
    let (places, _apart) = units::places(program, &mut layout);
    let mut lowered = names.clone();
    planned::plan(&function, &strips, &memories, &program.passes, &mut |seen| match seen {
        Seen::Lowered(function, became) => {
            lowered = names.renamed(became);
            all.push((Pass::Lower, text(program, function, &lowered)));
        }
        Seen::Planned(function, plan) => all.push((Pass::Plan, planned(program, function, plan, &lowered))),
        Seen::Branched(function, plan) => all.push((Pass::Branch, planned(program, function, plan, &lowered))),
        Seen::Sequenced(function, plan, pieces) => {
            all.push((Pass::Sequence, sequenced(program, function, plan, pieces, &lowered)));
            let addresses = Addresses::new(function, plan, places.iter().filter_map(|place| *place), &mut layout);
            let loops = Loops { function, plan, memories: &memories, strips: &strips };
            all.push((Pass::Loops, loops.text(Text::with(program, function.circuit(), lowered.clone()), pieces)));
            let of = Emitted { program, function, plan, addresses: &addresses, memories: &memories, strips: &strips };
            all.push((Pass::Strips, of.pieces(pieces, &lowered)));
        }
    });
    all
}

/// The units of a function: what crosses into each.
fn units(program: &Program, function: &Function, names: &Names) -> String {
    let Some(Split { taken, units, .. }) = split(&Units::of(program), function) else { return String::new() };
    let mut text = Text::with(program, function.circuit(), names.clone());
    let _ = text.values(function.needed().into_iter());
    let line = |part: &Part| {
        let crosses = |from: &From| match *from {
            From::Crossing(index) => Some(text.name(taken[index])),
            _ => None,
        };
        let crossing: Vec<String> = part.states.iter().filter_map(crosses).collect();
        let (UnitId(number), changes) = (part.unit, part.function.sinks.len());
        format!(
            "  unit {number}, skipped unless something else crosses: {changes} changes, crossing: {}\n",
            crossing.join(" ")
        )
    };
    units.iter().map(line).collect()
}

/// A function: its values and sinks.
fn text(program: &Program, function: &Function, names: &Names) -> String {
    let mut text = Text::with(program, function.circuit(), names.clone());
    let mut out = text.values(function.needed().into_iter());
    (0..function.sinks.len()).for_each(|sink| out.push_str(&line(&text, function, sink)));
    out
}

/// A sink in words.
pub(super) fn line(text: &Text, function: &Function, sink: usize) -> String {
    match function.sinks[sink] {
        Sink::Register { state, next, enable } => text.change(&text.name(state), &text.name(next), enable),
        Sink::Write { memory, enable, address, data } => {
            text.change(&format!("{}[{}]", text.memory(memory), text.name(address)), &text.name(data), Some(enable))
        }
        Sink::Show(value) => format!("  show {}\n", text.name(value)),
        Sink::ContinueIf(value) => format!("  continue if {}\n", text.name(value)),
        Sink::Row { at, value, .. } => format!("  row[{at}] {}\n", text.name(value)),
    }
}

/// The stages of a function.
fn planned(program: &Program, function: &Function, plan: &Plan, names: &Names) -> String {
    let mut text = Text::with(program, function.circuit(), names.clone());
    let _ = text.values(function.needed().into_iter());
    let mut out = String::new();
    for (number, stage) in plan.stages.iter().enumerate() {
        let _ = writeln!(out, "stage {number}");
        for (what, ids) in [("one lane", &stage.single), ("side by side", &stage.collected)] {
            if !ids.is_empty() {
                let _ = writeln!(out, "  {what}: {}", list(&text, ids));
            }
        }
        for (lanes, kernel) in stage.loops() {
            let _ = write!(out, "  loop over {lanes} lanes{}: ", order(kernel));
            let leaf = &mut |text: &mut Text, kernel: &Kernel| {
                let values = text.values(kernel.cells.iter().copied());
                let sinks = kernel.sinks.iter().map(|&sink| line(text, function, sink));
                values.lines().map(str::to_owned).chain(sinks).collect()
            };
            kernels(&mut out, &mut text, plan, kernel, 2, leaf);
        }
    }
    if !plan.live_out.is_empty() {
        let _ = writeln!(out, "live out: {}", list(&text, plan.live_out.iter()));
    }
    if !plan.hazards.is_empty() {
        let _ = writeln!(out, "hazards, changed at the end: {}", list(&text, plan.hazards.iter()));
    }
    out
}

pub(super) fn order(kernel: &Kernel) -> &'static str {
    if kernel.descends { ", the last first" } else { "" }
}

pub(super) fn list<'a>(text: &Text, ids: impl IntoIterator<Item = &'a ValueId>) -> String {
    ids.into_iter().map(|id| text.name(*id)).collect::<Vec<_>>().join(" ")
}

/// A loop, or those that run instead of it: the lines of each by `leaf`.
pub(super) fn kernels(
    out: &mut String,
    text: &mut Text,
    plan: &Plan,
    kernel: &Kernel,
    depth: usize,
    leaf: &mut dyn FnMut(&mut Text, &Kernel) -> Vec<String>,
) {
    let indent = "  ".repeat(depth);
    if let Some(index) = kernel.versioned {
        let _ = write!(out, "in versions by {}; else ", list(text, &plan.versioned[index].subjects));
    }
    if !kernel.parts.is_empty() {
        let _ = writeln!(out, "in {} loops", kernel.parts.len());
        for part in &kernel.parts {
            let _ = write!(out, "{indent}a loop: ");
            kernels(out, text, plan, part, depth + 1, leaf);
        }
        return;
    }
    if let Some(switch) = &kernel.switch {
        let _ = writeln!(out, "by {}", text.name(switch.subject));
        for (index, variant) in switch.kernels.iter().enumerate() {
            let numbers = (0..).zip(&switch.table).filter(|(_, kernel)| **kernel == index);
            let numbers: Vec<String> = numbers.map(|(number, _): (usize, _)| number.to_string()).collect();
            let _ = write!(out, "{indent}{}: ", numbers.join(", "));
            kernels(out, text, plan, variant, depth + 1, leaf);
        }
        return;
    }
    let does_nothing = kernel.cells.is_empty() && kernel.sinks.is_empty();
    let lines = if does_nothing { Vec::new() } else { leaf(text, kernel) };
    let _ = writeln!(out, "{}", if does_nothing { "nothing" } else { "" });
    for line in lines {
        let _ = writeln!(out, "{indent}{}", line.trim());
    }
}

/// The steps of each piece.
fn sequenced(program: &Program, function: &Function, plan: &Plan, pieces: &[Vec<Step>], names: &Names) -> String {
    let mut text = Text::with(program, function.circuit(), names.clone());
    let _ = text.values(function.needed().into_iter());
    let mut out = String::new();
    for (number, steps) in pieces.iter().enumerate() {
        let _ = writeln!(out, "piece {number}");
        for &step in steps {
            match step {
                Step::Single(id) | Step::Collect(id) => {
                    let _ = writeln!(out, "  {}", text.values([id].into_iter()).trim());
                }
                Step::Kernel(stage, lanes) => {
                    let kernel = &plan.stages[stage].kernels[&lanes];
                    let values = kernel.cells.len();
                    let _ = writeln!(
                        out,
                        "  a loop over {lanes} lanes for {values} values, {} changes",
                        kernel.sinks.len()
                    );
                }
                Step::Sink(sink) => out.push_str(&line(&text, function, sink)),
            }
        }
    }
    out
}

/// What the instructions of a function are made of.
struct Emitted<'a> {
    program: &'a Program,
    function: &'a Function,
    plan: &'a Plan,
    addresses: &'a Addresses,
    memories: &'a [MemoryAt],
    strips: &'a StripSizes,
}

impl Emitted<'_> {
    /// The instructions of each piece, without versions of loops.
    fn pieces(&self, pieces: &[Vec<Step>], names: &Names) -> String {
        let Emitted { program, function, plan, addresses, memories, strips } = *self;
        let mut text = Text::with(program, function.circuit(), names.clone());
        let _ = text.values(function.needed().into_iter());
        let state = |offset: usize| Some(text.name(addresses.value_at(offset)?));
        let memory = |address: usize| {
            let index = memories.iter().position(|memory| memory.address == address)?;
            Some(text.memory(index as u32).to_owned())
        };
        let notes = Notes { state: &state, address: &memory };
        let mut out = String::new();
        for (number, steps) in pieces.iter().enumerate() {
            let mut builder = Builder::new(self.strips.vector());
            let [state, ..] = strips::Program::PARAMETERS;
            let mut emitter = Emitter::new(function, plan, addresses, memories, strips, &mut builder, state);
            emitter.steps(steps);
            if number + 1 == pieces.len()
                && let Some(held) = emitter.end()
            {
                builder.give(held);
            }
            let (strips, _kept) = builder.finish();
            let _ = write!(out, "piece {number}\n{}", strips.text(&notes));
        }
        out
    }
}

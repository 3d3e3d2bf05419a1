//! The loops of a function in words: what stands before each, and the sequence within a strip.

use std::fmt::Write;

use super::Text;
use super::functions::{self, kernels, line, list};
use crate::engine::function::{Function, Sink};
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::plan::access::Access;
use crate::engine::plan::clamp::Clamp;
use crate::engine::plan::nest::{Division, Nest, Work};
use crate::engine::plan::sequence::Step;
use crate::engine::plan::{Kernel, Plan};
use crate::engine::program::{Kind, ValueId};

/// A function, and what its loops depend on besides.
pub(super) struct Loops<'a> {
    pub function: &'a Function,
    pub plan: &'a Plan,
    pub memories: &'a [MemoryAt],
    pub strips: &'a StripSizes,
}

impl Loops<'_> {
    /// The loops in sequence.
    pub fn text(&self, mut text: Text, pieces: &[Vec<Step>]) -> String {
        let _ = text.values(self.function.needed().into_iter());
        let mut out = String::new();
        for &step in pieces.iter().flatten() {
            let Step::Kernel(stage, lanes) = step else { continue };
            let kernel = &self.plan.stages[stage].kernels[&lanes];
            let _ = write!(out, "loop over {lanes} lanes{}: ", functions::order(kernel));
            let leaf = &mut |text: &mut Text, kernel: &Kernel| self.nest(text, lanes, kernel);
            kernels(&mut out, &mut text, self.plan, kernel, 1, leaf);
        }
        out
    }

    /// A loop without branches.
    fn nest(&self, text: &mut Text, lanes: u32, kernel: &Kernel) -> Vec<String> {
        let nest = Nest::of((self.function, self.plan), self.memories, self.strips, lanes, kernel);
        let mut lines = self.around(text, &nest);
        let values = text.values(kernel.cells.iter().copied());
        let mut values = values.lines().map(|line| line.trim().to_owned());
        lines.extend(nest.work.iter().map(|work| match *work {
            Work::Cell(id) if self.function.circuit().constant(id).is_some() => text.name(id),
            Work::Cell(_) | Work::Combine(_) => values.next().expect("each cell has a line"),
            Work::Register { sink, keeps } => {
                let Sink::Register { state, .. } = self.function.sinks[sink] else { unreachable!("a register") };
                let kept = if keeps { format!("load {}, then ", text.name(state)) } else { String::new() };
                let late = if self.plan.hazards.contains(&state) { ", at the end" } else { "" };
                kept + line(text, self.function, sink).trim() + late
            }
            Work::Write(sink) => line(text, self.function, sink).trim().to_owned(),
        }));
        lines
    }

    /// The division of the lanes, what stands before the loops, what they carry, and what a strip takes from others.
    fn around(&self, text: &Text, nest: &Nest) -> Vec<String> {
        let source = |id: ValueId| match self.function.cell(id).kind {
            Kind::Broadcast { of, .. } => of,
            _ => id,
        };
        let sources = |ids: &[ValueId]| list(text, &ids.iter().map(|&id| source(id)).collect::<Vec<_>>());
        let word = |&(memory, at): &(u32, ValueId)| format!("{}[{}]", text.memory(memory), text.name(source(at)));
        let words: Vec<String> = nest.words.iter().map(word).collect();
        let taken = ["taken by one load", "taken by some loads", "taken lane by lane"].map(|what| {
            let cells = nest.work.iter().filter_map(|work| match *work {
                Work::Cell(id) => Some((id, nest.taken.get(&id)?)),
                _ => None,
            });
            let cells = cells.filter(|(_, access)| loads(access) == what);
            (what, cells.map(|(id, access)| text.name(id) + kept(access).as_str()).collect::<Vec<_>>().join(" "))
        });
        let parts = [
            ("before all", sources(&nest.uniforms)),
            ("before all, repeated in a strip", sources(&nest.tiles)),
            ("found before all", words.join(" ")),
            ("before each row", sources(&nest.of_row)),
            ("carried along a row", list(text, &nest.sums)),
            ("carried along all rows", list(text, &nest.totals)),
        ];
        let some = parts.into_iter().chain(taken).filter(|(_, names)| !names.is_empty());
        let lines = some.map(|(what, names)| format!("{what}: {names}"));
        std::iter::once(division(nest.division)).chain(lines).collect()
    }
}

/// Rows and strips, in words.
fn division(Division { lanes, row, strip }: Division) -> String {
    let rows = if row < lanes { format!("rows of {row}, ") } else { String::new() };
    let last = (row - 1) % strip + 1;
    let padded = if last < strip { format!(", the last with {last} lanes") } else { String::new() };
    format!("{rows}strips of {strip}{padded}")
}

/// What takes the place of a number that no lane has.
fn kept(access: &Access) -> String {
    let (Access::Each(_, _, clamp) | Access::WordOf(_, _, clamp)) = access else { return String::new() };
    match clamp {
        Clamp::None => String::new(),
        Clamp::Last(last) => format!(" (at most lane {last})"),
        Clamp::Own => " (or its own)".to_owned(),
    }
}

/// How many loads take the lanes of a strip.
fn loads(access: &Access) -> &'static str {
    match access {
        Access::Uniform | Access::Constant(_) => "taken without a load",
        Access::OfRow(_) | Access::Near(..) | Access::Words(_) => "taken by one load",
        Access::Groups(..) | Access::Regular { .. } => "taken by some loads",
        Access::Each(..) | Access::EachWord(_) | Access::WordOf(..) => "taken lane by lane",
    }
}

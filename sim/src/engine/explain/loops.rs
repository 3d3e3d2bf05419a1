//! The loops of a function in words: what stands before each, and the sequence within a strip.

use std::fmt::Write;

use super::Text;
use super::functions::{self, kernels, line, list};
use crate::engine::emit::Addresses;
use crate::engine::function::{Function, Sink};
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::plan::access::Access;
use crate::engine::plan::nest::{Nest, Work};
use crate::engine::plan::sequence::Step;
use crate::engine::plan::{Kernel, Plan};
use crate::engine::program::{Kind, ValueId};

/// A function, and what its loops depend on besides.
pub(super) struct Loops<'a> {
    pub function: &'a Function,
    pub plan: &'a Plan,
    pub memories: &'a [MemoryAt],
    pub strips: &'a StripSizes,
    pub addresses: &'a Addresses,
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
                kept + line(text, self.function, sink).trim()
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
        let taken = self.taken(nest);
        let taken = |is_so: fn(&Access) -> bool| {
            let cells = taken.iter().filter(|(_, access)| is_so(access));
            list(text, &cells.map(|(id, _)| *id).collect::<Vec<_>>())
        };
        let parts = [
            ("before all", sources(&nest.uniforms)),
            ("before all, repeated in a strip", sources(&nest.tiles)),
            ("found before all", words.join(" ")),
            ("before each row", sources(&nest.of_row)),
            ("carried along a row", list(text, &nest.sums)),
            ("carried along all rows", list(text, &nest.totals)),
            ("taken by one load", taken(|it| matches!(it, Access::OfRow(_) | Access::Near(..)))),
            ("taken by some loads", taken(|it| matches!(it, Access::Groups(..) | Access::Regular { .. }))),
            ("taken lane by lane", taken(|it| matches!(it, Access::Each(..)))),
        ];
        let division = nest.division;
        let rows = if division.rows() > 1 { format!("rows of {}, ", division.row) } else { String::new() };
        let some = parts.into_iter().filter(|(_, names)| !names.is_empty());
        let lines = some.map(|(what, names)| format!("{what}: {names}"));
        [format!("{rows}strips of {}", division.strip)].into_iter().chain(lines).collect()
    }

    /// The cells whose lanes are taken from others, and not before the loop.
    fn taken(&self, nest: &Nest) -> Vec<(ValueId, Access)> {
        let is_before = |id: &ValueId| nest.tiles.contains(id) || nest.of_row.contains(id);
        let is_stored = |id: ValueId| self.addresses.has(id);
        let of = |id: ValueId| Access::of(self.function, self.strips, nest.division, &is_stored, id);
        let cells = nest.work.iter().filter_map(|work| match *work {
            Work::Cell(id) if !is_before(&id) => Some((id, of(id)?)),
            _ => None,
        });
        cells.collect()
    }
}

//! Which part of the list the user asks for.

use crate::block::entries;
use crate::machine::Machine;
use clap::ValueEnum;
use std::collections::BTreeSet;
use tilewright_scenes::builtin;

/// The user's choice.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// A line for each thing.
    Overview,
    /// A line for each thing of one part.
    Part(Part),
    /// The full description of the things of that name; a machine as a whole is also a block.
    Named(&'static str),
    /// The full description of everything.
    All,
}

/// A part of the list.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Part {
    Scenes,
    Files,
    Machines,
    Blocks,
    Designs,
    Passes,
}

impl Part {
    pub const ALL: [Part; 6] = [Part::Scenes, Part::Files, Part::Machines, Part::Blocks, Part::Designs, Part::Passes];

    fn name(self) -> &'static str {
        match self {
            Part::Scenes => "scenes",
            Part::Files => "files",
            Part::Machines => "machines",
            Part::Blocks => "blocks",
            Part::Designs => "designs",
            Part::Passes => "passes",
        }
    }
}

impl Shown {
    /// All choices, by name.
    pub fn all() -> Vec<(&'static str, Shown)> {
        let parts = Part::ALL.map(|part| (part.name(), Shown::Part(part)));
        let machines = Machine::value_variants().iter().map(|machine| machine.name());
        let mut known = BTreeSet::new();
        let things = machines.chain(builtin::NAMES).chain(entries().map(|entry| entry.name));
        let things = things.filter(|name| known.insert(*name)).map(|name| (name, Shown::Named(name)));
        [("all", Shown::All)].into_iter().chain(parts).chain(things).collect()
    }

    /// The parts that are shown with one line for each thing; `None` for full descriptions.
    pub fn part(self) -> Option<&'static [Part]> {
        match self {
            Shown::Overview => Some(&Part::ALL),
            Shown::Part(part) => Part::ALL.iter().find(|it| **it == part).map(std::slice::from_ref),
            Shown::Named(_) | Shown::All => None,
        }
    }

    /// Whether a thing of that name, in that part, is asked for.
    pub fn has(self, part: Part, name: &str) -> bool {
        match self {
            Shown::Overview | Shown::All => true,
            Shown::Part(asked) => asked == part,
            Shown::Named(asked) => asked == name,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::names::are_alike;

    #[test]
    fn no_two_things_that_can_be_asked_for_have_one_name() {
        let all = Shown::all();
        for (i, (name, _)) in all.iter().enumerate() {
            assert!(!all[..i].iter().any(|(other, _)| are_alike(name, other)), "{name} means two things");
        }
    }
}

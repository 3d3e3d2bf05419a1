//! The words of memories that are compared.

use crate::first_difference::{Waves, name};
use std::collections::HashSet;
use tilewright_sim::Trace;
use tilewright_sim::program::Program;
use tilewright_sim::program::hierarchy::index;

/// The memories of a circuit, as a waveform has room for their words.
#[derive(Default)]
pub struct Words {
    /// Those whose words are in our waveform.
    taken: Vec<Memory>,
    /// Those for which there is no room, by path.
    pub left_out: Vec<String>,
}

/// A memory of an instance.
struct Memory {
    path: String,
    /// Its lanes, by path: one that is the memory itself, or `PATH[3]`.
    lanes: Vec<String>,
    depth: u32,
}

impl Words {
    /// Takes one memory after another, in the sequence of declaration, as long as there is room for all its words.
    pub fn of(program: &Program) -> Words {
        let (hierarchy, mut words, mut room) = (&program.hierarchy, Words::default(), Trace::MOST_WORDS);
        for place in hierarchy.places(0) {
            for (name, memory, shape) in &hierarchy.scope(place.scope).memories {
                let (path, depth) = (hierarchy.path_in(place, name), program.memories[*memory as usize].depth);
                match room.checked_sub(u64::from(depth) * u64::from(shape.lanes())) {
                    None => words.left_out.push(path),
                    Some(rest) => {
                        let lanes = (0..shape.lanes()).map(|lane| format!("{path}{}", index(*shape, lane))).collect();
                        words.taken.push(Memory { path, lanes, depth });
                        room = rest;
                    }
                }
            }
        }
        words
    }

    /// The lanes of the memories, by path, with their depths.
    pub fn lanes(&self) -> impl Iterator<Item = (&str, u32)> {
        self.taken.iter().flat_map(|it| it.lanes.iter().map(|lane| (lane.as_str(), it.depth)))
    }

    /// The waveform with their words.
    pub fn trace(&self, trace: Trace) -> Trace {
        self.taken.iter().fold(trace, |trace, memory| trace.words(&memory.path, 0..u32::MAX))
    }

    /// The variables of our waveform that are words.
    pub fn variables(&self, ours: &Waves) -> HashSet<u32> {
        let lanes: HashSet<&str> = self.lanes().map(|(path, _)| path).collect();
        let is_word = |path: &[String]| lane_of(&name(path)).is_some_and(|lane| lanes.contains(lane));
        let words = ours.signals.iter().filter(|signal| is_word(signal.path.get(1..).unwrap_or_default()));
        words.map(|signal| signal.variable).collect()
    }

    /// Takes words out of the names that only one run has, and returns the memories of which the other one lacks some.
    pub fn lacking(&self, only: &mut [Vec<String>; 2]) -> Vec<String> {
        let lanes: HashSet<&str> = self.lanes().map(|(path, _)| path).collect();
        let words = only[0].extract_if(.., |name| lane_of(name).is_some_and(|lane| lanes.contains(lane)));
        let lacking: HashSet<String> = words.filter_map(|word| Some(lane_of(&word)?.to_owned())).collect();
        // A waveform of Verilator has arrays by their depth.
        only[1].retain(|name| !lane_of(name).is_some_and(|memory| self.left_out.iter().any(|it| it == memory)));
        let lacks = |memory: &&Memory| memory.lanes.iter().any(|lane| lacking.contains(lane));
        self.taken.iter().filter(lacks).map(|memory| memory.path.clone()).collect()
    }
}

/// The memory of a word such as `u_queue.bytes[5]`, or the lane of one.
fn lane_of(word: &str) -> Option<&str> {
    Some(word.strip_suffix(']')?.rsplit_once('[')?.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::{Simulation, for_examples::Counter};

    #[test]
    fn words_are_told_by_their_memories() {
        let sim = Simulation::of(&Counter).unwrap();
        let mut words = Words::of(sim.program());
        assert_eq!((words.lanes().collect::<Vec<_>>(), &words.left_out[..]), (vec![("squares", 16)], &[][..]));
        words.left_out = vec!["u_large.words".to_owned()];
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let ours = names(&["late", "squares[3]", "squares[7]", "sums[3]"]);
        let theirs = names(&["_gated", "squares[16]", "u_large.words[9]"]);
        let mut only = [ours, theirs];
        assert_eq!(words.lacking(&mut only), ["squares"]);
        assert_eq!(only, [names(&["late", "sums[3]"]), names(&["_gated", "squares[16]"])]);
        assert_eq!(words.lacking(&mut only), [""; 0]);
    }
}

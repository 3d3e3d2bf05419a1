//! Names of random designs: words that the printer, the testbench or a tool could use for something else, and near
//! misses of those that the design has already.

use super::border::pads;
use super::{Part, PartBlock, clocks};
use crate::stimulus::Numbers;
use std::collections::{BTreeSet, HashSet};
use std::sync::LazyLock;
use tilewright_hdl::{Fields, Leaf};

/// What a name is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// An input: seen from outside, so that no reserved word may be its name.
    Input,
    /// An output, likewise.
    Output,
    /// A register, net, memory or instance; a reserved word gets a `_`.
    Inner,
}

/// Names that are natural, or that something else has.
const WORDS: &[&str] = &[
    "x",
    "y",
    "a",
    "q",
    "i",
    "j",
    "k",
    "n",
    "lane",
    "lanes",
    "value",
    "leaf",
    "pair",
    "tree",
    "edge",
    "link",
    "genvar",
    "dut",
    "cycle",
    "errors",
    "stimulus",
    "expected",
    "gap",
    "rising",
    "run",
    "fill",
    "address",
    "tb",
    "lane0",
    "words",
    "u_x",
    "u_y",
    "u_lane",
    "mem",
    "asserted",
    "lane_index",
    "instance",
    "word_i",
    "_unused_ok",
    "_unused_lane",
    "top",
    "all_benches",
    "main",
    "TOP",
    "X",
    "Lane",
    "VALUE",
    "PHASE",
    "PHASE_IDLE",
    "clk_",
    "rst_",
    "small",
    "large",
    "table",
    "class",
    "template",
    "namespace",
    "friend",
    "std",
    "name",
    "path",
    "unit",
    "beat_",
    "own",
    "out",
    "d0_part0",
];

/// What is put behind a name: what the printer puts behind it, and numbers as those of lists.
const ENDS: &[&str] = &[
    "",
    "_0",
    "_1",
    "_2",
    "_",
    "_read",
    "_read0",
    "_word",
    "_inside",
    "_read_word",
    "_read_inside",
    "_next",
    "_enable",
    "_read_address",
    "_write_data",
    "_contents",
    "_sum",
    "_any",
    "_all",
    "_lanes",
    "_of",
    "_tree",
    "_edge",
    "_link",
    "_part",
    "_choice",
    "_state",
    "_meta",
    "_tb",
];

/// The reserved words of both standards; for ports those of C++ too.
fn is_reserved(name: &str, kind: Kind) -> bool {
    static VERILOG: LazyLock<HashSet<&str>> =
        LazyLock::new(|| include_str!("../../../../circuit/src/reserved_words.txt").split_whitespace().collect());
    static CPP: LazyLock<HashSet<&str>> =
        LazyLock::new(|| include_str!("../../../../circuit/src/reserved_cpp.txt").split_whitespace().collect());
    VERILOG.contains(name) || kind != Kind::Inner && CPP.contains(name)
}

/// The names of what a part has from outside, and the namer of the rest.
#[derive(Debug)]
pub struct Named {
    pub namer: Namer,
    pub inputs: Vec<String>,
    pub pads: Vec<String>,
}

/// Draws the names of a part.
#[derive(Debug)]
pub struct Namer {
    /// `None` gives every name as it is wanted.
    numbers: Option<Numbers>,
    /// The few words that the design is made of, so that parents, children and their ports share some.
    words: Vec<String>,
    taken: BTreeSet<String>,
    /// The part may be an array's, of which nothing but an output may be called `lane`.
    is_inner: bool,
}

impl Namer {
    /// The namer of a part, when its inputs and its pads have their names.
    pub fn of(block: &PartBlock) -> Named {
        let mut namer = Namer::new(block.spec.names, &format!("{block:?}"), block.index, !block.is_top());
        let Part { inputs, .. } = block.part();
        let list = namer.list();
        let input = |number| match &list {
            Some(list) if namer.take(&format!("{list}_{number}"), Kind::Input, &[]) => format!("{list}_{number}"),
            _ => namer.draw(&format!("in_{number}"), Kind::Input),
        };
        let inputs = (0..inputs.len()).map(input).collect();
        let ends = ["_value", "_drives"].map(str::to_owned);
        let pads = pads(block.part(), block.is_top());
        let pads = pads.map(|(number, ..)| namer.draw_with(&format!("pad_{number}"), Kind::Input, &ends)).collect();
        Named { namer, inputs, pads }
    }

    /// The namer of the part of that number, a module of that name, for the seed of a design; 0 draws no names.
    pub fn new(seed: u64, module: &str, index: usize, is_inner: bool) -> Namer {
        let mut words = Numbers(seed);
        let all: Vec<&str> = VERILOG_WORDS.iter().chain(WORDS).copied().collect();
        let mut words: Vec<String> = (0..6).map(|_| all[words.draw() as usize % all.len()].to_owned()).collect();
        words.push(module.to_owned());
        let taken = clocks::ports().chain(["beat".to_owned()]).collect();
        let numbers = (seed != 0).then(|| Numbers(seed.wrapping_add(index as u64 + 1)));
        Namer { numbers, words, taken, is_inner }
    }

    /// As [`Namer::draw`], as it stands in the circuit: the language puts `_` behind a reserved word.
    pub fn legal(&mut self, plain: &str, kind: Kind) -> String {
        self.legal_with(plain, kind, &[])
    }

    /// As [`Namer::draw_with`], as it stands in the circuit.
    pub fn legal_with(&mut self, plain: &str, kind: Kind, ends: &[String]) -> String {
        let name = self.draw_with(plain, kind, ends);
        if is_reserved(&name, kind) { format!("{name}_") } else { name }
    }

    /// A name that nothing in the part has; `plain` if names are not drawn.
    pub fn draw(&mut self, plain: &str, kind: Kind) -> String {
        self.draw_with(plain, kind, &[])
    }

    /// As [`Namer::draw`], where the names with these ends are in use as well from then on.
    pub fn draw_with(&mut self, plain: &str, kind: Kind, ends: &[String]) -> String {
        for _ in 0..8 {
            let Some(name) = self.candidate() else { break };
            if self.take(&name, kind, ends) {
                // Later names may be near misses of this one.
                if self.words.len() < 24 {
                    self.words.push(name.clone());
                }
                return name;
            }
        }
        // A drawn name may be the plain one of something that comes later.
        let mut name = plain.to_owned();
        while !self.taken.insert(name.clone()) {
            name.push_str("_more");
        }
        name
    }

    /// Puts a name to use, if the language takes it and nothing has it.
    fn take(&mut self, name: &str, kind: Kind, ends: &[String]) -> bool {
        // What the language makes of it.
        let printed = if is_reserved(name, kind) { format!("{name}_") } else { name.to_owned() };
        let all = || [printed.clone()].into_iter().chain(ends.iter().map(|end| format!("{name}{end}")));
        let is_legal = kind == Kind::Inner || printed == name;
        let is_lane = self.is_inner && kind != Kind::Output && name == "lane";
        let is_free = is_legal && !is_lane && all().all(|name| !self.taken.contains(&name));
        if is_free {
            self.taken.extend(all());
        }
        is_free
    }

    /// What the inputs are a list of, in one part of three: such a list often feeds an array by the name of its port.
    fn list(&mut self) -> Option<String> {
        let numbers = self.numbers.as_mut()?;
        let word = &self.words[numbers.draw() as usize % self.words.len()];
        numbers.draw().is_multiple_of(3).then(|| word.clone())
    }

    /// Lets later names be near misses of this one, which is given otherwise.
    pub fn remember(&mut self, name: &str) {
        self.taken.insert(name.to_owned());
        self.words.push(name.to_owned());
    }

    fn candidate(&mut self) -> Option<String> {
        let numbers = self.numbers.as_mut()?;
        let word = &self.words[numbers.draw() as usize % self.words.len()];
        let end = if numbers.draw().is_multiple_of(2) { "" } else { ENDS[numbers.draw() as usize % ENDS.len()] };
        Some(format!("{word}{end}"))
    }
}

/// Words of Verilog and SystemVerilog that are natural names, and some of C++.
const VERILOG_WORDS: &[&str] = &[
    "cell", "event", "design", "use", "config", "library", "generate", "bit", "do", "final", "priority", "logic",
    "int", "new", "this", "wire", "reg", "begin", "always", "strong0", "buf", "global", "checker", "type", "signed",
    "time",
];

/// Ports by name, of which each is a field of that name whatever record they are in.
#[derive(Debug, Clone, PartialEq)]
pub struct Ports<T>(pub Vec<(String, T)>);

impl<T> Default for Ports<T> {
    fn default() -> Self {
        Ports(Vec::new())
    }
}

impl<T: Leaf> Fields<T> for Ports<T> {
    type With<U: Leaf> = Ports<U>;

    fn map_fields<U: Leaf>(&self, _: &str, f: &mut dyn FnMut(&str, &T) -> U) -> Ports<U> {
        Ports(self.0.iter().map(|(name, leaf)| (name.clone(), f(name, leaf))).collect())
    }
}

impl<T> Ports<T> {
    /// The values without their names.
    pub fn values(self) -> Vec<T> {
        self.0.into_iter().map(|(_, value)| value).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plain_name_that_was_drawn_for_another_gets_an_end() {
        let taken = ["link_0".to_owned()].into();
        let mut namer = Namer { numbers: None, words: Vec::new(), taken, is_inner: false };
        let names = [(); 2].map(|()| namer.draw("link_0", Kind::Output));
        assert_eq!(names, ["link_0_more", "link_0_more_more"]);
    }
}

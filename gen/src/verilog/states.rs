//! The names of codes. The codes of an enum that the text mentions are `localparam`s. Constants that are assigned to
//! a value of that enum or compared with it are printed by name.

use super::layout::{range, wrapped};
use super::literal::{Style, literal};
use super::scope;
use super::text::words;
use std::collections::BTreeSet;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Kind, Module, Names, NodeId};

/// The enums of a module, and the nodes whose values are codes.
pub struct StateNames {
    enums: Vec<Enum>,
    /// For each node, its enum of states.
    of: Vec<Option<usize>>,
}

struct Enum {
    names: Names,
    width: u32,
    localparams: Vec<String>,
}

impl StateNames {
    pub fn new(module: &Module, taken: &mut scope::Names) -> StateNames {
        let mut all = StateNames { enums: Vec::new(), of: vec![None; module.nodes.len()] };
        for (id, node) in module.nodes.iter().enumerate() {
            let Kind::Code(names) = node.kind else { continue };
            let width = node.width;
            let known = all.enums.iter().position(|known| known.names == names && known.width == width);
            let index = known.unwrap_or_else(|| {
                let name = |code: &&str| taken.fresh(&screaming(&[names.of, code]));
                let localparams = names.codes.iter().map(name).collect();
                all.enums.push(Enum { names, width, localparams });
                all.enums.len() - 1
            });
            all.of[id] = Some(index);
        }
        all
    }

    /// The enum of a node.
    pub fn of(&self, id: NodeId) -> Option<usize> {
        self.of[id.0 as usize]
    }

    /// A state's name, or the plain number if no state has that code.
    pub fn name(&self, index: usize, value: &Bits) -> String {
        let states = &self.enums[index];
        match value.to_u64().and_then(|value| states.names.place(value)) {
            Some(place) => states.localparams[place].clone(),
            None => literal(value, Style::Count),
        }
    }

    /// The one state that is not among these, if there is exactly one.
    pub fn remaining<'a>(&self, index: usize, keys: impl Iterator<Item = &'a Bits>) -> Option<String> {
        let keys: BTreeSet<u64> = keys.filter_map(Bits::to_u64).collect();
        let states = &self.enums[index];
        let names = states.names.values.iter().zip(&states.localparams);
        let mut others = names.filter(|(value, _)| !keys.contains(value)).map(|(_, name)| name);
        let only = others.next().cloned();
        only.filter(|_| others.next().is_none())
    }

    /// The declarations of the codes that the finished text mentions. The others are listed after them as a comment,
    /// because linters warn about an unused `localparam`.
    pub fn declarations(&self, text: &[String]) -> Vec<String> {
        if self.enums.is_empty() {
            return Vec::new();
        }
        let mentioned = text.iter().flat_map(|line| words(line)).collect();
        self.enums.iter().flat_map(|states| states.declarations(&mentioned)).collect()
    }
}

impl Enum {
    fn declarations(&self, mentioned: &BTreeSet<&str>) -> Vec<String> {
        let (used, unused): (Vec<_>, Vec<_>) =
            self.localparams.iter().enumerate().partition(|(_, name)| mentioned.contains(name.as_str()));
        if used.is_empty() {
            return Vec::new();
        }
        let longest = used.iter().map(|(_, name)| name.len()).max().unwrap_or(0);
        let declare = |(place, name): (usize, &String)| {
            let value = literal(&Bits::new(self.width, self.names.values[place]), Style::Count);
            format!("localparam {}{name:longest$} = {value};", range(self.width))
        };
        let mut lines: Vec<String> = used.into_iter().map(declare).collect();
        if !unused.is_empty() {
            let items: Vec<String> =
                unused.iter().map(|(place, name)| format!("{name} = {}", self.names.values[*place])).collect();
            let list = format!("// Not used here: {}.", wrapped(&items, 0));
            lines.extend(list.replace('\n', "\n//     ").lines().map(str::to_string));
        }
        lines
    }
}

/// `CamelCase` words as `CAMEL_CASE`, joined by `_`.
pub fn screaming(words: &[&str]) -> String {
    let mut out = String::new();
    for word in words {
        let mut before = '_';
        for c in word.chars() {
            if c.is_uppercase() && (before.is_lowercase() || before.is_ascii_digit()) {
                out.push('_');
            }
            out.extend(c.to_uppercase());
            before = c;
        }
        out.push('_');
    }
    out.trim_end_matches('_').to_string()
}

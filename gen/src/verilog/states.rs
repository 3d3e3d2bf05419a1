//! State names: each state of a state machine is a `localparam`, and the constants that a state register takes or is
//! compared with are printed by that name.

use super::literal::{Style, literal};
use super::scope::Names;
use std::collections::BTreeSet;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Module, NodeId, Op, States};

/// The state enums of a module and the nodes that hold a state.
pub struct StateNames {
    enums: Vec<Enum>,
    /// For each node, the enum whose states it takes.
    of: Vec<Option<usize>>,
}

struct Enum {
    states: States,
    width: u32,
    localparams: Vec<String>,
    used: BTreeSet<usize>,
}

impl StateNames {
    pub fn new(module: &Module, taken: &mut Names) -> StateNames {
        let mut all = StateNames { enums: Vec::new(), of: vec![None; module.nodes.len()] };
        for register in &module.registers {
            let Some(states) = &register.states else { continue };
            let width = module.width(register.node);
            let known = all.enums.iter().position(|known| known.states == *states && known.width == width);
            let index = known.unwrap_or_else(|| {
                let name = |state: &String| taken.fresh(&screaming(&[&states.name, state]));
                let localparams = states.names.iter().map(name).collect();
                all.enums.push(Enum { states: states.clone(), width, localparams, used: BTreeSet::new() });
                all.enums.len() - 1
            });
            all.of[register.node.0 as usize] = Some(index);
            all.mark_values(module, register.next, index);
        }
        for (id, node) in module.nodes.iter().enumerate() {
            if let Op::Wire(to) | Op::QuasiStatic(to, _) = node.op
                && all.of[id].is_none()
            {
                all.of[id] = all.of[to.0 as usize];
            }
        }
        all
    }

    /// Marks the choices that lead to a state register; constants may be shared with other expressions.
    fn mark_values(&mut self, module: &Module, root: NodeId, index: usize) {
        let mut stack = vec![root];
        while let Some(id) = stack.pop() {
            if self.of[id.0 as usize].is_some() {
                continue;
            }
            let choice = match &module.node(id).op {
                Op::Mux { on_true, on_false, .. } => vec![*on_true, *on_false],
                Op::Select { arms, default } => arms.iter().map(|arm| arm.1).chain([*default]).collect(),
                Op::Case { arms, default, .. } => arms.iter().map(|arm| arm.1).chain([*default]).collect(),
                Op::Wire(to) => vec![*to],
                _ => continue,
            };
            self.of[id.0 as usize] = Some(index);
            stack.extend(choice);
        }
    }

    /// The enum whose states a node takes.
    pub fn of(&self, id: NodeId) -> Option<usize> {
        self.of[id.0 as usize]
    }

    /// A state's name, or the plain number if no state has that code.
    pub fn name(&mut self, index: usize, value: &Bits) -> String {
        let states = &mut self.enums[index];
        let code =
            value.to_u64().and_then(|code| usize::try_from(code).ok()).filter(|&code| code < states.localparams.len());
        match code {
            Some(code) => {
                states.used.insert(code);
                states.localparams[code].clone()
            }
            None => literal(value, Style::Count),
        }
    }

    /// The state that is none of these, if there is exactly one.
    pub fn remaining<'a>(&self, index: usize, keys: impl Iterator<Item = &'a Bits>) -> Option<String> {
        let keys: BTreeSet<u64> = keys.filter_map(Bits::to_u64).collect();
        let names = self.enums[index].localparams.iter().enumerate();
        let mut others = names.filter(|(code, _)| !keys.contains(&(*code as u64))).map(|(_, name)| name);
        let only = others.next().cloned();
        only.filter(|_| others.next().is_none())
    }

    /// The declarations; a state that the text does not mention becomes a comment, so that no linter warns.
    pub fn declarations(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for states in self.enums.iter().filter(|states| !states.used.is_empty()) {
            let longest = states.localparams.iter().map(String::len).max().unwrap_or(0);
            let range = if states.width == 1 { String::new() } else { format!("[{}:0] ", states.width - 1) };
            for (code, name) in states.localparams.iter().enumerate() {
                let value = literal(&Bits::new(states.width, code as u64), Style::Count);
                let unused = if states.used.contains(&code) { "" } else { "// not mentioned: " };
                lines.push(format!("{unused}localparam {range}{name:longest$} = {value};"));
            }
        }
        lines
    }
}

/// `CamelCase` words as `CAMEL_CASE`, joined by `_`.
fn screaming(words: &[&str]) -> String {
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

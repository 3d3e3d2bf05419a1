//! The functions for edges: which there are, and when one is made.

use tilewright_hdl::Bits;

use super::Compiled;
use super::function::{Function, Held, Maker};
use super::jit::Code;
use super::prepare::Prepared;
use crate::engine::start;

/// A function for an edge.
pub(super) struct Edge {
    /// The clocks that rise.
    rising: Vec<usize>,
    /// The resets that are high where that decides which assertions it checks.
    resets: Vec<bool>,
    code: Code,
    /// Since when inputs are as they are, and for how many edges.
    inputs_version: u64,
    quiet: u64,
    /// A function for these inputs.
    special: Option<Code>,
}

impl Compiled {
    /// The function for so many edges of these clocks; with inputs folded in if they have long been as they are.
    ///
    /// Registers are reset after it has run, so one function serves whether resets are high or not, except for the
    /// assertions that it checks: a circuit that begins with a reset has one function made, not two.
    pub(super) fn edge_code(&mut self, rising: &[usize], count: u64) -> Code {
        let mut asserting = rising.iter().filter(|&&clock| !self.program.clocks[clock].asserts.is_empty());
        let unchecked = asserting.all(|&clock| self.resets[clock]);
        self.check_asserts(!unchecked);
        let matches = |of: &[bool]| if unchecked { !of.contains(&true) } else { *of == *self.resets };
        let made = self.edges.iter().position(|edge| edge.rising.iter().eq(rising) && matches(&edge.resets));
        let index = made.unwrap_or_else(|| {
            let resets = if unchecked { vec![false; self.resets.len()] } else { self.resets.clone() };
            let code = self.make_edge(rising, &resets, &Held::default());
            let rising = rising.to_vec();
            self.edges.push(Edge { rising, resets, code, inputs_version: 0, quiet: 0, special: None });
            self.edges.len() - 1
        });
        let edge = &mut self.edges[index];
        if edge.inputs_version != self.inputs_version {
            edge.inputs_version = self.inputs_version;
            edge.quiet = 0;
            edge.special = None;
        }
        if let Some(code) = edge.special {
            return code;
        }
        edge.quiet += count;
        let code = edge.code;
        if edge.quiet < self.program.passes.held_after || self.special == 0 || self.inputs.is_empty() {
            return code;
        }
        self.special -= 1;
        let resets = self.edges[index].resets.clone();
        let held = self.inputs.iter().map(|&id| {
            let mut limbs = [0];
            self.state.get(self.places[id.index()].expect("an input is state"), &mut limbs);
            (id, Bits::from_limbs(self.program.value(id).width, &limbs))
        });
        let held: Held = held.collect();
        let code = self.make_edge(rising, &resets, &held);
        self.edges[index].special = Some(code);
        code
    }

    /// Whether functions are to check assertions.
    pub(super) fn check_asserts(&mut self, checked: bool) {
        if self.checked != checked {
            self.checked = checked;
            self.state.put(self.unchecked, &[u64::from(!checked)]);
        }
    }

    /// Makes the function for an edge, which checks the assertions of clocks not in reset, with inputs that are known.
    fn make_edge(&mut self, rising: &[usize], resets: &[bool], held: &Held) -> Code {
        let check = Maker::new(&self.program, held).check(rising, resets);
        let edge = Maker::new(&self.program, held).edge(rising);
        let functions: Vec<Function> = check.into_iter().chain([edge]).collect();
        let parts: Vec<Prepared> = functions.iter().map(|function| self.prepare(function)).collect();
        self.compile(&parts)
    }

    /// The registers of those clocks whose resets are high take their reset values.
    pub(super) fn reset(&mut self, rising: &[usize]) {
        let program = self.program.clone();
        for &clock in rising {
            if !self.resets[clock] {
                continue;
            }
            for &index in &program.clocks[clock].registers {
                let register = &program.registers[index as usize];
                start::reset(&program, register, self);
            }
        }
    }
}

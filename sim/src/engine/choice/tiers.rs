//! Two tiers: the interpreter runs a circuit until machine code is worth making.

use std::cell::Cell;

use crate::engine::choice::Started;
use crate::engine::program::{Program, ValueId};
use crate::engine::until::Until;
use crate::engine::{Difference, Done, Engine};

/// Making the code of a cell takes as long as the interpreter needs for this many limbs of results. This and what
/// follows were fitted to the designs of `tilewright bench`: the first cycle, and the time of each.
const LIMBS_TO_COMPILE: usize = 30_000;

/// An operation of the interpreter takes as long as this many limbs of its results, besides them.
const LIMBS_TO_BEGIN: usize = 40;

/// How long the interpreter runs.
#[derive(Debug, Default)]
pub(super) struct Early {
    /// The number of edges that it still executes.
    left: u64,
    /// The number of all its edges, if it is given.
    given: Option<u64>,
    /// For each clock: its reset is active.
    resets: Vec<bool>,
    /// The values that are read together.
    watched: Vec<Vec<ValueId>>,
    /// The values that are collected in rows.
    in_rows: Vec<Vec<ValueId>>,
}

impl Early {
    /// Of a run of a program from its start: that number of edges, or as long as making code would take.
    pub fn of(program: &Program, given: Option<u64>) -> Early {
        let (cells, limbs) = (program.circuit.len().max(1), program.schedule.storage);
        let worth = LIMBS_TO_COMPILE * cells / (LIMBS_TO_BEGIN * cells + limbs);
        let resets = vec![false; program.clocks.len()];
        Early { left: given.unwrap_or(worth as u64), given, resets, ..Early::default() }
    }

    /// The number of all its edges, if it is given.
    pub fn given(&self) -> Option<u64> {
        self.given
    }

    /// Whether code runs from now on.
    pub fn is_over(&self) -> bool {
        self.left == 0
    }
}

/// These methods of [`Engine`] count edges, or prepare what only code does.
impl Started {
    pub fn set_reset(&mut self, clock: usize, high: bool) {
        if let Some(reset) = self.early.resets.get_mut(clock) {
            *reset = high;
        }
        (**self).set_reset(clock, high);
    }

    pub fn edges(&mut self, rising: &[usize], count: u64) -> Result<Done, Box<Difference>> {
        if !self.early.is_over() {
            if count < self.early.left {
                self.early.left -= count;
            } else {
                self.make_code();
            }
        }
        (**self).edges(rising, count)
    }

    pub fn edges_until(
        &mut self,
        rising: &[usize],
        count: u64,
        until: &Until,
    ) -> Result<(Done, bool), Box<Difference>> {
        if self.early.is_over() {
            return (**self).edges_until(rising, count, until);
        }
        let first = count.min(self.early.left);
        let (done, holds) = (**self).edges_until(rising, first, until)?;
        if done.edges < self.early.left {
            self.early.left -= done.edges;
            return Ok((done, holds));
        }
        self.make_code();
        if holds || first == count {
            return Ok((done, holds));
        }
        let (more, holds) = (**self).edges_until(rising, count - first, until)?;
        Ok((Done { edges: done.edges + more.edges, changed: done.changed.with(more.changed) }, holds))
    }

    /// Makes code now if at least this many edges are to come and they repay it.
    pub fn expect(&mut self, edges: u64) {
        if !self.early.is_over() && self.early.given.is_none() && edges >= self.early.left {
            self.make_code();
        }
    }

    pub fn watch(&mut self, values: &[ValueId]) {
        if !self.early.is_over() {
            self.early.watched.push(values.to_vec());
        }
        (**self).watch(values);
    }

    /// The index is for [`Started::edges_in_rows`].
    pub fn take_in_rows(&mut self, values: &[ValueId]) -> Option<usize> {
        if self.early.is_over() {
            let index = (**self).take_in_rows(values)?;
            self.rows.push(Some(index));
            return Some(self.rows.len() - 1);
        }
        self.early.in_rows.push(values.to_vec());
        Some(self.early.in_rows.len() - 1)
    }

    pub fn edges_in_rows(&mut self, rows: usize, rising: &[usize], count: u64) -> Option<(Done, &[Cell<u64>])> {
        if !self.early.is_over() {
            if count < self.early.left {
                return None;
            }
            self.make_code();
        }
        let index = self.rows[rows]?;
        (**self).edges_in_rows(index, rising, count)
    }

    /// Goes on with code in place of the interpreter.
    #[cold]
    fn make_code(&mut self) {
        let early = std::mem::take(&mut self.early);
        let mut code = self.with_code();
        if let Some(mut interpreter) = self.interpreter.take() {
            for (clock, &high) in early.resets.iter().enumerate() {
                code.set_reset(clock, high);
            }
            interpreter.hand_over(&mut *code);
        }
        early.watched.iter().for_each(|values| code.watch(values));
        self.rows = early.in_rows.iter().map(|values| code.take_in_rows(values)).collect();
        self.early.given = early.given;
        self.compiled = code.into();
    }
}

#[cfg(test)]
mod tests {
    use crate::Simulation;
    use crate::testbench::for_examples::Counter;

    /// Whether there is code.
    fn is_code<I: tilewright_hdl::Bundle, O: tilewright_hdl::Bundle>(sim: &Simulation<I, O>) -> bool {
        sim.circuit.engine.compiled.get().is_some()
    }

    /// A run, and the edges after which it has code.
    macro_rules! counter {
        () => {{
            let sim = Simulation::of(&Counter).unwrap();
            let edges = sim.circuit.engine.early.left;
            assert!((100..10_000).contains(&edges), "{edges}");
            (sim, edges)
        }};
    }

    #[test]
    fn a_long_run_has_code_at_once_and_a_short_one_has_none() {
        let (mut sim, edges) = counter!();
        sim.run(edges - 1);
        assert!(!is_code(&sim));
        sim.step();
        assert!(is_code(&sim));

        let (mut sim, edges) = counter!();
        sim.run(edges);
        assert!(is_code(&sim));
    }

    #[test]
    fn a_run_that_is_told_its_length_has_code_at_once_if_it_is_long() {
        let (mut sim, edges) = counter!();
        sim.run(3);
        sim.expect(edges - 4);
        assert!(!is_code(&sim));
        sim.set(sim.i.enable, 1);
        sim.expect(edges - 3);
        assert!(is_code(&sim));
        sim.run(2);
        assert_eq!(sim.get_u64(sim.o.count), 2);
    }

    #[test]
    fn each_edge_counts_however_it_is_asked_for() {
        let (mut sim, edges) = counter!();
        sim.run_until(sim.o.count.is(1), 7);
        (0..edges - 8).for_each(|_| sim.step());
        assert!(!is_code(&sim));
        sim.step_clock("clk", 1);
        assert!(is_code(&sim));
    }
}

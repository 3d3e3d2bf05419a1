//! A testbench that looks every clock: what it looked at has been computed from the same state that the edge after it
//! starts from, so that edge can do with the rest; and as it is likely to look again, that follows in the same function.

use std::collections::{BTreeMap, BTreeSet};

use super::Compiled;
use super::function::Held;
use super::jit::Code;
use super::layout::Place;
use super::prepare::Prepared;
use crate::engine::program::{Circuit, Kind, Triggers, ValueId};

/// What is known of looks between edges.
#[derive(Default)]
pub(super) struct Looks {
    /// How many edges had one before them; it is not counted further once there is a function, or can be none.
    count: u64,
    rest: Option<Rest>,
}

/// Functions for what is left to do at an edge after a view has run.
#[derive(Clone, Copy)]
struct Rest {
    /// The view, and the edge, by index.
    view: usize,
    edge: usize,
    code: Code,
    /// The same, and then the view.
    followed: Code,
}

impl Compiled {
    /// One edge, where nothing has changed since somebody looked at something; whether it was done, if there is a
    /// function for it.
    pub(super) fn edge_after_look(&mut self, edge: usize, changes: Triggers) -> Option<bool> {
        let Some(rest) = self.looks.rest else {
            self.count_look(edge);
            return None;
        };
        if rest.edge != edge || self.views[rest.view].stale {
            return None;
        }
        let is_followed = std::mem::take(&mut self.looked);
        let is_done = self.call(if is_followed { rest.followed } else { rest.code }, 1) == 0;
        if is_done && is_followed {
            self.mark_others(rest.view, changes);
        } else if is_done {
            self.pending = changes;
        }
        Some(is_done)
    }

    fn count_look(&mut self, edge: usize) {
        self.looks.count = self.looks.count.saturating_add(1);
        if self.looks.count == self.program.passes.looks_after {
            let fresh = (0..self.views.len()).filter(|&view| !self.views[view].stale);
            let most = fresh.max_by_key(|&view| self.views[view].shown.len());
            self.looks.rest = most.and_then(|view| self.make_rest(view, edge));
        }
    }

    /// Has a view also leave what an edge needs of the same, and makes the function for the rest of that edge.
    fn make_rest(&mut self, view: usize, edge: usize) -> Option<Rest> {
        let shown = self.views[view].shown.clone();
        let (rising, resets) = self.edges[edge].clocks();
        let left = self.left_to(&shown, &rising, &resets);
        if left.is_empty() {
            return None;
        }
        let mut all = shown.clone();
        all.extend(left.iter().filter(|id| !shown.contains(id)));
        let prepared = self.prepare_view(&all);
        let code = self.compile(std::slice::from_ref(&prepared));
        self.replace_view(view, code, &shown, &prepared);
        let at: BTreeMap<ValueId, Place> = all.into_iter().zip(prepared.shown()).collect();
        let places: Vec<Place> = left.iter().map(|id| at[id]).collect();
        let mut parts = self.prepare_rest((&rising, &resets), &Held::default(), &left, &places);
        let code = self.compile(&parts);
        parts.push(prepared);
        Some(Rest { view, edge, code, followed: self.compile(&parts) })
    }

    /// What an edge needs first of what is computed for `shown` before it.
    pub(super) fn left_to(&self, shown: &[ValueId], rising: &[usize], resets: &[bool]) -> Vec<ValueId> {
        let program = &self.program;
        let sampled: Vec<ValueId> = rising.iter().flat_map(|&clock| program.sampled(clock, !resets[clock])).collect();
        border(&program.circuit, shown, &sampled)
    }

    /// Prepares the functions for an edge to which values that were computed before it are state, at these places.
    pub(super) fn prepare_rest(
        &mut self,
        (rising, resets): (&[usize], &[bool]),
        held: &Held,
        given: &[ValueId],
        places: &[Place],
    ) -> Vec<Prepared> {
        let functions = self.edge_functions(rising, resets, held, given);
        functions.iter().map(|function| self.prepare(function, places)).collect()
    }
}

/// What these values need first of what a view of `shown` computes, as far as it is a value of one lane and more than a
/// part of another.
fn border(circuit: &Circuit, shown: &[ValueId], values: &[ValueId]) -> Vec<ValueId> {
    let computed: BTreeSet<ValueId> = circuit.needed(shown.iter().copied()).into_iter().collect();
    let (mut seen, mut left) = (BTreeSet::new(), BTreeSet::new());
    let mut open = values.to_vec();
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        let cell = &circuit[id];
        let is_part = matches!(cell.kind, Kind::Const(_) | Kind::State | Kind::Slice(..) | Kind::Extend(..));
        if cell.lanes == 1 && !is_part && computed.contains(&id) {
            left.insert(id);
        } else {
            cell.kind.for_each_operand(|operand| open.push(operand));
        }
    }
    left.into_iter().collect()
}

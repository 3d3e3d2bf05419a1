//! A testbench that looks every clock: what it looked at has been computed from the same state that the edge after it
//! starts from, so that edge can do with the rest; and as it is likely to look again, that follows in the same function.

use std::collections::{BTreeMap, BTreeSet};

use super::Compiled;
use super::function::Held;
use super::jit::Code;
use super::layout::Place;
use super::prepare::Prepared;
use super::view::View;
use crate::engine::program::{Circuit, Kind, Triggers, ValueId};

/// What is known of looks between edges.
#[derive(Default)]
pub(super) struct Looks {
    /// How many edges had one before them; it is not counted further once there is a function, or can be none.
    count: u64,
    /// How many had one at what that function does not show.
    others: u64,
    rest: Option<Rest>,
}

/// A function for what is left to do at an edge after a view has run, and for that view after it.
#[derive(Clone, Copy)]
pub(super) struct Rest {
    /// The view, and the edge, by index.
    view: usize,
    edge: usize,
    code: Code,
}

impl Looks {
    /// The function for an edge after a look, if there is one.
    pub fn after(&self, edge: usize) -> Option<Rest> {
        self.rest.filter(|rest| rest.edge == edge)
    }
}

impl Compiled {
    /// An edge of the only clock where nothing has changed since somebody looked at something that is computed; whether it was
    /// done, if there is a function for it.
    #[inline(never)]
    pub(super) fn edge_after_look(&mut self) -> Option<bool> {
        self.looked = false;
        let ready = self.ready.as_ref()?;
        if self.pending != Triggers::NONE || !ready.is_only {
            return None;
        }
        let (edge, changes) = (ready.edge, ready.changes);
        let Some(rest) = ready.after_look else {
            self.count_look(edge);
            return None;
        };
        if self.views[rest.view].stale {
            return None;
        }
        let is_done = self.call(rest.code, 1) == 0;
        if is_done && self.views.len() > 1 {
            self.mark_others(rest, changes);
        }
        Some(is_done)
    }

    /// Counts an edge after a look; makes the function for such edges when there have been some.
    fn count_look(&mut self, edge: usize) {
        self.looks.count = self.looks.count.saturating_add(1);
        if self.looks.count == self.program.passes.looks_after {
            self.remake_rest(edge);
        }
    }

    #[cold]
    fn remake_rest(&mut self, edge: usize) {
        self.looks.others = 0;
        self.looks.rest = self.make_rest(edge);
        self.unready();
    }

    /// Marks what changes at an edge after which only one view has run.
    fn mark_others(&mut self, rest: Rest, changes: Triggers) {
        let changes_other = |(index, view): &(usize, &View)| *index != rest.view && view.triggers.meet(changes);
        if self.views.iter().enumerate().filter(changes_other).any(|(_, view)| !view.stale) {
            self.mark_fresh(rest, changes);
        }
    }

    /// Marks them where some are not yet; counts the edge, which was one after a look at more than its function shows, and
    /// makes another function when there have been some.
    #[cold]
    fn mark_fresh(&mut self, rest: Rest, changes: Triggers) {
        self.looks.others += 1;
        if self.looks.others >= self.program.passes.looks_after {
            self.remake_rest(rest.edge);
        }
        for (index, view) in self.views.iter_mut().enumerate() {
            view.stale |= index != rest.view && view.triggers.meet(changes);
        }
    }

    /// Has a view of all that was looked at also leave what an edge needs of the same, and makes the function for the rest
    /// of that edge.
    fn make_rest(&mut self, edge: usize) -> Option<Rest> {
        let fresh: Vec<&View> = self.views.iter().filter(|view| !view.stale).collect();
        let triggers = fresh.iter().fold(Triggers::NONE, |all, view| all.with(view.triggers));
        let shown: Vec<ValueId> = fresh.iter().flat_map(|view| &view.shown).copied().collect();
        let (rising, resets) = self.edges[edge].clocks();
        let left = self.left_to(&shown, &rising, &resets);
        if left.is_empty() {
            return None;
        }
        let mut all = shown.clone();
        all.extend(left.iter().filter(|id| !shown.contains(id)));
        let prepared = self.prepare_view(&all);
        let code = self.compile(std::slice::from_ref(&prepared));
        let view = self.add_view(code, triggers, &shown, &prepared);
        let at: BTreeMap<ValueId, Place> = all.into_iter().zip(prepared.shown()).collect();
        let places: Vec<Place> = left.iter().map(|id| at[id]).collect();
        let mut parts = self.prepare_rest((&rising, &resets), &Held::default(), &left, &places);
        parts.push(prepared);
        Some(Rest { view, edge, code: self.compile(&parts) })
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
        // What has turned out to be state itself stands where the edge changes it: to the edge, it is no other value.
        let is_apart = |(_, place): &(&ValueId, &Place)| !self.places.contains(&Some(**place));
        let (given, places): (Vec<ValueId>, Vec<Place>) = given.iter().zip(places).filter(is_apart).unzip();
        let functions = self.edge_functions(rising, resets, held, &given);
        functions.iter().map(|function| self.prepare(function, &places)).collect()
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

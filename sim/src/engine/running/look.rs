//! A testbench that looks at every clock: its values are computed from the same state from which the next edge
//! starts. So a *look* computes these values together with the changes of that edge. The edge itself only stores the
//! changes. The testbench will probably look again, so the next look follows in the same function.

use std::collections::BTreeSet;

use super::Compiled;
use super::prepare::Prepared;
use super::view::View;
use crate::engine::cranelift::Code;
use crate::engine::function::{Held, Maker};
use crate::engine::layout::Place;
use crate::engine::program::{Circuit, Kind, Triggers, ValueId};

/// The most values that a look computes for an edge, whatever it shows. Beyond that, it keeps only those that it
/// computes anyway.
const FEW: usize = 64;

/// Data about looks between edges.
#[derive(Default)]
pub(super) struct Looks {
    /// The number of edges after a look while there was no function for such edges.
    count: u64,
    /// The number of edges after a look at other values than that function shows.
    others: u64,
    rest: Option<Rest>,
}

/// Functions for edges between looks at the same values.
#[derive(Clone, Copy)]
pub(super) struct Rest {
    /// The view of these values, by index.
    view: u32,
    /// The edge, by index, and the inputs that they were made for, if any.
    edge: usize,
    held: Option<u64>,
    /// The look: stores all values of the view, and what the edge needs.
    look: Code,
    /// The rest of an edge after a look, and another look.
    code: Code,
}

impl Compiled {
    /// The functions for an edge between looks, if there are any.
    pub(super) fn rest_of(&self, edge: usize) -> Option<Rest> {
        let is_valid = |rest: &Rest| rest.edge == edge && (rest.held.is_none() || rest.held == self.held_version(edge));
        self.looks.rest.filter(is_valid)
    }

    /// An edge of the only clock after somebody looked at a computed value; returns whether it was done.
    #[inline(never)]
    pub(super) fn edge_after_look(&mut self) -> bool {
        let rest = self.rest_after_look();
        let is_done = self.begin_edge().is_some_and(|code| self.call(code, 1) == 0);
        if is_done && let Some(rest) = rest {
            self.mark();
            self.call(rest.look, 1);
            self.views[rest.view as usize].stale = false;
            self.fresh = rest.view;
            self.again = Some(rest.code);
        }
        is_done
    }

    /// The functions for the coming edge after a look, if another look at the same values is likely. Otherwise counts
    /// the edge, and makes functions after some of them.
    fn rest_after_look(&mut self) -> Option<Rest> {
        let ready = self.ready.as_ref().filter(|ready| ready.is_only && self.pending == Triggers::NONE)?;
        let (edge, changes) = (ready.edge, ready.changes);
        let Some(rest) = ready.after_look else {
            // Another edge, such as one of a reset, has none.
            if self.looks.rest.is_none_or(|rest| rest.edge == edge) {
                self.looks.count += 1;
                self.remake_rest_after(self.looks.count, edge);
            }
            return None;
        };
        let is_other = |(index, view): (u32, &View)| index != rest.view && !view.stale && view.triggers.meet(changes);
        if (0..).zip(&self.views).any(is_other) {
            self.looks.others += 1;
            self.remake_rest_after(self.looks.others, edge);
            return None;
        }
        Some(rest)
    }

    #[cold]
    fn remake_rest_after(&mut self, looks: u64, edge: usize) {
        if looks >= self.program.passes.looks_after {
            self.looks = Looks { count: 0, others: 0, rest: Some(self.make_rest(edge)) };
            self.unready();
        }
    }

    /// Makes functions for looks at everything that is up to date.
    fn make_rest(&mut self, edge: usize) -> Rest {
        let view = self.view_of_fresh();
        let held = self.held_version(edge);
        let known = if held.is_some() { self.held_inputs() } else { Held::default() };
        let (rising, resets) = self.edges[edge].clocks();
        let mut values = self.views[view as usize].shown.clone();
        let left = self.left_by_look(&values, &known, &rising, &resets);
        values.extend(left.iter().filter(|id| self.shown[id.index()].is_none_or(|(of, _)| of != view as usize)));
        let places: Vec<Place> = values.iter().map(|id| self.place_for_look(view, *id)).collect();
        let at = |id: &ValueId| places[values.iter().position(|value| value == id).expect("it is among them")];
        let left_at: Vec<Place> = left.iter().map(at).collect();
        let look = self.prepare_look(&known, &values, &places);
        let mut parts = self.prepare_rest((&rising, &resets), &known, &left, &left_at);
        let look_code = self.compile_once(std::slice::from_ref(&look));
        parts.push(look);
        Rest { view, edge, held, look: look_code, code: self.compile_once(&parts) }
    }

    /// A view of everything shown by up-to-date views.
    fn view_of_fresh(&mut self) -> u32 {
        let is_fresh = |(_, view): &(u32, &View)| !view.stale && !view.shown.is_empty();
        let fresh: Vec<(u32, &View)> = (0..).zip(&self.views).filter(is_fresh).collect();
        if let [(only, _)] = *fresh {
            return only;
        }
        let triggers = fresh.iter().fold(Triggers::NONE, |all, (_, view)| all.with(view.triggers));
        let shown: Vec<ValueId> = fresh.iter().flat_map(|(_, view)| &view.shown).copied().collect();
        let prepared = self.prepare_view(&shown);
        let code = self.compile(std::slice::from_ref(&prepared));
        self.add_view(code, triggers, &shown, &prepared) as u32
    }

    /// The values that a look keeps besides `shown`: values that are computed before the edge and that the edge
    /// needs.
    fn left_by_look(&self, shown: &[ValueId], held: &Held, rising: &[usize], resets: &[bool]) -> Vec<ValueId> {
        let mut maker = Maker::new(&self.program).hold(held);
        let mut is_computed = |id: ValueId| {
            let value = maker.take(id);
            !matches!(maker.kind(value), Kind::Const(_) | Kind::State)
        };
        let sampled = self.sampled(rising, resets);
        let all = border(&self.program.circuit, &sampled, &sampled);
        let left = if all.len() <= FEW { all } else { border(&self.program.circuit, shown, &sampled) };
        left.into_iter().filter(|id| is_computed(*id)).collect()
    }

    /// The place where a look stores a value: that of the view, if the view shows it.
    fn place_for_look(&mut self, view: u32, id: ValueId) -> Place {
        match self.shown[id.index()] {
            Some((of, place)) if of == view as usize => place,
            _ => self.layout.place(1, self.program.circuit[id].width),
        }
    }

    /// A function that stores values at these places.
    fn prepare_look(&mut self, held: &Held, values: &[ValueId], places: &[Place]) -> Prepared {
        let (values, places) = self.apart(values, places);
        let mut maker = Maker::new(&self.program);
        let own = maker.own(&values);
        let mut maker = maker.hold(held);
        maker.leave(&values, &own);
        self.prepare(&maker.finish().0, &places)
    }

    /// The values that are neither state themselves nor tables: those stay where an edge changes them, or as they are.
    fn apart(&self, values: &[ValueId], places: &[Place]) -> (Vec<ValueId>, Vec<Place>) {
        let is_apart =
            |(_, place): &(&ValueId, &Place)| !self.places.contains(&Some(**place)) && !self.layout.is_limited(**place);
        values.iter().zip(places).filter(is_apart).unzip()
    }

    /// The values that an edge samples.
    fn sampled(&self, rising: &[usize], resets: &[bool]) -> Vec<ValueId> {
        rising.iter().flat_map(|&clock| self.program.sampled(clock, !resets[clock])).collect()
    }

    /// The values computed for `shown` that an edge needs.
    pub(super) fn left_to(&self, shown: &[ValueId], rising: &[usize], resets: &[bool]) -> Vec<ValueId> {
        border(&self.program.circuit, shown, &self.sampled(rising, resets))
    }

    /// Prepares the functions for an edge for which values computed before it are state, at these places.
    pub(super) fn prepare_rest(
        &mut self,
        (rising, resets): (&[usize], &[bool]),
        held: &Held,
        given: &[ValueId],
        places: &[Place],
    ) -> Vec<Prepared> {
        let (given, places) = self.apart(given, places);
        let functions = self.edge_functions(rising, resets, held, &given);
        functions.iter().map(|function| self.prepare_edge(function, &places)).collect()
    }
}

/// The values of a view of `shown` that these values need first, if they have one lane and are more than a slice of
/// another.
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

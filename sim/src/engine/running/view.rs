//! The interface to a testbench: functions that store values for reading, and fast paths for single numbers.

use std::cell::Cell;
use std::collections::BTreeMap;

use rustc_hash::FxHashSet;

use super::prepare::Prepared;
use super::{Compiled, HELD};
use crate::engine::Engine;
use crate::engine::cranelift::Code;
use crate::engine::function::Maker;
use crate::engine::layout::Place;
use crate::engine::program::{Triggers, ValueId};

/// A function that stores values for reading.
pub(super) struct View {
    code: Code,
    /// The triggers of what it shows, and whether they have fired since it last ran.
    pub triggers: Triggers,
    pub stale: bool,
    /// What it shows.
    pub shown: Vec<ValueId>,
}

/// The index of no view.
pub(super) const NO_VIEW: u32 = u32::MAX;

/// The place of a value of one lane and up to 64 bits, which is a limb.
#[derive(Clone, Copy)]
pub(crate) struct Slot {
    /// The limb.
    at: u32,
    source: Source,
}

/// What stores a value in its slot.
#[derive(Clone, Copy)]
enum Source {
    /// It is an input, or an edge changes it.
    State,
    /// It is an input that functions are made for.
    Held,
    /// A view, by index.
    View(u32),
}

impl Slot {
    /// Another kind of value, or one that has no place yet. No store is large enough to have a limb there.
    pub const NONE: Slot = Slot { at: u32::MAX, source: Source::State };

    /// The slot of state.
    pub(super) fn of_state(place: &Place) -> Slot {
        Slot::of(place, if place.width <= HELD { Source::Held } else { Source::State })
    }

    fn of(place: &Place, source: Source) -> Slot {
        if place.lanes > 1 || place.width > 64 {
            return Slot::NONE;
        }
        Slot { at: (place.offset / 8) as u32, source }
    }
}

impl Compiled {
    /// The place of a value, brought up to date if it is computed; `None` for constants.
    pub(super) fn place(&mut self, id: ValueId) -> Option<Place> {
        match self.places[id.index()] {
            None if self.program.value(id).segment.is_some() => Some(self.view(id)),
            place => place,
        }
    }

    /// Brings a computed value up to date; returns its place.
    fn view(&mut self, id: ValueId) -> Place {
        let view = self.view_of(id);
        self.refresh(view);
        self.shown[id.index()].expect("it is shown").1
    }

    /// The view of a computed value. Output ports of up to 64 bits that change together share a function. Wider ones,
    /// which are often assembled from many lanes, have one each.
    #[inline]
    fn view_of(&mut self, id: ValueId) -> usize {
        match &self.shown[id.index()] {
            Some((view, _)) => *view,
            None => self.make_view(id),
        }
    }

    #[cold]
    fn make_view(&mut self, id: ValueId) -> usize {
        let is_narrow = |id: &ValueId| self.program.value(*id).width <= 64;
        let outputs: Vec<ValueId> = self.program.outputs.iter().map(|port| port.value).filter(is_narrow).collect();
        self.show(if outputs.contains(&id) { &outputs } else { std::slice::from_ref(&id) });
        self.shown[id.index()].expect("it is shown now").0
    }

    /// Brings the values of a view up to date.
    #[inline]
    fn refresh(&mut self, view: usize) {
        self.looked = true;
        self.mark();
        let shows = &mut self.views[view];
        if std::mem::take(&mut shows.stale) {
            let code = shows.code;
            self.call(code, 1);
            self.again = None;
        }
        self.fresh = view as u32;
    }

    /// The number in a slot of this engine, if it is up to date.
    #[inline]
    pub(in crate::engine) fn quick_get(&mut self, slot: Slot) -> Option<u64> {
        if let Source::View(view) = slot.source {
            if view != self.fresh {
                return None;
            }
            self.looked = true;
        }
        self.state.limbs().get(slot.at as usize).map(Cell::get)
    }

    /// The number in a slot of this engine, brought up to date, if it has a place.
    #[inline]
    pub(in crate::engine) fn refreshed(&mut self, slot: Slot) -> Option<u64> {
        if let Source::View(view) = slot.source {
            self.refresh(view as usize);
        }
        self.state.limbs().get(slot.at as usize).map(Cell::get)
    }

    /// Sets an input that has a slot of this engine; returns `false` and does nothing if it has none. It contains no
    /// call and nothing that can fail, so it needs no stack.
    #[inline]
    pub(in crate::engine) fn quick_set(&mut self, slot: Slot, number: u64, triggers: Triggers) -> bool {
        let Some(is_other) = self.state.replace_limb(slot.at as usize, number) else { return false };
        if is_other {
            self.input_changed(triggers, matches!(slot.source, Source::Held));
        }
        true
    }

    /// The slot of a value.
    pub(in crate::engine) fn slot(&self, id: ValueId) -> Slot {
        self.slots[id.index()]
    }

    /// Notes the places of numbers, and the views to refresh before reading them: see [`Engine::renew`].
    #[cold]
    pub(super) fn note(&mut self, ids: &[ValueId], note: &mut Vec<u32>) {
        let mut views = Vec::new();
        for &id in ids {
            // A value without a place gets one, unless it is a constant.
            self.number(id, 0);
            if let Source::View(view) = self.slots[id.index()].source {
                views.push(view);
            }
        }
        views.sort_unstable();
        views.dedup();
        note.clear();
        note.extend([self.version, views.len() as u32]);
        note.extend(views);
        note.extend(ids.iter().map(|id| self.slots[id.index()].at));
    }

    /// Like [`Engine::renew`].
    pub(super) fn renew_noted(&mut self, note: &[u32], seen: &mut [u64], changed: &mut Vec<u32>) {
        let (views, places) = note[2..].split_at(note[1] as usize);
        views.iter().for_each(|&view| self.refresh(view as usize));
        changed.resize(seen.len(), 0);
        let (limbs, mut count) = (self.state.limbs(), 0);
        for ((&at, seen), index) in places.iter().zip(seen).zip(0..) {
            // A constant has no place and never changes.
            let number = limbs.get(at as usize).map_or(*seen, Cell::get);
            // Whether a number has changed is hard to predict, so there is no branch.
            changed[count] = index;
            count += usize::from(*seen != number);
            *seen = number;
        }
        changed.truncate(count);
    }

    /// Many inputs may change between two edges, so this depends on no recent store.
    #[inline]
    pub(super) fn input_changed(&mut self, triggers: Triggers, is_held: bool) {
        if !triggers.within(self.pending) {
            self.change(triggers);
        }
        self.stirred = true;
        if is_held {
            self.held_changed = true;
            self.quick = None;
        }
    }

    /// Notes a change.
    #[inline]
    pub(super) fn change(&mut self, triggers: Triggers) {
        self.pending = self.pending.with(triggers);
        self.fresh = NO_VIEW;
        self.again = None;
    }

    /// Flags what pending changes make stale.
    #[inline]
    pub(super) fn mark(&mut self) {
        let pending = std::mem::replace(&mut self.pending, Triggers::NONE);
        if pending != Triggers::NONE {
            for view in &mut self.views {
                view.stale |= view.triggers.meet(pending);
            }
            self.age_glances();
        }
    }

    /// Makes functions for those of these values that are computed; those that change together are computed together.
    pub(super) fn show(&mut self, values: &[ValueId]) {
        let triggers = |id: ValueId| {
            let segment = self.program.value(id).segment?;
            Some(self.program.schedule.segments[segment as usize].triggers)
        };
        let mut groups: BTreeMap<Triggers, Vec<ValueId>> = BTreeMap::new();
        for &id in values {
            if let Some(triggers) = triggers(id) {
                groups.entry(triggers).or_default().push(id);
            }
        }
        for (triggers, mut shown) in groups {
            shown.sort();
            shown.dedup();
            let prepared = self.prepare_view(&shown);
            let code = self.compile(std::slice::from_ref(&prepared));
            self.add_view(code, triggers, &shown, &prepared);
        }
    }

    /// The function that shows these values.
    pub(super) fn prepare_view(&mut self, shown: &[ValueId]) -> Prepared {
        let mut maker = Maker::new(&self.program);
        maker.show(shown);
        self.prepare(&maker.finish().0, &[])
    }

    /// Makes a function the view of these values, which are the first that it shows; no other view shows them from
    /// now on. Returns its index.
    pub(super) fn add_view(&mut self, code: Code, triggers: Triggers, shown: &[ValueId], prepared: &Prepared) -> usize {
        let view = self.views.len();
        for (id, place) in shown.iter().zip(prepared.shown()) {
            self.shown[id.index()] = Some((view, place));
            self.slots[id.index()] = Slot::of(&place, Source::View(view as u32));
        }
        let now: FxHashSet<ValueId> = shown.iter().copied().collect();
        self.views.iter_mut().for_each(|view| view.shown.retain(|id| !now.contains(id)));
        self.views.push(View { code, triggers, stale: true, shown: shown.to_vec() });
        self.version += 1;
        view
    }
}

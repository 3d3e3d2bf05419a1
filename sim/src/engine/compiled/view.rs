//! What a testbench sets and looks at: functions that leave values where they can be read, and quick ways to single numbers.

use std::cell::Cell;
use std::collections::BTreeMap;

use super::function::Maker;
use super::jit::Code;
use super::layout::Place;
use super::prepare::Prepared;
use super::{Compiled, HELD};
use crate::engine::Engine;
use crate::engine::program::{Triggers, ValueId};

/// A function that leaves values where they can be read.
pub(super) struct View {
    code: Code,
    /// What changes what it shows, and whether it has since it was last run.
    pub triggers: Triggers,
    pub stale: bool,
    /// What it shows.
    pub shown: Vec<ValueId>,
}

/// Where a value is that has one lane and up to 64 bits, and so stands as its limb.
#[derive(Clone, Copy)]
pub(crate) struct Slot(u32);

impl Slot {
    /// Another kind of value, or one that has no place yet. No store is so large that it has a limb there.
    pub const NONE: Slot = Slot(u32::MAX);
    /// Functions are made for such an input.
    const NARROW: u32 = 1;
    const COMPUTED: u32 = 2;

    /// That of a place, which is computed or state.
    pub(super) fn of(place: &Place, computed: bool) -> Slot {
        if place.lanes > 1 || place.width > 64 {
            return Slot::NONE;
        }
        let narrow = if place.width <= HELD { Slot::NARROW } else { 0 };
        Slot((place.offset / 8) as u32 * 4 + narrow + if computed { Slot::COMPUTED } else { 0 })
    }

    #[inline]
    pub fn limb(self) -> Option<usize> {
        (self.0 != Slot::NONE.0).then_some(self.at())
    }

    /// As [`Slot::limb`], where there is one.
    #[inline]
    fn at(self) -> usize {
        self.0 as usize / 4
    }

    #[inline]
    pub fn is_narrow(self) -> bool {
        self.0 & Slot::NARROW != 0
    }

    #[inline]
    pub fn is_computed(self) -> bool {
        self.0 & Slot::COMPUTED != 0
    }
}

impl Compiled {
    /// Where a value is, brought up to date if it is computed; `None` for constants.
    pub(super) fn place(&mut self, id: ValueId) -> Option<Place> {
        match self.places[id.index()] {
            None if self.program.value(id).segment.is_some() => Some(self.view(id)),
            place => place,
        }
    }

    /// Brings a value that is computed up to date; gives where it is.
    fn view(&mut self, id: ValueId) -> Place {
        let view = self.view_of(id);
        self.refresh(view);
        self.shown[id.index()].expect("it is shown").1
    }

    /// What shows a value that is computed. All output ports share a function, as far as they change together.
    #[inline]
    fn view_of(&mut self, id: ValueId) -> usize {
        match &self.shown[id.index()] {
            Some((view, _)) => *view,
            None => self.make_view(id),
        }
    }

    #[cold]
    fn make_view(&mut self, id: ValueId) -> usize {
        let outputs: Vec<ValueId> = self.program.outputs.iter().map(|port| port.value).collect();
        self.show(if outputs.contains(&id) { &outputs } else { std::slice::from_ref(&id) });
        self.shown[id.index()].expect("it is shown now").0
    }

    /// Brings what a function shows up to date.
    #[inline]
    fn refresh(&mut self, view: usize) {
        self.looked = true;
        self.mark();
        let shows = &mut self.views[view];
        if std::mem::take(&mut shows.stale) {
            let code = shows.code;
            self.call(code, 1);
            self.some_stale = self.views.len() > 1 && self.views.iter().any(|view| view.stale);
        }
    }

    /// Whether all that is shown is up to date.
    #[inline]
    pub(super) fn is_settled(&self) -> bool {
        self.pending == Triggers::NONE && !self.some_stale
    }

    /// As [`Engine::number`].
    #[inline]
    pub(in crate::engine) fn get_number(&mut self, id: ValueId, lane: u32) -> u64 {
        let slot = self.slots[id.index()];
        match slot.limb() {
            Some(at) if !slot.is_computed() => self.state.limb(at),
            Some(at) if self.is_settled() => {
                self.looked = true;
                self.state.limb(at)
            }
            _ => self.computed(id, lane),
        }
    }

    /// Sets an input that stands in a slot of this engine; `false`, and nothing is done, if it is none. There is no call in it,
    /// nor anything that can fail, so that it takes no room on the stack.
    #[inline]
    pub(in crate::engine) fn quick_set(&mut self, slot: Slot, number: u64, triggers: Triggers) -> bool {
        let Some(is_other) = self.state.replace_limb(slot.at(), number) else { return false };
        if is_other {
            self.input_changed(triggers, slot.is_narrow());
        }
        true
    }

    /// Where a value stands.
    pub(in crate::engine) fn slot(&self, id: ValueId) -> Slot {
        self.slots[id.index()]
    }

    /// Notes where numbers stand, and what is to be brought up to date before: see [`Engine::renew`].
    #[cold]
    pub(super) fn note(&mut self, ids: &[ValueId], note: &mut Vec<u32>) {
        let mut views = Vec::new();
        for &id in ids {
            // Whatever has no place yet gets one, but for constants.
            self.number(id, 0);
            let slot = self.slots[id.index()];
            if slot.limb().is_some() && slot.is_computed() {
                views.push(self.view_of(id) as u32);
            }
        }
        views.sort_unstable();
        views.dedup();
        note.clear();
        note.extend([self.version, views.len() as u32]);
        note.extend(views);
        note.extend(ids.iter().map(|id| self.slots[id.index()].at() as u32));
    }

    /// As [`Engine::renew`].
    pub(super) fn renew_noted(&mut self, note: &[u32], seen: &mut [u64], changed: &mut Vec<u32>) {
        let (views, places) = note[2..].split_at(note[1] as usize);
        views.iter().for_each(|&view| self.refresh(view as usize));
        changed.resize(seen.len(), 0);
        let (limbs, mut count) = (self.state.limbs(), 0);
        for ((&at, seen), index) in places.iter().zip(seen).zip(0..) {
            // A constant stands nowhere, and remains what it is.
            let number = limbs.get(at as usize).map_or(*seen, Cell::get);
            // Whether a number has changed is hard to foresee, and so no branch.
            changed[count] = index;
            count += usize::from(*seen != number);
            *seen = number;
        }
        changed.truncate(count);
    }

    /// One lane of a value of up to 64 bits, where that takes more than a look.
    pub(super) fn computed(&mut self, id: ValueId, lane: u32) -> u64 {
        if let Some(at) = self.slots[id.index()].limb() {
            let view = self.view_of(id);
            self.refresh(view);
            return self.state.limb(at);
        }
        match self.place(id) {
            Some(place) => self.state.number(place, lane),
            None => self.read(id)[lane as usize],
        }
    }

    /// Many inputs may change between two edges, so this waits for nothing that was stored a moment ago.
    #[inline]
    pub(super) fn input_changed(&mut self, triggers: Triggers, is_narrow: bool) {
        if !triggers.within(self.pending) {
            self.pending = self.pending.with(triggers);
        }
        if is_narrow {
            self.held_changed = true;
        }
    }

    /// Marks what pending changes make stale.
    #[inline]
    fn mark(&mut self) {
        let pending = std::mem::replace(&mut self.pending, Triggers::NONE);
        if pending != Triggers::NONE {
            for view in &mut self.views {
                view.stale |= view.triggers.meet(pending);
                self.some_stale |= view.stale;
            }
        }
    }

    /// As [`Compiled::mark`], where nothing is pending but these changes, which one view shows already.
    pub(super) fn mark_others(&mut self, but: usize, changes: Triggers) {
        for (index, view) in self.views.iter_mut().enumerate() {
            view.stale |= index != but && view.triggers.meet(changes);
            self.some_stale |= view.stale;
        }
    }

    /// Makes functions for these values, as far as they are computed; those that change together are computed together.
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
            let view = self.views.len();
            self.views.push(View { code, triggers, stale: true, shown: shown.clone() });
            self.some_stale = true;
            self.replace_view(view, code, &shown, &prepared);
        }
    }

    /// What shows these values.
    pub(super) fn prepare_view(&mut self, shown: &[ValueId]) -> Prepared {
        let mut maker = Maker::new(&self.program);
        maker.show(shown);
        self.prepare(&maker.finish().0, &[])
    }

    /// Has another function show these values, which are the first that it shows; it is to run before the next look.
    pub(super) fn replace_view(&mut self, view: usize, code: Code, shown: &[ValueId], prepared: &Prepared) {
        for (id, place) in shown.iter().zip(prepared.shown()) {
            self.shown[id.index()] = Some((view, place));
            self.slots[id.index()] = Slot::of(&place, true);
        }
        self.version += 1;
        (self.views[view].code, self.views[view].stale, self.some_stale) = (code, true, true);
    }
}

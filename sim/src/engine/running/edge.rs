//! The functions for edges, and when each is made.

use tilewright_circuit::Bits;

use super::Compiled;
use super::look::Rest;
use crate::engine::cranelift::Code;
use crate::engine::function::{Function, Held, Maker};
use crate::engine::program::{Triggers, ValueId};
use crate::engine::{Done, start};

/// A function for an edge.
pub(super) struct Edge {
    /// The clocks that rise.
    rising: Vec<usize>,
    /// The active resets, if they decide which assertions it checks.
    resets: Vec<bool>,
    code: Code,
    /// What changes at it.
    pub changes: Triggers,
    /// The version of the inputs, and the number of edges since.
    inputs_version: u64,
    quiet: u64,
    /// A function for these inputs.
    special: Option<Code>,
}

impl Edge {
    /// The clocks that rise, and the active resets.
    pub fn clocks(&self) -> (Vec<usize>, Vec<bool>) {
        (self.rising.clone(), self.resets.clone())
    }

    /// This number of the requested edges has not been executed.
    fn give_back(&mut self, edges: u64) {
        self.quiet = self.quiet.saturating_sub(edges);
    }

    /// This number of edges was executed with the present inputs.
    pub fn pass(&mut self, edges: u64) {
        self.quiet = self.quiet.saturating_add(edges);
    }
}

/// The function to call for edges of one clock as long as only state changes.
pub(super) struct Ready {
    clock: usize,
    /// There is no other clock.
    pub is_only: bool,
    /// By index.
    pub edge: usize,
    code: Code,
    pub changes: Triggers,
    /// The function to call for an edge after a look.
    pub after_look: Option<Rest>,
}

impl Ready {
    /// The function to call.
    pub fn code(&self) -> Code {
        self.code
    }
}

/// The function for an edge of the only clock, which may be called immediately.
#[derive(Clone, Copy)]
pub(super) struct Quick {
    code: Code,
    changes: Triggers,
}

impl Compiled {
    /// Executes `count` edges of these clocks.
    #[inline]
    pub(super) fn usual_edges(&mut self, rising: &[usize], count: u64) -> Done {
        match self.ready_edges(rising, count) {
            Some(done) => done,
            None => self.other_edges(rising, count),
        }
    }

    /// Executes `count` edges of these clocks, if the function to call is known.
    #[inline]
    pub(super) fn ready_edges(&mut self, rising: &[usize], count: u64) -> Option<Done> {
        let &[clock] = rising else { return None };
        if self.held_changed || !self.is_ready(clock) || count > self.ready_for {
            return None;
        }
        let ready = self.ready.as_ref()?;
        let (code, changed) = (ready.code, ready.changes);
        self.spend(count);
        self.looked = false;
        let edges = count - self.call(code, count);
        self.change(changed);
        Some(Done { edges, changed })
    }

    /// Whether the function for edges of a clock is known; with several clocks, each may rise while another one is
    /// ready.
    #[inline]
    fn is_ready(&mut self, clock: usize) -> bool {
        if self.ready.as_ref().is_some_and(|ready| ready.clock == clock) {
            return true;
        }
        let Some(parked) = self.parked.get_mut(clock).and_then(Option::take) else { return false };
        self.park();
        (self.ready, self.ready_for) = (Some(parked.0), parked.1);
        true
    }

    /// Stores the ready function until its clock rises again.
    fn park(&mut self) {
        if let Some(ready) = self.ready.take() {
            let clock = ready.clock;
            self.parked[clock] = Some((ready, self.ready_for));
        }
    }

    /// Executes an edge of the only clock, if the function is known; returns whether it did. A testbench does little
    /// else in every cycle, so it is short, and inlined.
    #[inline]
    pub(in crate::engine) fn quick_edge(&mut self) -> bool {
        let code = match (std::mem::take(&mut self.looked), self.again) {
            (true, Some(code)) => {
                // It refreshes the view that is looked at, and nothing else.
                self.age_glances();
                code
            }
            (true, None) => return self.edge_after_look(),
            (false, _) => match self.begin_edge() {
                Some(code) => code,
                None => return false,
            },
        };
        self.call(code, 1) == 0
    }

    /// The function to call for an edge of the only clock, which the caller must then execute, if it is known.
    #[inline]
    pub(super) fn begin_edge(&mut self) -> Option<Code> {
        let Quick { code, changes } = self.quick?;
        self.spend(1);
        self.change(changes);
        Some(code)
    }

    /// Subtracts executed edges from those for which the function is known.
    #[inline]
    fn spend(&mut self, edges: u64) {
        self.ready_for -= edges;
        if self.ready_for == 0 {
            self.quick = None;
        }
    }

    /// Executes `count` edges of these clocks, after looking up their function.
    pub(super) fn other_edges(&mut self, rising: &[usize], count: u64) -> Done {
        if count == 0 {
            return Done { edges: 0, changed: Triggers::NONE };
        }
        self.put_away(rising);
        self.looked = false;
        let index = self.edge(rising);
        let code = self.edge_code(index, count);
        let changed = self.edges[index].changes;
        let mut left = count;
        if self.any_reset {
            while left > 0 && self.call(code, 1) == 0 {
                self.reset(rising);
                left -= 1;
            }
        } else {
            self.make_ready(index, code);
            left = self.call_with_versions(code, count);
        }
        self.change(changed);
        Done { edges: count - left, changed }
    }

    fn make_ready(&mut self, index: usize, code: Code) {
        let mut count = self.edges_until_versions();
        let edge = &mut self.edges[index];
        let &[clock] = edge.rising.as_slice() else { return };
        if edge.special.is_none() && self.special > 0 && !self.inputs.is_empty() {
            count = count.min(self.held_after.saturating_sub(edge.quiet));
            edge.quiet += count;
        }
        let (is_only, changes) = (self.resets.len() == 1, edge.changes);
        let after_look = self.rest_of(index);
        self.ready = Some(Ready { clock, is_only, edge: index, code, changes, after_look });
        self.ready_for = count;
        self.quick = (is_only && count > 0).then_some(Quick { code, changes });
    }

    /// Forgets the ready function: that for edges of these clocks must be looked up.
    fn put_away(&mut self, rising: &[usize]) {
        // If there are versions, the ready function is looked up again every few edges.
        if self.parked.is_empty() || self.held_changed || !self.versions.is_empty() {
            return self.unready();
        }
        self.park();
        if let &[clock] = rising
            && let Some((ready, left)) = self.parked[clock].take()
        {
            self.edges[ready.edge].give_back(left);
        }
    }

    /// With several clocks, moves the ready functions to those of their clocks, except for those made for other
    /// inputs.
    pub(super) fn renew_ready(&mut self) {
        self.park();
        if !std::mem::take(&mut self.held_changed) {
            return;
        }
        self.inputs_version += 1;
        for parked in &mut self.parked {
            let Some((ready, left)) = parked else { continue };
            let edge = &mut self.edges[ready.edge];
            (edge.inputs_version, edge.quiet) = (self.inputs_version, 0);
            if edge.special.take().is_some() {
                *parked = None;
            } else if self.special > 0 {
                *left = self.held_after;
                edge.quiet = *left;
            }
        }
    }

    /// The function to call must be looked up again.
    #[cold]
    pub(super) fn unready(&mut self) {
        self.again = None;
        self.quick = None;
        let ready = self.ready.take().map(|ready| (ready, self.ready_for));
        for (ready, left) in ready.into_iter().chain(self.parked.iter_mut().filter_map(Option::take)) {
            self.edges[ready.edge].give_back(left);
        }
    }

    /// The edge of these clocks, by index.
    ///
    /// Registers are reset after its function has run. So one function serves with and without resets, except for the
    /// assertions that it checks: a circuit that begins with a reset needs one function, not two.
    pub(super) fn edge(&mut self, rising: &[usize]) -> usize {
        if let Some((latest, checked)) = self.latest
            && self.edges[latest].rising.iter().eq(rising)
        {
            self.check_asserts(checked);
            return latest;
        }
        let mut asserting = rising.iter().filter(|&&clock| !self.program.clocks[clock].asserts.is_empty()).peekable();
        let states_something = asserting.peek().is_some();
        let unchecked = asserting.all(|&clock| self.resets[clock]);
        if states_something {
            self.check_asserts(!unchecked);
        }
        let matches = |of: &[bool]| if unchecked { !of.contains(&true) } else { *of == *self.resets };
        let made = self.edges.iter().position(|edge| edge.rising.iter().eq(rising) && matches(&edge.resets));
        let index = made.unwrap_or_else(|| {
            let resets = if unchecked { vec![false; self.resets.len()] } else { self.resets.clone() };
            let code = self.make_edge(rising, &resets, &Held::default());
            let changes = rising.iter().fold(Triggers::NONE, |all, &clock| all.with(Triggers::state(clock)));
            let rising = rising.to_vec();
            self.edges.push(Edge { rising, resets, code, changes, inputs_version: 0, quiet: 0, special: None });
            self.edges.len() - 1
        });
        self.latest = Some((index, self.checked));
        index
    }

    /// The function for `count` runs of an edge; inputs that have not changed for long are folded in.
    pub(super) fn edge_code(&mut self, index: usize, count: u64) -> Code {
        self.inputs_version += u64::from(std::mem::take(&mut self.held_changed));
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
        if edge.quiet < self.held_after || self.special == 0 || self.inputs.is_empty() {
            return code;
        }
        self.make_special(index)
    }

    /// The function for an edge with the present inputs.
    #[cold]
    fn make_special(&mut self, index: usize) -> Code {
        self.special -= 1;
        let (rising, resets) = self.edges[index].clocks();
        let held = self.held_inputs();
        let code = self.make_edge(&rising, &resets, &held);
        self.edges[index].special = Some(code);
        code
    }

    /// The version of the inputs that functions are made for, if they have not changed for long at this edge.
    pub(super) fn held_version(&self, index: usize) -> Option<u64> {
        self.is_special(index).then_some(self.inputs_version)
    }

    /// Whether an edge has a function for the present inputs.
    pub(super) fn is_special(&self, index: usize) -> bool {
        let edge = &self.edges[index];
        edge.special.is_some() && edge.inputs_version == self.inputs_version && !self.held_changed
    }

    /// The present values of the inputs that functions may be made for.
    pub(super) fn held_inputs(&self) -> Held {
        let held = self.inputs.iter().map(|&id| {
            let place = self.places[id.index()].expect("an input is state");
            (id, Bits::new(place.width, self.state.number(place, 0)))
        });
        held.collect()
    }

    /// Sets whether functions check assertions.
    pub(super) fn check_asserts(&mut self, checked: bool) {
        if self.checked != checked {
            self.checked = checked;
            self.unready();
            self.state.put(self.unchecked, &[u64::from(!checked)]);
        }
    }

    /// Makes the function for an edge with known inputs; it checks the assertions of clocks not in reset.
    fn make_edge(&mut self, rising: &[usize], resets: &[bool], held: &Held) -> Code {
        let parts = self.prepare_edges(rising, resets, held);
        self.compile(&parts)
    }

    /// The parts of a function for an edge, in sequence; the values in `given` are computed before.
    pub(super) fn edge_functions(
        &self,
        rising: &[usize],
        resets: &[bool],
        held: &Held,
        given: &[ValueId],
    ) -> Vec<Function> {
        let maker = || Maker::new(&self.program).give(given).hold(held);
        maker().check(rising, resets).into_iter().chain([maker().edge(rising).0]).collect()
    }

    /// Resets the registers of those clocks whose resets are high.
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
        self.wake();
    }
}

//! The functions for edges: which there are, and when one is made.

use tilewright_hdl::Bits;

use super::Compiled;
use super::function::{Function, Held, Maker};
use super::jit::Code;
use super::look::Rest;
use crate::engine::program::{Triggers, ValueId};
use crate::engine::{Done, start};

/// A function for an edge.
pub(super) struct Edge {
    /// The clocks that rise.
    rising: Vec<usize>,
    /// The resets that are high where that decides which assertions it checks.
    resets: Vec<bool>,
    code: Code,
    /// What changes at it.
    pub changes: Triggers,
    /// Since when inputs are as they are, and for how many edges.
    inputs_version: u64,
    quiet: u64,
    /// A function for these inputs.
    special: Option<Code>,
}

impl Edge {
    /// The clocks that rise, and the resets that are high.
    pub fn clocks(&self) -> (Vec<usize>, Vec<bool>) {
        (self.rising.clone(), self.resets.clone())
    }

    /// So many of those that were to be done have not been.
    fn give_back(&mut self, edges: u64) {
        self.quiet = self.quiet.saturating_sub(edges);
    }

    /// So many were done with inputs as they are.
    pub fn pass(&mut self, edges: u64) {
        self.quiet = self.quiet.saturating_add(edges);
    }
}

/// What is to be called for edges of one clock as long as nothing changes but state.
pub(super) struct Ready {
    clock: usize,
    /// There is no other.
    pub is_only: bool,
    /// By index.
    pub edge: usize,
    code: Code,
    pub changes: Triggers,
    /// What is to be called for an edge after a look.
    pub after_look: Option<Rest>,
}

impl Ready {
    /// What to call.
    pub fn code(&self) -> Code {
        self.code
    }
}

/// What is ready for an edge of the only clock, which may be called at once.
#[derive(Clone, Copy)]
pub(super) struct Quick {
    code: Code,
    changes: Triggers,
}

impl Compiled {
    /// So many edges of these clocks.
    #[inline]
    pub(super) fn usual_edges(&mut self, rising: &[usize], count: u64) -> Done {
        match self.ready_edges(rising, count) {
            Some(done) => done,
            None => self.other_edges(rising, count),
        }
    }

    /// So many edges of these clocks, if it is known what to call for them.
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

    /// Whether it is known what to call for edges of a clock; of several, each may rise while another one is ready.
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

    /// Keeps what is ready for when its clock rises again.
    fn park(&mut self) {
        if let Some(ready) = self.ready.take() {
            let clock = ready.clock;
            self.parked[clock] = Some((ready, self.ready_for));
        }
    }

    /// An edge of the only clock, if it is known what to call for it; whether it was done. A testbench does this and little
    /// else in every cycle, so it is short, and part of its code.
    #[inline]
    pub(in crate::engine) fn quick_edge(&mut self) -> bool {
        let code = match (std::mem::take(&mut self.looked), self.again) {
            (true, Some(code)) => code,
            (true, None) => return self.edge_after_look(),
            (false, _) => match self.begin_edge() {
                Some(code) => code,
                None => return false,
            },
        };
        self.call(code, 1) == 0
    }

    /// What to call for an edge of the only clock, which is to be done then, if that is known.
    #[inline]
    pub(super) fn begin_edge(&mut self) -> Option<Code> {
        let Quick { code, changes } = self.quick?;
        self.spend(1);
        self.change(changes);
        Some(code)
    }

    /// So many edges are done of those that it is known for what to call.
    #[inline]
    fn spend(&mut self, edges: u64) {
        self.ready_for -= edges;
        if self.ready_for == 0 {
            self.quick = None;
        }
    }

    /// So many edges of these clocks, after a look at what to call for them.
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
            count = count.min(self.program.passes.held_after.saturating_sub(edge.quiet));
            edge.quiet += count;
        }
        let (is_only, changes) = (self.resets.len() == 1, edge.changes);
        let after_look = self.rest_of(index);
        self.ready = Some(Ready { clock, is_only, edge: index, code, changes, after_look });
        self.ready_for = count;
        self.quick = (is_only && count > 0).then_some(Quick { code, changes });
    }

    /// It has to be found out what to call for edges of these clocks.
    fn put_away(&mut self, rising: &[usize]) {
        // Where versions are made, what is ready is asked for anew every few edges.
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

    /// Of several clocks, has what is ready stand where each one's does, but for what was made for inputs that are others now.
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
                *left = self.program.passes.held_after;
                edge.quiet = *left;
            }
        }
    }

    /// It has to be found out again what to call.
    #[cold]
    pub(super) fn unready(&mut self) {
        self.again = None;
        self.quick = None;
        let ready = self.ready.take().map(|ready| (ready, self.ready_for));
        for (ready, left) in ready.into_iter().chain(self.parked.iter_mut().filter_map(Option::take)) {
            self.edges[ready.edge].give_back(left);
        }
    }

    /// An edge of these clocks, by index.
    ///
    /// Registers are reset after its function has run, so one serves whether resets are high or not, except for the
    /// assertions that it checks: a circuit that begins with a reset has one function made, not two.
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

    /// The function for so many of an edge; with inputs folded in if they have long been as they are.
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
        if edge.quiet < self.program.passes.held_after || self.special == 0 || self.inputs.is_empty() {
            return code;
        }
        self.make_special(index)
    }

    /// The function for an edge with inputs as they are now.
    #[cold]
    fn make_special(&mut self, index: usize) -> Code {
        self.special -= 1;
        let (rising, resets) = self.edges[index].clocks();
        let held = self.held_inputs();
        let code = self.make_edge(&rising, &resets, &held);
        self.edges[index].special = Some(code);
        code
    }

    /// The inputs that functions are made for, if they have long been as they are at this edge: by their version.
    pub(super) fn held_version(&self, index: usize) -> Option<u64> {
        self.is_special(index).then_some(self.inputs_version)
    }

    /// Whether an edge has a function for the inputs as they are.
    pub(super) fn is_special(&self, index: usize) -> bool {
        let edge = &self.edges[index];
        edge.special.is_some() && edge.inputs_version == self.inputs_version && !self.held_changed
    }

    /// The inputs that functions may be made for, as they are.
    pub(super) fn held_inputs(&self) -> Held {
        let held = self.inputs.iter().map(|&id| {
            let place = self.places[id.index()].expect("an input is state");
            (id, Bits::new(place.width, self.state.number(place, 0)))
        });
        held.collect()
    }

    /// Whether functions are to check assertions.
    pub(super) fn check_asserts(&mut self, checked: bool) {
        if self.checked != checked {
            self.checked = checked;
            self.unready();
            self.state.put(self.unchecked, &[u64::from(!checked)]);
        }
    }

    /// Makes the function for an edge, which checks the assertions of clocks not in reset, with inputs that are known.
    fn make_edge(&mut self, rising: &[usize], resets: &[bool], held: &Held) -> Code {
        let parts = self.prepare_edges(rising, resets, held);
        self.compile(&parts)
    }

    /// What a function for an edge does, one after the other; the values in `given` are computed before.
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
        self.wake();
    }
}

//! The compiled engine: machine code made for one program.
//!
//! The state is one block of memory; memories are separate blocks. For each set of clocks that rise together, one
//! function executes such an edge any number of times. Other functions compute the values that a testbench reads. All
//! functions are made when they are first needed.

mod asserts;
mod edge;
pub(crate) mod evaluate;
mod examined;
mod glance;
mod idle;
mod look;
mod parts;
mod prepare;
mod rows;
mod start;
pub(crate) mod units;
mod until;
mod versions;
mod view;

use std::cell::Cell;
use std::sync::Arc;

use crate::engine::cranelift::{Code, Jit, SharedCode, Unsupported};
use crate::engine::fields::{self, Fields, Parts};
use crate::engine::function::demands;
use crate::engine::layout::bank::{self, Bank};
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::store::Store;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::layout::{Layout, Place};
use crate::engine::pack::{self, Packed, Places};
use crate::engine::passes::Target;
use crate::engine::program::{Program, Triggers, ValueId};
use crate::engine::start::State;
use crate::engine::until::Until;
use crate::engine::{Beginning, Difference, Done, Engine, Failed, Saved, Ticks, one_by_one, renew_each};
use edge::{Edge, Quick, Ready};
use evaluate::Functions;
pub use examined::examined;
use glance::Glance;
pub(crate) use glance::{Limb, Limbs};
use idle::Idle;
use look::Looks;
use rows::Rows;
use units::Apart;
use until::Stopping;
use versions::Versions;
pub(crate) use view::Slot;
use view::{NO_VIEW, View};

/// The state of a running circuit and the code that runs it.
pub(crate) struct Compiled {
    /// The circuit, with wide words split and single bits packed.
    program: Arc<Program>,
    /// The places of the parts.
    parts: Parts,
    /// The places of the bits.
    bits: Places,
    jit: Jit,
    /// State and the stored values of functions.
    state: Store,
    /// Temporary memory of functions.
    scratch: Store,
    layout: Layout,
    /// For each value of the program its place, if it is state.
    places: Vec<Option<Place>>,
    /// The same for a testbench that sets and reads single numbers.
    slots: Vec<Slot>,
    memories: Vec<MemoryAt>,
    banks: Vec<Bank>,
    /// Instances that run one by one, if there are any.
    apart: Option<Apart>,
    /// For each clock, whether its reset is high.
    resets: Vec<bool>,
    /// Whether any reset is high.
    any_reset: bool,
    edges: Vec<Edge>,
    /// The edge that was last looked up, and whether it checks assertions, while the resets are the same.
    latest: Option<(usize, bool)>,
    /// The function for the next edges, if they are of one clock, and the number of them.
    ready: Option<Ready>,
    ready_for: u64,
    /// For each of several clocks: the function that was ready when another clock rose, and its number of edges.
    parked: Vec<Option<(Ready, u64)>>,
    /// The ready function, if it is for the only clock and nothing must be checked before.
    quick: Option<Quick>,
    /// The inputs that a function may be made for, and how many more functions may be made.
    inputs: Vec<ValueId>,
    special: u32,
    /// The number of edges with unchanged inputs after which one is made.
    held_after: u64,
    /// The version of these inputs; it counts changes followed by an edge.
    inputs_version: u64,
    /// One of them was changed since the last edge.
    held_changed: bool,
    /// For each of several clocks: data about edges at which nothing happens.
    idle: Vec<Option<Idle>>,
    /// The clocks among these that read a clock's state.
    seen_by: Vec<idle::Clocks>,
    /// An input was changed since the last edge.
    stirred: bool,
    /// The number of edges of resting clocks.
    idle_edges: u64,
    /// The clocks that rise with a resting one; kept to avoid an allocation.
    rising: Vec<usize>,
    /// 1 while edges do not check assertions.
    unchecked: Place,
    checked: bool,
    /// The functions that check assertions, if there are any.
    checks: Vec<(Vec<usize>, Vec<bool>, Option<Code>)>,
    views: Vec<View>,
    looks: Looks,
    glances: Vec<Glance>,
    /// Somebody has looked at a computed value since the last edge.
    looked: bool,
    /// A view that is certainly up to date, or none: the usual look needs only this check.
    fresh: u32,
    /// The function to call for the next edge, if only looks happen before it.
    again: Option<Code>,
    stopping: Vec<Stopping>,
    rows: Vec<Rows>,
    /// For each function with loops that may get versions.
    versions: Vec<Versions>,
    /// The number of versions.
    versions_made: u64,
    /// The functions that are evaluated instead of compiled.
    #[expect(clippy::vec_box, reason = "code has the address of each")]
    evaluated: Vec<Box<Functions>>,
    /// The changes since views were last flagged as stale.
    pending: Triggers,
    /// Counts the changes of what views show, or of where they store it.
    version: u32,
    /// For each value of the program: the view that computes it, by index in `views`, and its place.
    shown: Vec<Option<(usize, Place)>>,
    /// Every value as limbs, brought up to date when it is read.
    mirror: Vec<u64>,
}

/// The widest input that a function is made for.
const HELD: u32 = 8;

/// The most such functions.
const SPECIAL: u32 = 16;

/// The cells of a circuit for which [`Passes::held_after`] holds as it stands.
const HELD_CELLS: u64 = 200;

/// The inputs that functions may be made for.
pub(crate) fn held_inputs(program: &Program) -> impl Iterator<Item = ValueId> {
    let is_held = |id: &ValueId| program.circuit[*id].lanes == 1 && program.circuit[*id].width <= HELD;
    program.inputs.iter().map(|port| port.value).filter(is_held)
}

impl Compiled {
    /// The circuit at its start; it shares code with others of it.
    ///
    /// # Errors
    ///
    /// Code cannot be generated for this machine.
    pub fn new(program: Arc<Program>, beginning: &Beginning, code: &Arc<SharedCode>) -> Result<Compiled, Unsupported> {
        let jit = match program.passes.target {
            Target::Strips { vector } => Jit::new()?.evaluating(vector),
            Target::Code | Target::Functions => Jit::new()?,
        };
        let jit = jit.sharing(code.clone());
        let (declared, Fields { program, parts }) = (&program, fields::split(&program));
        let Packed { program, places: bits } = pack::pack(program);
        demands::check(&program);
        let program = Arc::new(program);
        let mut layout = Layout::new(StripSizes::of(&program, program.passes.target.vector()));
        let (places, apart) = units::places(&program, &mut layout);
        layout.end_of_state();
        // Generated code skips units.
        let apart = apart.filter(|_| program.passes.target != Target::Functions);
        let unchecked = layout.place(1, 1);
        let (mut memories, banks) = bank::banks(&program, &layout.strips);
        if code.is_shared() {
            // Each simulation has memories of its own, whose addresses code looks up.
            memories.iter_mut().for_each(|memory| memory.table = Some(layout.place(1, 64).offset));
        }
        let inputs = held_inputs(&program).collect();
        let cells = program.circuit.len() as u64;
        let held_after = program.passes.held_after.saturating_mul((cells / HELD_CELLS).max(1));
        let has_idle = program.clocks.len() > 1 && apart.is_none();
        let idle = if has_idle { Idle::of(&program, &places) } else { Vec::new() };
        let mut engine = Compiled {
            jit,
            state: Store::new(layout.size, program.passes.guarded),
            scratch: Store::new(0, program.passes.guarded),
            layout,
            slots: places.iter().map(|it| it.as_ref().map_or(Slot::NONE, Slot::of_state)).collect(),
            places,
            memories,
            banks,
            apart,
            resets: vec![false; program.clocks.len()],
            any_reset: false,
            edges: Vec::new(),
            latest: None,
            ready: None,
            ready_for: 0,
            parked: (0..program.clocks.len()).filter(|_| program.clocks.len() > 1).map(|_| None).collect(),
            quick: None,
            unchecked,
            checked: true,
            checks: Vec::new(),
            views: Vec::new(),
            looks: Looks::default(),
            glances: Vec::new(),
            looked: false,
            fresh: NO_VIEW,
            again: None,
            stopping: Vec::new(),
            rows: Vec::new(),
            versions: Vec::new(),
            versions_made: 0,
            evaluated: Vec::new(),
            pending: Triggers::NONE,
            version: 0,
            shown: vec![None; program.circuit.len()],
            inputs,
            special: SPECIAL,
            held_after,
            inputs_version: 0,
            held_changed: false,
            seen_by: Idle::seen_by(&idle),
            idle,
            stirred: false,
            idle_edges: 0,
            rising: Vec::new(),
            mirror: vec![0; program.schedule.storage],
            program,
            parts,
            bits,
        };
        engine.tell_memories();
        crate::engine::start::start(declared, beginning, &mut engine);
        Ok(engine)
    }

    /// Enters a constant in `mirror`; most are never read.
    fn mirror_constant(&mut self, id: ValueId) {
        let bits = self.program.circuit.constant(id).expect("what is neither state nor computed is constant").limbs();
        let lanes = self.mirror[self.program.value(id).range()].chunks_exact_mut(bits.len());
        lanes.for_each(|lane| lane.copy_from_slice(bits));
    }

    /// Runs a function `count` times; returns how many are left because an assertion failed.
    #[inline]
    fn call(&mut self, code: Code, count: u64) -> u64 {
        let (state, scratch) = (self.state.address(), self.scratch.address().cast());
        // SAFETY: the code was made by this engine's `jit` for the layout of `state` and for these memories, which
        // are borrowed exclusively here and have not moved; `scratch` grows when a function is made.
        #[allow(unsafe_code, reason = "calls generated code")]
        unsafe {
            code.call(state, count, scratch)
        }
    }
}

impl Engine for Compiled {
    fn is_as_seen(&mut self, id: ValueId, seen: &mut Vec<u64>) -> bool {
        match self.place(id) {
            Some(place) => self.state.is_same(place, seen),
            None => false,
        }
    }

    fn read(&mut self, id: ValueId) -> &[u64] {
        let range = self.program.value(id).range();
        match self.place(id) {
            Some(place) => self.state.get(place, &mut self.mirror[range.clone()]),
            None => self.mirror_constant(id),
        }
        &self.mirror[range]
    }

    fn number(&mut self, id: ValueId, lane: u32) -> u64 {
        if let Some(number) = self.refreshed(self.slot(id)) {
            return number;
        }
        match self.place(id) {
            Some(place) => self.state.number(place, lane),
            None => self.read(id)[lane as usize],
        }
    }

    fn renew(&mut self, ids: &[ValueId], seen: &mut [u64], note: &mut Vec<u32>, changed: &mut Vec<u32>) {
        if note.first() == Some(&self.version) {
            return self.renew_noted(note, seen, changed);
        }
        renew_each(self, ids, seen, changed);
        self.note(ids, note);
    }

    fn write(&mut self, id: ValueId, limbs: &[u64], triggers: Triggers) {
        let place = self.places[id.index()].expect("an input is state");
        self.state.put(place, limbs);
        let is_held = place.width <= HELD;
        self.input_changed(triggers, is_held);
    }

    fn write_number(&mut self, id: ValueId, number: u64, triggers: Triggers) {
        if !self.quick_set(self.slot(id), number, triggers) {
            self.write(id, &[number], triggers);
        }
    }

    fn word(&self, memory: u32, lane: u32, address: u32) -> Vec<u64> {
        self.word_of_parts(memory, lane, address)
    }

    fn short_word(&self, memory: u32, lane: u32, address: u32) -> u64 {
        self.short_word_of_parts(memory, lane, address)
    }

    fn all_words(&self, program: &Program, memory: u32, out: &mut Vec<u64>) {
        self.all_words_of_parts(memory, &program.memories[memory as usize], out);
    }

    fn set_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        self.set_word_in_parts(memory, lane, address, limbs);
        self.wake();
        self.wake_clocks();
        self.change(Triggers::ALL);
    }

    fn set_reset(&mut self, clock: usize, high: bool) {
        self.resets[clock] = high;
        self.any_reset = self.resets.contains(&true);
        self.latest = None;
        self.unready();
        if self.program.resets_at_once(clock, high) {
            self.reset(&[clock]);
            self.wake_clocks();
            self.change(Triggers::state(clock));
        }
    }

    fn restore(&mut self, program: &Program, saved: &Saved) {
        saved.for_each_lane(program, |id, lane, limbs| self.set(id, lane..lane + 1, limbs));
        saved.for_each_word(program, |memory, lane, address, limbs| {
            self.set_word_in_parts(memory, lane, address, limbs);
        });
        self.input_changed(Triggers::ALL, true);
        self.wake();
        self.wake_clocks();
        self.change(Triggers::ALL);
    }

    fn check(&mut self, rising: &[usize]) -> Vec<Failed> {
        if self.holds(rising) {
            return Vec::new();
        }
        let program = self.program.clone();
        let mut failed = Vec::new();
        for &clock in rising {
            if self.resets[clock] {
                continue;
            }
            for &assert in &program.clocks[clock].asserts {
                let condition = self.read(program.asserts[assert as usize].condition);
                let lanes = (0u32..).zip(condition).filter(|(_, holds)| **holds == 0);
                failed.extend(lanes.map(|(lane, _)| Failed { assert, lane }));
            }
        }
        failed
    }

    fn edges(&mut self, rising: &[usize], count: u64) -> Result<Done, Box<Difference>> {
        if count == 1 && self.quick_edge() {
            let changed = self.ready.as_ref().map_or(Triggers::ALL, |ready| ready.changes);
            return Ok(Done { edges: 1, changed });
        }
        if !self.idle.is_empty()
            && let Some(done) = self.idle_edge(rising, count)
        {
            return Ok(done);
        }
        Ok(self.usual_edges(rising, count))
    }

    fn instants(&mut self, ticks: &mut [Ticks], until: u64) {
        self.plain_instants(ticks, until);
    }

    fn edges_until(&mut self, rising: &[usize], count: u64, until: &Until) -> Result<(Done, bool), Box<Difference>> {
        // Registers are reset after a function has run, so the function cannot know the consequences.
        if self.any_reset || count < 2 {
            return one_by_one(self, rising, count, until);
        }
        // The function checks the condition before an edge, so the first edge is done separately.
        let (first, holds) = one_by_one(self, rising, 1, until)?;
        if holds || first.edges == 0 {
            return Ok((first, holds));
        }
        let edges = 1 + self.until_edges(rising, count - 1, until);
        Ok((Done { edges, ..first }, until.holds(self.read(until.value))))
    }

    fn versions(&self) -> u64 {
        self.versions_made
    }

    fn left_out(&self) -> u64 {
        self.edges_left_out() + self.idle_edges
    }

    fn watch(&mut self, values: &[ValueId]) {
        self.show(values);
    }

    fn glance(&mut self, limbs: &Limbs, numbers: &mut [u64]) -> bool {
        self.glance_at(limbs, numbers)
    }

    fn take_in_rows(&mut self, values: &[ValueId]) -> Option<usize> {
        self.add_rows(values)
    }

    fn edges_in_rows(&mut self, rows: usize, rising: &[usize], count: u64) -> Option<(Done, &[Cell<u64>])> {
        self.fill_rows(rows, rising, count)
    }
}

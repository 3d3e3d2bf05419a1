//! The compiled engine: machine code made for one program.
//!
//! State stands in one block of memory, memories in blocks of their own. For each set of clocks that rises together
//! there is a function that goes through such an edge any number of times; for what a testbench looks at there are
//! functions that compute it. All are made when they are first needed.

mod bank;
mod branch;
mod builder;
mod demands;
mod edge;
mod emitter;
mod function;
mod jit;
mod kernel;
mod lanes;
mod layout;
mod lower;
mod memory;
mod pages;
mod plan;
mod prepare;
mod scalar;
mod sequence;
mod start;
mod store;
mod strip;
mod target;

use std::collections::BTreeMap;
use std::sync::Arc;

use tilewright_hdl::limbs_for;

use crate::engine::program::{Kind, Program, Triggers, ValueId};
use crate::engine::{Difference, Done, Engine, Failed};
use bank::Bank;
use edge::Edge;
use emitter::MemoryAt;
use function::{Held, Maker};
pub(crate) use jit::unsupported;
use jit::{Code, Jit};
use layout::{Layout, Place, Strips};
use store::Store;
pub use target::Unsupported;

/// The state of a running circuit and the code that runs it.
pub(crate) struct Compiled {
    program: Arc<Program>,
    jit: Jit,
    /// State and what functions store.
    state: Store,
    /// What functions need for a moment.
    scratch: Store,
    layout: Layout,
    /// Per value of the program: where it is, if it is state.
    places: Vec<Option<Place>>,
    memories: Vec<MemoryAt>,
    banks: Vec<Bank>,
    /// Per clock: its reset is high.
    resets: Vec<bool>,
    edges: Vec<Edge>,
    /// The inputs that a function may be made for, and how many functions still may.
    inputs: Vec<ValueId>,
    special: u32,
    /// Counts changes of inputs.
    inputs_version: u64,
    /// 1 while edges are not to check assertions.
    unchecked: Place,
    checked: bool,
    /// What looks whether assertions hold, if there are any.
    checks: Vec<(Vec<usize>, Vec<bool>, Option<Code>)>,
    views: Vec<View>,
    /// Per value of the program: what computes it, by index in `views`, and where it leaves it.
    shown: Vec<Option<(usize, Place)>>,
    /// Every value as limbs, brought up to date when it is read.
    mirror: Vec<u64>,
}

/// The widest input that a function is made for.
const HELD: u32 = 8;
/// How often at most.
const SPECIAL: u32 = 16;

/// A function that leaves values where they can be read.
#[derive(Clone, Copy)]
struct View {
    code: Code,
    /// What changes what it shows, and whether it has since it was last run.
    triggers: Triggers,
    stale: bool,
}

impl Compiled {
    /// The circuit at its start.
    ///
    /// # Errors
    ///
    /// The machine is not one that code can be generated for.
    pub fn new(program: Arc<Program>, seeds: &[u64]) -> Result<Compiled, Unsupported> {
        let jit = Jit::new()?;
        demands::check(&program);
        let mut layout = Layout::new(Strips::of(&program));
        let mut places = vec![None; program.circuit.len()];
        for (id, cell) in program.circuit.cells().filter(|(_, cell)| cell.kind == Kind::State) {
            places[id.index()] = Some(layout.place(cell.lanes, cell.width));
        }
        let unchecked = layout.place(1, 1);
        let (memories, banks) = bank::banks(&program, &layout.strips);
        let inputs = program.inputs.iter().map(|port| port.value);
        let inputs = inputs.filter(|&id| program.value(id).lanes == 1 && program.value(id).width <= HELD).collect();
        let mut engine = Compiled {
            jit,
            state: Store::new(layout.size, program.passes.guarded),
            scratch: Store::new(0, program.passes.guarded),
            layout,
            places,
            memories,
            banks,
            resets: vec![false; program.clocks.len()],
            edges: Vec::new(),
            unchecked,
            checked: true,
            checks: Vec::new(),
            views: Vec::new(),
            shown: vec![None; program.circuit.len()],
            inputs,
            special: SPECIAL,
            inputs_version: 0,
            mirror: vec![0; program.schedule.storage],
            program: program.clone(),
        };
        crate::engine::start::start(&program, seeds, &mut engine);
        Ok(engine)
    }

    /// Whether all assertions hold at an edge of these clocks.
    fn holds(&mut self, rising: &[usize]) -> bool {
        let made = self.checks.iter().find(|(clocks, resets, _)| clocks == rising && *resets == self.resets);
        let code = match made {
            Some((_, _, code)) => *code,
            None => {
                let check = Maker::new(&self.program, &Held::default()).check(rising, &self.resets);
                let check = check.map(|function| self.prepare(&function));
                let code = check.map(|check| self.compile(std::slice::from_ref(&check)));
                self.checks.push((rising.to_vec(), self.resets.clone(), code));
                code
            }
        };
        self.check_asserts(true);
        code.is_none_or(|code| self.call(code, 1) == 0)
    }

    /// Where a value is, brought up to date if it is computed; `None` for constants.
    fn place(&mut self, id: ValueId) -> Option<Place> {
        match self.places[id.index()] {
            None if self.program.value(id).segment.is_some() => Some(self.view(id)),
            place => place,
        }
    }

    /// Brings a value that is computed up to date; gives where it is. All output ports share a function.
    fn view(&mut self, id: ValueId) -> Place {
        let (view, place) = match self.shown[id.index()] {
            Some(shown) => shown,
            None => {
                let outputs: Vec<ValueId> = self.program.outputs.iter().map(|port| port.value).collect();
                self.watch(if outputs.contains(&id) { &outputs } else { std::slice::from_ref(&id) });
                self.shown[id.index()].expect("it is shown now")
            }
        };
        let View { code, stale, .. } = self.views[view];
        if stale {
            self.views[view].stale = false;
            self.call(code, 1);
        }
        place
    }

    /// Enters a constant in what is read; most never are.
    fn mirror_constant(&mut self, id: ValueId) {
        let bits = self.program.circuit.constant(id).expect("what is neither state nor computed is constant").limbs();
        let lanes = self.mirror[self.program.value(id).range()].chunks_exact_mut(bits.len());
        lanes.for_each(|lane| lane.copy_from_slice(bits));
    }

    /// Marks what shows something of this.
    fn changed(&mut self, triggers: Triggers) {
        for view in &mut self.views {
            view.stale |= view.triggers.meet(triggers);
        }
    }

    /// Runs a function so many times; gives how many are left because something did not hold.
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

    fn write(&mut self, id: ValueId, limbs: &[u64], triggers: Triggers) {
        let place = self.places[id.index()].expect("an input is state");
        self.state.put(place, limbs);
        self.changed(triggers);
        self.inputs_version += u64::from(self.program.value(id).width <= HELD);
    }

    fn word(&self, memory: u32, lane: u32, address: u32) -> Vec<u64> {
        let at = self.memories[memory as usize];
        let mut limbs = vec![0; limbs_for(at.width)];
        self.banks[at.bank].get_word(at.at(lane, address), at.words.word, at.width, &mut limbs);
        at.standing(&limbs)
    }

    fn set_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        let at = self.memories[memory as usize];
        self.banks[at.bank].put_word(at.at(lane, address), at.words.word, at.width, &at.standing(limbs));
        self.changed(Triggers::ALL);
    }

    fn set_reset(&mut self, clock: usize, high: bool) {
        self.resets[clock] = high;
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
        let mut left = 0;
        if count > 0 {
            let code = self.edge_code(rising, count);
            if rising.iter().any(|&clock| self.resets[clock]) {
                left = count;
                while left > 0 && self.call(code, 1) == 0 {
                    self.reset(rising);
                    left -= 1;
                }
            } else {
                left = self.call(code, count);
            }
        }
        let changed = rising.iter().fold(Triggers::NONE, |all, &clock| all.with(Triggers::state(clock)));
        self.changed(changed);
        Ok(Done { edges: count - left, changed })
    }

    fn watch(&mut self, values: &[ValueId]) {
        let computed = |id: &&ValueId| self.program.value(**id).segment.is_some();
        let mut shown: Vec<ValueId> = values.iter().filter(computed).copied().collect();
        shown.sort();
        shown.dedup();
        if shown.is_empty() {
            return;
        }
        // Values that change together are computed together.
        let triggers = |id: ValueId| {
            let segment = self.program.value(id).segment.expect("it is computed");
            self.program.schedule.segments[segment as usize].triggers
        };
        let mut groups: BTreeMap<Triggers, Vec<ValueId>> = BTreeMap::new();
        shown.into_iter().for_each(|id| groups.entry(triggers(id)).or_default().push(id));
        for (triggers, shown) in groups {
            let mut maker = Maker::new(&self.program, &Held::default());
            maker.show(&shown);
            let prepared = self.prepare(&maker.finish());
            let code = self.compile(std::slice::from_ref(&prepared));
            for (&id, place) in shown.iter().zip(prepared.shown()) {
                self.shown[id.index()] = Some((self.views.len(), place));
            }
            self.views.push(View { code, triggers, stale: true });
        }
    }
}

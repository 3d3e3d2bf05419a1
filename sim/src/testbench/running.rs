//! A running circuit without its port bundles: the core of simulations and batches.

use std::sync::Arc;

use rustc_hash::FxHashMap;
use tilewright_circuit::{Bits, Design, limbs_for, top_mask};

use crate::engine::program::{self, Program, Triggers, ValueId};
use crate::engine::{Beginning, EngineKind, Passes, Slot, Started, lane};
use crate::testbench::error::UnknownName;
use crate::testbench::past::{Change, Past};
use crate::testbench::port::{IntoValue, Port};
use crate::testbench::resting::Resting;
use crate::testbench::timeline::Timeline;
use crate::testbench::trace::{Observer, Poked};

/// A running circuit and its observers.
pub(crate) struct Running {
    pub program: Arc<Program>,
    pub engine: Started,
    pub timeline: Timeline,
    /// For each clock: its reset is active.
    pub resets: Vec<bool>,
    /// For each clock: when its reset last became active.
    pub reset_since: Vec<u64>,
    pub observers: Vec<Box<dyn Observer + Send>>,
    /// The observers that need no sample now.
    pub resting: Resting,
    /// The memory words replaced before the first step, which recordings include.
    pub poked: Poked,
    /// The recorded runs: from the first step on, a recording must explain everything.
    pub recorded: Vec<u32>,
    /// Everything that may have changed since the observers last saw it, if there are observers.
    pub changed: Triggers,
    /// The clocks of the coming instant; kept to avoid an allocation.
    pub rising: Vec<usize>,
    /// For each cover, two numbers in each lane: the count while the reset was active, and, if it is active now,
    /// the count at its begin.
    pub in_reset: Vec<Vec<u64>>,
    pub before_reset: Vec<Vec<u64>>,
    /// For each run, the value and lane of each name that was looked up: a testbench looks at the same names in every
    /// cycle.
    pub peeked: FxHashMap<u32, FxHashMap<String, (ValueId, u32)>>,
    /// What is remembered, and the time at which that or a resting observer wants something to be done; the largest
    /// one if there is nothing.
    pub past: Option<Box<Past>>,
    pub pause_at: u64,
    /// By port number.
    ports: Vec<Wired>,
}

/// The data of a port that is needed in every cycle.
#[derive(Clone, Copy)]
struct Wired {
    value: ValueId,
    width: u32,
    is_signed: bool,
    triggers: Triggers,
    /// Numbers below this can be set directly: 0 for an output, and for an input of more than 64 bits.
    end: u64,
    /// The engine's slot for it, once it has been set or read: looking the slot up each time would take longer than
    /// the rest.
    slot: Slot,
}

impl Running {
    /// `runs` runs of a design.
    pub fn new(design: &Design, runs: u32, passes: &Passes) -> Running {
        let program = Arc::new(program::compile_lanes(design, runs, passes));
        let engine = Started::new(program.clone(), EngineKind::default(), Beginning::of(vec![0; runs as usize]));
        Running::started(program, engine)
    }

    /// The same circuit at its start, with the same engine and seeds.
    pub fn another(&self) -> Running {
        Running::started(self.program.clone(), self.engine.another())
    }

    fn started(program: Arc<Program>, engine: Started) -> Running {
        let ports = program.inputs.iter().chain(&program.outputs).map(|port| {
            let width = program.value(port.value).width;
            let is_set = width <= 64 && port.triggers != Triggers::NONE;
            // For 64 bits, the largest number takes the slow path.
            let end = if is_set { top_mask(width).saturating_add(1) } else { 0 };
            Wired {
                value: port.value,
                width,
                is_signed: port.is_signed,
                triggers: port.triggers,
                end,
                slot: Slot::NONE,
            }
        });
        let mut running = Running {
            engine,
            timeline: Timeline::new(&program),
            resets: vec![false; program.clocks.len()],
            reset_since: vec![0; program.clocks.len()],
            observers: Vec::new(),
            resting: Resting::default(),
            poked: Poked::default(),
            recorded: Vec::new(),
            changed: Triggers::NONE,
            rising: Vec::new(),
            in_reset: Vec::new(),
            before_reset: Vec::new(),
            peeked: FxHashMap::default(),
            past: None,
            pause_at: u64::MAX,
            ports: ports.collect(),
            program,
        };
        running.clear_covers();
        running
    }

    #[track_caller]
    pub fn seed(&mut self, seeds: Vec<u64>) {
        assert!(self.timeline.time() == 0, "a seed can only be given before the first step");
        assert!(!self.is_observed(), "give the seed before attaching a trace");
        self.restart(self.engine.again(self.engine.chosen(), Beginning::of(seeds)));
    }

    #[track_caller]
    pub fn put_on(&mut self, kind: EngineKind) {
        assert!(self.timeline.time() == 0, "an engine can only be chosen before the first step");
        assert!(!self.is_observed(), "choose the engine before attaching a trace");
        self.restart(self.engine.again(kind, self.engine.beginning.clone()));
    }

    pub fn restart(&mut self, engine: Started) {
        self.engine = engine;
        // The slots belonged to the previous engine.
        self.ports.iter_mut().for_each(|port| port.slot = Slot::NONE);
        self.resets.fill(false);
        self.poked.clear();
        self.clear_covers();
        self.remember_again();
    }

    /// Remembers from the present state on, if anything is remembered.
    pub fn remember_again(&mut self) {
        if let Some(past) = self.past.take() {
            self.remember(past.most());
        }
    }

    pub fn port(&self, name: &str) -> Result<Port, UnknownName> {
        let ports = || self.program.inputs.iter().chain(&self.program.outputs);
        let found = ports().position(|port| port.name == name || port.path == name);
        found
            .map(|index| Port { index: index as u32 })
            .ok_or_else(|| UnknownName::new("port", name, &ports().map(|port| port.name.clone()).collect::<Vec<_>>()))
    }

    /// The declaration of a port.
    #[track_caller]
    pub fn declared(&self, port: Port) -> &program::Port {
        let index = port.index as usize;
        let inputs = self.program.inputs.len();
        let found =
            if index < inputs { Some(&self.program.inputs[index]) } else { self.program.outputs.get(index - inputs) };
        found.expect("the port is of another simulation")
    }

    #[track_caller]
    #[inline]
    fn wired(&self, port: Port) -> &Wired {
        self.ports.get(port.index as usize).expect("the port is of another simulation")
    }

    /// Sets an input in the only run.
    #[track_caller]
    #[inline]
    pub fn set(&mut self, port: Port, value: impl IntoValue) {
        match value.to_limb() {
            Some(limb) if self.set_limb(port, limb) => {}
            _ => self.set_bits(port, value),
        }
    }

    #[track_caller]
    fn set_bits(&mut self, port: Port, value: impl IntoValue) {
        let input = self.program.inputs.get(port.index as usize);
        // A value stored as limbs need not be copied.
        if let Some(limbs) = input.and_then(|input| value.limbs_of(self.program.value(input.value).width)) {
            return self.write(port, limbs);
        }
        let bits = self.fitting(port, value);
        self.write(port, bits.limbs());
    }

    /// Sets an input of up to 64 bits in the only run, if it is one and the number fits. A single function serves all
    /// types of numbers and is compiled with the engine.
    fn set_limb(&mut self, port: Port, limb: u64) -> bool {
        let Some(&Wired { triggers, end, slot, .. }) = self.ports.get(port.index as usize) else { return false };
        if limb >= end {
            return false;
        }
        self.may_have_changed(triggers);
        self.note(|| Change::Input(port.index, limb));
        self.engine.quick_set(slot, limb, triggers) || self.write_limb(port, limb)
    }

    #[cold]
    fn write_limb(&mut self, port: Port, limb: u64) -> bool {
        let Wired { value, triggers, .. } = self.ports[port.index as usize];
        self.engine.write_number(value, limb, triggers);
        self.find(port);
        true
    }

    /// Sets an input in all runs.
    pub fn write(&mut self, port: Port, limbs: &[u64]) {
        self.note(|| Change::of_input(port.index, limbs));
        let input = &self.program.inputs[port.index as usize];
        self.engine.write(input.value, limbs, input.triggers);
        self.may_have_changed(input.triggers);
    }

    /// Tells the observers, if there are any.
    #[inline]
    pub fn may_have_changed(&mut self, triggers: Triggers) {
        if !self.observers.is_empty() {
            self.changed = self.changed.with(triggers);
        }
    }

    /// The value converted to the width of an input.
    #[track_caller]
    pub fn fitting(&self, port: Port, value: impl IntoValue) -> Bits {
        let Some(input) = self.program.inputs.get(port.index as usize) else {
            panic!("`{}` is an output and cannot be set", self.declared(port).name)
        };
        let width = self.program.value(input.value).width;
        match value.into_value(width) {
            Ok(bits) => bits,
            Err(problem) => {
                panic!("input `{}` has {} and {problem}", input.name, bits(width))
            }
        }
    }

    /// The value of a port in one run.
    #[track_caller]
    #[inline]
    pub fn get(&mut self, port: Port, run: u32) -> Bits {
        let &Wired { width, slot, .. } = self.wired(port);
        match self.engine.quick_get(slot) {
            Some(number) => Bits::new(width, number),
            None => self.other_bits(port, run),
        }
    }

    #[inline(never)]
    fn other_bits(&mut self, port: Port, run: u32) -> Bits {
        let &Wired { value, width, .. } = self.wired(port);
        match self.refreshed(port) {
            Some(number) => Bits::new(width, number),
            None => self.lane(value, run),
        }
    }

    /// The value of a port of up to 64 bits in one run.
    #[track_caller]
    #[inline]
    pub fn narrow(&mut self, port: Port, run: u32) -> u64 {
        match self.engine.quick_get(self.wired(port).slot) {
            Some(number) => number,
            None => self.other_narrow(port, run),
        }
    }

    #[track_caller]
    #[inline(never)]
    fn other_narrow(&mut self, port: Port, run: u32) -> u64 {
        let &Wired { value, width, .. } = self.wired(port);
        if let Some(number) = self.refreshed(port) {
            return number;
        }
        assert!(width <= 64, "`{}` is wider than 64 bits: use `get`", self.declared(port).name);
        self.engine.number(value, run)
    }

    /// The value of a port that has a slot, brought up to date.
    fn refreshed(&mut self, port: Port) -> Option<u64> {
        self.find(port);
        self.engine.refreshed(self.wired(port).slot)
    }

    /// Looks up the engine's slot of a port, which may have moved.
    fn find(&mut self, port: Port) {
        let wired = &mut self.ports[port.index as usize];
        wired.slot = self.engine.slot(wired.value);
    }

    /// The value of a port in one run as a number, whatever its width; `instead` names the method to use for more
    /// than 64 bits.
    #[track_caller]
    #[inline]
    pub fn number(&mut self, port: Port, run: u32, instead: &str) -> u64 {
        match self.engine.quick_get(self.wired(port).slot) {
            Some(number) => number,
            None => self.other_number(port, run, instead),
        }
    }

    #[track_caller]
    #[inline(never)]
    fn other_number(&mut self, port: Port, run: u32, instead: &str) -> u64 {
        let number = self.other_bits(port, run).to_u64();
        number.unwrap_or_else(|| panic!("`{}` does not fit in 64 bits: use `{instead}`", self.declared(port).path))
    }

    /// The value of a port in the only run as a number, negative if the port is signed and the value is; `None` if it
    /// is out of the range of `i128`.
    pub fn signed(&mut self, port: Port) -> Option<i128> {
        let bits = self.get(port, 0);
        match self.wired(port).is_signed {
            true => bits.to_i128(),
            false => bits.to_u128().and_then(|number| number.try_into().ok()),
        }
    }

    /// The limbs of a port in one run.
    #[track_caller]
    pub fn limbs(&mut self, port: Port, run: u32) -> &[u64] {
        let &Wired { value, width, .. } = self.wired(port);
        let count = limbs_for(width);
        &self.engine.read(value)[run as usize * count..][..count]
    }

    /// A lane of a value.
    pub fn lane(&mut self, id: ValueId, index: u32) -> Bits {
        lane(&self.program, &mut *self.engine, id, index)
    }
}

/// A width in words.
pub(crate) fn bits(width: u32) -> String {
    if width == 1 { "1 bit".to_string() } else { format!("{width} bits") }
}

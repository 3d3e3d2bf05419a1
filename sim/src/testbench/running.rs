//! A running circuit, whatever the bundles of its ports: what simulations and batches are around.

use std::sync::Arc;

use rustc_hash::FxHashMap;
use tilewright_hdl::{Bits, Design, limbs_for, top_mask};

use crate::engine::program::{self, Program, Triggers, ValueId};
use crate::engine::{EngineKind, Passes, Slot, Started, lane};
use crate::testbench::error::UnknownName;
use crate::testbench::port::{IntoValue, Port};
use crate::testbench::timeline::Timeline;
use crate::testbench::trace::{Observer, Poked};

/// A running circuit and who watches it.
pub(crate) struct Running {
    pub program: Arc<Program>,
    pub engine: Started,
    pub timeline: Timeline,
    pub resets: Vec<bool>,
    pub observers: Vec<Box<dyn Observer + Send>>,
    /// The words that were replaced before the first step, of which recordings tell.
    pub poked: Poked,
    /// The runs that are recorded: from the first step on, a recording has to explain everything.
    pub recorded: Vec<u32>,
    /// What may have changed since the observers last saw it, if there are any.
    pub changed: Triggers,
    /// The clocks of the coming instant; kept to save an allocation.
    pub rising: Vec<usize>,
    /// By cover, how often its counter counted in each lane while the reset was high, and what it had when the reset began, if that is high.
    pub in_reset: Vec<Vec<u64>>,
    pub before_reset: Vec<Vec<u64>>,
    /// By run, the value and the lane of each name that was looked at: a testbench looks at the same ones in every cycle.
    pub peeked: FxHashMap<u32, FxHashMap<String, (ValueId, u32)>>,
    /// By number.
    ports: Vec<Wired>,
}

/// What is asked of a port in every cycle.
#[derive(Clone, Copy)]
struct Wired {
    value: ValueId,
    width: u32,
    is_signed: bool,
    triggers: Triggers,
    /// It can be set to a smaller number at once: 0 for an output, and for an input of more than 64 bits.
    end: u64,
    /// Where the engine has it, once it was set or looked at: to ask for it each time takes longer than the rest.
    slot: Slot,
}

impl Running {
    /// So many runs of a design.
    pub fn new(design: &Design, runs: u32, passes: &Passes) -> Running {
        let program = Arc::new(program::compile_lanes(design, runs, passes));
        let engine = Started::new(program.clone(), EngineKind::default(), vec![0; runs as usize]);
        Running::started(program, engine)
    }

    /// The same at its start, with the same engine and seeds.
    pub fn another(&self) -> Running {
        Running::started(self.program.clone(), self.engine.again(self.engine.chosen(), self.engine.seeds.clone()))
    }

    fn started(program: Arc<Program>, engine: Started) -> Running {
        let ports = program.inputs.iter().chain(&program.outputs).map(|port| {
            let width = program.value(port.value).width;
            let is_set = width <= 64 && port.triggers != Triggers::NONE;
            // Of 64 bits, the largest number takes the long way.
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
            observers: Vec::new(),
            poked: Poked::default(),
            recorded: Vec::new(),
            changed: Triggers::NONE,
            rising: Vec::new(),
            in_reset: Vec::new(),
            before_reset: Vec::new(),
            peeked: FxHashMap::default(),
            ports: ports.collect(),
            program,
        };
        running.clear_covers();
        running
    }

    #[track_caller]
    pub fn seed(&mut self, seeds: Vec<u64>) {
        assert!(self.timeline.time() == 0, "a seed can only be given before the first step");
        assert!(self.observers.is_empty(), "give the seed before attaching a trace");
        self.restart(self.engine.again(self.engine.chosen(), seeds));
    }

    #[track_caller]
    pub fn put_on(&mut self, kind: EngineKind) {
        assert!(self.timeline.time() == 0, "an engine can only be chosen before the first step");
        assert!(self.observers.is_empty(), "choose the engine before attaching a trace");
        self.restart(self.engine.again(kind, self.engine.seeds.clone()));
    }

    pub fn restart(&mut self, engine: Started) {
        self.engine = engine;
        // They were of the engine before.
        self.ports.iter_mut().for_each(|port| port.slot = Slot::NONE);
        self.resets.fill(false);
        self.poked.clear();
        self.clear_covers();
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
        // What stands somewhere need not be copied.
        if let Some(limbs) = input.and_then(|input| value.limbs_of(self.program.value(input.value).width)) {
            return self.write(port, limbs);
        }
        let bits = self.fitting(port, value);
        self.write(port, bits.limbs());
    }

    /// Sets an input of up to 64 bits in the only run, if it is one and the number fits. It is one function for all types of
    /// numbers, compiled with the engine.
    fn set_limb(&mut self, port: Port, limb: u64) -> bool {
        let Some(&Wired { triggers, end, slot, .. }) = self.ports.get(port.index as usize) else { return false };
        if limb >= end {
            return false;
        }
        self.may_have_changed(triggers);
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
        let input = &self.program.inputs[port.index as usize];
        self.engine.write(input.value, limbs, input.triggers);
        self.may_have_changed(input.triggers);
    }

    /// Tells those who watch, if anybody does.
    #[inline]
    pub fn may_have_changed(&mut self, triggers: Triggers) {
        if !self.observers.is_empty() {
            self.changed = self.changed.with(triggers);
        }
    }

    /// Has somebody watch.
    pub fn observe_by(&mut self, observer: Box<dyn Observer + Send>) {
        self.changed = Triggers::ALL;
        self.observers.push(observer);
    }

    /// The value as an input takes it.
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

    /// A port in one run.
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

    /// A port of up to 64 bits in one run.
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

    /// A port that stands in a slot, brought up to date.
    fn refreshed(&mut self, port: Port) -> Option<u64> {
        self.find(port);
        self.engine.refreshed(self.wired(port).slot)
    }

    /// Finds out where the engine has a port, which may be another place than before.
    fn find(&mut self, port: Port) {
        let wired = &mut self.ports[port.index as usize];
        wired.slot = self.engine.slot(wired.value);
    }

    /// The number that a port is in one run, however wide it is; `instead` gives what does not fit 64 bits.
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
        number.unwrap_or_else(|| panic!("`{}` does not fit 64 bits: use `{instead}`", self.declared(port).path))
    }

    /// The number that a port is in the only run, negative if it is signed and so is its value; none if it is out of the range of `i128`.
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

//! The way back: from some bits to what decided them, time by time.
//!
//! Within a time, values are visited from the last of the program's sequence to the first, and operands come before
//! what is computed from them. So all that depends on a value is known before the value is visited, and each is
//! visited once for each time. Registers, read data and words wait until the time at which they were written.

use std::collections::BTreeMap;
use std::sync::Arc;

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;
use tilewright_hdl::DEFAULT_PERIOD;

use super::edge::Outcome;
use super::names::Names;
use super::operation::{Asked, Demand, Place, demands};
use super::values::{Values, within};
use super::{End, Limits};
use crate::engine::program::{Kind, Program, ValueId};
use crate::testbench::error::Error;
use crate::testbench::running::Running;

/// Some bits at one time, or since they were written.
pub(super) struct Node {
    pub place: Place,
    pub lane: u32,
    pub bits: Bits,
    pub value: Bits,
    pub time: u64,
    pub clock: usize,
    pub cycle: u64,
    /// It is part of the tree, rather than on the way from one part to another.
    pub is_shown: bool,
    pub depth: usize,
    /// What decided them: other nodes, each with whether it chose them.
    pub edges: Vec<(usize, bool)>,
    pub end: Option<End>,
}

/// What changes a state at an edge.
#[derive(Clone, Copy)]
pub(super) enum StateOf {
    /// A register, by index.
    Register(u32),
    /// Read data: the memory and the port.
    Read(u32, u32),
}

/// The way back.
pub(super) struct Walk<'a> {
    pub running: &'a mut Running,
    pub program: Arc<Program>,
    pub limits: Limits,
    pub values: Values,
    pub states: FxHashMap<ValueId, StateOf>,
    /// The clocks of the coming edge.
    pub rising: Vec<usize>,
    pub names: Names,
    pub nodes: Vec<Node>,
    /// The values of the present time that are not visited yet.
    open: BTreeMap<(ValueId, u32), usize>,
    /// What was stored before the present time.
    stored: BTreeMap<(Place, u32), usize>,
    shown: usize,
}

impl Walk<'_> {
    pub fn new<'a>(running: &'a mut Running, limits: &Limits) -> Walk<'a> {
        let program = running.program.clone();
        let registers = (0..).zip(&program.registers).map(|(index, it)| (it.value, StateOf::Register(index)));
        let reads = (0..).zip(&program.memories).flat_map(|(memory, it)| {
            (0..).zip(&it.reads).map(move |(port, read)| (read.value, StateOf::Read(memory, port)))
        });
        Walk {
            states: registers.chain(reads).collect(),
            values: Values::new(&program),
            names: Names::new(&program),
            limits: limits.clone(),
            rising: Vec::new(),
            nodes: Vec::new(),
            open: BTreeMap::new(),
            stored: BTreeMap::new(),
            shown: 0,
            running,
            program,
        }
    }

    /// Goes from some bits to all that decided them, as far as the limits let it; the first node is where it begins.
    pub fn run(&mut self, place: Place, lane: u32, bits: Bits) -> Result<(), Error> {
        self.demand(None, Demand { place, lane, bits, is_control: false });
        loop {
            self.visit_open();
            self.end_what_was_set();
            self.cut_deep();
            if self.is_full() || self.stored.is_empty() {
                break;
            }
            if !self.go_to_the_last_write()? {
                self.end_at_the_start();
            }
        }
        let rest: Vec<usize> = self.open.values().chain(self.stored.values()).copied().collect();
        rest.into_iter().for_each(|node| self.nodes[node].end = Some(End::Cut));
        Ok(())
    }

    fn is_full(&self) -> bool {
        self.shown >= self.limits.nodes
    }

    /// Notes that a node depends on some bits at this time.
    fn demand(&mut self, from: Option<usize>, demand: Demand) {
        let Demand { place, lane, bits, is_control } = demand;
        if bits.is_zero() {
            return;
        }
        let known = match place {
            Place::Value(id) if !self.states.contains_key(&id) => self.open.get(&(id, lane)),
            _ => self.stored.get(&(place, lane)),
        };
        let node = known.copied().unwrap_or_else(|| self.add(from, place, lane));
        let above = from.map_or(0, |from| self.nodes[from].depth + usize::from(self.nodes[node].is_shown));
        let it = &mut self.nodes[node];
        it.bits = super::mask::or(&it.bits, &bits);
        it.depth = it.depth.min(above);
        if let Some(from) = from {
            let edges = &mut self.nodes[from].edges;
            match edges.iter_mut().find(|(to, _)| *to == node) {
                Some((_, chooses)) => *chooses &= is_control,
                None => edges.push((node, is_control)),
            }
        }
    }

    fn add(&mut self, from: Option<usize>, place: Place, lane: u32) -> usize {
        let (value, is_shown, clock) = match place {
            Place::Word(memory, address) => (self.running.word_of(memory, lane, address), true, None),
            Place::Value(id) => {
                let is_shown = from.is_none() || self.limits.operations || self.names.is_named(&self.program, id, lane);
                (self.values.get(self.running, id, lane), is_shown, self.clock_of(id))
            }
        };
        let clock = clock.unwrap_or_else(|| from.map_or(0, |from| self.nodes[from].clock));
        let node = Node {
            place,
            lane,
            bits: super::mask::none(value.width()),
            value,
            time: self.running.timeline.time(),
            clock,
            cycle: self.cycles(clock),
            is_shown,
            depth: usize::MAX,
            edges: Vec::new(),
            end: None,
        };
        self.shown += usize::from(is_shown);
        self.nodes.push(node);
        let index = self.nodes.len() - 1;
        match place {
            Place::Value(id) if !self.states.contains_key(&id) => drop(self.open.insert((id, lane), index)),
            _ => drop(self.stored.insert((place, lane), index)),
        }
        index
    }

    /// The clock of a register or of read data.
    fn clock_of(&self, id: ValueId) -> Option<usize> {
        self.states.get(&id).map(|state| match *state {
            StateOf::Register(index) => self.program.registers[index as usize].clock as usize,
            StateOf::Read(memory, port) => self.program.memories[memory as usize].reads[port as usize].clock as usize,
        })
    }

    /// How many edges a clock has had; the number of instants without a clock.
    fn cycles(&self, clock: usize) -> u64 {
        self.running.timeline.cycles_of_all()[clock]
    }

    /// Visits all values of this time.
    fn visit_open(&mut self) {
        let program = self.program.clone();
        while !self.is_full()
            && let Some(((id, lane), node)) = self.open.pop_last()
        {
            let cell = &program.circuit[id];
            if matches!(cell.kind, Kind::State | Kind::Const(_)) {
                let end = if cell.kind == Kind::State { End::Input } else { End::Constant };
                self.nodes[node].end = Some(end);
            } else if self.nodes[node].depth >= self.limits.depth && self.nodes[node].is_shown {
                self.nodes[node].end = Some(End::Cut);
            } else {
                let bits = self.nodes[node].bits.clone();
                let asked = Asked { circuit: &program.circuit, cell, lane, bits: &bits };
                let mut all = demands(&asked, &mut |id, lane| self.values.get(self.running, id, lane));
                if let Kind::Read { memory, address } = cell.kind {
                    let address = self.values.get(self.running, address, lane);
                    let address = within(address.limbs(), program.memories[memory as usize].depth);
                    let place = address.map(|address| Place::Word(memory, address));
                    all.extend(place.map(|place| Demand { place, lane, bits: bits.clone(), is_control: false }));
                }
                all.into_iter().for_each(|demand| self.demand(Some(node), demand));
            }
        }
    }

    /// What the testbench, or an asynchronous reset, set at this time came from nowhere else.
    fn end_what_was_set(&mut self) {
        let set = self.stored.iter().filter_map(|(key, node)| Some((*key, *node, self.set_now(*key)?)));
        for (key, node, (end, time)) in set.collect::<Vec<_>>() {
            self.stored.remove(&key);
            let period = self.program.clocks.get(self.nodes[node].clock).map(|clock| clock.period);
            self.came_at(node, time, time / period.unwrap_or(DEFAULT_PERIOD.picoseconds()));
            self.nodes[node].end = Some(end);
        }
    }

    /// What set a state at this time, if that was no edge, and when. A word that no port writes was set at some time.
    fn set_now(&self, (place, lane): (Place, u32)) -> Option<(End, u64)> {
        let now = self.running.timeline.time();
        match place {
            Place::Word(memory, address) => {
                let word = [memory, lane, address];
                let past = self.running.past.as_ref();
                let is_written = !self.program.memories[memory as usize].writes.is_empty();
                match past.and_then(|past| past.set_word(word, now)) {
                    Some(time) if time == now || !is_written => Some((End::Testbench, time)),
                    _ if !is_written => Some((End::Start, 0)),
                    _ => None,
                }
            }
            Place::Value(id) => {
                let StateOf::Register(index) = *self.states.get(&id)? else { return None };
                let register = &self.program.registers[index as usize];
                let clock = register.clock as usize;
                let is_reset = self.running.resets[clock]
                    && self.program.clocks[clock].kind.is_asynchronous()
                    && register.reset(lane).is_some();
                is_reset.then_some((End::Reset, now))
            }
        }
    }

    fn came_at(&mut self, node: usize, time: u64, cycle: u64) {
        (self.nodes[node].time, self.nodes[node].cycle) = (time, cycle);
    }

    /// What is too far from the beginning is not followed.
    fn cut_deep(&mut self) {
        let (nodes, depth) = (&mut self.nodes, self.limits.depth);
        self.stored.retain(|_, node| {
            let is_deep = nodes[*node].depth >= depth;
            nodes[*node].end = if is_deep { Some(End::Cut) } else { None };
            !is_deep
        });
    }

    /// Nothing that is stored was written since the earliest time that is remembered.
    fn end_at_the_start(&mut self) {
        let now = self.running.timeline.time();
        let end = if now == 0 { End::Start } else { End::Unremembered };
        for node in std::mem::take(&mut self.stored).into_values() {
            self.came_at(node, now, self.cycles(self.nodes[node].clock));
            self.nodes[node].end = Some(end);
        }
    }

    /// Goes back to the last time at which something that is stored was set, or before which it was written, and puts
    /// what decided that in its place. If there is none, goes to the earliest time.
    fn go_to_the_last_write(&mut self) -> Result<bool, Error> {
        let Some(past) = &self.running.past else { return Ok(false) };
        let earliest = past.earliest();
        let periods = self.program.clocks.iter().map(|clock| clock.period);
        let period = periods.min().unwrap_or(DEFAULT_PERIOD.picoseconds());
        let (mut end, mut instants) = (self.running.timeline.time(), 1);
        while end > earliest {
            self.visit(earliest.max(end.saturating_sub(period.saturating_mul(instants))))?;
            let (begin, mut found) = (self.running.timeline.time(), None);
            while self.running.timeline.time() < end {
                if self.is_something_written() {
                    found = Some(self.running.timeline.time());
                }
                self.running.step_in_past()?;
                self.values.clear();
            }
            if let Some(time) = found {
                self.visit(time)?;
                self.resolve();
                return Ok(true);
            }
            (end, instants) = (begin, (2 * instants).min(1 << 16));
        }
        self.visit(earliest)?;
        Ok(false)
    }

    fn visit(&mut self, time: u64) -> Result<(), Error> {
        self.values.clear();
        self.running.visit(time)
    }

    /// Whether anything that is stored was set at this time, or is written at the coming edge.
    fn is_something_written(&mut self) -> bool {
        self.look_ahead();
        let all: Vec<_> = self.stored.iter().map(|(key, node)| (*key, *node)).collect();
        all.into_iter().any(|((place, lane), node)| {
            let bits = self.nodes[node].bits.clone();
            self.set_now((place, lane)).is_some()
                || match self.outcome(place, lane, &bits) {
                    Outcome::Kept(why) => self.limits.kept && !why.is_empty(),
                    Outcome::Written(_) | Outcome::Reset => true,
                }
        })
    }

    /// Finds the clocks of the coming edge.
    fn look_ahead(&mut self) -> Option<u64> {
        let until = self.running.timeline.next_time()?;
        self.running.timeline.rising_at(until, &mut self.rising);
        Some(until)
    }

    /// Puts what decided the coming edge in the place of what it writes.
    fn resolve(&mut self) {
        let Some(until) = self.look_ahead() else { return };
        let all: Vec<_> = self.stored.iter().map(|(key, node)| (*key, *node)).collect();
        let mut causes = Vec::new();
        for (key, node) in all {
            let bits = self.nodes[node].bits.clone();
            let why = match self.outcome(key.0, key.1, &bits) {
                Outcome::Kept(why) => {
                    causes.extend(why.into_iter().filter(|_| self.limits.kept).map(|demand| (node, demand)));
                    continue;
                }
                Outcome::Written(why) => why,
                Outcome::Reset => {
                    self.nodes[node].end = Some(End::Reset);
                    Vec::new()
                }
            };
            let clock = self.nodes[node].clock;
            self.came_at(node, until, self.cycles(clock) + u64::from(self.rising.contains(&clock)));
            self.stored.remove(&key);
            causes.extend(why.into_iter().map(|demand| (node, demand)));
        }
        causes.into_iter().for_each(|(node, demand)| self.demand(Some(node), demand));
    }
}

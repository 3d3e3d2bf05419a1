//! A node's array in simulation. It gets instructions, and the network reads and writes its registers.

mod banks;
mod following;
mod skipping;

use std::collections::VecDeque;
use std::ops::Range;

use tilewright_rtl::pixelflow::ARRAY;
use tilewright_rtl::pixelflow::array::{PixelArray, PixelArrayIn, PixelArrayOut};
use tilewright_rtl::pixelflow::instruction::{Instruction, Sync};
use tilewright_sim::Simulation;

pub(in crate::pixelflow) use banks::Access;
use banks::Bank;

use super::beside::Beside;
use super::words::Words;
use crate::error::Error;
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::following::{ArrayObserver, GETS, SENDS};
use crate::pixelflow::model::Timing;
use crate::pixelflow::works::Mark;

/// An array in simulation.
pub(in crate::pixelflow) type ArraySimulation = Simulation<PixelArrayIn, PixelArrayOut>;

/// An array, and its current time.
pub(in crate::pixelflow) struct Node {
    /// Its name in errors.
    name: String,
    sim: ArraySimulation,
    /// Ticks of the network since the beginning, including skipped ticks, in which nothing in the array changes.
    time: Ticks,
    chips: u32,
    /// Pixels of a chip.
    pixels: u64,
    banks: [Bank; 2],
    /// For each access that ended, its bank and the time from which the array is told.
    ended: VecDeque<(Ticks, usize)>,
    /// Clocks since the array was busy.
    rest: u32,
    latency: u32,
    /// Clocks in which it had an instruction, and their ticks.
    busy: u64,
    worked: Vec<Range<Ticks>>,
    /// The ticks in which the model expects each bank to be given.
    expected: [VecDeque<Ticks>; 2],
    /// Banks that the network has, as far as the array knows.
    claimed: [bool; 2],
    /// The time from which on its next instruction is available.
    there: Ticks,
    /// The unit at its texture port.
    beside: Beside,
    /// The observer of a pixel that is followed, and the tick in which everything has ended for long.
    observer: Option<Box<ArrayObserver>>,
    limit: Ticks,
}

impl Node {
    /// A node with such an array and that unit at its texture port, in the tick in which its first instruction is available.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn new(
        name: String,
        array: &PixelArray,
        mut sim: ArraySimulation,
        side_by_side: bool,
        beside: Beside,
    ) -> Result<Node, Error> {
        sim.set(sim.i.side_by_side, side_by_side);
        sim.set(sim.i.bank_done, 0);
        sim.set(sim.i.texture_done, false);
        let writes = [sim.i.network[0].writes, sim.i.network[1].writes, sim.i.texture.writes];
        writes.into_iter().for_each(|port| sim.set(port, false));
        sim.set(sim.i.instructions.valid, false);
        sim.try_reset()?;
        // The next edges are of the network alone, and the following ones of both clocks.
        let clocks = sim.cycles(ARRAY).expect("there is one");
        while sim.cycles(ARRAY).expect("there is one") == clocks {
            sim.try_step()?;
        }
        Ok(Node {
            name,
            sim,
            time: Timing::FETCH,
            chips: array.chips(),
            pixels: array.pixels().into(),
            banks: Default::default(),
            ended: VecDeque::new(),
            rest: 0,
            latency: array.latency(),
            busy: 0,
            worked: Vec::new(),
            expected: Default::default(),
            claimed: [false; 2],
            there: 0,
            beside,
            observer: None,
            limit: Ticks::MAX,
        })
    }

    /// Its array, for another frame.
    pub fn into_array(self) -> ArraySimulation {
        self.sim
    }

    /// Schedules an access of the network.
    pub fn access(&mut self, access: Access) {
        self.banks[access.bank].accesses.push_back(access);
    }

    /// Takes the words that a bank sent in its first access that has not been taken; `None` if that has not ended.
    pub fn sent(&mut self, bank: usize) -> Option<Words> {
        self.banks[bank].sent.pop_front()
    }

    /// Whether there are such words.
    pub fn has_sent(&self, bank: usize) -> bool {
        !self.banks[bank].sent.is_empty()
    }

    /// Clocks in which it had an instruction.
    pub fn busy(&self) -> u64 {
        self.busy
    }

    /// The ticks of these clocks, two for each.
    pub fn worked(&self) -> &[Range<Ticks>] {
        &self.worked
    }

    /// Expects it to give a bank in that tick, after all that were expected before.
    pub fn expect(&mut self, bank: usize, tick: Ticks) {
        self.expected[bank].push_back(tick);
    }

    /// The picture of the frame buffer, if the node has one.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn scan(&mut self) -> Result<Vec<[u8; 3]>, Error> {
        match &mut self.beside {
            Beside::Store(store) => store.scan(),
            _ => Ok(Vec::new()),
        }
    }

    /// Runs a program until its last instruction is taken. From a given place on, no instruction is available before that tick.
    ///
    /// # Errors
    /// [`Error::Simulation`]; [`Error::Differs`]: a bank is given in another tick than expected.
    pub fn run(&mut self, program: &[Instruction<u64>], marks: &[Mark]) -> Result<(), Error> {
        let mut marks = marks.iter().peekable();
        for (number, instruction) in program.iter().enumerate() {
            while let Some((_, tick)) = marks.next_if(|(place, _)| *place == number) {
                self.there = *tick;
            }
            self.put(instruction);
            while !self.advance(Some(instruction))? {}
        }
        Ok(())
    }

    /// Runs until the network has done all its accesses, and all expected banks are given.
    ///
    /// # Errors
    /// As [`Node::run`].
    pub fn finish(&mut self) -> Result<(), Error> {
        while self.banks.iter().any(|bank| !bank.accesses.is_empty()) || self.rest <= self.latency + 2 {
            self.advance(None)?;
        }
        self.next_expected().map_or(Ok(()), |tick| Err(self.differs(0, tick)))
    }

    fn next_expected(&self) -> Option<Ticks> {
        self.expected.iter().flatten().min().copied()
    }

    fn differs(&mut self, seen: Ticks, expected: Ticks) -> Error {
        let signal = "the tick in which a bank is given";
        let error = Error::Differs { unit: self.name.clone(), signal, clock: self.time / 2, seen, expected };
        if let Some(observer) = &mut self.observer {
            observer.fail(self.time, &error);
        }
        error
    }

    /// Advances by a tick, or by several in which nothing happens. Every second tick is a clock of the array, with the given instruction. Returns
    /// whether the instruction is taken.
    fn advance(&mut self, shown: Option<&Instruction<u64>>) -> Result<bool, Error> {
        if self.time > self.limit {
            return Err(self.differs(0, self.next_expected().unwrap_or(0)));
        }
        self.beside.now(self.time);
        if !self.is_array_edge() {
            self.tick()?;
            if shown.is_none_or(|instruction| self.waits(instruction)) {
                self.leave_out()?;
            }
            return Ok(false);
        }
        self.tell_what_ended();
        if shown.is_some_and(|instruction| self.waits(instruction)) && self.is_forgotten() {
            return Err(self.differs(0, self.next_expected().unwrap_or(0)));
        }
        // Delay an instruction that would wait for a bank, so that the controller says that it is idle.
        let shown = shown.filter(|instruction| !self.waits(instruction));
        self.sim.set(self.sim.i.instructions.valid, shown.is_some());
        let taken = shown.filter(|_| self.sim.get_u64(self.sim.i.instructions.ready) == 1);
        let given = self.sim.get_u64(self.sim.o.given.banks);
        self.count(taken.is_some());
        self.beside.clock(&mut self.sim)?;
        if let Some(observer) = &mut self.observer {
            observer.shows(shown.copied());
        }
        self.tick()?;
        if let Some(instruction) = taken {
            self.claim(instruction);
        }
        for bank in (0..2).filter(|bank| given >> bank & 1 == 1) {
            let expected = self.expected[bank].pop_front().unwrap_or(0);
            if expected != self.time {
                return Err(self.differs(self.time, expected));
            }
        }
        Ok(taken.is_some())
    }

    fn is_array_edge(&self) -> bool {
        self.time % 2 == 1
    }

    /// Counts the clock. Returns whether the array is idle.
    fn count(&mut self, taken: bool) {
        let is_idle = !taken && self.sim.get_u64(self.sim.o.idle) == 1;
        self.rest = if is_idle { self.rest + 1 } else { 0 };
        self.works(!is_idle || self.beside.is_busy(), self.time - 1);
    }

    /// Whether it is busy in a clock that begins with that tick.
    fn works(&mut self, is_busy: bool, from: Ticks) {
        if !is_busy {
            return;
        }
        self.busy += 1;
        match self.worked.last_mut().filter(|last| last.end == from) {
            Some(last) => last.end += 2,
            None => self.worked.push(from..from + 2),
        }
    }

    /// Whether the network has nothing to do, so that no bank would ever be given back.
    fn is_forgotten(&self) -> bool {
        self.banks.iter().all(|bank| bank.accesses.is_empty())
            && self.ended.is_empty()
            && !self.beside.is_busy()
            && self.is_there()
    }

    /// Whether the front end has the next instruction in this clock, which begins with an even tick.
    fn is_there(&self) -> bool {
        self.there <= self.time & !1
    }

    /// Whether an instruction is not available, or waits for a bank of the network, or for the unit at the texture port.
    fn waits(&self, instruction: &Instruction<u64>) -> bool {
        let is = |sync: Sync| instruction.sync == sync as u64;
        !self.is_there()
            || is(Sync::AwaitBank) && self.claimed[instruction.c as usize]
            || is(Sync::AwaitTexture) && self.beside.is_busy()
    }

    fn claim(&mut self, instruction: &Instruction<u64>) {
        if instruction.sync == Sync::GiveBank as u64 {
            self.claimed[instruction.c as usize] = true;
        }
    }

    /// Puts an instruction at the array's port.
    fn put(&mut self, instruction: &Instruction<u64>) {
        self.sim.set_record(self.sim.i.instructions.payload, *instruction);
    }

    /// A tick of the network, and with every second one a clock of the array.
    fn tick(&mut self) -> Result<(), Error> {
        let ends = [0, 1].map(|bank| self.transfer(bank));
        if let Some(observer) = &mut self.observer {
            observer.look(&mut self.sim, self.time, self.time % 2 == 1);
        }
        if let Err(error) = self.sim.try_step() {
            let error = error.into();
            if let Some(observer) = &mut self.observer {
                observer.fail(self.time, &error);
            }
            return Err(error);
        }
        self.time += 1;
        for number in (0..2).filter(|number| ends[*number]) {
            let bank = &mut self.banks[number];
            let access = bank.accesses.pop_front();
            if let (Some(observer), Some(access)) = (&mut self.observer, access.filter(|it| it.is_followed)) {
                let does = if access.comes.is_some() { GETS } else { SENDS };
                observer.word(&self.sim, self.time, number, access.bytes, does);
            }
            bank.sent.extend(bank.went.take());
            bank.done = 0;
            self.sim.set(self.sim.i.network[number].writes, false);
            self.ended.push_back((Timing::told(self.time), number));
        }
        Ok(())
    }
}

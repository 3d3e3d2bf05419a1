//! A node's array in simulation: it is given instructions, and the network reads and writes its registers.

use std::collections::VecDeque;

use tilewright_rtl::pixelflow::ARRAY;
use tilewright_rtl::pixelflow::array::{PixelArray, PixelArrayIn, PixelArrayOut};
use tilewright_rtl::pixelflow::instruction::{Instruction, Sync};
use tilewright_sim::{Bits, EngineKind, Simulation};

use super::texture::TextureLookUp;
use crate::error::Error;
use crate::pixelflow::costs::Ticks;

/// The bytes of a region's words, in the order of sending: of all pixels of a chip the first byte, then the second, one of each chip at a time.
pub(in crate::pixelflow) type Words = Vec<Bits>;

/// What the network does with a bank, from some tick on: a byte of each chip a tick.
#[derive(Debug)]
pub(in crate::pixelflow) struct Access {
    pub from: Ticks,
    pub bank: usize,
    /// Bytes of a word.
    pub bytes: u64,
    /// The words that come; none if those in the bank go.
    pub comes: Option<Words>,
}

/// What the network does with a bank, one access after another.
#[derive(Default)]
struct Bank {
    accesses: VecDeque<Access>,
    /// Of the first access, how many ticks are done, and what went.
    done: Ticks,
    went: Words,
    /// Words that went before.
    sent: VecDeque<Words>,
}

/// An array, and the time at which it is.
pub(in crate::pixelflow) struct Node {
    sim: Simulation<PixelArrayIn, PixelArrayOut>,
    /// Ticks of the network since the beginning, with those that were left out: then nothing in the array changes.
    time: Ticks,
    pixels: u64,
    banks: [Bank; 2],
    /// When each access ended, and its bank: the array has not yet been told.
    ended: VecDeque<(Ticks, usize)>,
    /// Clocks since the array was busy.
    rest: u32,
    latency: u32,
    /// Clocks in which it had an instruction.
    busy: u64,
    /// From when on the network could have each bank that was given last.
    given: [Ticks; 2],
    /// Banks that the network has, as far as the array knows.
    claimed: [bool; 2],
    /// What finds texels, if it has one.
    texture: Option<TextureLookUp>,
}

/// What came of a tick: whether the array took the instruction, and whether it gave a bank.
#[derive(Default)]
struct Clock {
    taken: bool,
    given: bool,
}

impl Node {
    /// A node without textures.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn new(array: &PixelArray, engine: EngineKind, side_by_side: bool) -> Result<Node, Error> {
        let mut sim = Simulation::of(array)?.on(engine);
        sim.set(sim.i.instructions.valid, false);
        sim.set(sim.i.side_by_side, side_by_side);
        sim.set(sim.i.bank_done, 0);
        sim.set(sim.i.texture_done, false);
        let writes = [sim.i.network[0].writes, sim.i.network[1].writes, sim.i.texture.writes];
        writes.into_iter().for_each(|port| sim.set(port, false));
        sim.try_reset()?;
        // The next edges are of the network alone, and those behind them of both.
        let clocks = sim.cycles(ARRAY).expect("there is one");
        while sim.cycles(ARRAY).expect("there is one") == clocks {
            sim.try_step()?;
        }
        Ok(Node {
            sim,
            time: 0,
            pixels: array.pixels().into(),
            banks: Default::default(),
            ended: VecDeque::new(),
            rest: 0,
            latency: array.latency(),
            busy: 0,
            given: [0; 2],
            claimed: [false; 2],
            texture: None,
        })
    }

    /// The same with a texture unit.
    pub fn with_textures(self, texture: TextureLookUp) -> Node {
        Node { texture: Some(texture), ..self }
    }

    /// The network will do that.
    pub fn access(&mut self, access: Access) {
        self.banks[access.bank].accesses.push_back(access);
    }

    /// The words that went from a bank in the first access whose are not yet taken; none if it has not ended.
    pub fn sent(&mut self, bank: usize) -> Option<Words> {
        self.banks[bank].sent.pop_front()
    }

    /// Clocks in which it had an instruction.
    pub fn busy(&self) -> u64 {
        self.busy
    }

    /// From when on the network could have a bank, when it was given last.
    pub fn given(&self, bank: usize) -> Ticks {
        self.given[bank]
    }

    /// Runs a program that gives a bank with its last instruction; gives the tick from which on the network may have it.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn run(&mut self, program: &[Instruction<u64>]) -> Result<Ticks, Error> {
        let mut left = program.iter();
        let mut shown = left.next();
        self.put(shown);
        loop {
            let Clock { taken, given } = self.advance(shown)?;
            if taken {
                shown = left.next();
                self.put(shown);
            }
            if given && shown.is_none() {
                return Ok(self.time);
            }
        }
    }

    /// Lets the network do all that it has to.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn finish(&mut self) -> Result<(), Error> {
        while self.banks.iter().any(|bank| !bank.accesses.is_empty()) {
            self.advance(None)?;
        }
        Ok(())
    }

    /// Goes on by a tick, or by those in which nothing happens; with every second one the array has a clock, and the instruction before it.
    fn advance(&mut self, shown: Option<&Instruction<u64>>) -> Result<Clock, Error> {
        if !self.is_array_edge() {
            self.tick()?;
            self.leave_out();
            return Ok(Clock::default());
        }
        self.tell_what_ended();
        // An instruction that would wait for a bank is held back: so the controller says that it is idle.
        let shown = shown.filter(|instruction| !self.waits(instruction));
        self.sim.set(self.sim.i.instructions.valid, shown.is_some());
        let taken = shown.filter(|_| self.sim.get_u64(self.sim.i.instructions.ready) == 1);
        let given = self.sim.get_u64(self.sim.o.given.banks);
        self.count(taken.is_some());
        if let Some(texture) = &mut self.texture {
            texture.clock(&mut self.sim)?;
        }
        self.tick()?;
        if let Some(instruction) = taken {
            self.claim(instruction);
        }
        for bank in (0..2).filter(|bank| given >> bank & 1 == 1) {
            self.given[bank] = self.time;
        }
        Ok(Clock { taken: taken.is_some(), given: given != 0 })
    }

    fn is_array_edge(&self) -> bool {
        self.time % 2 == 1
    }

    /// Goes on to the next thing that happens, if the array is at rest: then the network reads what does not change, without a clock.
    fn leave_out(&mut self) {
        if self.rest <= self.latency {
            return;
        }
        while self.is_read_alone() {
            self.pass();
        }
        let is_at_rest = self.banks.iter().all(|bank| bank.done == 0);
        let next = self.banks.iter().filter_map(|bank| Some(bank.accesses.front()?.from));
        let next = next.chain(self.ended.front().map(|(time, _)| *time)).min();
        if let Some(next) = next.filter(|_| is_at_rest) {
            // An even number of ticks, so that the clocks stay in step.
            self.time += next.saturating_sub(self.time) / 2 * 2;
        }
    }

    /// Counts the clock: whether the array rests.
    fn count(&mut self, taken: bool) {
        let is_idle = !taken && self.sim.get_u64(self.sim.o.idle) == 1;
        self.rest = if is_idle { self.rest + 1 } else { 0 };
        self.busy += u64::from(!is_idle);
    }

    /// Whether an instruction waits for a bank that the network has.
    fn waits(&self, instruction: &Instruction<u64>) -> bool {
        instruction.sync == Sync::AwaitBank as u64 && self.claimed[instruction.c as usize]
    }

    fn claim(&mut self, instruction: &Instruction<u64>) {
        if instruction.sync == Sync::GiveBank as u64 {
            self.claimed[instruction.c as usize] = true;
        }
    }

    /// Puts an instruction before the array.
    fn put(&mut self, instruction: Option<&Instruction<u64>>) {
        let Some(instruction) = instruction else { return };
        let (port, i) = (self.sim.i.instructions.payload, instruction);
        for (port, value) in [
            (port.source, i.source),
            (port.function, i.function),
            (port.begin, i.begin),
            (port.mask, i.mask),
            (port.accumulates, i.accumulates),
            (port.stores, i.stores),
            (port.condition, i.condition),
            (port.enabling, i.enabling),
            (port.flagging, i.flagging),
            (port.skip, i.skip),
            (port.length, i.length),
            (port.descends, i.descends),
            (port.read, i.read),
            (port.write, i.write),
            (port.sync, i.sync),
            (port.a, i.a),
            (port.b, i.b),
            (port.c, i.c),
        ] {
            self.sim.set(port, value);
        }
    }

    /// Whether the network reads a bank, writes none, and the array will not be told of anything before two more ticks.
    fn is_read_alone(&self) -> bool {
        let is_under_way = |bank: &Bank| bank.accesses.front().is_some_and(|access| access.from <= self.time + 1);
        let is_read = |bank: &Bank| {
            let access = bank.accesses.front().expect("it is under way");
            access.from <= self.time && access.comes.is_none() && bank.done + 2 < access.bytes * self.pixels
        };
        let mut under_way = self.banks.iter().filter(|bank| is_under_way(bank)).peekable();
        under_way.peek().is_some() && under_way.all(is_read) && self.ended.is_empty()
    }

    /// Two ticks of a network that reads, left out but for what it reads.
    fn pass(&mut self) {
        for _ in 0..2 {
            for bank in 0..2 {
                self.transfer(bank);
            }
            self.time += 1;
        }
    }

    /// A tick of the network, and with every second one a clock of the array.
    fn tick(&mut self) -> Result<(), Error> {
        let ends = [0, 1].map(|bank| self.transfer(bank));
        self.sim.try_step()?;
        self.time += 1;
        for number in (0..2).filter(|number| ends[*number]) {
            let bank = &mut self.banks[number];
            let (access, went) = (bank.accesses.pop_front(), std::mem::take(&mut bank.went));
            if access.is_some_and(|access| access.comes.is_none()) {
                bank.sent.push_back(went);
            }
            bank.done = 0;
            self.sim.set(self.sim.i.network[number].writes, false);
            self.ended.push_back((self.time, number));
        }
        Ok(())
    }

    /// In the clock behind the end of an access the array is told of it.
    fn tell_what_ended(&mut self) {
        let mut banks = 0;
        while let Some((_, bank)) = self.ended.pop_front_if(|(time, _)| *time <= self.time) {
            banks |= 1_u64 << bank;
            self.claimed[bank] = false;
        }
        self.sim.set(self.sim.i.bank_done, banks);
    }

    /// The byte of each chip of a bank whose turn it is, if it is; tells whether it is the last.
    fn transfer(&mut self, number: usize) -> bool {
        let bank = &mut self.banks[number];
        let Some(access) = bank.accesses.front().filter(|access| access.from <= self.time) else { return false };
        let (byte, pixel) = (bank.done / self.pixels, bank.done % self.pixels);
        let port = self.sim.i.network[number];
        if pixel == 0 {
            self.sim.set(port.address, access.bytes - 1 - byte);
        }
        self.sim.set(port.pixel, pixel);
        match &access.comes {
            None => bank.went.push(self.sim.get(self.sim.o.network_seen[number])),
            Some(words) => {
                self.sim.set(port.writes, true);
                self.sim.set(port.bytes, &words[bank.done as usize]);
            }
        }
        bank.done += 1;
        bank.done == access.bytes * self.pixels
    }
}

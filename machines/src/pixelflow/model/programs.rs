//! Nodes that execute their instructions, with the times of the hardware.
//!
//! A frame begins with tick 0, in which each node gets the address of its instructions, and each direction of the network its first job. The clock of
//! the arrays has two ticks.

use tilewright_rtl::pixel_planes::schedule::Schedule;
use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_rtl::pixelflow::instruction::{Instruction, Sync};
use tilewright_rtl::pixelflow::schedule::{step, take};

use super::delays::Delays;
use super::run::{Given, Run, Shaded, Stored};
use super::{Arrays, Done, Shading, Turn};
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::works::{Mark, Works};

/// Ticks of the network in a clock of an array.
const CLOCK: Ticks = 2;

/// The times of the hardware.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::pixelflow) struct Timing {
    /// Each turn.
    pub turns: Vec<Done>,
    /// The times at which its banks were given.
    pub given: Vec<Given>,
    /// The times at which each shader first gave its bank for words, and the node of the frame buffer its two banks.
    pub first_words: Vec<Ticks>,
    pub first_stores: [Ticks; 2],
}

/// The parameters of a machine for the model.
#[derive(Clone, Copy, Debug)]
pub(in crate::pixelflow) struct Built<'a> {
    pub array: &'a PixelArray,
    pub shaders: usize,
    pub side_by_side: bool,
    /// Ticks of the network's set-up before a word.
    pub set_up: Ticks,
    /// Clocks of an array for a region in a shader's texture unit, and in the frame buffer's memory.
    pub looks_up: u64,
    pub loads: u64,
}

impl Timing {
    /// From the frame's beginning in hardware to the first instruction at a node's controller, which has to be announced and fetched.
    pub const FETCH: Ticks = 3 * CLOCK;
    /// From the tick after the network's last byte of a bank to the end of the clock in which the array is told, if clocks and ticks begin together. The array
    /// is told at an edge of its own clock, which may be a tick later.
    pub const TOLD: Ticks = 2 * CLOCK;

    /// The first tick of the clock in which the array is told that the network finished with a bank before `tick`.
    pub fn told(end: Ticks) -> Ticks {
        (end - 1 + Timing::TOLD).next_multiple_of(CLOCK)
    }

    /// The times of a frame.
    pub fn new(built: &Built, works: &Works) -> Timing {
        let array = |port: u64| Array {
            schedule: Schedule::new(built.side_by_side),
            latency: built.array.latency().into(),
            from: Timing::FETCH / CLOCK,
            banks: [0; 2],
            port,
            port_done: 0,
        };
        let nodes = ByPrograms {
            works,
            rasterizers: vec![array(0); works.shares()],
            shaders: vec![array(built.looks_up); built.shaders],
            holder: array(built.loads),
        };
        let pixels = Ticks::from(built.array.pixels());
        let turn = |number: usize| {
            let sends = if works.comes_to_holder(number) { Works::COLOUR * pixels } else { 0 };
            // Its program determines its time.
            let shading = |shader| Shading { shader, takes: 0, sends };
            Turn {
                region: works.region(number) as u16,
                composes: works.bytes() * pixels,
                shades: works.shader_of(number, built.shaders).map(shading),
                loads: if works.ends(number) { built.loads * CLOCK } else { 0 },
            }
        };
        let turns: Vec<Turn> = (0..works.turns()).map(turn).collect();
        let run = Run::new(nodes, Delays::of_hardware(built.set_up), &turns, false);
        let (first_words, first_stores) = (run.first_words(), run.first_stores());
        let run = run.run();
        Timing { turns: run.done, given: run.given, first_words, first_stores }
    }
}

/// All nodes of a frame.
struct ByPrograms<'a> {
    works: &'a Works,
    rasterizers: Vec<Array>,
    shaders: Vec<Array>,
    holder: Array,
}

impl Arrays for ByPrograms<'_> {
    fn counts(&self) -> [usize; 2] {
        [self.rasterizers.len(), self.shaders.len()]
    }

    fn first_words(&mut self) -> Vec<Ticks> {
        let program = Works::first_of_shader();
        self.shaders.iter_mut().map(|shader| shader.run(&program, &[]).given[0]).collect()
    }

    fn first_stores(&mut self) -> [Ticks; 2] {
        self.holder.run(&Works::first_of_holder(), &[]).given
    }

    fn draw(&mut self, number: usize, _: &Turn, free: &[Ticks]) -> Vec<Ticks> {
        let bank = number % 2;
        let draw = |(share, (array, free)): (usize, (&mut Array, &Ticks))| {
            array.bank_done(bank, *free);
            array.run(self.works.program(share, number), self.works.marks(share, number)).given[bank]
        };
        self.rasterizers.iter_mut().zip(free).enumerate().map(draw).collect()
    }

    fn shade(&mut self, number: usize, shading: &Shading, arrived: Ticks, sent: Ticks) -> Shaded {
        let array = &mut self.shaders[shading.shader];
        array.bank_done(0, arrived);
        array.bank_done(1, sent);
        let ran = array.run(self.works.shading(number), &[]);
        // Colours of other samples stay in the shader.
        let end = if self.works.comes_to_holder(number) { ran.given[1] } else { ran.given[0] };
        Shaded { at: ran.began..end, next_word: ran.given[0] }
    }

    fn load(&mut self, number: usize, _: &Turn, arrived: Ticks) -> Stored {
        let bank = self.works.holders_bank(number);
        self.holder.bank_done(bank, arrived);
        let ran = self.holder.run(&self.works.storing(number), &[]);
        let (given, written) = (ran.given[bank], CLOCK * self.holder.port_done);
        let at = if self.works.ends(number) { written - CLOCK * self.holder.port..written } else { given..given };
        Stored { at, given }
    }
}

/// A node's array, and the units for which it waits.
#[derive(Clone)]
struct Array {
    schedule: Schedule,
    /// Clocks from an instruction's end in the controller to its end in the pixels.
    latency: u64,
    /// The clock of the first instruction.
    from: u64,
    /// The clocks from which on each bank, and the unit at the texture port, are ready.
    banks: [u64; 2],
    /// The clocks of the unit at the texture port, and the clock from which on it is ready.
    port: u64,
    port_done: u64,
}

/// The times of a program.
struct Ran {
    /// The time at which its first instruction was taken.
    began: Ticks,
    /// The time at which each bank was last given.
    given: [Ticks; 2],
}

impl Array {
    /// Notes that the network finished with a bank before that tick; 0 if it never had it.
    fn bank_done(&mut self, bank: usize, end: Ticks) {
        // A flag crosses and is stored: the bank is ready in the next clock.
        self.banks[bank] = if end == 0 { 0 } else { Timing::told(end) / CLOCK + 1 };
    }

    /// Takes the instructions of a program. Those from a given place on are not available before a given time.
    fn run(&mut self, program: &[Instruction<u64>], marks: &[Mark]) -> Ran {
        let mut marks = marks.iter().peekable();
        let mut ran = Ran { began: 0, given: [0; 2] };
        for (number, instruction) in program.iter().enumerate() {
            while let Some((_, tick)) = marks.next_if(|(place, _)| *place == number) {
                self.from = self.from.max(tick.div_ceil(CLOCK));
            }
            let is = |sync: Sync| instruction.sync == sync as u64;
            let bank = instruction.c as usize;
            let bank_is_there = if is(Sync::AwaitBank) { self.banks[bank] } else { 0 };
            let port_is_done = if is(Sync::AwaitTexture) { self.port_done } else { 0 };
            let from = self.from.max(bank_is_there).max(port_is_done);
            let times = take(&mut self.schedule, instruction, &step(instruction), from);
            if number == 0 {
                ran.began = CLOCK * times.taken;
            }
            let in_pixels = times.ends + self.latency;
            if is(Sync::GiveBank) {
                ran.given[bank] = CLOCK * in_pixels;
            }
            if is(Sync::StartTexture) {
                self.port_done = in_pixels + self.port;
            }
        }
        ran
    }
}

//! A node's array in each clock, as far as it is about one pixel.

mod nets;
mod tell;

use std::collections::{BTreeMap, VecDeque};

use tilewright_hdl::Codes;
use tilewright_rtl::pixelflow::TRANSFER;
use tilewright_rtl::pixelflow::emulator::Pixel;
use tilewright_rtl::pixelflow::instruction::Instruction;
use tilewright_rtl::pixelflow::pixel::{Control, Mask};
use tilewright_sim::Memory;

use super::commands::{Commands, FIELDS, Taken, control_of, instruction};
use crate::looks::Looks;
use crate::pixelflow::hardware::ArraySimulation as Sim;
use crate::told::{Checks, Told, Unit};
use crate::way::Step;

/// The place of a pixel in an array: the chip and its number there, and the column and the line.
#[derive(Clone, Copy, Debug)]
pub(in crate::pixelflow) struct Place {
    pub chip: u32,
    pub pixel: u32,
    pub at: [u32; 2],
}

/// The registers of a bank.
struct Registers {
    unit: Unit,
    first: usize,
    bytes: Vec<u8>,
    /// What the array wrote, and what the port wrote.
    memories: Option<[Memory; 2]>,
    /// The addresses that were written, or could have been.
    written: [usize; 2],
    /// The place of its nets among those of all units, and of those of banks alone.
    nets: usize,
    port: usize,
}

impl Registers {
    /// A register of the hardware.
    fn register(&self, sim: &Sim, address: usize) -> Option<u64> {
        let words = self.memories?.map(|memory| sim.word(memory, address as u32).to_u64().unwrap_or(0));
        Some(words[0] ^ words[1])
    }
}

/// A node of the pixel.
pub(in crate::pixelflow) struct ArrayObserver {
    pub told: Told,
    place: Place,
    /// The words that were drawn, by primitive.
    pub drawn: BTreeMap<usize, u64>,
    lag: usize,
    units: [Unit; 4],
    banks: Vec<Registers>,
    commands: Commands,
    /// Sums of an expression's bytes, their number, and the bytes to come.
    sums: [i128; 3],
    count: u32,
    to_come: VecDeque<Option<u64>>,
    seen: VecDeque<[u64; 2]>,
    pixel: Option<Pixel>,
    memory: Option<Memory>,
    written: usize,
    looks: Looks,
    /// The nets that matter in ticks of the network alone: those of banks.
    ports: Looks,
    places: [usize; 6],
    pairs: Vec<(&'static str, [usize; 2])>,
    /// The instructions that are of the pixel's region, and are told: the number of their primitive, if they are one's.
    programs: VecDeque<(usize, Vec<Option<usize>>)>,
    shown: Option<Instruction<u64>>,
}

impl ArrayObserver {
    /// The instruction that is offered.
    pub fn shows(&mut self, instruction: Option<Instruction<u64>>) {
        self.shown = instruction;
    }

    /// Looks at all units before the edge that ends a tick; every second one is an edge of the array.
    pub fn look(&mut self, sim: &mut Sim, tick: u64, is_array_edge: bool) {
        if is_array_edge || self.pixel.is_none() {
            self.looks.look(sim);
        }
        if !is_array_edge {
            self.ports.look(sim);
        }
        self.told.at(sim.time() + TRANSFER.picoseconds());
        self.init(sim);
        let clock = tick / 2;
        let mut checks = Checks::default();
        if is_array_edge {
            self.tell_what_ended(sim, clock);
            self.wire(&mut checks);
            self.note(3, clock, "connects its units", &mut checks);
            let [controller, control, ..] = self.places;
            let fields = self.looks.from(controller);
            let nets = self.looks.from(controller + FIELDS.len());
            let taken = self.commands.look(clock, fields, nets, self.looks.from(control), &mut checks);
            self.note(0, clock, "controls evaluator and pixels", &mut checks);
            self.evaluate(clock, &mut checks);
            self.note(1, clock, "evaluates an expression", &mut checks);
            self.look_at_pixel(sim, &mut checks);
            self.note(2, clock, "works on a byte", &mut checks);
            if let Some(taken) = taken {
                self.takes(clock, &taken);
            }
        }
        self.look_at_registers(sim, tick, is_array_edge);
    }

    fn note(&mut self, unit: usize, clock: u64, does: &str, checks: &mut Checks) {
        self.told.extend(self.units[unit].differing(clock, does, checks));
    }

    fn init(&mut self, sim: &Sim) {
        if self.pixel.is_some() {
            return;
        }
        let lane = format!("[{}][{}]", self.place.chip, self.place.pixel);
        let memory = sim.memory(&format!("u_pixel{lane}.memory")).expect("a pixel has a memory");
        let mut pixel = Pixel::new();
        let byte = |address: usize| sim.word(memory, address as u32).to_u64().unwrap_or(0) as u8;
        (0..256).for_each(|address| pixel.memory[address] = byte(address));
        let [accumulator, carry, flag, enable] = self.looks.from(self.places[3] + 4);
        (pixel.accumulator, pixel.carry, pixel.flag, pixel.enable) =
            (accumulator as u8, carry == 1, flag == 1, enable as u32);
        for bank in &mut self.banks {
            bank.memories = Some(["by_array", "by_port"].map(|memory| {
                sim.memory(&format!("{}{memory}{lane}", bank.unit.path)).expect("each side of a bank has a memory")
            }));
            for address in 0..bank.bytes.len() {
                bank.bytes[address] = bank.register(sim, address).unwrap_or(0) as u8;
            }
        }
        (self.pixel, self.memory) = (Some(pixel), Some(memory));
    }

    /// Compares both ends of the wires between the units, and the instruction with that of the front end.
    fn wire(&self, checks: &mut Checks) {
        for (what, [to, from]) in &self.pairs {
            checks.same(what, self.looks.at(*to), self.looks.at(*from));
        }
        let [controller, control, _, pixel, ..] = self.places;
        let [.., read, write] = self.looks.from::<13>(control);
        let [_, register, result, writes, ..] = self.looks.from::<8>(pixel);
        for (bank, number) in self.banks.iter().zip(0..) {
            let is_here = |address: u64| {
                if number < 2 { address >> 6 & 1 == 0 && address >> 5 & 1 == number } else { address >> 6 & 1 == 1 }
            };
            let [to_read, to_write, _, _, _, to_writes, to_result, word, ..] = self.looks.from::<10>(bank.nets);
            let last = bank.bytes.len() as u64 - 1;
            checks.same("a bank's read", to_read, read & last);
            checks.same("a bank's write", to_write, write & last);
            checks.bit("a bank's writes", to_writes, writes == 1 && is_here(write));
            checks.same("a bank's result", to_result, result);
            if is_here(read) && read >= 256 {
                checks.same("register_byte", register, word);
            }
        }
        if let Some(shown) = &self.shown {
            let seen = instruction(self.looks.from(controller));
            if seen != *shown {
                checks.same("instruction", format!("{seen:?}"), format!("{shown:?}"));
            }
        }
    }

    fn evaluate(&mut self, clock: u64, checks: &mut Checks) {
        let [a, b, c, first, sends, seen] = self.looks.from(self.places[4]);
        if first == 1 {
            (self.sums, self.count) = ([0; 3], 0);
        }
        let under_way = |it: &&Taken| it.is_expression() && (it.times.begins..it.times.ends).contains(&clock);
        let is_used = sends == 1 && self.commands.under_way.iter().any(|it| under_way(&it));
        self.to_come.push_back(is_used.then(|| {
            let [x, y] = self.place.at.map(i128::from);
            for (sum, byte) in self.sums.iter_mut().zip([a, b, c]) {
                *sum |= i128::from(byte) << (8 * self.count).min(119);
            }
            let [a, b, c] = self.sums;
            ((a * x + b * y + c) >> (8 * self.count).min(119) & 0xff) as u64
        }));
        self.count += 1;
        let expected = self.to_come.pop_front().flatten();
        if let Some(expected) = expected {
            checks.same("value", seen, expected);
            self.seen.push_back([seen, expected]);
            if self.seen.len() > 16 {
                self.seen.pop_front();
            }
        }
    }

    fn look_at_pixel(&mut self, sim: &mut Sim, checks: &mut Checks) {
        let [_, _, lanes, of_pixel, ..] = self.places;
        let [expression, register, result, writes_register, accumulator, carry, flag, enable] =
            self.looks.from(of_pixel);
        let (Some(pixel), Some(memory)) = (&mut self.pixel, self.memory) else { return };
        checks.same("accumulator", accumulator, pixel.accumulator.into());
        checks.bit("carry", carry, pixel.carry);
        checks.bit("flag", flag, pixel.flag);
        checks.same("enable", enable, pixel.enable.into());
        let written = sim.word(memory, self.written as u32).to_u64().unwrap_or(0);
        checks.same("memory", written, pixel.memory[self.written].into());
        let Some(control) = control_of(self.looks.from(lanes)) else { return };
        if control.read >= 256 {
            pixel.memory[control.read as usize] = register as u8;
        }
        let writes = writes(pixel, &control);
        let is_register = writes && control.stores == 1 && control.write >= 256;
        checks.bit("writes_register", writes_register, is_register);
        pixel.step(&control, expression as u8);
        if is_register {
            checks.same("result", result, pixel.memory[control.write as usize].into());
        }
        if control.write < 256 {
            self.written = control.write as usize;
        }
    }

    fn look_at_registers(&mut self, sim: &mut Sim, tick: u64, is_array_edge: bool) {
        let control_read = if is_array_edge { self.looks.at(self.places[1] + 11) } else { 0 };
        for (number, bank) in self.banks.iter_mut().enumerate() {
            let mut checks = Checks::default();
            let [read, write, pixel, address, port_writes, writes, result, word, bytes, seen] =
                if is_array_edge { self.looks.from(bank.nets) } else { self.ports.from(bank.port) };
            for written in bank.written {
                if let Some(kept) = bank.register(sim, written) {
                    checks.same("word", kept, bank.bytes[written].into());
                }
            }
            let here = pixel == u64::from(self.place.pixel);
            let at = |address: u64| (address as usize).min(bank.bytes.len() - 1);
            if here {
                checks.same("seen", seen, bank.bytes[at(address)].into());
            }
            let is_read = control_read >= 256
                && match number {
                    2 => control_read >= 320,
                    _ => control_read < 320 && control_read >> 5 & 1 == number as u64,
                };
            if is_array_edge && is_read {
                checks.same("word", word, bank.bytes[at(read)].into());
            }
            let (to, port) = (at(write), at(address));
            if is_array_edge && writes == 1 {
                bank.bytes[to] = result as u8;
            }
            // The texture unit's port has the array's clock.
            let is_port_edge = number < 2 || is_array_edge;
            if is_port_edge && here && port_writes == 1 {
                bank.bytes[port] = bytes as u8;
            }
            bank.written = [to, port];
            let step = bank.unit.differing(tick / 2, "keeps bytes for array and port", &mut checks);
            self.told.extend(step.map(|step| Step { time: tick * 5000, ..step }));
        }
    }
}

/// Whether a pixel writes the result.
fn writes(pixel: &Pixel, control: &Control<u64>) -> bool {
    match Mask::ALL[control.mask as usize] {
        Mask::Nobody => false,
        Mask::Everybody => true,
        Mask::Enabled => pixel.is_enabled(),
        Mask::Flagged => pixel.flag,
    }
}

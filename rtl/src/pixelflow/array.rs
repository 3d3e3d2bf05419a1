//! The array: controller, linear evaluator, pixels, and the communication registers between the pixels and the ports
//! (PFL-NODE, facts E4).
//!
//! ```text
//!                  .---------------------- array ----------------------.
//! instructions ===>|[ controller ]---- a, b, c ---->[ evaluator ]      |
//!     done ------->|      |    |                          | a x + b y + c
//!     given <------|------'    '--- control ----.         v            |
//!                  |                            '-->[ W x H pixels ]   |
//!                  |                                  ^    | result    |
//!                  |                             byte |    v           |
//! network <=======>|========================[ 2 banks of 32 registers ]|
//! texture unit <==>|========================[      64 registers       ]|
//!                  '---------------------------------------------------'
//! ```
//!
//! A pixel addresses 256 bytes of memory. Above them are the communication registers: the network's bank 0 from 256,
//! its bank 1 from 288, and the texture unit's registers from 320. While the network has one bank, the pixels work with
//! the other one.
//!
//! The ports access one pixel of each chip at a time ([`registers`](super::registers)); the network's port has its own
//! clock.
//!
//! Latency and throughput are those of the instructions ([`controller`](super::controller)).

use super::controller::{ArrayController, ArrayControllerIn, BANKS, Given};
use super::instruction::Instruction;
use super::linear_evaluator::{LinearEvaluator, LinearEvaluatorIn};
use super::network_port::NetworkPort;
use super::pixel::{PixelProcessor, PixelProcessorIn};
use super::registers::{CommunicationRegisters, CommunicationRegistersIn, PortAccess};
use super::{ARRAY, NETWORK, extents};
use crate::prelude::*;

block! {
    /// Pixels that compute under one instruction stream.
    pub struct PixelArray {
        /// Pixels in a line of a region.
        width: u32,
        /// Lines in a region.
        height: u32,
    }
    latency = "the clocks of the instructions; a port's byte within the clock";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE)";
    in(self) PixelArrayIn {
        /// The instructions; all coefficients are relative to the region.
        instructions: stream(Instruction).on(ARRAY),
        /// Evaluator and memory may each have an instruction; while it is low, one begins when the one before has ended.
        side_by_side: bit().on(ARRAY),
        /// The network is done with a bank: a bit for each.
        bank_done: bits(BANKS).on(ARRAY),
        /// The texture unit is done.
        texture_done: bit().on(ARRAY),
        /// From the network, of each bank.
        network: [PortAccess::widths(&self.bank()).on(NETWORK); BANKS],
        /// From the texture unit.
        texture: PortAccess::widths(&self.texture()).on(ARRAY),
    }
    out(self) PixelArrayOut {
        /// To network and texture unit: after the next edge the registers contain the results of all instructions so far.
        given: Given,
        /// To the network, from each bank: a byte of each chip.
        network_seen: [bits(8).of(row(self.chips())); BANKS],
        /// To the texture unit: a byte of each chip.
        texture_seen: bits(8).of(row(self.chips())),
        /// Every instruction has ended except in the pixels, which are as late as the evaluator.
        idle: bit(),
    }
}

impl PixelArray {
    /// An array of `width` x `height` pixels, each a power of two from 2 to 256.
    ///
    /// # Errors
    ///
    /// There is no such array.
    pub fn new(width: u32, height: u32) -> Result<PixelArray, ParameterError> {
        let [width, height] = extents(width, height)?;
        Ok(PixelArray { width, height })
    }

    /// Pixels in a line.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Lines.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Chips: two lines each.
    pub fn chips(&self) -> u32 {
        self.height / 2
    }

    /// Pixels of a chip.
    pub fn pixels(&self) -> u32 {
        2 * self.width
    }

    /// Clocks from the end of an instruction in the controller to its end in the pixels.
    pub fn latency(&self) -> u32 {
        LinearEvaluator { width: self.width, height: self.height }.latency()
    }

    /// The signals to and from a direction of the network.
    pub fn network_port(&self) -> NetworkPort {
        NetworkPort { chips: self.chips(), pixels: self.pixels(), width: 8 }
    }

    /// A bank of the network's registers.
    pub fn bank(&self) -> CommunicationRegisters {
        CommunicationRegisters { width: self.width, height: self.height, bytes: 32, port: NETWORK }
    }

    /// The texture unit's registers.
    pub fn texture(&self) -> CommunicationRegisters {
        CommunicationRegisters { bytes: 64, port: ARRAY, ..self.bank() }
    }

    fn build(&self, m: Module, i: PixelArrayIn) -> PixelArrayOut {
        let PixelArray { width, height } = *self;
        let pixels = grid(self.chips(), self.pixels());
        let array = m.on(ARRAY);
        let PixelArrayIn { instructions, side_by_side, bank_done, texture_done, .. } = i;
        let controller = ArrayControllerIn { instructions, side_by_side, bank_done, texture_done };
        def!(controller = array.instance(&ArrayController { width, height }, controller));
        let evaluator = LinearEvaluatorIn {
            coefficients: controller.coefficients,
            first: controller.first,
            sends: controller.sends,
        };
        def!(evaluator = array.instance(&LinearEvaluator { width, height }, evaluator));

        let control = controller.control;
        let [result, writes] = [("result", bits(8)), ("writes_register", bit())]
            .map(|(name, bits)| m.wire(name, bits.of(pixels).on(ARRAY)));
        // The upper half of the 128 registers belongs to the texture unit.
        let [low, high] = [5, 6];
        let registers = |name: &str, block: CommunicationRegisters, here: &dyn Fn(Signal) -> Signal, port| {
            let inputs = CommunicationRegistersIn {
                read: control.read.trunc(below(block.bytes)),
                write: control.write.trunc(below(block.bytes)),
                writes: *writes & here(control.write),
                result: *result,
                port,
            };
            m.instance(name, &block, inputs)
        };
        let is_bank = |number: u32| move |address: Signal| !address.bit(high) & address.bit(low).eq(number);
        let mut banks = Vec::new();
        for (number, port) in (0..BANKS).zip(i.network) {
            banks.push(registers(&format!("u_bank{number}"), self.bank(), &is_bank(number), port));
        }
        let texture = registers("u_texture", self.texture(), &|address| address.bit(high), i.texture);
        let read = control.read;
        let of_banks = mux(read.bit(low), banks[1].word, banks[0].word);

        def!(
            pixel = array.array(pixels, &PixelProcessor { depth: PixelProcessor::DEPTH }, |_| PixelProcessorIn {
                control: control.map(|field| field.of(pixels)),
                expression: evaluator.value,
                register_byte: mux(read.bit(high), texture.word, of_banks),
            })
        );
        result.drive(pixel.result);
        writes.drive(pixel.writes_register);
        PixelArrayOut {
            given: controller.given,
            network_seen: banks.iter().map(|bank| bank.seen).collect(),
            texture_seen: texture.seen,
            idle: controller.idle,
        }
    }
}

#[cfg(test)]
mod tests;

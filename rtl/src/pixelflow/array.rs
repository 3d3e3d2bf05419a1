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
//! The ports access one pixel of each chip at a time ([`registers`](super::registers)). The network's port has its own
//! clock.
//!
//! Latency and throughput: those of the instructions ([`controller`](super::controller)).

use super::controller::{ArrayController, ArrayControllerIn, BANKS, Given};
use super::instruction::Instruction;
use super::linear_evaluator::{LinearEvaluator, LinearEvaluatorIn};
use super::network_port::NetworkPort;
use super::pixel::{PixelProcessor, PixelProcessorIn};
use super::registers::{CommunicationRegisters, CommunicationRegistersIn, PortAccess};
use super::{ARRAY, NETWORK, SIDES};
use crate::prelude::*;

block! {
    /// Pixels that execute one instruction stream.
    pub struct PixelArray {
        /// The number of pixels in a line of a region.
        pub width: u32,
        /// The number of lines of a region; a chip has two.
        pub height: u32,
    }
    ranges { width: powers_of_two(SIDES), height: powers_of_two(SIDES) }
    latency = "the clocks of the instructions; 0 clocks for a port to read a byte";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE)";
    in(self) PixelArrayIn {
        /// The instructions; all coefficients are relative to the region.
        instructions: stream(Instruction).on(ARRAY),
        /// Evaluator and memory may execute two instructions at once; while this is low, they execute one at a time.
        side_by_side: bit().on(ARRAY),
        /// For one clock: the network is done with a bank; a bit for each.
        bank_done: bits(BANKS).on(ARRAY),
        /// For one clock: the texture unit is done.
        texture_done: bit().on(ARRAY),
        /// For each bank: the network's access.
        network: [PortAccess::widths(&self.bank()).on(NETWORK); BANKS],
        /// The texture unit's access to its registers.
        texture: PortAccess::widths(&self.texture()).on(ARRAY),
    }
    out(self) PixelArrayOut {
        /// The hand-over to network and texture unit: after the next edge the registers have all results so far.
        given: Given,
        /// For each bank: the byte of each chip that the network reads.
        network_seen: [bits(8).of(row(self.chips())); BANKS],
        /// The byte of each chip that the texture unit reads.
        texture_seen: bits(8).of(row(self.chips())),
        /// All instructions have left the controller; the pixels execute the last one after the evaluator's latency.
        idle: bit(),
    }
}

impl PixelArray {
    /// The number of chips, which have two lines each.
    pub fn chips(&self) -> u32 {
        self.height / 2
    }

    /// The number of pixels of a chip.
    pub fn pixels(&self) -> u32 {
        2 * self.width
    }

    /// The clocks from the end of an instruction in the controller to its end in the pixels.
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

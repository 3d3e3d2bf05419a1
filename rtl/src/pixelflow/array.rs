//! The array: controller, linear evaluator, pixels, and the communication registers between them and the ports (PFL-NODE, facts E4).
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
//! texture unit <==>|========================[ 64 registers            ]|
//!                  '---------------------------------------------------'
//! ```
//!
//! A pixel's addresses are 256 bytes of memory, of the network's registers bank 0 from 256 and bank 1 from 288 on, and the texture unit's
//! from 320 on. While the network has one bank, the pixels work with the other one.
//!
//! The ports see a pixel of each chip at a time ([`registers`](super::registers)); the network's is on its own clock.
//!
//! Latency and throughput: those of the instructions ([`controller`](super::controller)).

use super::controller::{ArrayController, ArrayControllerIn, BANKS, Given};
use super::instruction::Instruction;
use super::linear_evaluator::{LinearEvaluator, LinearEvaluatorIn};
use super::pixel::{PixelProcessor, PixelProcessorIn};
use super::registers::{CommunicationRegisters, CommunicationRegistersIn, PortAccess};
use super::{ARRAY, NETWORK, extents};
use crate::prelude::*;

block! {
    /// Pixels that compute under one instruction stream.
    pub struct PixelArray {
        /// Pixels in a line of a region.
        width: u32,
        /// Its lines.
        height: u32,
    }
    latency = "the clocks of the instructions; a port's byte within the clock";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE)";
    in(self) PixelArrayIn {
        /// What to do; all coefficients are relative to the region.
        instructions: stream(Instruction = Instruction::widths()).on(ARRAY),
        /// Evaluator and memory may each have an instruction; while it is low, one begins when the one before has ended.
        side_by_side: bit().on(ARRAY),
        /// The network has done with a bank: a bit for each.
        bank_done: bits(BANKS).on(ARRAY),
        /// The texture unit has done.
        texture_done: bit().on(ARRAY),
        /// From the network: what it sees of both banks.
        network: PortAccess = self.registers(NETWORK).access().on(NETWORK),
        /// From the texture unit.
        texture: PortAccess = self.registers(ARRAY).access().on(ARRAY),
    }
    out(self) PixelArrayOut {
        /// To network and texture unit: at the edge behind it is what the instructions so far have written.
        given: Given = Given { banks: bits(BANKS), texture: bit() },
        /// To the network: a byte of each chip.
        network_seen: bits(8).of(row(self.chips())),
        /// To the texture unit.
        texture_seen: bits(8).of(row(self.chips())),
        /// Every instruction has ended, but in the pixels, which are as late as the evaluator.
        idle: bit(),
    }
}

impl PixelArray {
    /// An array of so many pixels, powers of two from 2 to 256.
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

    fn registers(&self, port: Clock) -> CommunicationRegisters {
        CommunicationRegisters { width: self.width, height: self.height, port }
    }

    fn build(&self, m: Module, i: PixelArrayIn) -> PixelArrayOut {
        let PixelArray { width, height } = *self;
        let pixels = grid(height, width);
        let array = m.on(ARRAY);
        let PixelArrayIn { instructions, side_by_side, bank_done, texture_done, .. } = i;
        let controller = ArrayControllerIn { instructions, side_by_side, bank_done, texture_done };
        let controller = array.instance("u_controller", &ArrayController { width, height }, controller);
        let evaluator = LinearEvaluatorIn { coefficients: controller.coefficients, first: controller.first };
        let evaluator = array.instance("u_evaluator", &LinearEvaluator { width, height }, evaluator);

        let control = controller.control;
        let [result, writes] = [("result", bits(8)), ("writes_register", bit())]
            .map(|(name, bits)| m.wire(name, bits.of(pixels).on(ARRAY)));
        let registers = |name, clock, half: u64, port| {
            let in_half = control.write.bit(6).eq(half);
            let inputs = CommunicationRegistersIn {
                read: control.read.trunc(below(CommunicationRegisters::BYTES)),
                write: control.write.trunc(below(CommunicationRegisters::BYTES)),
                writes: *writes & in_half,
                result: *result,
                port,
            };
            m.instance(name, &self.registers(clock), inputs)
        };
        let network = registers("u_network", NETWORK, 0, i.network);
        let texture = registers("u_texture", ARRAY, 1, i.texture);

        let pixel =
            array.array("u_pixel", pixels, &PixelProcessor { depth: PixelProcessor::DEPTH }, |_| PixelProcessorIn {
                control: control.map(|field| field.of(pixels)),
                expression: evaluator.value,
                register_byte: mux(control.read.bit(6), texture.word, network.word),
            });
        result.drive(pixel.result);
        writes.drive(pixel.writes_register);
        PixelArrayOut {
            given: controller.given,
            network_seen: network.seen,
            texture_seen: texture.seen,
            idle: controller.idle,
        }
    }
}

#[cfg(test)]
mod tests;

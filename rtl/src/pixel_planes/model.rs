//! The effect of instructions on the pixels of a region, one after another: the definition, for tests.

use super::instruction::{Instruction, Operation};
use super::linear_tree::Coefficients;
use super::pixel::PixelProcessor;
use crate::prelude::Codes;

/// A pixel.
#[derive(Clone, PartialEq, Eq)]
pub(super) struct Pixel {
    pub memory: Vec<bool>,
    pub enable: bool,
    pub flag: bool,
}

impl Pixel {
    fn new() -> Pixel {
        Pixel { memory: vec![false; PixelProcessor::BITS as usize], enable: false, flag: false }
    }

    /// The word of `length` bits at an address.
    pub fn word(&self, address: u64, length: u64) -> u64 {
        (0..length).map(|bit| u64::from(self.memory[(address + bit) as usize]) << bit).sum()
    }

    fn write(&mut self, address: u64, length: u64, word: u64) {
        for bit in 0..length {
            self.memory[(address + bit) as usize] = word >> bit & 1 == 1;
        }
    }

    /// Executes an instruction whose expression is `value` at this pixel.
    fn run(&mut self, operation: Operation, instruction: &Instruction<u64>, value: i128) {
        let &Instruction { skip, length, read, write, .. } = instruction;
        let mask = u64::MAX >> (64 - length);
        let new = (value >> skip) as u64 & mask;
        let inside = value >> (skip + length - 1) & 1 == 0;
        let kept = self.word(read, length);
        let (enable, flag) = (self.enable, self.flag);
        let mut write_if = |condition: bool, word: u64| {
            if condition {
                self.write(write, length, word);
            }
        };
        match operation {
            Operation::Enable => self.enable = true,
            Operation::Disable => self.enable = false,
            Operation::TestFirst => self.enable = inside,
            Operation::Test => self.enable &= inside,
            Operation::TestLast => {
                self.enable &= inside;
                self.flag = self.enable;
            }
            Operation::Flag => self.flag = self.enable,
            Operation::Evaluate | Operation::Fill => write_if(true, new),
            Operation::EvaluateEnabled => write_if(enable, new),
            Operation::EvaluateFlagged | Operation::FillFlagged => write_if(flag, new),
            Operation::Add => write_if(enable, new.wrapping_add(kept) & mask),
            Operation::Compare => {
                write_if(true, new);
                self.flag = self.enable && new < kept;
            }
            Operation::CompareOn => {
                write_if(true, new);
                self.flag = self.enable && (new < kept || new == kept && self.flag);
            }
            Operation::CompareConstant => self.flag = new < kept,
            Operation::Copy => write_if(true, kept),
            Operation::CopyFlagged => write_if(flag, kept),
            Operation::Save | Operation::Curve => {}
        }
    }
}

/// A region, and the regions that were saved.
pub(super) struct Model {
    side: u32,
    /// The coefficients of x², x y and y² for the next expression.
    curve: [i128; 3],
    /// The pixels of the region, line by line.
    pub pixels: Vec<Pixel>,
    /// The numbers of regions, and the words of their pixels.
    pub saved: Vec<(u64, Vec<u64>)>,
}

impl Model {
    pub fn new(side: u32) -> Model {
        Model { side, curve: [0; 3], pixels: vec![Pixel::new(); (side * side) as usize], saved: Vec::new() }
    }

    pub fn run(&mut self, instruction: &Instruction<u64>) {
        let operation = Operation::ALL[instruction.operation as usize];
        let Coefficients { a, b, c } = instruction.coefficients;
        let [a, b, c] = [a, b, c].map(|coefficient| i128::from((coefficient << 24) as i64 >> 24));
        if operation == Operation::Save {
            let words = self.pixels.iter().map(|pixel| pixel.word(instruction.read, instruction.length)).collect();
            self.saved.push((c as u64, words));
        }
        if operation == Operation::Curve {
            self.curve = [a, b, c];
        }
        let on_expression = operation.microcode().source == super::pixel::Source::Expression.code();
        let [d, e, f] = if on_expression { std::mem::take(&mut self.curve) } else { [0; 3] };
        for (number, pixel) in (0..).zip(&mut self.pixels) {
            let [x, y] = [number % self.side, number / self.side].map(i128::from);
            let value = a * x + b * y + c + d * x * x + e * x * y + f * y * y;
            pixel.run(operation, instruction, if on_expression { value } else { c });
        }
    }
}

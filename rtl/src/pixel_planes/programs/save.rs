//! Saves a region under its number, once the previous region has been sent.

use super::super::fields::WORD;
use super::super::instruction::{Instruction, Operation};
use super::{EdgeUse, Operand, Program, Step};

/// The program: 48 clocks.
pub const SAVE: Program = Program {
    name: "save",
    edges: EdgeUse::None,
    is_flat: true,
    steps: &[Step::on(Operation::Save, Operand::Number, WORD)],
};

/// The instruction that saves a region with that number.
pub fn save(region: u32) -> Vec<Instruction<u64>> {
    SAVE.of_region(region)
}

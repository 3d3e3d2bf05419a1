//! A model of how the controller treats instructions, for tests: written independently, from the codes of their fields.

use super::emulator::{control, is_by_sign, is_conditional};
use super::instruction::Instruction;
use super::pixel::{Control, Enabling, Flagging, Function, Mask, Source};
use crate::pixel_planes::schedule::Step;
use crate::prelude::Codes;

/// The control of a pixel for each byte of the word, one after another.
pub(super) fn controls(i: &Instruction<u64>) -> Vec<Control<u64>> {
    (0..i.length).map(|byte| control(i, byte)).collect()
}

/// The resources that an instruction needs: the table of [`controller`](super::controller), written independently.
pub(super) fn step(i: &Instruction<u64>) -> Step {
    let on_enable = i.enabling != Enabling::Keep.code()
        || i.mask == Mask::Enabled.code()
        || i.flagging == Flagging::EnabledCondition.code();
    let on_tree = i.source == Source::Expression.code() || on_enable;
    let writes = i.mask != Mask::Nobody.code() && i.accumulates + i.stores > 0;
    let looks_at_alu = i.flagging != Flagging::Keep.code() || is_conditional(i.enabling) && !is_by_sign(i);
    let works = writes || looks_at_alu || i.function != Function::Operand.code();
    Step { on_tree, on_memory: works || !on_tree, saves: false, skip: i.skip as u8, length: i.length as u8 }
}

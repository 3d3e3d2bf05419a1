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

/// The part of a pixel's control that has an effect, if any.
pub(super) fn effect(c: &Control<u64>) -> Control<u64> {
    let writes = c.mask != Mask::Nobody.code() && c.accumulates + c.stores > 0;
    let keeps = [Function::Operand, Function::Word, Function::And, Function::Or, Function::ExclusiveOr];
    let carries = !keeps.iter().any(|function| function.code() == c.function);
    let flags = c.flagging != Flagging::Keep.code();
    let (enters, by_sign) = (is_conditional(c.enabling), c.by_sign == 1);
    let looks = flags || enters && !by_sign;
    let if_so = |condition: bool, value: u64| if condition { value } else { 0 };
    let works = writes || carries || looks;
    Control {
        source: if_so(works, c.source),
        constant: if_so(works && c.source == Source::Constant.code(), c.constant),
        function: if_so(works, c.function),
        begin: if_so(works, c.begin),
        mask: if_so(writes, c.mask),
        accumulates: if_so(writes, c.accumulates),
        stores: if_so(writes, c.stores),
        condition: if_so(looks, c.condition),
        enabling: c.enabling,
        by_sign: if_so(enters, c.by_sign),
        flagging: c.flagging,
        read: if_so(works, c.read),
        write: if_so(writes && c.stores == 1, c.write),
    }
}

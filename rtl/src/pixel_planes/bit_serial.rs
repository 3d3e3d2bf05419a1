//! What the trees are made of: sums of streams of bits, least significant bit first, and their delays and shifts (PP5-ARCH).

use crate::delays::{delays, mark_delays};
use crate::prelude::*;

/// Which of the nodes of a level are right children.
#[track_caller]
pub(super) fn is_right(nodes: u32) -> Signal {
    constants(bit().of(row(nodes)), |node| node % 2)
}

/// The beginnings of expressions, at so many places: a clock later at each.
#[track_caller]
pub(super) fn beginnings(m: Module, places: u32, first: Signal) -> Vec<Signal> {
    mark_delays(m, "first", places - 1, first)
}

/// The bit, so many clocks later.
#[track_caller]
pub(super) fn delayed(m: Module, name: &str, clocks: u32, bit: Signal) -> Signal {
    delays(m, name, clocks, bit)[clocks as usize]
}

/// The sums of two numbers that begin with `first`, a clock later; their names, and those of their carries.
#[track_caller]
pub(super) fn sum(m: Module, [name, carry]: [&str; 2], first: Signal, number: Signal, adds: Signal) -> Signal {
    let carried = format!("{carry}_in");
    let carry = m.reg(carry, bit().of(number.shape()));
    let carried = (carry & !first).named(&carried);
    carry.next((number & adds) | (carried & (number | adds)));
    m.pipe(name, number ^ adds ^ carried)
}

/// A number times a power of two, for a sum that begins at the first of two of the beginnings: its first bit comes at the second. Until then
/// there are zeros, as of a shift. What is sent has more bits than there are clocks between the two; the name is that of what tells that it has come.
#[track_caller]
pub(super) fn shifted(m: Module, name: &str, first: &[Signal], [from, to]: [u32; 2], number: Signal) -> Signal {
    if from == to {
        return number;
    }
    let [first, comes] = [from, to].map(|place| first[place as usize]);
    let has_come = m.reg(name, bit()).reset(0);
    has_come.when(first, 0).when(comes, 1);
    number & (comes | (has_come & !first))
}

/// Twice a number that begins with `first`: a clock is a place.
#[track_caller]
pub(super) fn doubled(m: Module, name: &str, first: Signal, number: Signal) -> Signal {
    m.pipe(name, number) & !first
}

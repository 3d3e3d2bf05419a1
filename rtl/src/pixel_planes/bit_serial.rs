//! Building blocks of the trees: sums, delays and shifts of bit streams, least significant bit first (PP5-ARCH).

use crate::delays::{delays, mark_delays};
use crate::prelude::*;

/// Which of the nodes of a level are right children.
#[track_caller]
pub(super) fn is_right(nodes: u32) -> Signal {
    constants(bit().of(row(nodes)), |node| node % 2)
}

/// The `first` signal of an expression at each of `places` places; each place is one clock later.
#[track_caller]
pub(super) fn beginnings(m: Module, places: u32, first: Signal) -> Vec<Signal> {
    mark_delays(m, "first", places - 1, first)
}

/// The bit, delayed by `clocks` clocks.
#[track_caller]
pub(super) fn delayed(m: Module, name: &str, clocks: u32, bit: Signal) -> Signal {
    delays(m, name, clocks, bit)[clocks as usize]
}

/// The sum, one clock later, of two numbers whose first bits come with `first`. The two names are those of the sum and
/// of its carry.
#[track_caller]
pub(super) fn sum(m: Module, [name, carry]: [&str; 2], first: Signal, number: Signal, adds: Signal) -> Signal {
    let carried = format!("{carry}_in");
    let carry = m.reg(carry, bit().of(number.shape()));
    let carried = (carry & !first).named(&carried);
    carry.next((number & adds) | (carried & (number | adds)));
    m.pipe(name, number ^ adds ^ carried)
}

/// A number shifted left, for a sum that starts later. `from` and `to` are places in `first`: the shift is the distance
/// between them. Before the number's first bit the stream is 0. A number must have more bits than the shift. `name`
/// names the register that tells whether the number has started.
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

/// Twice a number that begins with `first`: a delay of one clock doubles it.
#[track_caller]
pub(super) fn doubled(m: Module, name: &str, first: Signal, number: Signal) -> Signal {
    m.pipe(name, number) & !first
}

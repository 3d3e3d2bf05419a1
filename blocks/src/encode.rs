//! One-hot codes and priorities: functions of signals.

use tilewright_hdl::{Integer, Signal, below, concat, lit};

/// The first of the bits that are high, from the least significant on: alone, or nothing if there is none.
///
/// ```
/// # use tilewright_blocks::first;
/// # use tilewright_hdl::*;
/// # bundle! {
/// #     /// In.
/// #     pub struct FirstIn<T> { pub requests: T }
/// #     /// Out.
/// #     pub struct FirstOut<T> { pub grant: T }
/// # }
/// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
/// # struct First;
/// # impl Block for First {
/// #     type In = FirstIn;
/// #     type Out = FirstOut;
/// #     fn inputs(&self) -> FirstIn<Width> { FirstIn { requests: bits(6) } }
/// #     fn build(&self, _: Module, i: FirstIn) -> FirstOut {
/// let grant = first(i.requests); // 000100 of 101100
/// #         FirstOut { grant }
/// #     }
/// # }
/// # let mut sim = tilewright_sim::Simulation::of(&First)?;
/// # sim.set(sim.i.requests, 0b101100);
/// # assert_eq!(sim.get(sim.o.grant), 0b000100);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[track_caller]
pub fn first(requests: Signal) -> Signal {
    requests & (!requests + 1)
}

/// The place of the first of the bits that are high, and 0 if there is none: a priority encoder.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::first_index;
/// # tilewright_sim::example(|m| {
/// m.assert(first_index(lit(6, 0b101100)).eq(2), "3 bits, as 6 places need");
/// m.assert(first_index(lit(6, 0)).eq(0), "so ask `.any_one()` beside it");
/// # });
/// ```
#[track_caller]
pub fn first_index(requests: Signal) -> Signal {
    index_of(first(requests))
}

/// The place of the one bit that is high, and 0 if there is none. If several are high, it is of no use.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::index_of;
/// # tilewright_sim::example(|m| {
/// m.assert(index_of(lit(6, 0b001000)).eq(3), "cheaper than `first_index`, as nothing is looked for");
/// # });
/// ```
#[track_caller]
pub fn index_of(one_hot: Signal) -> Signal {
    let places = 0..one_hot.width();
    let mut digits = Vec::new();
    for digit in (0..below(one_hot.width()).bits()).rev() {
        let high: Vec<Signal> =
            places.clone().filter(|place| place >> digit & 1 == 1).map(|place| one_hot.bit(place)).collect();
        digits.push(if high.is_empty() { lit(1, 0) } else { concat(&high).any_one() });
    }
    concat(&digits)
}

/// So many bits, of which the one at place `index` is high: a decoder. None is if the index is as large as that, or larger.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::{index_of, one_hot};
/// # tilewright_sim::example(|m| {
/// m.assert(one_hot(lit(3, 2), 6).eq(0b000100), "6 bits");
/// m.assert(one_hot(lit(3, 7), 6).eq(0), "there is no place 7");
/// m.assert(index_of(one_hot(lit(3, 5), 6)).eq(5), "there and back");
/// # });
/// ```
#[track_caller]
pub fn one_hot(index: Signal, count: impl Integer) -> Signal {
    let width = index.width();
    let mut places = Vec::new();
    for place in (0..count.integer()).rev() {
        let can_be = width >= 64 || place >> width == 0;
        places.push(if can_be { index.eq(place) } else { lit(1, 0) });
    }
    concat(&places)
}

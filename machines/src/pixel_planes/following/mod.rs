//! The way of a pixel through the machine: each unit of its renderer in each clock, beside plain models that get the hardware's inputs of the unit.

mod commands;
mod followed;
mod observer;
mod picture;
mod units;
mod wires;

pub(super) use followed::Followed;
pub(super) use observer::Observer;
pub(super) use picture::{Pictured, Scene};

/// The simulations: that of the frame buffer, and that of the renderer of a number.
pub(super) const FRAME_BUFFER: &str = "frame buffer";

/// The renderer of that number.
pub(super) fn renderer(number: usize) -> String {
    format!("renderer {number}")
}

/// A bit of a coefficient of 40 bits; its sign repeats.
fn bit_of(number: u64, bit: u64) -> bool {
    let number = (number << 24) as i64 >> 24;
    number >> bit.min(63) & 1 == 1
}

#[cfg(test)]
mod tests;

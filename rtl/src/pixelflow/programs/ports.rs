//! Synchronization with the ports, and copies of words.

use super::super::fields::Field;
use super::super::instruction::{Instruction, LONGEST, Sync};
use super::assembler::{copy, port};

/// Waits until the network has released a bank.
pub fn await_bank(bank: u64) -> Instruction<u64> {
    port(Sync::AwaitBank, bank)
}

/// Gives a bank to the network.
///
/// ```
/// use tilewright_rtl::pixelflow::programs::{await_bank, give_bank};
/// assert_eq!([await_bank(0), give_bank(1)].map(|instruction| (instruction.clocks(), instruction.c)), [(1, 0), (1, 1)]);
/// ```
pub fn give_bank(bank: u64) -> Instruction<u64> {
    port(Sync::GiveBank, bank)
}

/// Starts the texture unit, or the frame buffer at the same port.
pub fn start_texture() -> Instruction<u64> {
    port(Sync::StartTexture, 0)
}

/// Waits until the texture unit has finished.
///
/// ```
/// use tilewright_rtl::pixelflow::instruction::Sync;
/// use tilewright_rtl::pixelflow::programs::{await_texture, start_texture};
/// assert_eq!([start_texture(), await_texture()].map(|it| it.sync), [Sync::StartTexture as u64, Sync::AwaitTexture as u64]);
/// ```
pub fn await_texture() -> Instruction<u64> {
    port(Sync::AwaitTexture, 0)
}

/// Copies `bytes` bytes, in one clock each.
///
/// ```
/// use tilewright_rtl::pixelflow::{programs::move_word, schedule::one_at_a_time};
/// assert_eq!(one_at_a_time(&move_word(256, 160, 21)), 21);
/// ```
pub fn move_word(from: u64, to: u64, bytes: u64) -> Vec<Instruction<u64>> {
    let longest = u64::from(LONGEST);
    let part = |at: u64| {
        let field = Field::new(at, longest.min(bytes - at));
        copy(field.of(from), field.of(to))
    };
    (0..bytes).step_by(LONGEST as usize).map(part).collect()
}

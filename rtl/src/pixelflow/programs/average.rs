//! Samples that come one after another: the sums of eight colours, and the mean.
//!
//! Colours and sums are laid out as in a word: blue, green, red, from the lowest address up. Source: PFL-NT, facts E0
//! (`floor((sum + 4) / 8)`).

use super::super::fields::Field;
use super::super::instruction::Instruction;
use super::super::pixel::{Begin, Function};
use super::assembler::{carried, load, set, with_accumulator};

/// The number of bytes of the sums of a colour: 2 for each channel.
pub const SUM_BYTES: u64 = 6;

/// Half of the divisor of sums. Sums start with it, so that the quotient is rounded to nearest.
const HALF: i64 = 4;

/// The sum of a channel, for sums at this address.
fn channel(sums: u64, number: u64) -> Field {
    Field::new(sums + 2 * number, 2)
}

/// The instructions that start the sums: 6 clocks.
pub fn begin_sums(sums: u64) -> Vec<Instruction<u64>> {
    (0..3).map(|number| set(channel(sums, number), HALF)).collect()
}

/// The instructions that add a colour to the sums: 9 clocks.
pub fn add_sample(colour: u64, sums: u64) -> Vec<Instruction<u64>> {
    (0..3).flat_map(|number| add(Field::new(colour + number, 1), channel(sums, number))).collect()
}

/// Adds a number to a longer one: 2 clocks for each byte of the number, and 1 for each byte more in the sum.
pub(super) fn add(number: Field, sum: Field) -> Vec<Instruction<u64>> {
    let mut program = Vec::new();
    for byte in 0..number.bytes {
        let begin = if byte == 0 { Begin::Zero } else { Begin::Kept };
        program.push(load(number.byte(byte)));
        program.push(with_accumulator(Function::Add, sum.byte(byte)).writes(sum.byte(byte)).begins(begin));
    }
    let rest = Field::new(sum.byte(number.bytes), sum.bytes - number.bytes);
    program.push(carried(Function::Add, 0).from(rest).to(rest));
    program
}

/// The instructions that divide the sums of eight colours to get the mean: 18 clocks.
///
/// ```
/// use tilewright_rtl::pixelflow::emulator::Pixel;
/// use tilewright_rtl::pixelflow::programs::{add_sample, average, begin_sums};
///
/// let (colour, sums) = (256, 40);
/// let mut pixel = Pixel::new();
/// pixel.run(&begin_sums(sums), 0, 0);
/// for red in [10, 10, 10, 11, 10, 10, 10, 253] {
///     pixel.memory[colour as usize..][..3].copy_from_slice(&[0, 1, red]);
///     pixel.run(&add_sample(colour, sums), 0, 0);
/// }
/// pixel.run(&average(sums, colour), 0, 0);
/// assert_eq!(pixel.memory[colour as usize..][..3], [0, 1, 41]);
/// ```
pub fn average(sums: u64, colour: u64) -> Vec<Instruction<u64>> {
    (0..3).flat_map(|number| eighth(channel(sums, number), Field::new(colour + number, 1))).collect()
}

/// Writes the floor of an eighth of a number to a shorter one: 3 clocks per byte. It destroys the number.
pub(super) fn eighth(number: Field, to: Field) -> Vec<Instruction<u64>> {
    let mut program = Vec::new();
    for shift in 0..3 {
        for byte in (0..number.bytes).rev() {
            let begin = if byte + 1 == number.bytes { Begin::Zero } else { Begin::Kept };
            let is_result = shift == 2 && byte < to.bytes;
            let target = if is_result { to.byte(byte) } else { number.byte(byte) };
            program.push(carried(Function::ShiftRight, number.byte(byte)).writes(target).begins(begin));
        }
    }
    program
}

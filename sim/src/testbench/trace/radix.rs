//! The numbers of a text wave.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::Kind;

/// The radix of the numbers of a [`Wave`](super::Wave).
///
/// ```
/// # use tilewright_sim::{Simulation, WaveRadix, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let wave = sim.record([sim.o.count, sim.o.square]).radix("count", WaveRadix::Binary);
/// sim.set(sim.i.enable, 1);
/// sim.run(5);
/// wave.expect(r"
///     clk    |_____/~~\__/~~\__/~~\__/~~\__/
///     count  | 0   | 1   | 10  | 11  | 100 |
///     square | 0   | 1   | 4   | 9   | 10  |");
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WaveRadix {
    /// Hexadecimal.
    Hexadecimal,
    /// Decimal.
    Decimal,
    /// Binary.
    Binary,
}

/// A value as a row shows it: a code by its name, a signed number with its sign. Without a radix, unsigned numbers
/// are hexadecimal and signed ones decimal.
pub(crate) fn text(value: &Bits, kind: Kind, radix: Option<WaveRadix>) -> String {
    match kind {
        Kind::Code(names) => {
            let name = value.to_u64().and_then(|value| names.name(value));
            name.map_or_else(|| number(value, radix), str::to_owned)
        }
        Kind::Signed => match value.to_i128() {
            Some(signed) if radix.is_none_or(|radix| radix == WaveRadix::Decimal) => signed.to_string(),
            Some(signed) if signed < 0 => {
                let size = Bits::from_u128(128, signed.unsigned_abs());
                format!("-{}", number(&size, radix))
            }
            _ => number(value, radix),
        },
        Kind::Number => number(value, radix),
    }
}

/// A value without a sign and without leading zeros. More than 128 bits are never decimal.
fn number(value: &Bits, radix: Option<WaveRadix>) -> String {
    let digits = match (radix, value.to_u128()) {
        (Some(WaveRadix::Binary), _) => format!("{value:b}"),
        (Some(WaveRadix::Decimal), Some(number)) => return number.to_string(),
        _ => format!("{value:x}"),
    };
    let digits = digits.trim_start_matches('0');
    if digits.is_empty() { "0".to_owned() } else { digits.to_owned() }
}

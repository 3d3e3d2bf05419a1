//! Numbers that are shown in the radix in which they are written.

use crate::operand::{Literal, Operand, Value};
pub use tilewright_circuit::Radix;

/// A number and its radix. Made by [`hex`] and [`binary`].
///
/// ```
/// # use tilewright_hdl::*;
/// let mask: Written = hex(0xf0);
/// assert_ne!(mask, binary(0xf0)); // the same number, written in another way
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Written {
    value: u64,
    radix: Radix,
}

/// A number that Verilog shows in hexadecimal: `address.eq(hex(0x3f))` is `address == 8'h3f`. Rust does not tell how
/// a literal was written.
///
/// ```
/// # use tilewright_hdl::*;
/// block! {
///     /// Recognizes a pattern.
///     pub struct Finder;
///     in FinderIn { x: bits(8) }
///     out FinderOut { found: bit(), kept: bits(8) }
/// }
///
/// impl Finder {
///     fn build(&self, m: Module, i: FinderIn) -> FinderOut {
///         def!(kept = m.reg(8).reset(binary(0b101)));
///         kept.when(i.x.gt(100), i.x);
///         FinderOut { found: i.x.eq(hex(0x3f)), kept: *kept }
///     }
/// }
///
/// let text = &tilewright_gen::verilog(&elaborate(&Finder)?)[0].text;
/// for line in ["found = x == 8'h3f", "kept <= 8'b00000101", "x > 8'd100"] {
///     assert!(text.contains(line), "{text}");
/// }
/// # Ok::<(), Problems>(())
/// ```
pub fn hex(value: u64) -> Written {
    Written { value, radix: Radix::Hex }
}

/// A number that Verilog shows in binary. See [`hex`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8) } out { masked: bits(8) }
/// let masked = i.word & binary(0b1010);
/// #     ShownOut { masked }
/// # };
/// assert!(tilewright_gen::verilog(&design)[0].text.contains("8'b00001010"));
/// ```
pub fn binary(value: u64) -> Written {
    Written { value, radix: Radix::Binary }
}

impl Operand for Written {
    fn operand(self) -> Value {
        Value::Literal(Literal::Integer(self.value.into(), self.radix))
    }
}

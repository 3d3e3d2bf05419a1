//! The low bits of a signal, as many as the context needs.

use crate::operand::{Operand, Value};
use crate::signal::Signal;

/// The result of [`Signal::low`].
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let free: Low = lit(5, 0b10110).low();
/// m.assert(lit(3, 0b110).eq(free), "3 bits, as the other operand has");
/// m.assert(lit(4, 0b0110).eq(free), "and 4 here");
/// # });
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Low(Signal);

impl Operand for Low {
    fn operand(self) -> Value {
        Value::Low(self.0)
    }
}

impl Signal {
    /// The low bits, as many as the other operand has, just as a number takes its width from the context:
    /// `words.write(pushes, used.low(), word)`. It may be an operand beside a signal, an arm of a choice, or the
    /// value of a register or wire. It may also be an address or a word of a memory. Where nothing gives a width, as
    /// in a block's outputs, use [`trunc`](Signal::trunc).
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(used = m.reg(up_to(4)).reset(0));
    /// used.when(used.lt(4), used + 1);
    /// def!(words = m.memory(4, 8, ReadUnderWrite::Old).fill(9));
    /// words.write(used.lt(4), used.low(), used.zext(8)); // 2 of the 3 bits of `used`
    /// def!(newest = words.read_async((used - 1).low()));
    /// # });
    /// assert_eq!(example.values("newest"), [9, 0, 1, 2, 3, 3]);
    /// ```
    pub fn low(self) -> Low {
        Low(self)
    }
}

impl Value {
    /// Its value where `width` bits are needed. A narrower signal is not widened, so it does not fit.
    #[track_caller]
    pub(crate) fn cut_to(self, width: u32) -> Value {
        match self {
            Value::Low(signal) if signal.width > width => Value::Signal(signal.trunc(width)),
            Value::Low(signal) => Value::Signal(signal),
            value => value,
        }
    }
}

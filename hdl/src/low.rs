//! The low bits of a signal, as many as are wanted where they go.

use crate::operand::{Operand, Value};
use crate::signal::Signal;

/// What [`Signal::low`] makes.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let free: Low = lit(5, 0b10110).low();
/// m.assert(lit(3, 0b110).eq(free), "3 bits, as what it meets has");
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
    /// The low bits, as many as what they meet has, as a number has its width: `words.write(pushes, used.low(), word)`. Beside a signal,
    /// an operand, an arm of a choice, what a register takes or a wire is driven by, an address or a word of a memory. Where nothing says a width, as in a
    /// block's outputs, it is [`trunc`](Signal::trunc).
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
    /// What it is where `width` bits are wanted. Low bits of fewer stay what they are, which does not fit there.
    #[track_caller]
    pub(crate) fn cut_to(self, width: u32) -> Value {
        match self {
            Value::Low(signal) if signal.width > width => Value::Signal(signal.trunc(width)),
            Value::Low(signal) => Value::Signal(signal),
            value => value,
        }
    }
}

//! The width of a port, as a bundle of widths declares it.

use crate::integers::{Integer, for_integers, not_negative};
use crate::shaping::IntoShape;
use crate::signal::Signal;
use tilewright_circuit::ir::{Kind, Shape};
use tilewright_circuit::width_below;
use tilewright_circuit::{Clock, Loc};

/// The width of an input port, with the place of its declaration and, if it is not the block's own, the clock to
/// which it is synchronous. In a block with several named clocks and none of its own, an input that a register or
/// memory samples must name its clock. With a single named clock, it is on that one.
///
/// ```
/// # use tilewright_hdl::*;
/// // The differences between two ports: bits, lanes, and signedness.
/// let widths = [bit(), bits(24), below(12), bits(8).signed(), bits(8).of(row(4))];
/// assert_eq!(widths.map(Width::bits), [1, 24, 4, 8, 8]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Width {
    pub(crate) bits: u32,
    pub(crate) shape: Shape,
    pub(crate) kind: Kind,
    pub(crate) clock: Option<Clock>,
    pub(crate) loc: Loc,
}

impl Width {
    /// The port's values are synchronous to `clock`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const VIDEO: Clock = Clock::new("video", Period::ns(40));
    ///
    /// block! {
    ///     struct Sampler;
    ///     in SamplerIn { level: bits(8).on(VIDEO) }
    ///     out SamplerOut { sampled: bits(8) }
    /// }
    ///
    /// impl Sampler {
    ///     fn build(&self, m: Module, i: SamplerIn) -> SamplerOut {
    ///         SamplerOut { sampled: m.on(VIDEO).pipe("sampled", i.level) }
    ///     }
    /// }
    ///
    /// let design = elaborate(&Sampler)?;
    /// assert_eq!(design.top().clocks[0].name, Some("video"));
    /// # Ok::<(), Problems>(())
    /// ```
    pub fn on(self, clock: Clock) -> Width {
        Width { clock: Some(clock), ..self }
    }

    /// The same width in each lane: `bits(8).of(row(4))`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(bits(8).of(4).shape(), row(4));
    /// assert_eq!(bits(8).of(grid(2, 3)).bits(), 8);
    /// ```
    #[track_caller]
    pub fn of(self, shape: impl IntoShape) -> Width {
        Width { shape: shape.into_shape(), ..self }
    }

    /// The width of a signal.
    #[track_caller]
    pub(crate) fn like(signal: Signal) -> Width {
        Width { shape: signal.shape, kind: signal.kind, ..bits(signal.width) }
    }

    /// The width in bits, of each lane.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(bits(8).of(row(4)).bits(), 8);
    /// ```
    pub fn bits(self) -> u32 {
        self.bits
    }

    /// The number and layout of its lanes.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(bits(8).shape(), Shape::Plain);
    /// assert_eq!(bits(8).of(grid(2, 3)).shape().lanes(), 6);
    /// ```
    pub fn shape(self) -> Shape {
        self.shape
    }
}

/// A port of `width` bits. An invalid width is reported by the object declared with it.
///
/// ```
/// # use tilewright_hdl::*;
/// assert_eq!(bits(24).shape(), Shape::Plain);
/// assert_eq!(bits(24).of(row(4)).shape(), row(4));
/// ```
#[track_caller]
pub fn bits(width: impl Integer) -> Width {
    let width = width.integer();
    Width {
        bits: u32::try_from(width).unwrap_or(if width < 1 { 0 } else { u32::MAX }),
        shape: Shape::Plain,
        kind: Kind::Number,
        clock: None,
        loc: Loc::caller(),
    }
}

/// A port of one bit.
///
/// ```
/// # use tilewright_hdl::*;
/// assert_eq!(bit().bits(), 1);
/// ```
#[track_caller]
pub fn bit() -> Width {
    bits(1)
}

/// The width of an index into `count` things: wide enough for every number below `count`. At least 1 bit.
///
/// ```
/// # use tilewright_hdl::*;
/// assert_eq!(below(12).bits(), 4);
/// assert_eq!((below(16).bits(), below(17).bits()), (4, 5));
/// ```
///
/// # Panics
///
/// The number is negative. While a block is built, this is a problem of its description instead.
#[track_caller]
pub fn below(count: impl Integer) -> Width {
    bits(width_below(not_negative(count)))
}

/// Wide enough for every number from 0 to `most` inclusive: `up_to(4)` has 3 bits, `below(4)` has 2.
///
/// ```
/// # use tilewright_hdl::*;
/// // A count of taken places, 0 to 16, has 17 values.
/// assert_eq!((up_to(16).bits(), up_to(15).bits()), (5, 4));
/// ```
///
/// # Panics
///
/// The number is negative. While a block is built, this is a problem of its description instead.
#[track_caller]
pub fn up_to(most: impl Integer) -> Width {
    bits(width_below(not_negative(most) + 1))
}

/// A width: a number of bits, or the result of [`bits`], [`below`] or [`up_to`].
///
/// ```
/// # use tilewright_hdl::*;
/// fn ones(width: impl IntoWidth) -> Signal {
///     !lit(width, 0)
/// }
/// # tilewright_sim::example(|m| {
/// m.assert(ones(4).eq(15) & ones(below(12)).eq(15), "12 pages are numbered by 4 bits");
/// # });
/// ```
#[diagnostic::on_unimplemented(
    message = "a `{Self}` is not a width",
    note = "a width is a number of bits, or `bit()`, `below(n)` or `up_to(n)`; a record of a `bundle!` has one in \
            each field"
)]
pub trait IntoWidth {
    #[doc(hidden)]
    fn into_width(self) -> Width;
}

impl IntoWidth for Width {
    fn into_width(self) -> Width {
        self
    }
}

macro_rules! widths {
    ($($ty:ty)*) => {$(
        /// A number of bits. An invalid width is reported by the object declared with it.
        impl IntoWidth for $ty {
            #[track_caller]
            fn into_width(self) -> Width {
                bits(self)
            }
        }
    )*};
}
for_integers!(widths);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_width_holds_the_numbers_that_it_is_named_after() {
        let widths = [(1, 1), (2, 1), (3, 2), (4, 2), (5, 3), (256, 8), (257, 9)];
        for (count, width) in widths {
            assert_eq!(below(count).bits(), width, "below {count}");
            assert_eq!(up_to(count - 1).bits(), width, "up to {}", count - 1);
        }
        assert_eq!((below(0).bits(), up_to(u64::MAX).bits(), up_to(255u8).bits()), (1, 64, 8));
        assert_eq!(below(1i128 << 100).bits(), 100);
    }
}

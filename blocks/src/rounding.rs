//! Fewer bits for a number: rounded below, saturated above.

use tilewright_hdl::{Integer, IntoSignal, IntoWidth, Module, Signal, bit, bits, block, cat, def, mux};

/// Where [`round`] takes a number that is halfway between two others.
///
/// ```
/// use tilewright_blocks::Ties;
///
/// // The mean of halfway numbers stays what it was only with `Even`.
/// assert_ne!(Ties::Up, Ties::Even);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Ties {
    /// To the greater of the two: 2.5 to 3, -2.5 to -2. It costs one adder.
    Up,
    /// To the even one: 2.5 to 2, 3.5 to 4. Sums of many rounded numbers do not drift.
    Even,
}

/// The number without its lowest `places` bits, rounded to the nearest. It is one bit wider than what is left, so it
/// cannot overflow; [`saturate`] takes that bit away. Signed if the number is.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::{Ties, round, saturate};
/// # tilewright_sim::example(|m| {
/// let number = lit(8, 0b0101_1000); // 5.5, with 4 bits below the point
/// m.assert(round(number, 4, Ties::Up).eq(6), "5 bits");
/// m.assert(round(number - 0x10, 4, Ties::Even).eq(4), "4.5 is as far from 4 as from 5");
/// m.assert(round(number.signed() - 0x68, 4, Ties::Up).eq(-1), "-1.0");
/// m.assert(saturate(round(lit(8, 0xff), 4, Ties::Up), 4).eq(15), "15.9 would be 16");
/// # });
/// ```
#[track_caller]
pub fn round(number: impl IntoSignal, places: impl Integer, ties: Ties) -> Signal {
    let (number, places): (Signal, _) = (number.into(), places.integer());
    let kept = number.bits().slice(places..i128::from(number.width()));
    let wider = kept.width() + 1;
    if places == 0 {
        return if number.is_signed() { number.sext(wider) } else { number.zext(wider) };
    }
    let half = number.bit(places - 1);
    let goes_up = match ties {
        Ties::Even if places > 1 => half & (kept.bit(0) | number.bits().slice(0..places - 1).any_one()),
        Ties::Even => half & kept.bit(0),
        Ties::Up => half,
    };
    if number.is_signed() {
        (kept.sext(wider) + goes_up.zext(wider)).signed()
    } else {
        kept.zext(wider) + goes_up.zext(wider)
    }
}

/// The number in `width` bits. One that is too great or too small becomes the greatest or the least number of that
/// width. Signed if the number is; a wider `width` extends it.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::saturate;
/// # tilewright_sim::example(|m| {
/// m.assert(saturate(lit(8, 200), 6).eq(63), "the greatest");
/// m.assert(saturate(lit(8, 50), 6).eq(50), "it fits");
/// m.assert(saturate(-lit(8, 100).signed(), 6).eq(-32), "the least");
/// # });
/// ```
#[track_caller]
pub fn saturate(number: impl IntoSignal, width: impl IntoWidth) -> Signal {
    let (number, width): (Signal, u32) = (number.into(), width.into_width().bits());
    match (width < number.width(), number.is_signed()) {
        (false, true) => number.sext(width),
        (false, false) => number.zext(width),
        (true, true) => {
            // It fits if all bits that go are like the sign that stays.
            let signs = number.bits().slice(width - 1..number.width());
            let sign = number.is_negative();
            let limit = if width == 1 { sign } else { cat![sign, (!sign).repeat(width - 1)] };
            mux(signs.all_ones() | !signs.any_one(), number.trunc(width), limit.signed())
        }
        (true, false) => number.trunc(width) | number.slice(width..number.width()).any_one().repeat(width),
    }
}

block! {
    /// Rounds and saturates a signed number, as behind a filter: a product has more bits than what is sent on.
    ///
    /// ```text
    ///            .-------.       .----------.
    /// number ===>| round |==+1==>| saturate |==[ ]==> rounded
    ///            '-------'       '----------'
    /// ```
    ///
    /// Latency 1 clock with `enable`. As functions these are [`round`] and [`saturate`].
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&Quantizer { width: 8, places: 2, kept: 5, ties: Ties::Even })?;
    /// let rounded = [10, 14, 100].map(|number| {
    ///     sim.drive(QuantizerIn { enable: 1, number });
    ///     sim.step();
    ///     sim.read_u64().rounded
    /// });
    /// assert_eq!(rounded, [2, 4, 15]); // 2.5, 3.5, and 25, which is above all numbers of 5 bits
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct Quantizer {
        /// The bits of a number that comes in.
        pub width: u32,
        /// How many of them are below the unit, and go.
        pub places: u32,
        /// The bits of a number that comes out.
        pub kept: u32,
        /// Where a number that is halfway between two others goes.
        pub ties: Ties,
    }
    ranges(self) {
        width: 2..,
        /// A number keeps a bit at least.
        places: 1..self.width,
        /// There are no more after rounding.
        kept: 1..=(self.width + 1).saturating_sub(self.places),
    }
    in(self) QuantizerIn {
        /// Loads `rounded` with what `number` is rounded to.
        enable: bit(),
        /// A number, signed.
        number: bits(self.width).signed(),
    }
    out(self) QuantizerOut {
        /// The nearest number of its width, signed.
        rounded: bits(self.kept).signed(),
    }
}

impl Quantizer {
    fn build(&self, m: Module, i: QuantizerIn) -> QuantizerOut {
        let nearest = round(i.number, self.places, self.ties);
        def!(rounded = m.pipe_when(i.enable, saturate(nearest, self.kept)));
        QuantizerOut { rounded }
    }
}

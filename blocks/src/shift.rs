//! A shift register.

use tilewright_hdl::ir::About;
use tilewright_hdl::{Block, Module, Width, bit, bits, bundle, cat};

bundle! {
    /// The inputs of a [`ShiftRegister`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{ShiftRegister, ShiftRegisterIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// let count = m.reg("count", 4).reset(0);
    /// count.next(count + 1);
    /// let shifter = m.instance("u_shifter", &ShiftRegister::new(4), ShiftRegisterIn {
    ///     load: count.eq(0),
    ///     word: lit(4, 0b1011),
    ///     shift: lit(1, 1),
    ///     bit_in: lit(1, 0),
    /// });
    /// net!(held = shifter.held);
    /// # });
    /// assert_eq!(example.values("held"), [0, 0b1011, 0b0110, 0b1100, 0b1000]);
    /// ```
    pub struct ShiftRegisterIn<T> {
        /// It takes `word`; wins over `shift`.
        pub load: T,
        /// What it takes.
        pub word: T,
        /// It shifts by a place.
        pub shift: T,
        /// What comes in at the bottom.
        pub bit_in: T,
    }

    /// The outputs of a [`ShiftRegister`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{ShiftRegister, ShiftRegisterIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// let count = m.reg("count", 4).reset(0);
    /// count.next(count + 1);
    /// let shifter = m.instance("u_shifter", &ShiftRegister::new(4), ShiftRegisterIn {
    ///     load: count.eq(0),
    ///     word: lit(4, 0b1011),
    ///     shift: lit(1, 1),
    ///     bit_in: lit(1, 0),
    /// });
    /// net!(line = shifter.bit_out);
    /// # });
    /// assert_eq!(example.values("line"), [0, 1, 0, 1, 1]); // the most significant bit first
    /// ```
    pub struct ShiftRegisterOut<T> {
        /// All of it.
        pub held: T,
        /// What leaves next: the most significant bit.
        pub bit_out: T,
    }
}

/// Shifts towards the most significant bit: from a word to bits, or from bits to a word.
///
/// ```text
/// word ==load==>.-----------.===> held
///   bit_in ---->|   <<  1   |
///    shift ---->'-----------'---> bit_out
/// ```
///
/// Latency 1 clock.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::{ShiftRegister, ShiftRegisterIn};
/// # let example = tilewright_sim::traced(|m| {
/// // Bits that come in, from the first on: a word after four clocks.
/// let bit_in = m.reg("bit_in", 1).reset(1);
/// bit_in.next(!*bit_in);
/// let ports = ShiftRegisterIn { load: lit(1, 0), word: lit(4, 0), shift: lit(1, 1), bit_in: *bit_in };
/// net!(held = m.instance("u_shifter", &ShiftRegister::new(4), ports).held);
/// # });
/// assert_eq!(example.values("held"), [0b0000, 0b0001, 0b0010, 0b0101, 0b1010]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct ShiftRegister {
    width: u32,
}

impl ShiftRegister {
    /// A shift register of so many bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::ShiftRegister;
    ///
    /// assert_eq!(ShiftRegister::new(8).name(), "shift_register_width8");
    /// ```
    ///
    /// # Panics
    ///
    /// It has less than two, and nothing to shift.
    #[track_caller]
    pub fn new(width: u32) -> ShiftRegister {
        assert!(width > 1, "a shift register of {width} bits has nothing to shift: it has 2 or more");
        ShiftRegister { width }
    }
}

impl Block for ShiftRegister {
    type In = ShiftRegisterIn;
    type Out = ShiftRegisterOut;

    fn inputs(&self) -> ShiftRegisterIn<Width> {
        ShiftRegisterIn { load: bit(), word: bits(self.width), shift: bit(), bit_in: bit() }
    }

    fn build(&self, m: Module, i: ShiftRegisterIn) -> ShiftRegisterOut {
        let held = m.reg("held", self.width).reset(0);
        held.when(i.load, i.word).when(i.shift, cat![held.trunc(self.width - 1), i.bit_in]);
        ShiftRegisterOut { held: held.value(), bit_out: held.msb() }
    }

    fn about(&self) -> About {
        About {
            summary: "Shifts a word out, most significant bit first, or a word in.".into(),
            latency: "1 clock".into(),
            ..About::default()
        }
    }
}

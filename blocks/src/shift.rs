//! A shift register.

use tilewright_hdl::{Module, bit, bits, block, cat, def};

block! {
    /// Shifts a word out, most significant bit first, or a word in.
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
    /// use tilewright_blocks::ShiftRegister;
    /// let design = tilewright_hdl::elaborate(&ShiftRegister::new(4))?;
    /// assert_eq!(design.top().name, "shift_register_width4");
    /// # Ok::<(), tilewright_hdl::Problems>(())
    /// ```
    pub struct ShiftRegister {
        width: u32,
    }
    latency = "1 clock";
    in(self) ShiftRegisterIn {
        /// Loads `word`, with priority over `shift`.
        load: bit(),
        /// The word to load.
        word: bits(self.width),
        /// Shifts the register by one place.
        shift: bit(),
        /// The bit that is shifted in at the bottom.
        bit_in: bit(),
    }
    out(self) ShiftRegisterOut {
        /// All bits of the register.
        held: bits(self.width),
        /// The bit that is shifted out next: the most significant one.
        bit_out: bit(),
    }
}

impl ShiftRegister {
    /// A shift register of `width` bits.
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
    /// `width` is below 2, so there is nothing to shift.
    #[track_caller]
    pub fn new(width: u32) -> ShiftRegister {
        assert!(width > 1, "a shift register of {width} bits has nothing to shift: it has 2 or more");
        ShiftRegister { width }
    }

    fn build(&self, m: Module, i: ShiftRegisterIn) -> ShiftRegisterOut {
        def!(held = m.reg(self.width).reset(0));
        held.when(i.load, i.word).when(i.shift, cat![held.trunc(self.width - 1), i.bit_in]);
        ShiftRegisterOut { held: *held, bit_out: held.msb() }
    }
}

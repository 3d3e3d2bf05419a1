//! The position of a knob or a motor.

use tilewright_hdl::{Module, bit, bits, block, case, cat, choose, codes, def, mux, one_of};

codes! {
    /// A step that a [`Quadrature`] decoder sees.
    ///
    /// ```
    /// use tilewright_blocks::Turn;
    /// use tilewright_hdl::Codes;
    ///
    /// assert_eq!(Turn::Up.name(), "Up");
    /// ```
    pub enum Turn {
        /// No step.
        Still,
        /// A step up: `a` leads.
        Up,
        /// A step down: `b` leads.
        Down,
    }
}

block! {
    /// Counts the steps of an encoder with two lines, one of which leads the other by a quarter of a step.
    ///
    /// ```text
    ///      __    __                    __    __
    /// a __/  \__/  \__   up       a  _/  \__/  \_   down
    ///       __    __                __    __
    /// b ___/  \__/  \_            b /  \__/  \__
    /// ```
    ///
    /// Latency 1 clock to `turn`, 2 clocks to `position`. Each change of one line is a step; if both change at once,
    /// none is counted. The reference is the state of the lines in the first clock after a reset. Lines from outside
    /// the design need synchronizers.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Quadrature, QuadratureIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(code = m.reg(2).reset(0));
    /// code.next(cat![code.bit(0), !code.bit(1)]); // 00, 01, 11, 10: `b` leads
    /// let lines = QuadratureIn { a: code.bit(1), b: code.bit(0) };
    /// def!(position = m.instance("u_knob", &Quadrature::new(8), lines).position);
    /// # });
    /// assert_eq!(example.values("position"), [0, 0, 0, 0xff, 0xfe, 0xfd]); // 0, -1, -2 ..
    /// ```
    pub struct Quadrature {
        width: u32,
    }
    latency = "2 clocks";
    in QuadratureIn {
        /// The first line of the knob.
        a: bit(),
        /// The second line of the knob.
        b: bit(),
    }
    out(self) QuadratureOut {
        /// The position of the knob, signed; it starts at 0.
        position: bits(self.width).signed(),
        /// The step that the knob made.
        turn: one_of::<Turn>(),
    }
}

impl Quadrature {
    /// A position of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Quadrature;
    ///
    /// assert_eq!(Quadrature::new(16).name(), "quadrature_width16");
    /// ```
    ///
    /// # Panics
    ///
    /// `width` is below 2, so there are no bits beside the sign.
    #[track_caller]
    pub fn new(width: u32) -> Quadrature {
        assert!(width > 1, "a position of {width} bits: it has 2 or more");
        Quadrature { width }
    }

    fn build(&self, m: Module, i: QuadratureIn) -> QuadratureOut {
        let now = cat![i.a, i.b];
        def!(last = m.reg(2).reset(0));
        last.next(now);
        def!(known = m.reg(bit()).reset(0)); // `last` is a state of the lines
        known.next(1);
        let up = [0b00_10, 0b10_11, 0b11_01, 0b01_00].map(|change| (change, Turn::Up));
        let down = [0b00_01, 0b01_11, 0b11_10, 0b10_00].map(|change| (change, Turn::Down));
        def!(turn = m.reg(one_of::<Turn>()).reset(Turn::Still));
        turn.next(mux(known, case(cat![last, now], up.into_iter().chain(down), Turn::Still), Turn::Still));
        def!(position = m.reg(bits(self.width).signed()).reset(0));
        position.next(choose!(turn, Turn {
            Still => position,
            Up => position + 1,
            Down => position - 1,
        }));
        QuadratureOut { position: *position, turn: *turn }
    }
}

//! Decimal digits: displayed, and converted to a number.

use tilewright_hdl::{Module, Signal, below, bit, bits, block, def, hex, row};

/// The segments of each digit; the lowest bit is the uppermost segment.
const PATTERNS: [u64; 16] =
    [0x3f, 0x06, 0x5b, 0x4f, 0x66, 0x6d, 0x7d, 0x07, 0x7f, 0x6f, 0x77, 0x7c, 0x39, 0x5e, 0x79, 0x71];

block! {
    /// Shows a hexadecimal digit in seven segments.
    ///
    /// ```text
    ///            .----------.                0
    /// digit ====>| patterns |==> segments   5 1
    ///            '----------'                6
    ///                                       4 2
    ///                                        3
    /// ```
    ///
    /// Latency 1 clock.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{SevenSegment, SevenSegmentIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(digit = m.reg(4).reset(6));
    /// digit.next(digit + 1);
    /// def!(segments = m.instance("u_display", &SevenSegment, SevenSegmentIn { digit: *digit }).segments);
    /// # });
    /// assert_eq!(example.values("segments"), [0, 0b111_1101, 0b000_0111, 0b111_1111]); // 6, 7 and 8
    /// ```
    pub struct SevenSegment;
    in SevenSegmentIn {
        /// A digit from 0 to f.
        digit: bits(4),
    }
    out SevenSegmentOut {
        /// The segments that are lit, from the lowest bit: the uppermost one, then clockwise, and the middle one last.
        segments: bits(7),
    }
}

impl SevenSegment {
    fn build(&self, m: Module, i: SevenSegmentIn) -> SevenSegmentOut {
        def!(patterns = m.rom(7, PATTERNS.map(hex)));
        SevenSegmentOut { segments: patterns.read(i.digit) }
    }
}

block! {
    /// Converts decimal digits to a number.
    ///
    /// ```text
    ///              .------.      .------.
    /// digits[2] ==>| x 10 |==|+|>| x 10 |==|+|==[ ]==> number
    /// digits[1] =============='  '------'   |
    /// digits[0] ============================'
    /// ```
    ///
    /// Latency 1 clock with `enable`. For a digit above 9 the result has no meaning.
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&FromDecimal::new(3))?;
    /// sim.drive(FromDecimalIn { enable: 1, digits: 0x789 });
    /// sim.step();
    /// assert_eq!(sim.read_u64(), FromDecimalOut { number: 789 });
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct FromDecimal {
        digits: u32,
    }
    in(self) FromDecimalIn {
        /// Loads `number` with the value of `digits`.
        enable: bit(),
        /// The decimal digits, the ones in lane 0.
        digits: bits(4).of(row(self.digits)),
    }
    out(self) FromDecimalOut {
        /// The number that the digits stand for.
        number: below(10u64.pow(self.digits)),
    }
}

impl FromDecimal {
    /// A converter for `digits` digits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::FromDecimal;
    ///
    /// let design = elaborate(&FromDecimal::new(4))?;
    /// assert_eq!(design.top().node(design.top().outputs[0].node).width, 14); // up to 9999
    /// # Ok::<(), Problems>(())
    /// ```
    ///
    /// # Panics
    ///
    /// `digits` is 0 or above 16.
    #[track_caller]
    pub fn new(digits: u32) -> FromDecimal {
        assert!((1..=16).contains(&digits), "a number of {digits} digits: it has from 1 to 16");
        FromDecimal { digits }
    }

    fn build(&self, m: Module, i: FromDecimalIn) -> FromDecimalOut {
        let width = below(10u64.pow(self.digits)).bits();
        let mut digits = i.digits.to_vec().into_iter().rev();
        let first = digits.next().expect("there is a digit").zext(width);
        // Two shifts and a sum: a multiplier of an FPGA takes longer.
        let tenfold = |number: Signal| (number << 3) + (number << 1);
        let number = digits.fold(first, |number: Signal, digit| tenfold(number) + digit.zext(width));
        FromDecimalOut { number: m.pipe_when(i.enable, "number", number) }
    }
}

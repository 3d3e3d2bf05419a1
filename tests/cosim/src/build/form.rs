//! Signals as numbers, signed numbers and codes of an enum.

use crate::features::Feature;
use crate::spec::{Form, Meaning, Pattern};
use tilewright_hdl::*;

codes! {
    /// Fewer codes than three bits have, with gaps between them.
    pub enum Colour { Red = 0, Green = 2, Blue = 3, White = 5, Black = 6 }
}

impl Colour {
    /// The code that a number stands for.
    pub fn of(number: u64) -> Colour {
        Colour::ALL[(number % Colour::ALL.len() as u64) as usize]
    }
}

impl Meaning {
    /// How many bits it has where so many are wanted.
    pub fn width(self, wanted: u32) -> u32 {
        if self == Meaning::Code { Colour::NAMES.width() } else { wanted }
    }

    /// What holds it is declared by this.
    pub fn layout(self, wanted: u32) -> Width {
        match self {
            Meaning::Number => bits(wanted),
            Meaning::Signed => bits(wanted).signed(),
            Meaning::Code => one_of::<Colour>(),
        }
    }

    /// Bits, as wide as [`Meaning::width`] says, read as it; they may be no code.
    pub fn read(self, signal: Signal) -> Signal {
        match self {
            Meaning::Number => signal.bits(),
            Meaning::Signed => signal.signed(),
            Meaning::Code => signal.bits().code::<Colour>(),
        }
    }

    /// As [`Meaning::read`], with a code in place of what is none: the language asserts of some registers that they hold one.
    pub fn made_of(self, signal: Signal) -> Signal {
        let read = self.read(signal);
        if self == Meaning::Code { mux(read.is_code(), read, Colour::White) } else { read }
    }

    /// A constant, as a description writes it.
    pub fn constant(self, pattern: Pattern, wanted: u32) -> Value {
        let bits = self.constant_bits(pattern, wanted);
        match (self, pattern, bits.to_u64()) {
            (Meaning::Code, ..) => Colour::of(bits.limbs()[0]).operand(),
            (Meaning::Signed, ..) => {
                Feature::SignedNumber.used();
                bits.to_i128().map_or_else(|| bits.operand(), Operand::operand)
            }
            (Meaning::Number, Pattern::Number(_), Some(number)) => {
                Feature::Hex.used();
                hex(number).operand()
            }
            (Meaning::Number, Pattern::Alternating, Some(number)) => {
                Feature::Binary.used();
                binary(number).operand()
            }
            (Meaning::Number, _, Some(number)) => number.operand(),
            (Meaning::Number, ..) => bits.operand(),
        }
    }

    /// The bits of that constant.
    pub fn constant_bits(self, pattern: Pattern, wanted: u32) -> Bits {
        let width = self.width(wanted);
        let bits = pattern.bits(width);
        if self == Meaning::Code { Bits::new(width, Colour::of(bits.limbs()[0]).code()) } else { bits }
    }

    /// A value of it that is another one, most often.
    pub fn changed(self, signal: Signal) -> Signal {
        match self {
            Meaning::Code => mux(signal.is(Colour::Green), Colour::Blue, signal),
            Meaning::Number => signal + 1,
            Meaning::Signed => signal + -1,
        }
    }

    /// Notes one of these features, or none for a plain number.
    pub fn used(self, signed: Feature, code: Feature) {
        match self {
            Meaning::Number => {}
            Meaning::Signed => signed.used(),
            Meaning::Code => code.used(),
        }
    }
}

/// Records have one in each field.
impl Leaf for Form {}

impl Form {
    /// Its bits.
    pub fn width(self) -> u32 {
        self.meaning.width(self.width)
    }

    /// As [`Meaning::layout`].
    pub fn layout(self) -> Width {
        self.meaning.layout(self.width)
    }
}

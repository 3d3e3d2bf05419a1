//! How a value is brought to the width that it meets, and constants of a width.

use crate::features::Feature;
use crate::spec::{Pattern, Pick, WIDEST};
use tilewright_hdl::{Bits, Signal, limbs_for};

/// The value cut or widened to a width; where it is cut and how it is widened follows from the pick.
pub fn fit(signal: Signal, width: u32, pick: Pick) -> Signal {
    let (signal, how) = (signal.bits(), u32::from(pick.0 / 5));
    if signal.width() > width {
        let low = how % (signal.width() - width + 1);
        if pick.0.is_multiple_of(2) {
            Feature::Part.used();
            return signal.part(low, width);
        }
        return signal.slice(low..low + width);
    }
    if how % 2 == 1 { signal.sext(width) } else { signal.zext(width) }
}

/// Not wider than the widest value.
pub fn narrow(signal: Signal) -> Signal {
    signal.trunc(signal.width().min(WIDEST))
}

impl Pattern {
    /// The constant in `width` bits.
    pub fn bits(self, width: u32) -> Bits {
        let every = |number: u64| Bits::from_limbs(width, &vec![number; limbs_for(width)]);
        match self {
            Pattern::Zero => Bits::zero(width),
            Pattern::Ones => Bits::ones(width),
            Pattern::One => Bits::new(width, 1),
            Pattern::Sign if width == 1 => Bits::new(1, 1),
            Pattern::Sign => Bits::new(1, 1).concat(&Bits::zero(width - 1)),
            Pattern::Alternating => every(0x5555_5555_5555_5555),
            Pattern::Number(number) => every(number),
        }
    }
}

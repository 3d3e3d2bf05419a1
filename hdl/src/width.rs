//! The width of a port, as a bundle of widths declares it.

use crate::bundle::Fields;
use crate::clock::Clock;
use crate::loc::Loc;

/// The width of an input port, where it was written down, and the clock it is synchronous to if that is not the
/// block's own. In a block with several named clocks and none of its own, an input that a register or memory samples must
/// name its clock; with a single named clock, it is on that one.
#[derive(Debug, Clone, Copy)]
pub struct Width {
    pub(crate) bits: u32,
    pub(crate) clock: Option<Clock>,
    pub(crate) loc: Loc,
}

impl Width {
    /// The port's values are synchronous to `clock`.
    pub fn on(self, clock: Clock) -> Width {
        Width { clock: Some(clock), ..self }
    }

    /// The width in bits.
    pub fn bits(self) -> u32 {
        self.bits
    }
}

/// A port of `width` bits.
#[track_caller]
pub fn bits(width: u32) -> Width {
    Width { bits: width, clock: None, loc: Loc::caller() }
}

/// A port of one bit.
#[track_caller]
pub fn bit() -> Width {
    bits(1)
}

/// Ports of which all are synchronous to `clock`: [`Width::on`] for a whole bundle.
pub fn on<B: Fields<Width>>(clock: Clock, widths: B) -> B::With<Width> {
    widths.map(|width| width.on(clock))
}

/// The number of bits that hold every number below `count`: the width of an index into `count` things, at least 1.
pub const fn index_width(count: u64) -> u32 {
    match count {
        0..=2 => 1,
        _ => 64 - (count - 1).leading_zeros(),
    }
}

//! Helpers shared by several entries.

use tilewright_hdl::{Bits, Block, Bundle, Codes, Period, Width};

use super::{Parameter, Values};
use crate::gfb::{Display, Multipass, Passes};

/// The word of an empty pixel, which every other word replaces.
pub(super) const EMPTY: u64 = (1 << 48) - 1;

pub(super) const WIDTH: Parameter =
    Parameter { name: "width", default: 16, min: 2, max: 2048, meaning: "pixels in a scan line of the screen" };
pub(super) const HEIGHT: Parameter =
    Parameter { name: "height", default: 8, min: 2, max: 2048, meaning: "scan lines of the screen" };
pub(super) const PATCH: Parameter =
    Parameter { name: "patch", default: 4, min: 4, max: 16, meaning: "edge of a patch in pixels: 4, 8 or 16" };
pub(super) const PAGES: Parameter =
    Parameter { name: "pages", default: 4, min: 2, max: 1 << 18, meaning: "pages of image memory in a buffer" };
pub(super) const PIXEL_CLOCK: Parameter = Parameter {
    name: "pixel-clock",
    default: 7934,
    min: 5002,
    max: 1_000_000,
    meaning: "period of the display's pixel clock in picoseconds; VGA's is 39682",
};
pub(super) const PROCESSORS: Parameter =
    Parameter { name: "processors", default: 2, min: 1, max: 256, meaning: "processing elements" };
pub(super) const RECEIVE_QUEUE: Parameter =
    Parameter { name: "queue", default: 4, min: 2, max: 4096, meaning: "words that each receive queue holds" };
pub(super) const WORD_CLOCKS: Parameter =
    Parameter { name: "clocks", default: 6, min: 1, max: 255, meaning: "clocks for which a word occupies the bus" };
pub(super) const ACCUMULATION_BUFFER: Parameter =
    Parameter { name: "accumulation", default: 0, min: 0, max: 1, meaning: "1 with an accumulation buffer, 0 without" };
pub(super) const UNITS: Parameter =
    Parameter { name: "units", default: 4, min: 1, max: 256, meaning: "merging units in the chain" };

/// A display with that pixel clock.
pub(super) fn display(values: &Values) -> Display {
    Display { period: Period::ps(values.get("pixel-clock")), ..Display::VGA }
}

/// The host's settings for pictures of two passes, where there is an accumulation buffer.
pub(super) fn two_passes(accumulation: bool) -> Vec<Multipass<u64>> {
    vec![Multipass { accumulates: 1, passes: Passes::Two.code() }; accumulation.into()]
}

/// The inputs of a block, all 0.
pub(super) fn idle<B: Block>(block: &B) -> <B::In as Bundle>::Of<Bits> {
    B::In::convert_leaves(&block.inputs(), &mut |width: &Width| Bits::zero(width.bits() * width.shape().lanes()))
}

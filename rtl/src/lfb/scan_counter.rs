//! The scan counter: which pixel a local frame buffer sends next to the image merger (VC1-SCAN).
//!
//! ```text
//!                .---.          .---.
//! enable --+---->| x |--- end ->| y |--- end of the frame ---> armed
//!          |     '---'          '---'
//! restart -+-- preset.x ---- preset.y
//! ```
//!
//! Latency 1 clock; a pixel for every clock with `enable`.
//!
//! The counter runs freely in raster order, from the upper left to the lower right, and then at once from the start. In
//! the chain each runs 4 pixels ahead of the succeeding one, the latency of a merging unit, so that all samples
//! of a pixel meet. A restart therefore finds the counters behind the first at the end of a frame that nobody asked for:
//! `armed` tells the pixels of the first whole frame, and of those after it, from these.

use tilewright_hdl::ir::About;
use tilewright_hdl::{Block, Module, Width, bit, bits, bundle, index_width, mux, net};

use crate::parameter::Screen;
use crate::scan::{Position, ScanControl};

/// How far a scan counter runs ahead of the succeeding one, in pixels.
pub const LEAD: u32 = 4;

bundle! {
    /// The inputs of [`ScanCounter`].
    pub struct ScanCounterIn<T> {
        /// From the global frame buffer.
        pub scan: ScanControl<T>,
        /// Where a restart puts the counter; a constant.
        pub preset: Position<T>,
    }

    /// The outputs of [`ScanCounter`].
    pub struct ScanCounterOut<T> {
        /// The pixel to send.
        pub pixel: Position<T>,
        /// The pixel belongs to a whole frame after the restart.
        pub armed: T,
    }
}

/// Counts the pixels of a screen in raster order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ScanCounter {
    /// The screen.
    pub screen: Screen,
}

impl ScanCounter {
    /// The preset of the counter at a position of the chain; 0 is the first, fed by the global frame buffer.
    pub fn preset(screen: Screen, position: u32) -> Position<u64> {
        let frame = u64::from(screen.pixels());
        let behind = u64::from(LEAD) * u64::from(position) % frame;
        let pixel = (frame - behind) % frame;
        Position { x: pixel % u64::from(screen.width), y: pixel / u64::from(screen.width) }
    }

    /// The widths of a position on the screen.
    pub fn position(screen: Screen) -> Position<Width> {
        Position { x: bits(index_width(screen.width.into())), y: bits(index_width(screen.height.into())) }
    }
}

impl Block for ScanCounter {
    type In = ScanCounterIn;
    type Out = ScanCounterOut;

    fn inputs(&self) -> ScanCounterIn<Width> {
        ScanCounterIn {
            scan: ScanControl { restart: bit(), enable: bit() },
            preset: ScanCounter::position(self.screen),
        }
    }

    fn build(&self, m: Module, i: ScanCounterIn) -> ScanCounterOut {
        let ScanControl { restart, enable } = i.scan;
        let x = m.reg("x", i.preset.x.width()).reset(0);
        let y = m.reg("y", i.preset.y.width()).reset(0);
        let armed = m.reg("armed", 1).reset(0);
        net!(line_end = enable & x.eq(self.screen.width - 1));
        net!(last_line = y.eq(self.screen.height - 1));

        x.enable(restart | enable).next(mux(restart, i.preset.x, mux(line_end, 0, x + 1)));
        y.enable(restart | line_end).next(mux(restart, i.preset.y, mux(last_line, 0, y + 1)));
        net!(at_start = i.preset.x.eq(0) & i.preset.y.eq(0));
        armed.enable(restart | (line_end & last_line)).next(mux(restart, at_start, 1));
        ScanCounterOut { pixel: Position { x: x.value(), y: y.value() }, armed: armed.value() }
    }

    fn name(&self) -> String {
        format!("scan_counter_{}x{}", self.screen.width, self.screen.height)
    }

    fn about(&self) -> About {
        About {
            summary: "Counts the pixels of the screen in raster order, freely, from a preset on.".to_owned(),
            latency: "1".to_owned(),
            source: "VC-1, section 3.3, scan counter (VC1-SCAN)".to_owned(),
        }
    }
}

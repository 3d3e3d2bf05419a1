//! Signals from the global frame buffer unit to the chain of local frame buffers and merging units.

use tilewright_hdl::{below, bit, record};

use crate::parameter::Screen;

record! {
    /// The control of the scan, the same for every unit of the chain.
    pub struct ScanControl {
        /// High for one clock: every scan counter loads its preset.
        restart: bit(),
        /// The counters, the read-out and the merging units advance by a pixel; while `enable` is low, they keep their values.
        enable: bit(),
    }

    /// A pixel of the screen.
    pub struct Position(screen: Screen) {
        /// The column of the pixel, counted from the left.
        x: below(screen.width),
        /// The line of the pixel, counted from the top.
        y: below(screen.height),
    }
}

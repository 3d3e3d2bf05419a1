//! Signals from the global frame buffer unit to the chain of local frame buffers and merging units.

use tilewright_hdl::bundle;

bundle! {
    /// The control of the scan, the same for every unit of the chain.
    pub struct ScanControl<T> {
        /// For one clock: every scan counter takes its preset.
        pub restart: T,
        /// The counters, the read-out and the merging units advance by a pixel; when it is low they keep their values.
        pub enable: T,
    }

    /// A pixel of the screen.
    pub struct Position<T> {
        /// The column of the pixel, counted from the left.
        pub x: T,
        /// The line of the pixel, counted from the top.
        pub y: T,
    }
}

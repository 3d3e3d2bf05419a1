//! The designs. Each has an input `rst` and an output `csum`, a checksum of all that it does.

mod pim;
mod qt;
mod simd;

pub use pim::Pim;
pub use qt::Qt;
pub use simd::Simd;

use tilewright_hdl::bundle;

bundle! {
    /// The inputs of every design.
    pub struct BenchIn<T> {
        /// Held high for [`RESET_CYCLES`](crate::RESET_CYCLES) at the start. It is no reset of the language's kind, as what it puts
        /// into a register may differ from lane to lane.
        pub rst: T,
    }

    /// The outputs of every design.
    pub struct BenchOut<T> {
        /// The checksum, 32 bits.
        pub csum: T,
    }
}

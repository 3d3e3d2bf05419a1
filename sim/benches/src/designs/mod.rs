//! The designs. Each has an output `csum`, a checksum of everything that it does.

mod cores;
mod dots;
mod nodes;
mod pim;
mod pxpl;
mod qt;
mod renderer;
mod simd;
mod systolic;
mod vc1;

pub use cores::{Core, Processor, ProcessorIn, ProcessorOut};
pub use dots::{Dots, DotsIn, DotsOut};
pub use nodes::Nodes;
pub use pim::Pim;
pub use pxpl::Pxpl;
pub use qt::Qt;
pub use renderer::Regions;
pub use simd::Simd;
pub use systolic::Systolic;
pub use vc1::Vc1Frames;

use tilewright_hdl::bundle;

bundle! {
    /// The inputs of the designs of one clock.
    pub struct BenchIn<T> {
        /// High for [`RESET_CYCLES`](crate::RESET_CYCLES) at the start. It is not a reset of the language, because
        /// the values that it puts into a register may differ from lane to lane.
        pub rst: T,
    }

    /// The outputs of every design.
    pub struct BenchOut<T> {
        /// The checksum, 32 bits.
        pub csum: T,
    }
}

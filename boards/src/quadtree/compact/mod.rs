//! The generator for a chip with many video processors and few LUTs: the same windows and pixels by multipliers.
//!
//! The paper's video processor stores the values of all functions with each window, and moves them by shifts and adders.
//! An FPGA has multipliers. So a compact processor stores only where its window is, and computes each function there
//! anew, one edge and one plane a clock. It has no set-up, and no stack of windows.
//!
//! | file | contents |
//! |---|---|
//! | `lanes` | packets as words of an edge and a plane, and the memory that they are in |
//! | `player` | sends the words of a step |
//! | `walk` | the windows of a quadtree, one after another |
//! | `processor`, `generator` | a video processor, and the matrix of them |

mod generator;
mod lanes;
mod player;
mod processor;
mod walk;

pub use generator::{CompactGenerator, CompactGeneratorIn, CompactGeneratorOut};
pub use lanes::{Lane, Lanes};
pub use player::{LanePlayer, LanePlayerIn, LanePlayerOut};
pub use processor::{CompactProcessor, CompactProcessorIn, CompactProcessorOut};
pub use walk::{Walk, WalkIn, WalkOut};

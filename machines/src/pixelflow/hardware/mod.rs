//! The hardware in simulation: arrays, each by itself, and the network between them.

mod beside;
mod composition;
mod network;
mod node;
mod observed;
mod spare;
mod store;
mod texture;
mod words;

pub(super) use beside::Beside;
pub use composition::composition_time;
pub(super) use network::Way;
pub(super) use node::{Access, ArraySimulation, Node};
pub(super) use spare::Spare;
pub(super) use store::FrameStore;
pub(super) use texture::TextureLookUp;
pub(super) use words::Words;

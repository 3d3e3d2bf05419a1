//! The hardware in simulation: arrays, each by itself, and the network between them.

mod network;
mod node;

pub(super) use network::Way;
pub(super) use node::{Access, Node, Words};

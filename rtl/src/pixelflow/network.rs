//! The network: a chain of the ports of all nodes (PFL-NET).
//!
//! ```text
//!      node 0            node 1            node 2                  last node
//!     own  mode         own  mode         own  mode               own  mode
//!      v    v            v    v            v    v                  v    v
//! --->[  port  ]------->[  port  ]------->[  port  ]--- ... ----->[  port  ]
//!                            '-> unloaded      '-> unloaded            '-> unloaded
//! ```
//!
//! Words go one way. At each node that composites the lesser word goes on, and each node that unloads gets it. A second
//! network of the same kind goes the other way (PFL-NET).
//!
//! Latency: 1 clock per node; a byte of each chip in every clock.

use super::compositor::Mode;
use super::network_port::{NetworkPort, NetworkPortIn, Transfer};
use crate::prelude::*;

block! {
    /// Connects the ports of all nodes in a chain, in one direction.
    pub struct Network {
        /// The number of nodes.
        pub nodes: u32,
        /// The port of each node.
        pub port: NetworkPort,
    }
    latency(self) = format!("1 clock per node; a byte of all pixels takes {}", self.port.pixels);
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NET)";
    in(self) NetworkIn {
        /// The inputs of each node.
        nodes: [NodeIn::widths(&self.port); self.nodes],
    }
    out(self) NetworkOut {
        /// The outputs to each node.
        nodes: [NodeOut] = _,
    }
}

record! {
    /// A node's inputs to the network.
    pub struct NodeIn(port: &NetworkPort) {
        /// The mode of the node, constant during a word: a [`Mode`].
        mode: one_of::<Mode>(),
        /// A node in mode `Load` sends a byte of each chip.
        sends: bit(),
        /// The byte is the first of a word.
        first: bit(),
        /// The node's own bytes of the current pixels.
        own: bits(port.width).of(row(port.chips)),
    }
}

bundle! {
    /// A node's outputs from the network.
    pub struct NodeOut<T> {
        /// The current pixel of each chip.
        pub pixel: T,
        /// A byte of the current pixel is transferred.
        pub advances: T,
        /// The incoming bytes are for this node.
        pub unloaded: T,
        /// The incoming bytes, one of each chip.
        pub bytes: T,
    }
}

impl Network {
    fn build(&self, m: Module, i: NetworkIn) -> NetworkOut {
        let chips = row(self.port.chips);
        let mut upstream = Transfer { valid: lit(1, 0), first: lit(1, 0), bytes: lit(self.port.width, 0).of(chips) };
        let connect = |(number, node): (usize, NodeIn)| {
            let NodeIn { mode, sends, first, own } = node;
            let inputs = NetworkPortIn { mode, sends, first, upstream, own };
            let port = m.instance(&format!("u_port{number}"), &self.port, inputs);
            let bytes = std::mem::replace(&mut upstream, port.downstream).bytes;
            NodeOut { pixel: port.pixel, advances: port.advances, unloaded: port.unloaded, bytes }
        };
        NetworkOut { nodes: i.nodes.into_iter().enumerate().map(connect).collect() }
    }
}

#[cfg(test)]
mod tests;

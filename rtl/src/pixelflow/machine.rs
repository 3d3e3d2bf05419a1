//! The whole machine without its geometry processors: a chain of nodes, with the network between them in both
//! directions (PFL-NODE, PFL-NET).
//!
//! ```text
//!   stores, frames        stores, frames               stores, frames
//!         v                     v                            v
//!     .--------.==== forth ==>.--------.== .. ==== forth ==>.--------.==> off
//!     | node 0 |              | node 1 |                    |  last  |
//! <===.--------.<=== back ====.--------.<= .. ==== back ====.--------.
//! off   ^    ^ |                ^    ^ |                      ^    ^ |
//!    jobs   texture           jobs  texture                jobs   texture
//!
//! go, of each direction: all nodes are ready
//! ```
//!
//! | party | action | when |
//! |---|---|---|
//! | host | writes the instructions of each node, and gives their addresses | at any time |
//! | host | offers each node its jobs in both directions, one after another, one for each word | at any time |
//! | host | serves the texture ports: a shader's with a [texture unit](super::texture_unit), the frame holder's with its memory | when the port starts |
//!
//! Instructions and jobs decide whether a node is a rasterizer, a shader or the holder of the frame. A node that loads
//! a word sits behind those that get nothing of it; they have jobs of no bytes
//! ([`network_sequencer`](super::network_sequencer)).
//!
//! Latency: when all are ready, the first byte of each chip leaves one clock later, and takes 1 clock of the network
//! per node.

use super::command_dma::{Commands, Store};
use super::network_port::Transfer;
use super::network_sequencer::Job;
use super::node::{DIRECTIONS, DirectionIn, Node, NodeIn, NodeOut};
use super::registers::PortAccess;
use super::{ARRAY, NETWORK};
use crate::prelude::*;

/// The most nodes.
pub const MOST_NODES: u32 = 64;

block! {
    /// PixelFlow's nodes on a network with both directions.
    pub struct PixelFlow {
        /// The number of nodes.
        nodes: u32,
        /// The node, the same for all.
        node: Node,
    }
    latency = "1 clock of the network a node; instructions have their own clocks";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE, PFL-NET)";
    in(self) PixelFlowIn {
        /// Instructions that are written, of each node.
        stores: [Store::widths(self.node.words()).on(ARRAY); self.nodes],
        /// Frames of them that are to be done.
        frames: [stream(Commands::widths(self.node.words())).on(ARRAY); self.nodes],
        /// Evaluator and memory may each have an instruction; while it is low, one begins when the one before has ended.
        side_by_side: bit().on(ARRAY),
        /// From the texture unit of each node.
        textures: [PortAccess::widths(&self.node.array().texture()).on(ARRAY); self.nodes],
        /// The nodes whose texture unit is done.
        textures_done: bit().of(row(self.nodes)).on(ARRAY),
        /// The jobs of each node for the words that go forth, from the first node to the last.
        forth: [stream(Job).on(NETWORK); self.nodes],
        /// The jobs of each node for the words that go back.
        back: [stream(Job).on(NETWORK); self.nodes],
    }
    out(self) PixelFlowOut {
        /// To the texture unit of each node: a byte of each chip.
        texture_seen: [bits(8).of(row(self.node.array().chips())); self.nodes],
        /// The nodes whose texture unit begins.
        textures_start: bit().of(row(self.nodes)),
        /// The nodes in which every instruction has ended except in the pixels.
        idle: bit().of(row(self.nodes)),
        /// The nodes that have no job, of each direction.
        without_job: [bit().of(row(self.nodes)); DIRECTIONS],
        /// All nodes are ready for a word of the direction.
        go: [bit(); DIRECTIONS],
        /// The bytes that leave the network at the end of each direction.
        off: [Transfer::widths(&self.node.port()); DIRECTIONS],
    }
}

impl PixelFlow {
    /// A machine with `nodes` nodes.
    ///
    /// # Errors
    ///
    /// There are fewer than two nodes, or more than [`MOST_NODES`].
    ///
    /// ```
    /// use tilewright_rtl::pixelflow::{machine::PixelFlow, node::Node};
    ///
    /// let machine = PixelFlow::new(20, Node::new(128, 64, 1 << 16, 0)?)?;
    /// assert_eq!(machine.nodes() * machine.node().array().chips(), 640);
    /// # Ok::<(), tilewright_rtl::parameter::ParameterError>(())
    /// ```
    pub fn new(nodes: u32, node: Node) -> Result<PixelFlow, ParameterError> {
        if !(2..=MOST_NODES).contains(&nodes) {
            return Err(ParameterError(format!("{nodes} nodes: a machine has 2 to {MOST_NODES}")));
        }
        Ok(PixelFlow { nodes, node })
    }

    /// The number of nodes.
    pub fn nodes(&self) -> u32 {
        self.nodes
    }

    /// The node, the same for all.
    pub fn node(&self) -> &Node {
        &self.node
    }

    fn build(&self, m: Module, i: PixelFlowIn) -> PixelFlowOut {
        let network = m.on(NETWORK);
        let transfer = Transfer::widths(&self.node.port());
        let [forth, back] = ["forth", "back"].map(|name| {
            (0..self.nodes).map(|number| network.wire(&format!("{name}{number}"), transfer)).collect::<Vec<_>>()
        });
        let go = [network.wire("go_forth", bit()), network.wire("go_back", bit())];
        let nothing =
            Transfer { valid: lit(1, 0), first: lit(1, 0), bytes: lit(8, 0).of(row(self.node.array().chips())) };

        let ports = i.stores.into_iter().zip(i.frames).zip(i.textures).zip(i.forth.into_iter().zip(i.back));
        let mut nodes: Vec<NodeOut> = Vec::new();
        for (number, (((store, frames), texture), (jobs_forth, jobs_back))) in ports.enumerate() {
            let before = number.checked_sub(1).map_or(nothing, |before| *forth[before]);
            let behind = back.get(number + 1).map_or(nothing, |behind| **behind);
            let inputs = NodeIn {
                store,
                frames,
                side_by_side: i.side_by_side,
                texture,
                texture_done: i.textures_done.lane(number),
                network: vec![
                    DirectionIn { jobs: jobs_forth, go: *go[0], upstream: before },
                    DirectionIn { jobs: jobs_back, go: *go[1], upstream: behind },
                ],
            };
            let out = m.instance(&format!("u_node{number}"), &self.node, inputs);
            forth[number].drive(out.network[0].downstream);
            back[number].drive(out.network[1].downstream);
            nodes.push(out);
        }

        let of_all = |of: &dyn Fn(&NodeOut) -> Signal| stack(nodes.iter().map(of).collect::<Vec<_>>());
        for (direction, go) in go.iter().enumerate() {
            go.drive(of_all(&|node| node.network[direction].ready).and_all());
        }
        PixelFlowOut {
            textures_start: of_all(&|node| node.texture_starts),
            idle: of_all(&|node| node.idle),
            without_job: (0..DIRECTIONS as usize)
                .map(|direction| of_all(&|node| node.network[direction].idle))
                .collect(),
            go: go.iter().map(|go| **go).collect(),
            off: vec![*forth[self.nodes as usize - 1], *back[0]],
            texture_seen: nodes.into_iter().map(|node| node.texture_seen).collect(),
        }
    }
}

#[cfg(test)]
mod tests;

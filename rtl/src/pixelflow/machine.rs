//! The whole machine without its geometry processors: a chain of nodes, which the network connects in both directions
//! (PFL-NODE, PFL-NET).
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
//! | host | writes the instructions of each node, and offers the frames to execute | at any time |
//! | host | offers each node its jobs in both directions, one for each word | at any time |
//! | host | serves the texture ports: a shader's with a [texture unit](super::texture_unit), that of the frame buffer's node with a [frame buffer](super::frame_buffer) | when `textures_start` is high |
//!
//! Instructions and jobs decide whether a node is a rasterizer, a shader or the node of the frame buffer. A word begins
//! at the node that loads it. The nodes before that one have jobs of no bytes
//! ([`network_sequencer`](super::network_sequencer)).
//!
//! Latency: the first byte of each chip leaves one clock of the network after all nodes are ready. A byte takes 1 clock
//! of the network per node.

use super::command_dma::{Commands, Store};
use super::network_port::Transfer;
use super::network_sequencer::Job;
use super::node::{DIRECTIONS, DirectionIn, Node, NodeIn};
use super::registers::PortAccess;
use super::{ARRAY, NETWORK};
use crate::prelude::*;

/// The greatest number of nodes.
pub const MOST_NODES: u32 = 64;

block! {
    /// PixelFlow's nodes on a network with two directions.
    pub struct PixelFlow {
        /// The number of nodes.
        pub nodes: u32,
        /// The node, the same for all.
        pub node: Node,
    }
    ranges { nodes: 2..=MOST_NODES }
    latency = "1 clock of the network per node; in the array, the clocks of each instruction";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE, PFL-NET)";
    in(self) PixelFlowIn {
        /// A write to the instruction memory of each node.
        stores: [Store::widths(self.node.words).on(ARRAY); self.nodes],
        /// The frames that each node executes, one after another.
        frames: [stream(Commands::widths(self.node.words)).on(ARRAY); self.nodes],
        /// Evaluator and memory may execute two instructions at once; while this is low, they execute one at a time.
        side_by_side: bit().on(ARRAY),
        /// The access of each node's texture unit to its registers.
        textures: [PortAccess::widths(&self.node.array.texture()).on(ARRAY); self.nodes],
        /// For one clock: the texture unit of the node is done; a bit for each node.
        textures_done: bit().of(row(self.nodes)).on(ARRAY),
        /// The jobs of each node for the words that go forth, from the first node to the last.
        forth: [stream(Job).on(NETWORK); self.nodes],
        /// The jobs of each node for the words that go back, from the last node to the first.
        back: [stream(Job).on(NETWORK); self.nodes],
    }
    out(self) PixelFlowOut {
        /// The byte of each chip that the texture unit of each node reads.
        texture_seen: [bits(8).of(row(self.node.array.chips())); self.nodes],
        /// For one clock: the texture unit of the node begins; a bit for each node.
        textures_start: bit().of(row(self.nodes)),
        /// All instructions have left the controller of the node; a bit for each node.
        idle: bit().of(row(self.nodes)),
        /// For each direction: the node has no job; a bit for each node.
        without_job: [bit().of(row(self.nodes)); DIRECTIONS],
        /// For each direction: all nodes are ready for their word.
        go: [bit(); DIRECTIONS],
        /// For each direction: the bytes that leave the network at its end.
        off: [Transfer::widths(&self.node.port()); DIRECTIONS],
    }
}

impl PixelFlow {
    fn build(&self, m: Module, i: PixelFlowIn) -> PixelFlowOut {
        let [go_forth, go_back] = ["go_forth", "go_back"].map(|name| m.on(NETWORK).wire(name, bit()));
        let (jobs_forth, jobs_back) = (stack(i.forth), stack(i.back));
        let nodes = m.array("u_node", self.nodes, &self.node, |nodes| {
            let [forth, back] = [0, 1].map(|direction| nodes.network[direction].downstream);
            NodeIn {
                store: stack(i.stores),
                frames: stack(i.frames),
                side_by_side: i.side_by_side,
                texture: stack(i.textures),
                texture_done: i.textures_done,
                network: vec![
                    DirectionIn { jobs: jobs_forth, go: *go_forth, upstream: forth.previous(0) },
                    DirectionIn { jobs: jobs_back, go: *go_back, upstream: back.following(0) },
                ],
            }
        });
        let [forth, back] = &nodes.network[..] else { unreachable!("two directions") };
        go_forth.drive(forth.ready.and_all());
        go_back.drive(back.ready.and_all());
        PixelFlowOut {
            textures_start: nodes.texture_starts,
            idle: nodes.idle,
            without_job: vec![forth.idle, back.idle],
            go: vec![*go_forth, *go_back],
            off: vec![forth.downstream.last(), back.downstream.lane(0)],
            texture_seen: nodes.texture_seen.rows().to_vec(),
        }
    }
}

#[cfg(test)]
mod tests;

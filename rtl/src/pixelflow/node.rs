//! A node: an array that draws or shades regions, the memory of its instructions, and its ports to the network
//! (PFL-NODE, PFL-NET, facts E4).
//!
//! ```text
//!   store, frames ==>[ command fetcher ]==>[ array ]<== port ==> texture unit
//!                                             |  ^
//!                              banks given    v  | done
//!   jobs ==>[ sequencers ]<-------------[ bank 0, bank 1 ]
//!                 |                        ^         ^
//!                 v                        v         v
//!   upstream ==>[ port ]== downstream    one of them each
//! downstream ==[ port ]<== upstream
//! ```
//!
//! The network has two directions, and a node has a port and a sequencer for each. So regions of surfaces can go one
//! way while shaded ones go the other. A bank belongs to one direction at a time. Instructions and jobs alone decide
//! whether a node is a rasterizer, a shader or the node of the frame buffer.
//!
//! The array has a clock of 10 ns, and the network one of 5 ns. Two events cross between them: a bank is given, and a
//! bank is released. Each crosses as a flag that toggles, which takes 2 clocks of the other side. The bytes do not
//! cross: a side that does not have the bank does not access its registers.
//!
//! The node of the frame buffer is at an end of the network. It loads words onto the network as any other node does.
//!
//! Latency: 1 clock of the network for a byte of each chip; in the array, the clocks of each instruction.

use super::array::{PixelArray, PixelArrayIn};
use super::command_dma::{CommandDma, CommandDmaIn, Commands, Store};
use super::controller::BANKS;
use super::network_port::{NetworkPort, NetworkPortIn, Transfer};
use super::network_sequencer::{Job, NetworkSequencer, NetworkSequencerIn, NetworkSequencerOut};
use super::registers::PortAccess;
use super::{ARRAY, NETWORK};
use crate::prelude::*;

/// The directions of the network.
pub const DIRECTIONS: u32 = 2;

record! {
    /// Signals to a node from a direction of the network.
    pub struct DirectionIn(port: &NetworkPort) {
        /// The jobs of the node, one for each word.
        jobs: stream(Job),
        /// All nodes are ready.
        go: bit(),
        /// The bytes from the previous node.
        upstream: Transfer::widths(port),
    }
}

bundle! {
    /// Signals from a node to a direction of the network.
    pub struct DirectionOut<T> {
        /// The node is ready for its word.
        pub ready: T,
        /// The node has no job in this direction.
        pub idle: T,
        /// The bytes to the next node.
        pub downstream: Transfer<T>,
    }
}

/// The greatest capacity of a node's memory, in instructions.
pub const MOST: u32 = 1 << 20;

/// The longest set-up, in clocks of the network.
pub const LONGEST_SETUP: u32 = 1 << 16;

block! {
    /// A node of PixelFlow without its geometry processors.
    pub struct Node {
        /// The array of pixels.
        pub array: PixelArray,
        /// The capacity of the instruction memory.
        pub words: u32,
        /// The set-up before a word, in clocks of the network.
        pub setup: u32,
    }
    ranges { words: 1..=MOST, setup: ..=LONGEST_SETUP }
    latency = "1 clock of the network for a byte of each chip; in the array, the clocks of each instruction";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE, PFL-NET)";
    in(self) NodeIn {
        /// A write to the instruction memory.
        store: Store::widths(self.words).on(ARRAY),
        /// The frames to execute, one after another.
        frames: stream(Commands::widths(self.words)).on(ARRAY),
        /// Evaluator and memory may execute two instructions at once; while this is low, they execute one at a time.
        side_by_side: bit().on(ARRAY),
        /// The texture unit's access to its registers.
        texture: PortAccess::widths(&self.array.texture()).on(ARRAY),
        /// For one clock: the texture unit is done.
        texture_done: bit().on(ARRAY),
        /// The inputs from both directions of the network.
        network: [DirectionIn::widths(&self.port()).on(NETWORK); DIRECTIONS],
    }
    out(self) NodeOut {
        /// The byte of each chip that the texture unit reads.
        texture_seen: bits(8).of(row(self.array.chips())),
        /// For one clock: the texture unit begins.
        texture_starts: bit(),
        /// All instructions have left the controller; the pixels execute the last one after the evaluator's latency.
        idle: bit(),
        /// The outputs to both directions of the network.
        network: [DirectionOut] = _,
    }
}

impl Node {
    /// The port to a direction of the network.
    pub fn port(&self) -> NetworkPort {
        self.array.network_port()
    }

    fn build(&self, m: Module, i: NodeIn) -> NodeOut {
        let (array, network) = (m.on(ARRAY), m.on(NETWORK));
        let NodeIn { store, frames, side_by_side, texture, texture_done, network: directions } = i;
        def!(dma = array.instance(&CommandDma { words: self.words }, CommandDmaIn { store, frames }));
        def!(given = array.wire(bits(BANKS)));
        def!(done = network.wire(bits(BANKS)));
        let bank_done = m.within("done", || crossed(array, network, *done));
        def!(held = network.reg(bits(BANKS)).reset(0));
        held.next((held & !done) | m.within("given", || crossed(network, array, *given)));

        // Both banks show a byte of each chip. Each direction selects the byte of the bank that it has.
        let seen: Vec<Wire> =
            (0..BANKS).map(|bank| network.wire(&format!("seen{bank}"), bits(8).of(row(self.array.chips())))).collect();
        let sides: Vec<Side> = (0..)
            .zip(directions)
            .map(|(number, direction)| self.side(network, number, direction, *held, &seen))
            .collect();
        let [first, second] = &sides[..] else { unreachable!("two directions") };
        done.drive(first.sequencer.done | second.sequencer.done);
        let both = (first.sequencer.bank & second.sequencer.bank).ne(0);
        network.assert(!both, "a bank belongs to one direction at a time");
        let access =
            (0..BANKS).map(|bank| mux(second.sequencer.bank.bit(bank), second.access(bank), first.access(bank)));

        let inputs = PixelArrayIn {
            instructions: dma.instructions,
            side_by_side,
            bank_done,
            texture_done,
            network: access.collect(),
            texture,
        };
        let pixels = m.instance("u_array", &self.array, inputs);
        given.drive(pixels.given.banks);
        seen.into_iter().zip(pixels.network_seen).for_each(|(wire, bytes)| wire.drive(bytes));
        NodeOut {
            texture_seen: pixels.texture_seen,
            texture_starts: pixels.given.texture,
            idle: pixels.idle & dma.idle,
            network: sides.into_iter().map(|side| side.out).collect(),
        }
    }

    /// The port and the sequencer of a direction.
    fn side(&self, m: Module, number: u32, i: DirectionIn, held: Signal, seen: &[Wire]) -> Side {
        let named = |what: &str| format!("{what}{number}");
        let port = self.port();
        let pixel = m.wire(&named("pixel"), below(port.pixels));
        let advances = m.wire(&named("advances"), bit());
        let sequencer = NetworkSequencer { pixels: port.pixels, setup: self.setup };
        let DirectionIn { jobs, go, upstream } = i;
        let inputs = NetworkSequencerIn { jobs, given: held, go, pixel: *pixel, advances: *advances };
        let sequencer = m.instance(&named("u_sequencer"), &sequencer, inputs);
        let own = mux(sequencer.bank.bit(1), *seen[1], *seen[0]);
        let NetworkSequencerOut { mode, sends, first, .. } = sequencer;
        let passed = m.instance(&named("u_port"), &port, NetworkPortIn { mode, sends, first, upstream, own });
        pixel.drive(passed.pixel);
        advances.drive(passed.advances);
        let out = DirectionOut { ready: sequencer.ready, idle: sequencer.idle, downstream: passed.downstream };
        Side { sequencer, pixel: passed.pixel, unloaded: passed.unloaded, bytes: upstream.bytes, out }
    }
}

/// The outputs of a direction's sequencer and port.
struct Side {
    sequencer: NetworkSequencerOut,
    pixel: Signal,
    unloaded: Signal,
    bytes: Signal,
    out: DirectionOut,
}

impl Side {
    /// The direction's access to a bank, if it has the bank.
    fn access(&self, bank: u32) -> PortAccess {
        let writes = self.unloaded & self.sequencer.bank.bit(bank);
        PortAccess { pixel: self.pixel, address: self.sequencer.address, writes, bytes: self.bytes }
    }
}

/// Carries pulses from the clock of `there` to that of `here`: each toggles a flag, which two registers synchronize.
fn crossed(here: Module, there: Module, pulses: Signal) -> Signal {
    let mut bits = Vec::new();
    for bit in (0..pulses.width()).rev() {
        let flag = there.toggle(&format!("flag{bit}"), pulses.bit(bit));
        let flag = here.synchronize(&format!("here{bit}"), flag);
        let before = here.reg(&format!("before{bit}"), self::bit()).reset(0);
        before.next(flag);
        bits.push(flag ^ *before);
    }
    concat(&bits)
}

#[cfg(test)]
mod tests;

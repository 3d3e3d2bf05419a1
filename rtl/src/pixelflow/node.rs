//! A node: an array that draws or shades regions, its instructions, and its ports to the network (PFL-NODE, PFL-NET,
//! facts E4).
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
//! The network has two directions, and a node has a port and a sequencer for each. So regions of surfaces can come one
//! way while shaded ones go the other. A bank belongs to one direction at a time. Instructions and jobs alone decide
//! whether a node is a rasterizer, a shader or the holder of the frame.
//!
//! The array has a clock of 10 ns, and the network one of 5 ns. Two events cross between them: a bank is given, and a
//! bank is released. Each crosses as a flag that toggles, which takes 2 clocks of the other side. The bytes themselves
//! are in registers that the other side leaves alone.
//!
//! The holder of the frame is at an end of the network, and sends words there as any node loads them.
//!
//! Latency: a byte of each chip passes in 1 clock of the network; the instructions have their own clocks.

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

/// The largest capacity of a node's memory, in instructions.
pub const MOST: u32 = 1 << 20;

/// The longest set-up, in clocks of the network.
pub const LONGEST_SETUP: u32 = 1 << 16;

record! {
    /// Signals to a node from a direction of the network.
    pub struct DirectionIn(port: &NetworkPort) {
        /// The jobs of the node, one for each word.
        jobs: stream(Job),
        /// All nodes are ready.
        go: bit(),
        /// From the node before.
        upstream: Transfer::widths(port),
    }
}

bundle! {
    /// Signals from a node to a direction of the network.
    pub struct DirectionOut<T> {
        /// The node is set for its word.
        pub ready: T,
        /// There is no job.
        pub idle: T,
        /// To the node behind.
        pub downstream: Transfer<T>,
    }
}

block! {
    /// A node of PixelFlow without its geometry processors.
    pub struct Node {
        /// Its pixels.
        array: PixelArray,
        /// The capacity of its memory, in instructions.
        words: u32,
        /// Clocks of the network's set-up before a word.
        setup: u32,
    }
    latency = "a byte of each chip passes in 1 clock of the network; instructions have their own clocks";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE, PFL-NET)";
    in(self) NodeIn {
        /// Instructions that are written.
        store: Store::widths(self.words).on(ARRAY),
        /// Frames of them that are to be done.
        frames: stream(Commands::widths(self.words)).on(ARRAY),
        /// Evaluator and memory may each have an instruction; while it is low, one begins when the one before has ended.
        side_by_side: bit().on(ARRAY),
        /// From the texture unit.
        texture: PortAccess::widths(&self.array.texture()).on(ARRAY),
        /// The texture unit is done.
        texture_done: bit().on(ARRAY),
        /// From both directions of the network.
        network: [DirectionIn::widths(&self.port()).on(NETWORK); DIRECTIONS],
    }
    out(self) NodeOut {
        /// To the texture unit: a byte of each chip.
        texture_seen: bits(8).of(row(self.array.chips())),
        /// The texture unit begins.
        texture_starts: bit(),
        /// Every instruction has ended except in the pixels, which are as late as the evaluator.
        idle: bit(),
        /// To both directions of the network.
        network: [DirectionOut] = _,
    }
}

impl Node {
    /// A node with these pixels, a memory for `words` instructions, and a set-up of `setup` clocks of the
    /// network before each word.
    ///
    /// # Errors
    ///
    /// There is no such array; or the memory has no instructions, or more than [`MOST`]; or the set-up is above
    /// [`LONGEST_SETUP`].
    pub fn new(width: u32, height: u32, words: u32, setup: u32) -> Result<Node, ParameterError> {
        let array = PixelArray::new(width, height)?;
        if !(1..=MOST).contains(&words) {
            return Err(ParameterError(format!("a memory of {words} instructions: it has to hold from 1 to {MOST}")));
        }
        if setup > LONGEST_SETUP {
            return Err(ParameterError(format!("a set-up of {setup} clocks: {LONGEST_SETUP} are the most")));
        }
        Ok(Node { array, words, setup })
    }

    /// Its pixels.
    pub fn array(&self) -> &PixelArray {
        &self.array
    }

    /// The capacity of its memory, in instructions.
    pub fn words(&self) -> u32 {
        self.words
    }

    /// Clocks of the network's set-up before a word.
    pub fn setup(&self) -> u32 {
        self.setup
    }

    /// Its port to a direction of the network.
    pub fn port(&self) -> NetworkPort {
        self.array.network_port()
    }

    fn build(&self, m: Module, i: NodeIn) -> NodeOut {
        let (array, network) = (m.on(ARRAY), m.on(NETWORK));
        let NodeIn { store, frames, side_by_side, texture, texture_done, network: directions } = i;
        def!(dma = array.instance(&CommandDma { words: self.words }, CommandDmaIn { store, frames }));
        def!(given = array.wire(bits(BANKS)));
        def!(done = network.wire(bits(BANKS)));
        let bank_done = m.within("done", || turned(array, network, *done));
        def!(held = network.reg(bits(BANKS)).reset(0));
        held.next((held & !done) | m.within("given", || turned(network, array, *given)));

        // Each direction gets the byte that its bank shows, and selects it.
        let seen: Vec<Wire> =
            (0..BANKS).map(|bank| network.wire(&format!("seen{bank}"), bits(8).of(row(self.array.chips())))).collect();
        let sides: Vec<Side> = (0..)
            .zip(directions)
            .map(|(number, direction)| self.side(network, number, direction, *held, &seen))
            .collect();
        let [first, second] = &sides[..] else { unreachable!("two directions") };
        done.drive(first.sequencer.done | second.sequencer.done);
        let both = (first.sequencer.bank & second.sequencer.bank).ne(0);
        network.assert(!both, "a bank is of one direction at a time");
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

/// The state of a direction.
struct Side {
    sequencer: NetworkSequencerOut,
    pixel: Signal,
    unloaded: Signal,
    bytes: Signal,
    out: DirectionOut,
}

impl Side {
    /// What it sends to a bank that it has.
    fn access(&self, bank: u32) -> PortAccess {
        let writes = self.unloaded & self.sequencer.bank.bit(bank);
        PortAccess { pixel: self.pixel, address: self.sequencer.address, writes, bytes: self.bytes }
    }
}

/// Pulses of one clock as pulses of this clock: a flag toggles with each, and two registers synchronize it.
fn turned(here: Module, there: Module, marks: Signal) -> Signal {
    let mut bits = Vec::new();
    for bit in (0..marks.width()).rev() {
        let flag = there.toggle(&format!("flag{bit}"), marks.bit(bit));
        let flag = here.synchronize(&format!("here{bit}"), flag);
        let before = here.reg(&format!("before{bit}"), self::bit()).reset(0);
        before.next(flag);
        bits.push(flag ^ *before);
    }
    concat(&bits)
}

#[cfg(test)]
mod tests;

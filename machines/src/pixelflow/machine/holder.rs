//! The node that holds the frame, where it has an array that works: it adds up samples that come one after another (PFL-NT).
//!
//! Words come to its two banks in turn, as to any node. With the last sample its sums become colours, which stand in the bank instead; the
//! frame's memory reads them there, as the network would, in the last of the time that it takes to write them. Then the bank is free for words.

use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_sim::EngineKind;

use crate::error::Error;
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::hardware::{Access, Node, Words};
use crate::pixelflow::works::Works;

/// The node.
pub(super) struct Holder {
    node: Node,
    pixels: u64,
}

impl Holder {
    /// One whose banks both wait for words.
    pub fn new(array: &PixelArray, engine: EngineKind, side_by_side: bool) -> Result<Holder, Error> {
        let mut node = Node::new(array, engine, side_by_side)?;
        for bank in [0, 1] {
            node.run(&Works::first(bank))?;
        }
        Ok(Holder { node, pixels: array.pixels().into() })
    }

    /// When it has a bank for the words of a turn.
    pub fn awaits(&mut self, works: &Works, turn: usize) -> Result<Ticks, Error> {
        let bank = turn % 2;
        if turn.checked_sub(2).is_some_and(|before| works.ends(before)) {
            self.node.run(&Works::free_again(bank as u64))?;
        }
        Ok(self.node.given(bank))
    }

    /// Adds words that come from a tick on; gives the tick by which it has.
    pub fn add(&mut self, works: &Works, turn: usize, from: Ticks, came: Words) -> Result<Ticks, Error> {
        self.node.access(Access { from, bank: turn % 2, bytes: works.bytes(), comes: Some(came) });
        self.node.run(&works.holding(turn))
    }

    /// The frame's memory takes the colours of a turn, to the last by that tick.
    pub fn take(&mut self, turn: usize, added: Ticks, end: Ticks) {
        let from = end.saturating_sub(Works::COLOUR * self.pixels).max(added);
        self.node.access(Access { from, bank: turn % 2, bytes: Works::COLOUR, comes: None });
    }

    /// The colours that it took of all turns that end a region, in their order.
    pub fn taken(&mut self, works: &Works) -> Result<Vec<Words>, Error> {
        self.node.finish()?;
        let ends = (0..works.turns()).filter(|turn| works.ends(*turn));
        Ok(ends.map(|turn| self.node.sent(turn % 2).expect("its colours have gone")).collect())
    }

    /// Clocks in which it had an instruction.
    pub fn busy(&self) -> u64 {
        self.node.busy()
    }
}

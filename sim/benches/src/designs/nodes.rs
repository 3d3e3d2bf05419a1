//! Renderers, one of which is busy at a time: most nodes of a machine wait most of the time.
//!
//! ```text
//!   turn ----> [ node 0 ]    [ node 1 ]    [ node 2 ]  ..  each a renderer of 32 x 32 pixels
//!                  |             |             |           with its program
//!                  '-------------+-------------'----> checksum
//! ```
//!
//! The active node sends its renderer instructions; the others finish theirs, and wait for their turn.
//!
//! It tests whether unchanged values are not recomputed.

use tilewright_hdl::{Module, below, bit, bits, block, constants, def, lit, mux};
use tilewright_rtl::parameter::ParameterError;

use super::{BenchOut, Regions};

/// Pixels in a line of a node's regions.
const SIDE: u32 = 32;
/// Clocks of a turn, about as many as a region takes.
const TURN: u64 = 1 << 13;

block! {
    /// Renderers with their programs, one of them busy at a time.
    pub struct Nodes {
        count: u32,
        node: Node,
    }
    out = BenchOut { csum: bits(32) };
}

impl Nodes {
    /// The given number of renderers.
    ///
    /// # Errors
    ///
    /// There is no renderer with that side.
    pub fn new(count: u32) -> Result<Nodes, ParameterError> {
        Ok(Nodes { count, node: Node { regions: Regions::new(SIDE)? } })
    }

    fn build(&self, m: Module, (): ()) -> BenchOut {
        def!(clock = m.reg(below(TURN)).reset(0));
        def!(turn = m.reg(bits(16)).reset(0));
        let ends = clock.eq(TURN - 1);
        clock.next(mux(ends, 0, clock + 1));
        turn.when(ends, mux(turn.eq(self.count - 1), 0, turn + 1));
        let number = constants(bits(16).of(self.count), u64::from);
        let nodes = m.array("u_node", self.count, &self.node, |_| NodeIn { is_busy: number.eq(*turn) });
        BenchOut { csum: nodes.csum.to_vec().into_iter().fold(lit(32, 0), |all, one| all.rotate_left(1) ^ one) }
    }
}

block! {
    /// A renderer with its program.
    struct Node {
        regions: Regions,
    }
    in NodeIn {
        /// Its renderer is sent instructions.
        is_busy: bit(),
    }
    out = BenchOut { csum: bits(32) };
}

impl Node {
    fn build(&self, m: Module, i: NodeIn) -> BenchOut {
        self.regions.work(m, i.is_busy)
    }
}

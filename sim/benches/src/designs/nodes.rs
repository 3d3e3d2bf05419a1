//! Renderers of which one is busy: of the nodes of a machine, most wait most of the time.
//!
//! ```text
//!   turn ----> [ node 0 ]    [ node 1 ]    [ node 2 ]  ..  each a renderer of 32 x 32 pixels
//!                  |             |             |           with its program
//!                  '-------------+-------------'----> checksum
//! ```
//!
//! A node that has its turn sends its renderer instructions; the others end what they have, and wait until their turn comes.
//!
//! What it asks of a simulator: not to compute what stays as it is.

use tilewright_hdl::ir::About;
use tilewright_hdl::{Block, Module, Width, below, bit, bits, bundle, constants, lit, mux};
use tilewright_rtl::parameter::ParameterError;

use super::{BenchOut, Regions};

/// Pixels in a line of a node's regions.
const SIDE: u32 = 32;
/// Clocks of a turn, about as many as a region takes.
const TURN: u64 = 1 << 13;

/// Renderers, one of them busy at a time.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Nodes {
    count: u32,
    node: Node,
}

impl Nodes {
    /// So many.
    ///
    /// # Errors
    ///
    /// There is no renderer of that side.
    pub fn new(count: u32) -> Result<Nodes, ParameterError> {
        Ok(Nodes { count, node: Node { regions: Regions::new(SIDE)? } })
    }
}

impl Block for Nodes {
    type In = ();
    type Out = BenchOut;

    fn inputs(&self) {}

    fn build(&self, m: Module, (): ()) -> BenchOut {
        let clock = m.reg("clock", below(TURN)).reset(0);
        let turn = m.reg("turn", bits(16)).reset(0);
        let ends = clock.eq(TURN - 1);
        clock.next(mux(ends, 0, clock + 1));
        turn.when(ends, mux(turn.eq(self.count - 1), 0, turn + 1));
        let number = constants(bits(16).of(self.count), u64::from);
        let nodes = m.array("u_node", self.count, &self.node, |_| NodeIn { is_busy: number.eq(*turn) });
        BenchOut { csum: nodes.csum.to_vec().into_iter().fold(lit(32, 0), |all, one| all.rotate_left(1) ^ one) }
    }

    fn name(&self) -> String {
        format!("nodes_n{}", self.count)
    }

    fn about(&self) -> About {
        About {
            summary: format!("{} renderers of {SIDE} x {SIDE} pixels, one of them busy at a time.", self.count),
            ..About::default()
        }
    }
}

bundle! {
    /// The inputs of a node.
    struct NodeIn<T> {
        /// Its renderer is sent instructions.
        is_busy: T,
    }
}

/// A renderer with its program.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Node {
    regions: Regions,
}

impl Block for Node {
    type In = NodeIn;
    type Out = BenchOut;

    fn inputs(&self) -> NodeIn<Width> {
        NodeIn { is_busy: bit() }
    }

    fn build(&self, m: Module, i: NodeIn) -> BenchOut {
        self.regions.work(m, i.is_busy)
    }

    fn name(&self) -> String {
        format!("node_s{SIDE}")
    }

    fn about(&self) -> About {
        About { summary: format!("A renderer of {SIDE} x {SIDE} pixels with its program."), ..About::default() }
    }
}

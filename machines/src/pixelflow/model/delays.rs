//! The delays of circuits, in addition to the times of work and words.

use crate::pixelflow::costs::Ticks;

/// Delays of clock crossings and set-up, in ticks of the network. The paper's systems have none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::pixelflow) struct Delays {
    /// From the time at which a bank is given until the network knows it.
    pub given: Ticks,
    /// From a word's last byte at a node until the node has its next job.
    pub job: Ticks,
    /// From a node's bank until the node is ready, including the set-up.
    pub set: Ticks,
    /// From the tick in which all nodes are ready to the first byte.
    pub go: Ticks,
    /// From a node to the next one.
    pub hop: Ticks,
}

impl Delays {
    /// The delays of [`Node`](tilewright_rtl::pixelflow::node::Node) and
    /// [`NetworkSequencer`](tilewright_rtl::pixelflow::network_sequencer::NetworkSequencer).
    pub fn of_hardware(set_up: Ticks) -> Delays {
        // Two registers and the edge at which it is noted; a job is taken and looks for its bank; that and the first look at the set-up.
        Delays { given: 3, job: 1, set: 2 + set_up, go: 1, hop: 1 }
    }
}

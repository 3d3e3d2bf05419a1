//! What a circuit states: assertions and assumptions, covers, and displays.

use tilewright_circuit::Loc;
use tilewright_circuit::ir;

use super::{ValueId, hierarchy};

/// A condition that must be true at every edge of its clock while that clock's reset is low.
#[derive(Debug, Clone)]
pub struct Assert {
    /// Its clock, by index in [`Program::clocks`](super::Program::clocks).
    pub clock: u32,
    /// 1 bit a lane.
    pub condition: ValueId,
    /// The message if it is false.
    pub message: String,
    /// Whether the stimulus is wrong then.
    pub is_assumption: bool,
    /// The place in the description.
    pub loc: Loc,
    /// The number of lanes of the condition for each instance.
    pub group: u32,
    /// Its scope; several for separate instances that run in lanes.
    pub scopes: Vec<hierarchy::ScopeId>,
}

/// A condition whose edges are counted, in a register beside those of the design.
#[derive(Debug, Clone)]
pub struct Cover {
    /// Its clock, by index in [`Program::clocks`](super::Program::clocks).
    pub clock: u32,
    /// The register that counts, in each lane, also while the reset is high.
    pub counter: ValueId,
    /// The name of the event.
    pub name: String,
    /// The place in the description.
    pub loc: Loc,
    /// The number of lanes for each instance.
    pub group: u32,
    /// Its scope; several for separate instances that run in lanes.
    pub scopes: Vec<hierarchy::ScopeId>,
}

/// A text that is shown at the edges at which a condition is true.
#[derive(Debug, Clone)]
pub struct Display {
    /// Its clock, by index in [`Program::clocks`](super::Program::clocks).
    pub clock: u32,
    /// 1 bit a lane.
    pub condition: ValueId,
    /// The text.
    pub pieces: Vec<ir::Piece>,
    /// The values in it, as many lanes as the condition has.
    pub values: Vec<(ValueId, ir::Kind)>,
    /// The place in the description.
    pub loc: Loc,
    /// The number of lanes of the condition for each instance.
    pub group: u32,
    /// Its scope; several for separate instances that run in lanes.
    pub scopes: Vec<hierarchy::ScopeId>,
}

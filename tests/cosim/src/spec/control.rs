//! State machines, and what is chosen by a code.

use super::Pick;

/// A state machine of four states.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Machine {
    /// Where it goes from each state.
    pub states: [Exits; 4],
    /// The values that it chooses from by its state.
    pub chosen: [Pick; 4],
    /// What is asked of its transitions.
    pub asks: Vec<Ask>,
}

/// Where a state machine goes from a state.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Exits {
    /// Conditions, and the states they lead to.
    pub when: Vec<(Pick, u8)>,
    /// The state otherwise; `None` means that it stays.
    pub otherwise: Option<u8>,
}

/// What is asked of the transitions of a state machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Ask {
    /// Whether it leaves a state.
    Leaves(u8),
    /// Whether it enters a state.
    Enters(u8),
    /// Whether it goes from one state to another, or stays.
    Goes(u8, u8),
}

/// A register of an enum's codes, and what is chosen by it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Coded {
    /// A reset gives its first code; else power-on.
    pub begins_with_reset: bool,
    /// The first code.
    pub first: u8,
    /// When it takes which code.
    pub updates: Vec<(Pick, u8)>,
    /// What it chooses from.
    pub chosen: [Pick; 3],
    /// It chooses records.
    pub records: bool,
    /// Bits that are read as a code, and may be none.
    pub raw: Pick,
}

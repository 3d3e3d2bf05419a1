//! Pads, which only the top has.

use super::Pick;

/// A pad, and what the chip drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Pad {
    /// Its pins; an open drain has one.
    pub width: u32,
    /// A line that nobody drives is high.
    pub pull_up: bool,
    /// When the chip drives.
    pub drives: Drives,
    /// What it drives.
    pub out: Pick,
}

/// When a chip drives a pad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Drives {
    /// Never: the pad is an input.
    Never,
    /// Always: the pad is an output.
    Always,
    /// It pulls the line low while a value has its lowest bit.
    Low(Pick),
    /// It drives while a value has its lowest bit.
    While(Pick),
}

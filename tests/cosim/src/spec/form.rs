//! What values are held as: how many bits, and what they stand for.

/// What bits stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Meaning {
    /// A number.
    Number,
    /// A signed number.
    Signed,
    /// A code of an enum.
    Code,
}

/// A width, and what its bits stand for; as a code they are as many as the enum needs, whatever the width is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Form {
    /// The width in bits.
    pub width: u32,
    /// What they stand for.
    pub meaning: Meaning,
}

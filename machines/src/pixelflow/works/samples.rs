//! How the samples of a pixel follow each other.

/// How the samples of a pixel follow each other, and who makes one colour of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Samples {
    /// There is one.
    One,
    /// Four are side by side, of each of two renderings. All are shaded, and the frame buffer averages them.
    SideBySide,
    /// Those of a region are one after another, and a shader averages what it shades.
    ShadedOnce,
    /// Those of all regions are one after another, and the frame's holder adds them up.
    InMemory,
}

impl Samples {
    /// Turns that a region has one after another.
    pub fn together(self) -> usize {
        match self {
            Samples::One | Samples::InMemory => 1,
            Samples::SideBySide => 2,
            Samples::ShadedOnce => 8,
        }
    }

    /// How often all regions have them.
    pub fn rounds(self) -> usize {
        if self == Samples::InMemory { 8 } else { 1 }
    }

    /// How many a pixel has.
    pub fn count(self) -> u32 {
        if self == Samples::One { 1 } else { 8 }
    }
}

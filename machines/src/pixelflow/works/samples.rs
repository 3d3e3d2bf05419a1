//! The sequence of a pixel's samples.

/// The sequence of a pixel's samples, and the unit that averages them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Samples {
    /// One sample.
    One,
    /// Two renderings with four samples side by side. All are shaded, and the frame buffer averages them.
    SideBySide,
    /// The samples of a region one after another. A shader averages them after shading.
    ShadedOnce,
    /// Each sample for all regions, one after another. The node of the frame buffer adds them up.
    InMemory,
}

impl Samples {
    /// The number of consecutive turns of a region.
    pub fn together(self) -> usize {
        match self {
            Samples::One | Samples::InMemory => 1,
            Samples::SideBySide => 2,
            Samples::ShadedOnce => 8,
        }
    }

    /// The number of passes over all regions.
    pub fn rounds(self) -> usize {
        if self == Samples::InMemory { 8 } else { 1 }
    }

    /// The number of samples of a pixel.
    pub fn count(self) -> u32 {
        if self == Samples::One { 1 } else { 8 }
    }
}

//! Parameters of the machines' blocks, and the error for a value that cannot be built.

use std::fmt;

use tilewright_hdl::OutOfRange;
use tilewright_hdl::catalog::CatalogError;

/// A parameter value for which there is no hardware; one sentence says why, and which values work.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ParameterError(pub String);

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for ParameterError {}

impl From<OutOfRange> for ParameterError {
    fn from(problem: OutOfRange) -> ParameterError {
        ParameterError(problem.to_string())
    }
}

impl From<ParameterError> for CatalogError {
    fn from(ParameterError(sentence): ParameterError) -> CatalogError {
        CatalogError::Parameters(sentence)
    }
}

/// The screen's size in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Screen {
    /// Pixels in a scan line.
    pub width: u32,
    /// Scan lines.
    pub height: u32,
}

impl Screen {
    /// The screen of the VC-1.
    pub const VC1: Screen = Screen { width: 640, height: 480 };

    /// A screen of up to 2048 x 2048 pixels, the range of the integer contract.
    ///
    /// # Errors
    ///
    /// A side is 0 or above 2048.
    pub fn new(width: u32, height: u32) -> Result<Screen, ParameterError> {
        if [width, height].iter().all(|side| (1..=2048).contains(side)) {
            return Ok(Screen { width, height });
        }
        Err(ParameterError(format!("a screen of {width} x {height} pixels: each side has to be from 1 to 2048")))
    }

    /// The number of pixels.
    pub const fn pixels(self) -> u32 {
        self.width * self.height
    }
}

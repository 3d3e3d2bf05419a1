//! The designs behind a serial line, with what is theirs of the board.

use tilewright_blocks::{I2cMaster, I2cMode, SpiFlashReader};
use tilewright_boards::ulx3s::CORE;

/// A design behind a serial line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Served {
    /// Registers behind AXI4-Lite: the first is shown by eight LEDs, and seven buttons are a word of status.
    AxiLite,
    /// A reader of a flash memory.
    Flash,
    /// A master of I2C.
    I2c,
    /// The transform of vectors.
    Transform,
    /// Sines and cosines.
    SineCosine,
    /// A cache before a memory on the chip.
    Cache,
}

impl Served {
    /// Each of them.
    pub fn all() -> [Served; 6] {
        use Served::*;
        [AxiLite, Flash, I2c, Transform, SineCosine, Cache]
    }

    /// Its name in the names of nets.
    pub fn name(self) -> &'static str {
        match self {
            Served::AxiLite => "axi_lite",
            Served::Flash => "flash",
            Served::I2c => "i2c",
            Served::Transform => "transform",
            Served::SineCosine => "sine_cosine",
            Served::Cache => "cache",
        }
    }
}

/// The reader: SCK has 20 MHz.
pub const READER: SpiFlashReader = SpiFlashReader { half_period: 2, fast: true, length: 16 };

/// The master: SCL has 400 kHz.
pub fn master() -> I2cMaster {
    I2cMaster::new(I2cMode::Fast, CORE.period)
}

//! The clocks of the VC-1.

use tilewright_hdl::{Clock, Period};

/// The processing elements run at 40 MHz (VC1-PE).
pub const PE: Clock = Clock::new("pe", Period::ns(25));

/// The image merger takes a pixel every 80 ns (VC1-TM).
pub const MERGE: Clock = Clock::new("merge", Period::ns(80));

/// The display takes a pixel every 39.682 ns: VGA at 60 Hz, 800 x 525 pixels including the blanking.
pub const CRT: Clock = Clock::new("crt", Period::ps(39_682));

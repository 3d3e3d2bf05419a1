//! The time of each step of a frame, as measured, computed or estimated in the paper.

use serde::Serialize;

/// A time in ticks, the network's clocks of 5 ns. All times of the paper are whole ticks (PFL-NET).
pub type Ticks = u64;

/// The ticks of a time in microseconds.
///
/// ```
/// use tilewright_machines::pixelflow::{Costs, ticks};
///
/// assert_eq!(ticks(Costs::default().rasterize), 166);
/// ```
pub fn ticks(microseconds: f64) -> Ticks {
    (microseconds * 200.0).round() as Ticks
}

/// The milliseconds of a number of ticks.
pub fn milliseconds(ticks: Ticks) -> f64 {
    ticks as f64 / 200_000.0
}

/// The time of each step in microseconds.
///
/// ```
/// use tilewright_machines::pixelflow::Costs;
///
/// let costs = Costs::default();
/// assert_eq!(format!("{:.2}", costs.composed_byte * 21.0), "26.88");
/// assert_eq!(format!("{:.1}", costs.addresses + costs.look_up), "110.4");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Costs {
    /// The start of a frame (PFL-LAT1).
    pub overhead: f64,
    /// Geometry of a primitive in the base system, with its sorting into bins (PFL-LAT1).
    pub transform: f64,
    /// The first pass over a primitive if they are sorted before (PFL-PRE).
    pub sort: f64,
    /// The second pass over it, which makes its instructions (PFL-PRE).
    pub generate: f64,
    /// Geometry of a primitive without texture and without sorting (PFL-NT).
    pub transform_plain: f64,
    /// Rasterization of a primitive with all appearance parameters, in one region (PFL-TRAST).
    pub rasterize: f64,
    /// Rasterization of a primitive with depth and colour, in one region (PFL-NT).
    pub rasterize_plain: f64,
    /// A byte of each pixel of a region through the composition network (PFL-TCB).
    pub composed_byte: f64,
    /// Texture addresses of a region (PFL-SHADE).
    pub addresses: f64,
    /// Look-up of all textures of a region, in the worst case (PFL-SHADE).
    pub look_up: f64,
    /// A region's colours into the frame buffer (PFL-LOAD).
    pub load: f64,
}

impl Default for Costs {
    /// The costs of the paper.
    fn default() -> Costs {
        Costs {
            overhead: 100.0,
            transform: 1.85,
            sort: 0.74,
            generate: 1.45,
            transform_plain: 0.87,
            rasterize: 0.83,
            rasterize_plain: 0.62,
            composed_byte: 1.28,
            addresses: 15.4,
            look_up: 95.0,
            load: 52.0,
        }
    }
}

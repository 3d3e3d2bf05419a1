//! What the program of a processing element costs, in clocks of the processor.
//!
//! Source: VC1-T1, Table 1 of the paper times 16 processors over 12482 polygons at 40 MHz: 631 clocks of geometry and 754 of
//! rasterization per polygon of ter1k. Set-up is estimated at 500 (facts E1). A pixel takes 3, the fastest that the local frame
//! buffer accepts (VC1-ACC). Our ter1k has, per polygon and averaged over the 48 views, 0.9104 packets of 4.3235 rows and 16.062
//! pixels in all, so that a row of 58 clocks makes up the 754: `0.9104*500 + 4.3235*58 + 16.062*3 = 754.1`. Clearing an entry of
//! the patch table takes 3 (VC1-CLR2 gives no number).

use serde::Serialize;
use tilewright_scenes::Triangle;

/// Clocks of the processing element for each step of its program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct CostTable {
    /// Transformation, lighting, clipping of a polygon, drawn or not.
    pub geometry: u64,
    /// Set-up of a packet.
    pub set_up: u64,
    /// Each row of a packet's bounding box: its edges are stepped, its span is found.
    pub row: u64,
    /// Each covered pixel, the clock of its request among them; at least 1.
    pub pixel: u64,
    /// Clearing of an entry of the patch table, the clock of its write among them; at least 1.
    pub clear: u64,
}

impl Default for CostTable {
    fn default() -> Self {
        CostTable { geometry: 631, set_up: 500, row: 58, pixel: 3, clear: 3 }
    }
}

impl CostTable {
    /// What drawing a packet is expected to cost, its pixels taken from its area (as VC1-APR does).
    pub(crate) fn estimate(&self, packet: &Triangle) -> u64 {
        self.set_up + u64::from(rows(packet)) * self.row + packet.area().round() as u64 * self.pixel
    }
}

/// Rows of a packet's bounding box.
pub(crate) fn rows(packet: &Triangle) -> u32 {
    packet.bounds.bottom - packet.bounds.top + 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_scenes::{ScreenVertex, Size, set_up};

    #[test]
    fn a_packet_costs_its_set_up_its_rows_and_its_area() {
        let at = |x, y| ScreenVertex { x, y, z: 1, rgb: [0; 3] };
        // Rows 3 to 7 of a screen, and 25/2 pixels, which round up.
        let packet = set_up(&[at(16, 48), at(96, 48), at(16, 128)], Size::new(20, 20).expect("in range"));
        let packet = packet.expect("covers pixels");
        assert_eq!(rows(&packet), 5);
        let costs = CostTable { geometry: 10_000, set_up: 1000, row: 100, pixel: 3, clear: 50_000 };
        assert_eq!(costs.estimate(&packet), 1000 + 5 * 100 + 13 * 3);
    }
}

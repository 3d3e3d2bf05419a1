//! The costs of a processing element's program, in clocks of the processor.
//!
//! Source: VC1-T1, Table 1 of the paper times 16 processors over 12482 polygons at 40 MHz: 631 clocks of geometry and 754 of
//! rasterization per polygon of ter1k. Geometry is transformation, lighting and region classification; clipping and areas are
//! rasterization (VC1-CLIP, VC1-APR).
//!
//! The split of these clocks is our choice. A cluster of 32 polygons of ter1k has 1.0745 vertices a polygon, which are transformed and lit once:
//! `1.0745*400 + 201 = 630.8`. We estimate set-up at 500 (facts E1), an area, which is a vector product, at 12, and clipping at 300. A
//! pixel takes 3, the fastest that the local frame buffer accepts (VC1-ACC). Our ter1k has, per polygon and averaged over the 48 views,
//! 0.9104 packets, 0.0173 packets across the border of the screen, 4.3235 rows and 16.062 pixels. With 54 clocks a row the sum is 754:
//! `12 + 0.0173*300 + 0.9104*500 + 4.3235*54 + 16.062*3 = 754.0`. Clearing an entry of the patch table takes 3 (VC1-CLR2 gives no
//! number).

use serde::Serialize;
use tilewright_scenes::Triangle;

use super::assignment::Polygon;

/// Clocks of the processing element for each step of its program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct CostTable {
    /// Transformation and lighting of a vertex, once in each of its clusters.
    pub vertex: u64,
    /// Classification of a polygon, drawn or not, and all other work once per polygon.
    pub polygon: u64,
    /// The area of a polygon, drawn or not, as the vector product of two edges.
    pub area: u64,
    /// Clipping of a packet that crosses the screen's border.
    pub clip: u64,
    /// Set-up of a packet.
    pub set_up: u64,
    /// Each row of a packet's bounding box: stepping of edges, search for the span.
    pub row: u64,
    /// Each covered pixel, including the clock of its request; at least 1.
    pub pixel: u64,
    /// Clearing of an entry of the patch table, including the clock of its write; at least 1.
    pub clear: u64,
    /// A word sent over the bus, including the clock of its write to the port; at least 1.
    pub send: u64,
    /// A received word, including the clock of its read from the queue; at least 1.
    pub receive: u64,
}

impl Default for CostTable {
    fn default() -> Self {
        CostTable {
            vertex: 400,
            polygon: 201,
            area: 12,
            clip: 300,
            set_up: 500,
            row: 54,
            pixel: 3,
            clear: 3,
            send: 2,
            receive: 2,
        }
    }
}

impl CostTable {
    /// The steps by name, each with the fewest possible clocks.
    pub const STEPS: [(&'static str, u64); 10] = [
        ("vertex", 0),
        ("polygon", 0),
        ("area", 0),
        ("clip", 0),
        ("set-up", 0),
        ("row", 0),
        ("pixel", 1),
        ("clear", 1),
        ("send", 1),
        ("receive", 1),
    ];

    /// The clocks of the step of that name, one of [`CostTable::STEPS`].
    ///
    /// ```
    /// use tilewright_machines::vc1::CostTable;
    ///
    /// let mut costs = CostTable::default();
    /// *costs.step("set-up").expect("is a step") = 0;
    /// assert_eq!(costs, CostTable { set_up: 0, ..CostTable::default() });
    /// assert_eq!(costs.step("geometry"), None);
    /// ```
    pub fn step(&mut self, name: &str) -> Option<&mut u64> {
        Some(match name {
            "vertex" => &mut self.vertex,
            "polygon" => &mut self.polygon,
            "area" => &mut self.area,
            "clip" => &mut self.clip,
            "set-up" => &mut self.set_up,
            "row" => &mut self.row,
            "pixel" => &mut self.pixel,
            "clear" => &mut self.clear,
            "send" => &mut self.send,
            "receive" => &mut self.receive,
            _ => return None,
        })
    }

    /// Geometry of a polygon.
    pub(crate) fn geometry(&self, polygon: &Polygon) -> u64 {
        self.polygon + u64::from(polygon.vertices) * self.vertex
    }

    /// Area and clipping of a polygon, before its packets.
    pub(crate) fn preparation(&self, polygon: &Polygon) -> u64 {
        self.area + u64::from(polygon.clipped) * self.clip
    }

    /// The expected cost of drawing a packet; its area gives the number of pixels (as in VC1-APR).
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

    const NONE: CostTable = CostTable {
        vertex: 0,
        polygon: 0,
        area: 0,
        clip: 0,
        set_up: 0,
        row: 0,
        pixel: 0,
        clear: 0,
        send: 0,
        receive: 0,
    };
    const HUGE: CostTable = {
        let it = 1_000_000;
        let costs = CostTable { vertex: it, polygon: it, area: it, clip: it, set_up: it, row: it, ..NONE };
        CostTable { pixel: it, clear: it, send: it, receive: it, ..costs }
    };

    #[test]
    fn every_step_has_a_name() {
        let mut costs = HUGE;
        for (clocks, (name, _)) in (1..).zip(CostTable::STEPS) {
            *costs.step(name).expect("is a step") = clocks;
        }
        let CostTable { vertex, polygon, area, clip, set_up, row, pixel, clear, send, receive } = costs;
        let all = [vertex, polygon, area, clip, set_up, row, pixel, clear, send, receive];
        assert_eq!(all, [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    }

    #[test]
    fn clipping_costs_three_hundred_clocks() {
        assert_eq!(CostTable::default().clip, 300);
    }

    #[test]
    fn a_packet_costs_its_set_up_its_rows_and_its_area() {
        let at = |x, y| ScreenVertex { x, y, z: 1, rgb: [0; 3] };
        // Rows 3 to 7 of a screen, and 25/2 pixels, which round up.
        let packet = set_up(&[at(16, 48), at(96, 48), at(16, 128)], Size::new(20, 20).expect("in range"));
        let packet = packet.expect("covers pixels");
        assert_eq!(rows(&packet), 5);
        let costs = CostTable { set_up: 1000, row: 100, pixel: 3, ..HUGE };
        assert_eq!(costs.estimate(&packet), 1000 + 5 * 100 + 13 * 3);
    }
}

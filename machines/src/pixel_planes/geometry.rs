//! The clocks of the geometry processors, which work before renderers can draw.
//!
//! ```text
//! polygons, dealt one by one --> processor 0: transform, set up, bin --> instructions of each region
//!                            '-> processor 1: ..
//! ```
//!
//! Source: section I.3.2.1 has renderers "operating on separate streams of polygon input data", and does not mention the source of these. So the
//! number of processors and the last two costs are choices. A processor is an i860 at 40 MHz, as in a VC-1 (VC1-PE). It has the VC-1's clocks
//! for geometry per polygon (VC1-T1) and for set-up (facts E1), and the clock of the renderers.

use serde::Serialize;
use tilewright_scenes::Polygons;

use super::bin::{Primitive, Work};

/// Clocks of a geometry processor for each step of its program.
///
/// ```
/// use tilewright_machines::pixel_planes::GeometryCosts;
/// use tilewright_machines::vc1;
///
/// let (here, there) = (GeometryCosts::default(), vc1::CostTable::default());
/// // Clusters of 32 polygons of ter1k have 1.075 vertices a polygon.
/// assert_eq!(here.transform as f64, (1.075 * there.vertex as f64).round() + there.polygon as f64);
/// assert_eq!(here.set_up, there.set_up);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct GeometryCosts {
    /// Transformation, lighting and clipping of a polygon, drawn or not. A sphere counts as a polygon, which is a choice.
    pub transform: u64,
    /// Set-up of a primitive that remains of it.
    pub set_up: u64,
    /// Each region of a primitive: the region and the end of its bin are found.
    pub bin: u64,
    /// Each instruction there: two products and two sums move an expression to the region's corner, five words of 32 bits are stored, and
    /// three clocks advance the loop.
    pub instruction: u64,
}

impl Default for GeometryCosts {
    fn default() -> GeometryCosts {
        GeometryCosts { transform: 631, set_up: 500, bin: 30, instruction: 12 }
    }
}

/// The clocks of the geometry of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct GeometryReport {
    /// Transformation, lighting and clipping, of all processors together.
    pub transform: u64,
    /// Set-up, of all together.
    pub set_up: u64,
    /// Regions and their instructions, of all together.
    pub binning: u64,
    /// Clocks of the busiest processor; then all instructions are made.
    pub clocks: u64,
}

impl GeometryReport {
    /// The clocks of a scene whose regions need those works, on at least one processor. Polygon i and its primitives belong to processor i modulo
    /// the number of processors.
    pub(super) fn new(processors: u32, costs: &GeometryCosts, polygons: &Polygons, works: &[Work]) -> GeometryReport {
        let mut clocks = vec![0; processors as usize];
        let mut report = GeometryReport::default();
        let mut take = |polygon: u32, of: &mut u64, cost: u64| {
            clocks[(polygon % processors) as usize] += cost;
            *of += cost;
        };
        (0..polygons.counts.polygons).for_each(|polygon| take(polygon, &mut report.transform, costs.transform));
        let polygon_of = |primitive: u32| Primitive::of(polygons, primitive).polygon();
        let primitives = 0..(polygons.polygons.len() + polygons.spheres.len()) as u32;
        primitives.for_each(|primitive| take(polygon_of(primitive), &mut report.set_up, costs.set_up));
        for (primitive, instructions) in works.iter().flat_map(|work| &work.made) {
            let cost = costs.bin + u64::from(*instructions) * costs.instruction;
            take(polygon_of(*primitive), &mut report.binning, cost);
        }
        GeometryReport { clocks: clocks.into_iter().max().unwrap_or(0), ..report }
    }

    /// Clocks of all processors together.
    pub fn total(&self) -> u64 {
        self.transform + self.set_up + self.binning
    }
}

#[cfg(test)]
mod tests {
    use tilewright_scenes::{Counts, Polygon, ScreenVertex, Size, set_up_polygon};

    use super::super::config::Config;
    use super::super::machine::Machine;
    use super::*;

    /// Polygons 0, 1 and 2, of which 1 has no primitive, and 2 is in two regions of 16 pixels.
    fn three() -> Polygons {
        let size = Size::new(32, 16).expect("in range");
        let at = |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 1, rgb: [9; 3] };
        let vertices = [vec![at(1, 1), at(9, 1), at(1, 9)], vec![at(10, 2), at(25, 2), at(10, 13)]];
        let polygons = vertices.iter().zip([0, 2]).map(|(corners, polygon)| {
            let packet = set_up_polygon(corners, size).pop().expect("it has pixels");
            Polygon { polygon, ..packet }
        });
        let counts = Counts { polygons: 3, drawn: 2, ..Counts::default() };
        Polygons { size, polygons: polygons.collect(), vertices: vertices.to_vec(), spheres: Vec::new(), counts }
    }

    #[test]
    fn every_clock_of_the_cost_table_is_charged_once_to_whose_polygon_it_is() {
        let polygons = three();
        let machine = Machine::new(Config { side: 16, ..Config::new(polygons.size) }).expect("there is one");
        let works = machine.works(&machine.config.regions().expect("some"), &polygons, [0; 3]).expect("it fits");
        let costs = GeometryCosts { transform: 100_000, set_up: 10_000, bin: 1000, instruction: 1 };
        let instructions: u64 = works.iter().flat_map(|work| &work.made).map(|(_, count)| u64::from(*count)).sum();
        let beside: u64 = works.iter().map(|work| work.instructions.len() as u64).sum();
        // Each region has two that clear it and one that saves it.
        assert_eq!((works.len(), instructions), (2, beside - 6));

        let one = GeometryReport::new(1, &costs, &polygons, &works);
        let binning = 3 * 1000 + instructions;
        assert_eq!(one, GeometryReport { transform: 300_000, set_up: 20_000, binning, clocks: 320_000 + binning });
        assert_eq!(one.total(), one.clocks);
        // 0 and 2 are the first one's; with three, each has its own.
        let two = GeometryReport::new(2, &costs, &polygons, &works);
        assert_eq!(two, GeometryReport { clocks: 220_000 + binning, ..one });
        let three = GeometryReport::new(3, &costs, &polygons, &works);
        let of_last = works.iter().flat_map(|work| &work.made).filter(|(primitive, _)| *primitive == 1);
        let of_last: u64 = of_last.map(|(_, count)| 1000 + u64::from(*count)).sum();
        assert_eq!(three, GeometryReport { clocks: 110_000 + of_last, ..one });
    }
}

//! What a renderer gets to draw a region: the geometry processor's last step.
//!
//! Source: PP5-ARCH, facts E0. A packet's functions are of the screen's pixels; a renderer's coefficients are relative to the region, so those
//! of its upper left pixel stand in place of those of the screen's.

use tilewright_rtl::pixel_planes::instruction::Instruction;
use tilewright_rtl::pixel_planes::programs::{Expression, Surface, clear, save, smooth_least, smooth_strict};
use tilewright_scenes::{Edge, Plane, Polygon, Polygons};

/// A region, and which fragments its pixels keep.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bin {
    /// The number of the region.
    pub region: usize,
    /// Its upper left pixel.
    pub place: (u32, u32),
    /// Pixels along its side.
    pub side: u32,
    /// Of equal depths the first drawn stays.
    pub strict: bool,
}

impl Bin {
    /// What empties the region.
    pub fn begin(&self, [red, green, blue]: [u8; 3]) -> Vec<Instruction<u64>> {
        clear(u32::from_be_bytes([0, red, green, blue]))
    }

    /// What draws a polygon in it: nothing if an edge leaves nothing of it there.
    pub fn draw(&self, polygon: &Polygon) -> Vec<Instruction<u64>> {
        let edges: Vec<Expression> = polygon.edges.iter().map(|edge| self.edge(edge)).collect();
        let surface = Surface { z: self.plane(&polygon.z), rgb: polygon.rgb.each_ref().map(|plane| self.plane(plane)) };
        match self.strict {
            true => smooth_strict(self.side, &edges, &surface),
            false => smooth_least(self.side, &edges, &surface),
        }
    }

    /// What sends the region, when the one before is sent.
    pub fn end(&self) -> Vec<Instruction<u64>> {
        save(self.region as u32)
    }

    fn edge(&self, edge: &Edge) -> Expression {
        let [a, b, c] = [edge.a, edge.b, edge.c].map(i64::from);
        self.relative(a, b, c)
    }

    fn plane(&self, plane: &Plane) -> Expression {
        // All is modulo 2^40 or 2^24, so the products may wrap.
        self.relative(plane.x as i64, plane.y as i64, plane.origin as i64)
    }

    fn relative(&self, a: i64, b: i64, c: i64) -> Expression {
        let (x, y) = (i64::from(self.place.0), i64::from(self.place.1));
        Expression { a, b, c: c.wrapping_add(a.wrapping_mul(x)).wrapping_add(b.wrapping_mul(y)) }
    }
}

/// All that a region needs.
pub(super) struct Work {
    /// Its number.
    pub region: usize,
    /// Primitives in the bin, and those of them that have instructions.
    pub primitives: [u64; 2],
    /// What draws them, clears and sends.
    pub instructions: Vec<Instruction<u64>>,
}

impl Work {
    /// Of the primitives of those numbers.
    pub fn new(bin: &Bin, numbers: &[u32], polygons: &Polygons, background: [u8; 3]) -> Work {
        let (mut instructions, mut drawn) = (bin.begin(background), 0);
        for number in numbers {
            let polygon = bin.draw(&polygons.polygons[*number as usize]);
            drawn += u64::from(!polygon.is_empty());
            instructions.extend(polygon);
        }
        instructions.extend(bin.end());
        Work { region: bin.region, primitives: [numbers.len() as u64, drawn], instructions }
    }
}

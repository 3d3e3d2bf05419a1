//! The instructions that a renderer gets for a region: the geometry processor's last step.
//!
//! Source: PP5-ARCH, facts E0. A packet's functions are relative to the screen, and a renderer's coefficients are relative to the region. So
//! the constant term is the value at the region's upper left pixel.

use tilewright_rtl::pixel_planes::instruction::Instruction;
use tilewright_rtl::pixel_planes::programs::{
    Expression, FLAT_LEAST, FLAT_STRICT, Program, Quadratic, SMOOTH_LEAST, SMOOTH_STRICT, Surface, clear, save,
};
use tilewright_scenes::packet::{COLOUR_PLANE_BITS, FRACTION_BITS};
use tilewright_scenes::sphere::{self, SpherePacket};
use tilewright_scenes::{Edge, PixelBox, Plane, Polygon, Polygons};

use super::clocks::{Clocked, SPHERE_LEAST, SPHERE_STRICT, Tally};
use super::config::Config;
use super::outline::Binner;
use super::regions::Regions;

/// The bins of all regions: the numbers of their primitives in the sequence of submission. Spheres are binned by their boxes, and numbered after the polygons.
pub(super) fn bins(regions: &Regions, polygons: &Polygons) -> Vec<Vec<u32>> {
    let mut bins = regions.bins(&polygons.vertices, Binner::Tight);
    for (number, sphere) in (polygons.polygons.len() as u32..).zip(&polygons.spheres) {
        regions.of_box(&sphere.bounds).for_each(|region| bins[region].push(number));
    }
    bins
}

/// A primitive with a number in [`bins`].
pub(super) enum Primitive<'a> {
    Polygon(&'a Polygon),
    Sphere(&'a SpherePacket),
}

impl<'a> Primitive<'a> {
    /// The primitive of that number.
    pub fn of(polygons: &'a Polygons, number: u32) -> Primitive<'a> {
        let number = number as usize;
        let sphere = || Primitive::Sphere(&polygons.spheres[number - polygons.polygons.len()]);
        polygons.polygons.get(number).map_or_else(sphere, Primitive::Polygon)
    }

    /// The number of its polygon in the scene.
    pub fn polygon(&self) -> u32 {
        match self {
            Primitive::Polygon(polygon) => polygon.polygon,
            Primitive::Sphere(sphere) => sphere.polygon,
        }
    }
}

/// A region, and the machine whose renderer draws it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bin<'a> {
    /// The number of the region.
    region: usize,
    /// Its pixels on the screen.
    pixels: PixelBox,
    config: &'a Config,
}

impl<'a> Bin<'a> {
    /// The bin of region number `region`.
    pub fn new(region: usize, regions: &Regions, config: &'a Config) -> Bin<'a> {
        Bin { region, pixels: regions.pixels(region), config }
    }

    /// The instructions that clear the region.
    fn begin(&self, [red, green, blue]: [u8; 3]) -> Vec<Instruction<u64>> {
        clear(u32::from_be_bytes([0, red, green, blue]))
    }

    /// The program for a polygon: that for one colour if it has only one in the region.
    fn program(&self, polygon: &Polygon) -> &'static Program {
        match (self.config.strict, self.only_colour(polygon).is_some()) {
            (true, true) => &FLAT_STRICT,
            (true, false) => &SMOOTH_STRICT,
            (false, true) => &FLAT_LEAST,
            (false, false) => &SMOOTH_LEAST,
        }
    }

    /// The instructions of a program for a polygon; none if an edge excludes the whole region.
    pub fn draw(&self, program: &Program, polygon: &Polygon) -> Vec<Instruction<u64>> {
        let edges: Vec<Expression> = polygon.edges.iter().map(|edge| self.edge(edge)).collect();
        let z = self.plane(&polygon.z);
        let surface = match self.only_colour(polygon) {
            Some(rgb) => Surface::of_one_colour(z, rgb),
            None => Surface { z, rgb: polygon.rgb.each_ref().map(|plane| self.plane(plane)) },
        };
        program.draw(self.config.side, self.config.edges, &edges, &surface)
    }

    /// The instructions for a sphere, and their name; none if it has no pixel in the region.
    fn draw_sphere(&self, sphere: &SpherePacket) -> (&'static str, Vec<Instruction<u64>>) {
        let (name, program) =
            if self.config.strict { (SPHERE_STRICT, &SMOOTH_STRICT) } else { (SPHERE_LEAST, &SMOOTH_LEAST) };
        let corner = [self.pixels.left, self.pixels.top].map(i64::from);
        let here =
            |&sphere::Quadratic { d, e, f, a, b, c }: &sphere::Quadratic| Quadratic { a, b, c, d, e, f }.moved(corner);
        let surface = Surface { z: here(&sphere.z), rgb: sphere.rgb.each_ref().map(here) };
        (name, program.draw_sphere(self.config.side, &here(&sphere.inside), &surface))
    }

    /// The instructions for a primitive, with the name of the program.
    fn primitive(&self, primitive: &Primitive) -> (&'static str, Vec<Instruction<u64>>) {
        match primitive {
            Primitive::Polygon(polygon) => {
                let program = self.program(polygon);
                (program.name, self.draw(program, polygon))
            }
            Primitive::Sphere(sphere) => self.draw_sphere(sphere),
        }
    }

    /// The instructions that send the region, after the one before is sent.
    fn end(&self) -> Vec<Instruction<u64>> {
        save(self.region as u32)
    }

    /// The colour of a polygon, if all its possible pixels here have the same.
    fn only_colour(&self, polygon: &Polygon) -> Option<u32> {
        let (bounds, pixels) = (polygon.bounds, self.pixels);
        let places = PixelBox {
            left: bounds.left.max(pixels.left),
            top: bounds.top.max(pixels.top),
            right: bounds.right.min(pixels.right),
            bottom: bounds.bottom.min(pixels.bottom),
        };
        let [r, g, b] = polygon.rgb.each_ref().map(|plane| only_channel(plane, &places));
        Some(u32::from_be_bytes([0, r?, g?, b?]))
    }

    fn edge(&self, edge: &Edge) -> Expression {
        let [a, b, c] = [edge.a, edge.b, edge.c].map(i64::from);
        self.relative(a, b, c)
    }

    fn plane(&self, plane: &Plane) -> Expression {
        // Values are modulo 2^40 or 2^24, so the products may wrap.
        self.relative(plane.x as i64, plane.y as i64, plane.origin as i64)
    }

    fn relative(&self, a: i64, b: i64, c: i64) -> Expression {
        let (x, y) = (i64::from(self.pixels.left), i64::from(self.pixels.top));
        Expression { a, b, c: c.wrapping_add(a.wrapping_mul(x)).wrapping_add(b.wrapping_mul(y)) }
    }
}

/// The channel of a plane of colour, if it is equal at all those pixels.
fn only_channel(plane: &Plane, pixels: &PixelBox) -> Option<u8> {
    // Any congruent numbers modulo 2^24 will do; these are nearest to 0.
    const ABOVE: u32 = u64::BITS - COLOUR_PLANE_BITS;
    let [x, y, origin] = [plane.x, plane.y, plane.origin].map(|number| (number << ABOVE) as i64 >> ABOVE);
    let first = origin + x * i64::from(pixels.left) + y * i64::from(pixels.top);
    let across = [
        x * i64::from(pixels.right.saturating_sub(pixels.left)),
        y * i64::from(pixels.bottom.saturating_sub(pixels.top)),
    ];
    let least = first + across.iter().map(|step| step.min(&0)).sum::<i64>();
    let greatest = first + across.iter().map(|step| step.max(&0)).sum::<i64>();
    (least >> FRACTION_BITS == greatest >> FRACTION_BITS).then_some((least >> FRACTION_BITS) as u8)
}

/// All instructions of a region.
pub(super) struct Work {
    /// Its number.
    pub region: usize,
    /// Primitives in the bin, and the number of those with instructions.
    pub primitives: [u64; 2],
    /// The instructions that clear the region, draw the primitives and send it.
    pub instructions: Vec<Instruction<u64>>,
    /// The clocks of primitives.
    pub programs: Tally,
    /// The number of each primitive in the bin, with the number of its instructions here.
    pub made: Vec<(u32, u32)>,
}

impl Work {
    /// The work for the primitives of those numbers.
    pub fn new(bin: &Bin, numbers: &[u32], polygons: &Polygons, background: [u8; 3]) -> Work {
        let drawn = numbers.iter().map(|&number| {
            let (program, instructions) = bin.primitive(&Primitive::of(polygons, number));
            (number, program, instructions)
        });
        Work::of(bin, drawn, background)
    }

    /// The work for primitives, each with its number, its program's name and its instructions.
    pub fn of(
        bin: &Bin,
        primitives: impl Iterator<Item = (u32, &'static str, Vec<Instruction<u64>>)>,
        background: [u8; 3],
    ) -> Work {
        let mut clocked = Clocked::new(bin.config.side_by_side);
        let mut instructions = bin.begin(background);
        clocked.region(&instructions);
        let (mut made, mut drawn) = (Vec::new(), 0);
        for (number, program, primitive) in primitives {
            clocked.primitive(program, &primitive);
            made.push((number, primitive.len() as u32));
            drawn += u64::from(!primitive.is_empty());
            instructions.extend(primitive);
        }
        instructions.extend(bin.end());
        let primitives = [made.len() as u64, drawn];
        Work { region: bin.region, primitives, instructions, programs: clocked.tally, made }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// The value modulo 2^24, as in the pixels.
        #[test]
        fn a_channel_is_the_only_one_where_all_pixels_have_it(
            slopes in prop::array::uniform2(prop_oneof![-2000..2000i64, -(1i64 << 23)..1 << 23, -40_000..40_000i64]),
            origin in prop_oneof![0..1i64 << 24, Just(0), Just((1 << 24) - 1)],
            (left, top) in (0..2000u32, 0..2000u32),
            (columns, rows) in (0..9u32, 0..9u32),
        ) {
            const MASK: i64 = (1 << COLOUR_PLANE_BITS) - 1;
            let [x, y] = slopes;
            let plane = Plane { x: (x & MASK) as u64, y: (y & MASK) as u64, origin: origin as u64 };
            let pixels = PixelBox { left, top, right: left + columns, bottom: top + rows };
            let value = |column: u32, row: u32| ((origin + x * i64::from(column) + y * i64::from(row)) & MASK) >> FRACTION_BITS;
            let mut all = (top..=top + rows).flat_map(|row| (left..=left + columns).map(move |column| (column, row)));
            let first = value(left, top);
            let is_only = all.all(|(column, row)| value(column, row) == first);
            let found = only_channel(&plane, &pixels);
            if let Some(channel) = found {
                prop_assert!(is_only && i64::from(channel) == first, "{:?}", found);
            } else {
                // A plane that goes through all channels may return to the first.
                let comes_back = x.abs() * i64::from(columns) + y.abs() * i64::from(rows) >= 255 << FRACTION_BITS;
                prop_assert!(!is_only || comes_back);
            }
        }
    }
}

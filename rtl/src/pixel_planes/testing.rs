//! Helpers for tests: primitives by the contract's formulas alone (facts E0), random instructions, and expressions bit
//! by bit.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::instruction::{Instruction, Operation};
use super::linear_tree::Coefficients;
use super::pixel::Source;
use super::programs::{Expression, Quadratic, Surface};
use crate::prelude::{Block, Bundle, Codes};

/// A polygon relative to a region.
#[derive(Debug, Clone)]
pub(super) struct Primitive {
    pub edges: Vec<Expression>,
    pub surface: Surface,
    /// The colour for programs in one colour.
    pub rgb: u32,
}

/// The value of an expression at a pixel.
pub(super) fn at(expression: &Expression, x: u32, y: u32) -> i64 {
    expression.a * i64::from(x) + expression.b * i64::from(y) + expression.c
}

impl Primitive {
    pub fn covers(&self, x: u32, y: u32) -> bool {
        self.edges.iter().all(|edge| at(edge, x, y) >= 0)
    }
}

/// The inside of a quadratic, relative to a region.
#[derive(Debug, Clone)]
pub(super) struct Sphere {
    pub inside: Quadratic,
    pub surface: Surface<Quadratic>,
    /// The colour for programs in one colour.
    pub rgb: u32,
}

/// Anything that can be drawn.
#[derive(Debug, Clone)]
pub(super) enum Shape {
    Polygon(Primitive),
    Sphere(Sphere),
}

/// The value of a quadratic at a pixel.
pub(super) fn value(&Quadratic { a, b, c, d, e, f }: &Quadratic, x: u32, y: u32) -> i128 {
    let [x, y] = [x, y].map(i128::from);
    let terms = [(a, x), (b, y), (c, 1), (d, x * x), (e, x * y), (f, y * y)];
    terms.iter().map(|(coefficient, times)| i128::from(*coefficient) * times).sum()
}

impl Shape {
    pub fn covers(&self, x: u32, y: u32) -> bool {
        match self {
            Shape::Polygon(polygon) => polygon.covers(x, y),
            Shape::Sphere(sphere) => value(&sphere.inside, x, y) >= 0,
        }
    }

    fn surface(&self) -> (Surface<Quadratic>, u32) {
        match self {
            Shape::Polygon(Primitive { surface: Surface { z, rgb: planes }, rgb, .. }) => {
                (Surface { z: (*z).into(), rgb: planes.map(Quadratic::from) }, *rgb)
            }
            Shape::Sphere(Sphere { surface, rgb, .. }) => (*surface, *rgb),
        }
    }

    fn depth(&self, x: u32, y: u32) -> u64 {
        (value(&self.surface().0.z, x, y) >> 16) as u64 & 0xff_ffff
    }

    /// The shape's word with colour planes.
    pub fn smooth_word(&self, x: u32, y: u32) -> u64 {
        let channel = |plane: Quadratic| (value(&plane, x, y) >> 16) as u64 & 0xff;
        let rgb = self.surface().0.rgb.map(channel).into_iter().reduce(|high, low| high << 8 | low);
        self.depth(x, y) << 24 | rgb.expect("three channels")
    }

    /// The shape's word in one colour.
    pub fn flat_word(&self, x: u32, y: u32) -> u64 {
        self.depth(x, y) << 24 | u64::from(self.surface().1)
    }
}

/// Spheres that cross a region with that side or miss it, and random quadratics whose values there fit 40 bits.
pub(super) fn spheres(side: u32) -> BoxedStrategy<Sphere> {
    let side = i64::from(side);
    let centre = prop::array::uniform2(-side / 2..side * 3 / 2);
    let ellipse = (centre, 0..side, 1..5000i64, -1000..1000i64).prop_map(|([x, y], radius, scale, across)| {
        let (d, e, f) = (-scale, across * scale / 1000, -scale);
        Quadratic { a: 0, b: 0, c: scale * radius * radius, d, e, f }.moved([-x, -y])
    });
    let least = -(1i64 << 39) / (6 * side * side);
    let any = prop::array::uniform6(prop_oneof![2 => least..-least, 1 => -9..10i64])
        .prop_map(move |[a, b, c, d, e, f]| Quadratic { a: a * side, b: b * side, c: c * side * side, d, e, f });
    let inside = prop_oneof![2 => ellipse, 1 => any];
    let rgb = prop_oneof![Just(0x10_20_30), 0..1u32 << 24];
    (inside, quadratic(), prop::array::uniform3(quadratic()), rgb)
        .prop_map(|(inside, z, planes, rgb)| Sphere { inside, surface: Surface { z, rgb: planes }, rgb })
        .boxed()
}

/// A plane that differs little from one sphere to the next, or an arbitrary one.
fn quadratic() -> BoxedStrategy<Quadratic> {
    let coarse = prop_oneof![Just(0), Just(1i64 << 16), Just(3i64 << 16)];
    let any = prop_oneof![1 => -(1i64 << 39)..1 << 39, 1 => Just(0)];
    prop_oneof![2 => prop::array::uniform6(coarse), 1 => prop::array::uniform6(any)]
        .prop_map(|[a, b, c, d, e, f]| Quadratic { a, b, c, d, e, f })
        .boxed()
}

/// The reduced edge between two points, in 1/16 pixel, with y downward. The inside is to the right of the direction
/// from the first to the second (DES-EDGE).
fn edge([x0, y0]: [i64; 2], [x1, y1]: [i64; 2]) -> Expression {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let (a, b) = (-dy, dx);
    let counts = dy < 0 || dy == 0 && dx > 0;
    let c = -(a * x0 + b * y0);
    Coefficients { a, b, c: (8 * (a + b) + c - i64::from(!counts)).div_euclid(16) }
}

/// Triangles that cross a region with that side, or miss it; some of their vertices are at the ends of the guard band.
pub(super) fn primitives(side: u32) -> impl Strategy<Value = Primitive> {
    let near = 16 * i64::from(side);
    let place = move || prop_oneof![6 => -near / 2..near * 3 / 2, 1 => Just(-32_768), 1 => Just(32_767i64)];
    let vertices = prop::array::uniform3(prop::array::uniform2(place()));
    // A region anywhere on the largest screen.
    let region = prop::array::uniform2(0..2048 / i64::from(side));
    (vertices, surface(), region, prop::bool::weighted(0.1)).prop_map(move |(vertices, (surface, rgb), region, far)| {
        // The same vertices on the screen, limited by the guard band.
        let on_screen = |[x, y]: [i64; 2]| {
            let [left, top] = region.map(|number| number * near);
            [left + x, top + y].map(|place| place.clamp(-32_768, 32_767))
        };
        let mut vertices = vertices.map(on_screen);
        if far {
            vertices[0] = [-32_768, 32_767];
        }
        let [[x0, y0], [x1, y1], [x2, y2]] = vertices;
        if (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0) < 0 {
            vertices.swap(1, 2);
        }
        Primitive { edges: edges(&vertices, region.map(|number| number * i64::from(side))), surface, rgb }
    })
}

/// Polygons of three to eight edges around a place in a region with that side, or near it.
pub(super) fn polygons(side: u32) -> impl Strategy<Value = Primitive> {
    let near = 16.0 * f64::from(side);
    let centre = prop::array::uniform2(-0.2..1.2);
    let radii = prop::array::uniform2(0.02..1.0);
    let turns = prop::collection::vec(0.0..std::f64::consts::TAU, 3..=8);
    (centre, radii, turns, surface()).prop_map(move |(centre, radii, mut turns, (surface, rgb))| {
        turns.sort_by(f64::total_cmp);
        let vertex = |turn: &f64| {
            let [x, y] = [turn.cos() * radii[0] + centre[0], turn.sin() * radii[1] + centre[1]];
            [x, y].map(|place: f64| (near * place).round() as i64)
        };
        let vertices: Vec<[i64; 2]> = turns.iter().map(vertex).collect();
        Primitive { edges: edges(&vertices, [0, 0]), surface, rgb }
    })
}

/// The edges between vertices, relative to the region with this upper left pixel.
fn edges(vertices: &[[i64; 2]], [left, top]: [i64; 2]) -> Vec<Expression> {
    let next = vertices.iter().cycle().skip(1);
    let edges = vertices.iter().zip(next).map(|(&from, &to)| edge(from, to));
    edges.map(|Coefficients { a, b, c }| Coefficients { a, b, c: c + a * left + b * top }).collect()
}

/// Planes that differ little between primitives, so that words collide, or arbitrary ones; and a colour.
fn surface() -> impl Strategy<Value = (Surface, u32)> {
    let plane = || {
        let near = (-70_000..70_000i64, -70_000..70_000i64, 0..1i64 << 20).prop_map(|(a, b, c)| [a, b, c]);
        let coarse = prop::array::uniform3(prop_oneof![Just(0), Just(1i64 << 16), Just(3i64 << 16)]);
        let any = prop::array::uniform3(0..1i64 << 40);
        prop_oneof![3 => coarse, 2 => near, 1 => any].prop_map(|[a, b, c]| Coefficients { a, b, c })
    };
    let rgb = prop_oneof![Just(0x10_20_30), 0..1u32 << 24];
    (plane(), prop::array::uniform3(plane()), rgb)
        .prop_map(|(z, rgb_planes, rgb)| (Surface { z, rgb: rgb_planes }, rgb))
}

/// Instructions for a renderer with that side. They use a small part of the memory, so that they access the same words.
/// They include curves if `quadratic` is true.
pub(super) fn instructions(side: u32, quadratic: bool) -> impl Strategy<Value = Instruction<u64>> {
    const LAST: usize = Operation::Save as usize;
    let curves = if quadratic { 6 } else { 0 };
    let levels = u64::from(side.trailing_zeros());
    let length = prop_oneof![4 => 1..12u64, 1 => 1..65u64];
    let address = || prop_oneof![1..24u64, Just(100)];
    let coefficient = || prop_oneof![0..1u64 << 40, 0..64u64, (0..64u64).prop_map(|number| (1 << 40) - 1 - number)];
    let coefficients = prop::array::uniform3(coefficient());
    (0..LAST + curves, 0..20u64, length, address(), address(), coefficients).prop_map(
        move |(operation, skip, length, read, write, [a, b, c])| {
            let operation = if operation < LAST { Operation::ALL[operation] } else { Operation::Curve };
            let on_expression = operation.microcode().source == Source::Expression.code();
            let is_alone =
                matches!(operation, Operation::Enable | Operation::Disable | Operation::Flag | Operation::Curve);
            let length = if is_alone { 1 } else { length };
            let skip = if on_expression { skip.max(levels.saturating_sub(length)) } else { 0 };
            // Words that overlap are processed bit by bit, so a read may see what was just written.
            let write = if read.abs_diff(write) < length { read } else { write };
            let coefficients = Coefficients { a, b, c };
            Instruction { operation: operation.code(), skip, length, read, write, coefficients }
        },
    )
}

/// An expression sent to a tree, A to C or A to F, and how many of its bits are sent.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sent<const N: usize> {
    pub coefficients: [u64; N],
    pub bits: u32,
    /// Clocks after the expression in which filler is sent.
    pub pause: u32,
}

impl<const N: usize> Sent<N> {
    /// A bit of each coefficient, or the filler of a pause.
    fn inputs(&self, clock: u32) -> [u64; N] {
        self.coefficients.map(|number| if clock < self.bits { number >> clock & 1 } else { 1 })
    }

    /// A bit of A x + B y + C + D x^2 + E x y + F y^2.
    fn bit(&self, clock: u32, [x, y]: [u64; 2]) -> u64 {
        let terms = self.coefficients.iter().zip([x, y, 1, x * x, x * y, y * y]);
        let sum = terms.fold(0, |sum: u64, (number, times)| sum.wrapping_add(number.wrapping_mul(times)));
        sum >> clock & 1
    }
}

/// Sends expressions one after another to a tree for `side` x `side` pixels. Compares each pixel's bits, `latency`
/// clocks later, with the formula. `inputs` makes the tree's inputs from a bit of each coefficient and whether it is
/// the first.
pub(super) fn expect_sums<B: Block, const N: usize>(
    (tree, side, latency): (&B, u32, u32),
    inputs: impl Fn([u64; N], bool) -> <B::In as Bundle>::Of<u64>,
    all: &[Sent<N>],
) {
    let mut sim = Simulation::of(tree).unwrap().seeded(u64::from(side));
    let value = sim.port("value").unwrap();
    sim.reset();
    let clocks = all.iter().flat_map(|sent| (0..sent.bits + sent.pause).map(move |clock| (sent, clock)));
    let clocks: Vec<_> = clocks.collect();
    let (latency, side) = (latency as usize, u64::from(side));
    for time in 0..clocks.len() + latency {
        if let Some((sent, clock)) = clocks.get(time) {
            sim.drive(inputs(sent.inputs(*clock), *clock == 0));
        }
        let arrived = time.checked_sub(latency).map(|sent| clocks[sent]);
        if let Some((sent, clock)) = arrived.filter(|(sent, clock)| *clock < sent.bits) {
            let bit = |pixel| sent.bit(clock, [pixel % side, pixel / side]);
            let expected: Vec<u64> = (0..side * side).map(bit).collect();
            assert_eq!(sim.lanes(value), expected, "bit {clock} of {sent:?}");
        }
        sim.step();
    }
}

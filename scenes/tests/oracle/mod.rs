//! An oracle for coverage, depth and colour in exact fractions, independent of set-up and golden rasterizer.
//!
//! It uses only geometry: no reduced edges, no planes, no orientation swap, no modular numbers. The fill rule is stated
//! by its meaning. The sample point is the pixel's centre, moved right by an infinitesimal and down by a smaller one.
//! So it never lies on an edge, and triangles that share an edge share no sample.

use tilewright_scenes::ScreenVertex;

/// A fraction; the denominator is positive.
#[derive(Clone, Copy, Debug)]
pub struct Fraction {
    pub numerator: i128,
    pub denominator: i128,
}

impl Fraction {
    /// Whether the fraction differs from `value` by at most `parts`/64.
    pub fn is_within(self, value: i128, parts: i128) -> bool {
        64 * (value * self.denominator - self.numerator).abs() <= parts * self.denominator
    }
}

fn cross(p: (i128, i128), q: (i128, i128)) -> i128 {
    p.0 * q.1 - p.1 * q.0
}

fn from_to(p: &ScreenVertex, q: &ScreenVertex) -> (i128, i128) {
    ((q.x - p.x).into(), (q.y - p.y).into())
}

/// The side of the directed edge p -> q that the sample of pixel (x, y) is on: 1 or -1; 0 only if p = q.
fn side(p: &ScreenVertex, q: &ScreenVertex, x: u32, y: u32) -> i128 {
    let edge = from_to(p, q);
    let centre = (i128::from(16 * x + 8) - i128::from(p.x), i128::from(16 * y + 8) - i128::from(p.y));
    // The infinitesimals decide one after the other, each only if everything larger is zero.
    [cross(edge, centre), cross(edge, (1, 0)), cross(edge, (0, 1))]
        .into_iter()
        .find(|&c| c != 0)
        .map_or(0, i128::signum)
}

/// Whether the triangle covers the sample of pixel (x, y).
pub fn covers(v: &[ScreenVertex; 3], x: u32, y: u32) -> bool {
    let turn = cross(from_to(&v[0], &v[1]), from_to(&v[0], &v[2])).signum();
    turn != 0 && (0..3).all(|i| side(&v[i], &v[(i + 1) % 3], x, y) == turn)
}

/// The exact value, at the centre of pixel (x, y), of the plane through one value per vertex.
pub fn plane(v: &[ScreenVertex; 3], value: [i128; 3], x: u32, y: u32) -> Fraction {
    let centre = ScreenVertex { x: 16 * x as i32 + 8, y: 16 * y as i32 + 8, ..v[0] };
    // Barycentric: each value is weighted by the triangle that the centre makes with the other two vertices.
    let weight = |p: usize, q: usize| cross(from_to(&centre, &v[p]), from_to(&centre, &v[q]));
    let weights = [weight(1, 2), weight(2, 0), weight(0, 1)];
    let area: i128 = weights.iter().sum();
    let numerator: i128 = weights.iter().zip(value).map(|(w, v)| w * v).sum();
    Fraction { numerator: numerator * area.signum(), denominator: area.abs() }
}

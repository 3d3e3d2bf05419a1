//! Polygons and windows in plain numbers, by definition: the reference of the blocks, and the source of their scenarios
//! (MPG-WIN, MPG-SPR, facts E0).

use super::coverage_test::Test;
use super::format::{Bounds, EdgeFunction, Format, PLANES, Packet, Plane, Polygon, Window, Work};
use crate::prelude::*;

/// A convex polygon of the screen.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Convex {
    /// a, b and c of `a x + b y + c`, which is at least 0 inside.
    pub edges: Vec<[i64; 3]>,
    /// x, y and origin of each plane.
    pub planes: [[u64; 3]; PLANES as usize],
    /// The leftmost, uppermost, rightmost and lowest of the pixels that contain it.
    pub bounds: [u32; 4],
}

/// A square of 2^size x 2^size samples of a video processor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Square {
    pub size: u32,
    pub x: u32,
    pub y: u32,
}

impl Square {
    /// The quarters, in the sequence in which they are tested.
    pub(crate) fn quarters(self) -> [Square; 4] {
        let size = self.size - 1;
        [0, 1, 2, 3].map(|number| Square { size, x: self.x | (number & 1) << size, y: self.y | (number >> 1) << size })
    }
}

/// The samples of one video processor: every p-th pixel of every q-th line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Raster {
    pub format: Format,
    pub column: u32,
    pub row: u32,
}

impl Raster {
    /// The window of all samples.
    pub(crate) fn root(&self) -> Square {
        Square { size: self.format.levels(), x: 0, y: 0 }
    }

    /// The pixel of a sample.
    fn pixel(&self, x: u32, y: u32) -> [i64; 2] {
        let matrix = self.format.matrix();
        [self.column + matrix.columns() * x, self.row + matrix.rows() * y].map(i64::from)
    }

    /// The greatest value of an edge function in a window, with the aperture around it.
    pub(super) fn greatest(&self, [a, b, c]: [i64; 3], window: Square) -> i64 {
        let [left, top, right, bottom] = self.extent(window);
        let corners = [(left, top), (right, top), (left, bottom), (right, bottom)];
        corners.into_iter().map(|(x, y)| a * x + b * y + c).max().expect("four")
    }

    /// The leftmost, uppermost, rightmost and lowest pixel of a window with its aperture.
    fn extent(&self, Square { size, x, y }: Square) -> [i64; 4] {
        let (half, last) = (i64::from(self.format.aperture() / 2), (1 << size) - 1);
        let ([left, top], [right, bottom]) = (self.pixel(x, y), self.pixel(x + last, y + last));
        [left - half, top - half, right + half, bottom + half]
    }

    /// How far a window extends inward past each bound of a polygon.
    pub(super) fn reach(&self, polygon: &Convex, window: Square) -> [i64; 4] {
        let [left, top, right, bottom] = self.extent(window);
        let [first_x, first_y, last_x, last_y] = polygon.bounds.map(i64::from);
        [right - first_x, bottom - first_y, last_x - left, last_y - top]
    }

    /// Whether a polygon may cover a window: equation 5's coverage test.
    pub(crate) fn may_cover(&self, polygon: &Convex, window: Square) -> bool {
        let edges = polygon.edges.iter().map(|edge| self.greatest(*edge, window));
        edges.chain(self.reach(polygon, window)).all(|value| value >= 0)
    }

    /// The parts of a window that have this size. At each division, quarters that the polygon cannot cover are dropped.
    pub(crate) fn divided(&self, polygon: &Convex, window: Square, size: u32) -> Vec<Square> {
        if window.size == size {
            return vec![window];
        }
        let covered = window.quarters().into_iter().filter(|quarter| self.may_cover(polygon, *quarter));
        covered.flat_map(|quarter| self.divided(polygon, quarter, size)).collect()
    }

    /// For each level from the first, the numbers of windows that are divided, and of their quarters that pass.
    pub(crate) fn counts(&self, polygon: &Convex) -> Vec<[u64; 2]> {
        let mut windows = vec![self.root()];
        let levels = (0..self.format.levels()).rev().map(|size| {
            let left: Vec<_> = windows.iter().flat_map(|window| self.divided(polygon, *window, size)).collect();
            let divided = std::mem::replace(&mut windows, left).len();
            [divided, windows.len()].map(|count| count as u64)
        });
        levels.collect()
    }

    /// The clocks that one unit takes for all windows of a polygon (MPG-EQ5, MPG-EQ6).
    pub(crate) fn clocks(&self, polygon: &Convex, test: Test) -> u64 {
        let edges = if test == Test::Serial { polygon.edges.len() as u64 } else { 1 };
        self.counts(polygon).iter().map(|[divided, left]| 4 * edges * divided + u64::from(PLANES) * left).sum()
    }

    /// A window with its polygon, as the blocks exchange it.
    pub(crate) fn work(&self, polygon: &Convex, window: Square) -> Work<Bits> {
        let (format, widths) = (self.format, Work::widths(self.format));
        let matrix = format.matrix();
        let edge = |width: Width, value: &dyn Fn([i64; 3]) -> i64| {
            let values = polygon.edges.iter().map(|edge| value(*edge));
            lanes(width, values.chain(std::iter::repeat(0)))
        };
        let [x, y] = self.pixel(window.x, window.y).map(|at| at as u64);
        let plane = |value: &dyn Fn([u64; 3]) -> u64| {
            lanes(
                widths.window.planes,
                polygon.planes.iter().map(|plane| (value(*plane) & ((1 << format.precision().plane) - 1)) as i64),
            )
        };
        let (p, q) = (matrix.columns(), matrix.rows());
        Work {
            polygon: Polygon {
                last_edge: Bits::new(widths.polygon.last_edge.bits(), polygon.edges.len() as u64 - 1),
                step_x: edge(widths.polygon.step_x, &|[a, ..]| a.abs() * i64::from(p)),
                step_y: edge(widths.polygon.step_y, &|[_, b, _]| b.abs() * i64::from(q)),
                right: edge(widths.polygon.right, &|[a, ..]| (a >= 0).into()),
                lower: edge(widths.polygon.lower, &|[_, b, _]| (b >= 0).into()),
                plane_x: plane(&|[x, ..]| x.wrapping_mul(p.into())),
                plane_y: plane(&|[_, y, _]| y.wrapping_mul(q.into())),
            },
            window: Window {
                size: Bits::new(widths.window.size.bits(), window.size.into()),
                x: Bits::new(format.levels(), window.x.into()),
                y: Bits::new(format.levels(), window.y.into()),
                edges: edge(widths.window.edges, &|function| self.greatest(function, window)),
                bounds: bounds(
                    self.reach(polygon, window).map(|reach| Bits::from_i128(format.distance_bits(), reach.into())),
                ),
                planes: plane(&|[dx, dy, origin]| {
                    origin.wrapping_add(dx.wrapping_mul(x)).wrapping_add(dy.wrapping_mul(y))
                }),
            },
        }
    }

    /// The input of a set-up or video processor that gives the position of its samples.
    pub(crate) fn place(&self) -> Bounds<Bits> {
        let width = self.format.distance_bits();
        self.format.place_of(self.column, self.row).map(|end| Bits::from_i128(width, i128::from(*end)))
    }
}

impl Convex {
    /// The packet of the geometry processor. Lanes beyond its last edge have an edge with everything outside: no block
    /// may use them.
    pub(crate) fn packet(&self, format: &Format) -> Packet<Bits> {
        let widths = Packet::widths(*format);
        let edge = |width: Width, number: usize| {
            lanes(width, self.edges.iter().map(|edge| edge[number]).chain(std::iter::repeat(-1)))
        };
        let plane = |width: Width, number: usize| lanes(width, self.planes.iter().map(|plane| plane[number] as i64));
        let Packet { last_edge, edges, planes, bounds } = widths;
        Packet {
            last_edge: Bits::new(last_edge.bits(), self.edges.len() as u64 - 1),
            edges: EdgeFunction { a: edge(edges.a, 0), b: edge(edges.b, 1), c: edge(edges.c, 2) },
            planes: Plane { x: plane(planes.x, 0), y: plane(planes.y, 1), origin: plane(planes.origin, 2) },
            bounds: self::bounds(self.bounds.map(|bound| Bits::new(bounds.left.bits(), bound.into()))),
        }
    }
}

fn bounds([left, top, right, bottom]: [Bits; 4]) -> Bounds<Bits> {
    Bounds { left, top, right, bottom }
}

/// Values side by side, the first in the lowest bits.
fn lanes(width: Width, values: impl Iterator<Item = i64>) -> Bits {
    let count = width.shape().lanes() as usize;
    let values = values.take(count).map(|value| Bits::from_i128(width.bits(), value.into()));
    Bits::join(&values.collect::<Vec<_>>())
}

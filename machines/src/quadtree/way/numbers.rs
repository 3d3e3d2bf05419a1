//! Windows of packets in plain numbers, by definition: what set-up and coverage tests should put out (MPG-WIN, facts E0).

use tilewright_scenes::{Edge, Polygon};

use super::Followed;

/// The window of the followed sample whose side is two to that power.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Square {
    pub size: u32,
    /// Its first sample.
    pub x: u32,
    pub y: u32,
}

impl Square {
    /// The name of the first field in which another one differs.
    pub fn differs_in(self, other: Square) -> Option<&'static str> {
        let pairs = [("size", self.size, other.size), ("x", self.x, other.x), ("y", self.y, other.y)];
        pairs.into_iter().find(|(_, own, other)| own != other).map(|(name, ..)| name)
    }
}

/// The fields of a window and its polygon, each with the lanes that it has. Values are modulo the widths of the hardware's.
pub(super) struct Fields {
    pub square: Square,
    pub edges: Vec<i64>,
    pub bounds: [i64; 4],
    pub planes: [u64; 4],
    pub steps: Vec<i64>,
}

impl Followed {
    /// The window of that size with the sample.
    pub fn square(&self, size: u32) -> Square {
        Square { size, x: self.x >> size << size, y: self.y >> size << size }
    }

    /// Whether a window has the sample.
    pub fn is_in(&self, Square { size, x, y }: Square) -> bool {
        self.x >> size == x >> size && self.y >> size == y >> size
    }

    /// The leftmost, uppermost, rightmost and lowest pixel of a window with its aperture.
    fn extent(&self, Square { size, x, y }: Square) -> [i64; 4] {
        let half = i64::from(self.format.aperture() / 2);
        let last = (1 << size) - 1;
        let pixel = |x: u32, y: u32| {
            let matrix = self.format.matrix();
            [self.column + matrix.columns() * x, self.row + matrix.rows() * y].map(i64::from)
        };
        let ([left, top], [right, bottom]) = (pixel(x, y), pixel(x + last, y + last));
        [left - half, top - half, right + half, bottom + half]
    }

    fn greatest(&self, edge: &Edge, square: Square) -> i64 {
        let [left, top, right, bottom] = self.extent(square);
        let (a, b) = (i64::from(edge.a), i64::from(edge.b));
        a * if a >= 0 { right } else { left } + b * if b >= 0 { bottom } else { top } + i64::from(edge.c)
    }

    fn reach(&self, packet: &Polygon, square: Square) -> [i64; 4] {
        let [left, top, right, bottom] = self.extent(square);
        let bounds = packet.bounds;
        let [first_x, first_y, last_x, last_y] = [bounds.left, bounds.top, bounds.right, bounds.bottom].map(i64::from);
        [right - first_x, bottom - first_y, last_x - left, last_y - top]
    }

    /// Whether a packet's bounds contain the pixel, so that its way is told.
    pub fn is_told(&self, packet: &Polygon) -> bool {
        let matrix = self.format.matrix();
        packet.bounds.contains(self.x * matrix.columns() + self.column, self.y * matrix.rows() + self.row)
    }

    /// Whether a packet may cover a window.
    pub fn may_cover(&self, packet: &Polygon, square: Square) -> bool {
        packet.edges.iter().all(|edge| self.greatest(edge, square) >= 0)
            && self.reach(packet, square).iter().all(|reach| *reach >= 0)
    }

    /// The fields of a window with its packet.
    pub fn fields(&self, packet: &Polygon, square: Square) -> Fields {
        let room = self.format.edges() as usize;
        let matrix = self.format.matrix();
        let (p, q) = (i64::from(matrix.columns()), i64::from(matrix.rows()));
        let edges = |of: &dyn Fn(&Edge) -> i64| -> Vec<i64> {
            packet.edges.iter().map(of).chain(std::iter::repeat(0)).take(room).collect()
        };
        let (column, line) = (self.column + matrix.columns() * square.x, self.row + matrix.rows() * square.y);
        let [red, green, blue] = &packet.rgb;
        let planes = [&packet.z, red, green, blue];
        let value = |plane: &tilewright_scenes::Plane| {
            let moved = plane.x.wrapping_mul(column.into()).wrapping_add(plane.y.wrapping_mul(line.into()));
            plane.origin.wrapping_add(moved)
        };
        let mut steps = vec![packet.edges.len() as i64 - 1];
        steps.extend(edges(&|edge| i64::from(edge.a).abs() * p));
        steps.extend(edges(&|edge| i64::from(edge.b).abs() * q));
        steps.extend(edges(&|edge| (edge.a >= 0).into()));
        steps.extend(edges(&|edge| (edge.b >= 0).into()));
        steps.extend(planes.map(|plane| plane.x.wrapping_mul(p as u64) as i64));
        steps.extend(planes.map(|plane| plane.y.wrapping_mul(q as u64) as i64));
        Fields {
            square,
            edges: edges(&|edge| self.greatest(edge, square)),
            bounds: self.reach(packet, square),
            planes: planes.map(value),
            steps,
        }
    }
}

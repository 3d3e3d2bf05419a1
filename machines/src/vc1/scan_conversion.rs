//! Scan conversion in the program of a processing element: a packet's pixels in raster order, by additions alone.
//!
//! Source: facts E0. Sums are exact (edges) or modulo a power of two (planes), so stepping from pixel to pixel gives exactly the words of direct
//! evaluation (DES-EDGE, DES-Z).

use tilewright_scenes::packet::{COLOUR_PLANE_BITS, DEPTH_PLANE_BITS, FRACTION_BITS};
use tilewright_scenes::{Edge, PixelBox, Plane, Triangle};

/// A covered pixel and its visibility word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pixel {
    pub x: u32,
    pub y: u32,
    /// `z << 24 | r << 16 | g << 8 | b`.
    pub word: u64,
}

/// All values that change from pixel to pixel. Planes wrap modulo 2^64, a multiple of their own moduli.
#[derive(Clone, Copy)]
struct Interpolants {
    edges: [i64; 3],
    z: u64,
    rgb: [u64; 3],
}

impl Interpolants {
    /// The values at pixel (0, 0).
    fn origin(packet: &Triangle) -> Interpolants {
        Interpolants {
            edges: packet.edges.map(|e| e.c.into()),
            z: packet.z.origin,
            rgb: packet.rgb.map(|plane| plane.origin),
        }
    }

    /// The change over `x` pixels to the right and `y` rows down.
    fn change(packet: &Triangle, x: u32, y: u32) -> Interpolants {
        let edge = |e: Edge| i64::from(e.a) * i64::from(x) + i64::from(e.b) * i64::from(y);
        let plane = |p: Plane| p.x.wrapping_mul(x.into()).wrapping_add(p.y.wrapping_mul(y.into()));
        Interpolants { edges: packet.edges.map(edge), z: plane(packet.z), rgb: packet.rgb.map(plane) }
    }

    fn step(&mut self, by: &Interpolants) {
        self.z = self.z.wrapping_add(by.z);
        for i in 0..3 {
            self.edges[i] += by.edges[i];
            self.rgb[i] = self.rgb[i].wrapping_add(by.rgb[i]);
        }
    }

    fn inside(&self) -> bool {
        self.edges.iter().all(|&e| e >= 0)
    }

    fn word(&self) -> u64 {
        let whole = |value: u64, bits: u32| (value & ((1 << bits) - 1)) >> FRACTION_BITS;
        self.rgb.iter().fold(whole(self.z, DEPTH_PLANE_BITS), |word, &c| word << 8 | whole(c, COLOUR_PLANE_BITS))
    }
}

/// The covered pixels of a packet, row by row from the upper left, in all rows of the screen or in every n-th row.
pub(crate) struct Pixels {
    bounds: PixelBox,
    rows: Rows,
    x: u32,
    y: u32,
    here: Interpolants,
    /// The left end of the row.
    left: Interpolants,
    right_step: Interpolants,
    down_step: Interpolants,
}

/// The rows `y` of the screen with `y mod every = first`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rows {
    pub first: u32,
    pub every: u32,
}

impl Rows {
    pub const ALL: Rows = Rows { first: 0, every: 1 };

    /// The first of these rows that is not above that row.
    pub fn from(self, y: u32) -> u32 {
        y + (self.first + self.every - y % self.every) % self.every
    }

    /// The number of these rows from one row to another, both included.
    pub fn count(self, top: u32, bottom: u32) -> u32 {
        let first = self.from(top);
        if first > bottom { 0 } else { (bottom - first) / self.every + 1 }
    }
}

impl Pixels {
    pub fn of(packet: &Triangle, rows: Rows) -> Pixels {
        let (x, y) = (packet.bounds.left, rows.from(packet.bounds.top));
        let mut left = Interpolants::origin(packet);
        left.step(&Interpolants::change(packet, x, y));
        let right_step = Interpolants::change(packet, 1, 0);
        let down_step = Interpolants::change(packet, 0, rows.every);
        Pixels { bounds: packet.bounds, rows, x, y, here: left, left, right_step, down_step }
    }

    fn next_row(&mut self) {
        self.y += self.rows.every;
        self.x = self.bounds.left;
        self.left.step(&self.down_step);
        self.here = self.left;
    }
}

impl Iterator for Pixels {
    type Item = Pixel;

    fn next(&mut self) -> Option<Pixel> {
        while self.y <= self.bounds.bottom {
            while self.x <= self.bounds.right {
                let found = self.here.inside().then(|| Pixel { x: self.x, y: self.y, word: self.here.word() });
                self.x += 1;
                self.here.step(&self.right_step);
                if found.is_some() {
                    return found;
                }
            }
            self.next_row();
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use tilewright_scenes::{ScreenVertex, Size, set_up};

    fn vertex() -> impl Strategy<Value = ScreenVertex> {
        let position = -2000..4000_i32;
        (position.clone(), position, 1..0xff_fffe_u32, any::<[u8; 3]>()).prop_map(|(x, y, z, rgb)| ScreenVertex {
            x,
            y,
            z,
            rgb,
        })
    }

    proptest! {
        #[test]
        fn increments_give_what_direct_evaluation_gives(
            vertices in [vertex(), vertex(), vertex()], (every, first) in (1..9_u32).prop_flat_map(|n| (Just(n), 0..n)),
        ) {
            let size = Size::new(120, 90).expect("in range");
            if let Some(packet) = set_up(&vertices, size) {
                let rows = (0..90).filter(|y| y % every == first);
                let covered = rows.flat_map(|y| (0..120).map(move |x| (x, y))).filter(|&(x, y)| packet.covers(x, y));
                let direct: Vec<Pixel> = covered.map(|(x, y)| Pixel { x, y, word: packet.word(x, y) }).collect();
                let rows = Rows { first, every };
                prop_assert_eq!(Pixels::of(&packet, rows).collect::<Vec<_>>(), direct);
                let touched = (packet.bounds.top..=packet.bounds.bottom).filter(|y| y % every == first).count();
                prop_assert_eq!(rows.count(packet.bounds.top, packet.bounds.bottom) as usize, touched);
            }
        }
    }
}

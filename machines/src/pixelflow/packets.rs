//! Packets for the programs of a node, relative to a region.

use tilewright_rtl::pixelflow::programs::{Appearance, Expression, Surface};
use tilewright_scenes::deferred::AppearancePacket;
use tilewright_scenes::{Edge, Packet, Plane};

/// A region's upper left pixel, the origin of a packet's expressions.
///
/// ```
/// use tilewright_machines::pixelflow::Corner;
/// use tilewright_scenes::{ScreenVertex, Size, set_up};
///
/// let corner = |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 500, rgb: [9; 3] };
/// let triangle = set_up(&[corner(128, 64), corner(140, 64), corner(128, 80)], Size::new(256, 128)?).expect("it has an area");
/// // The left edge: x is 0 or more in the region that begins there.
/// let edges = Corner::of([128, 64]).edges(&triangle);
/// assert!(edges.iter().any(|edge| edge.b == 0 && edge.a > 0 && (0..edge.a).contains(&edge.c)));
/// # Ok::<(), tilewright_scenes::SceneError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Corner {
    /// Its place in the picture, x and y.
    pub at: [u32; 2],
    /// The step in the picture's columns and lines from a pixel of the region to the next.
    pub step: [u32; 2],
}

impl Corner {
    /// The corner of a region with all pixels of the picture.
    pub fn of(at: [u32; 2]) -> Corner {
        Corner { at, step: [1, 1] }
    }

    /// Its edges.
    pub fn edges<E: AsRef<[Edge]>>(self, packet: &Packet<E>) -> Vec<Expression> {
        packet.edges.as_ref().iter().map(|edge| self.edge(edge)).collect()
    }

    /// Its depth and colour.
    pub fn surface<E>(self, packet: &Packet<E>) -> Surface {
        Surface { z: self.plane(&packet.z), rgb: packet.rgb.map(|plane| self.plane(&plane)) }
    }

    /// All parameters of a packet for a pixel.
    pub fn appearance(self, packet: &AppearancePacket) -> Appearance {
        Appearance {
            surface: self.surface(&packet.triangle),
            normal: packet.normal.map(|plane| self.plane(&plane)),
            uv: packet.uv.map(|plane| self.plane(&plane)),
            scale: self.plane(&packet.scale),
            material: packet.material,
            level: packet.level,
        }
    }

    fn edge(self, &Edge { a, b, c }: &Edge) -> Expression {
        let [a, b, c] = [a, b, c].map(i64::from);
        let ([x, y], [across, down]) = (self.at.map(i64::from), self.step.map(i64::from));
        Expression { a: a * across, b: b * down, c: c + a * x + b * y }
    }

    /// The plane modulo 2^64, of which only its own bits matter.
    fn plane(self, plane: &Plane) -> Expression {
        let ([x, y], [across, down]) = (self.at.map(u64::from), self.step.map(u64::from));
        let c = plane.origin.wrapping_add(plane.x.wrapping_mul(x)).wrapping_add(plane.y.wrapping_mul(y));
        let [a, b] = [plane.x.wrapping_mul(across), plane.y.wrapping_mul(down)];
        Expression { a: a as i64, b: b as i64, c: c as i64 }
    }
}

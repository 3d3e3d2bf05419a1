//! Packets as the programs of a node take them: relative to a region.

use tilewright_rtl::pixelflow::programs::{Appearance, Expression, Surface};
use tilewright_scenes::deferred::AppearancePacket;
use tilewright_scenes::{Edge, Packet, Plane};

/// A region's upper left pixel, x and y, from which a packet's expressions count.
///
/// ```
/// use tilewright_machines::pixelflow::Corner;
/// use tilewright_scenes::{ScreenVertex, Size, set_up};
///
/// let corner = |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 500, rgb: [9; 3] };
/// let triangle = set_up(&[corner(128, 64), corner(140, 64), corner(128, 80)], Size::new(256, 128)?).expect("it has an area");
/// // The left edge: x is 0 or more in the region that begins there.
/// let edges = Corner([128, 64]).edges(&triangle);
/// assert!(edges.iter().any(|edge| edge.b == 0 && edge.a > 0 && (0..edge.a).contains(&edge.c)));
/// # Ok::<(), tilewright_scenes::SceneError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Corner(pub [u32; 2]);

impl Corner {
    /// Its edges.
    pub fn edges<E: AsRef<[Edge]>>(self, packet: &Packet<E>) -> Vec<Expression> {
        packet.edges.as_ref().iter().map(|edge| self.edge(edge)).collect()
    }

    /// Its depth and colour.
    pub fn surface<E>(self, packet: &Packet<E>) -> Surface {
        Surface { z: self.plane(&packet.z), rgb: packet.rgb.map(|plane| self.plane(&plane)) }
    }

    /// All that a packet leaves in a pixel.
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
        let [x, y] = self.0.map(i64::from);
        Expression { a, b, c: c + a * x + b * y }
    }

    /// Modulo 2^64 here, of which the plane's own bits count.
    fn plane(self, plane: &Plane) -> Expression {
        let [x, y] = self.0.map(u64::from);
        let c = plane.origin.wrapping_add(plane.x.wrapping_mul(x)).wrapping_add(plane.y.wrapping_mul(y));
        Expression { a: plane.x as i64, b: plane.y as i64, c: c as i64 }
    }
}

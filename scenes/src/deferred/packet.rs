//! The packet of a triangle for deferred shading: every parameter is a plane, like depth and colour.

use super::appearance::Appearance;
use crate::packet::{PARAMETER_PLANE_BITS, Plane, ScreenVertex, Triangle};
use crate::setup::{Anchor, set_up, signed_area2};
use crate::size::Size;

/// A vertex on the screen, with all attributes of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AppearanceVertex {
    /// Position, depth and diffuse colour.
    pub at: ScreenVertex,
    /// The normal: right, down, forward of the eye, on the eye's side; -32767 to 32767 each.
    pub normal: [i16; 3],
    /// u/w and v/w, in the unit of `scale`.
    pub uv: [u16; 2],
    /// 1/w, in a unit of the triangle's own.
    pub scale: u16,
}

/// A triangle, ready for a rasterizer that writes appearance words.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct AppearancePacket {
    /// Edges, depth, and the diffuse colour instead of a lit one.
    pub triangle: Triangle,
    /// The normal: planes modulo 2^[`PARAMETER_PLANE_BITS`] each; bits 31..16 are the number in two's complement.
    pub normal: [Plane; 3],
    /// u/w and v/w: planes modulo 2^[`PARAMETER_PLANE_BITS`] each.
    pub uv: [Plane; 2],
    /// 1/w: a plane modulo 2^[`PARAMETER_PLANE_BITS`].
    pub scale: Plane,
    /// The index of the material, the same at all pixels.
    pub material: u8,
    /// The level of detail at scale 2^16, in 1/8, the same at all pixels.
    pub level: u8,
}

/// Sets a triangle up for a screen of `size` pixels; `None` if there is nothing to draw, as with [`set_up`].
///
/// Planes are anchored and rounded like that of depth (DES-Z). So a parameter at a covered centre is within half a unit
/// and 0.13 of the exact plane, and never beyond the vertices' own values.
///
/// ```
/// use tilewright_scenes::deferred::{AppearanceVertex, set_up_appearance};
/// use tilewright_scenes::{ScreenVertex, Size};
///
/// let vertex = |x: i32, y: i32, right: i16| AppearanceVertex {
///     at: ScreenVertex { x: 16 * x, y: 16 * y, z: 900, rgb: [200, 100, 0] },
///     normal: [right, 0, -32000],
///     uv: [0; 2],
///     scale: 0,
/// };
/// let corners = [vertex(0, 0, -3000), vertex(8, 0, 5000), vertex(0, 8, -3000)];
/// let packet = set_up_appearance(&corners, 2, 0, Size::new(8, 8).unwrap()).unwrap();
/// // The middle of a pixel is half a pixel further.
/// let found = packet.word(3, 1).parameters();
/// assert_eq!((found.z, found.normal, found.rgb, found.material), (900, [500, 0, -32000], [200, 100, 0], 2));
/// ```
pub fn set_up_appearance(
    vertices: &[AppearanceVertex; 3],
    material: u8,
    level: u8,
    size: Size,
) -> Option<AppearancePacket> {
    let screen = vertices.map(|v| v.at);
    let triangle = set_up(&screen, size)?;
    // In the sequence that makes the area positive, as in set-up.
    let [v0, v1, v2] = *vertices;
    let round = if signed_area2(&screen) < 0 { [v0, v2, v1] } else { [v0, v1, v2] };
    let anchor = Anchor { corners: round.map(|v| v.at), area2: triangle.area2 };
    let plane = |value: &dyn Fn(&AppearanceVertex) -> i64| {
        anchor.through([value(&round[0]), value(&round[1]), value(&round[2])], PARAMETER_PLANE_BITS)
    };
    Some(AppearancePacket {
        normal: [0, 1, 2].map(|i| plane(&|v| v.normal[i].into())),
        uv: [0, 1].map(|i| plane(&|v| v.uv[i].into())),
        scale: plane(&|v| v.scale.into()),
        triangle,
        material,
        level,
    })
}

impl AppearancePacket {
    /// The appearance word at pixel (x, y); meaningful where the triangle covers the pixel.
    pub fn word(&self, x: u32, y: u32) -> Appearance {
        Appearance::from(self.parameters(x, y))
    }
}

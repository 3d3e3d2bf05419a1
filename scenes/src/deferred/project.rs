//! The front end of deferred shading: converts a scene to packets of appearance and the constants of a shader.
//!
//! Clipping, projection, snapping and set-up are those of [`crate::project`], so coverage and depth are identical.
//! Normals are transformed to view space, put on the eye's side triangle by triangle, and scaled to length 32767.

use super::constants::shader;
use super::mapping::{level, mapped};
use super::packet::{AppearancePacket, AppearanceVertex, set_up_appearance};
use super::samples::{Samples, Shading};
use super::shader::Shader;
use crate::clip::ViewVertex;
use crate::error::SceneError;
use crate::material::{Material, Materials};
use crate::packet::Triangle;
use crate::project::{Counts, Front, Part};
use crate::scene::Scene;
use crate::setup::signed_area2;
use crate::size::Size;
use glam::DVec3;
use std::borrow::Cow;

/// Units of a component of a normal of length 1.
const NORMAL: f64 = 32767.0;
/// A level of detail, in 1/8.
const LEVEL: u8 = 8;

/// A scene for deferred shading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Deferred {
    /// Pixels of the frame.
    pub size: Size,
    /// The samples of each pixel.
    pub samples: Samples,
    /// The passes: one, or two at twice the width and height.
    pub passes: Vec<Pass>,
    /// The shader, which computes colours from it.
    pub shader: Shader,
    /// The counts of polygons in the first pass.
    pub counts: Counts,
}

/// A pass: everything of a scene that is drawn at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pass {
    /// The screen.
    pub size: Size,
    /// Packets in the sequence of submission, as in [`Projection::triangles`](crate::Projection::triangles).
    pub packets: Vec<AppearancePacket>,
    /// The vertices that each packet was set up from, in the same sequence.
    pub vertices: Vec<[AppearanceVertex; 3]>,
}

/// Projects a scene onto a screen, for deferred shading.
///
/// ```
/// use tilewright_scenes::deferred::{Samples, project_deferred};
/// use tilewright_scenes::{Scene, Size, golden};
///
/// let scene = Scene::builtin("teapot").unwrap();
/// let deferred = project_deferred(&scene, Size::new(64, 48)?, Samples::One)?;
/// let frame = golden::render_deferred(&deferred);
/// assert_eq!(frame.size(), deferred.size);
/// # Ok::<(), tilewright_scenes::SceneError>(())
/// ```
///
/// # Errors
/// As [`crate::project`]. Also if a texture could not be read, there are more than 256 lights, or the screen is too
/// large for eight samples.
pub fn project_deferred(scene: &Scene, size: Size, samples: Samples) -> Result<Deferred, SceneError> {
    scene.without_spheres()?;
    let default = || Cow::Owned(Materials::plain(Material::default(), scene.mesh.triangles().len()));
    let materials = scene.mesh.materials().map_or_else(default, Cow::Borrowed);
    let shader = shader(scene, &materials, scene.camera.view()?)?;
    // A texel should be as large as a shaded sample.
    let coarser = if samples == Samples::Eight(Shading::OncePerPixel) { LEVEL } else { 0 };
    let passes = samples.passes(size)?;
    let passes: Vec<(Pass, Counts)> = passes
        .into_iter()
        .map(|(size, shift)| {
            let drawing = Drawing { materials: &materials, size, coarser };
            Ok(drawing.pass(&Front::new(scene, size, shift)?))
        })
        .collect::<Result<_, SceneError>>()?;
    let counts = passes[0].1;
    Ok(Deferred { size, samples, passes: passes.into_iter().map(|(pass, _)| pass).collect(), shader, counts })
}

impl Deferred {
    /// A sentence if no triangle and no line covers a pixel, so that the picture would show only the background; `None`
    /// if one does.
    pub fn warning(&self) -> Option<String> {
        self.counts.warning(self.passes.iter().flat_map(|pass| &pass.packets).map(|packet| &packet.triangle))
    }
}

/// Values that are the same for all triangles of a pass.
struct Drawing<'a> {
    materials: &'a Materials,
    size: Size,
    /// The amount subtracted from each level of detail, in 1/8.
    coarser: u8,
}

impl Drawing<'_> {
    fn pass(&self, front: &Front) -> (Pass, Counts) {
        let mut pass = Pass { size: self.size, packets: Vec::new(), vertices: Vec::new() };
        let counts = front.parts(|part| {
            let made = self.packet(part);
            let is_drawn = made.is_some();
            if let Some((vertices, packet)) = made {
                pass.vertices.push(vertices);
                pass.packets.push(packet);
            }
            is_drawn
        });
        (pass, counts)
    }

    /// The packet of a triangle, or of half a line, and its vertices.
    fn packet(&self, part: &Part) -> Option<([AppearanceVertex; 3], AppearancePacket)> {
        let plain = part.vertices.map(|at| AppearanceVertex { at, normal: [0; 3], uv: [0; 2], scale: 0 });
        let (vertices, material, level) = match part.seen {
            Some(seen) => self.surface(part.polygon as usize, plain, seen),
            // Lines have the last material, and no normal.
            None => (plain, self.materials.materials.len(), 0),
        };
        let packet = set_up_appearance(&vertices, material as u8, level, self.size)?;
        let triangle = Triangle { polygon: part.polygon, ..packet.triangle };
        Some((vertices, AppearancePacket { triangle, ..packet }))
    }

    /// A triangle's vertices with all attributes, its material and its level of detail.
    fn surface(
        &self,
        triangle: usize,
        mut vertices: [AppearanceVertex; 3],
        seen: [ViewVertex; 3],
    ) -> ([AppearanceVertex; 3], usize, u8) {
        let material = self.materials.mappings[triangle].material as usize;
        for (vertex, seen) in vertices.iter_mut().zip(seen) {
            vertex.at.rgb = seen.diffuse.to_array().map(eight_bits);
            vertex.normal = sixteen_bits(seen.normal);
        }
        if self.materials.materials[material].texture.is_none() {
            return (vertices, material, 0);
        }
        let (uv, scale) = mapped(seen.map(|v| v.uv), seen.map(|v| v.at.z));
        for (i, vertex) in vertices.iter_mut().enumerate() {
            (vertex.uv, vertex.scale) = (uv[i], scale[i]);
        }
        // A triangle without an area is not drawn.
        let level = if signed_area2(&vertices.map(|v| v.at)) == 0 { 0 } else { level(&vertices) };
        (vertices, material, level.saturating_sub(self.coarser))
    }
}

fn eight_bits(channel: f64) -> u8 {
    (channel * 255.0 + 0.5).floor() as u8
}

fn sixteen_bits(normal: DVec3) -> [i16; 3] {
    normal.to_array().map(|part| (part * NORMAL + 0.5).floor() as i16)
}

//! The front end: a scene becomes triangle packets for a screen.
//!
//! Transform, light, clip, project, snap to 1/16 pixel, set up (facts E0). Depth is `(1 - near/w) * far/(far - near)` for a
//! distance w along the line of sight: linear in 1/w, so that a plane in space is a plane on the screen. `near` and `far` are taken
//! from the scene: they enclose what is in front of the eye, near being at least far/4096.
//!
//! Float results are bit-equal on every machine: only + - * / and square roots of f64 are used (see [`crate::angle`]).

use crate::camera::View;
use crate::clip::{ClipPlane, ViewVertex};
use crate::error::SceneError;
use crate::light::{Lighting, facing};
use crate::mesh::{MeshTriangle, unit_or_z};
use crate::packet::*;
use crate::polygon::set_up_polygon;
use crate::scene::Scene;
use crate::setup::{set_up, signed_area2};
use crate::size::Size;
use glam::DVec3;

/// What becomes of a scene's polygons; every polygon is counted once, in `drawn` or in one of the four fields after it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Triangles of the mesh, or its faces.
    pub polygons: u32,
    /// Polygons with at least one packet.
    pub drawn: u32,
    /// Polygons wholly nearer than the near plane, or behind the eye.
    pub behind: u32,
    /// Polygons wholly outside the screen.
    pub off_screen: u32,
    /// Polygons of zero area after snapping.
    pub degenerate: u32,
    /// Polygons on the screen that enclose no pixel centre along one of the axes.
    pub between_centres: u32,
    /// Polygons that clipping turned into two packets or more; they count as drawn too.
    pub split: u32,
}

/// A scene on a screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Projection {
    /// The screen.
    pub size: Size,
    /// Packets in order of submission; [`Triangle::polygon`] tells which polygon of the mesh each is of, never decreasing.
    pub triangles: Vec<Triangle>,
    /// The three vertices that each packet was set up from, in the same order as `triangles`.
    pub vertices: Vec<[ScreenVertex; 3]>,
    /// What became of the polygons.
    pub counts: Counts,
}

/// A scene on a screen, in polygons.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polygons {
    /// The screen.
    pub size: Size,
    /// Packets in order of submission; [`Packet::polygon`] tells which face of the mesh each is of, never decreasing.
    pub polygons: Vec<Polygon>,
    /// What became of the faces.
    pub counts: Counts,
}

impl Scene {
    /// Triangle packets for the size that the scene asks for.
    ///
    /// # Errors
    /// As [`project`].
    pub fn project(&self) -> Result<Projection, SceneError> {
        project(self, self.size)
    }
}

/// Projects a scene onto a screen.
///
/// # Errors
/// [`SceneError`] if the camera or the lights are no good, or if nothing of the mesh is in front of the camera.
pub fn project(scene: &Scene, size: Size) -> Result<Projection, SceneError> {
    project_sample(scene, size, [0, 0])
}

/// Projects a scene with every vertex moved by `shift`, in 1/16 pixel: one sample of a multi-pass antialiased frame (facts E0, AA).
///
/// # Errors
/// As [`project`]; also if a shift exceeds a pixel.
pub fn project_sample(scene: &Scene, size: Size, shift: [i32; 2]) -> Result<Projection, SceneError> {
    if shift.iter().any(|s| s.abs() > SUBPIXELS) {
        return Err(SceneError::invalid(
            format!("a sample's shift is {shift:?} sixteenths of a pixel"),
            "give numbers from -16 to 16",
        ));
    }
    let front = Front::new(scene, size, shift)?;
    let mut projection = Projection {
        size,
        triangles: Vec::with_capacity(scene.mesh.triangles().len()),
        vertices: Vec::with_capacity(scene.mesh.triangles().len()),
        counts: Counts::default(),
    };
    for (polygon, triangle) in (0..).zip(scene.mesh.triangles()) {
        projection.counts.polygons += 1;
        match front.screen.clip(&front.corners(triangle)) {
            Ok(ring) => projection.submit(polygon, &ring, &front.screen),
            Err(outside) => projection.counts.leave_out(outside),
        }
    }
    Ok(projection)
}

/// Projects a scene onto a screen, each face of its mesh as one polygon where [`set_up_polygon`] makes one of it. Few tilted faces
/// are: snapping their corners takes them out of their plane by more than a unit of depth.
///
/// # Errors
/// As [`project`].
pub fn project_polygons(scene: &Scene, size: Size) -> Result<Polygons, SceneError> {
    let front = Front::new(scene, size, [0, 0])?;
    let mut all = Polygons { size, polygons: Vec::new(), counts: Counts::default() };
    for (number, face) in (0..).zip(scene.mesh.faces()) {
        all.counts.polygons += 1;
        let ends = face.iter().skip(1).map(|triangle| front.corners(triangle)[2]);
        let corners: Vec<ViewVertex> = front.corners(&face[0]).into_iter().chain(ends).collect();
        match front.screen.clip(&corners) {
            Err(outside) => all.counts.leave_out(outside),
            Ok(ring) => {
                let vertices: Vec<ScreenVertex> = ring.iter().map(|&v| front.screen.snap(v)).collect();
                let packets = set_up_polygon(&vertices, size);
                let is_proper =
                    (2..vertices.len()).any(|i| signed_area2(&[vertices[0], vertices[i - 1], vertices[i]]) != 0);
                all.counts.take(packets.len(), is_proper, front.screen.meets(&vertices));
                all.polygons.extend(packets.into_iter().map(|packet| Polygon { polygon: number, ..packet }));
            }
        }
    }
    Ok(all)
}

impl Projection {
    /// Sets up the pieces of one polygon and counts what became of it.
    fn submit(&mut self, polygon: u32, ring: &[ViewVertex], screen: &Screen) {
        let before = self.triangles.len();
        let (mut is_proper, mut on_screen) = (false, false);
        for i in 2..ring.len() {
            let vertices = [ring[0], ring[i - 1], ring[i]].map(|v| screen.snap(v));
            is_proper |= signed_area2(&vertices) != 0;
            on_screen |= screen.meets(&vertices);
            if let Some(mut packet) = set_up(&vertices, self.size) {
                packet.polygon = polygon;
                self.triangles.push(packet);
                self.vertices.push(vertices);
            }
        }
        self.counts.take(self.triangles.len() - before, is_proper, on_screen);
    }
}

impl Counts {
    /// A polygon that has become so many packets.
    fn take(&mut self, packets: usize, is_proper: bool, on_screen: bool) {
        let fate = match packets {
            0 if !is_proper => &mut self.degenerate,
            0 if !on_screen => &mut self.off_screen,
            0 => &mut self.between_centres,
            packets => {
                self.split += u32::from(packets > 1);
                &mut self.drawn
            }
        };
        *fate += 1;
    }

    /// A polygon that clipping left nothing of.
    fn leave_out(&mut self, outside: Clipped) {
        match outside {
            Clipped::Behind => self.behind += 1,
            Clipped::OffScreen => self.off_screen += 1,
        }
    }
}

/// What all polygons of a scene go through.
struct Front<'a> {
    scene: &'a Scene,
    lighting: Lighting,
    /// The positions of the mesh, in view space.
    seen: Vec<DVec3>,
    screen: Screen,
}

impl Front<'_> {
    fn new(scene: &Scene, size: Size, shift: [i32; 2]) -> Result<Front<'_>, SceneError> {
        scene.lighting.check()?;
        let view = scene.camera.view()?;
        let seen: Vec<DVec3> = scene.mesh.positions().iter().map(|&p| view.of_point(p)).collect();
        let screen = Screen::new(scene, &seen, view, size, shift)?;
        Ok(Front { scene, lighting: scene.lighting.normalized(), seen, screen })
    }

    /// A triangle's corners, each channel of their colours 0 to 1.
    fn corners(&self, triangle: &MeshTriangle) -> [ViewVertex; 3] {
        let mesh = &self.scene.mesh;
        let [p, q, r] = triangle.positions.map(|i| mesh.positions()[i as usize]);
        let face = (q - p).cross(r - p);
        let diffuse = DVec3::from_array(triangle.diffuse);
        [0, 1, 2].map(|i| {
            let normal = unit_or_z(mesh.normals()[triangle.normals[i] as usize]);
            let rgb = diffuse * self.lighting.at(facing(normal, face, self.scene.camera.eye - p));
            ViewVertex { at: self.seen[triangle.positions[i] as usize], rgb }
        })
    }
}

/// The error of a scene of which nothing is in front of the eye, or `None` if something is; what is wrong with the camera itself
/// is an error of its own.
pub(crate) fn nothing_in_front(scene: &Scene) -> Result<Option<SceneError>, SceneError> {
    let view = scene.camera.view()?;
    let positions = scene.mesh.positions().iter();
    let seen: Vec<DVec3> = positions.map(|&p| view.of_point(p)).collect();
    Ok((depth_range(scene, &seen).1 == 0.0).then(|| behind(scene)))
}

fn behind(scene: &Scene) -> SceneError {
    SceneError::invalid(
        format!(
            "nothing of the mesh is in front of the camera at {} looking towards {}",
            scene.camera.eye, scene.camera.target
        ),
        "move the eye or the target",
    )
}

/// The greatest ratio of far to near: 24 bits then still tell apart what is 1/4000 of the far distance deep.
const DEPTH_RATIO: f64 = 4096.0;

/// The least and the greatest distance along the line of sight of what is in front of the eye; far is 0 if nothing is, and near is 0
/// if a triangle passes the eye.
fn depth_range(scene: &Scene, seen: &[DVec3]) -> (f64, f64) {
    let mut range = (f64::INFINITY, 0.0_f64);
    for triangle in scene.mesh.triangles() {
        let w = triangle.positions.map(|i| seen[i as usize].z);
        let nearest = w[0].min(w[1]).min(w[2]);
        let farthest = w[0].max(w[1]).max(w[2]);
        if farthest > 0.0 {
            range = (range.0.min(nearest.max(0.0)), range.1.max(farthest));
        }
    }
    range
}

/// What clipping left nothing of, and on which side it was.
#[derive(Clone, Copy)]
enum Clipped {
    Behind,
    OffScreen,
}

/// The screen as the front end sees it: view space to 1/16 pixels.
struct Screen {
    size: Size,
    shift: [i32; 2],
    /// Middle of the screen, in pixels.
    centre: [f64; 2],
    /// Pixels per unit of right/forward.
    scale: f64,
    near: f64,
    /// far / (far - near).
    depth_scale: f64,
    near_plane: ClipPlane,
    guard: [ClipPlane; 4],
}

impl Screen {
    fn new(scene: &Scene, seen: &[DVec3], view: View, size: Size, shift: [i32; 2]) -> Result<Screen, SceneError> {
        let (nearest, far) = depth_range(scene, seen);
        if far == 0.0 {
            return Err(behind(scene));
        }
        let near = nearest.max(far / DEPTH_RATIO);
        // A mesh at one distance: any far plane behind it serves.
        let far = far.max(near * 1.001);
        let centre = [f64::from(size.width()) / 2.0, f64::from(size.height()) / 2.0];
        let scale = centre[1] / view.half_height;
        // The guard band less the shift, so that a moved vertex is still 16 bits.
        let limits = |axis: usize| {
            let sub = |position: i32| f64::from(position - shift[axis]) / f64::from(SUBPIXELS);
            (sub(i16::MIN.into()), sub(i16::MAX.into()))
        };
        let ((left, right), (top, bottom)) = (limits(0), limits(1));
        let plane = |x: f64, y: f64, w: f64| ClipPlane { normal: DVec3::new(x, y, w), offset: 0.0 };
        Ok(Screen {
            size,
            shift,
            centre,
            scale,
            near,
            depth_scale: far / (far - near),
            near_plane: ClipPlane { normal: DVec3::Z, offset: near },
            guard: [
                plane(scale, 0.0, centre[0] - left),
                plane(-scale, 0.0, right - centre[0]),
                plane(0.0, scale, centre[1] - top),
                plane(0.0, -scale, bottom - centre[1]),
            ],
        })
    }

    /// The part of a convex polygon that is beyond the near plane and, where it leaves the guard band, inside that: three vertices at
    /// least.
    fn clip(&self, corners: &[ViewVertex]) -> Result<Vec<ViewVertex>, Clipped> {
        let planes = [(&self.near_plane, Clipped::Behind)]
            .into_iter()
            .chain(self.guard.iter().map(|plane| (plane, Clipped::OffScreen)));
        let mut polygon = corners.to_vec();
        for (plane, outside) in planes {
            if polygon.iter().any(|v| plane.inside_by(v.at) < 0.0) {
                polygon = plane.clip(&polygon);
            }
            if polygon.len() < 3 {
                return Err(outside);
            }
        }
        Ok(polygon)
    }

    /// A vertex at its 1/16 pixel.
    fn snap(&self, v: ViewVertex) -> ScreenVertex {
        let w = v.at.z;
        let place = |axis: usize, offset: f64| {
            let pixels = self.centre[axis] + offset * self.scale / w;
            let snapped = (pixels * f64::from(SUBPIXELS) + 0.5).floor() as i32;
            snapped.saturating_add(self.shift[axis]).clamp(i16::MIN.into(), i16::MAX.into())
        };
        let range = f64::from(FARTHEST_VERTEX - NEAREST_VERTEX);
        let depth = ((1.0 - self.near / w) * self.depth_scale).clamp(0.0, 1.0);
        ScreenVertex {
            x: place(0, v.at.x),
            y: place(1, v.at.y),
            z: NEAREST_VERTEX + (depth * range + 0.5).floor() as u32,
            rgb: v.rgb.to_array().map(|c| (c * 255.0 + 0.5).floor() as u8),
        }
    }

    /// Whether the box round the vertices meets the screen.
    fn meets(&self, vertices: &[ScreenVertex]) -> bool {
        let axis = |position: fn(&ScreenVertex) -> i32, side: u32| {
            vertices.iter().any(|v| position(v) > 0) && vertices.iter().any(|v| position(v) < side as i32 * SUBPIXELS)
        };
        axis(|v| v.x, self.size.width()) && axis(|v| v.y, self.size.height())
    }
}

//! The front end: converts a scene to packets for a screen, of triangles alone or of polygons.
//!
//! The steps are transform, light, clip, project, snap to 1/16 pixel, set up (facts E0). A line is a polygon of four
//! corners, or two triangles in the same planes, and is not lit. Depth is `(1 - near/w) * far/(far - near)` for a
//! distance w along the line of sight. It is linear in 1/w, so that a plane in space is a plane on the screen. `near`
//! and `far` come from the scene: they enclose everything in front of the eye, with near at least far/4096.
//!
//! Float results are bit-equal on every machine: only + - * / and square roots of f64 are used (see [`crate::angle`]).

use crate::camera::View;
use crate::clip::ViewVertex;
use crate::deferred::Samples;
use crate::error::SceneError;
use crate::light::{Lighting, facing};
use crate::line::{line_corners, set_up_line};
use crate::mesh::{MeshLine, MeshTriangle, MeshVertex, unit_or_z};
use crate::packet::*;
use crate::polygon::set_up_parts;
use crate::scene::Scene;
use crate::screen::{Clipped, Screen};
use crate::setup::{set_up, signed_area2};
use crate::size::Size;
use crate::sphere::{self, Seen, Shade, SpherePacket, Unseen};
use glam::{DVec2, DVec3};

/// The counts of a scene's polygons; every polygon is counted once, in `drawn` or in one of the four fields after it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Triangles of the mesh, or its faces; also its lines and the spheres.
    pub polygons: u32,
    /// Lines among the polygons.
    pub lines: u32,
    /// Spheres among the polygons.
    pub spheres: u32,
    /// Polygons with at least one packet.
    pub drawn: u32,
    /// Polygons wholly nearer than the near plane, or behind the eye.
    pub behind: u32,
    /// Polygons wholly outside the screen.
    pub off_screen: u32,
    /// Polygons of zero area after snapping, and lines of zero length.
    pub degenerate: u32,
    /// Polygons on the screen that enclose no pixel centre along one of the axes.
    pub between_centres: u32,
    /// Polygons other than lines that clipping split into two packets or more; they also count as drawn.
    pub split: u32,
}

/// A scene on a screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Projection {
    /// The screen.
    pub size: Size,
    /// Packets in the sequence of submission, up to two for a line. [`Triangle::polygon`] gives the packet's polygon in
    /// the mesh. It never decreases, and lines come after triangles.
    pub triangles: Vec<Triangle>,
    /// The three vertices that each packet was set up from, in the same sequence as `triangles`. Those of a line may be
    /// up to half a pixel outside the guard band.
    pub vertices: Vec<[ScreenVertex; 3]>,
    /// The vertices of each polygon of the mesh, drawn or not, by its number
    /// ([`Mesh::vertices_of_polygons`](crate::Mesh::vertices_of_polygons)).
    pub corners: Vec<[MeshVertex; 3]>,
    /// The counts of polygons.
    pub counts: Counts,
}

impl Projection {
    /// Triangles without a scene, each a polygon with corners of its own. Those without a pixel only count as polygons.
    ///
    /// ```
    /// use tilewright_scenes::{Projection, ScreenVertex, Size};
    ///
    /// let corner = |x, y| ScreenVertex { x: 16 * x, y: 16 * y, z: 5, rgb: [200, 100, 50] };
    /// let triangle = [corner(1, 1), corner(9, 1), corner(9, 9)];
    /// let projection = Projection::of_triangles(Size::new(64, 48)?, [triangle, [triangle[0]; 3]]);
    /// assert_eq!((projection.counts.polygons, projection.counts.drawn, projection.triangles.len()), (2, 1, 1));
    /// # Ok::<(), tilewright_scenes::SceneError>(())
    /// ```
    pub fn of_triangles(size: Size, triangles: impl IntoIterator<Item = [ScreenVertex; 3]>) -> Projection {
        let counts = Counts::default();
        let mut all = Projection { size, triangles: Vec::new(), vertices: Vec::new(), corners: Vec::new(), counts };
        for (vertices, first) in triangles.into_iter().zip((0..).step_by(3)) {
            all.corners.push([0, 1, 2].map(|i| MeshVertex { position: first + i, normal: Some(first) }));
            if let Some(packet) = set_up(&vertices, size) {
                all.triangles.push(Triangle { polygon: all.counts.polygons, ..packet });
                all.vertices.push(vertices);
                all.counts.drawn += 1;
            }
            all.counts.polygons += 1;
        }
        all
    }
}

/// A scene on a screen, in polygons and spheres.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polygons {
    /// The screen.
    pub size: Size,
    /// Packets in the sequence of submission. [`Packet::polygon`] gives the packet's face or line of the mesh. It never
    /// decreases, and lines come after faces.
    pub polygons: Vec<Polygon>,
    /// The vertices that each packet was set up from, in the same sequence as `polygons`: for a line its two ends.
    pub vertices: Vec<Vec<ScreenVertex>>,
    /// The packets of spheres in the sequence of submission, after the polygons.
    pub spheres: Vec<SpherePacket>,
    /// The counts of faces, lines and spheres.
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
/// [`SceneError`] if the camera or the lights are invalid, if nothing of the mesh is in front of the camera, or if
/// there are spheres, which have no triangles.
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
    scene.without_spheres()?;
    let front = Front::new(scene, size, shift)?;
    let mut triangles = Vec::with_capacity(scene.mesh.triangles().len());
    let mut vertices = Vec::with_capacity(scene.mesh.triangles().len());
    let counts = front.parts(|part| {
        let packet = set_up(&part.vertices, size);
        let is_drawn = packet.is_some();
        if let Some(packet) = packet {
            triangles.push(Triangle { polygon: part.polygon, ..packet });
            vertices.push(part.vertices);
        }
        is_drawn
    });
    Ok(Projection { size, triangles, vertices, corners: scene.mesh.vertices_of_polygons(), counts })
}

/// Projects a scene for all samples of its pixels: once, or for eight samples twice at doubled width and height.
///
/// # Errors
/// As [`project`]; also if the screen is too large for eight samples.
pub fn project_samples(scene: &Scene, size: Size, samples: Samples) -> Result<Vec<Projection>, SceneError> {
    samples.passes(size)?.into_iter().map(|(size, shift)| project_sample(scene, size, shift)).collect()
}

/// Projects a scene onto a screen, each face of its mesh as one polygon where [`set_up_polygon`](crate::set_up_polygon)
/// allows it. It allows few tilted faces: snapping moves their corners out of the plane by more than a unit of depth.
///
/// # Errors
/// As [`project`], except for spheres. Also if a sphere is too near, too large or too slender, as [the page of
/// spheres](crate::sphere) says.
pub fn project_polygons(scene: &Scene, size: Size) -> Result<Polygons, SceneError> {
    let front = Front::new(scene, size, [0, 0])?;
    let mut all =
        Polygons { size, polygons: Vec::new(), vertices: Vec::new(), spheres: Vec::new(), counts: Counts::default() };
    let mut first = 0;
    for (number, face) in (0..).zip(scene.mesh.faces()) {
        all.counts.polygons += 1;
        let ends = (first..).zip(face).skip(1).map(|(triangle, of)| front.corners(triangle, of)[2]);
        let corners: Vec<ViewVertex> = front.corners(first, &face[0]).into_iter().chain(ends).collect();
        first += face.len() as u32;
        match front.screen.clip(&corners) {
            Ok(ring) => all.submit(number, &ring, &front.screen),
            Err(outside) => all.counts.leave_out(outside),
        }
    }
    for line in scene.mesh.lines() {
        let number = all.counts.line();
        match front.screen.clip_line(front.ends(line)) {
            Ok(ends) => all.submit_line(number, ends, &front.screen),
            Err(outside) => all.counts.leave_out(outside),
        }
    }
    let shade = Shade::new(&front.lighting, |direction| front.view.of_direction(direction));
    for (i, sphere) in scene.spheres.iter().enumerate() {
        let middle = front.view.of_point(sphere.centre);
        all.submit_sphere(sphere::set_up(i, sphere, middle, &front.screen, &shade)?);
    }
    Ok(all)
}

impl Polygons {
    /// Sets up a face and counts the result.
    fn submit(&mut self, number: u32, ring: &[ViewVertex], screen: &Screen) {
        let vertices: Vec<ScreenVertex> = ring.iter().map(|&v| screen.snap(v)).collect();
        let parts = set_up_parts(&vertices, self.size);
        let is_proper = (2..vertices.len()).any(|i| signed_area2(&[vertices[0], vertices[i - 1], vertices[i]]) != 0);
        self.counts.take(parts.len(), is_proper, screen.meets(&vertices));
        for (vertices, packet) in parts {
            self.polygons.push(Polygon { polygon: number, ..packet });
            self.vertices.push(vertices);
        }
    }

    /// Adds a sphere that has been set up, and counts the result.
    fn submit_sphere(&mut self, seen: Seen) {
        let number = self.counts.polygons;
        self.counts.polygons += 1;
        self.counts.spheres += 1;
        match seen {
            Err(Unseen::Behind) => self.counts.behind += 1,
            Err(Unseen::OffScreen) => self.counts.off_screen += 1,
            Err(Unseen::BetweenCentres) => self.counts.between_centres += 1,
            Ok(packet) => {
                self.counts.drawn += 1;
                self.spheres.push(SpherePacket { polygon: number, ..packet });
            }
        }
    }

    /// Sets up a line and counts the result.
    fn submit_line(&mut self, number: u32, ends: [ViewVertex; 2], screen: &Screen) {
        let ends = ends.map(|v| screen.snap(v));
        let packet = set_up_line(ends, self.size);
        self.counts.take_line(packet.is_some(), ends, screen);
        if let Some(packet) = packet {
            self.polygons.push(Polygon { polygon: number, ..packet });
            self.vertices.push(ends.to_vec());
        }
    }
}

impl Counts {
    /// Counts a polygon that has become this many packets.
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

    /// A line; its number among the polygons.
    fn line(&mut self) -> u32 {
        self.lines += 1;
        self.polygons += 1;
        self.polygons - 1
    }

    /// Counts a line that has become a packet or more, or none.
    fn take_line(&mut self, is_drawn: bool, ends: [ScreenVertex; 2], screen: &Screen) {
        let has_length = (ends[0].x, ends[0].y) != (ends[1].x, ends[1].y);
        self.take(is_drawn.into(), has_length, screen.meets(&line_corners(ends)));
    }

    /// Counts a polygon of which clipping left nothing.
    fn leave_out(&mut self, outside: Clipped) {
        match outside {
            Clipped::Behind => self.behind += 1,
            Clipped::OffScreen => self.off_screen += 1,
        }
    }
}

/// A triangle that remains of a polygon, on the screen.
pub(crate) struct Part {
    /// The number of the polygon in the mesh: lines come after the triangles.
    pub(crate) polygon: u32,
    pub(crate) vertices: [ScreenVertex; 3],
    /// The vertices before snapping; `None` for half a line.
    pub(crate) seen: Option<[ViewVertex; 3]>,
}

/// The common part of projecting all polygons of a scene.
pub(crate) struct Front<'a> {
    scene: &'a Scene,
    lighting: Lighting,
    pub(crate) view: View,
    /// The positions of the mesh, in view space.
    seen: Vec<DVec3>,
    screen: Screen,
}

impl Front<'_> {
    pub(crate) fn new(scene: &Scene, size: Size, shift: [i32; 2]) -> Result<Front<'_>, SceneError> {
        scene.lighting.check()?;
        scene.spheres.iter().enumerate().try_for_each(|(i, sphere)| sphere.check(i))?;
        let view = scene.camera.view()?;
        let seen: Vec<DVec3> = scene.mesh.positions().iter().map(|&p| view.of_point(p)).collect();
        let screen = Screen::new(scene, &seen, view, size, shift)?;
        Ok(Front { scene, lighting: scene.lighting.normalized(), view, seen, screen })
    }

    /// Passes on the rest of every triangle and line, in triangles, and counts the results; `set_up` returns whether
    /// there is anything to draw.
    pub(crate) fn parts(&self, mut set_up: impl FnMut(&Part) -> bool) -> Counts {
        let mut counts = Counts::default();
        for (polygon, triangle) in (0..).zip(self.scene.mesh.triangles()) {
            counts.polygons += 1;
            match self.screen.clip(&self.corners(polygon, triangle)) {
                Ok(ring) => self.pieces(polygon, &ring, &mut set_up, &mut counts),
                Err(outside) => counts.leave_out(outside),
            }
        }
        for line in self.scene.mesh.lines() {
            let polygon = counts.line();
            match self.screen.clip_line(self.ends(line)) {
                Ok(ends) => self.halves(polygon, ends, &mut set_up, &mut counts),
                Err(outside) => counts.leave_out(outside),
            }
        }
        counts
    }

    /// Passes on the pieces of a triangle and counts the result.
    fn pieces(&self, polygon: u32, ring: &[ViewVertex], set_up: &mut impl FnMut(&Part) -> bool, counts: &mut Counts) {
        let (mut packets, mut is_proper, mut on_screen) = (0, false, false);
        for i in 2..ring.len() {
            let seen = [ring[0], ring[i - 1], ring[i]];
            let vertices = seen.map(|v| self.screen.snap(v));
            is_proper |= signed_area2(&vertices) != 0;
            on_screen |= self.screen.meets(&vertices);
            packets += usize::from(set_up(&Part { polygon, vertices, seen: Some(seen) }));
        }
        counts.take(packets, is_proper, on_screen);
    }

    /// Passes on the halves of a line, which has its own planes, and counts the result.
    fn halves(&self, polygon: u32, ends: [ViewVertex; 2], set_up: &mut impl FnMut(&Part) -> bool, counts: &mut Counts) {
        let ends = ends.map(|v| self.screen.snap(v));
        let corners = line_corners(ends);
        let mut is_drawn = false;
        for half in [[0, 1, 2], [0, 2, 3]] {
            is_drawn |= set_up(&Part { polygon, vertices: half.map(|i| corners[i]), seen: None });
        }
        counts.take_line(is_drawn, ends, &self.screen);
    }

    /// The corners of the triangle with that number.
    fn corners(&self, number: u32, triangle: &MeshTriangle) -> [ViewVertex; 3] {
        let mesh = &self.scene.mesh;
        let [p, q, r] = triangle.positions.map(|i| mesh.positions()[i as usize]);
        let face = (q - p).cross(r - p);
        let diffuse = mesh.corner_colours(number as usize).map(DVec3::from_array);
        let uv = mesh.materials().map_or([DVec2::ZERO; 3], |materials| materials.corners(number));
        [0, 1, 2].map(|i| {
            let normal = unit_or_z(mesh.normals()[triangle.normals[i] as usize]);
            let turned = facing(normal, face, self.scene.camera.eye - p);
            ViewVertex {
                at: self.seen[triangle.positions[i] as usize],
                rgb: diffuse[i] * self.lighting.at(turned),
                diffuse: diffuse[i],
                normal: self.view.of_direction(turned),
                uv: uv[i],
            }
        })
    }

    /// A line's ends.
    fn ends(&self, line: &MeshLine) -> [ViewVertex; 2] {
        line.positions.map(|i| ViewVertex {
            at: self.seen[i as usize],
            rgb: DVec3::from_array(line.colour),
            ..ViewVertex::default()
        })
    }
}

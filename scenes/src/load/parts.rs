//! The content of a mesh file of any format, and its conversion to a mesh.
//!
//! [`super::faces`] cuts polygons. Each triangle of a face counts as a polygon, and so does each segment of a polyline,
//! in the file's sequence. In a wireframe the outlines of faces become lines; the cuts do not.

use super::faces::cut;
use super::surfaces::Surfaces;
use crate::error::SceneError;
use crate::mesh::{Mesh, MeshLine, MeshTriangle, smooth_normals};
use crate::wireframe::{Sides, place};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use std::path::Path;

/// The colour of anything without a material.
pub(super) const GREY: [f64; 3] = [0.8; 3];
/// The factor that leaves a colour unchanged.
pub(super) const WHITE: [f64; 3] = [1.0; 3];

/// Vertices, and the faces and lines that refer to them by index. The reader of a file checks the indices.
#[derive(Debug, Default)]
pub(super) struct Geometry {
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Vec<DVec3>,
    /// Texture coordinates: u rightward, v upward.
    pub(super) coordinates: Vec<DVec2>,
    /// Colours of corners, each channel 0 to 1, which multiply that of the material.
    pub(super) colours: Vec<[f64; 3]>,
    pub(super) faces: Vec<Face>,
    pub(super) lines: Vec<Polyline>,
}

/// A face with at least three corners.
#[derive(Debug)]
pub(super) struct Face {
    /// The line of the file where it begins, or its number in a file without lines.
    pub(super) place: usize,
    /// By index in the file's list of materials.
    pub(super) material: Option<usize>,
    pub(super) corners: Vec<Corner>,
}

/// A polyline: its material by index, its colour factor, and at least two vertices, counted from 0.
#[derive(Debug)]
pub(super) struct Polyline {
    pub(super) material: Option<usize>,
    pub(super) tint: [f64; 3],
    pub(super) vertices: Vec<u32>,
}

/// One corner of a face: vertex, texture coordinate, normal and colour, counted from 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) vertex: u32,
    pub(super) texture: Option<u32>,
    pub(super) normal: Option<u32>,
    pub(super) colour: Option<u32>,
}

/// A mesh, and the places of faces that cross themselves.
pub(super) struct Built {
    pub(super) mesh: Mesh,
    pub(super) crossing: Vec<usize>,
}

impl Geometry {
    /// Whether every corner of every face names a normal.
    pub(super) fn has_normals(&self) -> bool {
        self.faces.iter().all(|face| face.corners.iter().all(|corner| corner.normal.is_some()))
    }

    /// The outlines of faces and the polylines as lines; `colours` has the colour of each material.
    pub(super) fn wireframe(&self, path: &Path, colours: &[[f64; 3]]) -> Result<Mesh, SceneError> {
        let mut parts = Parts::default();
        let mut sides = Sides::default();
        for face in &self.faces {
            let corners: Vec<u32> =
                face.corners.iter().map(|corner| parts.place(self.positions[corner.vertex as usize])).collect();
            let tint = mean(face.corners.iter().map(|corner| self.tint(corner)));
            sides.take(&parts.positions, &corners, tinted(colour(colours, face.material), tint));
        }
        parts.lines = sides.lines;
        parts.add_polylines(self, colours);
        parts.mesh(path, None)
    }

    /// Faces and polylines; normals are smooth unless every corner has one.
    pub(super) fn mesh(
        self,
        path: &Path,
        colours: &[[f64; 3]],
        surfaces: Option<Surfaces>,
    ) -> Result<Built, SceneError> {
        let has_normals = self.has_normals();
        let mut parts = Parts { surfaces, ..Parts::default() };
        let crossing = parts.add_faces(&self, has_normals, colours);
        parts.add_polylines(&self, colours);
        if let Some(surfaces) = &mut parts.surfaces {
            surfaces.set_coordinates(self.coordinates);
        }
        Ok(Built { mesh: parts.mesh(path, has_normals.then_some(self.normals))?, crossing })
    }
}

impl Geometry {
    /// The factor of the material's colour at that corner.
    fn tint(&self, corner: &Corner) -> [f64; 3] {
        corner.colour.map_or(WHITE, |i| self.colours[i as usize])
    }
}

fn tinted(colour: [f64; 3], tint: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|channel| colour[channel] * tint[channel])
}

/// The mean of some colours.
pub(super) fn mean(colours: impl ExactSizeIterator<Item = [f64; 3]>) -> [f64; 3] {
    let count = colours.len() as f64;
    let sum = colours.fold([0.0; 3], |sum, colour| [0, 1, 2].map(|channel| sum[channel] + colour[channel]));
    // The sum is rounded, but the mean of ones is still one.
    sum.map(|channel| (channel / count).min(1.0))
}

fn colour(colours: &[[f64; 3]], material: Option<usize>) -> [f64; 3] {
    material.map_or(GREY, |material| colours[material])
}

/// The mesh under construction. Equal positions become one, so that normals are smooth across the parts of a file.
#[derive(Default)]
struct Parts {
    positions: Vec<DVec3>,
    index_of: BTreeMap<[u64; 3], u32>,
    triangles: Vec<MeshTriangle>,
    /// The texture coordinates of each triangle's corners, where the file has some.
    colours: Vec<[[f64; 3]; 3]>,
    lines: Vec<MeshLine>,
    faces: Vec<u32>,
    /// For deferred shading.
    surfaces: Option<Surfaces>,
}

impl Parts {
    fn place(&mut self, position: DVec3) -> u32 {
        *self.index_of.entry(place(position)).or_insert_with(|| {
            self.positions.push(position);
            self.positions.len() as u32 - 1
        })
    }

    /// Adds the faces, cut into triangles; the places of those that cross themselves.
    fn add_faces(&mut self, of: &Geometry, has_normals: bool, colours: &[[f64; 3]]) -> Vec<usize> {
        let mut crossing = Vec::new();
        for face in &of.faces {
            let corners: Vec<DVec3> = face.corners.iter().map(|corner| of.positions[corner.vertex as usize]).collect();
            let cut = cut(&corners);
            if cut.crosses {
                crossing.push(face.place);
            }
            let places: Vec<u32> = corners.into_iter().map(|corner| self.place(corner)).collect();
            let diffuse = colour(colours, face.material);
            match cut.is_fan {
                true => self.faces.push(cut.triangles.len() as u32),
                false => self.faces.extend(cut.triangles.iter().map(|_| 1)),
            }
            for triangle in cut.triangles {
                let positions = triangle.map(|i| places[i]);
                let normals = match has_normals {
                    true => triangle.map(|i| face.corners[i].normal.unwrap_or_default()),
                    false => positions,
                };
                self.triangles.push(MeshTriangle { positions, normals, diffuse });
                if !of.colours.is_empty() {
                    self.colours.push(triangle.map(|i| tinted(diffuse, of.tint(&face.corners[i]))));
                }
                if let Some(surfaces) = &mut self.surfaces {
                    surfaces.add(face.material, triangle.map(|i| face.corners[i].texture));
                }
            }
        }
        crossing
    }

    /// Adds the segments of polylines.
    fn add_polylines(&mut self, of: &Geometry, colours: &[[f64; 3]]) {
        for line in &of.lines {
            let places: Vec<u32> = line.vertices.iter().map(|&i| self.place(of.positions[i as usize])).collect();
            let colour = tinted(colour(colours, line.material), line.tint);
            self.lines.extend(places.array_windows().map(|&positions| MeshLine { positions, colour }));
        }
    }

    /// The mesh, with these normals or with smooth ones.
    fn mesh(self, path: &Path, normals: Option<Vec<DVec3>>) -> Result<Mesh, SceneError> {
        let Parts { positions, triangles, colours, lines, faces, surfaces, .. } = self;
        let has_area = |triangle: &MeshTriangle| {
            let [p, q, r] = triangle.positions.map(|i| positions[i as usize]);
            (q - p).cross(r - p) != DVec3::ZERO
        };
        let has_length = |line: &MeshLine| line.positions[0] != line.positions[1];
        if !triangles.iter().any(has_area) && !lines.iter().any(has_length) {
            return Err(SceneError::File {
                path: path.to_owned(),
                problem: "holds no face with an area and no line with a length, so nothing would be drawn".to_owned(),
                remedy: "give a face three corners that are not in a line, or a polyline two that differ".to_owned(),
            });
        }
        if triangles.is_empty() {
            return Mesh::of_lines(positions, lines);
        }
        let smooth = || smooth_normals(&positions, &triangles.iter().map(|t| t.positions).collect::<Vec<_>>());
        let normals = normals.unwrap_or_else(smooth);
        let mut mesh = Mesh::new(positions, normals, triangles)?.with_faces(faces)?.with_lines(lines)?;
        if !colours.is_empty() {
            mesh = mesh.with_corner_colours(colours)?;
        }
        match surfaces {
            Some(surfaces) => mesh.with_materials(surfaces.materials()),
            None => Ok(mesh),
        }
    }
}

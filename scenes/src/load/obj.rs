//! OBJ files: polygons with normals and diffuse colours, and polylines with colours, become a mesh.
//!
//! [`super::obj_scan`] reads the lines, [`super::faces`] cuts polygons. Each triangle of a face counts as a polygon, and each segment of a
//! polyline, in the file's order. In a wireframe the outlines of faces become lines, not the cuts.

use super::faces::cut;
use super::material::{GREY, looks};
use super::obj_scan::{Scan, scan};
use super::surface::Surfaces;
use crate::error::SceneError;
use crate::input::{self, read_lines};
use crate::mesh::{Mesh, MeshLine, MeshTriangle, smooth_normals};
use crate::quote::shown;
use crate::wireframe::{Sides, place};
use glam::DVec3;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A mesh, the files that it is in, and what was odd about them.
pub(super) struct Loaded {
    pub(super) mesh: Mesh,
    pub(super) files: Vec<PathBuf>,
    pub(super) warnings: Vec<String>,
}

/// Reads a mesh; as a wireframe, it has the outlines of faces for lines.
pub(super) fn load(path: &Path, wireframe: bool) -> Result<Loaded, SceneError> {
    let bytes = read_lines(path, &input::MESH)?;
    // Names and comments may be in any encoding; what matters is ASCII.
    let scan = scan(path, &String::from_utf8_lossy(&bytes))?;
    let (mut files, mut warnings) = (vec![path.to_owned()], Vec::new());
    let has_normals = !wireframe && normals_are_whole(path, &scan, &mut warnings);
    let looks = looks(path, &scan, &mut files, &mut warnings)?;
    let colour = |material: Option<usize>| material.map_or(GREY, |material| looks[material].colour);
    let mut parts = Parts::default();
    if wireframe {
        let mut sides = Sides::default();
        for face in &scan.faces {
            let corners: Vec<u32> =
                face.corners.iter().map(|corner| parts.place(scan.positions[corner.vertex as usize])).collect();
            sides.take(&parts.positions, &corners, colour(face.material));
        }
        parts.lines = sides.lines;
    } else {
        parts.surfaces = Surfaces::new(path, &scan, &looks, &mut files, &mut warnings);
        let crossing = parts.add_faces(&scan, has_normals, colour);
        warnings.extend(crossing_faces(path, &crossing));
    }
    parts.add_polylines(&scan, colour);
    let normals = has_normals.then(|| scan.normals.clone());
    Ok(Loaded { mesh: parts.mesh(path, normals)?, files, warnings })
}

/// Whether every corner of every face names a normal; a warning if some do and others do not.
fn normals_are_whole(path: &Path, scan: &Scan, warnings: &mut Vec<String>) -> bool {
    let bare = scan.faces.iter().find(|face| face.corners.iter().any(|corner| corner.normal.is_none()));
    let some = || scan.faces.iter().flat_map(|face| &face.corners).any(|corner| corner.normal.is_some());
    if let Some(face) = bare
        && some()
    {
        warnings.push(format!(
            "{}:{}: this face has no normals and others have, so all normals are computed: export all or none",
            shown(path),
            face.line
        ));
    }
    bare.is_none()
}

/// One warning for all faces that cross themselves, which begin at these lines.
fn crossing_faces(path: &Path, lines: &[usize]) -> Option<String> {
    let first = lines.first()?;
    let what = match lines.len() {
        1 => "this face crosses itself, so it is drawn roughly".to_owned(),
        several => format!("this face and {} more cross themselves, so they are drawn roughly", several - 1),
    };
    Some(format!("{}:{first}: {what}: cut it where its edges meet", shown(path)))
}

/// The mesh under construction. Equal positions become one, so that normals are smooth across the parts of a file.
#[derive(Default)]
struct Parts<'a> {
    positions: Vec<DVec3>,
    index_of: BTreeMap<[u64; 3], u32>,
    triangles: Vec<MeshTriangle>,
    lines: Vec<MeshLine>,
    faces: Vec<u32>,
    /// For deferred shading.
    surfaces: Option<Surfaces<'a>>,
}

impl Parts<'_> {
    fn place(&mut self, position: DVec3) -> u32 {
        *self.index_of.entry(place(position)).or_insert_with(|| {
            self.positions.push(position);
            self.positions.len() as u32 - 1
        })
    }

    /// Adds the faces, cut into triangles; the lines of the file at which those begin that cross themselves.
    fn add_faces(&mut self, scan: &Scan, has_normals: bool, colour: impl Fn(Option<usize>) -> [f64; 3]) -> Vec<usize> {
        let mut crossing = Vec::new();
        for face in &scan.faces {
            let corners: Vec<DVec3> =
                face.corners.iter().map(|corner| scan.positions[corner.vertex as usize]).collect();
            let cut = cut(&corners);
            if cut.crosses {
                crossing.push(face.line);
            }
            let places: Vec<u32> = corners.into_iter().map(|corner| self.place(corner)).collect();
            let diffuse = colour(face.material);
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
                if let Some(surfaces) = &mut self.surfaces {
                    surfaces.add(face, triangle);
                }
            }
        }
        crossing
    }

    /// Adds the segments of polylines.
    fn add_polylines(&mut self, scan: &Scan, colour: impl Fn(Option<usize>) -> [f64; 3]) {
        for line in &scan.lines {
            let places: Vec<u32> = line.vertices.iter().map(|&i| self.place(scan.positions[i as usize])).collect();
            let segments =
                places.array_windows().map(|&positions| MeshLine { positions, colour: colour(line.material) });
            self.lines.extend(segments);
        }
    }

    /// The mesh, with these normals or with smooth ones.
    fn mesh(self, path: &Path, normals: Option<Vec<DVec3>>) -> Result<Mesh, SceneError> {
        let Parts { positions, triangles, lines, faces, surfaces, .. } = self;
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
        let mesh = Mesh::new(positions, normals, triangles)?.with_faces(faces)?.with_lines(lines)?;
        match surfaces {
            Some(surfaces) => mesh.with_materials(surfaces.materials()),
            None => Ok(mesh),
        }
    }
}

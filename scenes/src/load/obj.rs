//! OBJ files: polygons with normals and diffuse colours become a mesh.
//!
//! [`super::obj_scan`] reads the lines, [`super::faces`] cuts polygons. Each triangle of a face counts as a polygon, in the file's order.

use super::faces::cut;
use super::material::{GREY, diffuse_colours};
use super::obj_scan::{Scan, scan};
use crate::error::SceneError;
use crate::input::{self, read_lines};
use crate::mesh::{Mesh, MeshTriangle, smooth_normals};
use crate::quote::shown;
use glam::DVec3;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A mesh, the files that it is in, and what was odd about them.
pub(super) struct Loaded {
    pub(super) mesh: Mesh,
    pub(super) files: Vec<PathBuf>,
    pub(super) warnings: Vec<String>,
}

pub(super) fn load(path: &Path) -> Result<Loaded, SceneError> {
    let bytes = read_lines(path, &input::MESH)?;
    // Names and comments may be in any encoding; what matters is ASCII.
    let scan = scan(path, &String::from_utf8_lossy(&bytes))?;
    let (mut files, mut warnings) = (vec![path.to_owned()], Vec::new());
    let has_normals = normals_are_whole(path, &scan, &mut warnings);
    let colours = diffuse_colours(path, &scan, &mut files, &mut warnings)?;
    let mut parts = Parts::default();
    let mut crossing = Vec::new();
    for face in &scan.faces {
        let corners: Vec<DVec3> = face.corners.iter().map(|&(vertex, _)| scan.positions[vertex as usize]).collect();
        let cut = cut(&corners);
        if cut.crosses {
            crossing.push(face.line);
        }
        let places: Vec<u32> = corners.into_iter().map(|corner| parts.place(corner)).collect();
        let diffuse = face.material.map_or(GREY, |material| colours[material]);
        match cut.is_fan {
            true => parts.faces.push(cut.triangles.len() as u32),
            false => parts.faces.extend(cut.triangles.iter().map(|_| 1)),
        }
        for triangle in cut.triangles {
            let positions = triangle.map(|i| places[i]);
            let normals = match has_normals {
                true => triangle.map(|i| face.corners[i].1.unwrap_or_default()),
                false => positions,
            };
            parts.triangles.push(MeshTriangle { positions, normals, diffuse });
        }
    }
    warnings.extend(crossing_faces(path, &crossing));
    let normals = match has_normals {
        true => scan.normals,
        false => smooth_normals(&parts.positions, &parts.triangles.iter().map(|t| t.positions).collect::<Vec<_>>()),
    };
    let mesh = Mesh::new(parts.positions, normals, parts.triangles)?.with_faces(parts.faces)?;
    if !mesh.triangles().iter().any(|triangle| has_area(&mesh, triangle)) {
        return Err(SceneError::File {
            path: path.to_owned(),
            problem: "holds no face with an area, so nothing would be drawn".to_owned(),
            remedy: "give at least one face three corners that are not in a line".to_owned(),
        });
    }
    Ok(Loaded { mesh, files, warnings })
}

/// Whether every corner of every face names a normal; a warning if some do and others do not.
fn normals_are_whole(path: &Path, scan: &Scan, warnings: &mut Vec<String>) -> bool {
    let bare = scan.faces.iter().find(|face| face.corners.iter().any(|corner| corner.1.is_none()));
    let some = || scan.faces.iter().flat_map(|face| &face.corners).any(|corner| corner.1.is_some());
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

fn has_area(mesh: &Mesh, triangle: &MeshTriangle) -> bool {
    let [p, q, r] = triangle.positions.map(|i| mesh.positions()[i as usize]);
    (q - p).cross(r - p) != DVec3::ZERO
}

/// The mesh under construction. Equal positions become one, so that normals are smooth across the parts of a file.
#[derive(Default)]
struct Parts {
    positions: Vec<DVec3>,
    index_of: BTreeMap<[u64; 3], u32>,
    triangles: Vec<MeshTriangle>,
    faces: Vec<u32>,
}

impl Parts {
    fn place(&mut self, position: DVec3) -> u32 {
        // Adding zero turns -0 into 0, which is the same place.
        let key = (position + DVec3::ZERO).to_array().map(f64::to_bits);
        *self.index_of.entry(key).or_insert_with(|| {
            self.positions.push(position);
            self.positions.len() as u32 - 1
        })
    }
}

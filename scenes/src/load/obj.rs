//! OBJ files: polygons with normals and diffuse colours, and polylines with colours, become a mesh.
//!
//! [`super::obj_scan`] reads the lines, [`super::material`] those of MTL files.

use super::material::looks;
use super::mesh_file::Loaded;
use super::obj_scan::scan;
use super::obj_surface::surfaces;
use super::parts::{Built, Geometry};
use crate::error::SceneError;
use crate::input::{self, read_lines};
use crate::quote::shown;
use glam::DVec3;
use std::path::Path;

/// Reads a mesh; as a wireframe, it has the outlines of faces for lines.
pub(super) fn load(path: &Path, wireframe: bool) -> Result<Loaded, SceneError> {
    let bytes = read_lines(path, &input::MESH)?;
    // Names and comments may be in any encoding; what matters is ASCII.
    let scan = scan(path, &String::from_utf8_lossy(&bytes))?;
    let (mut files, mut warnings) = (vec![path.to_owned()], Vec::new());
    let lone = if wireframe { None } else { normals_are_missing(path, &scan.geometry) };
    warnings.extend(lone);
    let looks = looks(path, &scan, &mut files, &mut warnings)?;
    let colours: Vec<[f64; 3]> = looks.iter().map(|look| look.colour).collect();
    if wireframe {
        return Ok(Loaded { mesh: scan.geometry.wireframe(path, &colours)?, up: DVec3::Y, files, warnings });
    }
    let surfaces = surfaces(path, &looks, &mut files, &mut warnings);
    let Built { mesh, crossing } = scan.geometry.mesh(path, &colours, surfaces)?;
    warnings.extend(crossing_faces(path, &crossing));
    Ok(Loaded { mesh, up: DVec3::Y, files, warnings })
}

/// A warning if corners of some faces name a normal and others do not.
fn normals_are_missing(path: &Path, geometry: &Geometry) -> Option<String> {
    let corners = || geometry.faces.iter().flat_map(|face| face.corners.iter().map(move |corner| (face, corner)));
    let (face, _) = corners().find(|(_, corner)| corner.normal.is_none())?;
    corners().find(|(_, corner)| corner.normal.is_some())?;
    Some(format!(
        "{}:{}: this face has no normals and others have, so all normals are computed: export all or none",
        shown(path),
        face.place
    ))
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

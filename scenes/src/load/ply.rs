//! PLY files, as text and in both binary byte orders: polygons, strips and edges, with normals, colours and texture
//! coordinates.
//!
//! The format is Greg Turk's (Stanford, 1994), with MeshLab's convention for textures: `comment TextureFile name`, and
//! coordinates of vertices or, in a list `texcoord`, of corners. This is our own reader. The best maintained crate,
//! `ply-rs-bw`, stores every value under its name in a map, depends on a parser generator, and its messages take
//! several lines.

mod body;
mod elements;
mod header;

use super::lines::At;
use super::mesh_file::Loaded;
use super::parts::{Built, WHITE};
use super::surfaces::Surfaces;
use crate::error::SceneError;
use crate::input::{self, read_bytes};
use crate::material::Material;
use crate::quote::shown;
use crate::texture::file;
use body::Body;
use elements::Elements;
use glam::DVec3;
use header::Header;
use std::path::{Path, PathBuf};

pub(super) fn load(path: &Path, wireframe: bool) -> Result<Loaded, SceneError> {
    let bytes = read_bytes(path, &input::MESH)?;
    let header = Header::read(path, &bytes)?;
    let mut body = Body::new(path, &header, &bytes);
    let mut elements = Elements::default();
    for element in &header.elements {
        elements.read(element, &mut body, header.textures.len())?;
    }
    drop(bytes);
    let (mut files, mut warnings) = (vec![path.to_owned()], Vec::new());
    if !header.textures.is_empty() && elements.has_coordinates() && elements.without_colours() {
        warnings.push(format!(
            "{}: its colours are not drawn, as its textures are: remove those that are not to be",
            shown(path)
        ));
    } else if elements.is_transparent {
        warnings.push(format!(
            "{}: its colours are transparent in places, and drawn as opaque: make them opaque",
            shown(path)
        ));
    }
    let geometry = elements.geometry(path, &header)?;
    let colours = vec![WHITE; header.textures.len().max(1)];
    if wireframe {
        return Ok(Loaded { mesh: geometry.wireframe(path, &colours)?, up: DVec3::Y, files, warnings });
    }
    let surfaces = match geometry.coordinates.is_empty() {
        true => None,
        false => surfaces(path, &header, &mut files, &mut warnings),
    };
    let Built { mesh, crossing } = geometry.mesh(path, &colours, surfaces)?;
    warnings.extend(crossing_faces(path, &crossing));
    Ok(Loaded { mesh, up: DVec3::Y, files, warnings })
}

/// The file's textures, each of which is a material.
fn surfaces(path: &Path, header: &Header, files: &mut Vec<PathBuf>, warnings: &mut Vec<String>) -> Option<Surfaces> {
    let (mut materials, mut textures) = (Vec::new(), Vec::new());
    for (i, (line, name)) in (0..).zip(&header.textures) {
        let at = At { path, line: *line };
        let file = path.parent().unwrap_or(Path::new("")).join(name);
        let found = file::read(&file).map_err(|(problem, remedy)| at.error(problem, remedy));
        if let Ok(found) = &found {
            warnings.extend(found.notes.iter().map(|note| at.warning(note)));
        }
        if file.exists() {
            files.push(file);
        }
        textures.push(found.map(|found| found.texture));
        materials.push(Material { texture: Some(i), ..Material::default() });
    }
    if materials.is_empty() {
        materials.push(Material::default());
    }
    Surfaces::new(path, &materials, textures, warnings)
}

/// One warning for all faces with these numbers, which cross themselves.
fn crossing_faces(path: &Path, faces: &[usize]) -> Option<String> {
    let first = faces.first()?;
    let what = match faces.len() {
        1 => format!("face {first} crosses itself, so it is drawn roughly"),
        several => format!("face {first} and {} more cross themselves, so they are drawn roughly", several - 1),
    };
    Some(format!("{}: {what}: cut it where its edges meet", shown(path)))
}

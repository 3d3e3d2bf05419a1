//! OBJ files: polygons with normals and diffuse colours, and polylines with colours, become a mesh.
//!
//! [`super::obj_scan`] reads the lines, [`super::material`] those of MTL files.

use super::map::Placement;
use super::material::{Look, Picture, looks};
use super::mesh_file::Loaded;
use super::notes::Notes;
use super::obj_scan::{Scan, scan};
use super::obj_surface::surfaces;
use super::parts::{Built, Geometry, Polyline, WHITE, mean};
use super::shading;
use crate::error::SceneError;
use crate::input::{self, read_text};
use crate::quote::shown;
use glam::DVec3;
use std::path::Path;

/// Reads a mesh; as a wireframe, it has the outlines of faces as lines.
pub(super) fn load(path: &Path, wireframe: bool) -> Result<Loaded, SceneError> {
    load_with(path, wireframe, |_| {})
}

/// As [`load`], for a texture that replaces the mesh's own, and is placed by the file's coordinates.
pub(super) fn load_for_texture(path: &Path, wireframe: bool) -> Result<Loaded, SceneError> {
    load_with(path, wireframe, |picture| picture.placement = Placement::default())
}

fn load_with(path: &Path, wireframe: bool, change: impl FnMut(&mut Picture)) -> Result<Loaded, SceneError> {
    let mut scan = scan(path, &read_text(path, &input::MESH)?)?;
    let (mut files, mut warnings) = (vec![path.to_owned()], Vec::new());
    let mut looks = looks(path, &mut scan, &mut files, &mut warnings)?;
    looks.iter_mut().filter_map(|look| look.picture.as_mut()).for_each(change);
    let Scan { mut geometry, colours, groups, mut notes, .. } = scan;
    if !colours.is_empty() {
        take_colours(&mut geometry, &colours, &mut looks);
    }
    let colours: Vec<[f64; 3]> = looks.iter().map(|look| look.colour).collect();
    let mesh = if wireframe {
        geometry.wireframe(path, &colours)?
    } else {
        note_unmapped(&geometry, &looks, &mut notes);
        let surfaces = surfaces(path, &looks, &mut geometry, &mut files, &mut warnings);
        shading::complete(&mut geometry, &groups, &mut notes);
        let Built { mesh, crossing } = geometry.mesh(path, &colours, surfaces)?;
        warnings.extend(crossing_faces(path, &crossing));
        mesh
    };
    warnings.extend(notes.warnings(path));
    Ok(Loaded { mesh, up: DVec3::Y, files, warnings })
}

/// Gives corners and lines the colours of their vertices, which multiply those of materials. Anything with such colours
/// and no material gets a white one.
fn take_colours(geometry: &mut Geometry, colours: &[Option<DVec3>], looks: &mut Vec<Look>) {
    let tint = |vertex: u32| colours.get(vertex as usize).copied().flatten().map(|colour| colour.to_array());
    let white = looks.len();
    looks.push(Look { colour: WHITE, ..Look::default() });
    geometry.colours = colours.iter().map(|colour| colour.map_or(WHITE, |colour| colour.to_array())).collect();
    for face in &mut geometry.faces {
        for corner in &mut face.corners {
            corner.colour = tint(corner.vertex).map(|_| corner.vertex);
        }
        if face.corners.iter().any(|corner| corner.colour.is_some()) {
            face.material.get_or_insert(white);
        }
    }
    // Each segment has the mean of its ends.
    let segments = std::mem::take(&mut geometry.lines).into_iter().flat_map(|line| {
        let pairs: Vec<[u32; 2]> = line.vertices.array_windows().copied().collect();
        pairs.into_iter().map(move |ends| (line.material, ends))
    });
    geometry.lines = segments
        .map(|(material, ends)| {
            let tints = ends.map(tint);
            let has_tints = tints.iter().any(Option::is_some);
            let material = material.or(has_tints.then_some(white));
            let tint = mean(tints.into_iter().map(|tint| tint.unwrap_or(WHITE)));
            Polyline { material, tint, vertices: ends.to_vec() }
        })
        .collect();
}

/// A note about faces that have a texture, but no coordinates for it.
fn note_unmapped(geometry: &Geometry, looks: &[Look], notes: &mut Notes) {
    for face in &geometry.faces {
        let has_texture = face.material.is_some_and(|material| looks[material].picture.is_some());
        if has_texture && face.corners.iter().any(|corner| corner.texture.is_none()) {
            let problem =
                || "this face has no texture coordinates, so the texture of its material is not drawn on it".to_owned();
            notes.add("unmapped", face.place, problem, "export the mesh with them (`vt`)");
        }
    }
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

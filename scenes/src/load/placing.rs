//! The placement of an OBJ mesh's textures by the options of `map_Kd`: their coordinates are moved before the mesh is
//! made.

use super::map::Placement;
use super::material::Look;
use super::parts::Geometry;
use super::surfaces::Read;
use crate::deferred::MOST_REPEATS;
use crate::quote::shown;
use crate::texture::Window;
use glam::DVec2;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// A texture of each material, by index; and which of them appear only once.
pub(super) struct Textures<'a> {
    pub(super) looks: &'a [Look],
    pub(super) of_look: &'a [Option<u32>],
    pub(super) textures: &'a mut [Read],
}

/// A coordinate that has been moved, and its texture if that appears only once.
struct Moved {
    index: u32,
    clamped: Option<u32>,
}

impl Textures<'_> {
    /// Gives the corners of faces coordinates of their own where a texture's placement differs from the file's
    /// coordinates. Warns about anything drawn differently.
    pub(super) fn place(&mut self, path: &Path, geometry: &mut Geometry, warnings: &mut Vec<String>) {
        let mut moved: BTreeMap<(usize, u32), Moved> = BTreeMap::new();
        let mut stretched: Vec<usize> = Vec::new();
        let Geometry { faces, coordinates, .. } = geometry;
        for face in faces {
            let Some(look) = face.material.filter(|&look| self.of_look.get(look).is_some_and(Option::is_some)) else {
                continue;
            };
            let Some(picture) = &self.looks[look].picture else { continue };
            if face.corners.iter().any(|corner| corner.texture.is_none()) {
                continue;
            }
            let placement = &picture.placement;
            if *placement != Placement::default() {
                for corner in face.corners.iter_mut().filter_map(|corner| corner.texture.as_mut()) {
                    let entry = moved.entry((look, *corner)).or_insert_with(|| {
                        coordinates.push(coordinates[*corner as usize] * placement.scale + placement.offset);
                        let clamped = self.of_look[look].filter(|_| placement.is_clamped);
                        Moved { index: coordinates.len() as u32 - 1, clamped }
                    });
                    *corner = entry.index;
                }
            }
            let all = || face.corners.iter().filter_map(|corner| corner.texture).map(|i| coordinates[i as usize]);
            let least = all().fold(DVec2::INFINITY, DVec2::min).floor();
            if !placement.is_clamped
                && (all().fold(DVec2::NEG_INFINITY, DVec2::max) - least).max_element() > MOST_REPEATS
            {
                stretched.push(face.place);
            }
        }
        let mut clamped: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        moved
            .values()
            .for_each(|moved| clamped.entry(moved.clamped.unwrap_or(u32::MAX)).or_default().push(moved.index));
        for (texture, indices) in clamped {
            if let Some(Ok(texture)) = self.textures.get_mut(texture as usize) {
                warnings.extend(clamp(path, texture, coordinates, &indices));
            }
        }
        if let Some(line) = stretched.first() {
            let more = if stretched.len() > 1 { ", and so on in others" } else { "" };
            warnings.push(format!(
                "{}:{line}: the texture repeats more than {MOST_REPEATS} times over this face, so it is stretched{more}: cut the face",
                shown(path)
            ));
        }
    }
}

/// Makes a larger texture from one that appears only once, if these coordinates reach beyond it. The colours of its
/// edges fill the rest.
fn clamp(
    path: &Path,
    texture: &mut Arc<crate::texture::Texture>,
    coordinates: &mut [DVec2],
    indices: &[u32],
) -> Option<String> {
    let reached = || indices.iter().map(|&i| coordinates[i as usize]);
    let least = reached().fold(DVec2::ZERO, DVec2::min);
    let most = reached().fold(DVec2::ONE, DVec2::max);
    if least == DVec2::ZERO && most == DVec2::ONE {
        return None;
    }
    let remedy = "bring texture coordinates (vt) nearer to 0 to 1";
    let Some(window) = Window::round(least, most, texture) else {
        return Some(format!(
            "{}: a texture with `-clamp on` is reached too far beyond its edges, so it repeats: {remedy}",
            shown(path)
        ));
    };
    let (found, kept) = (texture.level(), window.level(texture));
    *texture = Arc::new(texture.within(&window));
    indices.iter().for_each(|&i| coordinates[i as usize] = window.place(coordinates[i as usize]));
    (kept < found).then(|| {
        format!(
            "{}: a texture with `-clamp on` has {} in place of {} texels a side, as faces reach beyond its edges: {remedy}",
            shown(path),
            1 << kept,
            1 << found
        )
    })
}

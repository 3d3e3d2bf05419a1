//! Computes missing normals of corners from the surrounding faces in the same smoothing group.

use super::faces::cut;
use super::notes::Notes;
use super::parts::{Face, Geometry};
use crate::mesh::unit_or_z;
use crate::wireframe::place;
use glam::DVec3;
use std::collections::BTreeMap;

/// Gives each corner a normal. Does nothing if no corner has one and all faces are in one smoothing group, so that each
/// position has one normal. Returns a note if only some corners have normals. Groups are by face, 0 for none.
pub(super) fn complete(geometry: &mut Geometry, groups: &[u32], notes: &mut Notes) {
    let has_any = geometry.faces.iter().flat_map(|face| &face.corners).any(|corner| corner.normal.is_some());
    let is_one_group = groups.iter().all(|&group| group > 0 && group == groups[0]);
    if !has_any && is_one_group {
        return;
    }
    let Geometry { positions, normals, faces, .. } = geometry;
    let mut computed = Computed { own: normals.len() as u32, index_of: BTreeMap::new(), sums: Vec::new() };
    for (face, &group) in faces.iter_mut().zip(groups) {
        if face.corners.iter().all(|corner| corner.normal.is_some()) {
            continue;
        }
        if has_any {
            let problem = || "this face has no normals and others have, so its normals are computed".to_owned();
            notes.add("normals", face.place, problem, "export all or none");
        }
        computed.take(face, group, positions);
    }
    normals.extend(computed.sums.into_iter().map(unit_or_z));
}

/// Normals under construction, which are stored behind those of the file.
struct Computed {
    /// The number of normals in the file.
    own: u32,
    /// By position and smoothing group.
    index_of: BTreeMap<([u64; 3], u32), u32>,
    sums: Vec<DVec3>,
}

impl Computed {
    /// Adds a face; as in [`crate::smooth_normals`], it is weighted by area.
    fn take(&mut self, face: &mut Face, group: u32, positions: &[DVec3]) {
        let corners: Vec<DVec3> = face.corners.iter().map(|corner| positions[corner.vertex as usize]).collect();
        let at: Vec<u32> = match group {
            0 => vec![self.next(); corners.len()],
            _ => corners.iter().map(|&corner| self.at(corner, group)).collect(),
        };
        for triangle in cut(&corners).triangles {
            let [p, q, r] = triangle.map(|i| corners[i]);
            let twice_area = (q - p).cross(r - p);
            // All corners of a flat face share one.
            let of = if group == 0 { &triangle[..1] } else { &triangle[..] };
            of.iter().for_each(|&i| self.sums[at[i] as usize] += twice_area);
        }
        for (corner, at) in face.corners.iter_mut().zip(at) {
            corner.normal.get_or_insert(self.own + at);
        }
    }

    fn at(&mut self, position: DVec3, group: u32) -> u32 {
        let key = (place(position), group);
        if let Some(&index) = self.index_of.get(&key) {
            return index;
        }
        let index = self.next();
        self.index_of.insert(key, index);
        index
    }

    fn next(&mut self) -> u32 {
        self.sums.push(DVec3::ZERO);
        self.sums.len() as u32 - 1
    }
}

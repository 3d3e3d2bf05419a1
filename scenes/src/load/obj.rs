//! OBJ files: polygons with normals and diffuse colours become a mesh.
//!
//! [`super::obj_scan`] checks the lines, the crate `tobj` resolves the indices and cuts polygons into fans. Each triangle of a fan
//! counts as a polygon, in the file's order.

use super::material::{GREY, plain_materials};
use super::obj_scan::scan;
use crate::SceneError;
use crate::input::read_bytes;
use crate::mesh::{Mesh, MeshTriangle, smooth_normals};
use glam::DVec3;
use std::collections::BTreeMap;
use std::path::Path;

/// A mesh, and what was odd about its files.
pub(super) struct Loaded {
    pub(super) mesh: Mesh,
    pub(super) warnings: Vec<String>,
}

pub(super) fn load(path: &Path) -> Result<Loaded, SceneError> {
    let bytes = read_bytes(path, super::READ_REMEDY)?;
    // Names and comments may be in any encoding; what matters is ASCII.
    let scan = scan(path, &String::from_utf8_lossy(&bytes))?;
    let mut warnings = Vec::new();
    if let Some(line) = scan.mixed_at {
        warnings.push(format!(
            "{}:{line}: this face has no normals and others have, so all normals are computed: export all or none",
            path.display()
        ));
    }
    let materials = plain_materials(path, &scan, &mut warnings)?;
    let text = format!("mtllib plain\n{}", scan.plain);
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let unsound = |error: &dyn std::fmt::Display| SceneError::File {
        path: path.to_owned(),
        problem: format!("is not a sound OBJ file ({error})"),
        remedy: "export the mesh again".to_owned(),
    };
    let (models, materials) =
        tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| tobj::load_mtl_buf(&mut materials.as_bytes()))
            .map_err(|error| unsound(&error))?;
    let materials = materials.map_err(|error| unsound(&error))?;
    let mut parts = Parts::default();
    for model in &models {
        let material = model.mesh.material_id.and_then(|id| materials.get(id));
        let diffuse = material.and_then(|m| m.diffuse).unwrap_or(GREY);
        parts.add(&model.mesh, diffuse);
    }
    let mesh = parts.into_mesh(scan.has_normals).map_err(|error| unsound(&error))?;
    if !mesh.triangles().iter().any(|triangle| has_area(&mesh, triangle)) {
        return Err(SceneError::File {
            path: path.to_owned(),
            problem: "holds no face with an area, so nothing would be drawn".to_owned(),
            remedy: "give at least one face three corners that are not in a line".to_owned(),
        });
    }
    Ok(Loaded { mesh, warnings })
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
    normals: Vec<DVec3>,
    triangles: Vec<MeshTriangle>,
}

impl Parts {
    fn add(&mut self, part: &tobj::Mesh, diffuse: [f64; 3]) {
        let places: Vec<u32> =
            part.positions.chunks_exact(3).map(|p| self.place(DVec3::new(p[0], p[1], p[2]))).collect();
        let first_normal = self.normals.len() as u32;
        let vectors = part.normals.chunks_exact(3);
        self.normals.extend(vectors.map(|n| DVec3::new(n[0], n[1], n[2])));
        let mut normals = part.normal_indices.chunks_exact(3);
        for corners in part.indices.chunks_exact(3) {
            let at = |i: usize| places[corners[i] as usize];
            let normals = normals.next().unwrap_or(&[0; 3]);
            self.triangles.push(MeshTriangle {
                positions: [at(0), at(1), at(2)],
                normals: [0, 1, 2].map(|i: usize| first_normal + normals[i]),
                diffuse,
            });
        }
    }

    fn place(&mut self, position: DVec3) -> u32 {
        // Adding zero turns -0 into 0, which is the same place.
        let key = (position + DVec3::ZERO).to_array().map(f64::to_bits);
        *self.index_of.entry(key).or_insert_with(|| {
            self.positions.push(position);
            self.positions.len() as u32 - 1
        })
    }

    fn into_mesh(mut self, has_normals: bool) -> Result<Mesh, SceneError> {
        if !has_normals {
            let corners: Vec<_> = self.triangles.iter().map(|t| t.positions).collect();
            self.normals = smooth_normals(&self.positions, &corners);
            for triangle in &mut self.triangles {
                triangle.normals = triangle.positions;
            }
        }
        Mesh::new(self.positions, self.normals, self.triangles)
    }
}

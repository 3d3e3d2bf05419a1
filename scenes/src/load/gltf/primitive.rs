//! The primitives of a glTF file's meshes: triangles and lines in world space.

use super::Oddities;
use super::buffers::Buffers;
use super::colour::encoded;
use super::container::File;
use super::looks::Looks;
use super::nodes::Placed;
use crate::error::SceneError;
use crate::load::parts::{Corner, Face, Geometry, Polyline, WHITE, mean};
use glam::{DMat3, DMat4, DVec3};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index};

/// The most faces and lines of a file, and the most vertices, including repetitions by nodes.
const MOST: usize = 4 << 20;

/// Everything that has been added.
#[derive(Default)]
pub(super) struct Primitives {
    pub(super) geometry: Geometry,
}

/// The number of vertices before a primitive's, which offsets its indices.
struct First {
    position: u32,
    normal: Option<u32>,
    texture: Option<u32>,
    colour: Option<u32>,
}

impl Primitives {
    /// Adds a mesh at its node's place.
    pub(super) fn add(
        &mut self,
        file: &File,
        buffers: &mut Buffers,
        looks: &Looks,
        placed: &Placed,
        oddities: &mut Oddities,
    ) -> Result<(), SceneError> {
        let mesh = &file.root.meshes[placed.mesh];
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            let name = format!("meshes[{}].primitives[{i}]", placed.mesh);
            let Checked::Valid(mode) = primitive.mode else {
                continue;
            };
            if mode == Mode::Points {
                oddities.add("its points are not drawn");
                continue;
            }
            let positions = buffers.vectors::<3>(
                attribute(primitive, Semantic::Positions)
                    .ok_or_else(|| file.wrong(&format!("{name} has no positions"), "export it again"))?,
                None,
            )?;
            let indices = match primitive.indices {
                Some(indices) => buffers.indices(indices)?,
                None => (0..positions.len() as u32).collect(),
            };
            if let Some(index) = indices.iter().find(|&&index| index as usize >= positions.len()) {
                let problem = format!("{name} names vertex {index}, and has {}", positions.len());
                return Err(file.wrong(&problem, "export it again"));
            }
            let (corners, left_over) = elements(mode, &indices);
            if left_over > 0 {
                oddities.add("its indices that make no whole triangle or line are left out");
            }
            let drawn = self.geometry.faces.len() + self.geometry.lines.len() + corners.len();
            if drawn.max(self.geometry.positions.len() + positions.len()) > MOST {
                return Err(file.wrong(
                    "draws more than 4194304 faces and lines, or has as many vertices",
                    "simplify the meshes, or have fewer nodes",
                ));
            }
            let first = self.vertices(file, buffers, looks, primitive, placed, &positions, &name, oddities)?;
            self.elements(&corners, &first, looks.index(primitive.material));
        }
        Ok(())
    }

    /// Adds the attributes of a primitive's vertices.
    #[expect(clippy::too_many_arguments, reason = "a primitive in its file")]
    fn vertices(
        &mut self,
        file: &File,
        buffers: &mut Buffers,
        looks: &Looks,
        primitive: &Primitive,
        placed: &Placed,
        positions: &[[f64; 3]],
        name: &str,
        oddities: &mut Oddities,
    ) -> Result<First, SceneError> {
        let count = positions.len();
        let whole = |length: usize, what: &str| match length < count {
            true => Err(file.wrong(&format!("{name} has {length} {what} for {count} positions"), "export it again")),
            false => Ok(()),
        };
        let geometry = &mut self.geometry;
        let position = geometry.positions.len() as u32;
        for &at in positions {
            let at = placed.to_world.transform_point3(DVec3::from_array(at));
            if !at.abs().cmplt(DVec3::splat(1e30)).all() {
                let problem = format!("nodes[{}] puts a vertex at {:?}", placed.node, at.to_array());
                return Err(file.wrong(&problem, "give finite numbers below 1e30"));
            }
            geometry.positions.push(at);
        }
        let mut first = First { position, normal: None, texture: None, colour: None };
        if let Some(normals) = attribute(primitive, Semantic::Normals) {
            let normals = buffers.vectors::<3>(normals, None)?;
            whole(normals.len(), "normals")?;
            let turn = of_normals(placed.to_world);
            first.normal = Some(geometry.normals.len() as u32);
            geometry.normals.extend(normals.iter().map(|&normal| bounded(turn * DVec3::from_array(normal))));
        }
        if let Some(mapping) = looks.mapping(looks.index(primitive.material)) {
            match attribute(primitive, Semantic::TexCoords(mapping.set)) {
                Some(coordinates) => {
                    let coordinates = buffers.vectors::<2>(coordinates, None)?;
                    whole(coordinates.len(), "texture coordinates")?;
                    first.texture = Some(geometry.coordinates.len() as u32);
                    let mapped = coordinates.iter().map(|&coordinate| mapping.of(coordinate));
                    geometry.coordinates.extend(mapped);
                    let mapped = &geometry.coordinates[first.texture.unwrap_or(0) as usize..];
                    let inside = mapped.iter().all(|at| (0.0..=1.0).contains(&at.x) && (0.0..=1.0).contains(&at.y));
                    if !mapping.repeats && !inside {
                        oddities.add("its textures that end at their edges, or are mirrored there, go on repeating");
                    }
                }
                None => {
                    oddities.add("its primitives without the texture coordinates of their material have no texture")
                }
            }
        }
        if let Some(colours) = attribute(primitive, Semantic::Colors(0)) {
            let colours: Vec<[f64; 3]> = match buffers.width(colours) {
                4 => buffers.vectors::<4>(colours, None)?.into_iter().map(|[r, g, b, _]| [r, g, b]).collect(),
                _ => buffers.vectors::<3>(colours, None)?,
            };
            whole(colours.len(), "colours")?;
            first.colour = Some(geometry.colours.len() as u32);
            geometry.colours.extend(colours.iter().map(|colour| colour.map(encoded)));
        }
        Ok(first)
    }

    /// Adds triangles and lines with these corners.
    fn elements(&mut self, corners: &[Vec<u32>], first: &First, material: usize) {
        let material = Some(material);
        for element in corners {
            let geometry = &mut self.geometry;
            if let [p, q] = element[..] {
                let tint = match first.colour {
                    Some(first) => mean([p, q].into_iter().map(|i| geometry.colours[(first + i) as usize])),
                    None => WHITE,
                };
                let vertices = [p, q].map(|i| first.position + i).to_vec();
                geometry.lines.push(Polyline { material, tint, vertices });
                continue;
            }
            // Without normals a face is flat.
            let flat = geometry.normals.len() as u32;
            if first.normal.is_none() {
                let [p, q, r] = [0, 1, 2].map(|i| geometry.positions[(first.position + element[i]) as usize]);
                geometry.normals.push((q - p).cross(r - p));
            }
            let corner = |&i: &u32| Corner {
                vertex: first.position + i,
                texture: first.texture.map(|first| first + i),
                normal: Some(first.normal.map_or(flat, |first| first + i)),
                colour: first.colour.map(|first| first + i),
            };
            let place = geometry.faces.len() + 1;
            geometry.faces.push(Face { place, material, corners: element.iter().map(corner).collect() });
        }
    }
}

pub(super) fn attribute(primitive: &Primitive, semantic: Semantic) -> Option<Index<Accessor>> {
    primitive.attributes.get(&Checked::Valid(semantic)).copied()
}

/// The triangles or lines that such indices make, and the number of indices left over.
fn elements(mode: Mode, indices: &[u32]) -> (Vec<Vec<u32>>, usize) {
    let pieces = |size: usize| (indices.chunks_exact(size).map(<[u32]>::to_vec).collect(), indices.len() % size);
    let least = |least: usize| if indices.len() < least { indices.len() } else { 0 };
    match mode {
        Mode::Points => (Vec::new(), 0),
        Mode::Triangles => pieces(3),
        Mode::Lines => pieces(2),
        Mode::LineStrip => (indices.array_windows::<2>().map(|line| line.to_vec()).collect(), least(2)),
        Mode::LineLoop => {
            let ends = indices.iter().zip(indices.iter().cycle().skip(1));
            let lines = if indices.len() < 2 { Vec::new() } else { ends.map(|(&p, &q)| vec![p, q]).collect() };
            (lines, least(2))
        }
        Mode::TriangleStrip => {
            // Every second triangle has the opposite direction.
            let triangle = |(i, &[p, q, r]): (usize, &[u32; 3])| if i % 2 == 0 { vec![p, q, r] } else { vec![p, r, q] };
            (indices.array_windows().enumerate().map(triangle).collect(), least(3))
        }
        Mode::TriangleFan => {
            let edges = indices.get(1..).unwrap_or_default().array_windows::<2>();
            (edges.map(|&[q, r]| vec![indices[0], q, r]).collect(), least(3))
        }
    }
}

/// The transform of normals: the cofactors of the matrix, which are its transposed inverse times its determinant. So a
/// normal stays on its face's side, even if the transform mirrors.
fn of_normals(to_world: DMat4) -> DMat3 {
    let [x, y, z] = [to_world.x_axis, to_world.y_axis, to_world.z_axis].map(|axis| axis.truncate());
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y))
}

/// A direction of any length, for huge scales whose products overflow.
fn bounded(normal: DVec3) -> DVec3 {
    if normal.abs().cmplt(DVec3::splat(1e99)).all() { normal } else { DVec3::ZERO }
}

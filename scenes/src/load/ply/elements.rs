//! The elements of a PLY file that are drawn: vertices, faces, strips of triangles, and edges.

use super::super::parts::{Corner, Face, Geometry, Polyline, WHITE, mean};
use super::body::{Body, Of};
use super::header::{Element, Header, Kind, Property};
use crate::error::SceneError;
use crate::quote::quote;
use glam::{DVec2, DVec3, dvec2};
use std::path::Path;

/// The most corners of a face, as in an OBJ file.
const MOST_CORNERS: f64 = 16_384.0;

/// The meaning of a value in a vertex, a face or an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    Position(usize),
    Normal(usize),
    Colour(usize),
    Alpha,
    Coordinate(usize),
    /// Corners of a face or a strip.
    Corners,
    /// Texture coordinates of a face's corners.
    CornerCoordinates,
    /// The number of a face's texture.
    Texture,
    /// An end of an edge.
    End(usize),
    None,
}

fn role(element: &str, property: &Property) -> Role {
    match (element, property.name.as_str(), property.list.is_some()) {
        ("face" | "tristrips", "vertex_indices" | "vertex_index", true) => Role::Corners,
        ("face", "texcoord", true) => Role::CornerCoordinates,
        (_, _, true) => Role::None,
        ("vertex", "x", _) => Role::Position(0),
        ("vertex", "y", _) => Role::Position(1),
        ("vertex", "z", _) => Role::Position(2),
        ("vertex", "nx", _) => Role::Normal(0),
        ("vertex", "ny", _) => Role::Normal(1),
        ("vertex", "nz", _) => Role::Normal(2),
        ("vertex", "s" | "u" | "texture_u" | "texture_s", _) => Role::Coordinate(0),
        ("vertex", "t" | "v" | "texture_v" | "texture_t", _) => Role::Coordinate(1),
        ("vertex" | "face" | "edge", "red" | "r" | "diffuse_red", _) => Role::Colour(0),
        ("vertex" | "face" | "edge", "green" | "g" | "diffuse_green", _) => Role::Colour(1),
        ("vertex" | "face" | "edge", "blue" | "b" | "diffuse_blue", _) => Role::Colour(2),
        ("vertex" | "face" | "edge", "alpha" | "a", _) => Role::Alpha,
        ("face", "texnumber", _) => Role::Texture,
        ("edge", "vertex1", _) => Role::End(0),
        ("edge", "vertex2", _) => Role::End(1),
        _ => Role::None,
    }
}

/// The values of one element.
#[derive(Default)]
struct Item {
    position: DVec3,
    normal: DVec3,
    colour: [f64; 3],
    coordinate: DVec2,
    corners: Vec<f64>,
    corner_coordinates: Vec<f64>,
    texture: Option<f64>,
    ends: [f64; 2],
}

/// The values that elements of a kind have.
#[derive(Clone, Copy, Default)]
struct Has {
    normals: bool,
    colours: bool,
    coordinates: bool,
}

/// A face before its corners are looked up: with a colour and texture coordinates of its own, if it has any.
struct Raw {
    number: u64,
    corners: Vec<f64>,
    coordinates: Vec<f64>,
    colour: Option<[f64; 3]>,
    texture: Option<f64>,
}

/// Everything that is drawn. Faces may come before the vertices that they refer to.
#[derive(Default)]
pub(super) struct Elements {
    vertices: Has,
    geometry: Geometry,
    faces: Vec<Raw>,
    edges: Vec<(u64, [f64; 2], Option<[f64; 3]>)>,
    pub(super) is_transparent: bool,
}

impl Elements {
    /// Reads one kind of element from the body, or skips it.
    pub(super) fn read(&mut self, element: &Element, body: &mut Body, textures: usize) -> Result<(), SceneError> {
        if element.properties.is_empty() {
            return Ok(());
        }
        let roles: Vec<Role> = element.properties.iter().map(|property| role(&element.name, property)).collect();
        let all = |of: fn(usize) -> Role, count: usize| (0..count).all(|axis| roles.contains(&of(axis)));
        let has =
            Has { normals: all(Role::Normal, 3), colours: all(Role::Colour, 3), coordinates: all(Role::Coordinate, 2) };
        if element.name == "vertex" {
            self.vertices = has;
        }
        for number in 1..=element.count {
            let of = Of { name: &element.name, number, count: element.count };
            let item = self.item(element, &roles, body, of)?;
            self.take(item, has, body, of, textures)?;
        }
        Ok(())
    }

    fn item(&mut self, element: &Element, roles: &[Role], body: &mut Body, of: Of) -> Result<Item, SceneError> {
        let mut item = Item::default();
        for (property, &role) in element.properties.iter().zip(roles) {
            if let Some(length) = property.list {
                let length = body.number(length, of)?;
                if role == Role::Corners && of.name == "face" && length > MOST_CORNERS {
                    return Err(body.error(of, "has more than 16384 corners", "cut it"));
                }
                // A negative length means no entries.
                for _ in 0..length as u64 {
                    let value = body.number(property.kind, of)?;
                    match role {
                        Role::Corners => item.corners.push(value),
                        Role::CornerCoordinates => item.corner_coordinates.push(value),
                        _ => continue,
                    }
                    if is_out_of_reach(value) {
                        return Err(out_of_reach(body, of, property, value));
                    }
                }
                continue;
            }
            let value = body.number(property.kind, of)?;
            let whole = scale(property.kind);
            match role {
                Role::Position(axis) => item.position[axis] = value,
                Role::Normal(axis) => item.normal[axis] = value,
                Role::Coordinate(axis) => item.coordinate[axis] = value,
                Role::Colour(channel) => item.colour[channel] = (value / whole).clamp(0.0, 1.0),
                Role::Alpha => self.is_transparent |= value < whole,
                Role::Texture => item.texture = Some(value),
                Role::End(end) => item.ends[end] = value,
                _ => continue,
            }
            if is_out_of_reach(value) {
                return Err(out_of_reach(body, of, property, value));
            }
        }
        Ok(item)
    }

    fn take(&mut self, item: Item, has: Has, body: &Body, of: Of, textures: usize) -> Result<(), SceneError> {
        let colour = has.colours.then_some(item.colour);
        match of.name {
            "vertex" => {
                self.geometry.positions.push(item.position);
                self.geometry.normals.extend(has.normals.then_some(item.normal));
                self.geometry.coordinates.extend(has.coordinates.then_some(item.coordinate));
                self.geometry.colours.extend(colour);
            }
            "face" => {
                if !item.corner_coordinates.is_empty() && item.corner_coordinates.len() != 2 * item.corners.len() {
                    let problem = format!("has {} numbers for `texcoord`", item.corner_coordinates.len());
                    return Err(body.error(of, &problem, "give two to each corner"));
                }
                if item.texture.is_some_and(|texture| textures > 0 && !(0.0..textures as f64).contains(&texture)) {
                    return Err(body.error(of, "names a texture that the header does not", "correct `texnumber`"));
                }
                if item.corners.len() < 3 {
                    return Err(body.error(of, "has fewer than three corners", "remove it, or write it as an edge"));
                }
                let Item { corners, corner_coordinates: coordinates, texture, .. } = item;
                self.faces.push(Raw { number: of.number, corners, coordinates, colour, texture });
            }
            "tristrips" => self.strips(&item.corners),
            "edge" => self.edges.push((of.number, item.ends, colour)),
            _ => {}
        }
        Ok(())
    }

    /// Strips of triangles, which -1 ends; every second triangle has the opposite direction.
    fn strips(&mut self, corners: &[f64]) {
        for strip in corners.split(|&corner| corner < 0.0) {
            for (i, &[p, q, r]) in strip.array_windows().enumerate() {
                let corners = if i % 2 == 0 { vec![p, q, r] } else { vec![q, p, r] };
                let number = self.faces.len() as u64 + 1;
                self.faces.push(Raw { number, corners, coordinates: Vec::new(), colour: None, texture: None });
            }
        }
    }

    /// Drops the colours where there are textures: a scan has both, and their product would be too dark.
    pub(super) fn without_colours(&mut self) -> bool {
        let had = self.vertices.colours || self.faces.iter().any(|face| face.colour.is_some());
        self.vertices.colours = false;
        self.geometry.colours.clear();
        self.faces.iter_mut().for_each(|face| face.colour = None);
        had
    }

    pub(super) fn has_coordinates(&self) -> bool {
        self.vertices.coordinates || self.faces.iter().any(|face| !face.coordinates.is_empty())
    }

    /// Faces and edges with the vertices that they name.
    pub(super) fn geometry(self, path: &Path, header: &Header) -> Result<Geometry, SceneError> {
        let Elements { vertices, mut geometry, faces, edges, .. } = self;
        let file = |problem: String, remedy: &str| SceneError::File {
            path: path.to_owned(),
            problem,
            remedy: remedy.to_owned(),
        };
        if faces.is_empty() && edges.is_empty() {
            return Err(file("holds no face and no edge, and points are not drawn".to_owned(), "export it as a mesh"));
        }
        let count = geometry.positions.len();
        let vertex = |what: &str, number: u64, index: f64| match (0.0..count as f64).contains(&index) {
            true => Ok(index as u32),
            false => Err(file(
                format!("{what} {number} names vertex {index}, and there are {count}, counted from 0"),
                "export it again",
            )),
        };
        // The attributes that corners refer to, besides their vertices.
        let tints = geometry.colours.len();
        for face in faces {
            let own_colour = face.colour.filter(|_| tints == 0).map(|colour| {
                geometry.colours.push(colour);
                geometry.colours.len() as u32 - 1
            });
            let first = geometry.coordinates.len() as u32;
            let is_mapped = !face.coordinates.is_empty();
            geometry.coordinates.extend(face.coordinates.as_chunks().0.iter().map(|&[u, v]| dvec2(u, v)));
            let corner = |(i, &index): (usize, &f64)| {
                let vertex = vertex("face", face.number, index)?;
                Ok(Corner {
                    vertex,
                    texture: if is_mapped { Some(first + i as u32) } else { vertices.coordinates.then_some(vertex) },
                    normal: vertices.normals.then_some(vertex),
                    colour: own_colour.or(vertices.colours.then_some(vertex)),
                })
            };
            let corners: Vec<Corner> =
                face.corners.iter().enumerate().map(corner).collect::<Result<_, SceneError>>()?;
            // Without a colour and a texture it is grey.
            let is_plain = corners[0].colour.is_none() && header.textures.is_empty();
            let material = if is_plain { None } else { Some(face.texture.map_or(0, |texture| texture as usize)) };
            let material = material.map(|material| if header.textures.is_empty() { 0 } else { material });
            geometry.faces.push(Face { place: face.number as usize, material, corners });
        }
        for (number, ends, colour) in edges {
            let ends = [vertex("edge", number, ends[0])?, vertex("edge", number, ends[1])?];
            let of_ends = vertices.colours.then(|| mean(ends.iter().map(|&end| geometry.colours[end as usize])));
            let tint = colour.or(of_ends);
            let material = tint.map(|_| 0);
            geometry.lines.push(Polyline { material, tint: tint.unwrap_or(WHITE), vertices: ends.to_vec() });
        }
        Ok(geometry)
    }
}

fn is_out_of_reach(value: f64) -> bool {
    value.is_nan() || value.abs() >= 1e30
}

fn out_of_reach(body: &Body, of: Of, property: &Property, value: f64) -> SceneError {
    body.error(of, &format!("has {value} for {}", quote(&property.name)), "give finite numbers below 1e30")
}

/// The greatest value of a colour of that type.
fn scale(kind: Kind) -> f64 {
    match kind {
        Kind::F32 | Kind::F64 => 1.0,
        Kind::U16 | Kind::I16 => 65535.0,
        _ => 255.0,
    }
}

//! STL files, as text and in binary: facets, flat, with the colours that two programs store in binary ones.
//!
//! The format is 3D Systems' (1988). A facet is lit by the normal of its three corners, not by the one that the file
//! states, because many programs write zeros there. This is our own reader: the crate `stl_io` reports no positions and
//! drops colours.

use super::lines::At;
use super::mesh_file::Loaded;
use super::numbers::numbers;
use super::parts::{Corner, Face, GREY, Geometry, WHITE};
use crate::error::SceneError;
use crate::input::{self, read_bytes, read_lines};
use crate::quote::{quote, shown};
use glam::{DVec3, dvec3};
use std::path::Path;

/// The size of a binary file's header, whose last four bytes are the number of facets; and the size of a facet.
const HEADER: usize = 84;
const FACET: usize = 50;

/// Corners, the stated normal, and a colour.
struct Facet {
    corners: [DVec3; 3],
    normal: DVec3,
    colour: Option<[f64; 3]>,
}

pub(super) fn load(path: &Path, wireframe: bool) -> Result<Loaded, SceneError> {
    let bytes = read_bytes(path, &input::MESH)?;
    let facets = if is_text(&bytes) {
        drop(bytes);
        text(path, &String::from_utf8_lossy(&read_lines(path, &input::MESH)?))?
    } else {
        binary(path, &bytes)?
    };
    let warnings = contradicting(path, &facets).into_iter().collect();
    let geometry = geometry(&facets);
    let mesh = match wireframe {
        true => geometry.wireframe(path, &[WHITE])?,
        false => geometry.mesh(path, &[WHITE], None)?.mesh,
    };
    Ok(Loaded { mesh, up: DVec3::Z, files: vec![path.to_owned()], warnings })
}

/// Binary files may begin with `solid`, too. Then their length decides, or a zero byte, which their header has.
fn is_text(bytes: &[u8]) -> bool {
    let begins = bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    begins && facet_count(bytes).is_none_or(|count| bytes.len() != HEADER + FACET * count) && !bytes.contains(&0)
}

/// The number of facets that a binary file states.
fn facet_count(bytes: &[u8]) -> Option<usize> {
    Some(u32::from_le_bytes(*bytes.get(HEADER - 4..HEADER)?.as_array()?) as usize)
}

fn binary(path: &Path, bytes: &[u8]) -> Result<Vec<Facet>, SceneError> {
    let wrong =
        |problem: String, remedy: &str| SceneError::File { path: path.to_owned(), problem, remedy: remedy.to_owned() };
    let Some(count) = facet_count(bytes) else {
        return Err(wrong(
            "is no STL file: it does not begin with `solid` and has no header".to_owned(),
            "export it again",
        ));
    };
    let body = &bytes[HEADER..];
    if body.len() != FACET * count {
        return Err(wrong(
            format!(
                "says that it has {count} facets, and holds {} bytes for {} of them",
                body.len(),
                body.len() / FACET
            ),
            "export it again: it is damaged, or no STL file",
        ));
    }
    let own = default_colour(&bytes[..HEADER - 4]);
    let facet = |(i, facet): (usize, &[u8])| {
        let number = |at: usize| f64::from(f32::from_le_bytes([0, 1, 2, 3].map(|byte| facet[4 * at + byte])));
        let [normal, corners @ ..] = [0, 3, 6, 9].map(|at| dvec3(number(at), number(at + 1), number(at + 2)));
        if corners.iter().any(|corner| !corner.abs().cmplt(DVec3::splat(1e30)).all()) {
            let problem = format!("facet {} has a corner at {:?}", i + 1, corners.map(|corner| corner.to_array()));
            return Err(wrong(problem, "give finite numbers below 1e30"));
        }
        Ok(Facet { corners, normal, colour: colour(u16::from_le_bytes([facet[48], facet[49]]), own) })
    };
    body.chunks_exact(FACET).enumerate().map(facet).collect()
}

/// The colour of the whole mesh that Materialise Magics writes into the header.
fn default_colour(header: &[u8]) -> Option<[f64; 3]> {
    let at = header.windows(6).position(|word| word == b"COLOR=")?;
    let rgb = header.get(at + 6..at + 9)?;
    Some([0, 1, 2].map(|channel| f64::from(rgb[channel]) / 255.0))
}

/// The colour in a facet's last two bytes. Magics has red lowest, and clears the highest bit if the colour differs from
/// the whole mesh's. VisCAM and SolidView have blue lowest and set that bit.
fn colour(word: u16, whole: Option<[f64; 3]>) -> Option<[f64; 3]> {
    let part = |shift: u32| f64::from(word >> shift & 31) / 31.0;
    match (whole, word >> 15 == 1) {
        (Some(whole), true) => Some(whole),
        (Some(_), false) => Some([0, 5, 10].map(part)),
        (None, true) => Some([10, 5, 0].map(part)),
        (None, false) => None,
    }
}

fn text(path: &Path, text: &str) -> Result<Vec<Facet>, SceneError> {
    let mut facets = Vec::new();
    let mut normal = None;
    let mut corners = Vec::new();
    let mut last = 1;
    for (line, statement) in (1..).zip(text.lines()) {
        last = line;
        let at = At { path, line };
        let words: Vec<&str> = statement.split_whitespace().take(6).collect();
        let lower: Vec<String> = words.iter().take(2).map(|word| word.to_lowercase()).collect();
        let lower: Vec<&str> = lower.iter().map(String::as_str).collect();
        match (lower.as_slice(), &normal) {
            ([] | ["solid" | "endsolid", ..], None) | (["outer", "loop"] | ["endloop"] | [], Some(_)) => {}
            (["facet", "normal"], None) => {
                normal = Some(DVec3::from_array(numbers(at, "facet normal", &words[2..], &[3])?));
            }
            (["vertex", ..], Some(_)) if corners.len() < 3 => {
                corners.push(DVec3::from_array(numbers(at, "vertex", &words[1..], &[3])?));
            }
            (["vertex", ..], Some(_)) => {
                return Err(at.error("a facet with a fourth `vertex`", "cut it into triangles"));
            }
            (["endfacet"], Some(stated)) => {
                let Some(&corners) = corners.as_array() else {
                    let problem = format!("`endfacet` after {} of three corners", corners.len());
                    return Err(at.error(problem, "give three lines with `vertex`"));
                };
                facets.push(Facet { corners, normal: *stated, colour: None });
                normal = None;
            }
            _ => {
                return Err(at.error(
                    format!("{} does not belong here", quote(statement.trim())),
                    "a facet is `facet normal`, `outer loop`, three times `vertex`, `endloop` and `endfacet`",
                ));
            }
        }
        if normal.is_none() {
            corners.clear();
        }
    }
    match normal {
        Some(_) => Err(At { path, line: last }.error("the file ends within a facet", "export it again")),
        None => Ok(facets),
    }
}

/// A warning if a facet's stated normal differs from that of its corners by more than rounding.
fn contradicting(path: &Path, facets: &[Facet]) -> Option<String> {
    let is_off = |facet: &Facet| {
        let own = normal(&facet.corners);
        let cosine = own.dot(facet.normal).abs() / (own.length() * facet.normal.length());
        // A zero, or a facet without an area, makes it NaN.
        cosine < 0.9
    };
    let mut off = (1..).zip(facets).filter(|(_, facet)| is_off(facet)).map(|(i, _)| i);
    let first: usize = off.next()?;
    let others = match off.count() {
        0 => format!("facet {first} states"),
        more => format!("facet {first} and {more} more state"),
    };
    Some(format!(
        "{}: {others} a normal that its corners do not have, and the corners' own is drawn: export it again",
        shown(path)
    ))
}

fn normal([p, q, r]: &[DVec3; 3]) -> DVec3 {
    (q - p).cross(r - p)
}

fn geometry(facets: &[Facet]) -> Geometry {
    let mut geometry = Geometry::default();
    let is_coloured = facets.iter().any(|facet| facet.colour.is_some());
    for (i, facet) in (0..).zip(facets) {
        geometry.positions.extend(facet.corners);
        geometry.normals.push(normal(&facet.corners));
        if is_coloured {
            geometry.colours.push(facet.colour.unwrap_or(GREY));
        }
        let corner = |j| Corner { vertex: 3 * i + j, texture: None, normal: Some(i), colour: is_coloured.then_some(i) };
        let material = is_coloured.then_some(0);
        geometry.faces.push(Face { place: i as usize + 1, material, corners: [0, 1, 2].map(corner).to_vec() });
    }
    geometry
}

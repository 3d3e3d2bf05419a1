//! OBJ files, statement by statement, so that every mistake is reported with its line.
//!
//! The format is Wavefront's (Advanced Visualizer manual, appendix B1); free-form curves and surfaces are refused. No crate is used:
//! `tobj`, the best kept one, names no lines, ignores statements that it does not know and takes a line element for a face.

use super::lines::{At, logical_lines, numbers};
use super::parts::{Corner, Face, Geometry, Polyline, WHITE};
use crate::error::SceneError;
use crate::quote::{number, quote};
use glam::{DVec3, dvec2, dvec3};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What an OBJ file says.
#[derive(Debug, Default)]
pub(super) struct Scan {
    /// Faces with their lines and their materials by index in [`Scan::materials`]; and polylines.
    pub(super) geometry: Geometry,
    /// Different `mtllib` operands with the lines of their first use, in order.
    pub(super) libraries: Vec<(usize, String)>,
    /// Different `usemtl` names with the lines of their first use, in order.
    pub(super) materials: Vec<(usize, String)>,
}

/// The most corners of a face: cutting a face takes up to their square in time. And of a line, for simplicity.
const MOST_CORNERS: usize = 16_384;

/// Statements that say nothing about faces and lines or their colours.
const IGNORED: [&str; 16] = [
    "o",
    "g",
    "s",
    "mg",
    "p",
    "vp",
    "lod",
    "bevel",
    "c_interp",
    "d_interp",
    "usemap",
    "maplib",
    "shadow_obj",
    "trace_obj",
    "call",
    "csh",
];

pub(super) fn scan(path: &Path, text: &str) -> Result<Scan, SceneError> {
    let mut scan = Scan::default();
    let mut material = None;
    let mut material_of: BTreeMap<String, usize> = BTreeMap::new();
    let mut libraries: BTreeSet<String> = BTreeSet::new();
    for (line, statement) in logical_lines(text) {
        let at = At { path, line };
        let mut words = statement.split_whitespace();
        let Some(keyword) = words.next() else {
            continue;
        };
        let words: Vec<&str> = words.take(MOST_CORNERS + 1).collect();
        let operand = statement.trim_start()[keyword.len()..].trim();
        match keyword {
            "v" => scan.geometry.positions.push(vertex(at, &words)?),
            "vn" => scan.geometry.normals.push(DVec3::from_array(numbers(at, keyword, &words, &[3])?)),
            "vt" => {
                let [u, v, _] = numbers::<3>(at, keyword, &words, &[1, 2, 3])?;
                scan.geometry.coordinates.push(dvec2(u, v));
            }
            "f" => {
                let corners = face(at, &words, &scan)?;
                scan.geometry.faces.push(Face { place: line, material, corners });
            }
            "l" => scan.geometry.lines.push(Polyline { material, tint: WHITE, vertices: polyline(at, &words, &scan)? }),
            "usemtl" | "mtllib" if operand.is_empty() => {
                return Err(at.error(format!("`{keyword}` without a name"), "give the name after it"));
            }
            "usemtl" => {
                material = Some(*material_of.entry(operand.to_owned()).or_insert_with(|| {
                    scan.materials.push((line, operand.to_owned()));
                    scan.materials.len() - 1
                }));
            }
            "mtllib" => {
                if libraries.insert(operand.to_owned()) {
                    scan.libraries.push((line, operand.to_owned()));
                }
            }
            other if IGNORED.contains(&other) => {}
            other => {
                return Err(at.error(
                    format!("unknown statement {}", quote(other)),
                    "an OBJ file of polygons and lines has v, vn, vt, f, l, o, g, s, usemtl and mtllib; remove the line or export polygons",
                ));
            }
        }
    }
    if scan.geometry.faces.is_empty() && scan.geometry.lines.is_empty() {
        return Err(SceneError::File {
            path: path.to_owned(),
            problem: "holds no face and no polyline".to_owned(),
            remedy: "export the mesh with its polygons (lines that begin with `f`) or polylines (with `l`)".to_owned(),
        });
    }
    Ok(scan)
}

/// A position; a weight of 1 or a colour may follow it.
fn vertex(at: At, words: &[&str]) -> Result<DVec3, SceneError> {
    let [x, y, z, w] = numbers::<4>(at, "v", words, &[3, 4, 6, 7])?;
    if matches!(words.len(), 4 | 7) && w != 1.0 {
        return Err(
            at.error(format!("`v` with the weight {}", number(w)), "remove it: weights belong to free-form surfaces")
        );
    }
    Ok(dvec3(x, y, z))
}

fn face(at: At, words: &[&str], seen: &Scan) -> Result<Vec<Corner>, SceneError> {
    check_count(at, "a face", words.len(), 3, "three")?;
    words.iter().map(|word| corner(at, word, seen)).collect()
}

fn polyline(at: At, words: &[&str], seen: &Scan) -> Result<Vec<u32>, SceneError> {
    check_count(at, "a polyline", words.len(), 2, "two")?;
    words.iter().map(|word| polyline_corner(at, word, seen)).collect()
}

fn check_count(at: At, what: &str, corners: usize, least: usize, least_word: &str) -> Result<(), SceneError> {
    if corners < least {
        let corners = if corners == 1 { "1 corner".to_owned() } else { format!("{corners} corners") };
        return Err(at.error(format!("{what} with {corners}"), format!("give at least {least_word}")));
    }
    if corners > MOST_CORNERS {
        return Err(at.error(format!("{what} with more than {MOST_CORNERS} corners"), "cut it"));
    }
    Ok(())
}

/// What a corner belongs to, for errors.
#[derive(Clone, Copy)]
struct Owner {
    name: &'static str,
    forms: &'static str,
}

const FACE: Owner = Owner { name: "face", forms: "v, v/vt, v//vn or v/vt/vn" };
const POLYLINE: Owner = Owner { name: "polyline", forms: "v or v/vt" };

/// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
fn corner(at: At, word: &str, seen: &Scan) -> Result<Corner, SceneError> {
    let read = Reader { at, word, of: FACE };
    let mut parts = word.split('/');
    let (vertex, texture) = read.vertex(&mut parts, seen)?;
    let normal = match parts.next() {
        None | Some("") => None,
        Some(normal) => Some(read.index(normal, "normal", seen.geometry.normals.len())?),
    };
    read.end(parts)?;
    Ok(Corner { vertex, texture, normal, colour: None })
}

/// `v` or `v/vt`.
fn polyline_corner(at: At, word: &str, seen: &Scan) -> Result<u32, SceneError> {
    let read = Reader { at, word, of: POLYLINE };
    let mut parts = word.split('/');
    let (vertex, _) = read.vertex(&mut parts, seen)?;
    read.end(parts)?;
    Ok(vertex)
}

/// What reads a corner, and says what is wrong with it.
struct Reader<'a> {
    at: At<'a>,
    word: &'a str,
    of: Owner,
}

impl Reader<'_> {
    /// The vertex, and the texture coordinate that may follow it.
    fn vertex<'w>(
        &self,
        parts: &mut impl Iterator<Item = &'w str>,
        seen: &Scan,
    ) -> Result<(u32, Option<u32>), SceneError> {
        let vertex = self.index(parts.next().unwrap_or_default(), "vertex", seen.geometry.positions.len())?;
        let texture = match parts.next() {
            None | Some("") => None,
            Some(texture) => Some(self.index(texture, "texture coordinate", seen.geometry.coordinates.len())?),
        };
        Ok((vertex, texture))
    }

    /// An index counted from 0; in the file it counts from 1, and a negative one counts back from the last element so far.
    fn index(&self, part: &str, what: &str, count: usize) -> Result<u32, SceneError> {
        let number: i64 = part.parse().map_err(|_| self.malformed())?;
        let from_one = if number < 0 { count as i64 + 1 + number } else { number };
        if (1..=count as i64).contains(&from_one) {
            return Ok(from_one as u32 - 1);
        }
        let what_if = if number == 0 { ", and counting begins at 1" } else { "" };
        Err(self.at.error(
            format!("the corner {} names {what} {number}, but {count} are defined above{what_if}", quote(self.word)),
            format!("correct the index, or move the definition above the {}", self.of.name),
        ))
    }

    /// That nothing follows.
    fn end<'w>(&self, mut parts: impl Iterator<Item = &'w str>) -> Result<(), SceneError> {
        parts.next().map_or(Ok(()), |_| Err(self.malformed()))
    }

    fn malformed(&self) -> SceneError {
        let Owner { name, forms } = self.of;
        self.at.error(
            format!("the corner {} of a {name} is malformed", quote(self.word)),
            format!("write {forms} with whole numbers"),
        )
    }
}

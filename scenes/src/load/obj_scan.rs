//! OBJ files, statement by statement, so that every mistake is reported with its line.
//!
//! The format is Wavefront's (Advanced Visualizer manual, appendix B1); free-form curves and surfaces are refused. No crate is used:
//! `tobj`, the best kept one, names no lines, ignores statements that it does not know and takes a line element for a face.

use super::lines::{At, logical_lines, numbers};
use crate::error::SceneError;
use crate::quote::{number, quote};
use glam::{DVec3, dvec3};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What an OBJ file says.
#[derive(Debug, Default)]
pub(super) struct Scan {
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Vec<DVec3>,
    /// Faces in order; at least one.
    pub(super) faces: Vec<Face>,
    /// Different `mtllib` operands with the lines of their first use, in order.
    pub(super) libraries: Vec<(usize, String)>,
    /// Different `usemtl` names with the lines of their first use, in order.
    pub(super) materials: Vec<(usize, String)>,
    textures: usize,
}

/// A face: its line, its material by index in [`Scan::materials`], and at least three corners.
#[derive(Debug)]
pub(super) struct Face {
    pub(super) line: usize,
    pub(super) material: Option<usize>,
    pub(super) corners: Vec<Corner>,
}

/// One corner of a face: vertex and normal, counted from 0.
pub(super) type Corner = (u32, Option<u32>);

/// The most corners of a face: cutting a face takes up to their square in time.
const MOST_CORNERS: usize = 16_384;

/// Statements that say nothing about triangles or their colours.
const IGNORED: [&str; 17] = [
    "o",
    "g",
    "s",
    "mg",
    "p",
    "l",
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
            "v" => scan.positions.push(vertex(at, &words)?),
            "vn" => scan.normals.push(DVec3::from_array(numbers(at, keyword, &words, &[3])?)),
            "vt" => {
                numbers::<3>(at, keyword, &words, &[1, 2, 3])?;
                scan.textures += 1;
            }
            "f" => {
                let corners = face(at, &words, &scan)?;
                scan.faces.push(Face { line, material, corners });
            }
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
                    "an OBJ file of polygons has v, vn, vt, f, o, g, s, usemtl and mtllib; remove the line or export polygons",
                ));
            }
        }
    }
    if scan.faces.is_empty() {
        return Err(SceneError::File {
            path: path.to_owned(),
            problem: "holds no face".to_owned(),
            remedy: "export the mesh with its polygons (lines that begin with `f`)".to_owned(),
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
    if words.len() < 3 {
        return Err(at.error(format!("a face with {} corners", words.len()), "give at least three"));
    }
    if words.len() > MOST_CORNERS {
        return Err(at.error(format!("a face with more than {MOST_CORNERS} corners"), "cut it"));
    }
    words.iter().map(|word| corner(at, word, seen)).collect()
}

/// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
fn corner(at: At, word: &str, seen: &Scan) -> Result<Corner, SceneError> {
    let mut parts = word.split('/');
    let vertex = index(at, word, parts.next().unwrap_or_default(), "vertex", seen.positions.len())?;
    match parts.next() {
        None | Some("") => {}
        Some(texture) => {
            index(at, word, texture, "texture coordinate", seen.textures)?;
        }
    }
    let normal = match parts.next() {
        None | Some("") => None,
        Some(normal) => Some(index(at, word, normal, "normal", seen.normals.len())?),
    };
    if parts.next().is_some() {
        return Err(malformed(at, word));
    }
    Ok((vertex, normal))
}

/// An index counted from 0; in the file it counts from 1, and a negative one counts back from the last element so far.
fn index(at: At, word: &str, part: &str, what: &str, count: usize) -> Result<u32, SceneError> {
    let number: i64 = part.parse().map_err(|_| malformed(at, word))?;
    let from_one = if number < 0 { count as i64 + 1 + number } else { number };
    if (1..=count as i64).contains(&from_one) {
        return Ok(from_one as u32 - 1);
    }
    let what_if = if number == 0 { ", and counting begins at 1" } else { "" };
    Err(at.error(
        format!("the corner {} names {what} {number}, but {count} are defined above{what_if}", quote(word)),
        "correct the index, or move the definition above the face",
    ))
}

fn malformed(at: At, word: &str) -> SceneError {
    at.error(
        format!("the corner {} of a face is malformed", quote(word)),
        "write v, v/vt, v//vn or v/vt/vn with whole numbers",
    )
}

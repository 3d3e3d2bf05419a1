//! The first reading of an OBJ file: every line is checked, so that a mistake is reported with its line.
//!
//! `tobj`, which builds the mesh, names no lines, ignores statements that it does not know and takes a line element for a face.
//! So it is given a plain copy: vertices, normals, faces and material names alone, one statement a line. The format is Wavefront's
//! (Advanced Visualizer manual, appendix B1); free-form curves and surfaces are refused.

use crate::SceneError;
use std::fmt::Write;
use std::path::Path;

/// What the first reading found.
#[derive(Debug, Default)]
pub(super) struct Scan {
    /// The plain copy for `tobj`. Material i of `materials` is called `i` there.
    pub(super) plain: String,
    /// `mtllib` operands with their lines, in order.
    pub(super) libraries: Vec<(usize, String)>,
    /// Different `usemtl` names with the lines of their first use, in order.
    pub(super) materials: Vec<(usize, String)>,
    /// Whether every corner of every face names a normal; if not, the copy names none.
    pub(super) has_normals: bool,
    /// The line of a face without normals, if other faces have them.
    pub(super) mixed_at: Option<usize>,
}

/// A line's number and its file, for errors.
#[derive(Clone, Copy)]
pub(super) struct At<'a> {
    pub(super) path: &'a Path,
    pub(super) line: usize,
}

impl At<'_> {
    pub(super) fn error(self, problem: impl Into<String>, remedy: impl Into<String>) -> SceneError {
        SceneError::Line { path: self.path.to_owned(), line: self.line, problem: problem.into(), remedy: remedy.into() }
    }
}

/// Numbers of vertices, texture coordinates and normals so far.
#[derive(Default)]
struct Seen {
    vertices: usize,
    textures: usize,
    normals: usize,
}

/// One corner of a face: vertex and normal, counted from 1.
type Corner = (usize, Option<usize>);

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
    let mut seen = Seen::default();
    let mut faces: Vec<(usize, Vec<Corner>)> = Vec::new();
    // Where in the copy each face or material change goes is the order of this list.
    let mut body: Vec<Statement> = Vec::new();
    for (line, statement) in logical_lines(text) {
        let at = At { path, line };
        let mut words = statement.split_whitespace();
        let Some(keyword) = words.next() else {
            continue;
        };
        let words: Vec<&str> = words.collect();
        let operand = statement.trim_start()[keyword.len()..].trim();
        match keyword {
            "v" => {
                let xyz = vertex(at, &words)?;
                seen.vertices += 1;
                writeln_plain(&mut scan.plain, "v", xyz);
            }
            "vn" => {
                let xyz = numbers(at, keyword, &words, &[3])?;
                seen.normals += 1;
                writeln_plain(&mut scan.plain, "vn", xyz);
            }
            "vt" => {
                numbers::<3>(at, keyword, &words, &[1, 2, 3])?;
                seen.textures += 1;
            }
            "f" => {
                body.push(Statement::Face(faces.len()));
                faces.push((line, face(at, &words, &seen)?));
            }
            "usemtl" | "mtllib" if operand.is_empty() => {
                return Err(at.error(format!("`{keyword}` without a name"), "give the name after it"));
            }
            "usemtl" => {
                let known = scan.materials.iter().position(|(_, name)| name == operand);
                let index = known.unwrap_or(scan.materials.len());
                if known.is_none() {
                    scan.materials.push((line, operand.to_owned()));
                }
                body.push(Statement::Material(index));
            }
            "mtllib" => scan.libraries.push((line, operand.to_owned())),
            other if IGNORED.contains(&other) => {}
            other => {
                return Err(at.error(
                    format!("unknown statement `{other}`"),
                    "an OBJ file of polygons has v, vn, vt, f, o, g, s, usemtl and mtllib; remove the line or export polygons",
                ));
            }
        }
    }
    if faces.is_empty() {
        return Err(SceneError::File {
            path: path.to_owned(),
            problem: "holds no face".to_owned(),
            remedy: "export the mesh with its polygons (lines that begin with `f`)".to_owned(),
        });
    }
    let without = |(_, corners): &&(usize, Vec<Corner>)| corners.iter().any(|c| c.1.is_none());
    let bare = faces.iter().find(without);
    scan.has_normals = bare.is_none();
    let some = faces.iter().flat_map(|(_, corners)| corners).any(|c| c.1.is_some());
    scan.mixed_at = bare.map(|(line, _)| *line).filter(|_| some);
    for statement in body {
        match statement {
            Statement::Material(index) => {
                let _ = writeln!(scan.plain, "usemtl {index}");
            }
            Statement::Face(index) => face_plain(&mut scan.plain, &faces[index].1, scan.has_normals),
        }
    }
    Ok(scan)
}

enum Statement {
    Face(usize),
    Material(usize),
}

// Writing to a String cannot fail.
fn writeln_plain(plain: &mut String, keyword: &str, xyz: [f64; 3]) {
    let [x, y, z] = xyz;
    // Rust prints the shortest decimal that reads back as the same number.
    let _ = writeln!(plain, "{keyword} {x} {y} {z}");
}

fn face_plain(plain: &mut String, corners: &[Corner], normals: bool) {
    plain.push('f');
    for (vertex, normal) in corners {
        let _ = match normal {
            Some(normal) if normals => write!(plain, " {vertex}//{normal}"),
            _ => write!(plain, " {vertex}"),
        };
    }
    plain.push('\n');
}

/// Lines without comments, those that end in a backslash joined to the next; with the number of the first, counted from 1.
pub(super) fn logical_lines(text: &str) -> impl Iterator<Item = (usize, String)> + '_ {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = (1..).zip(text.lines());
    std::iter::from_fn(move || {
        let (number, mut line) = lines.next()?;
        let mut whole = String::new();
        loop {
            let code = line.split('#').next().unwrap_or_default();
            match code.trim_end().strip_suffix('\\') {
                Some(begun) => whole.push_str(begun),
                None => {
                    whole.push_str(code);
                    return Some((number, whole));
                }
            }
            whole.push(' ');
            match lines.next() {
                Some((_, next)) => line = next,
                None => return Some((number, whole)),
            }
        }
    })
}

/// Finite numbers, as many as one of `counts` says.
pub(super) fn numbers<const N: usize>(
    at: At,
    keyword: &str,
    words: &[&str],
    counts: &[usize],
) -> Result<[f64; N], SceneError> {
    if !counts.contains(&words.len()) {
        let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
        return Err(
            at.error(format!("`{keyword}` with {} numbers", words.len()), format!("give {}", counts.join(" or ")))
        );
    }
    let mut values = [0.0; N];
    for (i, word) in words.iter().enumerate() {
        let value = number(at, keyword, word)?;
        if let Some(place) = values.get_mut(i) {
            *place = value;
        }
    }
    Ok(values)
}

fn number(at: At, keyword: &str, word: &str) -> Result<f64, SceneError> {
    match word.parse::<f64>() {
        Ok(value) if value.abs() < 1e100 => Ok(value),
        Ok(_) => Err(at.error(format!("`{keyword}` with the number `{word}`"), "give finite numbers below 1e100")),
        Err(_) => Err(at.error(format!("`{word}` after `{keyword}` is not a number"), "write it as in 1.5 or -2e-3")),
    }
}

/// A position; a weight of 1 or a colour may follow it.
fn vertex(at: At, words: &[&str]) -> Result<[f64; 3], SceneError> {
    let [x, y, z, w] = numbers::<4>(at, "v", words, &[3, 4, 6, 7])?;
    if matches!(words.len(), 4 | 7) && w != 1.0 {
        return Err(at.error(format!("`v` with the weight {w}"), "remove it: weights belong to free-form surfaces"));
    }
    Ok([x, y, z])
}

fn face(at: At, words: &[&str], seen: &Seen) -> Result<Vec<Corner>, SceneError> {
    if words.len() < 3 {
        return Err(at.error(format!("a face with {} corners", words.len()), "give at least three"));
    }
    words.iter().map(|word| corner(at, word, seen)).collect()
}

/// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
fn corner(at: At, word: &str, seen: &Seen) -> Result<Corner, SceneError> {
    let mut parts = word.split('/');
    let vertex = index(at, word, parts.next().unwrap_or_default(), "vertex", seen.vertices)?;
    match parts.next() {
        None | Some("") => {}
        Some(texture) => {
            index(at, word, texture, "texture coordinate", seen.textures)?;
        }
    }
    let normal = match parts.next() {
        None | Some("") => None,
        Some(normal) => Some(index(at, word, normal, "normal", seen.normals)?),
    };
    if parts.next().is_some() {
        return Err(malformed(at, word));
    }
    Ok((vertex, normal))
}

/// An index counted from 1; a negative one counts back from the last element so far.
fn index(at: At, word: &str, part: &str, what: &str, count: usize) -> Result<usize, SceneError> {
    let number: i64 = part.parse().map_err(|_| malformed(at, word))?;
    let from_one = if number < 0 { count as i64 + 1 + number } else { number };
    if (1..=count as i64).contains(&from_one) {
        return Ok(from_one as usize);
    }
    let what_if = if number == 0 { ", and counting begins at 1" } else { "" };
    Err(at.error(
        format!("the corner `{word}` names {what} {number}, but {count} are defined above{what_if}"),
        "correct the index, or move the definition above the face",
    ))
}

fn malformed(at: At, word: &str) -> SceneError {
    at.error(
        format!("the corner `{word}` of a face is malformed"),
        "write v, v/vt, v//vn or v/vt/vn with whole numbers",
    )
}

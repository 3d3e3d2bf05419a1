//! Corners of faces and polylines: indices of elements defined above them.

use super::lines::At;
use super::notes::{self, Notes};
use super::numbers::parsed;
use super::parts::{Corner, Geometry};
use crate::error::SceneError;
use crate::quote::quote_bytes;
use glam::DVec3;

/// The most corners of a face, because cutting a face may take time quadratic in them. The same limit applies to a
/// line, for simplicity.
pub(super) const MOST_CORNERS: usize = 16_384;

/// What a corner belongs to, for errors.
#[derive(Clone, Copy)]
struct Owner {
    name: &'static str,
    forms: &'static str,
}

const FACE: Owner = Owner { name: "face", forms: "v, v/vt, v//vn or v/vt/vn" };
const POLYLINE: Owner = Owner { name: "polyline", forms: "v or v/vt" };

/// The corners of a face, each `v`, `v/vt`, `v//vn` or `v/vt/vn`; `None` if they are too few to enclose anything.
pub(super) fn face(
    at: At,
    words: &[&[u8]],
    seen: &Geometry,
    notes: &mut Notes,
) -> Result<Option<Vec<Corner>>, SceneError> {
    if !are_enough(at, notes::FACE, words.len(), 3, notes)? {
        return Ok(None);
    }
    words.iter().map(|word| corner(at, word, seen, notes)).collect::<Result<_, _>>().map(Some)
}

/// The vertices of a polyline, whose corners are `v` or `v/vt` each; `None` if there are fewer than two.
pub(super) fn polyline(
    at: At,
    words: &[&[u8]],
    seen: &Geometry,
    notes: &mut Notes,
) -> Result<Option<Vec<u32>>, SceneError> {
    if !are_enough(at, notes::POLYLINE, words.len(), 2, notes)? {
        return Ok(None);
    }
    let vertex = |word: &&[u8]| {
        let read = Reader { at, word, of: POLYLINE };
        let mut parts = word.split(|&byte| byte == b'/');
        let vertex = read.vertex(&mut parts, seen)?;
        // Lines have no texture.
        parts.next();
        read.end(parts)?;
        Ok(vertex)
    };
    words.iter().map(vertex).collect::<Result<_, _>>().map(Some)
}

/// Whether there are enough corners; if not, a note.
fn are_enough(at: At, what: &'static str, corners: usize, least: usize, notes: &mut Notes) -> Result<bool, SceneError> {
    if corners > MOST_CORNERS {
        return Err(at.error(format!("{what} with more than {MOST_CORNERS} corners"), "cut it"));
    }
    if corners < least {
        let corners = if corners == 1 { "1 corner".to_owned() } else { format!("{corners} corners") };
        let remedy = if least == 3 { "give at least three" } else { "give at least two" };
        notes.add(what, at.line, || format!("{what} with {corners} is not drawn"), remedy);
    }
    Ok(corners >= least)
}

fn corner(at: At, word: &[u8], seen: &Geometry, notes: &mut Notes) -> Result<Corner, SceneError> {
    let read = Reader { at, word, of: FACE };
    let mut parts = word.split(|&byte| byte == b'/');
    let vertex = read.vertex(&mut parts, seen)?;
    let texture = read.other(parts.next(), "texture coordinate", seen.coordinates.len(), notes)?;
    let normal = read.other(parts.next(), "normal", seen.normals.len(), notes)?;
    read.end(parts)?;
    let remedy = "export the mesh again";
    let texture = texture.filter(|&i| {
        let is_sound = seen.coordinates[i as usize].is_finite();
        if !is_sound {
            let problem =
                || "this face names a texture coordinate that is not a number, so it has no texture".to_owned();
            notes.add("coordinate", at.line, problem, remedy);
        }
        is_sound
    });
    let normal = normal.filter(|&i| {
        let is_sound = seen.normals[i as usize] != DVec3::ZERO;
        if !is_sound {
            let problem = || "this face names a normal without a direction, so one is computed".to_owned();
            notes.add("direction", at.line, problem, remedy);
        }
        is_sound
    });
    Ok(Corner { vertex, texture, normal, colour: None })
}

/// Reads a corner, and reports what is wrong with it.
struct Reader<'a> {
    at: At<'a>,
    word: &'a [u8],
    of: Owner,
}

impl Reader<'_> {
    fn vertex<'w>(&self, parts: &mut impl Iterator<Item = &'w [u8]>, seen: &Geometry) -> Result<u32, SceneError> {
        self.index(parts.next().unwrap_or_default(), "vertex", seen.positions.len())
    }

    /// The index of a texture coordinate or a normal, which may be missing. Some programs write 0 for none, and some
    /// write numbers where none are defined.
    fn other(
        &self,
        part: Option<&[u8]>,
        what: &'static str,
        count: usize,
        notes: &mut Notes,
    ) -> Result<Option<u32>, SceneError> {
        let Some(part) = part.filter(|part| !part.is_empty()) else { return Ok(None) };
        let number = self.number(part)?;
        if number != 0 && count > 0 {
            return self.index(part, what, count).map(Some);
        }
        let is_normal = what == "normal";
        let result = if is_normal { "so one is computed" } else { "so it has no texture" };
        let reason = if number == 0 { "and counting begins at 1" } else { "and none is defined above" };
        let problem = || format!("the corner {} names {what} {number}, {reason}, {result}", quote_bytes(self.word));
        notes.add(
            if is_normal { "no normal" } else { "no coordinate" },
            self.at.line,
            problem,
            "export the mesh again",
        );
        Ok(None)
    }

    /// An index counted from 0; in the file it counts from 1, and a negative one counts back from the last element so far.
    fn index(&self, part: &[u8], what: &str, count: usize) -> Result<u32, SceneError> {
        let number = self.number(part)?;
        let from_one = if number < 0 { (count as i64 + 1).saturating_add(number) } else { number };
        if (1..=count as i64).contains(&from_one) {
            return Ok(from_one as u32 - 1);
        }
        let what_if = if number == 0 { ", and counting begins at 1" } else { "" };
        Err(self.at.error(
            format!(
                "the corner {} names {what} {number}, but {count} are defined above{what_if}",
                quote_bytes(self.word)
            ),
            format!("correct the index, or move the definition above the {}", self.of.name),
        ))
    }

    fn number(&self, part: &[u8]) -> Result<i64, SceneError> {
        let whole = std::str::from_utf8(part).ok().and_then(|part| part.parse().ok());
        // Some programs write all numbers as floats.
        let round = || parsed(part).filter(|x| x.fract() == 0.0 && x.abs() < 1e15).map(|x| x as i64);
        whole.or_else(round).ok_or_else(|| self.malformed())
    }

    /// Checks that only an empty part follows.
    fn end<'w>(&self, mut parts: impl Iterator<Item = &'w [u8]>) -> Result<(), SceneError> {
        parts.find(|part| !part.is_empty()).map_or(Ok(()), |_| Err(self.malformed()))
    }

    fn malformed(&self) -> SceneError {
        let Owner { name, forms } = self.of;
        self.at.error(
            format!("the corner {} of a {name} is malformed", quote_bytes(self.word)),
            format!("write {forms} with whole numbers"),
        )
    }
}

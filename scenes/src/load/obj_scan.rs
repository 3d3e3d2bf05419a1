//! OBJ files, statement by statement, so that every mistake is reported with its line.
//!
//! The format is Wavefront's (Advanced Visualizer manual, appendix B1); free-form curves and surfaces are refused. This
//! is our own reader. The best maintained crate, `tobj`, names no lines, ignores statements that it does not know and
//! takes a line element for a face.

use super::corner::{MOST_CORNERS, face, polyline};
use super::lines::{At, Statement, is_no_number, statements};
use super::notes::Notes;
use super::numbers::{check_weight, numbers};
use super::parts::{Face, Geometry, Polyline, WHITE};
use crate::error::SceneError;
use crate::quote::quote;
use glam::{DVec2, DVec3, dvec2, dvec3};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The content of an OBJ file.
#[derive(Debug, Default)]
pub(super) struct Scan {
    /// Faces with their lines and their materials by index in [`Scan::materials`]; and polylines. A normal without a
    /// direction is zero, and no corner refers to it.
    pub(super) geometry: Geometry,
    /// Colours of positions, as far as the file has any; red, green and blue.
    pub(super) colours: Vec<Option<DVec3>>,
    /// The smoothing group of each face, 0 for none.
    pub(super) groups: Vec<u32>,
    /// Different `mtllib` operands with the lines of their first use, in sequence.
    pub(super) libraries: Vec<(usize, Vec<u8>)>,
    /// Different `usemtl` names with the lines of their first use, in sequence.
    pub(super) materials: Vec<(usize, Vec<u8>)>,
    /// Harmless problems.
    pub(super) notes: Notes,
}

/// Statements that change no picture: names, levels of detail, and parts of free-form surfaces.
const IGNORED: [&str; 5] = ["o", "g", "mg", "vp", "lod"];

/// Statements that are understood but not drawn.
const UNDRAWN: [&str; 10] =
    ["p", "bevel", "c_interp", "d_interp", "usemap", "maplib", "shadow_obj", "trace_obj", "call", "csh"];

/// The smoothing group of faces in a file without groups: one for all.
const ALL: u32 = 1;

/// A scan in progress.
#[derive(Default)]
struct Scanner {
    scan: Scan,
    notes: Notes,
    /// The current material and smoothing group, if any have been named.
    material: Option<usize>,
    group: Option<u32>,
    material_of: BTreeMap<Vec<u8>, usize>,
    group_of: BTreeMap<Vec<u8>, u32>,
    libraries: BTreeSet<Vec<u8>>,
    /// The line of the first colour outside 0 to 1.
    bright: Option<usize>,
    /// Whether a colour has a number that is not a whole number from 0 to 255.
    has_fractions: bool,
}

pub(super) fn scan(path: &Path, text: &[u8]) -> Result<Scan, SceneError> {
    let mut scanner = Scanner::default();
    for statement in statements(text) {
        scanner.take(At { path, line: statement.line }, &statement)?;
    }
    let scan = scanner.finish();
    if scan.geometry.faces.is_empty() && scan.geometry.lines.is_empty() {
        return Err(scan.notes.too_few(path).unwrap_or_else(|| SceneError::File {
            path: path.to_owned(),
            problem: "holds no face and no polyline".to_owned(),
            remedy: "export the mesh with its polygons (lines that begin with `f`) or polylines (with `l`)".to_owned(),
        }));
    }
    Ok(scan)
}

impl Scanner {
    fn take(&mut self, at: At, statement: &Statement) -> Result<(), SceneError> {
        let keyword = statement.keyword();
        let words = || statement.words().take(MOST_CORNERS + 1).collect::<Vec<&[u8]>>();
        let Scanner { scan, notes, .. } = self;
        match &*keyword {
            "v" => self.vertex(at, &words())?,
            "vn" => {
                let words = words();
                let is_one = !words.iter().any(|word| is_no_number(word));
                scan.geometry.normals.push(if is_one { numbers(at, "vn", &words, &[3])?.into() } else { DVec3::ZERO });
            }
            "vt" => {
                let words = words();
                let is_one = !words.iter().any(|word| is_no_number(word));
                let [u, v, _] = if is_one { numbers::<3>(at, "vt", &words, &[1, 2, 3])? } else { [f64::NAN; 3] };
                scan.geometry.coordinates.push(dvec2(u, v));
            }
            // Older versions of the format have `fo`.
            "f" | "fo" => {
                if let Some(corners) = face(at, &words(), &scan.geometry, notes)? {
                    scan.geometry.faces.push(Face { place: at.line, material: self.material, corners });
                    scan.groups.push(self.group.unwrap_or_default());
                }
            }
            "l" => {
                if let Some(vertices) = polyline(at, &words(), &scan.geometry, notes)? {
                    scan.geometry.lines.push(Polyline { material: self.material, tint: WHITE, vertices });
                }
            }
            "s" => self.group = Some(self.smoothing(statement.words().next().unwrap_or_default())),
            "usemtl" | "mtllib" => self.name(&keyword, at.line, statement.name()),
            ignored if IGNORED.contains(&ignored) => {}
            undrawn => match UNDRAWN.iter().find(|&&known| known == undrawn) {
                // `bevel off` and the like.
                Some(_) if statement.name().eq_ignore_ascii_case(b"off") => {}
                Some(known) => {
                    notes.add(known, at.line, || format!("`{known}` is not drawn"), "export what it shows as polygons");
                }
                None => {
                    return Err(at.error(
                        format!("unknown statement {}", quote(&statement.spelled())),
                        "an OBJ file of polygons and lines has v, vn, vt, f, l, o, g, s, usemtl and mtllib; remove the line or export polygons",
                    ));
                }
            },
        }
        Ok(())
    }

    /// A position; a weight of 1, or a colour with or without alpha, may follow it.
    fn vertex(&mut self, at: At, words: &[&[u8]]) -> Result<(), SceneError> {
        let [x, y, z, r, g, b, alpha] = numbers::<7>(at, "v", words, &[3, 4, 6, 7])?;
        let Scanner { scan, notes, .. } = self;
        if words.len() == 4 {
            check_weight(at, r)?;
        }
        if words.len() >= 6 {
            scan.colours.resize(scan.geometry.positions.len(), None);
            scan.colours.push(Some(dvec3(r, g, b)));
            if [r, g, b].iter().any(|channel| !(0.0..=1.0).contains(channel)) {
                self.bright.get_or_insert(at.line);
            }
            self.has_fractions |= [r, g, b].iter().any(|c| c.fract() != 0.0 || !(0.0..=255.0).contains(c));
        }
        if words.len() == 7 && alpha != 1.0 {
            let problem = || "this vertex is transparent, and it is drawn without that".to_owned();
            notes.add("alpha", at.line, problem, "remove the seventh number, or make it 1");
        }
        scan.geometry.positions.push(dvec3(x, y, z));
        Ok(())
    }

    /// The number of a smoothing group. A statement without a number turns smoothing on, as some programs write it.
    fn smoothing(&mut self, name: &[u8]) -> u32 {
        let name = name.to_ascii_lowercase();
        match &name[..] {
            b"off" | b"0" => 0,
            b"" | b"on" | b"1" => ALL,
            _ => {
                let next = ALL + 1 + self.group_of.len() as u32;
                *self.group_of.entry(name).or_insert(next)
            }
        }
    }

    /// Takes the name of a material, or of files of them.
    fn name(&mut self, keyword: &str, line: usize, name: &[u8]) {
        let is_empty = name.is_empty() || name.starts_with(b"# ");
        match (keyword, is_empty) {
            ("usemtl", true) => {
                self.material = None;
                let problem = || "`usemtl` without a name, so what follows has no material".to_owned();
                self.notes.add("usemtl", line, problem, "give the name after it");
            }
            ("usemtl", false) => {
                let scan = &mut self.scan;
                self.material = Some(*self.material_of.entry(name.to_owned()).or_insert_with(|| {
                    scan.materials.push((line, name.to_owned()));
                    scan.materials.len() - 1
                }));
            }
            (_, true) => {
                let problem = || "`mtllib` without a name, so no file is read for it".to_owned();
                self.notes.add("mtllib", line, problem, "give the name after it");
            }
            (_, false) => {
                if self.libraries.insert(name.to_owned()) {
                    self.scan.libraries.push((line, name.to_owned()));
                }
            }
        }
    }

    fn finish(mut self) -> Scan {
        if let Some(line) = self.bright {
            self.scale_colours(line);
        }
        let Scanner { mut scan, notes, group, .. } = self;
        if group.is_none() {
            scan.groups.fill(ALL);
        }
        // No corner refers to them.
        scan.geometry.coordinates.iter_mut().filter(|uv| !uv.is_finite()).for_each(|uv| *uv = DVec2::ZERO);
        Scan { notes, ..scan }
    }

    /// Scales or clamps all colours to 0 to 1.
    fn scale_colours(&mut self, line: usize) {
        let (problem, unit) = match self.has_fractions {
            true => ("this vertex has a colour outside 0 to 1, and the nearest inside is drawn", 1.0),
            false => ("this vertex has a colour above 1, so all are taken for numbers from 0 to 255", 255.0),
        };
        self.notes.add("bright", line, || problem.to_owned(), "give red, green and blue from 0 to 1");
        for colour in self.scan.colours.iter_mut().flatten() {
            *colour = (*colour / unit).clamp(DVec3::ZERO, DVec3::ONE);
        }
    }
}

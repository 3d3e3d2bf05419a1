//! Materials of an OBJ file: the diffuse colours (Kd) of its MTL files. For deferred shading also their textures
//! (map_Kd) and highlights (Ks, Ns, illum).
//!
//! A missing MTL file is a warning, not an error. Such files often get lost when a mesh is copied, and every triangle
//! can still be drawn, in grey. A malformed one is an error, like any malformed file.

use super::files::{Finder, expected, find, listed, words};
use super::lines::trimmed;
use super::map::{self, Map, Placement, Wrong};
use super::mtl::{Definition, Libraries};
use super::obj_scan::Scan;
use super::parts::{GREY, WHITE};
use crate::error::SceneError;
use crate::quote::{quote, quote_bytes, shown};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The look of a material.
#[derive(Clone)]
pub(super) struct Look {
    /// The diffuse colour.
    pub(super) colour: [f64; 3],
    pub(super) picture: Option<Picture>,
    /// The brightness of highlights, 0 to 1.
    pub(super) specular: Option<f64>,
    /// The power of the cosine that makes them, as the file has it.
    pub(super) shininess: Option<f64>,
}

/// The file of a texture, its placement, and where the material says so.
#[derive(Clone)]
pub(super) struct Picture {
    /// The MTL file.
    pub(super) library: PathBuf,
    pub(super) line: usize,
    pub(super) path: PathBuf,
    pub(super) placement: Placement,
    /// What is wrong with the options.
    pub(super) wrong: Option<Wrong>,
}

impl Default for Look {
    fn default() -> Look {
        Look { colour: GREY, picture: None, specular: None, shininess: None }
    }
}

/// The looks of a mesh's materials, in the sequence of [`Scan::materials`]. Adds the paths of their files to `files`,
/// and problems to `warnings`.
pub(super) fn looks(
    obj: &Path,
    scan: &mut Scan,
    files: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Result<Vec<Look>, SceneError> {
    let mut reading = Reading { obj, libraries: Libraries::default(), finder: Finder::default(), warnings };
    let complete = reading.read_libraries(scan)?;
    reading.assume_the_only_one(scan);
    let definitions = reading.definitions(scan, complete);
    let looks = reading.looks(&definitions);
    let Reading { libraries, warnings, .. } = reading;
    for (path, notes) in libraries.paths.iter().zip(libraries.notes) {
        warnings.extend(notes.warnings(path));
    }
    files.extend(libraries.paths);
    Ok(looks)
}

/// The materials of a mesh under construction.
struct Reading<'a> {
    obj: &'a Path,
    libraries: Libraries,
    finder: Finder,
    warnings: &'a mut Vec<String>,
}

impl Reading<'_> {
    /// Reads the files that the mesh names; returns whether none is missing.
    fn read_libraries(&mut self, scan: &mut Scan) -> Result<bool, SceneError> {
        let folder = self.obj.parent().unwrap_or(Path::new(""));
        let Scan { libraries, materials, notes, .. } = scan;
        let used: BTreeSet<&[u8]> = materials.iter().map(|(_, name)| &name[..]).collect();
        let mut missing: Option<(usize, PathBuf, usize)> = None;
        for &(line, ref operand) in &*libraries {
            for file in listed(folder, operand) {
                let found = file.or_else(|name| {
                    let path = expected(folder, &name);
                    let found = self.finder.find_loosely(&[folder], &name).ok_or_else(|| path.clone())?;
                    let problem =
                        || format!("there is no material file {}, so {} is read", shown(&path), shown(&found));
                    notes.add("library", line, problem, "correct the name");
                    Ok(found)
                });
                match (found, &mut missing) {
                    (Ok(path), _) => self.libraries.read(path, &used)?,
                    (Err(_), Some((.., more))) => *more += 1,
                    (Err(path), None) => missing = Some((line, path, 0)),
                }
            }
        }
        let first_use = materials.first().filter(|_| missing.is_some() || libraries.is_empty()).map(|&(line, _)| line);
        let in_place = first_use.and_then(|_| self.read_by_own_name(&used));
        let warning = match (missing, &in_place) {
            (Some(missing), _) => missing_files(missing, in_place.as_deref()),
            (None, Some(own)) => {
                let line = first_use.unwrap_or_default();
                format!("{line}: no `mtllib` names a material file, so {} is read: name it", shown(own))
            }
            (None, None) => return Ok(true),
        };
        self.warnings.push(format!("{}:{warning}", shown(self.obj)));
        Ok(in_place.is_some())
    }

    /// Reads the MTL file with the mesh's own name if the mesh names none or the named one is missing: the mesh may
    /// have been renamed. As nothing names this file, it is ignored if it is malformed.
    fn read_by_own_name(&mut self, used: &BTreeSet<&[u8]>) -> Option<PathBuf> {
        let mut longer = self.obj.as_os_str().to_owned();
        longer.push(".mtl");
        let own = [self.obj.with_extension("mtl"), longer.into()];
        let path = own.into_iter().find(|path| path.is_file() && !self.libraries.paths.contains(path))?;
        self.libraries.read(path.clone(), used).ok()?;
        Some(path)
    }

    /// Gives a mesh without `usemtl` the only material that there is.
    fn assume_the_only_one(&mut self, scan: &mut Scan) {
        let Some(&(line, _)) = scan.libraries.first().filter(|_| scan.materials.is_empty()) else { return };
        let mut names = self.libraries.found.keys();
        let (Some(name), more) = (names.next().cloned(), names.next().is_some()) else { return };
        let result = match more {
            true => "all is grey".to_owned(),
            false => format!("the only one, {}, is everywhere", quote_bytes(&name)),
        };
        self.warnings.push(format!(
            "{}:{line}: no `usemtl` names a material, so {result}: name one before the faces",
            shown(self.obj)
        ));
        if !more {
            scan.materials.push((line, name));
            scan.geometry.faces.iter_mut().for_each(|face| face.material = Some(0));
            scan.geometry.lines.iter_mut().for_each(|line| line.material = Some(0));
        }
    }

    /// The files' entries for each material of the mesh.
    fn definitions(&self, scan: &mut Scan, complete: bool) -> Vec<Option<Definition>> {
        let Scan { materials, notes, .. } = scan;
        let mut nearly: Option<BTreeMap<Vec<u8>, Option<&[u8]>>> = None;
        let found = &self.libraries.found;
        let definition = |(line, name): &(usize, Vec<u8>)| {
            // With everything after `usemtl`, or without a possible comment there.
            if let Some(definition) = found.get(name).or_else(|| found.get(without_comment(name))) {
                return Some(definition.clone());
            }
            let similar = nearly.get_or_insert_with(|| by_likeness(found)).get(&likeness(name)).copied().flatten();
            if let Some(similar) = similar {
                if without_comment(similar) != without_comment(name) {
                    let problem = || {
                        format!(
                            "no MTL file defines the material {}, so {} is drawn",
                            quote_bytes(name),
                            quote_bytes(similar)
                        )
                    };
                    notes.add("similar", *line, problem, "write both alike");
                }
                return found.get(similar).cloned();
            }
            // Some programs write this for no material; and after a missing file, that file's warning is enough.
            let is_none = matches!(&name[..], b"(null)" | b"None" | b"none");
            if complete && !is_none {
                let problem = || format!("no MTL file defines the material {}, so it is grey", quote_bytes(name));
                notes.add("undefined", *line, problem, "define it, or name its file with mtllib");
            }
            None
        };
        materials.iter().map(definition).collect()
    }

    fn looks(&mut self, definitions: &[Option<Definition>]) -> Vec<Look> {
        let mut undrawn: BTreeMap<usize, Undrawn> = BTreeMap::new();
        let mut looks = Vec::with_capacity(definitions.len());
        for definition in definitions {
            let Some(definition) = definition else {
                looks.push(Look::default());
                continue;
            };
            let mut definition = definition.clone();
            let picture =
                definition.texture.take().map(|(line, operand)| self.picture(&mut definition, line, &operand));
            let Definition { specular, shininess, .. } = definition;
            let colour = self.colour(&definition, picture.as_ref());
            looks.push(Look { colour, picture, specular, shininess });
            if !definition.undrawn.is_empty() {
                undrawn.entry(definition.file).or_default().add(definition.undrawn);
            }
        }
        self.warnings.extend(undrawn.into_iter().map(|(file, undrawn)| undrawn.warning(&self.libraries.paths[file])));
        looks
    }

    /// The colour of a surface, which multiplies its texture: white if only a texture is given. Some programs write
    /// black there.
    fn colour(&mut self, definition: &Definition, picture: Option<&Picture>) -> [f64; 3] {
        let Some(picture) = picture else { return definition.colour.unwrap_or(GREY) };
        if definition.colour == Some([0.0; 3]) {
            let problem = || "`Kd` is black under this texture, so the texture is drawn as under white".to_owned();
            self.libraries.notes[definition.file].add("black", picture.line, problem, "write `Kd 1 1 1`");
        }
        definition.colour.filter(|&colour| colour != [0.0; 3]).unwrap_or(WHITE)
    }

    /// The texture that a `map_Kd` names.
    fn picture(&mut self, definition: &mut Definition, line: usize, operand: &[u8]) -> Picture {
        let library = self.libraries.paths[definition.file].clone();
        let folders = [&library, self.obj].map(|path| path.parent().unwrap_or(Path::new("")));
        let (map, wrong) = match map::read(operand, |name| find(folders[0], name).is_some()) {
            Ok(map) => (map, None),
            Err(wrong) => (Map::default(), Some(wrong)),
        };
        let Map { name, placement, undrawn } = map;
        undrawn.into_iter().for_each(|option| definition.leave_out(&quote(option), line));
        let missing = expected(folders[0], &name);
        let path = find(folders[0], &name).or_else(|| {
            let path = self.finder.find_loosely(&folders, &name).filter(|_| !name.is_empty())?;
            let problem = || format!("there is no texture {}, so {} is drawn", shown(&missing), shown(&path));
            self.libraries.notes[definition.file].add("moved", line, problem, "correct the path");
            Some(path)
        });
        let wrong = wrong.or_else(|| unknown_option(&name).filter(|_| path.is_none()));
        let path = path.unwrap_or_else(|| missing.clone());
        Picture { library, line, path, placement, wrong }
    }
}

/// Warns about missing files: the line of the first, its expected path, how many more there are, and the substitutes.
fn missing_files((line, path, more): (usize, PathBuf, usize), in_place: Option<&Path>) -> String {
    let path = shown(&path);
    let (files, whose, them) = match more {
        0 => (format!("the material file {path} is missing"), "its", "it"),
        more => (format!("the material files {path} and {more} more are missing"), "their", "them"),
    };
    let result = match in_place {
        Some(own) => format!("so {} is read", shown(own)),
        None => format!("so {whose} materials are grey"),
    };
    format!("{line}: {files}, {result}: put {them} beside the mesh")
}

/// Warns that a name without a file begins like an option.
fn unknown_option(name: &[u8]) -> Option<Wrong> {
    if name.is_empty() {
        return Some(("`map_Kd` without a file".to_owned(), "give its name after the options"));
    }
    let first = words(name).next().map(|(begin, end)| &name[begin..end]).filter(|word| word.starts_with(b"-"))?;
    Some((format!("`map_Kd` with the option {}", quote_bytes(first)), "remove it, or correct the name of the file"))
}

/// Statements about one file's materials that are not drawn.
#[derive(Default)]
struct Undrawn {
    lines: BTreeMap<String, usize>,
    materials: usize,
}

/// The most statements in such a warning.
const MOST_STATEMENTS: usize = 8;

impl Undrawn {
    fn add(&mut self, lines: BTreeMap<String, usize>) {
        self.materials += 1;
        for (what, line) in lines {
            let first = self.lines.entry(what).or_insert(line);
            *first = line.min(*first);
        }
    }

    fn warning(&self, path: &Path) -> String {
        let mut what: Vec<String> = self.lines.keys().take(MOST_STATEMENTS).cloned().collect();
        let more = self.lines.len() - what.len();
        if more > 0 {
            what.push(format!("{more} more"));
        }
        let last = what.pop().unwrap_or_default();
        let what = if what.is_empty() { last } else { format!("{} and {last}", what.join(", ")) };
        let verb = if self.lines.len() == 1 { "is" } else { "are" };
        let of = if self.materials == 1 { String::new() } else { format!(" and {} more", self.materials - 1) };
        let line = self.lines.values().min().copied().unwrap_or_default();
        format!(
            "{}:{line}: {what} of this material{of} {verb} not drawn: a surface has a colour (Kd), a texture (map_Kd) and white highlights (Ks, Ns)",
            shown(path)
        )
    }
}

/// Names by likeness; none if several are alike.
fn by_likeness(found: &BTreeMap<Vec<u8>, Definition>) -> BTreeMap<Vec<u8>, Option<&[u8]>> {
    let mut all: BTreeMap<Vec<u8>, Option<&[u8]>> = BTreeMap::new();
    for name in found.keys() {
        all.entry(likeness(name)).and_modify(|other| *other = None).or_insert(Some(name));
    }
    all
}

/// The common form of names that differ only in a comment behind them, in quotes, in blanks or in case.
fn likeness(name: &[u8]) -> Vec<u8> {
    let name = without_comment(name);
    let words: Vec<&[u8]> = words(name).map(|(begin, end)| &name[begin..end]).collect();
    let words = words.join(&b' ').to_ascii_lowercase();
    match &words[..] {
        [b'"', within @ .., b'"'] => within.to_owned(),
        _ => words,
    }
}

/// A name up to a number sign where a word begins; the whole name if it begins with one.
fn without_comment(name: &[u8]) -> &[u8] {
    let sign = words(name).skip(1).find(|&(begin, _)| name[begin] == b'#');
    sign.map_or(name, |(begin, _)| trimmed(&name[..begin]))
}

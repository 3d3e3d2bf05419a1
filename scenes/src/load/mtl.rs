//! MTL files: the looks of their materials, as far as they are drawn.
//!
//! Statements that would change the picture but are not drawn are kept with their lines, and reported for materials
//! that a mesh uses.

use super::lines::{At, Statement, statements};
use super::notes::Notes;
use super::numbers::{numbers, parsed};
use crate::error::SceneError;
use crate::input::{self, read_text};
use crate::quote::{quote, quote_bytes, shown};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The content of an MTL file for a material.
#[derive(Clone, Default)]
pub(super) struct Definition {
    /// Its file, by index in [`Libraries::paths`], and its line there.
    pub(super) file: usize,
    pub(super) line: usize,
    /// The diffuse colour.
    pub(super) colour: Option<[f64; 3]>,
    /// The line and the operand of `map_Kd`.
    pub(super) texture: Option<(usize, Vec<u8>)>,
    /// The brightness of highlights, 0 to 1.
    pub(super) specular: Option<f64>,
    /// The power of the cosine that makes them, as the file has it.
    pub(super) shininess: Option<f64>,
    /// Its statements that are not drawn, with the line of each.
    pub(super) undrawn: BTreeMap<String, usize>,
    /// The line and the colour of `Ka`, and the line and the operand of `map_Ka`.
    ambient: Option<(usize, [f64; 3])>,
    ambient_texture: Option<(usize, Vec<u8>)>,
    /// The line of a `Tr` that is neither 0 nor 1; and whether a `d` overrides it.
    transparency: Option<usize>,
    has_density: bool,
    /// Whether its lighting model is one without highlights.
    is_dull: bool,
}

/// The MTL files of a mesh, in the sequence in which they are searched.
#[derive(Default)]
pub(super) struct Libraries {
    pub(super) paths: Vec<PathBuf>,
    /// The problems in each of them.
    pub(super) notes: Vec<Notes>,
    pub(super) found: BTreeMap<Vec<u8>, Definition>,
}

/// Maps that are not drawn.
const MAPS: [&str; 17] = [
    "map_ks",
    "map_ns",
    "map_ke",
    "map_d",
    "map_tr",
    "map_opacity",
    "map_bump",
    "map_disp",
    "bump",
    "disp",
    "decal",
    "refl",
    "norm",
    "map_pr",
    "map_pm",
    "map_ps",
    "map_refl",
];

/// Numbers that are not drawn, unless they are zero.
const AMOUNTS: [&str; 7] = ["ke", "pm", "ps", "pc", "pcr", "aniso", "anisor"];

/// Statements that change no picture of opaque surfaces: refraction and filtering, sharpness of reflections, and
/// roughness of surfaces whose highlights `Ns` describes.
const IGNORED: [&str; 5] = ["ni", "tf", "sharpness", "pr", "map_aat"];

/// Channels that differ by less are considered equal.
const ALIKE: f64 = 1.0 / 255.0;

impl Libraries {
    /// Reads an MTL file. If two materials have the same name, the first file's is used, and within one file the later
    /// one. For those that are used and differ, there is a note.
    pub(super) fn read(&mut self, path: PathBuf, used: &BTreeSet<&[u8]>) -> Result<(), SceneError> {
        if self.paths.contains(&path) {
            return Ok(());
        }
        let file = self.paths.len();
        let mut notes = Notes::default();
        let mut own: BTreeMap<Vec<u8>, Definition> = BTreeMap::new();
        for (name, definition) in definitions(&path, file, &mut notes)? {
            let line = definition.line;
            if let Some(other) = own.insert(name.clone(), definition)
                && used.contains(&name[..])
                && own.get(&name).is_some_and(|this| this.differs(&other))
            {
                let problem = || {
                    format!(
                        "the material {} is defined in line {} as well, and otherwise; this one is drawn",
                        quote_bytes(&name),
                        other.line
                    )
                };
                notes.add("twice", line, problem, "give each a name of its own");
            }
        }
        for (name, definition) in own {
            match self.found.get(&name) {
                Some(first) if used.contains(&name[..]) && first.differs(&definition) => {
                    let problem = || {
                        let at = shown(&self.paths[first.file]);
                        format!(
                            "the material {} is defined in {at}:{} before, and otherwise; that one is drawn",
                            quote_bytes(&name),
                            first.line
                        )
                    };
                    notes.add("elsewhere", definition.line, problem, "give each a name of its own");
                }
                Some(_) => {}
                None => {
                    self.found.insert(name, definition);
                }
            }
        }
        self.paths.push(path);
        self.notes.push(notes);
        Ok(())
    }
}

/// The materials of a file, in sequence.
fn definitions(path: &Path, file: usize, notes: &mut Notes) -> Result<Vec<(Vec<u8>, Definition)>, SceneError> {
    let bytes = read_text(path, &input::MATERIALS)?;
    let mut all: Vec<(Vec<u8>, Definition)> = Vec::new();
    for statement in statements(&bytes) {
        let at = At { path, line: statement.line };
        let keyword = statement.keyword();
        match (&*keyword, all.last_mut()) {
            ("newmtl", _) if statement.name().is_empty() => {
                return Err(at.error("`newmtl` without a name", "give the name after it"));
            }
            ("newmtl", _) => {
                let definition = Definition { file, line: at.line, ..Definition::default() };
                all.push((statement.name().to_owned(), definition));
            }
            (_, Some((_, definition))) => definition.take(at, &statement, notes)?,
            ("kd" | "ks" | "ns" | "map_kd", None) => {
                let problem = format!("{} before any `newmtl`", quote(&statement.spelled()));
                return Err(at.error(problem, "name the material first"));
            }
            (_, None) => {
                let problem = || format!("{} before any `newmtl` is not read", quote(&statement.spelled()));
                notes.add("before", at.line, problem, "name the material first");
            }
        }
    }
    all.iter_mut().for_each(|(_, definition)| definition.finish());
    Ok(all)
}

impl Definition {
    /// Processes a statement.
    fn take(&mut self, at: At, statement: &Statement, notes: &mut Notes) -> Result<(), SceneError> {
        let keyword = statement.keyword();
        let words: Vec<&[u8]> = statement.words().take(9).collect();
        let name = || Some(statement.name()).filter(|name| !name.is_empty()).map(|name| (at.line, name.to_owned()));
        let number = || words.first().and_then(|word| parsed(word));
        let spelled = statement.spelled();
        match &*keyword {
            "kd" => self.colour = self.reflectivity(at, "Kd", &words)?.or(self.colour),
            "ka" => self.ambient = self.reflectivity(at, "Ka", &words)?.map(|colour| (at.line, colour)),
            "ks" => {
                if let Some(colour) = self.reflectivity(at, "Ks", &words)? {
                    // Highlights are white here, as bright as the brightest channel.
                    let [least, greatest] = extremes(colour);
                    self.specular = Some(greatest);
                    if greatest - least > ALIKE {
                        self.leave_out("the hue of `Ks`", at.line);
                    }
                }
            }
            "ns" => self.shininess = Some(numbers::<1>(at, "Ns", &words, &[1])?[0]),
            "map_kd" => {
                self.texture = name();
                if self.texture.is_none() {
                    let problem = || "`map_Kd` without a file, so there is no texture".to_owned();
                    notes.add("map_Kd", at.line, problem, "give its name after it");
                }
            }
            "map_ka" => self.ambient_texture = name(),
            "d" => {
                self.has_density = true;
                if number().is_none_or(|density| density < 1.0) {
                    self.leave_out(&quote(&spelled), at.line);
                }
            }
            // Some programs mean the density by it; a value other than 0 and 1 says that a surface is partly
            // transparent.
            "tr" => self.transparency = number().is_none_or(|part| part > 0.0 && part < 1.0).then_some(at.line),
            "illum" => {
                let model = number();
                self.is_dull = matches!(model, Some(0.0 | 1.0));
                if !matches!(model, Some(1.0 | 2.0)) {
                    let word = words.first().copied().unwrap_or_default();
                    self.leave_out(&quote(&format!("illum {}", String::from_utf8_lossy(word))), at.line);
                }
            }
            map if MAPS.contains(&map) && name().is_none() => {}
            amount if AMOUNTS.contains(&amount) && words.iter().all(|word| parsed(word) == Some(0.0)) => {}
            ignored if IGNORED.contains(&ignored) => {}
            _ => self.leave_out(&quote(&spelled), at.line),
        }
        Ok(())
    }

    /// Notes that something is not drawn.
    pub(super) fn leave_out(&mut self, what: &str, line: usize) {
        self.undrawn.entry(what.to_owned()).or_insert(line);
    }

    /// One number for all channels, or three; `None` if it is a spectrum or another colour space.
    fn reflectivity(&mut self, at: At, keyword: &str, words: &[&[u8]]) -> Result<Option<[f64; 3]>, SceneError> {
        if let Some(form) = words.first().filter(|word| [&b"spectral"[..], b"xyz"].contains(word)) {
            self.leave_out(&format!("`{keyword} {}`", String::from_utf8_lossy(form)), at.line);
            return Ok(None);
        }
        let [r, g, b] = numbers::<3>(at, keyword, words, &[1, 3])?;
        let rgb = if words.len() == 1 { [r; 3] } else { [r, g, b] };
        if rgb.iter().any(|channel| !(0.0..=1.0).contains(channel)) && keyword != "Ka" {
            self.leave_out(&format!("`{keyword}` outside 0 to 1"), at.line);
        }
        Ok(Some(rgb.map(|channel| channel.clamp(0.0, 1.0))))
    }

    /// Decides what depends on several statements.
    fn finish(&mut self) {
        let undrawn = [
            // The scene decides how bright ambient light is.
            self.ambient
                .filter(|&(_, ambient)| !alike_in_hue(ambient, self.colour.unwrap_or([1.0; 3])))
                .map(|(line, _)| ("the hue of `Ka`", line)),
            self.ambient_texture
                .as_ref()
                .filter(|(_, name)| self.texture.as_ref().is_none_or(|(_, texture)| texture != name))
                .map(|&(line, _)| ("`map_Ka`", line)),
            self.transparency.filter(|_| !self.has_density).map(|line| ("`Tr`", line)),
        ];
        undrawn.into_iter().flatten().for_each(|(what, line)| self.leave_out(what, line));
        if self.is_dull {
            self.specular = Some(0.0);
        }
    }

    /// Whether it gives a different picture from the other one.
    fn differs(&self, other: &Definition) -> bool {
        let looks = |this: &Definition| {
            let texture = this.texture.as_ref().map(|(_, name)| name.clone());
            (this.colour, texture, this.specular, this.shininess)
        };
        looks(self) != looks(other)
    }
}

/// Whether a colour has no hue, or the same hue as the other one.
fn alike_in_hue(colour: [f64; 3], other: [f64; 3]) -> bool {
    let [least, greatest] = extremes(colour);
    let [_, most] = extremes(other);
    greatest - least <= ALIKE || (0..3).all(|i| (colour[i] * most - other[i] * greatest).abs() <= ALIKE)
}

/// The least channel and the greatest.
fn extremes(colour: [f64; 3]) -> [f64; 2] {
    [colour.into_iter().fold(1.0, f64::min), colour.into_iter().fold(0.0, f64::max)]
}

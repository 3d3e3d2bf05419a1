//! Materials of an OBJ file: the diffuse colours (Kd) of its MTL files; and for deferred shading their textures (map_Kd) and highlights
//! (Ks, Ns).
//!
//! A missing MTL file is a warning, not an error: such files often get lost when a mesh travels, and every triangle is still there,
//! in grey. One that is there but malformed is an error, like any malformed file.

use super::lines::{At, logical_lines, numbers};
use super::obj_scan::Scan;
use super::parts::GREY;
use crate::error::SceneError;
use crate::input::{self, read_lines};
use crate::quote::{quote, shown};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What an MTL file says of a material.
#[derive(Clone)]
pub(super) struct Look {
    /// The diffuse colour.
    pub(super) colour: [f64; 3],
    pub(super) texture: Option<TextureName>,
    /// The brightness of highlights, 0 to 1.
    pub(super) specular: Option<f64>,
    /// The power of the cosine that makes them, as the file has it.
    pub(super) shininess: Option<f64>,
}

/// The name of a texture, and where it stands.
#[derive(Clone)]
pub(super) struct TextureName {
    /// The MTL file.
    pub(super) library: PathBuf,
    pub(super) line: usize,
    /// Relative to the MTL file's folder.
    pub(super) name: String,
}

impl Default for Look {
    fn default() -> Look {
        Look { colour: GREY, texture: None, specular: None, shininess: None }
    }
}

/// What a mesh's materials look like, in the order of [`Scan::materials`]. The paths of their files go to
/// `files`, what is odd to `warnings`.
pub(super) fn looks(
    obj: &Path,
    scan: &Scan,
    files: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Result<Vec<Look>, SceneError> {
    let mut found = BTreeMap::new();
    let mut complete = true;
    for (line, operand) in &scan.libraries {
        for path in library_paths(obj, operand) {
            if path.exists() {
                read_library(&path, &mut found)?;
                files.push(path);
            } else {
                complete = false;
                warnings.push(format!(
                    "{}:{line}: the material file {} is missing, so its materials are grey: put it beside the mesh",
                    shown(obj),
                    shown(&path)
                ));
            }
        }
    }
    let look = |(line, name): &(usize, String)| {
        // After a missing file, that warning says it all.
        if complete && !found.contains_key(name) {
            warnings.push(format!(
                "{}:{line}: no MTL file defines the material {}, so it is grey: define it, or name its file with mtllib",
                shown(obj),
                quote(name)
            ));
        }
        found.get(name).cloned().unwrap_or_default()
    };
    Ok(scan.materials.iter().map(look).collect())
}

/// The files that the operand of `mtllib` names: one, whose name may hold blanks, or else several.
fn library_paths(obj: &Path, operand: &str) -> Vec<PathBuf> {
    let folder = obj.parent().unwrap_or(Path::new(""));
    let whole = folder.join(operand);
    if whole.exists() || !operand.to_lowercase().contains(".mtl ") {
        return vec![whole];
    }
    operand.split_whitespace().map(|name| folder.join(name)).collect()
}

/// Adds an MTL file's materials; of two with one name the later one holds.
fn read_library(path: &Path, found: &mut BTreeMap<String, Look>) -> Result<(), SceneError> {
    let bytes = read_lines(path, &input::MATERIALS)?;
    let mut current: Option<String> = None;
    for (line, statement) in logical_lines(&String::from_utf8_lossy(&bytes)) {
        let at = At { path, line };
        let words: Vec<&str> = statement.split_whitespace().collect();
        let Some((&keyword, operands)) = words.split_first() else {
            continue;
        };
        let rest = statement.trim_start()[keyword.len()..].trim();
        match keyword {
            "newmtl" if rest.is_empty() => return Err(at.error("`newmtl` without a name", "give the name after it")),
            "newmtl" => {
                found.insert(rest.to_owned(), Look::default());
                current = Some(rest.to_owned());
            }
            "Kd" | "Ks" | "Ns" | "map_Kd" => {
                let look = current.as_ref().and_then(|name| found.get_mut(name));
                let missing = || at.error(format!("`{keyword}` before any `newmtl`"), "name the material first");
                look.ok_or_else(missing)?.take(at, keyword, operands, rest)?;
            }
            // What else a material says is not drawn here.
            _ => {}
        }
    }
    Ok(())
}

impl Look {
    /// Takes what a statement says.
    fn take(&mut self, at: At, keyword: &str, operands: &[&str], rest: &str) -> Result<(), SceneError> {
        match keyword {
            "Kd" => self.colour = colour(at, keyword, operands)?,
            // Highlights are white here, as bright as the brightest channel.
            "Ks" => self.specular = Some(colour(at, keyword, operands)?.into_iter().fold(0.0, f64::max)),
            "Ns" => self.shininess = Some(numbers::<1>(at, keyword, operands, &[1])?[0]),
            _ if rest.is_empty() => {
                return Err(at.error(format!("`{keyword}` without a file"), "give its name after it"));
            }
            _ => {
                let name = rest.to_owned();
                self.texture = Some(TextureName { library: at.path.to_owned(), line: at.line, name });
            }
        }
        Ok(())
    }
}

/// One number for all channels, or three. Some programs write brighter colours than a surface can have.
fn colour(at: At, keyword: &str, operands: &[&str]) -> Result<[f64; 3], SceneError> {
    let [r, g, b] = numbers::<3>(at, keyword, operands, &[1, 3])?;
    let rgb = if operands.len() == 1 { [r; 3] } else { [r, g, b] };
    Ok(rgb.map(|c| c.clamp(0.0, 1.0)))
}

//! Materials of an OBJ file: the diffuse colours (Kd) of its MTL files.
//!
//! A missing MTL file is a warning, not an error: such files often get lost when a mesh travels, and every triangle is still there,
//! in grey. One that is there but malformed is an error, like any malformed file.

use super::lines::{At, logical_lines, numbers};
use super::obj_scan::Scan;
use crate::error::SceneError;
use crate::input::{self, read_lines};
use crate::quote::{quote, shown};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The colour of what has no material.
pub(super) const GREY: [f64; 3] = [0.8; 3];

/// The diffuse colours of a mesh's materials, in the order of [`Scan::materials`]. The paths of their files go to
/// `files`, what is odd to `warnings`.
pub(super) fn diffuse_colours(
    obj: &Path,
    scan: &Scan,
    files: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Result<Vec<[f64; 3]>, SceneError> {
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
    let colour = |(line, name): &(usize, String)| {
        // After a missing file, that warning says it all.
        if complete && !found.contains_key(name) {
            warnings.push(format!(
                "{}:{line}: no MTL file defines the material {}, so it is grey: define it, or name its file with mtllib",
                shown(obj),
                quote(name)
            ));
        }
        found.get(name).copied().unwrap_or(GREY)
    };
    Ok(scan.materials.iter().map(colour).collect())
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

/// Adds the colours of an MTL file's materials; of two with one name the later one holds.
fn read_library(path: &Path, found: &mut BTreeMap<String, [f64; 3]>) -> Result<(), SceneError> {
    let bytes = read_lines(path, &input::MATERIALS)?;
    let mut current: Option<String> = None;
    for (line, statement) in logical_lines(&String::from_utf8_lossy(&bytes)) {
        let at = At { path, line };
        let words: Vec<&str> = statement.split_whitespace().collect();
        match words[..] {
            ["newmtl"] => return Err(at.error("`newmtl` without a name", "give the name after it")),
            ["newmtl", ..] => {
                let name = statement.trim_start()["newmtl".len()..].trim().to_owned();
                found.insert(name.clone(), GREY);
                current = Some(name);
            }
            ["Kd", ref colour @ ..] => {
                let Some(current) = &current else {
                    return Err(at.error("`Kd` before any `newmtl`", "name the material first"));
                };
                let [r, g, b] = numbers::<3>(at, "Kd", colour, &[1, 3])?;
                let rgb = if colour.len() == 1 { [r; 3] } else { [r, g, b] };
                // Some programs write brighter colours than a diffuse surface can have.
                found.insert(current.clone(), rgb.map(|c| c.clamp(0.0, 1.0)));
            }
            // What else a material says is not drawn here.
            _ => {}
        }
    }
    Ok(())
}

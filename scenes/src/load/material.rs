//! Materials of an OBJ file: the diffuse colours (Kd) of its MTL files.
//!
//! A missing MTL file is a warning, not an error: such files often get lost when a mesh travels, and every triangle is still there,
//! in grey. One that is there but malformed is an error, like any malformed file.

use super::obj_scan::{At, Scan, logical_lines, numbers};
use crate::SceneError;
use crate::input::read_bytes;
use std::path::{Path, PathBuf};

/// The colour of what has no material.
pub(super) const GREY: [f64; 3] = [0.8; 3];

/// The MTL files of an OBJ file, in a plain form for `tobj`: `newmtl` and `Kd` alone, and names as [`Scan::materials`] numbers
/// them. What is odd goes to `warnings`.
pub(super) fn plain_materials(obj: &Path, scan: &Scan, warnings: &mut Vec<String>) -> Result<String, SceneError> {
    let mut found: Vec<(String, [f64; 3])> = Vec::new();
    let mut complete = true;
    for (line, operand) in &scan.libraries {
        for path in library_paths(obj, operand) {
            if path.exists() {
                read_library(&path, &mut found)?;
            } else {
                complete = false;
                warnings.push(format!(
                    "{}:{line}: the material file {} is missing, so its materials are grey: put it beside the mesh",
                    obj.display(),
                    path.display()
                ));
            }
        }
    }
    let mut plain = String::new();
    for (index, (line, name)) in scan.materials.iter().enumerate() {
        // Of two materials with one name the later one holds.
        match found.iter().rev().find(|(known, _)| known == name) {
            Some((_, [r, g, b])) => plain.push_str(&format!("newmtl {index}\nKd {r} {g} {b}\n")),
            // After a missing file, that warning says it all.
            None if complete => warnings.push(format!(
                "{}:{line}: no MTL file defines the material `{name}`, so it is grey: define it, or name its file with mtllib",
                obj.display()
            )),
            None => {}
        }
    }
    Ok(plain)
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

fn read_library(path: &Path, found: &mut Vec<(String, [f64; 3])>) -> Result<(), SceneError> {
    let bytes = read_bytes(path, "make it readable, or remove the mtllib line")?;
    let mut current = None;
    for (line, statement) in logical_lines(&String::from_utf8_lossy(&bytes)) {
        let at = At { path, line };
        let words: Vec<&str> = statement.split_whitespace().collect();
        match words[..] {
            ["newmtl"] => return Err(at.error("`newmtl` without a name", "give the name after it")),
            ["newmtl", ..] => {
                let name = statement.trim_start()["newmtl".len()..].trim();
                found.push((name.to_owned(), GREY));
                current = Some(found.len() - 1);
            }
            ["Kd", ref colour @ ..] => {
                let Some(current) = current else {
                    return Err(at.error("`Kd` before any `newmtl`", "name the material first"));
                };
                let [r, g, b] = numbers::<3>(at, "Kd", colour, &[1, 3])?;
                let rgb = if colour.len() == 1 { [r; 3] } else { [r, g, b] };
                // Some programs write brighter colours than a diffuse surface can have.
                found[current].1 = rgb.map(|c| c.clamp(0.0, 1.0));
            }
            // What else a material says is not drawn here.
            _ => {}
        }
    }
    Ok(())
}

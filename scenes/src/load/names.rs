//! Names of scenes: a file's own, and the built-in one that a misspelt name may mean.

use super::mesh_file::ENDINGS;
use crate::builtin;
use crate::error::SceneError;
use std::path::Path;

/// A file's name without folder and extension.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}

pub(super) fn unknown_name(name: &str) -> SceneError {
    let all = builtin::NAMES.join(", ");
    let files = format!("or name a .toml, {ENDINGS} file");
    SceneError::UnknownScene {
        name: name.to_owned(),
        remedy: match nearest(name) {
            Some(known) => format!("did you mean `{known}`? The built-in scenes are {all}; {files}"),
            None => format!("the built-in scenes are {all}; {files}"),
        },
    }
}

/// The built-in scene that a misspelt name may mean.
pub(super) fn nearest(name: &str) -> Option<&'static str> {
    let lower = name.to_lowercase();
    let (edits, known) = builtin::NAMES.into_iter().map(|known| (strsim::levenshtein(&lower, known), known)).min()?;
    (edits <= 1 + known.len() / 4).then_some(known)
}

//! The files of the repository, for tests that read them all.

use std::fs;
use std::path::{Path, PathBuf};

/// The files below a folder with one of these extensions, sorted; without `target` and what is hidden.
pub fn files(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if name.starts_with('.') || name == "target" {
            continue;
        }
        if path.is_dir() {
            files.extend(self::files(&path, extensions));
        } else if path.extension().is_some_and(|it| extensions.iter().any(|extension| it == *extension)) {
            files.push(path);
        }
    }
    files.sort();
    files
}

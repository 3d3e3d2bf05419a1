//! Warnings about lines of a file: each kind once, with its first line and the number of further ones.

use super::lines::At;
use crate::error::SceneError;
use crate::quote::shown;
use std::collections::BTreeMap;
use std::path::Path;

/// The kinds of a face and a polyline that have too few corners.
pub(super) const FACE: &str = "a face";
pub(super) const POLYLINE: &str = "a polyline";

/// Harmless problems in the lines of a file.
#[derive(Debug, Default)]
pub(super) struct Notes {
    /// The common data of a kind: first line, problem, remedy, and number of lines.
    kinds: BTreeMap<&'static str, (usize, String, &'static str, usize)>,
}

impl Notes {
    /// Adds a note; the text of the first of its kind stands for all.
    pub(super) fn add(
        &mut self,
        kind: &'static str,
        line: usize,
        problem: impl FnOnce() -> String,
        remedy: &'static str,
    ) {
        self.kinds.entry(kind).or_insert_with(|| (line, problem(), remedy, 0)).3 += 1;
    }

    /// The error for a file in which nothing has enough corners.
    pub(super) fn too_few(&self, path: &Path) -> Option<SceneError> {
        let (line, problem, remedy, _) = [FACE, POLYLINE].iter().find_map(|kind| self.kinds.get(kind))?;
        Some(At { path, line: *line }.error(problem.clone(), *remedy))
    }

    /// The sentences, sorted by line.
    pub(super) fn warnings(self, path: &Path) -> impl Iterator<Item = String> {
        let mut all: Vec<_> = self.kinds.into_values().collect();
        all.sort_by_key(|&(line, ..)| line);
        let path = shown(path);
        all.into_iter().map(move |(line, problem, remedy, lines)| {
            let more = match lines {
                1 => String::new(),
                2 => ", and so on in 1 more line".to_owned(),
                lines => format!(", and so on in {} more lines", lines - 1),
            };
            format!("{path}:{line}: {problem}{more}: {remedy}")
        })
    }
}

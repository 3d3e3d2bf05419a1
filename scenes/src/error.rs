//! Everything a user can get wrong, each as one sentence that names the place and the remedy.

use crate::quote::{quote, shown};
use std::path::PathBuf;

/// A mistake in a scene, a file or a name. `Display` is the whole sentence.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// A width or height out of range.
    #[error("an image of {width}x{height} pixels cannot be rendered: give a width and a height between 1 and 2048")]
    Size {
        /// The width asked for, in pixels.
        width: i64,
        /// The height asked for, in pixels.
        height: i64,
    },
    /// A name that is neither a built-in scene nor a file.
    #[error("there is no scene {}: {remedy}", quote(name))]
    UnknownScene {
        /// The requested name.
        name: String,
        /// The remedy: what to type instead.
        remedy: String,
    },
    /// A file that cannot be opened or read.
    #[error("{}: cannot be read ({reason}): {remedy}", shown(path))]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's message.
        reason: String,
        /// The remedy.
        remedy: String,
    },
    /// A file that cannot be written; nothing of it is left behind.
    #[error("{}: cannot be written ({reason}): {remedy}", shown(path))]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's message.
        reason: String,
        /// The remedy.
        remedy: String,
    },
    /// A mistake in a line of a file.
    #[error("{}:{line}: {problem}: {remedy}", shown(path))]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// The problem.
        problem: String,
        /// The remedy: what to write instead.
        remedy: String,
    },
    /// A mistake at a place of a scene file.
    #[error("{}:{line}:{column}: {problem}: {remedy}", shown(path))]
    Place {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// The column in characters, counted from 1.
        column: usize,
        /// The problem.
        problem: String,
        /// The remedy: what to write instead.
        remedy: String,
    },
    /// A mistake in a file as a whole.
    #[error("{}: {problem}: {remedy}", shown(path))]
    File {
        /// The file.
        path: PathBuf,
        /// The problem.
        problem: String,
        /// The remedy.
        remedy: String,
    },
    /// A mesh, camera or light made in code that gives no picture.
    #[error("{problem}: {remedy}")]
    Invalid {
        /// The problem.
        problem: String,
        /// The remedy.
        remedy: String,
    },
}

impl SceneError {
    pub(crate) fn invalid(problem: impl Into<String>, remedy: impl Into<String>) -> SceneError {
        SceneError::Invalid { problem: problem.into(), remedy: remedy.into() }
    }
}

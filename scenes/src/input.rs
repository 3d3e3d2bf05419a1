//! Reads a user's file: up to a limit, and with an error that names the file.

use crate::error::SceneError;
use crate::output::reason;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The kind of a file.
pub(crate) struct Kind {
    /// The largest size that is read, in MiB.
    limit: u64,
    /// What to do if it is larger.
    smaller: &'static str,
    /// What to do if it cannot be read.
    readable: &'static str,
}

const SCENE_OR_MESH: &str = "name a .toml, .obj, .gltf, .glb, .ply or .stl file that you may read, or a built-in scene";

/// A scene file.
pub(crate) const SCENE: Kind = Kind { limit: 1, smaller: "name a scene file", readable: SCENE_OR_MESH };
/// A mesh; a file of the largest size has about three million polygons.
pub(crate) const MESH: Kind = Kind { limit: 256, smaller: "simplify the mesh, or cut it", readable: SCENE_OR_MESH };
/// A part of a mesh, in a separate file.
pub(crate) const BUFFER: Kind =
    Kind { limit: 256, smaller: "simplify the mesh, or cut it", readable: "make it readable" };
/// The materials of a mesh.
pub(crate) const MATERIALS: Kind = Kind {
    limit: 16,
    smaller: "remove what the mesh does not use",
    readable: "make it readable, or remove the mtllib line",
};
/// A picture of at most 2048x2048 pixels: twice what its bytes take before they are compressed.
pub(crate) const PICTURE: Kind = Kind { limit: 64, smaller: "name a picture of a frame", readable: "name a PNG file" };

/// A texture of any size, as its file has it.
pub(crate) const TEXTURE: Kind = Kind { limit: 64, smaller: "name a smaller picture", readable: "make it readable" };

/// Opens a file, or says why it cannot be read.
pub(crate) fn open(path: &Path, kind: &Kind) -> Result<File, SceneError> {
    // Opening a directory for reading succeeds on some systems.
    match path.is_dir() {
        true => Err(unreadable(path, kind, &io::ErrorKind::IsADirectory.into())),
        false => File::open(path).map_err(|error| unreadable(path, kind, &error)),
    }
}

/// The bytes of a file.
pub(crate) fn read_bytes(path: &Path, kind: &Kind) -> Result<Vec<u8>, SceneError> {
    let file = open(path, kind)?;
    let failed = |error: io::Error| unreadable(path, kind, &error);
    let most = kind.limit << 20;
    // A device or a pipe does not know its length, so the bytes are counted as well.
    let length = file.metadata().map_err(failed)?.len();
    let mut bytes = Vec::with_capacity(length.min(most) as usize);
    if length <= most {
        file.take(most + 1).read_to_end(&mut bytes).map_err(failed)?;
    }
    if length.max(bytes.len() as u64) > most {
        return Err(SceneError::File {
            path: path.to_owned(),
            problem: format!("is larger than {} MiB, the most that is read", kind.limit),
            remedy: kind.smaller.to_owned(),
        });
    }
    Ok(bytes)
}

/// The bytes of a file of lines, in ASCII or in an encoding that contains it.
pub(crate) fn read_lines(path: &Path, kind: &Kind) -> Result<Vec<u8>, SceneError> {
    let bytes = read_text(path, kind)?;
    let ends = bytes.iter().filter(|&&byte| byte == b'\n').count();
    if bytes.windows(2).filter(|pair| pair[0] == b'\r' && pair[1] != b'\n').count() > ends {
        return Err(no_text(path, "ends its lines with CR alone", "save it with LF or CR LF at the ends of lines"));
    }
    Ok(bytes)
}

/// The bytes of a text, in ASCII or in an encoding that contains it, with any line endings.
pub(crate) fn read_text(path: &Path, kind: &Kind) -> Result<Vec<u8>, SceneError> {
    let bytes = read_bytes(path, kind)?;
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(no_text(path, "is text in UTF-16", "save it in UTF-8"));
    }
    if bytes.contains(&0) {
        let problem = "holds a zero byte, as UTF-16 and files that are no text do";
        return Err(no_text(path, problem, "save it as text in UTF-8"));
    }
    Ok(bytes)
}

fn no_text(path: &Path, problem: &str, remedy: &str) -> SceneError {
    SceneError::File { path: path.to_owned(), problem: problem.to_owned(), remedy: remedy.to_owned() }
}

fn unreadable(path: &Path, kind: &Kind, error: &io::Error) -> SceneError {
    SceneError::Read { path: path.to_owned(), reason: reason(error), remedy: kind.readable.to_owned() }
}

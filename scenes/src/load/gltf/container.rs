//! The content of a glTF file: its JSON, checked, and the binary part of a `.glb` file.

use crate::error::SceneError;
use crate::input::{self, read_bytes};
use crate::load::gltf::primitive::attribute;
use crate::quote::{brief, quote, shown};
use gltf_json::mesh::Semantic;
use gltf_json::validation::{Error, Validate};
use gltf_json::{Path as Place, Root};
use std::path::{Path, PathBuf};

/// The first bytes of all binary files.
const MAGIC: &[u8] = b"glTF";
/// The kinds of a binary file's parts.
const JSON: [u8; 4] = *b"JSON";
const BIN: [u8; 4] = *b"BIN\0";

/// The supported extensions.
const EXTENSIONS: [&str; 4] =
    ["KHR_materials_pbrSpecularGlossiness", "KHR_materials_unlit", "KHR_mesh_quantization", "KHR_texture_transform"];

pub(super) struct File {
    pub(super) path: PathBuf,
    pub(super) root: Root,
    /// Of a binary file.
    pub(super) blob: Option<Vec<u8>>,
}

impl File {
    pub(super) fn read(path: &Path) -> Result<File, SceneError> {
        let bytes = read_bytes(path, &input::MESH)?;
        let wrong = |problem: &str, remedy: &str| wrong(path, problem, remedy);
        let (json, blob) = match bytes.starts_with(MAGIC) {
            true => parts(&bytes).map_err(|problem| wrong(problem, "export it again"))?,
            false => (&bytes[..], None),
        };
        let blob = blob.map(<[u8]>::to_vec);
        let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
        // Instantiated in that crate: a generic function would be compiled here once more, and optimised.
        let root = Root::from_slice(json).map_err(|error| not_json(path, &error))?;
        let version = &root.asset.version;
        if !version.starts_with("2.") {
            return Err(wrong(&format!("is of version {} of glTF", quote(version)), "export it as glTF 2.0"));
        }
        let unknown: Vec<String> =
            root.extensions_required.iter().filter(|name| !is_known(name)).map(|name| quote(name)).collect();
        if !unknown.is_empty() {
            let problem = format!("needs the extensions {}, which are not read", unknown.join(", "));
            return Err(wrong(&problem, "export it without them"));
        }
        let mut first = dangling_positions(&root).map(|place| (place, Error::IndexOutOfBounds));
        // With such an index the crate's own checks panic.
        if first.is_none() {
            root.validate(&root, Place::new, &mut |place, error| {
                if first.is_none() && !is_harmless(&place(), error, &root) {
                    first = Some((place(), error));
                }
            });
        }
        if let Some((place, error)) = first {
            let place = if place.as_str().is_empty() { "the file".to_owned() } else { brief(place.as_str(), 200) };
            return Err(wrong(&format!("{place} {}", what(error)), "export it again"));
        }
        Ok(File { path: path.to_owned(), root, blob })
    }

    /// What is wrong with the file.
    pub(super) fn wrong(&self, problem: &str, remedy: &str) -> SceneError {
        wrong(&self.path, problem, remedy)
    }

    /// Sentences for parts of the file that are not drawn.
    pub(super) fn oddities(&self) -> Vec<String> {
        let root = &self.root;
        let unknown: Vec<String> =
            root.extensions_used.iter().filter(|name| !is_known(name)).map(|name| quote(name)).collect();
        let given = [
            (
                !unknown.is_empty(),
                format!("the extensions {} are not drawn: export it without them", unknown.join(", ")),
            ),
            (!root.animations.is_empty(), "its animations are not played: it is drawn as it rests".to_owned()),
            (
                !root.cameras.is_empty(),
                "its cameras are not used, as the mesh is framed: put one into a scene file".to_owned(),
            ),
        ];
        let given = given.into_iter().filter(|(is_given, _)| *is_given);
        given.map(|(_, sentence)| format!("{}: {sentence}", shown(&self.path))).collect()
    }
}

/// The first primitive whose positions are an accessor that the file does not have.
fn dangling_positions(root: &Root) -> Option<Place> {
    let meshes = root.meshes.iter().enumerate();
    let mut primitives =
        meshes.flat_map(|(i, mesh)| (0..).zip(&mesh.primitives).map(move |(j, primitive)| (i, j, primitive)));
    let (i, j, _) = primitives.find(|(_, _, primitive)| {
        attribute(primitive, Semantic::Positions).is_some_and(|index| root.get(index).is_none())
    })?;
    let primitive = Place::new().field("meshes").index(i).field("primitives").index(j);
    Some(primitive.field("attributes").key("POSITION"))
}

fn is_known(extension: &str) -> bool {
    EXTENSIONS.contains(&extension)
}

fn wrong(path: &Path, problem: &str, remedy: &str) -> SceneError {
    SceneError::File { path: path.to_owned(), problem: problem.to_owned(), remedy: remedy.to_owned() }
}

/// The JSON of a binary file, and the bytes after it.
fn parts(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), &'static str> {
    let word = |at: usize| bytes.get(at..at + 4)?.as_array().copied();
    let version = word(4).map(u32::from_le_bytes);
    let length = word(8).map(|length| u32::from_le_bytes(length) as usize).ok_or("ends within its header")?;
    if version != Some(2) {
        return Err("is a binary file of another version of glTF than 2");
    }
    let body = bytes.get(12..length).ok_or("is shorter than its header says")?;
    let (json, rest) = part(body, JSON)?;
    // Parts of unknown kinds are to be skipped.
    let blob = if rest.is_empty() { None } else { part(rest, BIN).ok().map(|(blob, _)| blob) };
    Ok((json, blob))
}

/// The next part of a binary file, and the rest behind it.
fn part(bytes: &[u8], kind: [u8; 4]) -> Result<(&[u8], &[u8]), &'static str> {
    let (head, rest) = bytes.split_first_chunk::<8>().ok_or("ends within the head of a part")?;
    let [a, b, c, d, found @ ..] = *head;
    if found != kind {
        return Err("does not begin with its JSON");
    }
    rest.split_at_checked(u32::from_le_bytes([a, b, c, d]) as usize).ok_or("has a part that is longer than the file")
}

fn not_json(path: &Path, error: &gltf_json::Error) -> SceneError {
    let sentence = error.to_string();
    let problem = sentence.rsplit_once(" at line ").map_or(sentence.as_str(), |(problem, _)| problem);
    SceneError::Place {
        path: path.to_owned(),
        line: error.line(),
        column: error.column(),
        problem: brief(problem, 200),
        remedy: "correct the JSON, or export the file again".to_owned(),
    }
}

/// Items that the checks report and this loader ignores: the least and greatest position, application-specific
/// attributes, accessors of zeros, and extensions, which are checked before.
fn is_harmless(place: &Place, error: Error, root: &Root) -> bool {
    let place = place.as_str();
    match error {
        Error::Missing | Error::Invalid if place.contains(".attributes") && !place.is_empty() => {
            let is_limit = place.ends_with(".min") || place.ends_with(".max");
            is_limit || matches!(error, Error::Invalid)
        }
        Error::Missing => {
            place.starts_with("accessors[") && place.ends_with(".bufferView") && !root.accessors.is_empty()
        }
        Error::Unsupported => true,
        _ => false,
    }
}

fn what(error: Error) -> &'static str {
    match error {
        Error::IndexOutOfBounds => "names something that is not there",
        Error::Invalid => "has a value that glTF does not have",
        Error::Missing => "is missing",
        Error::Oversize => "is too large",
        Error::Unsupported => "is not read",
    }
}

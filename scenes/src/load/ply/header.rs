//! The header of a PLY file: its elements and their form.

use super::super::lines::At;
use crate::error::SceneError;
use crate::quote::quote;
use std::path::Path;

/// The form in which numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Text,
    Little,
    Big,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of(name: &str) -> Option<Kind> {
        Some(match name {
            "char" | "int8" => Kind::I8,
            "uchar" | "uint8" => Kind::U8,
            "short" | "int16" => Kind::I16,
            "ushort" | "uint16" => Kind::U16,
            "int" | "int32" => Kind::I32,
            "uint" | "uint32" => Kind::U32,
            "float" | "float32" => Kind::F32,
            "double" | "float64" => Kind::F64,
            _ => return None,
        })
    }

    pub(super) fn is_whole(self) -> bool {
        !matches!(self, Kind::F32 | Kind::F64)
    }
}

/// One value of an element, or a list of them.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
    /// The type of a list's length.
    pub(super) list: Option<Kind>,
}

/// A number of elements of one kind.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) form: Form,
    pub(super) elements: Vec<Element>,
    /// Names of texture files, with their lines.
    pub(super) textures: Vec<(usize, String)>,
    /// The offset of the body, and the number of its first line.
    pub(super) length: usize,
    pub(super) line: usize,
}

impl Header {
    pub(super) fn read(path: &Path, bytes: &[u8]) -> Result<Header, SceneError> {
        let mut form = None;
        let (mut elements, mut textures) = (Vec::new(), Vec::new());
        let mut length = 0;
        for (line, text) in (1..).zip(bytes.split_inclusive(|&byte| byte == b'\n')) {
            let at = At { path, line };
            length += text.len();
            let text = String::from_utf8_lossy(text);
            let words: Vec<&str> = text.split_whitespace().take(8).collect();
            match words.as_slice() {
                ["ply"] if line == 1 => {}
                _ if line == 1 => {
                    return Err(at.error("is no PLY file: it does not begin with `ply`", "export it again"));
                }
                ["comment", "TextureFile", ..] => {
                    let name = text.trim_start()["comment".len()..].trim_start()["TextureFile".len()..].trim();
                    textures.push((line, name.to_owned()));
                }
                [] | ["comment" | "obj_info", ..] => {}
                ["format", name, "1.0"] => form = Some(self::form(at, name)?),
                ["element", name, count] => {
                    let count = count.parse().map_err(|_| {
                        at.error(format!("{} is not the number of an element", quote(count)), "write a whole number")
                    })?;
                    elements.push(Element { name: (*name).to_owned(), count, properties: Vec::new() });
                }
                ["property", rest @ ..] => {
                    let property = property(at, rest)?;
                    let element: Option<&mut Element> = elements.last_mut();
                    let missing = || at.error("`property` before any `element`", "name the element first");
                    element.ok_or_else(missing)?.properties.push(property);
                }
                ["end_header"] => {
                    let form = form.ok_or_else(|| at.error("a header without `format`", "add `format ascii 1.0`"))?;
                    return Ok(Header { form, elements, textures, length, line: line + 1 });
                }
                _ => {
                    return Err(at.error(
                        format!("unknown statement {} in the header", quote(text.trim())),
                        "a header has format, comment, obj_info, element, property and end_header",
                    ));
                }
            }
        }
        Err(SceneError::File {
            path: path.to_owned(),
            problem: "ends before its header does".to_owned(),
            remedy: "export it again, or add the line `end_header`".to_owned(),
        })
    }
}

fn form(at: At, name: &str) -> Result<Form, SceneError> {
    match name {
        "ascii" => Ok(Form::Text),
        "binary_little_endian" => Ok(Form::Little),
        "binary_big_endian" => Ok(Form::Big),
        _ => Err(at.error(
            format!("unknown format {}", quote(name)),
            "write ascii, binary_little_endian or binary_big_endian",
        )),
    }
}

fn property(at: At, words: &[&str]) -> Result<Property, SceneError> {
    let kind = |name: &str| {
        Kind::of(name).ok_or_else(|| {
            let types = "write char, uchar, short, ushort, int, uint, float or double";
            at.error(format!("unknown type {}", quote(name)), types)
        })
    };
    match *words {
        ["list", length, of, name] => {
            let length_kind = kind(length)?;
            if !length_kind.is_whole() {
                return Err(at.error(format!("a list whose length is a {length}"), "write uchar, or int"));
            }
            Ok(Property { name: name.to_owned(), kind: kind(of)?, list: Some(length_kind) })
        }
        [of, name] => Ok(Property { name: name.to_owned(), kind: kind(of)?, list: None }),
        _ => Err(at.error("a malformed `property`", "write `property TYPE NAME` or `property list TYPE TYPE NAME`")),
    }
}

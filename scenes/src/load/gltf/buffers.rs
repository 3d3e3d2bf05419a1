//! Buffers of a glTF file, and the accessors that convert their bytes to numbers.

use super::container::File;
use crate::error::SceneError;
use crate::input::{self, read_bytes};
use crate::quote::shown;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf_json::accessor::{ComponentType, GenericComponentType, IndexComponentType, Type};
use gltf_json::buffer::View;
use gltf_json::validation::{Checked, USize64};
use gltf_json::{Accessor, Index};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The most bytes of all buffers, and the most elements of an accessor without bytes.
const MOST_BYTES: usize = 256 << 20;
const MOST_ZEROS: usize = 1 << 22;

/// The requested buffers, each read once.
pub(super) struct Buffers<'a> {
    file: &'a File,
    read: BTreeMap<usize, Vec<u8>>,
    files: Vec<PathBuf>,
    total: usize,
}

/// The content of a URI.
pub(super) enum Uri {
    Bytes(Vec<u8>),
    /// A separate file.
    File(PathBuf),
}

impl<'a> Buffers<'a> {
    pub(super) fn new(file: &'a File) -> Buffers<'a> {
        Buffers { file, read: BTreeMap::new(), files: Vec::new(), total: 0 }
    }

    /// The files that buffers are in.
    pub(super) fn files(&self) -> impl Iterator<Item = PathBuf> {
        self.files.iter().cloned()
    }

    /// The bytes of a view.
    pub(super) fn view(&mut self, index: Index<View>) -> Result<&[u8], SceneError> {
        let file = self.file;
        let view = &file.root.buffer_views[index.value()];
        let (from, length) = (size(view.byte_offset), view.byte_length.0 as usize);
        let bytes = self.buffer(view.buffer.value())?;
        let found = from.checked_add(length).and_then(|to| bytes.get(from..to));
        found.ok_or_else(|| {
            let problem = format!("bufferViews[{}] reaches beyond the end of its buffer", index.value());
            file.wrong(&problem, "export it again")
        })
    }

    fn buffer(&mut self, index: usize) -> Result<&[u8], SceneError> {
        if !self.read.contains_key(&index) {
            let bytes = self.bytes(index)?;
            self.total += bytes.len();
            if self.total > MOST_BYTES {
                return Err(self
                    .file
                    .wrong("has buffers of more than 256 MiB, the most that is read", "simplify the mesh"));
            }
            self.read.insert(index, bytes);
        }
        Ok(&self.read[&index])
    }

    fn bytes(&mut self, index: usize) -> Result<Vec<u8>, SceneError> {
        let buffer = &self.file.root.buffers[index];
        let wrong = |problem: &str, remedy: &str| self.file.wrong(&format!("buffers[{index}] {problem}"), remedy);
        let mut bytes = match &buffer.uri {
            None => {
                // Only the first buffer may be in the file itself.
                let blob = self.file.blob.as_ref().filter(|_| index == 0);
                blob.cloned().ok_or_else(|| wrong("is nowhere: it has no `uri`", "export it again"))?
            }
            Some(uri) => match resolved(&self.file.path, uri)
                .map_err(|problem| wrong(problem, "put it into a file beside this one"))?
            {
                Uri::Bytes(bytes) => bytes,
                Uri::File(path) if path.exists() => {
                    let bytes = read_bytes(&path, &input::BUFFER)?;
                    self.files.push(path);
                    bytes
                }
                Uri::File(path) => {
                    let problem = format!("is the file {}, which is not there", shown(&path));
                    return Err(wrong(&problem, "put it beside the mesh"));
                }
            },
        };
        let length = buffer.byte_length.0 as usize;
        if bytes.len() < length {
            let problem = format!("has {} bytes, and is to have {length}", bytes.len());
            return Err(wrong(&problem, "export it again"));
        }
        bytes.truncate(length);
        Ok(bytes)
    }

    /// The whole numbers of an accessor with one number an element.
    pub(super) fn indices(&mut self, index: Index<Accessor>) -> Result<Vec<u32>, SceneError> {
        let accessor = &self.file.root.accessors[index.value()];
        if component(accessor) == ComponentType::F32 {
            return Err(self.wrong(index, "has indices that are no whole numbers", "export it again"));
        }
        // 32 bits are exact in f64.
        Ok(self.vectors::<1>(index, Some(false))?.into_iter().map(|[i]| i as u32).collect())
    }

    /// How many numbers an element of the accessor has.
    pub(super) fn width(&self, index: Index<Accessor>) -> usize {
        width(&self.file.root.accessors[index.value()])
    }

    /// The elements of an accessor, as numbers, normalised if the accessor, or `normalized`, says so.
    pub(super) fn vectors<const N: usize>(
        &mut self,
        index: Index<Accessor>,
        normalized: Option<bool>,
    ) -> Result<Vec<[f64; N]>, SceneError> {
        let file = self.file;
        let accessor = &file.root.accessors[index.value()];
        let found = width(accessor);
        if found != N {
            let problem = format!("has {found} numbers for each element, and {N} are needed");
            return Err(self.wrong(index, &problem, "export it again"));
        }
        let kind = component(accessor);
        let number = scaled(kind, normalized.unwrap_or(accessor.normalized));
        let count = accessor.count.0 as usize;
        let mut all: Vec<[f64; N]> = match accessor.buffer_view {
            None if count > MOST_ZEROS => {
                return Err(self.wrong(index, "has millions of elements and no bytes", "export it again"));
            }
            None => vec![[0.0; N]; count],
            Some(view) => {
                let stride =
                    file.root.buffer_views[view.value()].byte_stride.map_or(N * kind.size(), |stride| stride.0);
                let bytes = self.view(view)?;
                let elements = elements(bytes, size(accessor.byte_offset), count, stride, N * kind.size());
                let read = elements.map(|elements| elements.map(|bytes| vector(bytes, kind, number)).collect());
                read.ok_or_else(|| self.wrong(index, "reaches beyond the end of its buffer view", "export it again"))?
            }
        };
        if accessor.sparse.is_some() {
            self.replace(index, &mut all, number)?;
        }
        if let Some(i) = all.iter().position(|vector| !vector.iter().all(|part| part.abs() < 1e30)) {
            let problem = format!("has {:?} for element {i}", all[i]);
            return Err(self.wrong(index, &problem, "give finite numbers below 1e30"));
        }
        Ok(all)
    }

    /// Writes a sparse accessor's separate elements to their places.
    fn replace<const N: usize>(
        &mut self,
        index: Index<Accessor>,
        all: &mut [[f64; N]],
        number: impl Fn(f64) -> f64 + Copy,
    ) -> Result<(), SceneError> {
        let accessor = &self.file.root.accessors[index.value()];
        let Some(sparse) = &accessor.sparse else {
            return Ok(());
        };
        let (kind, count) = (component(accessor), sparse.count.0 as usize);
        let place_kind = match sparse.indices.component_type {
            Checked::Valid(IndexComponentType(kind)) => kind,
            Checked::Invalid => ComponentType::U32,
        };
        let short = "has sparse elements beyond the end of their buffer view";
        let bytes = self.view(sparse.indices.buffer_view)?;
        let (from, size) = (sparse.indices.byte_offset.0 as usize, place_kind.size());
        let places = elements(bytes, from, count, size, size);
        let places = places.map(|places| places.map(|bytes| vector::<1>(bytes, place_kind, |n| n)[0]).collect());
        let places: Vec<f64> = places.ok_or_else(|| self.wrong(index, short, "export it again"))?;
        let bytes = self.view(sparse.values.buffer_view)?;
        let (from, size) = (sparse.values.byte_offset.0 as usize, N * kind.size());
        let values = elements(bytes, from, count, size, size);
        let values = values.map(|values| values.map(|bytes| vector(bytes, kind, number)).collect());
        let values: Vec<[f64; N]> = values.ok_or_else(|| self.wrong(index, short, "export it again"))?;
        for (place, value) in places.into_iter().zip(values) {
            let Some(element) = all.get_mut(place as usize) else {
                let problem = format!("replaces element {place}, and there are {}", all.len());
                return Err(self.wrong(index, &problem, "export it again"));
            };
            *element = value;
        }
        Ok(())
    }

    pub(super) fn wrong(&self, index: Index<Accessor>, problem: &str, remedy: &str) -> SceneError {
        self.file.wrong(&format!("accessors[{}] {problem}", index.value()), remedy)
    }
}

/// The bytes of each of `count` elements, if all of them are there.
fn elements(
    bytes: &[u8],
    from: usize,
    count: usize,
    stride: usize,
    size: usize,
) -> Option<impl Iterator<Item = &[u8]>> {
    // No stride is shorter than an element, so at most the available bytes are read.
    let length = count.checked_sub(1).map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size));
    let bytes = bytes.get(from..from.checked_add(length?)?)?;
    (stride >= size).then(|| (0..count).map(move |i| &bytes[i * stride..][..size]))
}

fn vector<const N: usize>(bytes: &[u8], kind: ComponentType, number: impl Fn(f64) -> f64) -> [f64; N] {
    std::array::from_fn(|i| number(component_at(&bytes[i * kind.size()..], kind)))
}

fn component_at(bytes: &[u8], kind: ComponentType) -> f64 {
    let two = || [bytes[0], bytes[1]];
    let four = || [bytes[0], bytes[1], bytes[2], bytes[3]];
    match kind {
        ComponentType::I8 => f64::from(bytes[0] as i8),
        ComponentType::U8 => f64::from(bytes[0]),
        ComponentType::I16 => f64::from(i16::from_le_bytes(two())),
        ComponentType::U16 => f64::from(u16::from_le_bytes(two())),
        ComponentType::U32 => f64::from(u32::from_le_bytes(four())),
        ComponentType::F32 => f64::from(f32::from_le_bytes(four())),
    }
}

/// Converts a stored number to a normalised one.
fn scaled(kind: ComponentType, normalized: bool) -> impl Fn(f64) -> f64 + Copy {
    let most = match kind {
        _ if !normalized => None,
        ComponentType::I8 => Some(127.0),
        ComponentType::U8 => Some(255.0),
        ComponentType::I16 => Some(32767.0),
        ComponentType::U16 => Some(65535.0),
        ComponentType::U32 | ComponentType::F32 => None,
    };
    move |number| most.map_or(number, |most| (number / most).max(-1.0))
}

fn component(accessor: &Accessor) -> ComponentType {
    match accessor.component_type {
        Checked::Valid(GenericComponentType(kind)) => kind,
        // The file was refused before this.
        Checked::Invalid => ComponentType::F32,
    }
}

fn width(accessor: &Accessor) -> usize {
    match accessor.type_ {
        Checked::Valid(Type::Scalar) => 1,
        Checked::Valid(Type::Vec2) => 2,
        Checked::Valid(Type::Vec3) => 3,
        Checked::Valid(Type::Vec4 | Type::Mat2) => 4,
        Checked::Valid(Type::Mat3) => 9,
        Checked::Valid(Type::Mat4) | Checked::Invalid => 16,
    }
}

fn size(offset: Option<USize64>) -> usize {
    offset.map_or(0, |offset| offset.0 as usize)
}

/// The meaning of a URI in the file at `path`.
pub(super) fn resolved(path: &Path, uri: &str) -> Result<Uri, &'static str> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (_, code) = data.split_once(";base64,").ok_or("has a `data:` address that is not in base64")?;
        return STANDARD.decode(code).map(Uri::Bytes).map_err(|_| "has a `data:` address of damaged base64");
    }
    if uri.contains("://") {
        return Err("is at an address on the net, and is not fetched");
    }
    Ok(Uri::File(path.parent().unwrap_or(Path::new("")).join(percent_decoded(uri))))
}

/// A name whose bytes may be written as `%` and two hexadecimal digits.
fn percent_decoded(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let digits = after.get(..2).filter(|_| first == b'%').and_then(|digits| std::str::from_utf8(digits).ok());
        match digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_decoded() {
        let cases = [("a%20b.bin", "a b.bin"), ("%C3%A9.png", "é.png"), ("100%.bin", "100%.bin"), ("%zz%4", "%zz%4")];
        for (uri, name) in cases {
            assert_eq!(percent_decoded(uri), name);
        }
    }
}

//! Files that a mesh names, matched against existing files.
//!
//! A name is bytes. It may be quoted, or have another system's slashes. If no file matches, the name may have lost its
//! folder, or its case, on the way between machines. A file taken for it then is reported.

use super::lines::{is_blank, trimmed};
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// The most words of a name with blanks: each run of words may be one.
const MOST_WORDS: usize = 32;

/// Looks up files, and caches the contents of folders.
#[derive(Default)]
pub(super) struct Finder {
    listings: BTreeMap<PathBuf, Vec<OsString>>,
}

/// A file with exactly that name: with either slash between folders, and without quotes around it.
pub(super) fn find(folder: &Path, name: &[u8]) -> Option<PathBuf> {
    let plain = unquoted(name);
    let slashed = with_slashes(plain);
    let mut names = [name, plain, &slashed].into_iter().filter(|name| !name.is_empty());
    names.find_map(|name| file(folder.join(os(name))))
}

/// The path that a file with that name would have.
pub(super) fn expected(folder: &Path, name: &[u8]) -> PathBuf {
    folder.join(os(&with_slashes(unquoted(name))))
}

/// The files of a list: at each word, the longest name that is a file's; if there is none, the name itself.
pub(super) fn listed(folder: &Path, list: &[u8]) -> Vec<Result<PathBuf, Vec<u8>>> {
    let words: Vec<(usize, usize)> = words(list).collect();
    let mut files = Vec::new();
    let mut first = 0;
    while first < words.len() {
        let most = words.len().min(first + MOST_WORDS);
        let run = |last: usize| &list[words[first].0..words[last].1];
        let found = (first..most).rev().find_map(|last| Some((last, find(folder, run(last))?)));
        if found.is_none() && run(first).starts_with(b"#") {
            break;
        }
        let last = found.as_ref().map_or_else(|| last_word(list, &words, first), |&(last, _)| last);
        files.push(found.map(|(_, path)| path).ok_or_else(|| run(last).to_vec()));
        first = last + 1;
    }
    files
}

/// The last word of the name that begins with a word of a list: one in .mtl, or else the one before a comment.
fn last_word(list: &[u8], words: &[(usize, usize)], first: usize) -> usize {
    let word = |i: usize| unquoted(&list[words[i].0..words[i].1]).to_ascii_lowercase();
    let end = (first + 1..words.len()).find(|&i| word(i).starts_with(b"#")).unwrap_or(words.len());
    let ends_name = |i: &usize| word(*i).ends_with(b".mtl") || word(*i).ends_with(b".mtl\"");
    (first..end).find(ends_name).unwrap_or(end - 1)
}

/// Where words begin and end.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = (usize, usize)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let begin = at + text[at..].iter().position(|&byte| !is_blank(byte))?;
        at = begin + text[begin..].iter().position(|&byte| is_blank(byte)).unwrap_or(text.len() - begin);
        Some((begin, at))
    })
}

impl Finder {
    /// A substitute for a name without a file. It has the same name in another of these folders, or differs only in
    /// case, or lacks the name's folders.
    pub(super) fn find_loosely(&mut self, folders: &[&Path], name: &[u8]) -> Option<PathBuf> {
        let name = with_slashes(unquoted(name));
        let is_absolute = name.starts_with(b"/") || name.get(1) == Some(&b':');
        let own = name.rsplit(|&byte| byte == b'/').next().unwrap_or_default();
        let within = Some(&name[..]).filter(|_| !is_absolute);
        for name in within.into_iter().chain([own]).filter(|name| !name.is_empty()) {
            if let Some(path) = folders.iter().find_map(|folder| find(folder, name)) {
                return Some(path);
            }
            if let Some(path) = folders.iter().find_map(|folder| self.find_in_any_case(folder, name)) {
                return Some(path);
            }
        }
        None
    }

    /// The one file with this name, in any case.
    fn find_in_any_case(&mut self, folder: &Path, name: &[u8]) -> Option<PathBuf> {
        let mut at = folder.to_owned();
        for part in name.split(|&byte| byte == b'/').filter(|part| !part.is_empty() && *part != b".") {
            let next = at.join(os(part));
            at = if next.exists() { next } else { at.join(self.entry(&at, &os(part))?) };
        }
        file(at)
    }

    /// The one entry of a folder with this name, in any case.
    fn entry(&mut self, folder: &Path, name: &OsStr) -> Option<OsString> {
        let listing = self.listings.entry(folder.to_owned()).or_insert_with(|| {
            let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
            let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
            entries.map(|entry| entry.file_name()).collect()
        });
        let lower = |name: &OsStr| name.to_string_lossy().to_lowercase();
        let wanted = lower(name);
        let mut same = listing.iter().filter(|entry| lower(entry) == wanted);
        same.next().filter(|_| same.next().is_none()).cloned()
    }
}

/// A path, unless it is only a folder.
fn file(path: PathBuf) -> Option<PathBuf> {
    (path.exists() && !path.is_dir()).then_some(path)
}

fn unquoted(name: &[u8]) -> &[u8] {
    match name {
        [b'"', within @ .., b'"'] | [b'\'', within @ .., b'\''] => trimmed(within),
        _ => name,
    }
}

fn with_slashes(name: &[u8]) -> Vec<u8> {
    name.iter().map(|&byte| if byte == b'\\' { b'/' } else { byte }).collect()
}

/// A file name: raw bytes where the system has them, otherwise UTF-8.
#[cfg(unix)]
fn os(name: &[u8]) -> OsString {
    std::os::unix::ffi::OsStringExt::from_vec(name.to_vec())
}

/// A file name: raw bytes where the system has them, otherwise UTF-8.
#[cfg(not(unix))]
fn os(name: &[u8]) -> OsString {
    String::from_utf8_lossy(name).into_owned().into()
}

//! Compares the shapes of bundles of one type: a `Vec` may be longer in one than in the other.

use crate::bundle::join;
use std::collections::BTreeSet;
use std::fmt;

/// A list of the wrong length.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Uneven {
    /// Its path in the bundle.
    pub list: String,
    /// Its number of elements.
    pub has: usize,
    /// The required number of elements.
    pub needs: usize,
}

/// The list's name after a space; nothing for a list without a name.
impl fmt::Display for Uneven {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.list.is_empty() { Ok(()) } else { write!(f, " `{}`", self.list) }
    }
}

/// Finds a list in the leaves of a bundle that is longer or shorter than in another bundle of the same type.
#[doc(hidden)]
pub fn uneven<T, U>(has: &[(String, T)], needs: &[(String, U)]) -> Option<Uneven> {
    let has = || has.iter().map(|(path, _)| path.as_str());
    let needs = || needs.iter().map(|(path, _)| path.as_str());
    if has().eq(needs()) {
        return None;
    }
    let (known, needed): (BTreeSet<&str>, BTreeSet<&str>) = (has().collect(), needs().collect());
    let extra = has().find(|path| !needed.contains(path));
    let missing = needs().find(|path| !known.contains(path));
    let (path, others) = match (extra, missing) {
        (Some(extra), _) => (extra, &needed),
        (None, Some(missing)) => (missing, &known),
        (None, None) => return None,
    };
    // The element that is missing in the other; only list elements have numbers as names.
    let ends = path.match_indices('.').map(|(at, _)| at).chain([path.len()]);
    let elements = ends.map(|end| path[..end].rsplit_once('.').unwrap_or(("", &path[..end])));
    let mut lists = elements.filter(|(_, name)| name.starts_with(|c: char| c.is_ascii_digit()));
    let list = lists.find(|(list, name)| !others.iter().any(|other| is_in(other, &join(list, name))));
    let list = list.map_or("", |(list, _)| list);
    let length = |paths: &BTreeSet<&str>| {
        let inside = paths.iter().filter(|path| list.is_empty() || (is_in(path, list) && path.len() > list.len()));
        let elements = inside.map(|path| path[list.len()..].trim_start_matches('.').split('.').next());
        elements.collect::<BTreeSet<_>>().len()
    };
    Some(Uneven { list: list.to_owned(), has: length(&known), needs: length(&needed) })
}

/// Whether `path` is `part` of a bundle, or something within it.
fn is_in(path: &str, part: &str) -> bool {
    path.strip_prefix(part).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

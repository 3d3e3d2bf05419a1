//! Which signals of two files are the same.

use super::file::{Signal, Waves};
use std::collections::{BTreeMap, HashSet};

/// The greatest depth of a scope that may be the top of what both files have.
const DEEPEST: usize = 3;

/// The signals of two files by their names below a common top.
pub struct Matched {
    pub pairs: Vec<Pair>,
    /// The names that only one of the files has. A signal of another width counts as another one.
    pub only: [Vec<String>; 2],
}

/// A signal that both files have.
pub struct Pair {
    /// Its name below the common top.
    pub name: String,
    pub variables: [u32; 2],
    /// The number of bits, or [`TEXT`](super::file::TEXT).
    pub width: u32,
}

/// A name below a top, and the width.
type Key<'a> = (&'a [String], u32);

/// Matches signals by name. The files may have other scopes around what both have, such as that of a testbench: the
/// scopes are left out below which most names are the same.
pub fn matched(files: [&Waves; 2]) -> Matched {
    let tops = files.map(tops);
    let mut best = (0, [&[][..]; 2]);
    // One of both is an outermost scope, or the file itself.
    for (first, second) in pairs_of(&tops) {
        let known = below(files[0], first);
        let count = signals_below(files[1], second).filter(|(key, _)| known.contains_key(key)).count();
        // Of several such scopes, the inner ones have the shorter names.
        if count > 0 && count >= best.0 {
            best = (count, [first, second]);
        }
    }
    let [first, second] = [0, 1].map(|side| below(files[side], best.1[side]));
    let mut all = Matched { pairs: Vec::new(), only: [Vec::new(), Vec::new()] };
    for (key, variable) in &first {
        match second.get(key) {
            Some(other) => all.pairs.push(Pair { name: key.0.join("."), variables: [*variable, *other], width: key.1 }),
            None => all.only[0].push(key.0.join(".")),
        }
    }
    all.only[1].extend(second.keys().filter(|key| !first.contains_key(*key)).map(|key| key.0.join(".")));
    all
}

/// The scopes that may be the common top, the outermost first; the first one is the file itself.
fn tops(file: &Waves) -> Vec<&[String]> {
    let mut tops: Vec<&[String]> = vec![&[]];
    let mut known = HashSet::new();
    for signal in &file.signals {
        for depth in 1..=DEEPEST.min(signal.path.len() - 1) {
            let scope = &signal.path[..depth];
            if known.insert(scope) {
                tops.push(scope);
            }
        }
    }
    tops.sort_by_key(|scope| scope.len());
    tops
}

fn pairs_of<'a>(tops: &[Vec<&'a [String]>; 2]) -> Vec<(&'a [String], &'a [String])> {
    let outer = |side: usize| tops[side].iter().copied().filter(|scope| scope.len() < 2);
    let mut pairs: Vec<_> = outer(0).flat_map(|one| tops[1].iter().map(move |other| (one, *other))).collect();
    pairs.extend(outer(1).flat_map(|one| tops[0].iter().map(move |other| (*other, one))));
    pairs.sort_by_key(|(one, other)| one.len() + other.len());
    pairs
}

fn signals_below<'a>(file: &'a Waves, top: &'a [String]) -> impl Iterator<Item = (Key<'a>, u32)> {
    let key = |signal: &'a Signal| Some(((signal.path.strip_prefix(top)?, signal.width), signal.variable));
    file.signals.iter().filter_map(key)
}

fn below<'a>(file: &'a Waves, top: &'a [String]) -> BTreeMap<Key<'a>, u32> {
    signals_below(file, top).collect()
}

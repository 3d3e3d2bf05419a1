//! Which signals of two files are the same.

use super::file::Waves;
use super::lanes;
use std::collections::{BTreeMap, HashSet};
use std::rc::Rc;

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
    /// Its name below the common top, in the first file.
    pub name: String,
    pub variables: [u32; 2],
    /// The lowest bit of it in each variable.
    pub lows: [u32; 2],
    /// The number of bits, or [`TEXT`](super::file::TEXT).
    pub width: u32,
}

/// A path below a top, and the width.
pub type Key<'a> = (&'a [String], u32);

/// A signal of a file.
pub struct Signal<'a> {
    /// Its path in one form, whatever the form of arrays is in the file.
    path: Vec<String>,
    /// Its path in the file.
    own: &'a [String],
    width: u32,
    pub variable: u32,
}

impl Signal<'_> {
    /// Its name below a top of so many scopes.
    pub fn name(&self, top: usize) -> String {
        name(&self.own[top..])
    }
}

/// Signals by their keys.
pub type Signals<'a> = BTreeMap<Key<'a>, &'a Signal<'a>>;

/// Matches signals by name. The files may have other scopes around what both have, such as that of a testbench: the
/// scopes are left out below which most names are the same.
pub fn matched(files: [&Waves; 2]) -> Matched {
    let signals = files.map(signals);
    let tops = [0, 1].map(|side| tops(&signals[side]));
    let sorted = [0, 1].map(|side| Sorted::new(&signals[side]));
    let best = common_tops(&sorted, &tops);
    let depths = best.map(<[String]>::len);
    let mut rest: [Signals; 2] = [0, 1].map(|side| sorted[side].below(best[side]).collect());
    let mut pairs = Vec::new();
    for (key, signal) in rest[0].clone() {
        if let Some(other) = rest[1].remove(&key) {
            rest[0].remove(&key);
            let variables = [signal.variable, other.variable];
            pairs.push(Pair { name: signal.name(depths[0]), variables, lows: [0, 0], width: key.1 });
        }
    }
    for side in 0..2 {
        pairs.extend(lanes::pairs(&mut rest, side, depths[0]));
    }
    pairs.sort_by(|one, other| one.name.cmp(&other.name));
    let only = [0, 1].map(|side| rest[side].values().map(|signal| signal.name(depths[side])).collect());
    Matched { pairs, only }
}

/// The scopes below which most names are the same. One of both is an outermost scope, or the file itself.
fn common_tops<'a>(sorted: &[Sorted<'a>; 2], tops: &[Vec<&'a [String]>; 2]) -> [&'a [String]; 2] {
    let outer = |side: usize| tops[side].iter().copied().filter(|scope| scope.len() < 2);
    let mut choices = Vec::new();
    for side in 0..2 {
        for scope in outer(side) {
            let known: Rc<HashSet<Key>> = Rc::new(sorted[side].below(scope).map(|(key, _)| key).collect());
            choices.extend(tops[1 - side].iter().map(|other| (side, scope, *other, known.clone())));
        }
    }
    choices.sort_by_key(|(_, scope, other, _)| scope.len() + other.len());
    let mut best = (0, [&[][..]; 2]);
    for (side, scope, other, known) in choices {
        let count = sorted[1 - side].below(other).filter(|(key, _)| known.contains(key)).count();
        // Of several such scopes, the inner ones have the shorter names.
        if count > 0 && count >= best.0 {
            best = (count, if side == 0 { [scope, other] } else { [other, scope] });
        }
    }
    best.1
}

fn signals(file: &Waves) -> Vec<Signal<'_>> {
    let signal = |it: &'_ super::file::Signal| canonical(&it.path);
    let all = file.signals.iter();
    all.map(|it| Signal { path: signal(it), own: &it.path, width: it.width, variable: it.variable }).collect()
}

/// A path in which an element of an array is one scope. In Verilog a loop is around it, whose scope has the index: `u_cell[3].lane.sum`
/// and `row[3].u_cell.sum` are `u_cell[3].sum`, and `row[3].sum` is `sum[3]`.
fn canonical(path: &[String]) -> Vec<String> {
    let mut parts = Vec::new();
    let (mut label, mut index) = (None, String::new());
    for (at, part) in path.iter().enumerate() {
        let is_scope = at + 1 < path.len();
        match part.find('[').filter(|_| is_scope && part.ends_with(']')) {
            Some(start) => {
                label.get_or_insert(&part[..start]);
                index += &part[start..];
            }
            None => {
                let is_lane = is_scope && part.trim_start_matches("u_") == "lane";
                let name = label.take().filter(|_| is_lane).unwrap_or(part.as_str());
                // A lane of a lane has the outer index first.
                let (base, own) = name.find('[').map_or((name, ""), |start| name.split_at(start));
                parts.push(format!("{base}{}{own}", std::mem::take(&mut index)));
            }
        }
    }
    parts
}

/// A path as `why` takes it: without the scope that Verilog has in each element of an array.
pub fn name(path: &[String]) -> String {
    let is_lane = |at: usize| at > 0 && at + 1 < path.len() && path[at] == "lane" && path[at - 1].ends_with(']');
    let parts: Vec<&str> = (0..path.len()).filter(|at| !is_lane(*at)).map(|at| path[at].as_str()).collect();
    parts.join(".")
}

/// The scopes that may be the common top, the outermost first; the first one is the file itself.
fn tops<'a>(signals: &'a [Signal]) -> Vec<&'a [String]> {
    let mut tops: Vec<&[String]> = vec![&[]];
    let mut known = HashSet::new();
    for signal in signals {
        for depth in 1..=DEEPEST.min(signal.path.len() - 1) {
            let scope = &signal.path[..depth];
            // Below an element of an array, the paths have other lengths.
            if signal.own.starts_with(scope) && known.insert(scope) {
                tops.push(scope);
            }
        }
    }
    tops.sort_by_key(|scope| scope.len());
    tops
}

/// The signals of a file by path: those below a scope are adjacent.
struct Sorted<'a>(Vec<&'a Signal<'a>>);

impl<'a> Sorted<'a> {
    fn new(signals: &'a [Signal<'a>]) -> Sorted<'a> {
        let mut sorted: Vec<&Signal> = signals.iter().collect();
        sorted.sort_by(|one, other| one.path.cmp(&other.path));
        Sorted(sorted)
    }

    /// The signals below a scope.
    fn below(&self, top: &'a [String]) -> impl Iterator<Item = (Key<'a>, &'a Signal<'a>)> {
        let start = self.0.partition_point(|signal| signal.path[..] < *top);
        let below = self.0[start..].iter().map_while(move |signal| Some((signal.path.strip_prefix(top)?, *signal)));
        below.map(|(path, signal)| ((path, signal.width), signal))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_element_of_an_array_is_one_scope_in_any_form() {
        let path = |text: &str| text.split('.').map(str::to_owned).collect::<Vec<_>>();
        for (own, expected, shown) in [
            ("top.u_cell[3].lane.sum", "top.u_cell[3].sum", "top.u_cell[3].sum"),
            ("top.row[3].u_cell.sum", "top.u_cell[3].sum", "top.row[3].u_cell.sum"),
            ("top.u_cell[1][2].lane.sum", "top.u_cell[1][2].sum", "top.u_cell[1][2].sum"),
            ("top.u_cell[1].col[2].lane.sum", "top.u_cell[1][2].sum", "top.u_cell[1].col[2].sum"),
            ("top.row[3].sum", "top.sum[3]", "top.row[3].sum"),
            ("top.sum[3]", "top.sum[3]", "top.sum[3]"),
            ("top.u_cell[3].lane.row[1].sum", "top.u_cell[3].sum[1]", "top.u_cell[3].row[1].sum"),
            ("top.lane.sum", "top.lane.sum", "top.lane.sum"),
        ] {
            assert_eq!((canonical(&path(own)).join("."), name(&path(own)).as_str()), (expected.to_owned(), shown));
        }
    }
}

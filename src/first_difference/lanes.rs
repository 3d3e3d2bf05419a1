//! Lanes that one file has as variables of their own, such as `sums[3]`, and the other one as parts of a vector of all lanes. Of a memory, the
//! lanes of a word are `flags[3][7]`, and the vector is `flags[7]`.

use super::names::{Key, Pair, Signal, Signals};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};

/// Pairs the lanes that one side has as variables with the vectors of the other side, and takes both out of the rest. `top` is the number of scopes
/// above the names in the first file.
pub fn pairs<'a>(rest: &mut [Signals<'a>; 2], side: usize, top: usize) -> Vec<Pair> {
    let (mut pairs, vectors) = (Vec::new(), vectors(&rest[1 - side]));
    for ((scope, base, width), lanes) in groups(&rest[side]) {
        let vector = vectors.get(&(scope, base.clone(), width.saturating_mul(lanes.len() as u32)));
        let Some(vector) = vector.and_then(|vector| rest[1 - side].remove(vector)) else { continue };
        for (number, (key, lane)) in (0..).zip(lanes.into_values()) {
            rest[side].remove(&key);
            let low = number * width;
            let name = if side == 0 { lane.name(top) } else { of_lane(&vector.name(top), number) };
            let (mut variables, mut lows) = ([lane.variable, vector.variable], [0, low]);
            if side == 1 {
                variables.reverse();
                lows.reverse();
            }
            pairs.push(Pair { name, variables, lows, width });
        }
    }
    pairs
}

/// The scope, the name without the index of the lane, and the width.
type Base<'a> = (&'a [String], Cow<'a, str>, u32);

/// The lanes of each signal, by their indices.
type Lanes<'a> = BTreeMap<Vec<u32>, (Key<'a>, &'a Signal<'a>)>;

/// Lanes of signals, and lanes of words of memories.
fn groups<'a>(rest: &Signals<'a>) -> BTreeMap<Base<'a>, Lanes<'a>> {
    let mut groups: BTreeMap<Base, Lanes> = BTreeMap::new();
    for (key @ (path, width), signal) in rest {
        let Some((last, scope)) = path.split_last() else { continue };
        let Some((base, mut index)) = indexed(last) else { continue };
        let mut add = |base, index| groups.entry((scope, base, *width)).or_default().insert(index, (*key, *signal));
        add(Cow::Borrowed(base), index.clone());
        if let (Some(address), false) = (index.pop(), index.is_empty()) {
            add(Cow::Owned(format!("{base}[{address}]")), index);
        }
    }
    groups
}

/// The keys of all signals, by what they are the vectors of.
fn vectors<'a>(rest: &Signals<'a>) -> HashMap<Base<'a>, Key<'a>> {
    let base = |key: &Key<'a>| {
        let (last, scope) = key.0.split_last()?;
        Some(((scope, Cow::Borrowed(last.as_str()), key.1), *key))
    };
    rest.keys().filter_map(base).collect()
}

/// The name of a lane of a vector; that of a word has its address behind it.
fn of_lane(vector: &str, number: u32) -> String {
    let last = vector.rfind('.').map_or(0, |dot| dot + 1);
    let (name, address) = vector.split_at(vector[last..].find('[').map_or(vector.len(), |start| last + start));
    format!("{name}[{number}]{address}")
}

/// `words[1][2]` as a name and indices.
fn indexed(name: &str) -> Option<(&str, Vec<u32>)> {
    let (base, index) = name.strip_suffix(']')?.split_once('[')?;
    Some((base, index.split("][").map(str::parse).collect::<Result<_, _>>().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lane_of_a_word_has_its_address_behind_it() {
        assert_eq!(
            (of_lane("u_a[3].sums", 2), of_lane("flags[7]", 2)),
            ("u_a[3].sums[2]".to_owned(), "flags[2][7]".to_owned())
        );
    }
}

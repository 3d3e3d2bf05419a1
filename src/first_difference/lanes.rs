//! Lanes that one file has as variables of their own, such as `words[3]`, and the other one as parts of a vector of all lanes.

use super::names::{Key, Pair, Signal, Signals};
use std::collections::{BTreeMap, HashMap};

/// Pairs the lanes that one side has as variables with the vectors of the other side, and takes both out of the rest. `top` is the number of scopes
/// above the names in the first file.
pub fn pairs<'a>(rest: &mut [Signals<'a>; 2], side: usize, top: usize) -> Vec<Pair> {
    let (mut pairs, vectors) = (Vec::new(), vectors(&rest[1 - side]));
    for ((scope, base, width), lanes) in groups(&rest[side]) {
        let vector = vectors.get(&(scope, base, width * lanes.len() as u32));
        let Some(vector) = vector.and_then(|vector| rest[1 - side].remove(vector)) else { continue };
        for (number, (key, lane)) in (0..).zip(lanes.into_values()) {
            rest[side].remove(&key);
            let (name, low) = (if side == 0 { lane } else { vector }.name(top), number * width);
            let index = if side == 0 { String::new() } else { format!("[{number}]") };
            let (mut variables, mut lows) = ([lane.variable, vector.variable], [0, low]);
            if side == 1 {
                variables.reverse();
                lows.reverse();
            }
            pairs.push(Pair { name: name + &index, variables, lows, width });
        }
    }
    pairs
}

/// The scope, the name without its index, and the width.
type Base<'a> = (&'a [String], &'a str, u32);

/// The lanes of each signal, by their indices.
type Lanes<'a> = BTreeMap<Vec<u32>, (Key<'a>, &'a Signal<'a>)>;

fn groups<'a>(rest: &Signals<'a>) -> BTreeMap<Base<'a>, Lanes<'a>> {
    let mut groups: BTreeMap<Base, Lanes> = BTreeMap::new();
    for (key @ (path, width), signal) in rest {
        if let Some((last, scope)) = path.split_last()
            && let Some((base, index)) = indexed(last)
        {
            groups.entry((scope, base, *width)).or_default().insert(index, (*key, *signal));
        }
    }
    groups
}

/// The keys of all signals, by what they are the vectors of.
fn vectors<'a>(rest: &Signals<'a>) -> HashMap<Base<'a>, Key<'a>> {
    let base = |key: &Key<'a>| key.0.split_last().map(|(last, scope)| ((scope, last.as_str(), key.1), *key));
    rest.keys().filter_map(base).collect()
}

/// `words[1][2]` as a name and indices.
fn indexed(name: &str) -> Option<(&str, Vec<u32>)> {
    let (base, index) = name.strip_suffix(']')?.split_once('[')?;
    Some((base, index.split("][").map(str::parse).collect::<Result<_, _>>().ok()?))
}

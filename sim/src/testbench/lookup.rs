//! From a hierarchical name, such as `u_cell[3].sum`, to what it names.

use crate::engine::program::Hierarchy;
use crate::engine::program::hierarchy::{Place, Signal};
use crate::testbench::error::UnknownName;

/// A signal in one lane of its value.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Found<'a> {
    pub signal: &'a Signal,
    pub lane: u32,
}

/// Finds a signal of a run. `NAME[i]` is lane `i` of a signal that has lanes in its own module. The scope `lane`, which stands
/// between an array's element and its signals in Verilog, may be left out.
pub(crate) fn signal<'a>(hierarchy: &'a Hierarchy, path: &str, run: u32) -> Result<Found<'a>, UnknownName> {
    let (place, name) = enter(hierarchy, path, run, "signal")?;
    let signals = &hierarchy.scope(place.scope).signals;
    let plain = signals.iter().find(|signal| signal.group.is_none() && signal.name == name);
    if let Some(signal) = plain {
        return Ok(Found { signal, lane: place.lane });
    }
    let lane = split_index(&name).and_then(|(name, index)| {
        let signal = signals.iter().find(|signal| signal.name == name)?;
        let group = signal.group.filter(|&group| index < group)?;
        Some(Found { signal, lane: place.lane * group + index })
    });
    lane.ok_or_else(|| {
        let mut names: Vec<String> = signals.iter().map(display_name).collect();
        names.extend(hierarchy.children(place).into_iter().map(|(name, _)| format!("{name}.")));
        unknown(hierarchy, place, "signal", &name, &names)
    })
}

/// Finds a memory of a run: its index in the program, and the lane.
pub(crate) fn memory(hierarchy: &Hierarchy, path: &str, run: u32) -> Result<(u32, u32), UnknownName> {
    let (place, name) = enter(hierarchy, path, run, "memory")?;
    let memories = &hierarchy.scope(place.scope).memories;
    let found = memories.iter().find(|(candidate, _)| *candidate == name);
    found.map(|(_, index)| (*index, place.lane)).ok_or_else(|| {
        let names: Vec<String> = memories.iter().map(|(name, _)| name.clone()).collect();
        unknown(hierarchy, place, "memory", &name, &names)
    })
}

fn display_name(signal: &Signal) -> String {
    match signal.group {
        Some(_) => format!("{}[0]", signal.name),
        None => signal.name.clone(),
    }
}

/// Follows a path to the instance that its last name is in.
fn enter(hierarchy: &Hierarchy, path: &str, run: u32, what: &'static str) -> Result<(Place, String), UnknownName> {
    let mut place = hierarchy.top(run);
    let mut names: Vec<&str> = path.split('.').collect();
    let last = names.pop().unwrap_or_default();
    let mut in_array = false;
    for name in names {
        if std::mem::take(&mut in_array) && name == "lane" {
            continue;
        }
        let children = hierarchy.children(place);
        match children.iter().find(|(candidate, _)| candidate == name) {
            Some((_, child)) => place = *child,
            None => {
                let mut names: Vec<String> = children.into_iter().map(|(name, _)| name).collect();
                names.dedup();
                return Err(unknown(hierarchy, place, what, name, &names));
            }
        }
        in_array = name.ends_with(']');
    }
    Ok((place, last.to_string()))
}

/// `NAME[3]` as `NAME` and 3.
fn split_index(name: &str) -> Option<(&str, u32)> {
    let (name, index) = name.strip_suffix(']')?.split_once('[')?;
    Some((name, index.parse().ok()?))
}

fn unknown(hierarchy: &Hierarchy, place: Place, what: &'static str, name: &str, names: &[String]) -> UnknownName {
    let full = |name: &str| hierarchy.path_in(place, name);
    let names: Vec<String> = names.iter().map(|name| full(name)).collect();
    UnknownName::new(what, &full(name), &names)
}

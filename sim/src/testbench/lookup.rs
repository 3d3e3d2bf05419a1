//! From a hierarchical name, such as `u_cell[3].sum`, to its object.

use tilewright_circuit::ir::Shape;

use crate::engine::program::Hierarchy;
use crate::engine::program::hierarchy::{self, Place, Signal};
use crate::testbench::error::UnknownName;
use crate::testbench::trace::glob;

/// A signal in one lane of its value.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Found<'a> {
    pub signal: &'a Signal,
    pub lane: u32,
}

/// Finds a signal of a run. `NAME[i]` and `NAME[i][j]` are lanes of a signal that has lanes in its own module. The
/// scope `lane`, which Verilog has between an array's element and its signals, may be omitted.
pub(crate) fn signal<'a>(hierarchy: &'a Hierarchy, path: &str, run: u32) -> Result<Found<'a>, UnknownName> {
    let (place, name) = enter(hierarchy, path, run, "signal")?;
    let signals = &hierarchy.scope(place.scope).signals;
    let found = signals.iter().find_map(|signal| {
        let lane = lane(&signal.name, signal.shape, &name)?;
        Some(Found { signal, lane: place.lane * signal.shape.lanes() + lane })
    });
    found.ok_or_else(|| {
        let mut names: Vec<String> = signals.iter().map(display_name).collect();
        names.extend(hierarchy.children(place).into_iter().map(|(name, _)| format!("{name}.")));
        unknown(hierarchy, place, "signal", &name, &names)
    })
}

/// Finds the signals of an instance whose names match the last part of `path`, in which `*` stands for any
/// characters, each with its path. For a signal with lanes, a name without an index means all of them.
pub(crate) fn signals<'a>(
    hierarchy: &'a Hierarchy,
    path: &str,
    run: u32,
) -> Result<Vec<(String, Found<'a>)>, UnknownName> {
    let (place, pattern) = enter(hierarchy, path, run, "signal")?;
    let inside = path.strip_suffix(&pattern).unwrap_or_default();
    let mut found = Vec::new();
    for signal in &hierarchy.scope(place.scope).signals {
        for lane in 0..signal.shape.lanes() {
            let name = format!("{}{}", signal.name, hierarchy::index(signal.shape, lane));
            if glob::matches(&pattern, &name) || glob::matches(&pattern, &signal.name) {
                let lane = place.lane * signal.shape.lanes() + lane;
                found.push((format!("{inside}{name}"), Found { signal, lane }));
            }
        }
    }
    if found.is_empty() {
        let names: Vec<String> = hierarchy.scope(place.scope).signals.iter().map(display_name).collect();
        return Err(unknown(hierarchy, place, "signal", &pattern, &names));
    }
    Ok(found)
}

/// Finds a memory of a run: its index in the program, and the lane.
pub(crate) fn memory(hierarchy: &Hierarchy, path: &str, run: u32) -> Result<(u32, u32), UnknownName> {
    let (place, name) = enter(hierarchy, path, run, "memory")?;
    let memories = &hierarchy.scope(place.scope).memories;
    let found = memories.iter().find_map(|(candidate, index, shape)| {
        let lane = lane(candidate, *shape, &name)?;
        Some((*index, place.lane * shape.lanes() + lane))
    });
    found.ok_or_else(|| {
        let names: Vec<String> =
            memories.iter().map(|(name, _, shape)| format!("{name}{}", hierarchy::index(*shape, 0))).collect();
        unknown(hierarchy, place, "memory", &name, &names)
    })
}

fn display_name(signal: &Signal) -> String {
    format!("{}{}", signal.name, hierarchy::index(signal.shape, 0))
}

/// The lane that a name with an index for each axis means, if it is one.
fn lane(of: &str, shape: Shape, name: &str) -> Option<u32> {
    hierarchy::at_index(shape, name.strip_prefix(of)?)
}

/// Follows a path to the instance that contains its last name.
fn enter(hierarchy: &Hierarchy, path: &str, run: u32, what: &'static str) -> Result<(Place, String), UnknownName> {
    let mut place = hierarchy.top(run);
    let mut names: Vec<&str> = path.split('.').collect();
    let last = names.pop().unwrap_or_default();
    let mut in_array = false;
    for name in names {
        if std::mem::take(&mut in_array) && name == "lane" {
            continue;
        }
        match hierarchy.child(place, name) {
            Some(child) => place = child,
            None => {
                let mut names: Vec<String> = hierarchy.children(place).into_iter().map(|(name, _)| name).collect();
                names.dedup();
                return Err(unknown(hierarchy, place, what, name, &names));
            }
        }
        in_array = name.ends_with(']');
    }
    Ok((place, last.to_string()))
}

fn unknown(hierarchy: &Hierarchy, place: Place, what: &'static str, name: &str, names: &[String]) -> UnknownName {
    let full = |name: &str| hierarchy.path_in(place, name);
    let names: Vec<String> = names.iter().map(|name| full(name)).collect();
    UnknownName::new(what, &full(name), &names)
}

//! Reads of memories that are not compared.

use crate::block::simulation;
use crate::shell::Failure;
use std::collections::HashSet;
use tilewright_hdl::{Design, ReadUnderWrite};
use tilewright_sim::EngineKind;
use tilewright_sim::program::hierarchy::index;

/// The signals, by path, that are reads of memories with [`ReadUnderWrite::Any`]: if their word is written at the same edge, each
/// simulator may give them another value.
///
/// # Errors
/// The design's memories are too large.
pub fn of_any(design: &Design) -> Result<HashSet<String>, Failure> {
    // Without passes, each read is a value of its own.
    let sim = simulation(design, EngineKind::Reference)?;
    let (memories, hierarchy) = (&sim.program().memories, &sim.program().hierarchy);
    let any = memories.iter().filter(|memory| memory.policy == ReadUnderWrite::Any && !memory.writes.is_empty());
    let values: HashSet<_> = any.flat_map(|memory| memory.reads.iter().map(|read| read.value)).collect();
    let mut paths = HashSet::new();
    for place in hierarchy.places(0) {
        for signal in hierarchy.scope(place.scope).signals.iter().filter(|signal| values.contains(&signal.value)) {
            let path = hierarchy.path_in(place, &signal.name);
            paths.extend((0..signal.shape.lanes()).map(|lane| format!("{path}{}", index(signal.shape, lane))));
        }
    }
    Ok(paths)
}

//! The nets of a block, by name.

use crate::view::nets::sources;
use tilewright_hdl::Design;
use tilewright_hdl::ir::Kind;
use tilewright_sim::Simulation;
use tilewright_sim::program::hierarchy::index;

/// A port, a register or a named net, one lane of it.
#[derive(Debug)]
pub struct Net {
    /// Its path below the top, as `why` and waves have it.
    pub name: String,
    pub width: u32,
    pub kind: Kind,
    /// File and line of its description, if they are known.
    pub source: Option<String>,
}

/// All nets: those of the top first, ports before others, then those of the instances.
pub fn nets(design: &Design, sim: &Simulation) -> Vec<Net> {
    let (sources, hierarchy) = (sources(design), &sim.program().hierarchy);
    let mut nets = Vec::new();
    for place in hierarchy.places(0) {
        let scope = hierarchy.scope(place.scope);
        for signal in &scope.signals {
            let source = sources.get(&(scope.module.clone(), signal.name.clone()));
            nets.extend((0..signal.shape.lanes()).map(|lane| Net {
                name: hierarchy.path_in(place, &format!("{}{}", signal.name, index(signal.shape, lane))),
                width: signal.width,
                kind: signal.kind,
                source: source.cloned(),
            }));
        }
    }
    nets
}

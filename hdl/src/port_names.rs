//! Names of ports that the description gives, as a bus standard or a pin-out wants them.

use crate::draft::Draft;
use tilewright_circuit::ir::NodeId;
use tilewright_circuit::{Mistake, Problem};

/// The names that a block gives to ports, by the names in its description.
pub(crate) type PortNames = Vec<(&'static str, String)>;

/// The name that the description gives to the port with this path: that of the port, or that of its record or stream
/// followed by the path within.
pub(crate) fn named(names: &PortNames, path: &str) -> Option<String> {
    names.iter().find_map(|(port, name)| match path.strip_prefix(port)? {
        "" => Some(name.clone()),
        within => Some(format!("{name}{}", within.strip_prefix('.')?.replace('.', "_"))),
    })
}

/// Reports names for ports that the block does not have.
pub(crate) fn check(draft: &Draft, outputs: &[(String, NodeId)], problems: &mut Vec<Problem>) {
    if draft.port_names.is_empty() {
        return;
    }
    let paths =
        draft.inputs.iter().map(|input| input.path.as_str()).chain(outputs.iter().map(|(path, _)| path.as_str()));
    let mut ports: Vec<&str> = Vec::new();
    for path in paths {
        let port = path.split('.').next().unwrap_or(path);
        if !ports.contains(&port) {
            ports.push(port);
        }
    }
    let clocks = draft.clocks.iter().flat_map(|clock| {
        let prefix = clock.map_or(String::new(), |clock| format!("{}_", clock.name));
        ["clk", "rst", "rst_n"].map(|port| format!("{prefix}{port}"))
    });
    let clocks: Vec<String> = clocks.collect();
    for (port, name) in &draft.port_names {
        if ports.contains(port) || clocks.iter().any(|clock| clock == port) {
            continue;
        }
        let message = format!("`{name}` names the port `{port}`, but `{}` has no such port", draft.block);
        let help = format!("its ports are `{}`; those of its clock are `{}`", ports.join("`, `"), clocks.join("`, `"));
        problems.push(Problem::new(Mistake::NoSuchPort, draft.declared.unwrap_or(draft.loc), message).help(help));
    }
}

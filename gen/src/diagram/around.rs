//! The surroundings of one net: what feeds it and what it feeds, within some steps.

use super::items::{Items, What};
use super::wires::Wire;
use super::{Around, DiagramError};
use tilewright_circuit::ir::{NodeId, Op};

/// The item of a net. A net of logic becomes an item.
pub(super) fn focus(items: &mut Items, around: &Around) -> Result<usize, DiagramError> {
    let name = around.net.as_str();
    if let Some(item) = (0..items.list.len()).find(|item| names(items, *item).iter().any(|it| it == name)) {
        return Ok(item);
    }
    let Some((scope, node)) = nets(items).into_iter().find(|(net, _)| net == name).map(|it| it.1) else {
        return Err(unknown(items, name));
    };
    items.add(scope, What::Net(node));
    Ok(items.list.len() - 1)
}

/// The names of an item: its own, and those of the ports it stands for.
fn names(items: &Items, item: usize) -> Vec<String> {
    let (scope, what) = items.list[item];
    let mut names = vec![format!("{}{}", items.scopes[scope].path, items.name(item))];
    if let What::Port(bundle) = what {
        names.extend(items.top_ports().bundles[bundle].members.iter().cloned());
    }
    names
}

/// The named nets of logic in all scopes.
fn nets(items: &Items) -> Vec<(String, (usize, NodeId))> {
    let mut nets = Vec::new();
    for (index, scope) in items.scopes.iter().enumerate() {
        for (id, node) in scope.module.nodes.iter().enumerate() {
            let is_logic = !matches!(node.op, Op::Register(_) | Op::Input(_));
            let name = node.name.as_ref().filter(|_| is_logic);
            nets.extend(name.map(|name| (format!("{}{name}", scope.path), (index, NodeId(id as u32)))));
        }
    }
    nets
}

/// The error for an unknown net, with the most similar name.
fn unknown(items: &Items, name: &str) -> DiagramError {
    let known = (0..items.list.len()).flat_map(|item| names(items, item));
    let known = known.chain(nets(items).into_iter().map(|it| it.0));
    let nearest = known.map(|known| (strsim::levenshtein(name, &known), known)).min();
    let similar = nearest.filter(|(edits, known)| *edits <= 1 + known.len() / 3).map(|it| it.1);
    DiagramError::UnknownNet { net: name.to_owned(), similar }
}

/// The items within `steps` of one, forwards and backwards, and the wires between them on these paths.
pub(super) fn within(items: &Items, wires: &[Wire], item: usize, steps: u32) -> (Vec<bool>, Vec<Wire>) {
    let mut shown = vec![false; items.list.len()];
    shown[item] = true;
    let mut kept = vec![false; wires.len()];
    for is_forward in [true, false] {
        let mut reached = vec![false; items.list.len()];
        reached[item] = true;
        for _ in 0..steps {
            let before = reached.clone();
            for (wire, kept) in wires.iter().zip(&mut kept) {
                let [near, far] = if is_forward { [wire.from, wire.to] } else { [wire.to, wire.from] };
                if before[near] {
                    (reached[far], shown[far], *kept) = (true, true, true);
                }
            }
        }
    }
    let wires = wires.iter().zip(kept).filter(|(_, kept)| *kept).map(|(wire, _)| wire.clone());
    (shown, wires.collect())
}

//! Makes the netlist smaller without changing what it computes: names for one value become one, constants are
//! computed now, equal expressions are computed once, what is the same in all lanes is computed once, and what nobody
//! can see is not computed.

use std::collections::HashMap;

use super::netlist::{Cell, Netlist};
use super::rules::{Cells, alias, fold, shorter};
use super::{Kind, ValueId};

/// Simplifies; `order` has each cell after its operands.
pub(super) fn simplify(netlist: &mut Netlist, order: &[ValueId]) {
    let mut same: Vec<ValueId> = (0..netlist.cells.len() as u32).map(ValueId).collect();
    let mut known: HashMap<(Kind, u32, u32), ValueId> = HashMap::new();
    for &id in order {
        netlist.cells[id.index()].kind.rewrite(|operand| *operand = same[operand.index()]);
        let Cell { kind, width, .. } = netlist.cell(id);
        let (kind, width) = (shorter(netlist, kind).unwrap_or_else(|| kind.clone()), *width);
        let kind = fold(netlist, &kind, width).map_or(kind, Kind::Const);
        same[id.index()] = match alias(netlist, &kind, width) {
            Some(of) => of,
            None => {
                netlist.cells[id.index()].kind = kind;
                uniform(netlist, &mut known, id);
                share(netlist, &mut known, id)
            }
        };
    }
    netlist.rewrite_roots(|value| *value = same[value.index()]);
}

/// The earlier cell that computes the same, or the cell itself.
fn share(netlist: &Netlist, known: &mut HashMap<(Kind, u32, u32), ValueId>, id: ValueId) -> ValueId {
    match netlist.cell(id) {
        Cell { kind: Kind::State, .. } => id,
        Cell { kind, lanes, width, .. } => *known.entry((kind.clone(), *lanes, *width)).or_insert(id),
    }
}

impl Cells for Netlist {
    fn kind(&self, id: ValueId) -> &Kind {
        &self.cell(id).kind
    }

    fn width(&self, id: ValueId) -> u32 {
        self.cell(id).width
    }
}

/// What is the same in all lanes or groups is computed once, before it is repeated.
fn uniform(netlist: &mut Netlist, known: &mut HashMap<(Kind, u32, u32), ValueId>, id: ValueId) {
    let cell = netlist.cell(id);
    let repeated = match &cell.kind {
        Kind::Broadcast(of, n) => match netlist.cell(*of).kind {
            Kind::Broadcast(plain, inner) => Some(Kind::Broadcast(plain, inner * n)),
            _ => None,
        },
        Kind::PerLane(_) => tile(netlist, known, id),
        kind if kind.is_elementwise() => hoist(netlist, known, id),
        _ => None,
    };
    if let Some(kind) = repeated {
        netlist.cells[id.index()].kind = kind;
    }
}

/// Lanes of which each is the same in all groups.
fn tile(netlist: &mut Netlist, known: &mut HashMap<(Kind, u32, u32), ValueId>, id: ValueId) -> Option<Kind> {
    let Cell { kind: Kind::PerLane(parts), lanes, width, origin } = netlist.cell(id).clone() else { return None };
    let groups = lanes / parts.len() as u32;
    let plain = parts.iter().map(|part| match netlist.cell(*part).kind {
        Kind::Broadcast(plain, n) if n == groups => Some(plain),
        _ => None,
    });
    let plain = plain.collect::<Option<Vec<ValueId>>>().filter(|_| groups > 1)?;
    let of = add(netlist, known, Cell { kind: Kind::PerLane(plain), lanes: lanes / groups, width, origin });
    Some(Kind::Tile(of, groups))
}

/// An operation whose operands are all repeated in the same way, or constants.
fn hoist(netlist: &mut Netlist, known: &mut HashMap<(Kind, u32, u32), ValueId>, id: ValueId) -> Option<Kind> {
    let Cell { mut kind, lanes, width, origin } = netlist.cell(id).clone();
    let mut ways = Vec::new();
    kind.for_each_operand(|operand| match netlist.cell(operand).kind {
        Kind::Broadcast(_, n) => ways.push(Some((false, n))),
        Kind::Tile(_, m) => ways.push(Some((true, m))),
        Kind::Const(_) => {}
        _ => ways.push(None),
    });
    let (tiled, times) = ways.first().copied().flatten().filter(|way| ways.iter().all(|other| *other == Some(*way)))?;
    let lanes = lanes / times;
    kind.rewrite(|operand| {
        *operand = match netlist.cell(*operand).kind.clone() {
            Kind::Broadcast(plain, _) | Kind::Tile(plain, _) => plain,
            constant => {
                let width = netlist.cell(*operand).width;
                add(netlist, known, Cell { kind: constant, lanes, width, origin: None })
            }
        }
    });
    let plain = add(netlist, known, Cell { kind, lanes, width, origin });
    Some(if tiled { Kind::Tile(plain, times) } else { Kind::Broadcast(plain, times) })
}

/// A cell of which all operands are simplified, or an earlier one that computes the same.
fn add(netlist: &mut Netlist, known: &mut HashMap<(Kind, u32, u32), ValueId>, cell: Cell) -> ValueId {
    netlist.cells.push(cell);
    share(netlist, known, ValueId(netlist.cells.len() as u32 - 1))
}

//! Makes the netlist smaller without changing what it computes: names for one value become one, constants are
//! computed now, equal expressions are computed once, what is the same in all lanes is computed once, and what nobody
//! can see is not computed.

use rustc_hash::FxHashMap;

use super::lift::lift;
use super::netlist::{Cell, Netlist};
use super::rules::{Cells, alias, fold, name, shorter};
use super::{Kind, Passes, ValueId};

/// Cells by what they compute.
pub(super) type Known = FxHashMap<(Kind, u32, u32), ValueId>;

/// Simplifies; `order` has each cell after its operands.
pub(super) fn simplify(netlist: &mut Netlist, order: &[ValueId], passes: &Passes) {
    let mut same: Vec<ValueId> = (0..netlist.cells.len() as u32).map(ValueId).collect();
    let mut known = Known::default();
    for &id in order {
        netlist.cells[id.index()].kind.rewrite(|operand| *operand = same[operand.index()]);
        let Cell { kind, width, .. } = netlist.cell(id).clone();
        let kind = if passes.fold { folded(netlist, kind, width) } else { kind };
        let alias = if passes.fold { alias(netlist, &kind, width) } else { name(&kind) };
        same[id.index()] = alias.unwrap_or_else(|| {
            netlist.cells[id.index()].kind = kind;
            let whole = uniform(netlist, &mut known, id, passes);
            let share = |known: &mut Known| if passes.share { share(netlist, known, id) } else { id };
            whole.unwrap_or_else(|| share(&mut known))
        });
    }
    netlist.rewrite_roots(|value| *value = same[value.index()]);
}

/// A smaller operation that does the same, or the operation itself.
fn folded(netlist: &Netlist, kind: Kind, width: u32) -> Kind {
    let kind = shorter(netlist, &kind).unwrap_or(kind);
    fold(netlist, &kind, width).map_or(kind, Kind::Const)
}

/// The earlier cell that computes the same, or the cell itself.
fn share(netlist: &Netlist, known: &mut Known, id: ValueId) -> ValueId {
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

/// What is the same in all lanes or groups is computed once, before it is repeated; lanes that are computed alike are
/// computed together.
fn uniform(netlist: &mut Netlist, known: &mut Known, id: ValueId, passes: &Passes) -> Option<ValueId> {
    let Cell { kind, lanes, width, .. } = netlist.cell(id).clone();
    if passes.lift
        && let Kind::PerLane(parts) = &kind
        && let Some(whole) = lift(netlist, known, parts, lanes)
    {
        return Some(whole);
    }
    if passes.uniform
        && let Some(kind) = once(netlist, known, &kind, lanes, width)
    {
        netlist.cells[id.index()].kind = kind;
    }
    None
}

/// A cell of an operation whose operands are all simplified.
pub(super) fn repeated(netlist: &mut Netlist, known: &mut Known, kind: Kind, lanes: u32, width: u32) -> ValueId {
    let kind = once(netlist, known, &kind, lanes, width).unwrap_or(kind);
    let kind = fold(netlist, &kind, width).map_or(kind, Kind::Const);
    match alias(netlist, &kind, width) {
        Some(of) => of,
        None => add(netlist, known, kind, lanes, width),
    }
}

/// An operation as the repetition of one with fewer lanes.
fn once(netlist: &mut Netlist, known: &mut Known, kind: &Kind, lanes: u32, width: u32) -> Option<Kind> {
    match kind {
        Kind::Broadcast(of, n) => match netlist.cell(*of).kind {
            Kind::Broadcast(plain, inner) => Some(Kind::Broadcast(plain, inner * n)),
            _ => None,
        },
        Kind::PerLane(parts) => tile(netlist, known, parts, lanes, width),
        kind if kind.is_elementwise() => hoist(netlist, known, kind, lanes, width),
        _ => None,
    }
}

/// Lanes of which each is the same in all groups.
fn tile(netlist: &mut Netlist, known: &mut Known, parts: &[ValueId], lanes: u32, width: u32) -> Option<Kind> {
    let groups = lanes / parts.len() as u32;
    let plain = parts.iter().map(|part| match netlist.cell(*part).kind {
        Kind::Broadcast(plain, n) if n == groups => Some(plain),
        _ => None,
    });
    let plain = plain.collect::<Option<Vec<ValueId>>>().filter(|_| groups > 1)?;
    let row = lanes / groups;
    let of = match lift(netlist, known, &plain, row) {
        Some(of) => of,
        None => add(netlist, known, Kind::PerLane(plain), row, width),
    };
    Some(Kind::Tile(of, groups))
}

/// An operation whose operands are all repeated in the same way, or constants.
fn hoist(netlist: &mut Netlist, known: &mut Known, kind: &Kind, lanes: u32, width: u32) -> Option<Kind> {
    let mut ways = Vec::new();
    kind.for_each_operand(|operand| match netlist.cell(operand).kind {
        Kind::Broadcast(_, n) => ways.push(Some((false, n))),
        Kind::Tile(_, m) => ways.push(Some((true, m))),
        Kind::Const(_) => {}
        _ => ways.push(None),
    });
    let (tiled, times) = ways.first().copied().flatten().filter(|way| ways.iter().all(|other| *other == Some(*way)))?;
    let (mut kind, lanes) = (kind.clone(), lanes / times);
    kind.rewrite(|operand| {
        *operand = match netlist.cell(*operand).kind.clone() {
            Kind::Broadcast(plain, _) | Kind::Tile(plain, _) => plain,
            constant => {
                let width = netlist.cell(*operand).width;
                add(netlist, known, constant, lanes, width)
            }
        }
    });
    let plain = add(netlist, known, kind, lanes, width);
    Some(if tiled { Kind::Tile(plain, times) } else { Kind::Broadcast(plain, times) })
}

/// A cell, or an earlier one that computes the same.
pub(super) fn add(netlist: &mut Netlist, known: &mut Known, kind: Kind, lanes: u32, width: u32) -> ValueId {
    netlist.cells.push(Cell { kind, lanes, width });
    share(netlist, known, ValueId(netlist.cells.len() as u32 - 1))
}

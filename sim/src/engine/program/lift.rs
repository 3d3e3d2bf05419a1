//! Single values that are computed alike become one array.

use rustc_hash::FxHashMap;

use super::netlist::Netlist;
use super::simplify::{Known, add, repeated};
use super::{Kind, ValueId};

/// How deep expressions may be that are compared.
const DEPTH: u32 = 16;

/// The array of these lanes, if they are the lanes of one, or are computed in the same way from such, from constants
/// and from what is the same for all: then it is computed in all lanes together.
pub(super) fn lift(netlist: &mut Netlist, known: &mut Known, parts: &[ValueId], lanes: u32) -> Option<ValueId> {
    let is_computed = |part: &ValueId| match netlist.cell(*part).kind {
        Kind::Lane { .. } => true,
        ref kind => kind.is_elementwise(),
    };
    if parts.len() < 2 || !parts.iter().any(is_computed) {
        return None;
    }
    Lift { netlist, known, lanes, found: FxHashMap::default() }.array(parts, DEPTH)
}

struct Lift<'a> {
    netlist: &'a mut Netlist,
    known: &'a mut Known,
    lanes: u32,
    /// What has been looked at.
    found: FxHashMap<Vec<ValueId>, Option<ValueId>>,
}

impl Lift<'_> {
    /// An array with these lanes.
    fn array(&mut self, parts: &[ValueId], depth: u32) -> Option<ValueId> {
        if let Some(found) = self.found.get(parts) {
            return *found;
        }
        let found = self.make(parts, depth);
        self.found.insert(parts.to_vec(), found);
        found
    }

    fn make(&mut self, parts: &[ValueId], depth: u32) -> Option<ValueId> {
        let Lift { netlist, known, lanes, .. } = self;
        let lanes = *lanes;
        let n = parts.len() as u32;
        let width = netlist.cell(parts[0]).width;
        let first = netlist.cell(parts[0]).kind.clone();
        if parts.iter().all(|part| *part == parts[0]) {
            return Some(repeated(netlist, known, Kind::Broadcast(parts[0], n), lanes, width));
        }
        if parts.iter().all(|part| matches!(netlist.cell(*part).kind, Kind::Const(_))) {
            return Some(add(netlist, known, Kind::PerLane(parts.to_vec()), lanes, width));
        }
        if let Kind::Lane { of, group, .. } = first {
            let in_order =
                (0..).zip(parts).all(|(i, part)| netlist.cell(*part).kind == Kind::Lane { of, index: i, group });
            return (in_order && group == n).then_some(of);
        }
        if depth == 0 || !first.is_elementwise() {
            return None;
        }
        let shape = shape(&first);
        let mut columns: Vec<Vec<ValueId>> = Vec::new();
        for part in parts {
            let cell = netlist.cell(*part);
            if self::shape(&cell.kind) != shape {
                return None;
            }
            let mut operands = Vec::new();
            cell.kind.for_each_operand(|operand| operands.push(operand));
            columns.resize_with(operands.len(), Vec::new);
            columns.iter_mut().zip(operands).for_each(|(column, operand)| column.push(operand));
        }
        let same_width = |column: &Vec<ValueId>| {
            column.iter().all(|operand| netlist.cell(*operand).width == netlist.cell(column[0]).width)
        };
        if !columns.iter().all(same_width) {
            return None;
        }
        let mut operands = Vec::new();
        for column in &columns {
            operands.push(self.array(column, depth - 1)?);
        }
        let mut operands = operands.into_iter();
        let mut kind = first;
        kind.rewrite(|operand| *operand = operands.next().expect("one for each operand"));
        Some(repeated(self.netlist, self.known, kind, lanes, width))
    }
}

/// An operation with its operands left out.
fn shape(kind: &Kind) -> Kind {
    let mut shape = kind.clone();
    shape.rewrite(|operand| *operand = ValueId(0));
    shape
}

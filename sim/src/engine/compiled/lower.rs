//! Makes of operations across lanes what a loop over strips can do.

use std::collections::HashMap;

use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Binary, Reduction};

use super::function::MemoryAt;
use super::graph::{Cell, Graph, Sink};
use super::layout::Strips;
use crate::engine::Passes;
use crate::engine::program::{Kind, ValueId};

/// Constants that a pass has added, so that it adds each once.
#[derive(Default)]
struct Tables(HashMap<(u32, Vec<bool>), ValueId>);

impl Tables {
    /// A 1-bit value of so many lanes: `pattern` over and over.
    fn flags(&mut self, graph: &mut Graph, lanes: u32, pattern: &[bool]) -> ValueId {
        if let Some(&id) = self.0.get(&(lanes, pattern.to_vec())) {
            return id;
        }
        let outer = lanes / pattern.len() as u32;
        let [zero, one] = [0, 1].map(|bit| graph.add(Kind::Const(Bits::from_limbs(1, &[bit])), outer, 1));
        let parts = pattern.iter().map(|&bit| if bit { one } else { zero }).collect();
        let id = graph.add(Kind::PerLane(parts), lanes, 1);
        self.0.insert((lanes, pattern.to_vec()), id);
        id
    }

    /// 1 in the lanes that exist, which those of the last strip may not.
    fn existing(&mut self, graph: &mut Graph, lanes: u32) -> ValueId {
        self.flags(graph, lanes, &vec![true; lanes as usize])
    }
}

/// The widest number that constants are looked up by.
const LOOKED_UP_BY: u32 = 8;
/// From how many arms on a choice between constants is looked up.
const ARMS: usize = 4;

/// Rewrites a graph:
///
/// - choices between constants are looked up in a table, and rotations are found;
/// - words of memories are converted from and to how they stand there;
/// - neighbours are loaded from anywhere, and replaced at the edges of their groups: the `edge` of the [`Kind::Shifted`]
///   that remains is not looked at;
/// - lanes that pad the last strip take no part in reductions and write nothing.
pub(super) fn lower(graph: &mut Graph, strips: &Strips, memories: &[MemoryAt], passes: &Passes) {
    let mut tables = Tables::default();
    for index in 0..graph.cells.len() {
        let id = ValueId(index as u32);
        match graph.cell(id).kind.clone() {
            Kind::Shifted { of, by, edge, group } => neighbour(graph, &mut tables, id, of, by, edge, group),
            Kind::Reduce { by, of, group } => reduction(graph, &mut tables, strips, id, by, of, group),
            Kind::Read { memory, address } if memories[memory as usize].blank != 0 => {
                let Cell { lanes, width, .. } = *graph.cell(id);
                let word = graph.add(Kind::Read { memory, address }, lanes, width);
                graph.cells[index].kind = graph.standing(&memories[memory as usize], word);
            }
            Kind::Case { subject, arms, default } if passes.lookups && graph.cell(id).lanes == 1 => {
                lookup(graph, id, subject, &arms, default);
            }
            Kind::Concat(parts) if passes.lookups && graph.cell(id).lanes == 1 => {
                if let Some(rotation) = rotation(graph, &parts) {
                    graph.rotations.insert(id, rotation);
                }
            }
            _ => {}
        }
    }
    for index in 0..graph.sinks.len() {
        if let Sink::Write { memory, mut enable, address, mut data } = graph.sinks[index] {
            let lanes = graph.cell(enable).lanes;
            let at = &memories[memory as usize];
            if at.blank != 0 {
                let kind = graph.standing(at, data);
                data = graph.add(kind, lanes, at.width);
            }
            if lanes > 1 && !lanes.is_multiple_of(strips.strip(lanes)) {
                let existing = tables.existing(graph, lanes);
                enable = graph.add(Kind::Binary(Binary::And, enable, existing), lanes, 1);
            }
            graph.sinks[index] = Sink::Write { memory, enable, address, data };
        }
    }
}

impl Graph {
    /// As [`MemoryAt::standing`].
    fn standing(&mut self, at: &MemoryAt, word: ValueId) -> Kind {
        let lanes = self.cell(word).lanes;
        let blank = self.add(Kind::Const(Bits::new(at.width, at.blank)), lanes, at.width);
        Kind::Binary(Binary::Xor, word, blank)
    }
}

fn neighbour(graph: &mut Graph, tables: &mut Tables, id: ValueId, of: ValueId, by: i32, edge: ValueId, group: u32) {
    let (lanes, width) = (graph.cell(id).lanes, graph.cell(id).width);
    let has_neighbour = |lane: u32| lane.checked_add_signed(-by).is_some_and(|from| from < group);
    let pattern: Vec<bool> = (0..group).map(has_neighbour).collect();
    let end = match graph.cell(edge).kind.clone() {
        Kind::Const(bits) => graph.add(Kind::Const(bits), lanes, width),
        Kind::Broadcast(plain, n) => graph.add(Kind::Broadcast(plain, n * group), lanes, width),
        _ => graph.add(Kind::Broadcast(edge, group), lanes, width),
    };
    if !pattern.contains(&true) {
        graph.cells[id.index()].kind = Kind::Alias(end);
        return;
    }
    let select = tables.flags(graph, lanes, &pattern);
    let anywhere = graph.add(Kind::Shifted { of, by, edge: of, group }, lanes, width);
    graph.cells[id.index()].kind = Kind::Mux { select, on_true: anywhere, on_false: end };
}

fn reduction(
    graph: &mut Graph,
    tables: &mut Tables,
    strips: &Strips,
    id: ValueId,
    by: Reduction,
    of: ValueId,
    group: u32,
) {
    let (lanes, width) = (graph.cell(of).lanes, graph.cell(of).width);
    if group < lanes || lanes % strips.strip(lanes) == 0 {
        return;
    }
    let neutral = if by == Reduction::And { Bits::ones(width) } else { Bits::zero(width) };
    let select = tables.existing(graph, lanes);
    let neutral = graph.add(Kind::Const(neutral), lanes, width);
    let of = graph.add(Kind::Mux { select, on_true: of, on_false: neutral }, lanes, width);
    graph.cells[id.index()].kind = Kind::Reduce { by, of, group };
}

/// Puts constants to choose from into a table.
fn lookup(graph: &mut Graph, id: ValueId, subject: ValueId, arms: &[(Bits, ValueId)], default: ValueId) {
    let is_constant = |value: ValueId| matches!(graph.cell(value).kind, Kind::Const(_));
    let (width, by) = (graph.cell(id).width, graph.cell(subject).width);
    let all = is_constant(default) && arms.iter().all(|(_, value)| is_constant(*value));
    if !all || arms.len() < ARMS || by > LOOKED_UP_BY || width > 64 {
        return;
    }
    let mut parts = vec![default; 1 << by];
    arms.iter().for_each(|(key, value)| parts[key.limbs()[0] as usize] = *value);
    let table = graph.add(Kind::PerLane(parts), 1 << by, width);
    graph.lookups.insert(id, table);
}

/// What a concatenation of the two parts of a value rotates, and by how much to the left, if the machine has integers
/// of its width.
fn rotation(graph: &Graph, parts: &[ValueId]) -> Option<(ValueId, u32)> {
    let &[upper, lower] = parts else { return None };
    match (&graph.cell(upper).kind, &graph.cell(lower).kind) {
        (&Kind::Slice(of, 0), &Kind::Slice(other, low)) => {
            let width = graph.cell(of).width;
            let widths = (graph.cell(upper).width, graph.cell(lower).width);
            let is_whole = of == other && widths == (low, width - low);
            (is_whole && matches!(width, 8 | 16 | 32 | 64)).then_some((of, width - low))
        }
        _ => None,
    }
}

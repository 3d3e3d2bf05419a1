//! Makes the diagram of items and wires: the words in boxes, and one arrow for all wires between two boxes.

use super::fold::{Detail, Groups, numbered};
use super::items::{Items, What};
use super::model::{Arrow, ArrowKind, BoxKind, Diagram, DiagramBox, Frame};
use super::wires::Wire;
use std::collections::{BTreeMap, BTreeSet};
use tilewright_circuit::ir::{ClockId, Contents, Memory, Shape};

/// The most lines of names in a box; the last one says how many more there are.
const MOST_NAMES: usize = 6;

/// The diagram of the items shown, at that detail.
pub(super) fn build(items: &Items, wires: &[Wire], shown: &[bool], detail: Detail) -> Diagram {
    let groups = Groups::of(items, wires, shown, detail);
    let words = Words { items };
    let mut members = groups.members();
    members.retain(|group, _| shown[*group]);
    let index: BTreeMap<usize, usize> = members.keys().enumerate().map(|(i, group)| (*group, i)).collect();
    let boxes = members.values().map(|members| words.of_box(members)).collect();
    let mut drawn: BTreeMap<(usize, usize, ArrowKind), BTreeSet<String>> = BTreeMap::new();
    for wire in wires.iter().filter(|wire| shown[wire.from] && shown[wire.to]) {
        let [from, to] = [wire.from, wire.to].map(|item| index[&groups.of_item(item)]);
        if from != to {
            drawn.entry((from, to, kind(wire))).or_default().extend(words.of_wire(wire));
        }
    }
    let (arrows, hidden) = without_needless(drawn, detail);
    let clocks = items.design.top().clocks.iter().map(|clock| clock.name.unwrap_or(&clock.port).to_owned());
    let clocks = Some(clocks.collect::<Vec<_>>()).filter(|clocks| clocks.len() > 1).unwrap_or_default();
    let (boxes, frames) = without_empty(boxes, words.frames());
    Diagram { title: block_name(&items.design.top().parameters), boxes, arrows, frames, clocks, hidden }
}

/// Drops frames without boxes, and renumbers the others.
fn without_empty(mut boxes: Vec<DiagramBox>, frames: Vec<Frame>) -> (Vec<DiagramBox>, Vec<Frame>) {
    let mut is_full = vec![false; frames.len()];
    for it in &boxes {
        let mut frame = it.frame;
        while let Some(index) = frame {
            is_full[index] = true;
            frame = frames[index].frame;
        }
    }
    let number = |frame: usize| is_full[..frame].iter().filter(|full| **full).count();
    boxes.iter_mut().for_each(|it| it.frame = it.frame.map(number));
    let left = frames.into_iter().zip(&is_full).filter(|(_, full)| **full);
    (boxes, left.map(|(it, _)| Frame { frame: it.frame.map(number), ..it }).collect())
}

fn kind(wire: &Wire) -> ArrowKind {
    match (wire.is_stream, wire.is_data) {
        (true, _) => ArrowKind::Stream,
        (_, true) => ArrowKind::Data,
        _ => ArrowKind::Control,
    }
}

/// Drops control beside data. Where control is not shown, drops that too, except where a box has no other arrow in or out. Returns the number of these.
fn without_needless(
    drawn: BTreeMap<(usize, usize, ArrowKind), BTreeSet<String>>,
    detail: Detail,
) -> (Vec<Arrow>, usize) {
    let data: Vec<(usize, usize)> =
        drawn.keys().filter(|key| key.2 != ArrowKind::Control).map(|(from, to, _)| (*from, *to)).collect();
    let ways: BTreeSet<(usize, usize)> = data.iter().copied().collect();
    let left: BTreeSet<usize> = data.iter().map(|(from, _)| *from).collect();
    let entered: BTreeSet<usize> = data.iter().map(|(_, to)| *to).collect();
    let (mut arrows, mut hidden) = (Vec::new(), 0);
    for ((from, to, kind), signals) in drawn {
        if kind == ArrowKind::Control {
            if ways.contains(&(from, to)) {
                continue;
            }
            if detail > Detail::All && left.contains(&from) && entered.contains(&to) {
                hidden += 1;
                continue;
            }
        }
        arrows.push(Arrow { from, to, kind, signals: signals.into_iter().collect() });
    }
    (arrows, hidden)
}

/// The words in boxes and beside arrows.
struct Words<'a> {
    items: &'a Items<'a>,
}

impl Words<'_> {
    fn of_box(&self, members: &[usize]) -> DiagramBox {
        let items = self.items;
        let (scope, what) = items.list[members[0]];
        let module = items.scopes[scope].module;
        let one = |note: String| if members.len() == 1 { note } else { String::new() };
        let (kind, note, count, is_stream, clocks) = match what {
            What::Port(bundle) => {
                let bundle = &items.top_ports().bundles[bundle];
                let kind = if bundle.comes_in { BoxKind::Input } else { BoxKind::Output };
                let count = if bundle.elements > 1 { bundle.elements.to_string() } else { String::new() };
                (kind, one(bits(bundle.bits)), one(count), bundle.is_stream, vec![])
            }
            What::Register(id) => {
                let register = &module.registers[id.0 as usize];
                let node = module.node(register.node);
                let note = bits(node.width.into());
                (BoxKind::Register, one(note), one(lanes(node.shape)), false, vec![register.clock])
            }
            What::Memory(id) => {
                let memory = &module.memories[id.0 as usize];
                let writes = memory.writes.iter().map(|write| write.clock);
                let clocks = writes.chain(memory.reads.iter().filter_map(|read| read.clock));
                (BoxKind::Memory, one(size(memory)), one(lanes(memory.shape)), false, clocks.collect())
            }
            What::Instance(id) => {
                let instance = items.instance(scope, id);
                let module = items.design.module(instance.module);
                // The block of a foreign module is only its model.
                let block = match &module.foreign {
                    Some(foreign) => foreign.module.clone(),
                    None => block_name(&module.parameters),
                };
                let count = if members.len() == 1 { lanes(instance.shape) } else { members.len().to_string() };
                (BoxKind::Instance, block, count, false, instance.clocks.clone())
            }
            What::Net(id) => (BoxKind::Net, bits(module.width(id).into()), lanes(module.shape(id)), false, vec![]),
        };
        DiagramBox {
            kind,
            names: self.names(members),
            note,
            count,
            is_stream,
            is_focus: items.focus == Some(members[0]),
            clocks: self.clocks(scope, &clocks),
            frame: scope.checked_sub(1),
            members: members.iter().flat_map(|item| self.full_names(*item)).collect(),
        }
    }

    fn names(&self, members: &[usize]) -> Vec<String> {
        let is_instance = matches!(self.items.list[members[0]].1, What::Instance(_));
        // Instances that share a box have numbered names.
        if let Some((stem, _)) = numbered(self.items.name(members[0])).filter(|_| is_instance && members.len() > 1) {
            return vec![format!("{stem}[*]")];
        }
        let mut names: Vec<String> = members.iter().map(|item| self.items.name(*item).to_owned()).collect();
        if names.len() > MOST_NAMES {
            let more = names.len() + 1 - MOST_NAMES;
            names.truncate(MOST_NAMES - 1);
            names.push(format!("and {more} more"));
        }
        names
    }

    fn full_names(&self, item: usize) -> Vec<String> {
        let (scope, what) = self.items.list[item];
        match what {
            What::Port(bundle) => self.items.top_ports().bundles[bundle].members.clone(),
            _ => vec![format!("{}{}", self.items.scopes[scope].path, self.items.name(item))],
        }
    }

    /// The clocks of the top module that drive those of a scope, sorted; none if the top has one.
    fn clocks(&self, scope: usize, clocks: &[ClockId]) -> Vec<usize> {
        if self.items.design.top().clocks.len() < 2 {
            return Vec::new();
        }
        let top = |clock: &ClockId| {
            let (mut scope, mut clock) = (scope, *clock);
            while let Some((outside, id)) = self.items.scopes[scope].outside {
                clock = self.items.instance(outside, id).clocks[clock.0 as usize];
                scope = outside;
            }
            clock.0 as usize
        };
        clocks.iter().map(top).collect::<BTreeSet<_>>().into_iter().collect()
    }

    /// The instance port at the end of a wire, unless the box at the other end has the same name.
    fn of_wire(&self, wire: &Wire) -> Option<String> {
        let port = |item: usize, bundle: Option<usize>| {
            let (scope, what) = self.items.list[item];
            let What::Instance(id) = what else { return None };
            Some(&self.items.ports_of(self.items.instance(scope, id)).bundles[bundle?].name)
        };
        let (port, other) = match port(wire.from, wire.leaves) {
            Some(port) => (port, wire.to),
            None => (port(wire.to, wire.enters)?, wire.from),
        };
        (self.items.name(other) != port).then(|| port.clone())
    }

    fn frames(&self) -> Vec<Frame> {
        let opened = self.items.scopes.iter().filter_map(|scope| {
            let (outside, id) = scope.outside?;
            let instance = self.items.instance(outside, id);
            Some(Frame { name: instance.name.clone(), count: lanes(instance.shape), frame: outside.checked_sub(1) })
        });
        opened.collect()
    }
}

fn bits(bits: u64) -> String {
    if bits == 1 { "1 bit".to_owned() } else { format!("{bits} bits") }
}

fn lanes(shape: Shape) -> String {
    match shape {
        _ if shape.lanes() == 1 => String::new(),
        Shape::Plain => String::new(),
        Shape::Row(lanes) => lanes.to_string(),
        Shape::Grid(rows, columns) => format!("{rows}×{columns}"),
    }
}

fn size(memory: &Memory) -> String {
    let is_table = memory.writes.is_empty() && memory.contents != Contents::Unknown;
    let what = if is_table { "table, " } else { "" };
    format!("{what}{} × {}", memory.depth, bits(memory.width.into()))
}

/// `Counter` of `Counter { width: 8 }`.
fn block_name(parameters: &str) -> String {
    parameters.split([' ', '{', '(', '<']).next().unwrap_or_default().to_owned()
}

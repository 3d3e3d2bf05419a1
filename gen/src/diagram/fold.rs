//! Which items share a box, so that a diagram stays readable.

use super::items::{Items, What};
use super::wires::Wire;
use std::collections::{BTreeMap, BTreeSet};
use tilewright_circuit::ir::ClockId;

/// How much of a design is shown, from everything to least.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Detail {
    /// A box for each item, and all arrows.
    All,
    /// No arrows of control, except where a box has no other in or out.
    Data,
    /// Items with the same neighbours share a box.
    Neighbours,
    /// Registers in a cycle share a box.
    Cycles,
    /// Registers of a pipeline stage share a box. The stage is the longest path from the first registers.
    Stages,
    /// Two stages share a box, then four.
    PairsOfStages,
    FoursOfStages,
    /// Connected registers share a box.
    Connected,
    /// All registers of a clock share a box.
    Clocks,
}

impl Detail {
    pub const ALL: [Detail; 9] = [
        Detail::All,
        Detail::Data,
        Detail::Neighbours,
        Detail::Cycles,
        Detail::Stages,
        Detail::PairsOfStages,
        Detail::FoursOfStages,
        Detail::Connected,
        Detail::Clocks,
    ];
}

/// For each item, the first item of its box.
pub(super) struct Groups(Vec<usize>);

impl Groups {
    /// The groups of the items shown.
    pub fn of(items: &Items, wires: &[Wire], shown: &[bool], detail: Detail) -> Groups {
        let wires: Vec<Wire> = wires.iter().filter(|wire| shown[wire.from] && shown[wire.to]).cloned().collect();
        let wires = &wires[..];
        let mut groups = Groups((0..items.list.len()).collect());
        let registers = Registers::of(items, shown);
        match detail {
            Detail::Clocks => registers.all(&mut groups),
            Detail::Connected => registers.connected(wires, &mut groups),
            Detail::Cycles => registers.cycles(wires, &mut groups),
            Detail::Stages => registers.stages(wires, 1, &mut groups),
            Detail::PairsOfStages => registers.stages(wires, 2, &mut groups),
            Detail::FoursOfStages => registers.stages(wires, 4, &mut groups),
            _ => {}
        }
        if detail >= Detail::Neighbours {
            groups.join_numbered(items, shown);
            // Joining two groups can make the neighbours of others equal.
            for _ in 0..3 {
                groups.join_equal(items, wires);
            }
        }
        groups
    }

    pub fn of_item(&self, item: usize) -> usize {
        self.0[item]
    }

    /// The items of each group, sorted by their first.
    pub fn members(&self) -> BTreeMap<usize, Vec<usize>> {
        let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        self.0.iter().enumerate().for_each(|(item, group)| members.entry(*group).or_default().push(item));
        members
    }

    fn join(&mut self, a: usize, b: usize) {
        let (to, from) = (self.0[a].min(self.0[b]), self.0[a].max(self.0[b]));
        self.0.iter_mut().filter(|group| **group == from).for_each(|group| *group = to);
    }

    /// Joins instances of one block whose names differ only in the number at their end.
    fn join_numbered(&mut self, items: &Items, shown: &[bool]) {
        let mut families: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        for (item, (scope, what)) in items.list.iter().enumerate().filter(|(item, _)| shown[*item]) {
            if let (What::Instance(id), Some((stem, _))) = (*what, numbered(items.name(item))) {
                let module = items.instance(*scope, id).module;
                families.entry((*scope, module, stem)).or_default().push(item);
            }
        }
        for family in families
            .values()
            .filter(|family| family.len() >= MANY && items.focus.is_none_or(|item| !family.contains(&item)))
        {
            family.iter().for_each(|item| self.join(family[0], *item));
        }
    }

    /// Joins groups of one kind and clock with the same neighbours on both sides.
    fn join_equal(&mut self, items: &Items, wires: &[Wire]) {
        let (mut before, mut behind) = (BTreeMap::new(), BTreeMap::new());
        for wire in wires.iter().filter(|wire| wire.is_data) {
            let [from, to] = [wire.from, wire.to].map(|item| self.0[item]);
            if from != to {
                before.entry(to).or_insert_with(BTreeSet::new).insert((from, wire.leaves));
                behind.entry(from).or_insert_with(BTreeSet::new).insert((to, wire.enters));
            }
        }
        let mut first = BTreeMap::new();
        for group in self.members().into_keys() {
            let Some(kind) = kind(items, group) else { continue };
            // Groups without neighbours stay apart.
            if !before.contains_key(&group) && !behind.contains_key(&group) {
                continue;
            }
            let key = (kind, before.get(&group).cloned(), behind.get(&group).cloned());
            let of = *first.entry(key).or_insert(group);
            self.join(of, group);
        }
    }
}

/// The fewest numbered instances that can share a box.
const MANY: usize = 4;

/// A name without the number at its end, and the number.
pub(super) fn numbered(name: &str) -> Option<(&str, &str)> {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    (stem.len() < name.len() && !stem.is_empty()).then(|| name.split_at(stem.len()))
}

/// The kind, scope and clock of an item; items that agree in it can share a box. Streams, instances and the focus have boxes of their own.
fn kind(items: &Items, item: usize) -> Option<(u8, usize, Option<ClockId>)> {
    let (scope, what) = items.list[item];
    let module = items.scopes[scope].module;
    match what {
        _ if items.focus == Some(item) => None,
        What::Port(bundle) => {
            let bundle = &items.top_ports().bundles[bundle];
            (!bundle.is_stream).then_some((bundle.comes_in.into(), scope, None))
        }
        What::Register(id) => Some((2, scope, Some(module.registers[id.0 as usize].clock))),
        What::Memory(_) => Some((3, scope, None)),
        What::Instance(_) | What::Net(_) => None,
    }
}

/// The registers, with their scope and clock.
struct Registers(BTreeMap<usize, (u8, usize, Option<ClockId>)>);

impl Registers {
    fn of(items: &Items, shown: &[bool]) -> Registers {
        let all = (0..items.list.len()).filter(|item| shown[*item]);
        let registers = all.filter(|item| matches!(items.list[*item].1, What::Register(_)));
        Registers(registers.filter_map(|item| Some((item, kind(items, item)?))).collect())
    }

    fn all(&self, groups: &mut Groups) {
        let mut first = BTreeMap::new();
        for (item, kind) in &self.0 {
            let of = *first.entry(kind).or_insert(*item);
            groups.join(of, *item);
        }
    }

    /// The wires between registers of one scope and clock.
    fn wires<'a>(&'a self, wires: &'a [Wire]) -> impl Iterator<Item = &'a Wire> {
        let kind = |item: usize| self.0.get(&item);
        wires.iter().filter(move |wire| kind(wire.from).is_some() && kind(wire.from) == kind(wire.to))
    }

    fn connected(&self, wires: &[Wire], groups: &mut Groups) {
        for wire in self.wires(wires) {
            groups.join(wire.from, wire.to);
        }
    }

    fn cycles(&self, wires: &[Wire], groups: &mut Groups) {
        let mut behind: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for wire in self.wires(wires) {
            behind.entry(wire.from).or_default().insert(wire.to);
        }
        let reached = |from: usize| {
            let (mut seen, mut next) = (BTreeSet::new(), vec![from]);
            while let Some(item) = next.pop() {
                let more = behind.get(&item).into_iter().flatten().copied();
                next.extend(more.filter(|item| seen.insert(*item)));
            }
            seen
        };
        let reached: BTreeMap<usize, BTreeSet<usize>> = behind.keys().map(|item| (*item, reached(*item))).collect();
        for (item, others) in &reached {
            let back = others.iter().filter(|other| reached.get(other).is_some_and(|it| it.contains(item)));
            back.for_each(|other| groups.join(*item, *other));
        }
    }

    /// Joins the registers of a stage in each connected part; `together` stages share a box. A cycle is in one stage.
    fn stages(&self, wires: &[Wire], together: usize, groups: &mut Groups) {
        self.cycles(wires, groups);
        let steps: BTreeSet<(usize, usize)> = self
            .wires(wires)
            .filter(|wire| wire.is_data)
            .map(|wire| (groups.of_item(wire.from), groups.of_item(wire.to)))
            .filter(|(from, to)| from != to)
            .collect();
        let mut stage: BTreeMap<usize, usize> = self.0.keys().map(|item| (groups.of_item(*item), 0)).collect();
        // Without cycles, no path is longer than the number of groups.
        for _ in 0..stage.len() {
            let before = stage.clone();
            for (from, to) in &steps {
                let after = stage[from] + 1;
                stage.entry(*to).and_modify(|it| *it = after.max(*it));
            }
            if stage == before {
                break;
            }
        }
        let mut parts = Groups((0..groups.0.len()).collect());
        self.connected(wires, &mut parts);
        let mut first = BTreeMap::new();
        let cycles = Groups(groups.0.clone());
        for item in self.0.keys() {
            let of = *first.entry((parts.of_item(*item), stage[&cycles.of_item(*item)] / together)).or_insert(*item);
            groups.join(of, *item);
        }
    }
}

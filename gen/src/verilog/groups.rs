//! The nets that share the scopes of one `generate for`: those of one shape that are connected lane by lane.
//!
//! A group comes after those that it reads, so that no name is read before it is declared. If groups read each other,
//! as a row that reads a grid that reads the row, the values read before their group are declared in a block of their
//! own.

use super::order::{for_each_read, operands_first};
use super::plan::{Form, Plan};
use std::collections::{BTreeMap, BTreeSet};
use tilewright_circuit::graph::Union;
use tilewright_circuit::ir::{Module, NodeId, Op, Shape};

/// A `generate for`.
pub struct Group {
    pub shape: Shape,
    /// Nets and constants, operands first; registers and outputs are not among them.
    pub nets: Vec<NodeId>,
    /// Nets that are read before their own position.
    pub early: BTreeSet<NodeId>,
    /// Nets that an earlier group reads.
    pub ahead: BTreeSet<NodeId>,
    pub registers: Vec<usize>,
    pub memories: Vec<usize>,
    pub instances: Vec<usize>,
    pub properties: Vec<usize>,
}

/// The groups in sequence, and the group of each node that is in one.
pub struct Groups {
    pub groups: Vec<Group>,
    home: BTreeMap<NodeId, usize>,
}

impl Groups {
    pub fn new(module: &Module, plan: &Plan, resets: &[Option<NodeId>]) -> Groups {
        let items = Items::new(module, plan, resets);
        let sets = items.sets();
        let mut groups = Groups { groups: Vec::new(), home: BTreeMap::new() };
        let position: BTreeMap<NodeId, usize> = operands_first(module).into_iter().zip(0..).collect();
        for set in items.in_order(sets) {
            groups.add(&items, &set, &position);
        }
        groups.find_ahead(&items);
        groups
    }

    /// The group that declares a node.
    pub fn home(&self, id: NodeId) -> Option<usize> {
        self.home.get(&id).copied()
    }

    fn add(&mut self, items: &Items, set: &[usize], position: &BTreeMap<NodeId, usize>) {
        let (index, module) = (self.groups.len(), items.module);
        let mut group = Group {
            shape: items.all[set[0]].shape,
            nets: Vec::new(),
            early: BTreeSet::new(),
            ahead: BTreeSet::new(),
            registers: Vec::new(),
            memories: Vec::new(),
            instances: Vec::new(),
            properties: Vec::new(),
        };
        for &item in set {
            match items.all[item].what {
                What::Net(id) => group.nets.push(id),
                What::Register(register) => group.registers.push(register),
                What::Memory(memory) => group.memories.push(memory),
                What::Instance(instance) => group.instances.push(instance),
                What::Property(property) => group.properties.push(property),
            }
            items.all[item].nodes(module).into_iter().for_each(|id| {
                self.home.insert(id, index);
            });
        }
        group.nets.sort_by_key(|id| position[id]);
        let turn: BTreeMap<NodeId, usize> = group.nets.iter().copied().zip(0..).collect();
        for &item in set {
            let What::Net(net) = items.all[item].what else { continue };
            let reads = items.reads[item].iter().flat_map(|read| items.all[read.item].net());
            group.early.extend(reads.filter(|read| turn.get(read).is_some_and(|turn_of| *turn_of >= turn[&net])));
        }
        // An asynchronous read needs its memory, not the position of a net.
        self.groups.push(group);
    }

    fn find_ahead(&mut self, items: &Items) {
        for reader in &items.all {
            let here = self.home_of(reader, items.module);
            for read in &items.reads[reader.index] {
                let there = self.home_of(&items.all[read.item], items.module);
                if there > here {
                    self.groups[there].ahead.extend(read.node);
                }
            }
        }
    }

    fn home_of(&self, item: &Item, module: &Module) -> usize {
        item.nodes(module).first().and_then(|id| self.home(*id)).or_else(|| self.of_object(item)).unwrap_or(usize::MAX)
    }

    /// The group of an object that has no node.
    fn of_object(&self, item: &Item) -> Option<usize> {
        self.groups.iter().position(|group| match item.what {
            What::Memory(memory) => group.memories.contains(&memory),
            What::Instance(instance) => group.instances.contains(&instance),
            What::Property(property) => group.properties.contains(&property),
            _ => false,
        })
    }
}

/// An object that is declared or made in a scope.
struct Item {
    index: usize,
    shape: Shape,
    what: What,
}

#[derive(Clone, Copy)]
enum What {
    Net(NodeId),
    Register(usize),
    Memory(usize),
    Instance(usize),
    Property(usize),
}

/// A read of an item.
struct Read {
    item: usize,
    node: Option<NodeId>,
    /// Whether it reads the same lane, or that of a neighbour of the same shape.
    is_beside: bool,
}

struct Items<'a> {
    module: &'a Module,
    plan: &'a Plan,
    all: Vec<Item>,
    /// The item that declares a node.
    of: BTreeMap<NodeId, usize>,
    reads: Vec<Vec<Read>>,
}

impl Item {
    /// The nodes that it declares.
    fn nodes(&self, module: &Module) -> Vec<NodeId> {
        match self.what {
            What::Net(id) => vec![id],
            What::Register(register) => vec![module.registers[register].node],
            What::Memory(memory) => {
                let reads = module.memories[memory].reads.iter();
                reads.filter(|read| read.clock.is_some()).map(|read| read.node).collect()
            }
            What::Instance(instance) => module.instances[instance].outputs.clone(),
            What::Property(_) => Vec::new(),
        }
    }

    fn net(&self) -> Option<NodeId> {
        match self.what {
            What::Net(id) => Some(id),
            _ => None,
        }
    }
}

impl<'a> Items<'a> {
    fn new(module: &'a Module, plan: &'a Plan, resets: &[Option<NodeId>]) -> Items<'a> {
        let mut items = Items { module, plan, all: Vec::new(), of: BTreeMap::new(), reads: Vec::new() };
        for id in (0..module.nodes.len() as u32).map(NodeId) {
            if matches!(plan.form(id), Form::Net | Form::Block | Form::Constants) {
                items.add(module.shape(id), What::Net(id));
            }
        }
        for (index, register) in module.registers.iter().enumerate() {
            items.add(module.shape(register.node), What::Register(index));
        }
        for (index, memory) in module.memories.iter().enumerate() {
            items.add(memory.shape, What::Memory(index));
        }
        for (index, instance) in module.instances.iter().enumerate() {
            items.add(instance.shape, What::Instance(index));
        }
        for (index, property) in module.properties.iter().enumerate() {
            items.add(module.shape(property.condition), What::Property(index));
        }
        items.reads = items.all.iter().map(|item| items.reads_of(item, resets)).collect();
        items
    }

    fn add(&mut self, shape: Shape, what: What) {
        if shape.is_plain() {
            return;
        }
        let item = Item { index: self.all.len(), shape, what };
        item.nodes(self.module).into_iter().for_each(|id| {
            self.of.insert(id, item.index);
        });
        self.all.push(item);
    }

    fn reads_of(&self, item: &Item, resets: &[Option<NodeId>]) -> Vec<Read> {
        let module = self.module;
        let mut roots: Vec<NodeId> = Vec::new();
        match item.what {
            What::Net(id) => for_each_read(module, id, |read| roots.push(read)),
            What::Register(index) => {
                let register = &module.registers[index];
                roots.extend([Some(register.next), register.enable, resets[index]].into_iter().flatten());
            }
            What::Memory(index) => {
                let memory = &module.memories[index];
                memory.reads.iter().for_each(|read| roots.extend([Some(read.address), read.enable].iter().flatten()));
                memory.writes.iter().for_each(|write| roots.extend([write.enable, write.address, write.data]));
            }
            What::Instance(index) => roots.extend(&module.instances[index].inputs),
            What::Property(index) => roots.extend(module.properties[index].nodes()),
        }
        let mut found = self.behind(item.shape, roots);
        // A word is read in the scope of its memory.
        if let What::Net(id) = item.what
            && let Op::Read(memory, _) = module.node(id).op
        {
            let memory = self.all.iter().find(|item| matches!(item.what, What::Memory(m) if m == memory.0 as usize));
            found.extend(memory.map(|memory| Read { item: memory.index, node: None, is_beside: true }));
        }
        found
    }

    /// The items that these nodes are printed with.
    fn behind(&self, shape: Shape, roots: Vec<NodeId>) -> Vec<Read> {
        let mut found = Vec::new();
        let mut seen = BTreeSet::new();
        let mut stack: Vec<(NodeId, bool)> = roots.into_iter().map(|id| (id, true)).collect();
        while let Some((id, is_beside)) = stack.pop() {
            let is_beside = is_beside && self.module.shape(id) == shape;
            if !seen.insert((id, is_beside)) {
                continue;
            }
            if let Some(&item) = self.of.get(&id) {
                found.push(Read { item, node: Some(id), is_beside });
            } else if matches!(self.plan.form(id), Form::Inline | Form::Branches) {
                for_each_read(self.module, id, |read| stack.push((read, is_beside)));
            }
        }
        found
    }

    /// The items that belong together. A reader of an instance's output is included only if it also feeds the
    /// instance.
    fn sets(&self) -> Vec<Vec<usize>> {
        let mut union = Union::new(self.all.len());
        for item in &self.all {
            for read in &self.reads[item.index] {
                let is_output = matches!(self.all[read.item].what, What::Instance(_));
                if read.is_beside && !is_output {
                    union.join(item.index, read.item);
                }
            }
        }
        union.sets(0..self.all.len())
    }

    /// The sets, each after those that it reads. Sets of one shape that read each other are merged; those of
    /// different shapes follow in the sequence of their first items.
    fn in_order(&self, sets: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
        let merged = self.merge_cycles(sets);
        let mut waiting: Vec<(Vec<usize>, BTreeSet<usize>)> = Vec::new();
        let reads = self.reads_of_sets(&merged);
        for (set, reads) in merged.into_iter().zip(reads) {
            waiting.push((set, reads));
        }
        let mut done = vec![false; waiting.len()];
        let mut out = Vec::new();
        while out.len() < waiting.len() {
            let next = (0..waiting.len()).filter(|&set| !done[set]);
            let ready = next.clone().find(|&set| waiting[set].1.iter().all(|&read| done[read] || read == set));
            // None is ready if sets of two shapes read each other.
            let set = ready.or(next.clone().min_by_key(|&set| waiting[set].0[0])).expect("some set is left");
            done[set] = true;
            out.push(std::mem::take(&mut waiting[set].0));
        }
        out
    }

    fn reads_of_sets(&self, sets: &[Vec<usize>]) -> Vec<BTreeSet<usize>> {
        let mut place = vec![0; self.all.len()];
        sets.iter().enumerate().for_each(|(index, set)| set.iter().for_each(|&item| place[item] = index));
        let reads =
            |set: &Vec<usize>| set.iter().flat_map(|&item| &self.reads[item]).map(|read| place[read.item]).collect();
        sets.iter().map(reads).collect()
    }

    fn merge_cycles(&self, mut sets: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
        loop {
            let reads = self.reads_of_sets(&sets);
            let reach: Vec<BTreeSet<usize>> = (0..sets.len()).map(|set| reachable(&reads, set)).collect();
            let shape = |set: usize| self.all[sets[set][0]].shape;
            let pair = (0..sets.len()).find_map(|a| {
                let with = |&b: &usize| b > a && shape(a) == shape(b) && reach[b].contains(&a);
                reach[a].iter().copied().find(with).map(|b| (a, b))
            });
            let Some((a, b)) = pair else { return sets };
            let other = sets.remove(b);
            sets[a].extend(other);
            sets[a].sort_unstable();
        }
    }
}

fn reachable(reads: &[BTreeSet<usize>], from: usize) -> BTreeSet<usize> {
    let mut seen = BTreeSet::new();
    let mut stack: Vec<usize> = reads[from].iter().copied().collect();
    while let Some(next) = stack.pop() {
        if seen.insert(next) {
            stack.extend(&reads[next]);
        }
    }
    seen
}

//! The sequence in which a function computes its cells, and the cells that it stores in memory.
//!
//! A function goes through *stages*. In each stage it first computes scalars, which stay in machine registers. Then
//! it packs scalars into arrays of lanes. Then it runs *kernels*, loops over the lanes of all values with one lane
//! count. An operation from lanes to scalars or to other lanes (a reduction, a neighbour, one lane) begins a new
//! stage, unless it reads state, which is in memory anyway.

pub(super) mod access;
pub(super) mod branch;
pub(super) mod clamp;
mod divide;
mod hazards;
pub(super) mod nest;
mod parts;
pub(super) mod planned;
pub(super) mod quiet;
pub(super) mod sequence;
pub(super) mod versioned;

use std::collections::{BTreeMap, BTreeSet};

use crate::engine::function::{Function, Sink};
use crate::engine::program::{Kind, Lowered, ValueId};
use versioned::Versioned;

/// The sequence of a function.
#[derive(Debug, Clone, Default)]
pub(super) struct Plan {
    pub stages: Vec<Stage>,
    /// Values used outside of the kernel that computes them, which are stored: for other kernels, neighbours and
    /// testbenches. State is not included.
    pub live_out: BTreeSet<ValueId>,
    /// Registers with lanes that are read after their kernel has run: they change at the end.
    pub hazards: BTreeSet<ValueId>,
    /// Cells of a branch, and those at whose place they are stored.
    pub homes: BTreeMap<ValueId, ValueId>,
    /// Loops that may get versions.
    pub versioned: Vec<Versioned>,
}

/// A part of a function.
#[derive(Debug, Clone, Default)]
pub(super) struct Stage {
    /// Values of one lane.
    pub single: Vec<ValueId>,
    /// Arrays of lanes collected from scalars or from other arrays.
    pub collected: Vec<ValueId>,
    /// Loops by lane count.
    pub kernels: BTreeMap<u32, Kernel>,
    /// The loops over the most lanes come first.
    pub widest_first: bool,
}

impl Stage {
    /// The loops in sequence, each with its number of lanes.
    pub fn loops(&self) -> Vec<(u32, &Kernel)> {
        let mut loops: Vec<(u32, &Kernel)> = self.kernels.iter().map(|(lanes, kernel)| (*lanes, kernel)).collect();
        if self.widest_first {
            loops.reverse();
        }
        loops
    }
}

/// A loop over lanes.
#[derive(Debug, Clone, Default)]
pub(super) struct Kernel {
    /// The cells that it computes, each after its operands.
    pub cells: Vec<ValueId>,
    /// The sinks that it executes at the end of a strip, by index in [`Function::sinks`].
    pub sinks: Vec<usize>,
    /// From the last lanes to the first.
    pub descends: bool,
    /// The kernels to run instead.
    pub switch: Option<Box<Switch>>,
    /// Loops that run instead, one after another.
    pub parts: Vec<Kernel>,
    /// Its index in [`Plan::versioned`], if it may get versions.
    pub versioned: Option<usize>,
}

impl Kernel {
    /// The number of its operations on a strip.
    pub fn operations(&self) -> usize {
        self.cells.len() + self.sinks.len()
    }

    /// Calls `visit` with each loop that runs instead of it, or with itself.
    pub fn for_each_leaf(&mut self, visit: &mut dyn FnMut(&mut Kernel)) {
        let Kernel { parts, switch, .. } = self;
        if parts.is_empty() && switch.is_none() {
            return visit(self);
        }
        let instead = parts.iter_mut().chain(switch.iter_mut().flat_map(|switch| &mut switch.kernels));
        instead.for_each(|kernel| kernel.for_each_leaf(visit));
    }
}

/// Kernels to choose from.
#[derive(Debug, Clone)]
pub(super) struct Switch {
    /// The scalar that decides.
    pub subject: ValueId,
    pub kernels: Vec<Kernel>,
    /// The kernel for each number of the subject.
    pub table: Vec<usize>,
}

/// A position within a stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Position {
    stage: usize,
    /// 0 for scalars, 1 for packing, then kernels by their lanes.
    place: u32,
}

/// The role of a cell in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Role {
    /// A constant, the same in all lanes.
    Constant,
    /// In memory from the start: state, or lanes that are all constant.
    Resident,
    Single,
    Collected,
    /// The same scalar, or row, in all lanes: no work of its own.
    Rematerialised,
    /// In the kernel with this number of lanes.
    Kernel(u32),
}

impl Role {
    fn place(self) -> u32 {
        match self {
            Role::Kernel(lanes) => lanes,
            Role::Collected => 1,
            _ => 0,
        }
    }
}

impl Plan {
    /// Plans a function; `postpone` collects the work on an array in one loop. Memories that are `far` are read in
    /// loops that do little else, so that many reads are in flight at a time.
    pub fn new(function: &Function, far: &[bool], postpone: bool) -> Plan {
        let needed = function.needed();
        let positions = vec![Position { stage: 0, place: 0 }; function.circuit().len()];
        let looked_at = looked_at(function, &needed);
        let ports = ports(function, far.len());
        let mut planner = Planner { function, far, ports, positions, looked_at, kernels: BTreeMap::new() };
        let mut plan = Plan::default();
        for &id in &needed {
            planner.positions[id.index()] = Position { stage: planner.stage(id), place: planner.role(id).place() };
        }
        if postpone {
            planner.postpone(&needed);
        }
        for &id in &needed {
            planner.place(&mut plan, id);
        }
        planner.sinks(&mut plan);
        planner.stores(&mut plan, &needed);
        hazards::find(&planner, &mut plan, &needed);
        plan
    }

    /// Adds scalars that depend on no computed value.
    pub fn singles_first(&mut self, ids: Vec<ValueId>) {
        self.at(0).single.splice(0..0, ids);
    }

    /// The cell at whose place this one is stored.
    pub fn home(&self, id: ValueId) -> ValueId {
        self.homes.get(&id).copied().unwrap_or(id)
    }

    fn at(&mut self, stage: usize) -> &mut Stage {
        if self.stages.len() <= stage {
            self.stages.resize_with(stage + 1, Stage::default);
        }
        &mut self.stages[stage]
    }
}

/// Arrays that are read otherwise than lane by lane.
fn looked_at(function: &Function, needed: &[ValueId]) -> BTreeSet<ValueId> {
    let of = needed.iter().filter_map(|&id| match function.cell(id).kind {
        Kind::Lowered(Lowered::Slide { of, .. } | Lowered::Gather { of, .. })
        | Kind::Lane { of, .. }
        | Kind::Broadcast { of, .. }
        | Kind::Pack { of, .. } => Some(of),
        _ => None,
    });
    let shown = function.sinks.iter().filter_map(|sink| match sink {
        Sink::Show(value) => Some(*value),
        _ => None,
    });
    of.chain(shown).collect()
}

/// The readers and writers of a memory.
#[derive(Debug, Clone, Default)]
struct Ports {
    reads: Vec<ValueId>,
    /// By index in [`Function::sinks`].
    writes: Vec<usize>,
}

/// The ports of this number of memories.
fn ports(function: &Function, memories: usize) -> Vec<Ports> {
    let mut ports = vec![Ports::default(); memories];
    for (id, cell) in function.circuit().cells() {
        if let Kind::Lowered(Lowered::Word { memory, .. } | Lowered::WordOf { memory, .. }) = cell.kind {
            ports[memory as usize].reads.push(id);
        }
    }
    for (index, sink) in function.sinks.iter().enumerate() {
        if let Sink::Write { memory, .. } = *sink {
            ports[memory as usize].writes.push(index);
        }
    }
    ports
}

struct Planner<'a> {
    function: &'a Function,
    /// For each memory.
    far: &'a [bool],
    ports: Vec<Ports>,
    positions: Vec<Position>,
    looked_at: BTreeSet<ValueId>,
    /// For each lane count: the stage of the kernel that does most of the work, if there is one.
    kernels: BTreeMap<u32, usize>,
}

impl Planner<'_> {
    fn role(&self, id: ValueId) -> Role {
        let cell = self.function.cell(id);
        match &cell.kind {
            Kind::Const(_) => Role::Constant,
            Kind::State => Role::Resident,
            _ if self.function.is_table(id) => Role::Resident,
            Kind::Stack { .. } | Kind::Unpack { .. } => Role::Collected,
            Kind::Broadcast { of, axis }
                if (axis.inner > 1 || self.function.cell(*of).lanes == 1) && !self.looked_at.contains(&id) =>
            {
                Role::Rematerialised
            }
            Kind::Reduce { of, .. } => Role::Kernel(self.function.cell(*of).lanes),
            Kind::Lane { .. } if cell.lanes > 1 => Role::Kernel(cell.lanes),
            _ if cell.lanes == 1 => Role::Single,
            _ => Role::Kernel(cell.lanes),
        }
    }

    /// Whether a kernel's cell takes its operand lane by lane.
    fn by_lane(&self, id: ValueId, operand: ValueId) -> bool {
        let takes_lane = match self.function.cell(id).kind {
            Kind::Lowered(Lowered::Gather { of, .. }) => operand != of,
            Kind::Lowered(Lowered::Word { .. } | Lowered::WordOf { .. }) | Kind::Reduce { .. } | Kind::Alias(_) => true,
            ref kind => kind.is_elementwise(),
        };
        takes_lane && matches!(self.role(operand), Role::Kernel(_) | Role::Collected) && !self.is_apart(operand)
    }

    /// Whether no cell uses a value with lanes in the loop that computes it.
    fn is_apart(&self, id: ValueId) -> bool {
        match self.function.cell(id).kind {
            Kind::Reduce { .. } => true,
            Kind::Lowered(Lowered::Word { memory, .. }) => {
                self.function.cell(id).lanes > 1 && self.far[memory as usize]
            }
            _ => false,
        }
    }

    /// The first stage in which all operands are available.
    fn stage(&self, id: ValueId) -> usize {
        let mut stage = 0;
        self.function.cell(id).kind.for_each_operand(|operand| {
            stage = stage.max(self.available(operand, self.by_lane(id, operand)));
        });
        stage
    }

    /// The stage from which a value is available, for a use lane by lane in its own kernel or for any other.
    fn available(&self, id: ValueId, by_lane: bool) -> usize {
        let at = self.positions[id.index()].stage;
        match self.role(id) {
            Role::Constant | Role::Resident => 0,
            Role::Single | Role::Rematerialised => at,
            Role::Collected if by_lane => at,
            Role::Kernel(_) if by_lane => at,
            Role::Collected | Role::Kernel(_) => at + 1,
        }
    }

    /// Moves cells to the last kernel of their lane count unless they are needed earlier. So one loop does the work
    /// of several, without storing the values between them.
    fn postpone(&mut self, needed: &[ValueId]) {
        let sinks: Vec<(Position, &Sink)> =
            self.function.sinks.iter().map(|sink| (self.sink_position(sink), sink)).collect();
        let kernels = needed.iter().map(|id| self.positions[id.index()]).filter(|position| position.place > 1);
        for position in kernels.chain(sinks.iter().map(|sink| sink.0).filter(|position| position.place > 1)) {
            let last = self.kernels.entry(position.place).or_default();
            *last = position.stage.max(*last);
        }
        let end = self.kernels.values().copied().max().unwrap_or(0) + 1;
        let mut limits = vec![end; self.function.circuit().len()];
        for (position, sink) in sinks {
            let mut sums = false;
            sink.for_each_operand(|operand| sums |= matches!(self.function.cell(operand).kind, Kind::Reduce { .. }));
            let before = match position.place {
                0 => end,
                _ if sums => end,
                lanes => self.kernels[&lanes],
            };
            sink.for_each_operand(|operand| {
                let limit = &mut limits[operand.index()];
                *limit = (*limit).min(before - usize::from(self.is_apart(operand)));
            });
        }
        for &id in needed.iter().rev() {
            let Position { stage, place } = self.positions[id.index()];
            let latest = limits[id.index()];
            let stage = match place {
                0 | 1 if stage == 0 => 0,
                0 | 1 => latest.max(stage),
                lanes => latest.min(self.kernels[&lanes]).max(stage),
            };
            self.positions[id.index()].stage = stage;
            self.function.cell(id).kind.for_each_operand(|operand| {
                let is_stored = matches!(self.role(operand), Role::Kernel(_) | Role::Collected);
                let after = usize::from(is_stored && !self.by_lane(id, operand));
                let limit = &mut limits[operand.index()];
                *limit = (*limit).min(stage.saturating_sub(after));
            });
        }
    }

    /// Enters a cell at its position.
    fn place(&self, plan: &mut Plan, id: ValueId) {
        let stage = self.positions[id.index()].stage;
        match self.role(id) {
            Role::Constant | Role::Resident | Role::Rematerialised => {}
            Role::Single => plan.at(stage).single.push(id),
            Role::Collected => plan.at(stage).collected.push(id),
            Role::Kernel(lanes) => plan.at(stage).kernels.entry(lanes).or_default().cells.push(id),
        }
    }

    /// The position at which a sink reads its operands: the end for scalars.
    fn sink_position(&self, sink: &Sink) -> Position {
        let lanes = sink.lanes(self.function.circuit());
        if lanes == 1 {
            return Position { stage: usize::MAX, place: 0 };
        }
        let last = self.kernels.get(&lanes).copied().unwrap_or(0);
        let stage = match *sink {
            Sink::Write { memory, .. } => self.written(memory),
            _ => self.taken(sink),
        };
        Position { stage: stage.max(last), place: lanes }
    }

    /// The first stage in which all operands of a sink are available.
    fn taken(&self, sink: &Sink) -> usize {
        let mut stage = 0;
        sink.for_each_operand(|operand| stage = stage.max(self.available(operand, !self.is_apart(operand))));
        stage
    }

    /// The first stage in which a memory has been read, and all its ports can write, one after another.
    fn written(&self, memory: u32) -> usize {
        let Ports { reads, writes } = &self.ports[memory as usize];
        let reads = reads.iter().map(|id| self.positions[id.index()].stage);
        reads.chain(writes.iter().map(|&sink| self.taken(&self.function.sinks[sink]))).max().unwrap_or(0)
    }

    fn sinks(&mut self, plan: &mut Plan) {
        for (index, sink) in self.function.sinks.iter().enumerate() {
            let position = self.sink_position(sink);
            if position.place > 0 && !matches!(sink, Sink::Show(_)) {
                plan.at(position.stage).kernels.entry(position.place).or_default().sinks.push(index);
            }
        }
    }

    /// Finds the values that must be in memory for uses elsewhere.
    fn stores(&self, plan: &mut Plan, needed: &[ValueId]) {
        let mut need = |operand: ValueId, reader: Position, by_lane: bool| {
            let stored = match self.role(operand) {
                Role::Kernel(_) => !by_lane || self.positions[operand.index()] != reader,
                Role::Collected => true,
                _ => false,
            };
            if stored {
                plan.live_out.insert(operand);
            }
        };
        for &id in needed {
            let reader = self.positions[id.index()];
            self.function.cell(id).kind.for_each_operand(|operand| need(operand, reader, self.by_lane(id, operand)));
        }
        for sink in &self.function.sinks {
            let reader = self.sink_position(sink);
            sink.for_each_operand(|operand| {
                need(operand, reader, !self.is_apart(operand));
            });
        }
        for sink in &self.function.sinks {
            if let Sink::Show(value) = sink
                && !matches!(self.role(*value), Role::Constant | Role::Resident)
            {
                plan.live_out.insert(*value);
            }
        }
    }
}

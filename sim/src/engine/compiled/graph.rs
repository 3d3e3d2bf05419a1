//! What one function of generated code computes: the cells of a program that its sinks need.

use std::collections::BTreeMap;

use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Binary, ReadUnderWrite, Reduction, Relation, Unary};

use crate::engine::program::rules::Cells;
use crate::engine::program::{Kind, Program, ValueId};

/// A value and how it comes about.
#[derive(Debug, Clone)]
pub(super) struct Cell {
    pub kind: Kind,
    pub lanes: u32,
    pub width: u32,
}

/// What a function does with what it computes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Sink {
    /// A register, or the data of a synchronous read, takes a value.
    Register {
        /// What holds it.
        state: ValueId,
        /// What it takes.
        next: ValueId,
        /// 1 bit: whether it does.
        enable: Option<ValueId>,
    },
    /// A word goes into a memory.
    Write {
        /// The memory, by index.
        memory: u32,
        /// 1 bit: whether it does.
        enable: ValueId,
        /// The address.
        address: ValueId,
        /// The word.
        data: ValueId,
    },
    /// A value is left where a testbench finds it.
    Show(ValueId),
    /// The function goes on only if this is 1.
    Hold(ValueId),
}

impl Sink {
    /// How many lanes what it takes has.
    pub fn lanes(&self, graph: &Graph) -> u32 {
        let (Sink::Register { state: id, .. } | Sink::Write { enable: id, .. } | Sink::Show(id) | Sink::Hold(id)) =
            *self;
        graph.cell(id).lanes
    }

    /// Calls `visit` with every value that the sink takes.
    pub fn for_each_operand(&self, mut visit: impl FnMut(ValueId)) {
        match *self {
            Sink::Register { next, enable, .. } => {
                visit(next);
                enable.into_iter().for_each(visit);
            }
            Sink::Write { enable, address, data, .. } => [enable, address, data].into_iter().for_each(visit),
            Sink::Show(value) | Sink::Hold(value) => visit(value),
        }
    }

    /// Calls `visit` with every value that the sink takes, which it may replace.
    pub fn rewrite(&mut self, mut visit: impl FnMut(&mut ValueId)) {
        match self {
            Sink::Register { next, enable, .. } => {
                visit(next);
                enable.iter_mut().for_each(visit);
            }
            Sink::Write { enable, address, data, .. } => [enable, address, data].into_iter().for_each(visit),
            Sink::Show(value) | Sink::Hold(value) => visit(value),
        }
    }
}

impl Cells for Graph {
    fn kind(&self, id: ValueId) -> &Kind {
        &self.cell(id).kind
    }

    fn width(&self, id: ValueId) -> u32 {
        self.cell(id).width
    }
}

/// Cells and sinks. The ids of the program's values are kept; cells of the function's own follow.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    pub cells: Vec<Cell>,
    /// Choices between constants by a small number: the array in which they stand by that number.
    pub lookups: BTreeMap<ValueId, ValueId>,
    /// Concatenations of the two parts of a value: that value, and by how much it is rotated to the left.
    pub rotations: BTreeMap<ValueId, (ValueId, u32)>,
    pub sinks: Vec<Sink>,
}

impl Graph {
    /// All cells of a program.
    pub fn new(program: &Program) -> Graph {
        let mut cells: Vec<Cell> = program
            .values
            .iter()
            .map(|value| Cell { kind: Kind::State, lanes: value.lanes, width: value.width })
            .collect();
        for (value, bits) in &program.constants {
            cells[value.index()].kind = Kind::Const(bits.clone());
        }
        for operation in &program.operations {
            cells[operation.result.index()].kind = operation.kind.clone();
        }
        Graph { cells, lookups: BTreeMap::new(), rotations: BTreeMap::new(), sinks: Vec::new() }
    }

    /// The cell of that id.
    pub fn cell(&self, id: ValueId) -> &Cell {
        &self.cells[id.index()]
    }

    /// A cell of the function's own.
    pub fn add(&mut self, kind: Kind, lanes: u32, width: u32) -> ValueId {
        self.cells.push(Cell { kind, lanes, width });
        ValueId(self.cells.len() as u32 - 1)
    }

    /// An edge of these clocks, but for resets.
    pub fn edge(program: &Program, rising: &[usize]) -> Graph {
        let mut graph = Graph::new(program);
        for &clock in rising {
            for &index in &program.clocks[clock].registers {
                let register = &program.registers[index as usize];
                let sink = Sink::Register { state: register.value, next: register.next, enable: register.enable };
                graph.sinks.push(sink);
            }
            for &(memory, port) in &program.clocks[clock].reads {
                let sink = graph.synchronous_read(program, memory, port, rising);
                graph.sinks.push(sink);
            }
        }
        for &clock in rising {
            for &(memory, port) in &program.clocks[clock].writes {
                let write = &program.memories[memory as usize].writes[port as usize];
                let (enable, address, data) = (write.enable, write.address, write.data);
                graph.sinks.push(Sink::Write { memory, enable, address, data });
            }
        }
        graph
    }

    /// What must hold at an edge of these clocks, but for those in reset; `None` if there is nothing.
    pub fn check(program: &Program, rising: &[usize], resets: &[bool]) -> Option<Graph> {
        let mut graph = Graph::new(program);
        let clocks = rising.iter().filter(|&&clock| !resets[clock]);
        let asserts = clocks.flat_map(|&clock| &program.clocks[clock].asserts);
        let mut all = None;
        for &assert in asserts {
            let mut condition = program.asserts[assert as usize].condition;
            let group = graph.cell(condition).lanes;
            if group > 1 {
                condition = graph.add(Kind::Reduce { by: Reduction::And, of: condition, group }, 1, 1);
            }
            all = Some(match all {
                None => condition,
                Some(before) => graph.add(Kind::Binary(Binary::And, before, condition), 1, 1),
            });
        }
        graph.sinks.push(Sink::Hold(all?));
        Some(graph)
    }

    /// A synchronous read is a register that takes the word; where its word is written at the same edge and the
    /// policy is `Any`, the word inverted.
    fn synchronous_read(&mut self, program: &Program, memory: u32, port: u32, rising: &[usize]) -> Sink {
        let declared = &program.memories[memory as usize];
        let read = &declared.reads[port as usize];
        let (lanes, width) = (declared.lanes, declared.width);
        let mut next = self.add(Kind::Read { memory, address: read.address }, lanes, width);
        if declared.policy == ReadUnderWrite::Any {
            let hits = declared.writes.iter().filter(|write| rising.contains(&(write.clock as usize)));
            let hits: Vec<ValueId> = hits
                .map(|write| {
                    let same = self.add(Kind::Compare(Relation::Eq, false, write.address, read.address), lanes, 1);
                    self.add(Kind::Binary(Binary::And, same, write.enable), lanes, 1)
                })
                .collect();
            if let Some(hit) =
                hits.into_iter().reduce(|all, hit| self.add(Kind::Binary(Binary::Or, all, hit), lanes, 1))
            {
                let inside = self.within(read.address, declared.depth, lanes);
                let select = self.add(Kind::Binary(Binary::And, hit, inside), lanes, 1);
                let inverted = self.add(Kind::Unary(Unary::Not, next), lanes, width);
                next = self.add(Kind::Mux { select, on_true: inverted, on_false: next }, lanes, width);
            }
        }
        Sink::Register { state: read.value, next, enable: read.enable }
    }

    /// 1 bit: whether an address is within the depth.
    fn within(&mut self, address: ValueId, depth: u32, lanes: u32) -> ValueId {
        let width = self.cell(address).width;
        if width < 32 && depth >> width > 0 {
            return self.add(Kind::Const(Bits::from_limbs(1, &[1])), lanes, 1);
        }
        let mut limbs = vec![0; tilewright_hdl::limbs_for(width)];
        limbs[0] = u64::from(depth);
        let depth = self.add(Kind::Const(Bits::from_limbs(width, &limbs)), lanes, width);
        self.add(Kind::Compare(Relation::Lt, false, address, depth), lanes, 1)
    }

    /// Calls `visit` with all that a cell is computed from.
    pub fn for_each_operand(&self, id: ValueId, mut visit: impl FnMut(ValueId)) {
        match (self.rotations.get(&id), self.lookups.get(&id), &self.cell(id).kind) {
            (Some((of, _)), ..) => visit(*of),
            (_, Some(table), Kind::Case { subject, .. }) => [*subject, *table].into_iter().for_each(visit),
            (.., kind) => kind.for_each_operand(visit),
        }
    }

    /// The cells that the sinks need, each after its operands.
    pub fn needed(&self) -> Vec<ValueId> {
        let mut seen = vec![false; self.cells.len()];
        let mut order = Vec::new();
        let mut open: Vec<(ValueId, bool)> = Vec::new();
        for sink in &self.sinks {
            sink.for_each_operand(|operand| open.push((operand, false)));
            while let Some((id, done)) = open.pop() {
                if done {
                    order.push(id);
                } else if !std::mem::replace(&mut seen[id.index()], true) {
                    open.push((id, true));
                    self.for_each_operand(id, |operand| open.push((operand, false)));
                }
            }
        }
        order
    }
}

//! The computation of one function of generated code: the values of a program that its sinks need.

pub(super) mod demands;
pub(super) mod lower;
pub(super) mod split;

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;
use tilewright_circuit::ir::{Binary, ReadUnderWrite, Reduction, Relation, Unary};
use tilewright_circuit::{Bits, limbs_for};

use crate::engine::LINE;
use crate::engine::program::{Axis, Cell, Circuit, Kind, Program, Register, ValueId};
use crate::engine::rewrite::{Rewriter, rebuild};

/// An effect of a function.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Sink {
    /// A register, or the data of a synchronous read, takes a value.
    Register {
        /// The state.
        state: ValueId,
        /// The new value.
        next: ValueId,
        /// 1 bit: the enable.
        enable: Option<ValueId>,
    },
    /// A word is written to a memory.
    Write {
        /// The memory, by index.
        memory: u32,
        /// 1 bit: the enable.
        enable: ValueId,
        /// The address.
        address: ValueId,
        /// The word.
        data: ValueId,
    },
    /// A value is stored for a testbench.
    Show(ValueId),
    /// The function continues only if this is 1.
    ContinueIf(ValueId),
    /// A value of one lane is stored in a row, as its limbs.
    Row {
        /// The address of the row.
        row: ValueId,
        /// Its first limb in the row.
        at: usize,
        /// The value.
        value: ValueId,
    },
}

impl Sink {
    /// The number of lanes of its operands.
    pub fn lanes(&self, circuit: &Circuit) -> u32 {
        let (Sink::Register { state: id, .. }
        | Sink::Write { enable: id, .. }
        | Sink::Show(id)
        | Sink::ContinueIf(id)
        | Sink::Row { value: id, .. }) = *self;
        circuit[id].lanes
    }

    /// Calls `visit` with every operand of the sink.
    pub fn for_each_operand(&self, mut visit: impl FnMut(ValueId)) {
        match *self {
            Sink::Register { next, enable, .. } => {
                visit(next);
                enable.into_iter().for_each(visit);
            }
            Sink::Write { enable, address, data, .. } => [enable, address, data].into_iter().for_each(visit),
            Sink::Show(value) | Sink::ContinueIf(value) => visit(value),
            Sink::Row { row, value, .. } => [row, value].into_iter().for_each(visit),
        }
    }

    /// Calls `visit` with every operand of the sink, which it may replace.
    pub fn rewrite(&mut self, mut visit: impl FnMut(&mut ValueId)) {
        match self {
            Sink::Register { next, enable, .. } => {
                visit(next);
                enable.iter_mut().for_each(visit);
            }
            Sink::Write { enable, address, data, .. } => [enable, address, data].into_iter().for_each(visit),
            Sink::Show(value) | Sink::ContinueIf(value) => visit(value),
            Sink::Row { row, value, .. } => [row, value].into_iter().for_each(visit),
        }
    }
}

/// The values of a circuit in another one that is made from it.
pub(super) type Became = FxHashMap<ValueId, ValueId>;

/// Known state of a program while a function runs.
pub(super) type Held = Vec<(ValueId, Bits)>;

/// A circuit and its sinks. State comes first, in the sequence of the program.
#[derive(Debug, Clone)]
pub(super) struct Function {
    pub rewriter: Rewriter,
    pub sinks: Vec<Sink>,
}

impl Function {
    /// The circuit.
    pub fn circuit(&self) -> &Circuit {
        self.rewriter.circuit()
    }

    /// The cell with this id.
    pub fn cell(&self, id: ValueId) -> &Cell {
        &self.rewriter.circuit()[id]
    }

    /// Whether a cell is an array whose lanes are constants.
    pub fn is_table(&self, id: ValueId) -> bool {
        match &self.cell(id).kind {
            Kind::Stack { parts, .. } => parts.iter().all(|part| self.circuit().constant(*part).is_some()),
            _ => false,
        }
    }

    /// Whether another function does the same in the same way.
    pub fn is_same(&self, other: &Function) -> bool {
        let (cells, others) = (self.circuit().cells(), other.circuit().cells());
        self.circuit().len() == other.circuit().len() && self.sinks == other.sinks && cells.eq(others)
    }

    /// The values that the sinks need, each after its operands.
    pub fn needed(&self) -> Vec<ValueId> {
        let mut roots = Vec::new();
        self.sinks.iter().for_each(|sink| sink.for_each_operand(|operand| roots.push(operand)));
        self.circuit().needed(roots)
    }

    /// The function without sinks that never happen.
    pub fn happening(self) -> Function {
        let Function { rewriter, sinks } = self;
        let sinks = sinks.into_iter().filter_map(|sink| happening(rewriter.circuit(), sink)).collect();
        Function { rewriter, sinks }
    }

    /// The function with every needed operation made anew by `make`.
    pub fn rebuild(&self, rewriter: Rewriter, make: impl FnMut(&mut Rewriter, Cell) -> ValueId) -> (Function, Became) {
        let mut rewriter = rewriter;
        let mut became = state(self.circuit(), &mut rewriter);
        let mut sinks = self.sinks.clone();
        rebuild(self.circuit(), self.needed(), &mut became, &mut rewriter, make);
        sinks.iter_mut().for_each(|sink| sink.rewrite(|operand| *operand = became[operand]));
        (Function { rewriter, sinks }, became)
    }
}

/// Adds the state of another circuit to a new one, in which it comes first.
pub(super) fn state(circuit: &Circuit, rewriter: &mut Rewriter) -> Became {
    let state = circuit.cells().filter(|(_, cell)| cell.kind == Kind::State);
    state.map(|(id, cell)| (id, rewriter.state(cell.lanes, cell.width))).collect()
}

/// Makes functions of a program.
pub(super) struct Maker<'a> {
    program: &'a Program,
    /// The values of the program in the function.
    became: Became,
    function: Function,
}

impl<'a> Maker<'a> {
    /// An empty function. Its own state comes first, before any value is taken.
    pub fn new(program: &'a Program) -> Maker<'a> {
        let mut rewriter = Rewriter::new(&program.passes);
        let became = state(&program.circuit, &mut rewriter);
        Maker { program, became, function: Function { rewriter, sinks: Vec::new() } }
    }

    /// Declares that these values have been computed before, and are state.
    pub fn give(mut self, values: &[ValueId]) -> Self {
        for &id in values {
            let Cell { lanes, width, .. } = self.program.circuit[id];
            self.became.insert(id, self.function.rewriter.state(lanes, width));
        }
        self
    }

    /// State of the function's own, of one lane.
    pub fn state(&mut self, width: u32) -> ValueId {
        self.function.rewriter.state(1, width)
    }

    /// State of the function's own, one for each of these values, with the same shape.
    pub fn own(&mut self, values: &[ValueId]) -> Vec<ValueId> {
        let circuit = &self.program.circuit;
        values.iter().map(|&id| self.function.rewriter.state(circuit[id].lanes, circuit[id].width)).collect()
    }

    /// Stores values in state of its own.
    pub fn leave(&mut self, values: &[ValueId], own: &[ValueId]) {
        for (&id, &state) in values.iter().zip(own) {
            let next = self.take(id);
            self.function.sinks.push(Sink::Register { state, next, enable: None });
        }
    }

    /// Adds an effect.
    pub fn add_sink(&mut self, sink: Sink) {
        self.function.sinks.push(sink);
    }

    /// The kind of a value of the function.
    pub fn kind(&self, id: ValueId) -> &Kind {
        &self.function.cell(id).kind
    }

    /// The number of lanes of a value of the function.
    pub fn lanes(&self, id: ValueId) -> u32 {
        self.function.cell(id).lanes
    }

    /// Declares that these values are known.
    pub fn hold(mut self, held: &Held) -> Self {
        for &(id, ref bits) in held {
            let constant = self.function.rewriter.constant(bits.clone(), self.program.circuit[id].lanes);
            self.became.insert(id, constant);
        }
        self
    }

    /// The function continues only if this is 1.
    pub fn go_on_if(&mut self, flag: ValueId) {
        self.function.sinks.push(Sink::ContinueIf(flag));
    }

    /// A value of the program.
    pub fn take(&mut self, id: ValueId) -> ValueId {
        let (circuit, rewriter) = (&self.program.circuit, &mut self.function.rewriter);
        rebuild(circuit, [id], &mut self.became, rewriter, Rewriter::number);
        self.became[&id]
    }

    /// A value of the function's own.
    pub fn add(&mut self, kind: Kind, lanes: u32, width: u32) -> ValueId {
        self.function.rewriter.add(kind, lanes, width)
    }

    /// The function, without sinks that never happen, and the values of the program in it.
    pub fn finish(self) -> (Function, Became) {
        (self.function.happening(), self.became)
    }

    /// Stores values for a testbench.
    pub fn show(&mut self, values: &[ValueId]) {
        for &id in values {
            let shown = self.take(id);
            self.function.sinks.push(Sink::Show(shown));
        }
    }

    /// Stores values of one lane in a row before anything changes, and advances to the next row. `row` has its
    /// address.
    pub fn rows(&mut self, row: ValueId, values: &[ValueId]) {
        let mut limbs = 0;
        for &id in values {
            let value = self.take(id);
            self.function.sinks.push(Sink::Row { row, at: limbs, value });
            limbs += limbs_for(self.program.circuit[id].width);
        }
        let limbs = limbs.next_multiple_of(LINE);
        let size = self.function.rewriter.constant(Bits::new(64, 8 * limbs as u64), 1);
        let next = self.add(Kind::Binary(Binary::Add, row, size), 1, 64);
        self.function.sinks.push(Sink::Register { state: row, next, enable: None });
    }

    /// An edge of these clocks, without resets.
    pub fn edge(mut self, rising: &[usize]) -> (Function, Became) {
        let program = self.program;
        for &clock in rising {
            self.registers(program.clocks[clock].registers.iter().map(|&index| &program.registers[index as usize]));
            for &(memory, port) in &program.clocks[clock].reads {
                let sink = self.synchronous_read(memory, port, rising);
                self.function.sinks.push(sink);
            }
        }
        for &clock in rising {
            for &(memory, port) in &program.clocks[clock].writes {
                let write = &program.memories[memory as usize].writes[port as usize];
                let [enable, address, data] = [write.enable, write.address, write.data].map(|id| self.take(id));
                self.function.sinks.push(Sink::Write { memory, enable, address, data });
            }
        }
        self.finish()
    }

    /// An edge for these registers only.
    pub fn registers<'r>(&mut self, registers: impl IntoIterator<Item = &'r Register>) {
        for register in registers {
            let (next, enable) = (self.take(register.next), register.enable.map(|enable| self.take(enable)));
            let state = self.became[&register.value];
            self.function.sinks.push(Sink::Register { state, next, enable });
        }
    }

    /// The assertions at an edge of these clocks, except for those in reset; `None` if there are none.
    pub fn check(mut self, rising: &[usize], resets: &[bool]) -> Option<Function> {
        let clocks = rising.iter().filter(|&&clock| !resets[clock]);
        let asserts = clocks.flat_map(|&clock| &self.program.clocks[clock].asserts);
        let conditions: Vec<ValueId> =
            asserts.map(|&assert| self.take(self.program.asserts[assert as usize].condition)).collect();
        if !self.go_on_if_all(&conditions) {
            return None;
        }
        Some(self.finish().0)
    }

    /// The function continues only if these 1-bit values of its own are 1 in all lanes; returns whether there are
    /// any.
    pub fn go_on_if_all(&mut self, conditions: &[ValueId]) -> bool {
        let mut all = None;
        for of in self.by_lanes(conditions) {
            let axis = Axis::last(self.lanes(of));
            let condition = self.add(Kind::Reduce { by: Reduction::And, of, axis }, 1, 1);
            all = Some(self.and(all, condition));
        }
        all.map(|all| self.go_on_if(all)).is_some()
    }

    /// Values that are all 1 where these are. Those with equal numbers of lanes are combined, except for words and
    /// scalars, and except for those of units, each of which checks its own.
    fn by_lanes(&mut self, conditions: &[ValueId]) -> Vec<ValueId> {
        if self.program.registers.iter().any(|register| register.unit.is_some()) {
            return conditions.to_vec();
        }
        let (mut all, mut others) = (BTreeMap::new(), Vec::new());
        for &id in conditions {
            if matches!(self.kind(id), Kind::Unpack { .. } | Kind::Broadcast { .. }) {
                others.push(id);
            } else {
                let lanes = self.lanes(id);
                let both = self.and(all.get(&lanes).copied(), id);
                all.insert(lanes, both);
            }
        }
        all.into_values().chain(others).collect()
    }

    /// Both conditions, lane by lane; `before` may be absent.
    fn and(&mut self, before: Option<ValueId>, id: ValueId) -> ValueId {
        let Some(before) = before else { return id };
        let lanes = self.lanes(id);
        self.add(Kind::Binary(Binary::And, before, id), lanes, 1)
    }

    /// A synchronous read is a register that takes the word; if its word is written at the same edge and the policy
    /// is `Any`, it takes the word inverted.
    fn synchronous_read(&mut self, memory: u32, port: u32, rising: &[usize]) -> Sink {
        let declared = &self.program.memories[memory as usize];
        let read = &declared.reads[port as usize];
        let (lanes, width) = (declared.lanes, declared.width);
        let (address, enable) = (self.take(read.address), read.enable.map(|enable| self.take(enable)));
        let mut next = self.add(Kind::Read { memory, address }, lanes, width);
        if declared.policy == ReadUnderWrite::Any {
            let hits = declared.writes.iter().filter(|write| rising.contains(&(write.clock as usize)));
            let hits: Vec<ValueId> = hits
                .map(|write| {
                    let [written, enable] = [write.address, write.enable].map(|id| self.take(id));
                    let same = self.add(Kind::Compare(Relation::Eq, false, written, address), lanes, 1);
                    self.add(Kind::Binary(Binary::And, same, enable), lanes, 1)
                })
                .collect();
            if let Some(hit) =
                hits.into_iter().reduce(|all, hit| self.add(Kind::Binary(Binary::Or, all, hit), lanes, 1))
            {
                let inside = self.function.rewriter.below(address, declared.depth);
                let select = self.add(Kind::Binary(Binary::And, hit, inside), lanes, 1);
                let inverted = self.add(Kind::Unary(Unary::Not, next), lanes, width);
                next = self.add(Kind::Mux { select, on_true: inverted, on_false: next }, lanes, width);
            }
        }
        Sink::Register { state: self.became[&read.value], next, enable }
    }
}

/// A sink, unless it never has an effect.
pub(super) fn happening(circuit: &Circuit, sink: Sink) -> Option<Sink> {
    match sink {
        Sink::Write { enable, .. } if circuit.known(enable) == Some(false) => None,
        Sink::Register { state, next, .. } if next == state => None,
        Sink::Register { state, next, enable: Some(enable) } => match circuit.known(enable) {
            Some(true) => Some(Sink::Register { state, next, enable: None }),
            Some(false) => None,
            None => Some(sink),
        },
        _ => Some(sink),
    }
}

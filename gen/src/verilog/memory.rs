//! Memories, in templates from which Yosys infers block RAM on iCE40, ECP5 and Xilinx parts.
//!
//! A read beyond the depth gives zero. If an address can go that far, the raw word and a flag are registered, and the
//! data is gated after them: the array itself keeps the form that block RAM needs.

use super::group::block;
use super::layout::{generate, range, with_place};
use super::literal::{Style, literal};
use super::printer::Printer;
use super::statement::Statement;
use super::text::{attribute, mark};
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{ClockId, Memory, MemoryId, NodeId, Op, ReadUnderWrite};

impl Printer<'_> {
    /// The arrays without lanes, and the data registers of their synchronous ports.
    pub fn memory_declarations(&mut self) -> Vec<String> {
        let plain = self.plain_memories();
        plain.into_iter().flat_map(|id| self.memory_declaration(id)).collect()
    }

    fn plain_memories(&self) -> Vec<MemoryId> {
        let memories = (0..).map(MemoryId).zip(&self.module.memories);
        memories.filter(|(_, memory)| memory.shape.is_plain()).map(|(id, _)| id).collect()
    }

    /// An array, and the data registers of its synchronous ports.
    pub fn memory_declaration(&mut self, id: MemoryId) -> Vec<String> {
        let module = self.module;
        let mut out = Vec::new();
        let (index, memory) = (id.0 as usize, &module.memories[id.0 as usize]);
        if memory.policy == ReadUnderWrite::Any {
            out.push("(* no_rw_check *)".to_string());
        }
        if !memory.attributes.is_empty() {
            out.push(mark(memory.attributes.iter().map(attribute).collect()).trim_end().to_string());
        }
        let many_clocks = memory.writes.windows(2).any(|pair| pair[0].clock != pair[1].clock);
        if many_clocks {
            out.push("/* verilator lint_off MULTIDRIVEN */ // written by two clocks".to_string());
        }
        let range = range(memory.width);
        let declaration = format!("reg {range}{} [0:{}];", memory.name, memory.depth - 1);
        out.push(with_place(declaration, memory.loc));
        if many_clocks {
            out.push("/* verilator lint_on MULTIDRIVEN */".to_string());
        }
        for (names, read) in self.reads[index].iter().zip(&memory.reads) {
            let Some(names) = names else { continue };
            // The port declares an output of the same name.
            let is_port = self.is_port(read.node);
            match &names.raw {
                None if is_port => {}
                None => out.push(with_place(format!("reg {range}{};", names.data), module.node(read.node).loc)),
                Some(raw) => {
                    let zero = literal(&Bits::zero(memory.width), Style::Count);
                    out.push(format!("reg {range}{};", raw.word));
                    out.push(format!("reg {};", raw.inside));
                    let net = if is_port { "assign ".to_string() } else { format!("wire {range}") };
                    out.push(format!("{net}{} = {} ? {} : {zero};", names.data, raw.inside, raw.word));
                }
            }
        }
        out
    }

    /// The always blocks of the memories without lanes.
    pub fn memory_ports(&mut self) -> Vec<String> {
        let plain = self.plain_memories();
        plain.into_iter().flat_map(|id| self.memory_blocks(id)).collect()
    }

    /// The always blocks of a memory, one for each clock.
    pub fn memory_blocks(&mut self, id: MemoryId) -> Vec<String> {
        let mut out = Vec::new();
        let memory = &self.module.memories[id.0 as usize];
        let reads = memory.reads.iter().filter_map(|read| read.clock);
        let mut clocks: Vec<ClockId> = memory.writes.iter().map(|write| write.clock).chain(reads).collect();
        clocks.sort();
        clocks.dedup();
        for clock in clocks {
            let body = self.memory_block(id, clock);
            if !body.is_empty() {
                out.extend(self.always_at(clock, &body));
            }
            out.extend(self.masked_block(id, clock));
        }
        out
    }

    /// The number of lanes of a word that an enable masks; 1 if it is for the whole word.
    fn mask_lanes(&self, enable: Option<NodeId>) -> u32 {
        enable.map_or(1, |enable| self.module.width(enable))
    }

    /// Whether writes on a clock have masks: then each lane of the words has an always block with all writes, in
    /// which the last one wins.
    fn has_masks(&self, memory: &Memory, clock: ClockId) -> bool {
        let writes = memory.writes.iter().filter(|write| write.clock == clock);
        writes.into_iter().any(|write| self.mask_lanes(Some(write.enable)) > 1)
    }

    /// The always blocks of the lanes of wide words, for the ports of a clock whose enables are masks.
    fn masked_block(&mut self, id: MemoryId, clock: ClockId) -> Vec<String> {
        let module = self.module;
        let memory = &module.memories[id.0 as usize];
        let reads: Vec<usize> = (0..memory.reads.len())
            .filter(|&port| memory.reads[port].clock == Some(clock) && self.mask_lanes(memory.reads[port].enable) > 1)
            .collect();
        let writes: Vec<_> = memory.writes.iter().filter(|write| write.clock == clock).collect();
        let writes = if self.has_masks(memory, clock) { writes } else { Vec::new() };
        let enables =
            writes.iter().map(|write| Some(write.enable)).chain(reads.iter().map(|&read| memory.reads[read].enable));
        let lanes = enables.map(|enable| self.mask_lanes(enable)).max().unwrap_or(1);
        if lanes == 1 {
            return Vec::new();
        }
        let [outer, inner] = loops(lanes);
        let i = match inner {
            1 => self.loop_variable(0),
            _ => format!("{} * {inner} + {}", self.loop_variable(0), self.loop_variable(1)),
        };
        let lane = match memory.width / lanes {
            1 => format!("[{i}]"),
            width if inner == 1 => format!("[{i} * {width} +: {width}]"),
            width => format!("[({i}) * {width} +: {width}]"),
        };
        let mut body = Vec::new();
        for write in writes {
            let (address, data) = (self.value(write.address), self.value(write.data));
            let assign = Statement::Assign(format!("{}[{address}]{lane} <= {data}{lane};", memory.name));
            body.extend(self.when_lane(write.enable, &i, assign));
        }
        for port in reads {
            let read = &memory.reads[port];
            let names = self.reads[id.0 as usize][port].clone().expect("a synchronous port has a register");
            let word = self.word(memory, read.address);
            let assign = Statement::Assign(format!("{}{lane} <= {word}{lane};", names.data));
            body.extend(self.when_lane(read.enable.expect("a mask"), &i, assign));
        }
        let mut always = self.always_at(clock, &body);
        always.pop();
        if inner > 1 {
            let label = self.label(&format!("{}_part", memory.name));
            always = block(format!("{} begin : {label}", self.for_lanes(1, inner)), always);
        }
        let label = self.label(&format!("{}_lane", memory.name));
        let mut out = generate(format!("{} begin : {label}", self.for_lanes(0, outer)), always);
        out.push(String::new());
        out
    }

    /// The statement under the enable, or under the lane's bit of it.
    fn when_lane(&mut self, enable: NodeId, i: &str, assign: Statement) -> Vec<Statement> {
        match self.module.width(enable) {
            1 => self.when(Some(enable), vec![assign]),
            _ => vec![Statement::If(vec![(format!("{}[{i}]", self.value(enable)), vec![assign])], Vec::new())],
        }
    }

    fn memory_block(&mut self, id: MemoryId, clock: ClockId) -> Vec<Statement> {
        let module = self.module;
        let memory = &module.memories[id.0 as usize];
        let mut body = Vec::new();
        let is_masked = self.has_masks(memory, clock);
        for write in memory.writes.iter().filter(|write| write.clock == clock && !is_masked) {
            let assign = format!("{}[{}] <= {};", memory.name, self.value(write.address), self.value(write.data));
            body.extend(self.when(Some(write.enable), vec![Statement::Assign(assign)]));
        }
        for (port, read) in memory.reads.iter().enumerate().filter(|(_, read)| read.clock == Some(clock)) {
            if self.mask_lanes(read.enable) > 1 {
                continue;
            }
            let names = self.reads[id.0 as usize][port].clone().expect("a synchronous port has a register");
            let assign = |name: &str, value: String| Statement::Assign(format!("{name} <= {value};"));
            let assigns = match (names.raw, self.is_never(read.enable)) {
                (None, true) => vec![assign(&names.data, names.data.clone())],
                (Some(raw), true) => {
                    vec![assign(&raw.word, raw.word.clone()), assign(&raw.inside, raw.inside.clone())]
                }
                (None, false) => vec![assign(&names.data, self.word(memory, read.address))],
                (Some(raw), false) => {
                    let word = self.word(memory, read.address);
                    vec![assign(&raw.word, word), assign(&raw.inside, self.inside(memory, read.address))]
                }
            };
            if self.is_never(read.enable) {
                body.extend(assigns);
                continue;
            }
            body.extend(self.when(read.enable, assigns));
        }
        body
    }

    /// Whether an enable is always low; a port so disabled keeps its data.
    fn is_never(&self, enable: Option<NodeId>) -> bool {
        enable.is_some_and(|id| matches!(&self.module.node(id).op, Op::Const(value) if value.is_zero()))
    }

    fn when(&mut self, enable: Option<NodeId>, body: Vec<Statement>) -> Vec<Statement> {
        match enable {
            Some(enable) if !matches!(&self.module.node(enable).op, Op::Const(value) if !value.is_zero()) => {
                vec![Statement::If(vec![(self.value(enable), body)], Vec::new())]
            }
            _ => body,
        }
    }
}

/// The turns of a loop over this many lanes, and those of one within it. Tools end a loop that seems to have no end:
/// Verilator 5.006 takes 3072 turns.
fn loops(lanes: u32) -> [u32; 2] {
    const MOST: u32 = 1024;
    let is_square = |outer: &u32| lanes.is_multiple_of(*outer) && outer * outer >= lanes;
    match (2..=MOST).find(is_square) {
        Some(outer) if lanes > MOST => [outer, lanes / outer],
        _ => [lanes, 1],
    }
}

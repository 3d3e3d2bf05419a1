//! Memories, by templates from which Yosys infers block RAM on iCE40, ECP5 and Xilinx parts.
//!
//! A read beyond the depth gives zero. Where an address can go that far, the raw word and a flag are registered, and
//! the data is gated behind them: the array itself keeps the shape that block RAM needs.

use super::layout::{range, with_place};
use super::literal::{Style, literal};
use super::printer::Printer;
use super::statement::Statement;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{ClockId, MemoryId, NodeId, Op, ReadUnderWrite};

impl Printer<'_> {
    /// The arrays and the registers that their synchronous ports read into.
    pub fn memory_declarations(&mut self) -> Vec<String> {
        let module = self.module;
        let mut out = Vec::new();
        for (index, memory) in module.memories.iter().enumerate() {
            if memory.policy == ReadUnderWrite::Any {
                out.push("(* no_rw_check *)".to_string());
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
            for names in self.reads[index].iter().flatten() {
                match &names.raw {
                    None => out.push(format!("reg {range}{};", names.data)),
                    Some(raw) => {
                        let zero = literal(&Bits::zero(memory.width), Style::Count);
                        out.push(format!("reg {range}{};", raw.word));
                        out.push(format!("reg {};", raw.inside));
                        out.push(format!("wire {range}{} = {} ? {} : {zero};", names.data, raw.inside, raw.word));
                    }
                }
            }
        }
        out
    }

    /// The always blocks: one for each memory and clock.
    pub fn memory_ports(&mut self) -> Vec<String> {
        let module = self.module;
        let mut out = Vec::new();
        for (index, memory) in module.memories.iter().enumerate() {
            let reads = memory.reads.iter().filter_map(|read| read.clock);
            let mut clocks: Vec<ClockId> = memory.writes.iter().map(|write| write.clock).chain(reads).collect();
            clocks.sort();
            clocks.dedup();
            for clock in clocks {
                let body = self.memory_block(MemoryId(index as u32), clock);
                out.extend(self.always_at(clock, &body));
            }
        }
        out
    }

    fn memory_block(&mut self, id: MemoryId, clock: ClockId) -> Vec<Statement> {
        let module = self.module;
        let memory = &module.memories[id.0 as usize];
        let mut body = Vec::new();
        for write in memory.writes.iter().filter(|write| write.clock == clock) {
            let assign = format!("{}[{}] <= {};", memory.name, self.value(write.address), self.value(write.data));
            body.extend(self.when(Some(write.enable), vec![Statement::Assign(assign)]));
        }
        for (port, read) in memory.reads.iter().enumerate().filter(|(_, read)| read.clock == Some(clock)) {
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

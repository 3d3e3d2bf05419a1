//! Memories, by templates from which Yosys infers block RAM on iCE40, ECP5 and Xilinx parts.
//!
//! A read beyond the depth gives zero. Where an address can go that far, the raw word and a flag are registered, and
//! the data is gated behind them: the array itself keeps the shape that block RAM needs.

use super::expression::Printer;
use super::layout::{range, with_place};
use super::literal::{Style, literal};
use super::names::Taken;
use super::statement::Statement;
use crate::VerilogFile;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{ClockId, Contents, Memory, MemoryId, Module, NodeId, Op, ReadUnderWrite};

/// More words than this are loaded from a file.
const MOST_INLINE_WORDS: usize = 1024;

/// What a synchronous read port is called.
#[derive(Debug, Clone)]
pub struct ReadNames {
    /// The data: a register, or a net where the word is gated.
    pub data: String,
    /// The registers behind the data, where the address can exceed the depth.
    pub raw: Option<RawRead>,
}

/// The registers of a read whose address can exceed the depth.
#[derive(Debug, Clone)]
pub struct RawRead {
    /// What the array gave.
    pub word: String,
    /// Whether the address was inside.
    pub inside: String,
}

/// The name of the file that a memory is loaded from.
fn data_file(module: &Module, memory: &Memory) -> String {
    format!("{}_{}.hex", module.name, memory.name)
}

/// The files that the memories of a module are loaded from.
pub fn data_files(module: &Module) -> Vec<VerilogFile> {
    let loaded =
        |memory: &&Memory| matches!(&memory.contents, Contents::Words(words) if words.len() > MOST_INLINE_WORDS);
    let file = |memory: &Memory| {
        let Contents::Words(words) = &memory.contents else { unreachable!("a loaded memory has words") };
        let zero = Bits::zero(memory.width);
        let word = |address: usize| format!("{:x}\n", words.get(address).unwrap_or(&zero));
        VerilogFile { name: data_file(module, memory), text: (0..memory.depth as usize).map(word).collect() }
    };
    module.memories.iter().filter(loaded).map(file).collect()
}

impl Printer<'_> {
    /// `address < depth`.
    fn inside(&mut self, memory: &Memory, address: NodeId) -> String {
        let depth = literal(&Bits::new(self.module.width(address), u64::from(memory.depth)), Style::Count);
        format!("{} < {depth}", self.operand(address, Style::Count))
    }

    /// The word at an address, which is zero at a constant address beyond the depth.
    fn word(&mut self, memory: &Memory, address: NodeId) -> String {
        match constant_address(self.module, address) {
            Some(address) if address >= u64::from(memory.depth) => literal(&Bits::zero(memory.width), Style::Count),
            _ => {
                self.memories_read.insert(memory.name.clone());
                format!("{}[{}]", memory.name, self.value(address))
            }
        }
    }

    /// The word of an asynchronous port, zero beyond the depth.
    pub fn asynchronous_read(&mut self, memory: MemoryId, port: u32) -> String {
        let module = self.module;
        let memory = &module.memories[memory.0 as usize];
        let address = memory.reads[port as usize].address;
        let word = self.word(memory, address);
        if !can_exceed(module, memory, address) {
            return word;
        }
        let zero = literal(&Bits::zero(memory.width), Style::Count);
        format!("({}) ? {word} : {zero}", self.inside(memory, address))
    }

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

    /// What the memories hold at the start.
    pub fn memory_contents(&mut self) -> Vec<String> {
        let module = self.module;
        let mut out = Vec::new();
        for memory in &module.memories {
            let name = &memory.name;
            let mut body = match &memory.contents {
                Contents::Unknown => continue,
                Contents::Fill(word) => self.fill(memory, 0, word),
                Contents::Words(words) if words.len() > MOST_INLINE_WORDS => {
                    out.push(format!("initial $readmemh(\"{}\", {name});", data_file(module, memory)));
                    out.push(String::new());
                    continue;
                }
                Contents::Words(words) => {
                    let word = |(address, word)| format!("    {name}[{address}] = {};", literal(word, Style::Pattern));
                    let mut body: Vec<String> = words.iter().enumerate().map(word).collect();
                    if words.len() < memory.depth as usize {
                        body.splice(0..0, self.fill(memory, words.len(), &Bits::zero(memory.width)));
                    }
                    body
                }
            };
            let label = self.taken.fresh(&format!("{name}_contents"));
            out.push(format!("initial begin : {label}"));
            out.append(&mut body);
            out.extend(["end".to_string(), String::new()]);
        }
        out
    }

    /// Gives every word from an address on the same value.
    fn fill(&mut self, memory: &Memory, from: usize, word: &Bits) -> Vec<String> {
        let index = if self.taken.contains("i") { "word_index" } else { "i" };
        let (name, word) = (&memory.name, literal(word, Style::Pattern));
        vec![
            format!("    integer {index};"),
            format!(
                "    for ({index} = {from}; {index} < {}; {index} = {index} + 1) {name}[{index}] = {word};",
                memory.depth
            ),
        ]
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

/// The highest value of a width.
fn highest_value(width: u32) -> u64 {
    if width >= 64 { u64::MAX } else { (1 << width) - 1 }
}

/// The value of an address that is constant; one of more than 64 bits counts as the largest.
fn constant_address(module: &Module, address: NodeId) -> Option<u64> {
    match &module.node(address).op {
        Op::Const(value) => Some(value.to_u64().unwrap_or(u64::MAX)),
        Op::Wire(to) => constant_address(module, *to),
        _ => None,
    }
}

/// Whether the address of a read port can exceed the depth, and is not known to.
pub fn can_exceed(module: &Module, memory: &Memory, address: NodeId) -> bool {
    let node = module.node(address);
    let highest = match &node.op {
        Op::Extend { of, signed: false } => highest_value(module.width(*of)),
        _ => highest_value(node.width),
    };
    constant_address(module, address).is_none() && highest >= u64::from(memory.depth)
}

/// The names of every read port, by memory; asynchronous ports have none.
///
/// The data is called what the description calls it, else `m_read` for memory `m`; with several synchronous ports
/// `m_read0`, `m_read1` and so on.
pub fn name_reads(module: &Module, taken: &mut Taken) -> Vec<Vec<Option<ReadNames>>> {
    module.memories.iter().map(|memory| name_reads_of(module, memory, taken)).collect()
}

fn name_reads_of(module: &Module, memory: &Memory, taken: &mut Taken) -> Vec<Option<ReadNames>> {
    let several = memory.reads.iter().filter(|read| read.clock.is_some()).count() > 1;
    let mut index = 0;
    let mut names = Vec::with_capacity(memory.reads.len());
    for read in &memory.reads {
        names.push(read.clock.map(|_| {
            let number = if several { index.to_string() } else { String::new() };
            index += 1;
            let named = module.node(read.node).name.clone();
            let data = named.unwrap_or_else(|| taken.fresh(&format!("{}_read{number}", memory.name)));
            let raw = can_exceed(module, memory, read.address).then(|| RawRead {
                word: taken.fresh(&format!("{data}_word")),
                inside: taken.fresh(&format!("{data}_inside")),
            });
            ReadNames { data, raw }
        }));
    }
    names
}

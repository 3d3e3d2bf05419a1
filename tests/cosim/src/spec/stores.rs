//! What holds words and records: memories, tables, pipelines.

use super::{Form, Pattern, Pick};
use tilewright_hdl::ReadUnderWrite;

/// A memory.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Memory {
    /// Words.
    pub depth: u32,
    /// What a word is.
    pub form: Form,
    /// It says what it is to be made of.
    pub attribute: bool,
    /// [`ReadUnderWrite::Any`] keeps its synchronous reads off in cycles of writing, so that nothing depends on it.
    pub policy: ReadUnderWrite,
    /// What it holds at the start: nothing, one word everywhere, or words from address 0.
    pub contents: Contents,
    /// The ports that read.
    pub reads: Vec<Read>,
    /// The ports that write, all on one clock.
    pub writes: Vec<Write>,
    /// The writes are on the other clock than the reads.
    pub crossing: bool,
    /// There is another memory of this width with the same ports.
    pub twin: Option<u32>,
}

/// A memory's contents at the start.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Contents {
    /// None given.
    Unknown,
    /// One word everywhere.
    Fill(Pattern),
    /// Words from address 0.
    Words(Vec<Pattern>),
}

/// A port that reads.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Read {
    /// Within the cycle, where both ports have one clock.
    pub asynchronous: bool,
    /// When it reads.
    pub enable: Option<Pick>,
    /// Where.
    pub address: Pick,
}

/// A port that writes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Write {
    /// When it writes.
    pub enable: Pick,
    /// Where.
    pub address: Pick,
    /// What; may be a value of a later step.
    pub data: Pick,
}

/// A register, a memory and a pipeline of a record, which has a field, an array of two records, and a list.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Records {
    /// The field, the two of each record, and an element of the list.
    pub forms: [Form; 4],
    /// The length of the list.
    pub list: u32,
    /// The register's value after a reset, in all fields.
    pub reset: Option<Pattern>,
    /// Its value at power-on, in all fields.
    pub initial: Option<Pattern>,
    /// The register has an attribute.
    pub attribute: bool,
    /// When it takes what; none is a record of zeros. A record is made of one pick, each field of another value.
    pub updates: Vec<(Pick, Option<Pick>)>,
    /// What the register takes where no condition holds.
    pub otherwise: Option<Pick>,
    /// The memory's words.
    pub depth: u32,
    /// What they are at the start.
    pub contents: Vec<Pattern>,
    /// It is read within the cycle.
    pub asynchronous: bool,
    /// Where it is read, when it is written, and where.
    pub ports: [Pick; 3],
    /// The stages of the pipeline.
    pub stages: u32,
}

/// A table of records: an opcode, and an operand.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Rom {
    /// The operand.
    pub operand: Form,
    /// The words: of the opcode, and of the operand.
    pub words: Vec<[Pattern; 2]>,
    /// Where it is read.
    pub address: Pick,
    /// It is read within the cycle.
    pub asynchronous: bool,
    /// What the opcode chooses from.
    pub chosen: [Pick; 3],
}

/// A memory of words in parts, each with an enable of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct InParts {
    /// The parts of a word.
    pub parts: u32,
    /// What a part is.
    pub form: Form,
    /// Words.
    pub depth: u32,
    /// It is read within the cycle.
    pub asynchronous: bool,
    /// The enables, where it is written, what, and where it is read.
    pub ports: [Pick; 4],
}

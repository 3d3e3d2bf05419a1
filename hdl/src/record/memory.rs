//! Memories of records: one memory, in whose words the fields stand side by side.

use crate::bits::Bits;
use crate::bundle::{Bundle, Fields};
use crate::clock::Clock;
use crate::data::{Fits, number_of_field};
use crate::elaboration;
use crate::ir::Op;
use crate::loc::Loc;
use crate::memory::Mem;
use crate::operand::{IntoSignal, Literal, Operand, Value};
use crate::problem::Problem;
use crate::record::split;
use crate::select::concat;
use crate::signal::bits_text;
use crate::width::Width;

/// A memory of records is one memory, in whose words the fields stand side by side, the first most significant, as in
/// [`cat!`](crate::cat!). What is read is a record; a name for it, as in `net!(step = ..)`, names
/// its word and its fields, `step_address`, in waves and in Verilog.
///
/// ```
/// # use tilewright_hdl::{Block, Module, ReadUnderWrite, Width, bit, bits, bundle, elaborate, net};
/// bundle! {
///     /// An instruction.
///     pub struct Step<T> { pub address: T, pub counts: T, pub ends: T }
/// }
/// # bundle! {
/// #     /// Where it is.
/// #     pub struct ProgramIn<T> { pub at: T }
/// # }
/// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
/// # struct Program;
/// # impl Block for Program {
/// #     type In = ProgramIn;
/// #     type Out = Step;
/// #     fn inputs(&self) -> ProgramIn<Width> { ProgramIn { at: bits(2) } }
/// #     fn build(&self, m: Module, i: ProgramIn) -> Step {
/// const COUNT: Step<u64> = Step { address: 0, counts: 1, ends: 0 };
/// let program = m.memory("program", 4, Step { address: bits(8), counts: bit(), ends: bit() }, ReadUnderWrite::Any).words([
///     Step { address: 17, ..COUNT },
///     Step { address: 18, ..COUNT },
///     Step { address: 0, counts: 0, ends: 1 },
/// ]);
/// net!(step = program.read(i.at));
/// #         step
/// #     }
/// # }
/// # elaborate(&Program).unwrap();
/// ```
impl<B: Bundle> Mem<B> {
    /// The same memory; ports made through this handle are on `clock`.
    #[track_caller]
    pub fn on(&self, clock: Clock) -> Mem<B> {
        self.with(self.word().on(clock))
    }

    /// The width of an address in bits.
    pub fn address_width(&self) -> u32 {
        self.address_width
    }

    /// The width of a word in bits: of all fields together.
    pub fn width(&self) -> u32 {
        self.word.bits
    }

    /// Allows more than one write port. Few FPGAs have such memories: elsewhere this becomes registers.
    #[track_caller]
    pub fn true_dual_port(&self) -> Mem<B> {
        self.with(self.word().true_dual_port())
    }

    /// Every word is `record` at the start: a record of numbers, or 0 for all of its fields.
    #[track_caller]
    pub fn fill(&self, record: impl Fits<B>) -> Mem<B> {
        self.with(self.word().fill(self.number(record, "fill", "the contents")))
    }

    /// Holds these records of numbers from address 0 at the start, and zeros above.
    #[track_caller]
    pub fn words<R: Fits<B>>(&self, records: impl IntoIterator<Item = R>) -> Mem<B> {
        // A loop, as a closure would be the caller that messages name.
        let mut words = Vec::new();
        for (at, record) in records.into_iter().enumerate() {
            words.push(self.number(record, "words", &format!("word {at}")));
        }
        self.with(self.word().words(words))
    }

    /// A synchronous read: the record at `address` appears after the next edge.
    #[track_caller]
    pub fn read(&self, address: impl Operand) -> B {
        split(&self.layout, self.word().read(address))
    }

    /// As a read, where `enable` is high; elsewhere the data stays.
    #[track_caller]
    pub fn read_when(&self, enable: impl IntoSignal, address: impl Operand) -> B {
        split(&self.layout, self.word().read_when(enable, address))
    }

    /// An asynchronous read: the record at `address`, in the same cycle. On an FPGA it costs distributed memory.
    #[track_caller]
    pub fn read_async(&self, address: impl Operand) -> B {
        split(&self.layout, self.word().read_async(address))
    }

    /// Writes `record` at `address` at each edge where `enable` is high.
    #[track_caller]
    pub fn write(&self, enable: impl IntoSignal, address: impl Operand, record: impl Fits<B>) {
        let fields = self.fields();
        let mut parts = Vec::new();
        for (value, (path, width)) in record.given().for_fields(&fields, "write").into_iter().zip(&fields) {
            let value = match value {
                Value::Literal(number) => {
                    let field = || format!("field `{path}` of memory `{}`", self.name());
                    let bits = number_of_field(&number, field, (width.bits, width.kind));
                    Value::Literal(Literal::Exact(bits))
                }
                signal => signal,
            };
            parts.push(self.word().sized(value, (width.bits, width.kind), &format!("field `{path}`")));
        }
        self.word().write(enable, address, concat(&parts));
    }

    /// The memory of packed words.
    fn word(&self) -> Mem {
        let Mem { stamp, module, index, address_width, word, clock, .. } = *self;
        Mem { stamp, module, index, address_width, word, clock, layout: word }
    }

    fn with(&self, word: Mem) -> Mem<B> {
        Mem { clock: word.clock, ..self.clone() }
    }

    /// The fields' paths, and how they are declared.
    fn fields(&self) -> Vec<(String, Width)> {
        self.layout.leaves()
    }

    fn name(&self) -> String {
        elaboration::draft(|draft| draft.memories[self.index as usize].memory.name.clone())
    }

    /// A record of numbers as a word; `which` it is among the contents.
    #[track_caller]
    fn number(&self, record: impl Fits<B>, of: &str, which: &str) -> Bits {
        let loc = Loc::caller();
        let fields = self.fields();
        let mut word: Option<Bits> = None;
        for (value, (path, width)) in record.given().for_fields(&fields, of).into_iter().zip(&fields) {
            let part = match value {
                Value::Literal(number) => number_of_field(
                    &number,
                    || format!("field `{path}` of {which} of memory `{}`", self.name()),
                    (width.bits, width.kind),
                ),
                Value::Signal(signal) => {
                    let id = signal.id();
                    elaboration::with(|e| match &e.draft().node(id).op {
                        Op::Const(bits) if bits.width() == width.bits => bits.clone(),
                        _ => {
                            let (draft, index) = (e.draft(), self.index as usize);
                            let (name, text) = (&draft.memories[index].memory.name, draft.describe(id));
                            let message = format!(
                                "field `{path}` of {which} of memory `{name}` is a constant of {}, but `{text}` is none",
                                bits_text(width.bits)
                            );
                            let help = "contents are numbers known while the block is built";
                            e.report_instead_of(&[id], Problem::new(loc, message).help(help));
                            Bits::zero(width.bits)
                        }
                    })
                }
            };
            word = Some(word.map_or(part.clone(), |word| word.concat(&part)));
        }
        word.unwrap_or(Bits::zero(self.word.bits)).resize(self.word.bits)
    }
}

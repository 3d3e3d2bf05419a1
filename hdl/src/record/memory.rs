//! Memories of records: one memory with the fields side by side in its words.

use crate::bundle::Bundle;
use crate::data::{Fits, number_of_field};
use crate::memory::Mem;
use crate::operand::{IntoSignal, Literal, Operand, Value};
use crate::record::{sound_fields, split};
use crate::select::concat;
use crate::width::Width;
use tilewright_circuit::Clock;

/// A memory of records is one memory. Its words have the fields side by side, the first most significant, as in
/// [`cat!`](crate::cat!). A read gives a record. Naming it, as in `def!(step = ..)`, names its word and its fields
/// (`step_address`) in waves and in Verilog.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// bundle! {
///     /// An instruction.
///     struct Step<T> { address: T, counts: T, ends: T }
/// }
///
/// const COUNT: Step<u64> = Step { address: 0, counts: 1, ends: 0 };
/// let layout = Step { address: bits(8), counts: bit(), ends: bit() };
/// let program = m.rom("program", layout, [
///     Step { address: 17, ..COUNT },
///     Step { address: 18, ..COUNT },
///     Step { address: 0, counts: 0, ends: 1 },
///     COUNT,
/// ]);
/// def!(at = m.reg(2).reset(0));
/// def!(step = program.read_async(at));
/// at.when(!step.ends, at + 1);
/// # });
/// assert_eq!(example.values("step_address"), [17, 18, 0, 0]);
/// assert_eq!(example.values("step_ends"), [0, 0, 1, 1]);
/// ```
impl<B: Bundle> Mem<B> {
    /// The same memory, with its next ports on `clock`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # const HOST: Clock = Clock::new("host", Period::ns(30));
    /// # const VIDEO: Clock = Clock::new("video", Period::ns(40));
    /// bundle! { struct Tile<T> { glyph: T, colour: T } }
    /// # block! {
    /// #     struct Text;
    /// #     in TextIn {
    /// #         set: bit().on(HOST),
    /// #         at: bits(10).on(HOST),
    /// #         tile: Tile { glyph: bits(8), colour: bits(4) }.on(HOST),
    /// #         shown: bits(10).on(VIDEO),
    /// #     }
    /// #     out TextOut { now: Tile = _ }
    /// # }
    /// # impl Text {
    /// #     fn build(&self, m: Module, i: TextIn) -> TextOut {
    ///
    /// def!(tiles = m.memory(1024, Tile { glyph: bits(8), colour: bits(4) }, ReadUnderWrite::Any));
    /// tiles.on(HOST).write(i.set, i.at, i.tile);
    /// let now = tiles.on(VIDEO).read(i.shown);
    /// #         TextOut { now }
    /// #     }
    /// # }
    /// # assert_eq!(elaborate(&Text).unwrap().top().clocks.len(), 2);
    /// ```
    #[track_caller]
    pub fn on(&self, clock: Clock) -> Mem<B> {
        self.with(self.word().on(clock))
    }

    /// The width of an address in bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Entry<T> { resident: T, page: T } }
    ///
    /// def!(table = m.memory(12, Entry { resident: bit(), page: below(100) }, ReadUnderWrite::Any).fill(0));
    /// let last = lit(table.address_width(), 11);
    /// m.assert(!table.read_async(last).resident, "4 bits address 12 records");
    /// # });
    /// ```
    pub fn address_width(&self) -> u32 {
        self.address_width
    }

    /// The width of a word in bits: that of all fields together.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Entry<T> { resident: T, page: T } }
    ///
    /// def!(table = m.memory(12, Entry { resident: bit(), page: below(100) }, ReadUnderWrite::Any).fill(0));
    /// m.assert(table.read_async(0).pack().eq(lit(table.width(), 0)), "1 bit and 7");
    /// # });
    /// ```
    pub fn width(&self) -> u32 {
        self.word.bits
    }

    /// Allows more than one write port. Few FPGAs have such memories; on others, this memory becomes registers.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Entry<T> { resident: T, page: T } }
    ///
    /// def!(count = m.reg(2).reset(0));
    /// count.next(count + 1);
    /// let layout = Entry { resident: bit(), page: bits(2) };
    /// def!(table = m.memory(4, layout, ReadUnderWrite::Any).true_dual_port().fill(0));
    /// table.write(lit(1, 1), count, Entry { resident: lit(1, 1), page: *count });
    /// table.write(count.eq(1), 3, 0);
    /// def!(entry = table.read_async(3));
    /// # });
    /// assert_eq!(example.values("entry_resident"), [0, 0, 0, 0, 1, 1, 0, 0]);
    /// ```
    #[track_caller]
    pub fn true_dual_port(&self) -> Mem<B> {
        self.with(self.word().true_dual_port())
    }

    /// A synchronous read: the record at `address` appears after the next edge.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Entry<T> { resident: T, page: T } }
    ///
    /// def!(at = m.reg(1).reset(0));
    /// at.next(!at);
    /// let table = m
    ///     .memory("table", 2, Entry { resident: bit(), page: bits(4) }, ReadUnderWrite::Any)
    ///     .words([Entry { resident: 0, page: 9 }, Entry { resident: 1, page: 7 }]);
    /// def!(entry = table.read(at));
    /// # });
    /// assert_eq!(example.values("entry_page"), [0, 9, 7, 9]);
    /// assert_eq!(example.values("entry_resident"), [0, 0, 1, 0]);
    /// ```
    #[track_caller]
    pub fn read(&self, address: impl Operand) -> B {
        split(&self.layout, self.word().read(address))
    }

    /// Like a read, but only where `enable` is high; elsewhere the data keeps its value.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Entry<T> { resident: T, page: T } }
    ///
    /// def!(count = m.reg(2).reset(0));
    /// count.next(count + 1);
    /// let table = m
    ///     .memory("table", 2, Entry { resident: bit(), page: bits(4) }, ReadUnderWrite::Any)
    ///     .words([Entry { resident: 0, page: 9 }, Entry { resident: 1, page: 7 }]);
    /// def!(entry = table.read_when(count.bit(0), count.bit(1)));
    /// # });
    /// assert_eq!(example.values("entry_page"), [0, 0, 9, 9, 7, 7, 9]);
    /// ```
    #[track_caller]
    pub fn read_when(&self, enable: impl IntoSignal, address: impl Operand) -> B {
        split(&self.layout, self.word().read_when(enable, address))
    }

    /// An asynchronous read: the record at `address` in the same cycle. On an FPGA it needs distributed memory.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Entry<T> { resident: T, page: T } }
    ///
    /// let layout = Entry { resident: bit(), page: bits(4) };
    /// def!(table = m.memory(2, layout, ReadUnderWrite::Any).words([Entry { resident: 1, page: 7 }]));
    /// let Entry { resident, page } = table.read_async(0);
    /// m.assert(resident & page.eq(7), "its fields, taken apart");
    /// # });
    /// ```
    #[track_caller]
    pub fn read_async(&self, address: impl Operand) -> B {
        split(&self.layout, self.word().read_async(address))
    }

    /// Writes `record` at `address` at each edge where `enable` is high.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Entry<T> { resident: T, page: T } }
    ///
    /// def!(count = m.reg(3).reset(0));
    /// count.next(count + 1);
    /// def!(table = m.memory(2, Entry { resident: bit(), page: bits(3) }, ReadUnderWrite::Old).fill(0));
    /// def!(entry = table.read_async(1));
    /// table.write(count.bit(0), 1, Entry { page: *count, ..entry }); // the other field is written back unchanged
    /// # });
    /// assert_eq!(example.values("entry_page"), [0, 0, 1, 1, 3, 3, 5]);
    /// ```
    #[track_caller]
    pub fn write(&self, enable: impl IntoSignal, address: impl Operand, record: impl Fits<B>) {
        let fields = self.fields();
        let mut parts = Vec::new();
        for (value, (path, width)) in record.given().for_fields(&fields, "write").into_iter().zip(&fields) {
            let value = match value {
                Value::Literal(number) => {
                    let field = || format!("field `{path}` of memory `{}`", self.name());
                    let bits = number_of_field(&number, field, (width.bits, width.kind), self.stand_in());
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

    /// The fields' paths and their declared widths.
    fn fields(&self) -> Vec<(String, Width)> {
        sound_fields(&self.layout)
    }
}

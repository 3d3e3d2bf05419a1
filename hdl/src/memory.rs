//! Memories with any number of read and write ports, each on its own clock.

use crate::data::Data;
use crate::elaboration::{self, Elaboration};
use crate::names::bits_text;
use crate::operand::{IntoSignal, Operand, Value};
use crate::select::condition;
use crate::signal::Signal;
use crate::width::Width;
use tilewright_circuit::ir::{Kind, MemoryId, NodeId, Op, ReadPort, WritePort};
use tilewright_circuit::{Clock, Loc, Mistake, Problem};

/// A memory of signals or of records, seen from one clock. Made by [`Module::memory`](crate::Module::memory).
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// def!(count = m.reg(2).reset(0));
/// count.next(count + 1);
/// def!(table = m.memory(4, 8, ReadUnderWrite::Old).fill(9));
/// table.write(count.bit(0), count, count.zext(8));
/// def!(word = table.read_async(count));
/// # });
/// // Words 1 and 3 are written at the end of the clock in which they are first read.
/// assert_eq!(example.values("word"), [9, 9, 9, 9, 9, 1, 9, 3]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Mem<V: Data = Signal> {
    pub(crate) stamp: u32,
    pub(crate) module: u32,
    pub(crate) index: u32,
    pub(crate) address_width: u32,
    /// The width of a word in one lane, with its lanes and kind.
    pub(crate) word: Width,
    pub(crate) clock: Option<Clock>,
    /// The widths of the word's fields, or of the word.
    pub(crate) layout: V::Like<Width>,
}

impl Mem {
    /// The same memory, with its next ports on `clock`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const HOST: Clock = Clock::new("host", Period::ns(30));
    /// const VIDEO: Clock = Clock::new("video", Period::ns(40));
    ///
    /// block! {
    ///     /// A palette that the host sets and the screen reads.
    ///     struct Palette;
    ///     in PaletteIn {
    ///         set: bit().on(HOST),
    ///         index: bits(8).on(HOST),
    ///         rgb: bits(24).on(HOST),
    ///         pixel: bits(8).on(VIDEO),
    ///     }
    ///     out PaletteOut { rgb_out: bits(24) }
    /// }
    ///
    /// impl Palette {
    ///     fn build(&self, m: Module, i: PaletteIn) -> PaletteOut {
    ///         def!(colours = m.memory(256, 24, ReadUnderWrite::Any));
    ///         colours.on(HOST).write(i.set, i.index, i.rgb);
    ///         PaletteOut { rgb_out: colours.on(VIDEO).read(i.pixel) }
    ///     }
    /// }
    ///
    /// // A memory is one way to cross between clocks.
    /// assert_eq!(elaborate(&Palette)?.top().clocks.len(), 2);
    /// # Ok::<(), Problems>(())
    /// ```
    #[track_caller]
    pub fn on(self, clock: Clock) -> Mem {
        let loc = Loc::caller();
        let clock = elaboration::with(|e| {
            e.meet_clock(clock, loc);
            e.draft().in_use(clock)
        });
        Mem { clock, ..self }
    }

    /// The width of an address in bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(table = m.memory(12, 8, ReadUnderWrite::Any).fill(Bits::zero(8)));
    /// let last = lit(table.address_width(), 11);
    /// m.assert(table.read_async(last).eq(0), "4 bits; the addresses 12 to 15 have no word");
    /// # });
    /// ```
    pub fn address_width(self) -> u32 {
        self.address_width
    }

    /// The width of a word in bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(table = m.memory(12, below(100), ReadUnderWrite::Any).fill(99));
    /// let word = table.read_async(0);
    /// m.assert(word.eq(lit(table.width(), 99)), "7 bits can represent every number below 100");
    /// # });
    /// ```
    pub fn width(self) -> u32 {
        self.word.bits
    }

    /// Allows more than one write port. Few FPGAs have such memories; on others, this memory becomes registers.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(2).reset(0));
    /// count.next(count + 1);
    /// def!(table = m.memory(4, 8, ReadUnderWrite::Any).true_dual_port().fill(Bits::zero(8)));
    /// table.write(lit(1, 1), count, 1);
    /// table.write(count.bit(0), count, 2); // if both write one word, the later port wins
    /// def!(word = table.read_async(count));
    /// # });
    /// assert_eq!(example.values("word"), [0, 0, 0, 0, 1, 2, 1, 2]);
    /// ```
    #[track_caller]
    pub fn true_dual_port(self) -> Mem {
        elaboration::draft(|draft| draft.memories[self.index as usize].true_dual_port = true);
        self
    }

    #[track_caller]
    fn address(self, address: impl Operand) -> Signal {
        self.laid_out(self.sized(address, (self.address_width, Kind::Number), "an address"), "an address")
    }

    /// The operand as a signal of `width` bits; `what` names its role in this memory.
    #[track_caller]
    pub(crate) fn sized(self, operand: impl Operand, (width, kind): (u32, Kind), what: &str) -> Signal {
        let loc = Loc::caller();
        self.check_module(loc);
        let signal = match operand.operand().cut_to(width) {
            Value::Literal(literal) => return literal.sized(width, kind),
            Value::Signal(signal) | Value::Low(signal) => signal,
        };
        match (signal.width == width, signal.kind == kind) {
            (true, true) => return signal,
            (true, false) => return self.of_kind(signal, kind, what),
            (false, _) => {}
        }
        let id = signal.id();
        elaboration::with(|e| {
            let draft = e.draft();
            let memory = &draft.memories[self.index as usize].memory;
            let (name, text) = (&memory.name, draft.describe(id));
            let (needs, has) = (bits_text(width), bits_text(signal.width));
            let problem = Problem::new(
                Mistake::MemoryWidth,
                loc,
                format!("{what} of memory `{name}` has {needs}, but `{text}` has {has}"),
            )
            .note(format!("`{name}` is declared"), memory.loc)
            .note(format!("`{text}` is made"), draft.node(id).loc)
            .help(match signal.width < width {
                true => format!("widen it with `.zext({width})` or `.sext({width})`"),
                false => format!("cut it with `.trunc({width})`"),
            });
            self.report_instead_of(e, id, problem);
            Signal::zero_in(e, width, signal.shape, kind, loc)
        })
    }

    /// A signal that is not of the kind that this memory needs: a problem.
    #[track_caller]
    fn of_kind(self, signal: Signal, kind: Kind, what: &str) -> Signal {
        let (loc, id) = (Loc::caller(), signal.id());
        elaboration::with(|e| {
            let draft = e.draft();
            let memory = &draft.memories[self.index as usize].memory;
            let (name, text) = (&memory.name, draft.describe(id));
            let problem = Problem::new(
                Mistake::MixedKinds,
                loc,
                format!("{what} of memory `{name}` is {kind}, but `{text}` is {}", signal.kind),
            )
            .note(format!("`{name}` is declared"), memory.loc)
            .note(format!("`{text}` is made"), draft.node(id).loc)
            .help(crate::signed::READ_AS);
            self.report_instead_of(e, id, problem);
            Signal::zero_in(e, signal.width, signal.shape, kind, loc)
        })
    }

    /// The signal, which must be plain or have a lane for each lane of the memory; otherwise a problem.
    #[track_caller]
    fn laid_out(self, signal: Signal, what: &str) -> Signal {
        if signal.shape.is_plain() || signal.shape == self.word.shape {
            return signal;
        }
        let (loc, id) = (Loc::caller(), signal.id());
        elaboration::with(|e| {
            let draft = e.draft();
            let memory = &draft.memories[self.index as usize].memory;
            let (name, text) = (&memory.name, draft.describe(id));
            let message = format!("{what} of memory `{name}`, of {}, has {}: `{text}`", self.word.shape, signal.shape);
            let problem = Problem::new(Mistake::OtherLayout, loc, message)
                .note(format!("`{name}` is declared"), memory.loc)
                .note(format!("`{text}` is made"), draft.node(id).loc)
                .help("it is plain, one for all lanes, or has the memory's lanes");
            self.report_instead_of(e, id, problem);
            Signal::zero_in(e, signal.width, self.word.shape, signal.kind, loc)
        })
    }

    /// Reports a problem with `operand` of this memory, unless either of them follows from another problem.
    fn report_instead_of(self, e: &mut Elaboration, operand: NodeId, problem: Problem) {
        let stand_in = e.draft().memories[self.index as usize].stand_in;
        let operands: Vec<NodeId> = stand_in.into_iter().chain([operand]).collect();
        e.report_instead_of(&operands, problem);
    }

    /// Panics for the handle of another module, which only a helper that keeps handles between blocks can have.
    fn check_module(self, loc: Loc) {
        elaboration::with(|e| {
            crate::signal::check_stamp(e, self.stamp, loc);
            assert!(
                e.draft().serial == self.module,
                "a memory of another module is used, at {loc}: memories stay in the module that declares them"
            );
        });
    }

    /// A synchronous read: the word at `address` appears after the next edge.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(at = m.reg(2).reset(0));
    /// at.next(at + 1);
    /// def!(table = m.memory(4, 8, ReadUnderWrite::Any).words([10, 11, 12, 13]));
    /// def!(word = table.read(at));
    /// # });
    /// assert_eq!(example.values("at"), [0, 1, 2, 3]);
    /// assert_eq!(example.values("word"), [0, 10, 11, 12]); // the data is a register without a reset
    /// ```
    #[track_caller]
    pub fn read(self, address: impl Operand) -> Signal {
        let address = self.address(address);
        self.read_port(address, None, true)
    }

    /// Like [`Mem::read`], but only where `enable` is high; elsewhere the data keeps its value.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(at = m.reg(2).reset(0));
    /// at.next(at + 1);
    /// def!(table = m.memory(4, 8, ReadUnderWrite::Any).words([10, 11, 12, 13]));
    /// def!(word = table.read_when(at.bit(0), at));
    /// # });
    /// assert_eq!(example.values("word"), [0, 0, 11, 11, 13, 13]);
    /// ```
    #[track_caller]
    pub fn read_when(self, enable: impl IntoSignal, address: impl Operand) -> Signal {
        let (address, enable) = (self.address(address), enable.into());
        self.read_port(address, Some(enable), true)
    }

    /// An asynchronous read: the word at `address` in the same cycle. On an FPGA it needs distributed memory.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(at = m.reg(2).reset(0));
    /// at.next(at + 1);
    /// def!(table = m.memory(3, 8, ReadUnderWrite::Any).words([10, 11, 12]));
    /// def!(word = table.read_async(at));
    /// # });
    /// assert_eq!(example.values("word"), [10, 11, 12, 0]); // word 3 does not exist
    /// ```
    #[track_caller]
    pub fn read_async(self, address: impl Operand) -> Signal {
        let address = self.address(address);
        self.read_port(address, None, false)
    }

    #[track_caller]
    fn read_port(self, address: Signal, enable: Option<Signal>, synchronous: bool) -> Signal {
        let loc = Loc::caller();
        let address = address.id();
        #[expect(clippy::manual_map, reason = "a closure would be the caller that messages name")]
        let enable = match enable {
            Some(enable) => Some(self.laid_out(condition(enable, "read_when"), "an enable").id()),
            None => None,
        };
        elaboration::with(|e| {
            let draft = e.draft();
            let clock = synchronous.then(|| draft.use_clock(self.clock));
            let (port, part) = (draft.memories[self.index as usize].memory.reads.len() as u32, draft.part);
            let node = draft.add(Op::Read(MemoryId(self.index), port), self.word.bits, self.word.shape, loc);
            let memory = &mut draft.memories[self.index as usize];
            memory.memory.reads.push(ReadPort { clock, address, enable, node });
            memory.read_parts.push(part);
            memory.read_clocks.push(self.clock);
            if memory.stand_in.is_some() {
                draft.stand_ins.insert(node);
            }
            Signal::at(e, node).kept_in(e, self.word.kind)
        })
    }

    /// Writes `data` at `address` at each edge where `enable` is high.
    ///
    /// To write parts of a word, make the word a row of parts, and its enable a row of bits. A synthesizer makes a
    /// memory of lanes with one address into a memory of wide words with a write enable for each part. Record fields
    /// that are written at different times need a memory each.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// A memory of 32-bit words with byte enables.
    ///     pub struct Ram;
    ///     in RamIn { at: below(256), writes: bit(), bytes: bits(4), data: bits(32) }
    ///     out RamOut { word: bits(32) }
    /// }
    ///
    /// impl Ram {
    ///     fn build(&self, m: Module, i: RamIn) -> RamOut {
    ///         def!(words = m.memory(256, bits(8).of(row(4)), ReadUnderWrite::Any));
    ///         words.write(i.writes & i.bytes.unpack(row(4)), i.at, i.data.unpack(row(4)));
    ///         RamOut { word: words.read(i.at).pack() }
    ///     }
    /// }
    /// # let text = &tilewright_gen::verilog(&elaborate(&Ram).unwrap())[0].text;
    /// # assert!(text.contains("reg [31:0] words [0:255];"), "{text}");
    /// # assert!(text.contains("words[at][i * 8 +: 8] <= data[i * 8 +: 8];"), "{text}");
    /// # let mut sim = tilewright_sim::Simulation::of(&Ram).unwrap();
    /// # for (bytes, data) in [(0b1111, 0x1122_3344), (0b0101, 0xaabb_ccdd)] {
    /// #     sim.drive(RamIn { at: 3, writes: 1, bytes, data });
    /// #     sim.step();
    /// # }
    /// # sim.set(sim.i.writes, 0);
    /// # sim.step();
    /// # assert_eq!(sim.get_u64(sim.o.word), 0x11bb_33dd);
    /// ```
    #[track_caller]
    pub fn write(self, enable: impl IntoSignal, address: impl Operand, data: impl Operand) {
        let loc = Loc::caller();
        let enable = self.laid_out(condition(enable.into(), "write"), "an enable").id();
        let address = self.address(address).id();
        let mut data = self.laid_out(self.sized(data, (self.word.bits, self.word.kind), "a word"), "a word");
        if data.shape != self.word.shape {
            data = data.spread(self.word.shape, loc);
        }
        let data = data.id();
        elaboration::with(|e| {
            let (clock, part) = (e.draft().use_clock(self.clock), e.draft().part);
            let draft = &mut e.draft().memories[self.index as usize];
            draft.memory.writes.push(WritePort { clock, enable, address, data });
            draft.write_parts.push(part);
            draft.written.push(loc);
            if draft.memory.writes.len() > 1 && !draft.true_dual_port {
                let (name, declared) = (draft.memory.name.clone(), draft.memory.loc);
                let problem =
                    Problem::new(Mistake::SecondWritePort, loc, format!("memory `{name}` gets a second write port"))
                        .note(format!("`{name}` is declared"), declared)
                        .help("share one port with `mux`, or say `.true_dual_port()` if the target has such memories");
                e.report(problem);
            }
        });
    }
}

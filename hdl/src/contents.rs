//! The contents of memories at the start.

use crate::data::{Data, Fits, Layout, number_of_field};
use crate::elaboration;
use crate::memory::Mem;
use crate::module::Module;
use crate::names::bits_text;
use crate::operand::Value;
use crate::record::sound_fields;
use crate::signal::Signal;
use crate::signed::READ_AS;
use crate::width::Width;
use tilewright_circuit::ir::{Contents, NodeId, Op, ReadUnderWrite};
use tilewright_circuit::{Bits, Loc, Mistake, Problem};

impl Module {
    /// A ROM with the contents `words`: numbers, or records of numbers.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Step<T> { add: T, halt: T } }
    ///
    /// let program = m.rom("program", Step { add: bits(8).signed(), halt: bit() }, [
    ///     Step { add: 5, halt: 0 },
    ///     Step { add: -2, halt: 0 },
    ///     Step { add: 0, halt: 1 },
    /// ]);
    /// def!(at = m.reg(program.address_width()).reset(0));
    /// def!(step = program.read_async(at));
    /// def!(sum = m.reg(bits(8).signed()).reset(0));
    /// sum.next(sum + step.add);
    /// at.when(!step.halt, at + 1);
    /// # });
    /// assert_eq!(example.values("sum"), [0, 5, 3, 3]);
    /// ```
    #[track_caller]
    pub fn rom<L: Layout, W: Fits<L::Value>>(
        self,
        name: &str,
        layout: L,
        words: impl IntoIterator<Item = W>,
    ) -> Mem<L::Value> {
        let words: Vec<W> = words.into_iter().collect();
        self.memory(name, words.len() as u32, layout, ReadUnderWrite::Any).words(words)
    }
}

impl<V: Data> Mem<V> {
    /// Sets every word to `word` at the start: a number, a record of numbers, or 0 for all of its fields.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Entry<T> { resident: T, page: T } }
    ///
    /// def!(depths = m.memory(16, 24, ReadUnderWrite::Any).fill(Bits::ones(24)));
    /// m.assert(depths.read_async(5).all_ones(), "the farthest depth; a reset does not restore it");
    /// let layout = Entry { resident: bit(), page: below(12) };
    /// def!(table = m.memory(16, layout, ReadUnderWrite::Any).fill(Entry { resident: 0, page: 11 }));
    /// m.assert(table.read_async(5).page.eq(11), "a number for each field");
    /// # });
    /// ```
    #[track_caller]
    pub fn fill(self, word: impl Fits<V>) -> Mem<V> {
        let word = self.number(word, &sound_fields(&self.layout), "fill", || "the contents".to_owned());
        self.contents(Contents::Fill(word));
        self
    }

    /// Sets the words from address 0 on at the start, as numbers or records of numbers; the words above are zero.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(squares = m.memory(8, 8, ReadUnderWrite::Any).words((0..4).map(|x| x * x)));
    /// def!(at = m.reg(3).reset(1));
    /// at.next(at + 1);
    /// def!(square = squares.read_async(at));
    /// # });
    /// assert_eq!(example.values("square"), [1, 4, 9, 0, 0]); // the words above address 3 are zero
    /// ```
    #[track_caller]
    pub fn words<W: Fits<V>>(self, words: impl IntoIterator<Item = W>) -> Mem<V> {
        let fields = sound_fields(&self.layout);
        // A loop: in a closure, the message would name the closure as the caller.
        let mut numbers = Vec::new();
        for (at, word) in words.into_iter().enumerate() {
            numbers.push(self.number(word, &fields, "words", || format!("word {at}")));
        }
        self.contents(Contents::Words(numbers));
        self
    }

    #[track_caller]
    fn contents(&self, contents: Contents) {
        let loc = Loc::caller();
        elaboration::with(|e| {
            let memory = &mut e.draft().memories[self.index as usize].memory;
            let (name, depth) = (memory.name.clone(), memory.depth);
            let given = if let Contents::Words(words) = &contents { words.len() } else { 1 };
            let is_second = std::mem::replace(&mut memory.contents, contents) != Contents::Unknown;
            if is_second {
                let problem =
                    Problem::new(Mistake::GivenTwice, loc, format!("memory `{name}` is given contents twice"));
                e.report(problem.help("give them once: by `.fill(..)` or by `.words(..)`"));
            }
            if given > depth as usize {
                let message = format!("memory `{name}` has {depth} words, but its contents have {given}");
                let problem = Problem::new(Mistake::TooMuchContents, loc, message);
                let stand_in = e.draft().memories[self.index as usize].stand_in;
                let problem = problem.help("give at most as many words as the memory has");
                e.report_instead_of(stand_in.as_slice(), problem);
            }
        });
    }

    /// A number, or a record of numbers, as a word; `which` is its position in the contents.
    #[track_caller]
    fn number(&self, word: impl Fits<V>, fields: &[(String, Width)], of: &str, which: impl Fn() -> String) -> Bits {
        let mut bits: Option<Bits> = None;
        for (value, (path, width)) in word.given().for_fields(fields, of).into_iter().zip(fields) {
            let name = || {
                let field = if path.is_empty() { String::new() } else { format!("field `{path}` of ") };
                format!("{field}{} of memory `{}`", which(), self.name())
            };
            let part = match value {
                Value::Literal(number) => number_of_field(&number, name, (width.bits, width.kind), self.stand_in()),
                Value::Signal(signal) | Value::Low(signal) => constant(signal, name, *width, self.stand_in()),
            };
            bits = Some(bits.map_or(part.clone(), |bits| bits.concat(&part)));
        }
        bits.unwrap_or(Bits::zero(self.word.bits)).resize(self.word.bits)
    }

    /// The stand-in, if the declaration is faulty.
    pub(crate) fn stand_in(&self) -> Option<NodeId> {
        elaboration::draft(|draft| draft.memories[self.index as usize].stand_in)
    }

    /// The declared name.
    pub(crate) fn name(&self) -> String {
        elaboration::draft(|draft| draft.memories[self.index as usize].memory.name.clone())
    }
}

/// The constant that the signal must be.
#[track_caller]
fn constant(signal: Signal, name: impl FnOnce() -> String, width: Width, stand_in: Option<NodeId>) -> Bits {
    let (loc, id, name) = (Loc::caller(), signal.id(), name());
    elaboration::with(|e| match &e.draft().node(id).op {
        Op::Const(bits) if bits.width() == width.bits && signal.kind == width.kind => bits.clone(),
        op => {
            let other_kind = matches!(op, Op::Const(bits) if bits.width() == width.bits);
            let text = e.draft().describe(id);
            let problem = if other_kind {
                let message = format!("{name} is {}, but `{text}` is {}", width.kind, signal.kind);
                Problem::new(Mistake::MixedKinds, loc, message).help(READ_AS)
            } else {
                let message = format!("{name} is a constant of {}, but `{text}` is not", bits_text(width.bits));
                Problem::new(Mistake::NotConstant, loc, message)
                    .help("contents are numbers known while the block is built")
            };
            e.report_instead_of(&stand_in.into_iter().chain([id]).collect::<Vec<_>>(), problem);
            Bits::zero(width.bits)
        }
    })
}

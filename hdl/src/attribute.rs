//! Attributes: notes to synthesizers only.

use crate::bundle::Bundle;
use crate::data::Data;
use crate::draft::Draft;
use crate::elaboration;
use crate::memory::Mem;
use crate::names::illegal;
use crate::register::Reg;
use crate::wire::is_here;
use tilewright_circuit::ir::Attribute;
use tilewright_circuit::{Loc, Mistake, Problem};

impl Reg {
    /// Sets a synthesis attribute of this register: `.attribute("keep", "true")` is Verilog's `(* keep = "true" *)`.
    /// The registers of a synchronizer have `ASYNC_REG` without it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
    /// def!(late = m.reg(8).attribute("keep", "true"));
    /// late.next(i.word);
    /// #     ShownOut { late: *late }
    /// # };
    /// assert!(tilewright_gen::verilog(&design)[0].text.contains("(* keep = \"true\" *)"));
    /// ```
    #[track_caller]
    pub fn attribute(self, name: &str, value: &str) -> Reg {
        let loc = Loc::caller();
        if is_here(self.signal, self.signal.node, loc) {
            add(loc, name, value, |draft| &mut draft.registers[self.index].attributes);
        }
        self
    }
}

impl<B: Bundle> Reg<B> {
    /// Sets a synthesis attribute of the register of each field.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// bundle! { struct Pair<T> { low: T, high: T } }
    ///
    /// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
    /// def!(pair = m.reg(Pair { low: bits(4), high: bits(4) }).attribute("keep", "true"));
    /// pair.next(Pair { low: i.word.part(0, 4), high: i.word.part(4, 4) });
    /// #     ShownOut { late: pair.pack() }
    /// # };
    /// assert!(design.top().registers.iter().all(|register| register.attributes.len() == 1));
    /// ```
    #[track_caller]
    pub fn attribute(self, name: &str, value: &str) -> Reg<B> {
        for register in self.fields() {
            let _ = register.attribute(name, value);
        }
        self
    }
}

impl<V: Data> Mem<V> {
    /// Sets a synthesis attribute of this memory. `.attribute("ram_style", "block")`, for example, tells Xilinx'
    /// tools which kind of memory to use.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// Stores lines of a picture.
    ///     pub struct Lines;
    ///     in LinesIn { write: bit(), at: below(1024), pixel: bits(24) }
    ///     out LinesOut { shown: bits(24) }
    /// }
    ///
    /// impl Lines {
    ///     fn build(&self, m: Module, i: LinesIn) -> LinesOut {
    ///         def!(lines = m.memory(1024, 24, ReadUnderWrite::Any).attribute("ram_style", "block"));
    ///         lines.write(i.write, i.at, i.pixel);
    ///         LinesOut { shown: lines.read(i.at) }
    ///     }
    /// }
    /// # let design = elaborate(&Lines).unwrap();
    /// # assert!(tilewright_gen::verilog(&design)[0].text.contains("(* ram_style = \"block\" *)"));
    /// ```
    #[track_caller]
    pub fn attribute(self, name: &str, value: &str) -> Mem<V> {
        let index = self.index as usize;
        add(Loc::caller(), name, value, |draft| &mut draft.memories[index].memory.attributes);
        self
    }
}

fn add(loc: Loc, name: &str, value: &str, to: impl Fn(&mut Draft) -> &mut Vec<Attribute>) {
    elaboration::with(|e| {
        let attributes = to(e.draft());
        match wrong(attributes, name, value, loc) {
            Some(problem) => e.report(problem),
            None => attributes.push(Attribute { name: name.to_owned(), value: value.to_owned() }),
        }
    });
}

/// What is wrong with an attribute beside those that are known.
pub(crate) fn wrong(known: &[Attribute], name: &str, value: &str, loc: Loc) -> Option<Problem> {
    if let Some(problem) = illegal("an attribute", name, loc) {
        return Some(problem);
    }
    let (mistake, message, help) = if value.contains("*)") {
        let message = format!("the value of the attribute `{name}` would end it: `{value}`");
        (Mistake::AttributeEnd, message, "an attribute of Verilog ends at `*)`, even within a string")
    } else if known.iter().any(|known| known.name == name) {
        (Mistake::GivenTwice, format!("the attribute `{name}` is given twice"), "give it once")
    } else {
        return None;
    };
    Some(Problem::new(mistake, loc, message).help(help))
}

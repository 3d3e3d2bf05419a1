//! Steps that are tables of records: small programs.

use super::form::Colour;
use super::records::Pair;
use super::{Builder, Kind};
use crate::features::Feature;
use crate::spec::*;
use tilewright_hdl::*;

bundle! {
    /// What a word of the table says.
    struct Instruction<T> { opcode: T, operand: T }
}

impl Builder<'_> {
    /// A table of instructions, of which the one that is read says what is done.
    pub fn rom(&mut self, d: usize, number: usize, rom: &Rom) {
        Feature::Rom.used();
        rom.operand.meaning.used(Feature::SignedField, Feature::CodeField);
        let layout = Instruction { opcode: one_of::<Colour>(), operand: rom.operand.layout() };
        let words = rom.words.iter().map(|[opcode, operand]| Instruction {
            opcode: Meaning::Code.constant(*opcode, 1),
            operand: rom.operand.meaning.constant(*operand, rom.operand.width),
        });
        let name = self.namer.draw_with(&format!("q{number}"), Kind::Inner, &["_read".to_owned()]);
        let program = self.on(d).rom(&name, layout, words);
        let address = self.pick_fit(d, rom.address, program.address_width());
        let found = if rom.asynchronous { program.read_async(address) } else { program.read(address) };
        let chosen = rom.chosen.map(|pick| self.pick_fit(d, pick, rom.operand.width()));
        let chosen = chosen.map(|signal| rom.operand.meaning.made_of(signal));
        Feature::ChooseARecord.used();
        let result: Pair = found.opcode.choose(|opcode: Colour| match opcode {
            Colour::Red => Pair { low: found.operand, high: chosen[0] },
            Colour::Green => Pair { low: rom.operand.meaning.changed(found.operand), high: chosen[1] },
            Colour::Blue => Pair { low: chosen[0], high: found.operand },
            Colour::White => Pair { low: chosen[1], high: chosen[2] },
            Colour::Black => Pair { low: chosen[2], high: chosen[0] },
        });
        [result.low, result.high].into_iter().for_each(|signal| self.push(d, signal));
    }
}

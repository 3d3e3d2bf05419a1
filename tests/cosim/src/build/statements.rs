//! Steps that state something, look back, or choose by codes of an enum; and memories whose words are written in parts.

use super::form::Colour;
use super::records::Pair;
use super::{Builder, Kind};
use crate::batch::SHOWN;
use crate::features::Feature;
use crate::spec::*;
use tilewright_hdl::*;

impl Builder<'_> {
    /// States what always holds, or counts what may happen.
    pub fn state(&mut self, d: usize, number: usize, statement: Statement, of: Pick) {
        let (m, signal) = (self.on(d), self.pick(d, of));
        let all_ones = Bits::ones(signal.width());
        match statement {
            Statement::Assert => m.assert(signal.le(all_ones), "a value is at most all ones"),
            Statement::Assume => m.assume(signal.le(all_ones), "a value is at most all ones"),
            Statement::Cover(pattern) => m.cover(&format!("cover {number}"), signal.eq(pattern.bits(signal.width()))),
            Statement::Rises => m.cover(&format!("rise {number}"), m.rose(signal.bit(0))),
            Statement::Falls => m.cover(&format!("fall {number}"), m.fell(signal.msb())),
            Statement::Displayed => {
                Feature::Displayed.used();
                let text = format!("{SHOWN}{} {number}: {{}} {{:x}} {{:b}} {{}}", self.block.prefix);
                m.display(signal.bit(0), &text, &[signal, signal, m.past(signal), signal.signed()]);
            }
            Statement::Past(edges) => {
                let (mut past, mut held) = (signal, signal);
                for edge in 0..=edges {
                    past = m.past(past);
                    let name = self.inner_name(&format!("h{number}_{edge}"));
                    held = m.pipe(&name, held);
                }
                // Whatever they hold at first, which is not the same.
                m.assert(past.eq(held), "a past value is what was");
                m.assert(m.stable(signal) | signal.ne(m.past(signal)), "a value changes, or does not");
                self.push(d, past);
            }
        }
    }

    /// A register of an enum's codes, and what is chosen by it, and by bits that may be no code.
    pub fn coded(&mut self, d: usize, number: usize, coded: &Coded) {
        let name = self.inner_name(&format!("k{number}"));
        let code = |pick: &u8| Colour::of(u64::from(*pick));
        let register = self.on(d).reg(&name, one_of::<Colour>());
        let register = match coded.begins_with_reset {
            true => register.reset(code(&coded.first)),
            false => register.initial(code(&coded.first)),
        };
        let arms = coded.updates.iter().map(|(when, to)| (self.pick_fit(d, *when, 1), code(to))).collect::<Vec<_>>();
        register.next(select(arms, *register));
        let width = self.pick(d, coded.chosen[0]).width();
        let chosen = coded.chosen.map(|pick| self.pick_fit(d, pick, width));
        let raw = self.pick_fit(d, coded.raw, 3).code::<Colour>();
        for subject in [*register, raw] {
            if coded.records {
                Feature::ChooseARecord.used();
                let pair: Pair = choose!(subject, Colour {
                    Red => Pair { low: chosen[0], high: chosen[1] },
                    Green | White => Pair { low: chosen[1], high: !chosen[2] },
                    _ => Pair { low: chosen[2], high: lit(width, 1) },
                });
                [pair.low, pair.high].into_iter().for_each(|signal| self.push(d, signal));
            } else {
                Feature::ChooseASignal.used();
                let value = subject.choose(|colour: Colour| chosen[colour.code() as usize % chosen.len()]);
                self.push(d, value);
            }
        }
        Feature::Is.used();
        self.push(d, register.is(code(&coded.first)));
        Feature::IsCode.used();
        self.push(d, raw.is_code());
    }

    /// A memory of words in parts, each with an enable of its own.
    pub fn parts(&mut self, d: usize, number: usize, parts: &InParts) {
        let InParts { parts: count, form, depth, asynchronous, ports: [enables, write_at, data, read_at] } = *parts;
        form.meaning.used(Feature::SignedWord, Feature::CodeWord);
        let name = self.namer.draw_with(&format!("p{number}"), Kind::Inner, &["_read".to_owned()]);
        let words = self.on(d).memory(&name, depth, form.layout().of(row(count)), ReadUnderWrite::Old);
        let address = words.address_width();
        let [write_at, read_at] = [write_at, read_at].map(|pick| self.pick_fit(d, pick, address));
        let enables = self.pick_fit(d, enables, count).unpack(row(count));
        let data = form.meaning.made_of(self.pick_fit(d, data, count * form.width()).unpack(row(count)));
        words.write(enables, write_at, data);
        let word = if asynchronous { words.read_async(read_at) } else { words.read(read_at) };
        self.push(d, word.pack());
    }
}

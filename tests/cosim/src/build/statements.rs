//! Steps that state something, look back, or hold codes of an enum; and memories whose words are written in parts.

use super::{Builder, Kind};
use crate::spec::*;
use tilewright_hdl::*;

codes! {
    /// Fewer codes than three bits have.
    enum Colour { Red, Green, Blue, White, Black }
}

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
        let code = |pick: &u8| Colour::ALL[usize::from(*pick) % Colour::ALL.len()];
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
            let value = subject.choose(|colour: Colour| chosen[colour.code() as usize % chosen.len()]);
            self.push(d, value);
        }
        self.push(d, raw.is_code());
    }

    /// A register with a value at power-on.
    pub fn power_on(&mut self, d: usize, number: usize, initial: Pattern, reset: Option<Pattern>, next: Pick) {
        let name = self.inner_name(&format!("o{number}"));
        let next = self.pick(d, next);
        let width = next.width();
        let register = self.on(d).reg(&name, width).initial(initial.bits(width));
        let register = reset.map_or(register, |reset| register.reset(reset.bits(width)));
        register.next(next);
        self.push(d, *register);
    }

    /// A memory of words in parts, each with an enable of its own.
    pub fn parts(&mut self, d: usize, number: usize, parts: &InParts) {
        let InParts { parts: count, width, depth, asynchronous, ports: [enables, write_at, data, read_at] } = *parts;
        let name = self.namer.draw_with(&format!("p{number}"), Kind::Inner, &["_read".to_owned()]);
        let words = self.on(d).memory(&name, depth, bits(width).of(row(count)), ReadUnderWrite::Old);
        let address = words.address_width();
        let [write_at, read_at] = [write_at, read_at].map(|pick| self.pick_fit(d, pick, address));
        let enables = self.pick_fit(d, enables, count).unpack(row(count));
        let data = self.pick_fit(d, data, count * width).unpack(row(count));
        words.write(enables, write_at, data);
        let word = if asynchronous { words.read_async(read_at) } else { words.read(read_at) };
        self.push(d, word.pack());
    }
}

//! Value changes as the bytes of a waveform file.
//!
//! The form is that of IEEE 1364-2001, section 18.2: `#TIME`, and then a line for each variable that changes there. The
//! `vcd` crate, which writes the header, formats digit by digit and would take most of the time of a traced run.

use vcd::IdCode;

/// A variable's identifier with the end of its line, ready to be copied.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Id {
    pub code: IdCode,
    /// The characters, the first in the lowest byte.
    word: u64,
    length: usize,
}

impl Id {
    /// The longest identifier, so that a scalar's value or the space before it fits into the word too.
    const LONGEST: usize = 6;

    /// # Panics
    ///
    /// There are more than 94^6 variables.
    pub fn new(code: IdCode) -> Id {
        let line = format!("{code}\n");
        assert!(line.len() <= Id::LONGEST + 1, "`{code}` is the identifier of a variable beyond the 94^6th");
        let word = line.bytes().rev().fold(0, |word, byte| word << 8 | u64::from(byte));
        Id { code, word, length: line.len() }
    }
}

/// Value changes in memory, in order of time.
#[derive(Debug, Default)]
pub(super) struct Changes {
    bytes: Vec<u8>,
    /// The last time that was written.
    time: Option<u64>,
}

impl Changes {
    /// The text since the last [`Changes::clear`].
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Forgets the text, but not the time.
    pub fn clear(&mut self) {
        self.bytes.clear();
    }

    /// What follows happens at this time.
    pub fn at(&mut self, time: u64) {
        if self.time.replace(time) == Some(time) {
            return;
        }
        let mut line = *b"#00000000000000000000\n";
        let mut first = line.len() - 1;
        let mut rest = time;
        loop {
            first -= 1;
            line[first] = b'0' + (rest % 10) as u8;
            rest /= 10;
            if rest == 0 {
                break;
            }
        }
        line[first - 1] = b'#';
        self.bytes.extend_from_slice(&line[first - 1..]);
    }

    /// A command such as `$dumpvars`.
    pub fn command(&mut self, command: &str) {
        self.bytes.extend_from_slice(command.as_bytes());
        self.bytes.push(b'\n');
    }

    /// A variable of 1 bit.
    pub fn bit(&mut self, id: Id, high: bool) {
        self.end(b'0' + u8::from(high), id);
    }

    /// A variable of several bits, from its limbs, the lowest first; leading zeros are left out.
    pub fn bits(&mut self, id: Id, limbs: &[u64]) {
        let top = limbs.iter().rposition(|&limb| limb != 0).unwrap_or(0);
        self.bytes.push(b'b');
        self.digits(limbs[top], u64::BITS - (limbs[top] | 1).leading_zeros());
        limbs[..top].iter().rev().for_each(|&limb| self.digits(limb, u64::BITS));
        self.end(b' ', id);
    }

    /// A string variable.
    pub fn string(&mut self, id: Id, text: &str) {
        self.bytes.push(b's');
        self.bytes.extend_from_slice(text.as_bytes());
        self.end(b' ', id);
    }

    /// The lowest `count` digits of a number, at least one, the highest first.
    fn digits(&mut self, number: u64, count: u32) {
        let end = self.bytes.len() + count as usize;
        let mut rest = number << (u64::BITS - count);
        for _ in 0..count.div_ceil(8) {
            self.bytes.extend_from_slice(&digits((rest >> 56) as u8));
            rest <<= 8;
        }
        self.bytes.truncate(end);
    }

    /// A character and the identifier: a copy of fixed size, of which the part in use is kept, is the fastest.
    fn end(&mut self, before: u8, id: Id) {
        let end = self.bytes.len() + 1 + id.length;
        self.bytes.extend_from_slice(&(id.word << 8 | u64::from(before)).to_le_bytes());
        self.bytes.truncate(end);
    }
}

/// The eight binary digits of a byte, the highest first.
fn digits(byte: u8) -> [u8; 8] {
    /// A one in every byte.
    const ONES: u64 = 0x0101_0101_0101_0101;
    // Character i keeps bit 7 - i; adding 0x7f carries what is not zero into the highest bit of its byte, never further.
    let bits = (u64::from(byte) * ONES) & 0x0102_0408_1020_4080;
    let digits = ((bits + 0x7f * ONES) >> 7) & ONES;
    (digits | (u64::from(b'0') * ONES)).to_le_bytes()
}

#[cfg(test)]
mod tests {
    use proptest::collection::vec;
    use proptest::prelude::*;
    use tilewright_hdl::{limbs_for, top_mask};
    use vcd::{Command, Parser, Value};

    use super::*;

    /// What a variable changes to.
    #[derive(Debug, Clone)]
    enum New {
        Bit(bool),
        /// The width, and limbs with zeros above it.
        Bits(u32, Vec<u64>),
        State(String),
    }

    fn new() -> impl Strategy<Value = New> {
        let limb = prop_oneof![Just(0), Just(1), Just(u64::MAX), any::<u64>(), any::<u64>().prop_map(|it| it >> 40)];
        let bits = (2..=130_u32, vec(limb, 3)).prop_map(|(width, mut limbs)| {
            limbs.truncate(limbs_for(width));
            *limbs.last_mut().unwrap() &= top_mask(width);
            New::Bits(width, limbs)
        });
        prop_oneof![any::<bool>().prop_map(New::Bit), bits, "[A-Za-z_][A-Za-z0-9_]{0,30}".prop_map(New::State)]
    }

    /// A variable whose identifier has one to four characters.
    fn variable() -> impl Strategy<Value = IdCode> {
        prop_oneof![0..94_u64, 0..9_000_u64, 0..80_000_000_u64].prop_map(IdCode::from)
    }

    fn write(text: &mut Changes, variable: IdCode, new: &New) {
        let id = Id::new(variable);
        match new {
            New::Bit(high) => text.bit(id, *high),
            New::Bits(_, limbs) => text.bits(id, limbs),
            New::State(name) => text.string(id, name),
        }
    }

    /// The command that is to be read: a vector begins with its highest one, or is a single zero.
    fn expected(variable: IdCode, new: &New) -> Command {
        match new {
            New::Bit(high) => Command::ChangeScalar(variable, Value::from(*high)),
            New::Bits(width, limbs) => {
                let highest = (0..*width).rev().find(|&bit| crate::limbs::bit(limbs, bit)).unwrap_or(0);
                let digits = (0..=highest).rev().map(|bit| Value::from(crate::limbs::bit(limbs, bit)));
                Command::ChangeVector(variable, digits.collect::<Vec<_>>().into())
            }
            New::State(name) => Command::ChangeString(variable, name.clone()),
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn a_parser_reads_the_changes_that_were_written(
            steps in vec((1..u64::MAX / 64, vec((variable(), new()), 0..12)), 1..24),
        ) {
            let (mut text, mut time, mut commands) = (Changes::default(), 0, Vec::new());
            for (later, changes) in &steps {
                text.at(time);
                commands.push(Command::Timestamp(time));
                for (variable, new) in changes {
                    // The same time again is not written again.
                    text.at(time);
                    write(&mut text, *variable, new);
                    commands.push(expected(*variable, new));
                }
                time += later;
            }
            let read: Vec<Command> = Parser::new(text.bytes()).map(|command| command.unwrap()).collect();
            prop_assert_eq!(read, commands);
        }
    }

    #[test]
    fn a_number_has_no_leading_zeros() {
        let mut text = Changes::default();
        text.command("$dumpvars");
        text.at(u64::MAX);
        for limbs in [&[0, 0][..], &[1, 0], &[0, 1], &[u64::MAX]] {
            text.bits(Id::new(IdCode::FIRST), limbs);
        }
        let (zeros, ones) = ("0".repeat(64), "1".repeat(64));
        let expected = format!("$dumpvars\n#18446744073709551615\nb0 !\nb1 !\nb1{zeros} !\nb{ones} !\n");
        assert_eq!(String::from_utf8_lossy(text.bytes()), expected);
    }
}

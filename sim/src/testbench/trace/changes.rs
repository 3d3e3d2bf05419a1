//! Value changes as the bytes of a waveform file.
//!
//! The format is that of IEEE 1364-2001, section 18.2: `#TIME`, and then a line for each variable that changes there.
//! The `vcd` crate, which writes the header, formats digit by digit and would dominate the time of a traced run.

use vcd::IdCode;

use super::sink::BLOCK;
use super::times::Times;

/// A variable's identifier with the end of its line, ready to be copied.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Id {
    pub code: IdCode,
    /// Variables are numbered from 0 in the sequence of the header.
    pub number: u32,
    /// The characters, the first in the lowest byte.
    word: u64,
    length: usize,
}

impl Id {
    /// A number has at most five characters, so that a scalar's value or the space before it fits in the word too.
    pub fn new(number: u32) -> Id {
        let code = IdCode::from(number);
        let line = format!("{code}\n");
        let word = line.bytes().rev().fold(0, |word, byte| word << 8 | u64::from(byte));
        Id { code, number, word, length: line.len() }
    }
}

/// The precomputed line format of a variable of up to 32 bits that is not a string. Most variables are such, and each
/// line is assembled without an unpredictable branch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Short {
    /// The characters after the digits.
    after: u64,
    after_length: u32,
    /// The number of characters before the digits, which a scalar does not have.
    before: u32,
}

impl Short {
    /// The lines of a scalar or of a vector.
    pub fn new(id: Id, is_scalar: bool) -> Short {
        match is_scalar {
            true => Short { after: id.word, after_length: id.length as u32, before: 0 },
            false => Short { after: id.word << 8 | u64::from(b' '), after_length: id.length as u32 + 1, before: 1 },
        }
    }
}

/// Value changes in memory, in the sequence of time.
///
/// Most of the time of a traced run is spent on these lines, a few bytes each. So they are assembled from copies of
/// fixed size, and each copy overwrites the unused end of the previous one. The room in the buffer is checked only
/// once for each line.
#[derive(Debug, Default)]
pub(super) struct Changes {
    /// The text, and free space after it.
    bytes: Vec<u8>,
    /// The end of the text.
    end: usize,
    /// The last time that was written.
    time: Option<u64>,
    times: Times,
}

/// The eight binary digits of each byte, the highest first.
const DIGITS: [[u8; 8]; 256] = {
    let mut all = [[b'0'; 8]; 256];
    let mut place = 0;
    while place < 256 * 8 {
        let (byte, digit) = (place / 8, place % 8);
        all[byte][digit] += ((byte >> (7 - digit)) & 1) as u8;
        place += 1;
    }
    all
};

/// The room for the line of a number of up to 64 bits and for the unused ends of its copies.
pub(super) const LINE: usize = 80;

impl Changes {
    /// The text since the last [`Changes::clear`].
    pub fn bytes(&self) -> &[u8] {
        &self.bytes[..self.end]
    }

    /// Clears the text, but keeps the time.
    pub fn clear(&mut self) {
        self.end = 0;
    }

    /// Exchanges the text, with its length, for another buffer.
    pub fn exchange(&mut self, take: impl FnOnce(Vec<u8>, usize) -> Vec<u8>) {
        self.bytes = take(std::mem::take(&mut self.bytes), self.end);
        self.clear();
    }

    /// The free space at the end.
    #[inline]
    fn room(&mut self) -> &mut [u8; LINE] {
        self.reserve(LINE);
        self.bytes[self.end..].first_chunk_mut().expect("it has just grown")
    }

    /// Makes room for `more` bytes at the end.
    fn reserve(&mut self, more: usize) {
        if self.bytes.len() < self.end + more {
            self.grow(more);
        }
    }

    #[cold]
    fn grow(&mut self, more: usize) {
        // Zeros from the system take no time before they are written.
        let mut larger = vec![0; (2 * self.bytes.len()).max(self.end + more)];
        larger[..self.end].copy_from_slice(self.bytes());
        self.bytes = larger;
    }

    /// Text of any length.
    fn text(&mut self, text: &[u8]) {
        for part in text.chunks(LINE) {
            self.room()[..part.len()].copy_from_slice(part);
            self.end += part.len();
        }
    }

    /// Sets the time of the following changes.
    pub fn at(&mut self, time: u64) {
        if self.time != Some(time) {
            self.time = Some(time);
            self.reserve(LINE);
            let line = self.bytes[self.end..].first_chunk_mut().expect("there is room");
            self.end += self.times.put(line, time);
        }
    }

    /// Writes the new values of those short variables that have a bit in `which`.
    #[inline]
    pub fn shorts(&mut self, which: u64, all: &[Short; BLOCK], limbs: &[u64; BLOCK]) {
        self.reserve(LINE * BLOCK);
        let (mut rest, mut end) = (which, self.end);
        while rest != 0 {
            let place = rest.trailing_zeros() as usize % BLOCK;
            rest &= rest - 1;
            let line = self.bytes[end..].first_chunk_mut().expect("there is room for all");
            end += put_short(line, all[place], limbs[place] as u32);
        }
        self.end = end;
    }

    /// A command such as `$dumpvars`.
    pub fn command(&mut self, command: &str) {
        self.text(command.as_bytes());
        self.text(b"\n");
    }

    /// A variable of 1 bit.
    #[inline]
    pub fn bit(&mut self, id: Id, high: bool) {
        self.end += put_end(self.room(), 0, b'0' + u8::from(high), id);
    }

    /// A variable of several bits, from its limbs, the lowest first; leading zeros are omitted.
    #[inline]
    pub fn bits(&mut self, id: Id, limbs: &[u64]) {
        let &[limb] = limbs else { return self.wide(id, limbs) };
        let line = self.room();
        line[0] = b'b';
        let digits = put_digits(line, 1, limb, u64::BITS - (limb | 1).leading_zeros());
        self.end += put_end(line, 1 + digits, b' ', id);
    }

    /// Like [`Changes::bits`], for any number of limbs.
    fn wide(&mut self, id: Id, limbs: &[u64]) {
        let top = limbs.iter().rposition(|&limb| limb != 0).unwrap_or(0);
        self.text(b"b");
        for (index, &limb) in limbs[..=top].iter().enumerate().rev() {
            let leading = if index == top { (limb | 1).leading_zeros() } else { 0 };
            self.end += put_digits(self.room(), 0, limb, u64::BITS - leading);
        }
        self.end += put_end(self.room(), 0, b' ', id);
    }

    /// A string variable.
    pub fn string(&mut self, id: Id, text: &str) {
        self.text(b"s");
        self.text(text.as_bytes());
        self.end += put_end(self.room(), 0, b' ', id);
    }
}

/// Writes the line of a new value there; returns its length.
#[inline]
fn put_short(line: &mut [u8; LINE], of: Short, number: u32) -> usize {
    let before = (of.before & 1) as usize;
    let leading = (number | 1).leading_zeros();
    line[0] = b'b';
    put_bytes(line, before, &(number << leading).to_be_bytes());
    // It is less than 64 anyway; the remainder avoids a bounds check.
    let after = (before + (u32::BITS - leading) as usize) % 64;
    line[after..after + 8].copy_from_slice(&of.after.to_le_bytes());
    after + of.after_length as usize
}

/// Writes the lowest `count` digits of a number there, at least one, the highest first; returns how many were
/// written.
#[inline]
fn put_digits(line: &mut [u8; LINE], at: usize, number: u64, count: u32) -> usize {
    let rest = number << (u64::BITS - count);
    let bytes = rest.to_be_bytes();
    // Half of them, or all: the number in use is hard to predict, and more branches would take longer than the
    // digits.
    let (high, low) = bytes.split_at(4);
    put_bytes(line, at, high);
    if count > 32 {
        put_bytes(line, at + 32, low);
    }
    count as usize
}

/// Writes the digits of four bytes there.
#[inline]
fn put_bytes(line: &mut [u8; LINE], at: usize, bytes: &[u8]) {
    let places = line[at..at + 32].chunks_exact_mut(8);
    places.zip(bytes).for_each(|(place, &byte)| place.copy_from_slice(&DIGITS[usize::from(byte)]));
}

/// Writes a character and the identifier there; returns the end of the line.
#[inline]
fn put_end(line: &mut [u8; LINE], at: usize, before: u8, id: Id) -> usize {
    line[at..at + 8].copy_from_slice(&(id.word << 8 | u64::from(before)).to_le_bytes());
    at + 1 + id.length
}

#[cfg(test)]
mod tests {
    use proptest::collection::vec;
    use proptest::prelude::*;
    use tilewright_circuit::{limbs_for, top_mask};
    use vcd::{Command, Parser, Value};

    use super::*;

    /// The new value of a variable.
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
    fn variable() -> impl Strategy<Value = Id> {
        prop_oneof![0..94_u32, 0..9_000_u32, 0..80_000_000_u32].prop_map(Id::new)
    }

    /// Writes a line, as a short variable if `together`.
    fn write(text: &mut Changes, id: Id, new: &New, together: bool) {
        match new {
            New::Bit(high) if together => short(text, Short::new(id, true), u64::from(*high)),
            New::Bit(high) => text.bit(id, *high),
            New::Bits(..=32, limbs) if together => short(text, Short::new(id, false), limbs[0]),
            New::Bits(_, limbs) => text.bits(id, limbs),
            New::State(name) => text.string(id, name),
        }
    }

    fn short(text: &mut Changes, of: Short, limb: u64) {
        text.shorts(1 << 5, &[of; BLOCK], &[limb; BLOCK]);
    }

    /// The expected command: a vector begins with its highest one, or is a single zero.
    fn expected(variable: IdCode, new: &New) -> Command {
        match new {
            New::Bit(high) => Command::ChangeScalar(variable, Value::from(*high)),
            New::Bits(width, limbs) => {
                let highest = (0..*width).rev().find(|&bit| tilewright_circuit::limbs::bit(limbs, bit)).unwrap_or(0);
                let digits = (0..=highest).rev().map(|bit| Value::from(tilewright_circuit::limbs::bit(limbs, bit)));
                Command::ChangeVector(variable, digits.collect::<Vec<_>>().into())
            }
            New::State(name) => Command::ChangeString(variable, name.clone()),
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn a_parser_reads_the_changes_that_were_written(
            steps in vec((prop_oneof![1..1_u64 << 20, 1..u64::MAX / 64], vec((variable(), new(), any::<bool>()), 0..12)), 1..24),
        ) {
            let (mut text, mut time, mut commands) = (Changes::default(), 0, Vec::new());
            for (later, changes) in &steps {
                text.at(time);
                commands.push(Command::Timestamp(time));
                for (variable, new, together) in changes {
                    // An unchanged time is not written again.
                    text.at(time);
                    write(&mut text, *variable, new, *together);
                    commands.push(expected(variable.code, new));
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
            text.bits(Id::new(0), limbs);
        }
        let (zeros, ones) = ("0".repeat(64), "1".repeat(64));
        let expected = format!("$dumpvars\n#18446744073709551615\nb0 !\nb1 !\nb1{zeros} !\nb{ones} !\n");
        assert_eq!(String::from_utf8_lossy(text.bytes()), expected);
    }
}

//! The changes that a testbench makes, in sequence and packed. One of a narrow input takes 4 bytes.
//!
//! A testbench that sets an input in each clock makes many changes, and new memory for them takes longer than all else.

use std::borrow::Cow;

/// An entry of the log has the value in its low bits, above it whether it comes a stride after the change before, and
/// above that the input. Without a stride it comes at the same time.
const VALUE_BITS: u32 = 20;
const STRIDE: u32 = 1 << VALUE_BITS;
const PORT_SHIFT: u32 = VALUE_BITS + 1;
/// In place of the value: the next two entries are the value.
const LONG: u64 = (1 << VALUE_BITS) - 1;
/// In place of the input: the value, as the upper bits, and the next entry are the stride from now on, and that of the
/// change in the entry after it.
const STRIDES: u32 = u32::MAX >> PORT_SHIFT;
/// In place of the input: the change is one of the others.
const OTHER: u32 = STRIDES - 1;

/// What a testbench changes.
#[derive(Debug, Clone)]
pub(crate) enum Change {
    /// An input, by number, that has one limb.
    Input(u32, u64),
    /// A wide input.
    Wide(Box<(u32, Vec<u64>)>),
    /// Whether the reset of a clock is active.
    Reset(u32, bool),
    /// A word of a memory, at a lane and an address.
    Word(Box<([u32; 3], Vec<u64>)>),
}

impl Change {
    /// An input of any width.
    pub fn of_input(port: u32, limbs: &[u64]) -> Change {
        if let [limb] = limbs { Change::Input(port, *limb) } else { Change::Wide(Box::new((port, limbs.to_vec()))) }
    }

    /// Its bytes among the others, about.
    fn bytes(&self) -> usize {
        size_of::<(u64, Change)>()
            + match self {
                Change::Wide(wide) => size_of_val(&**wide) + size_of_val(&wide.1[..]),
                Change::Word(word) => size_of_val(&**word) + size_of_val(&word.1[..]),
                Change::Input(..) | Change::Reset(..) => 0,
            }
    }
}

/// The changes, each with its time.
pub(super) struct Log {
    entries: Vec<u32>,
    /// The changes that fit no entry, each with its time. Each has an entry, too.
    others: Vec<(u64, Change)>,
    /// The time of the last change, or else of the beginning.
    time: u64,
    /// The picoseconds of a stride.
    stride: u64,
}

/// The entry of an input, which comes at once or a stride after the change before.
fn entry(port: u32, since: u64, value: u64) -> u32 {
    port << PORT_SHIFT | if since == 0 { 0 } else { STRIDE } | value as u32
}

/// A place between two changes of a log.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    entry: usize,
    other: usize,
    /// The time of the change before it, or else of the beginning.
    pub time: u64,
    stride: u64,
}

impl Place {
    /// The same place, where what was before another one is forgotten.
    pub fn without(self, gone: Place) -> Place {
        Place { entry: self.entry - gone.entry, other: self.other - gone.other, ..self }
    }
}

impl Log {
    /// The bytes of an entry.
    pub const ENTRY: usize = size_of::<u32>();

    /// An empty one that begins at this time.
    pub fn from(time: u64) -> Log {
        Log { entries: Vec::new(), others: Vec::new(), time, stride: 0 }
    }

    /// The number of entries.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Its end.
    pub fn end(&self) -> Place {
        Place { entry: self.entries.len(), other: self.others.len(), time: self.time, stride: self.stride }
    }

    /// Adds a change that comes after the others, and returns the bytes that it takes beside an entry.
    #[inline]
    pub fn push(&mut self, time: u64, change: Change) -> usize {
        let since = time - self.time;
        match change {
            Change::Input(port, value) if port < OTHER && value < LONG && (since == 0 || since == self.stride) => {
                self.time = time;
                self.entries.push(entry(port, since, value));
                0
            }
            change => self.push_other(time, change),
        }
    }

    #[cold]
    fn push_other(&mut self, time: u64, change: Change) -> usize {
        let (since, count) = (time - self.time, self.entries.len());
        self.time = time;
        match change {
            Change::Input(port, value) if port < OTHER && since >> (32 + VALUE_BITS) == 0 => {
                if since != 0 && since != self.stride {
                    self.stride = since;
                    self.entries.extend([STRIDES << PORT_SHIFT | (since >> 32) as u32, since as u32]);
                }
                self.entries.push(entry(port, since, value.min(LONG)));
                if value >= LONG {
                    self.entries.extend([(value >> 32) as u32, value as u32]);
                }
                (self.entries.len() - count - 1) * Log::ENTRY
            }
            change => {
                let bytes = change.bytes();
                self.entries.push(OTHER << PORT_SHIFT);
                self.others.push((time, change));
                bytes
            }
        }
    }

    /// The change after a place, and the place after it, which has its time.
    pub fn after(&self, mut place: Place) -> Option<(Cow<'_, Change>, Place)> {
        let mut entry = self.entry(&mut place)?;
        if entry >> PORT_SHIFT == OTHER {
            let (time, change) = &self.others[place.other];
            return Some((Cow::Borrowed(change), Place { other: place.other + 1, time: *time, ..place }));
        }
        if entry >> PORT_SHIFT == STRIDES {
            place.stride = u64::from(entry & LONG as u32) << 32 | u64::from(self.entry(&mut place)?);
            entry = self.entry(&mut place)?;
        }
        if entry & STRIDE != 0 {
            place.time += place.stride;
        }
        let mut value = u64::from(entry) & LONG;
        if value == LONG {
            value = u64::from(self.entry(&mut place)?) << 32 | u64::from(self.entry(&mut place)?);
        }
        Some((Cow::Owned(Change::Input(entry >> PORT_SHIFT, value)), place))
    }

    /// The entry after a place, which moves behind it.
    fn entry(&self, place: &mut Place) -> Option<u32> {
        place.entry += 1;
        self.entries.get(place.entry - 1).copied()
    }

    /// Forgets what comes after a place.
    pub fn truncate(&mut self, place: Place) {
        self.entries.truncate(place.entry);
        self.others.truncate(place.other);
        (self.time, self.stride) = (place.time, place.stride);
    }

    /// Forgets what comes before a place.
    pub fn forget(&mut self, place: Place) {
        self.entries.drain(..place.entry);
        self.others.drain(..place.other);
    }

    /// The bytes of the changes between two places.
    pub fn bytes(&self, from: Place, to: Place) -> usize {
        let others = self.others[from.other..to.other].iter().map(|(_, change)| change.bytes());
        size_of_val(&self.entries[from.entry..to.entry]) + others.sum::<usize>()
    }

    /// The last time up to `now` at which a word was set: a memory, a lane and an address.
    pub fn set_word(&self, word: [u32; 3], now: u64) -> Option<u64> {
        let count = self.others.partition_point(|(time, _)| *time <= now);
        let is_it = |change: &Change| matches!(change, Change::Word(set) if set.0 == word);
        self.others[..count].iter().rev().find(|(_, change)| is_it(change)).map(|(time, _)| *time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Inputs of all sizes at short and long distances, wide ones, resets and words.
    fn changes() -> Vec<(u64, Change)> {
        vec![
            (1_000, Change::Input(0, 0)),
            (1_000, Change::Input(OTHER - 1, LONG - 1)),
            (2_000, Change::Input(OTHER - 1, LONG)),
            (2_000, Change::Input(OTHER, 7)),
            (3_000, Change::Input(STRIDES, 8)),
            (4_000, Change::Input(1, 9)),
            (5_000, Change::Input(70_000, u64::MAX)),
            (5_500, Change::Input(3, u64::MAX)),
            (6_000, Change::Input(3, 1)),
            (7_000, Change::Input(2, 1 << 32)),
            (1 << 40, Change::Wide(Box::new((2, vec![5, 6])))),
            (1 << 40, Change::Reset(1, true)),
            (1 << 41, Change::Word(Box::new(([1, 2, 3], vec![9])))),
            ((1 << 41) + 500, Change::Input(1, 1)),
            ((1 << 42) + 7, Change::Input(1, 2)),
            (1 << 62, Change::Input(1, 3)),
        ]
    }

    fn told(log: &Log, mut place: Place) -> Vec<String> {
        let mut told = Vec::new();
        while let Some((change, after)) = log.after(place) {
            told.push(format!("{} {change:?}", after.time));
            place = after;
        }
        assert_eq!(place, log.end());
        told
    }

    #[test]
    fn a_log_gives_back_what_it_was_given_from_any_place_on() {
        let expected: Vec<String> = changes().iter().map(|(time, change)| format!("{time} {change:?}")).collect();
        for cut in 0..=expected.len() {
            let mut log = Log::from(1_000);
            let start = log.end();
            let mut bytes = 0;
            for (time, change) in &changes()[..cut] {
                bytes += Log::ENTRY + log.push(*time, change.clone());
            }
            let place = log.end();
            assert_eq!(log.bytes(start, place), bytes);
            for (time, change) in &changes()[cut..] {
                log.push(*time, change.clone());
            }
            assert_eq!(told(&log, start), expected);
            assert_eq!(told(&log, place), expected[cut..]);
            let mut short = Log::from(1_000);
            for (time, change) in changes() {
                short.push(time, change);
            }
            short.truncate(place);
            assert_eq!(told(&short, start), expected[..cut]);
            log.forget(place);
            assert_eq!(told(&log, place.without(place)), expected[cut..]);
        }
    }

    #[test]
    fn the_last_change_of_a_word_is_found_up_to_a_time() {
        let mut log = Log::from(0);
        for (time, change) in changes() {
            log.push(time, change);
        }
        assert_eq!(log.set_word([1, 2, 3], (1 << 41) - 1), None);
        assert_eq!(log.set_word([1, 2, 3], 1 << 42), Some(1 << 41));
        assert_eq!(log.set_word([1, 2, 4], 1 << 42), None);
    }
}

//! The first time at which two files differ.

use super::file::{Change, TEXT, Waves};
use super::names::Pair;

/// Two files in one unit of time.
pub struct Both<'a> {
    pub files: [&'a Waves; 2],
    pub pairs: &'a [Pair],
    /// A time of a file is so many units.
    scales: [u64; 2],
    /// The unit is 10^`exponent` seconds: one with a name.
    pub exponent: i32,
}

/// The values of both files from one time on.
pub struct State<'a> {
    both: &'a Both<'a>,
    /// The next change of each file.
    next: [usize; 2],
    /// The last change of each variable.
    last: [Vec<Option<&'a Change>>; 2],
}

impl<'a> Both<'a> {
    /// Two files, compared in these signals.
    pub fn new(files: [&'a Waves; 2], pairs: &'a [Pair]) -> Both<'a> {
        let exponent = files.map(|file| file.exponent.div_euclid(3) * 3).into_iter().min().unwrap_or(-12);
        let scales = files.map(|file| 10_u64.saturating_pow((file.exponent - exponent) as u32));
        Both { files, pairs, scales, exponent }
    }

    /// The times that both files have, in units.
    pub fn times(&self) -> (u64, u64) {
        let begins =
            [0, 1].map(|side| self.files[side].changes.first().map_or(0, |change| self.time(side, change.time)));
        let ends = [0, 1].map(|side| self.time(side, self.files[side].end));
        (begins[0].max(begins[1]), ends[0].min(ends[1]))
    }

    /// A time of a file in units.
    pub fn time(&self, side: usize, time: u64) -> u64 {
        time.saturating_mul(self.scales[side])
    }

    /// Nothing is known yet.
    pub fn start(&'a self) -> State<'a> {
        State { both: self, next: [0; 2], last: self.files.map(|file| vec![None; file.variables]) }
    }

    /// The first time at which both files are known and differ.
    pub fn first_difference(&self) -> Option<u64> {
        let (begin, end) = self.times();
        let mut walk = Walk::new(self);
        if walk.differs_at(begin) {
            return Some(begin);
        }
        // What changes where a file ends is no longer in it. If both end there, both have it.
        let ends = [0, 1].map(|side| self.time(side, self.files[side].end));
        while let Some(time) = walk.state.next_time().filter(|time| *time < end || *time == end && ends[0] == ends[1]) {
            if walk.differs_at(time) {
                return Some(time);
            }
        }
        None
    }

    /// The first of these times, in sequence, just before which both files are known and differ, by its place.
    pub fn first_difference_before(&self, times: &[u64]) -> Option<usize> {
        let mut walk = Walk::new(self);
        times.iter().position(|time| walk.differs_at(time.saturating_sub(1)))
    }
}

/// Two files that are compared from time to time.
struct Walk<'a> {
    state: State<'a>,
    /// For each variable of each file, its pairs.
    pairs: [Vec<Vec<usize>>; 2],
}

impl<'a> Walk<'a> {
    fn new(both: &'a Both<'a>) -> Walk<'a> {
        let mut pairs = [0, 1].map(|side| vec![Vec::new(); both.files[side].variables]);
        for (number, pair) in both.pairs.iter().enumerate() {
            (0..2).for_each(|side| pairs[side][pair.variables[side] as usize].push(number));
        }
        Walk { state: both.start(), pairs }
    }

    /// Goes to a time; whether a pair differs there that has changed on the way.
    fn differs_at(&mut self, time: u64) -> bool {
        let before = self.state.next;
        self.state.go_to(time);
        (0..2).any(|side| {
            let changes = &self.state.both.files[side].changes[before[side]..self.state.next[side]];
            let mut pairs = changes.iter().flat_map(|change| &self.pairs[side][change.variable as usize]);
            pairs.any(|number| self.state.differs(*number))
        })
    }
}

impl<'a> State<'a> {
    /// The time of the next change.
    pub fn next_time(&self) -> Option<u64> {
        let next = |side: usize| Some(self.both.time(side, self.both.files[side].changes.get(self.next[side])?.time));
        [next(0), next(1)].into_iter().flatten().min()
    }

    /// Takes all changes up to a time.
    pub fn go_to(&mut self, time: u64) {
        for side in 0..2 {
            let changes = &self.both.files[side].changes[self.next[side]..];
            for change in changes.iter().take_while(|change| self.both.time(side, change.time) <= time) {
                self.last[side][change.variable as usize] = Some(change);
                self.next[side] += 1;
            }
        }
    }

    /// The value of a pair's signal in a file, once there is one.
    pub fn value(&self, pair: usize, side: usize) -> Option<&'a [u8]> {
        let Pair { variables, lows, width, .. } = &self.both.pairs[pair];
        let value = self.both.files[side].value(self.last[side][variables[side] as usize]?);
        let end = value.len().saturating_sub(lows[side] as usize);
        let start = if *width == TEXT { 0 } else { end.saturating_sub(*width as usize) };
        Some(&value[start..end])
    }

    /// The number of bits of a pair's signal, or [`TEXT`].
    pub fn width(&self, pair: usize) -> u32 {
        self.both.pairs[pair].width
    }

    /// Whether the values of a pair differ. An unknown bit (x) is no difference.
    pub fn differs(&self, pair: usize) -> bool {
        let (Some(one), Some(other)) = (self.value(pair, 0), self.value(pair, 1)) else { return false };
        let is_bits = self.width(pair) != TEXT;
        let is_same = |(one, other): (&u8, &u8)| one == other || is_bits && [one, other].contains(&&b'x');
        one.len() != other.len() || !one.iter().zip(other).all(is_same)
    }
}

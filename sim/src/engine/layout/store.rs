//! A block of memory for generated code, seen from Rust as values.

use std::cell::Cell;

use super::Place;
use super::span::Span;
use super::words::{LINE, Words};

/// Zeros at first.
pub(crate) struct Store {
    words: Words,
    size: usize,
    guarded: bool,
}

impl Store {
    /// A block of this many bytes; if `guarded`, between protected pages.
    pub fn new(size: usize, guarded: bool) -> Store {
        let count = size.next_multiple_of(LINE) / 8;
        Store { words: if guarded { Words::guarded(count) } else { Words::plain(count) }, size, guarded }
    }

    /// Grows it to at least this size; it may move.
    pub fn grow(&mut self, size: usize) {
        if size > self.size {
            // With guards, exactly this size, so that its end stays at the guard.
            let larger = Store::new(if self.guarded { size } else { size.max(2 * self.size) }, self.guarded);
            larger.words.iter().zip(&*self.words).for_each(|(new, old)| new.set(old.get()));
            *self = larger;
        }
    }

    /// Its address, until it grows.
    #[inline]
    pub fn address(&self) -> *mut u8 {
        self.words.as_ptr().cast_mut().cast()
    }

    /// All limbs.
    #[inline]
    pub fn limbs(&self) -> &[Cell<u64>] {
        &self.words
    }

    /// Replaces a limb, if it exists; returns whether it changed.
    #[inline]
    pub fn replace_limb(&mut self, at: usize, limb: u64) -> Option<bool> {
        Some(self.words.get(at)?.replace(limb) != limb)
    }

    /// One lane of a value of up to 64 bits.
    pub fn number(&self, place: Place, lane: u32) -> u64 {
        let mut limb = [0];
        self.get_word(place.lane(lane), place.bytes(), place.width, &mut limb);
        limb[0]
    }

    /// The limbs of one lane of a value, or of a word, of this many bytes.
    pub fn get_word(&self, at: usize, bytes: usize, width: u32, limbs: &mut [u64]) {
        Cells(&self.words).get_word(at, bytes, width, limbs);
    }

    /// Replaces one lane of a value, or a word.
    pub fn put_word(&mut self, at: usize, bytes: usize, width: u32, limbs: &[u64]) {
        Cells(&self.words).put_word(at, bytes, width, limbs);
    }

    /// Replaces `count` adjacent lanes or words.
    pub fn repeat_word(&mut self, at: usize, bytes: usize, width: u32, limbs: &[u64], count: usize) {
        let is_filled = bytes <= 8 && at.is_multiple_of(8) && count * bytes >= 16;
        if !is_filled {
            return (0..count).for_each(|i| self.put_word(at + i * bytes, bytes, width, limbs));
        }
        // A limb consists of whole words: fill one with copies to see its pattern.
        let each = 8 / bytes;
        (0..each).for_each(|i| self.put_word(at + i * bytes, bytes, width, limbs));
        let (first, whole) = (at / 8, count / each);
        let limb = self.words[first].get();
        self.words[first..first + whole].iter().for_each(|word| word.set(limb));
        (whole * each..count).for_each(|i| self.put_word(at + i * bytes, bytes, width, limbs));
    }

    /// Whether a value's limbs equal `seen`, which is updated if not.
    pub fn is_same(&self, place: Place, seen: &mut Vec<u64>) -> bool {
        let words = (place.lanes as usize * place.bytes()).div_ceil(8);
        let now = &self.words[place.offset / 8..][..words];
        if seen.len() == words && now.iter().zip(seen.iter()).fold(0, |all, (now, seen)| all | now.get() ^ seen) == 0 {
            return true;
        }
        seen.clear();
        seen.extend(now.iter().map(Cell::get));
        false
    }

    /// Copies the limbs of these runs, one after another.
    pub fn keep(&self, spans: impl Iterator<Item = Span>, kept: &mut Vec<u64>) {
        kept.clear();
        for Span { offset, limbs, .. } in spans {
            kept.extend(self.words[offset / 8..][..limbs].iter().map(Cell::get));
        }
    }

    /// Whether the significant bits of a run of limbs differ from their copy.
    pub fn differs(&self, span: Span, kept: &[u64]) -> bool {
        let Some((last, all)) = kept.split_last() else { return false };
        let now = &self.words[span.offset / 8..][..span.limbs];
        let (last_now, all_now) = now.split_last().expect("as many were kept");
        let differs = all_now.iter().zip(all).fold(0, |differs, (now, kept)| differs | now.get() ^ kept);
        differs | (last_now.get() ^ last) & span.mask != 0
    }

    /// All lanes of a value.
    pub fn get(&self, place: Place, limbs: &mut [u64]) {
        let each = limbs.len() / place.lanes as usize;
        for (lane, limbs) in (0..).zip(limbs.chunks_exact_mut(each)) {
            self.get_word(place.lane(lane), place.bytes(), place.width, limbs);
        }
    }

    /// Replaces all lanes of a value.
    pub fn put(&mut self, place: Place, limbs: &[u64]) {
        let each = limbs.len() / place.lanes as usize;
        for (lane, limbs) in (0..).zip(limbs.chunks_exact(each)) {
            self.put_word(place.lane(lane), place.bytes(), place.width, limbs);
        }
    }
}

/// Numbers that code changes, seen as values.
#[derive(Clone, Copy)]
pub(crate) struct Cells<'a>(pub &'a [Cell<u64>]);

impl Cells<'_> {
    /// An integer of up to 8 bytes.
    fn integer(self, at: usize, bytes: usize) -> u64 {
        let word = self.0[at / 8].get();
        let shifted = word >> (at % 8 * 8);
        if bytes == 8 { shifted } else { shifted & ((1 << (bytes * 8)) - 1) }
    }

    fn set_integer(self, at: usize, bytes: usize, value: u64) {
        let word = &self.0[at / 8];
        let (shift, ones) = (at % 8 * 8, if bytes == 8 { u64::MAX } else { (1 << (bytes * 8)) - 1 });
        word.set(word.get() & !(ones << shift) | (value & ones) << shift);
    }

    /// The limbs of one lane of a value, or of a word, of this many bytes.
    pub fn get_word(self, at: usize, bytes: usize, width: u32, limbs: &mut [u64]) {
        if is_mask(bytes, width) {
            limbs[0] = self.integer(at, bytes) & 1;
            return;
        }
        for (i, limb) in limbs.iter_mut().enumerate() {
            *limb = self.integer(at + i * 8, bytes.min(8));
        }
    }

    /// Replaces one lane of a value, or a word.
    pub fn put_word(self, at: usize, bytes: usize, width: u32, limbs: &[u64]) {
        if is_mask(bytes, width) {
            return self.set_integer(at, bytes, limbs[0].wrapping_neg());
        }
        for (i, &limb) in limbs.iter().enumerate() {
            self.set_integer(at + i * 8, bytes.min(8), limb);
        }
    }
}

/// Whether a value of 1 bit is stored as all ones or all zeros, as lanes and words are.
pub(crate) fn is_mask(bytes: usize, width: u32) -> bool {
    width == 1 && bytes < 8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_repeated_as_if_one_by_one() {
        for (bytes, width) in [(1, 1), (1, 8), (2, 1), (2, 11), (4, 32), (8, 1), (8, 50), (16, 100)] {
            for (at, count) in [(0_usize, 1), (8, 5), (16, 64), (24, 67), (4, 9)] {
                let (mut one_by_one, mut together) = (Store::new(2048, false), Store::new(2048, true));
                for store in [&mut one_by_one, &mut together] {
                    store.repeat_word(0, 8, 64, &[0x5a5a_5a5a_5a5a_5a5a], 256);
                }
                let at = if bytes < 8 { at } else { at.next_multiple_of(8) };
                let limbs = &[0x1234_5678_9abc_def1, 0x3][..if bytes == 16 { 2 } else { 1 }];
                (0..count).for_each(|i| one_by_one.put_word(at + i * bytes, bytes, width, limbs));
                together.repeat_word(at, bytes, width, limbs, count);
                assert_eq!(one_by_one.words[..256], together.words[..256]);
            }
        }
    }
}

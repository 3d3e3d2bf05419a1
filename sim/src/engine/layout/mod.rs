//! The layout of values and memories in the memory of generated code.
//!
//! A value of one lane takes its 64-bit limbs, so that a testbench reads and writes it in place. A value of several
//! lanes takes an array with one element for each lane, padded at both ends so that a strip may extend beyond it;
//! 1-bit values are masks there. Wider values take limbs.

pub(super) mod bank;
mod guarded;
pub(super) mod memory_at;
pub(super) mod span;
pub(super) mod store;
pub(super) mod strip_sizes;
pub(super) mod words;

use std::cell::RefCell;

use tilewright_circuit::{limbs_for, top_mask};

use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::strips::{Base, Extent, Surroundings, Touched};
use store::is_mask;

/// The place of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    /// The byte of the first lane.
    pub offset: usize,
    /// Bits of an element: 8, 16, 32 or 64; above 64, all limbs of a lane.
    pub element: u32,
    /// How many lanes there are.
    pub lanes: u32,
    /// The width of a lane in bits.
    pub width: u32,
    /// The code runs for several units, and this is the first one's place; that of another unit is at the unit's
    /// distance.
    pub moves: bool,
}

impl Place {
    /// The byte of one lane.
    pub fn lane(&self, lane: u32) -> usize {
        self.offset + lane as usize * self.bytes()
    }

    /// Bits of the integers that an element consists of.
    pub fn integer(&self) -> u32 {
        self.element.min(64)
    }

    /// Bytes from one lane to the next.
    pub fn bytes(&self) -> usize {
        self.element as usize / 8
    }
}

/// The smallest element for `width` bits; whole limbs above 64.
pub(super) fn element(width: u32) -> u32 {
    match width {
        0..=8 => 8,
        9..=16 => 16,
        17..=32 => 32,
        _ => limbs_for(width) as u32 * 64,
    }
}

/// Bits of the element in which a lane of such an array is stored.
pub(super) fn storage(strips: &StripSizes, lanes: u32, width: u32) -> u32 {
    match lanes {
        1 => limbs_for(width) as u32 * 64,
        _ => element(width).max(strips.vector() / strips.strip(lanes)),
    }
}

/// Allocates places.
#[derive(Debug, Clone, Default)]
pub(super) struct Layout {
    /// How many bytes are taken.
    pub size: usize,
    pub strips: StripSizes,
    /// The places by their first byte, with the padding that belongs to each.
    taken: Vec<Extent>,
    /// Where the addresses of other memory are, and its bytes.
    addresses: Vec<(usize, usize)>,
    /// What is allocated before this byte is changed by edges.
    state: usize,
}

impl Layout {
    /// Nothing placed yet.
    pub fn new(strips: StripSizes) -> Layout {
        Layout { strips, ..Layout::default() }
    }

    /// What has been allocated so far is changed by edges.
    pub fn end_of_state(&mut self) {
        self.state = self.size;
    }

    /// Numbers in a place are at most this.
    pub fn limit(&mut self, place: Place, most: u64) {
        if let Some(index) = self.index(place.offset as i64) {
            self.taken[index].most = most;
        }
    }

    /// Whether a place has fewer numbers than its width allows: those of a table, which nothing changes.
    pub fn is_limited(&self, place: Place) -> bool {
        let extent = self.index(place.offset as i64).map(|index| self.taken[index]);
        extent.is_some_and(|extent| extent.most < top_mask(place.width.min(64)))
    }

    /// A place has the address of other memory of so many bytes.
    pub fn address(&mut self, place: Place, bytes: usize) {
        self.addresses.push((place.offset, bytes));
    }

    /// A place has what another one has: an address, if that has one.
    pub fn same_address(&mut self, place: Place, of: Place) {
        if let Some((_, bytes)) = self.addresses.iter().copied().find(|(at, _)| *at == of.offset) {
            self.address(place, bytes);
        }
    }

    fn index(&self, at: i64) -> Option<usize> {
        self.taken.partition_point(|extent| extent.start <= at).checked_sub(1)
    }

    fn take(&mut self, first: usize, place: Place) -> Place {
        // One bit is stored as a mask.
        let most = if is_mask(place.bytes(), place.width) { u64::MAX } else { top_mask(place.width.min(64)) };
        let (start, end) = (first as i64, self.size as i64);
        self.taken.push(Extent { start, end, integer: place.integer(), most, is_state: false });
        place
    }

    /// Aligns the next place, so that the same places after two such calls have the same relative offsets.
    pub fn align(&mut self) {
        self.size = self.size.next_multiple_of(self.guard());
    }

    /// The least number of bytes before and after an array of lanes that code may access: the largest strip of the
    /// widest element. It has as many bytes as a vector has bits.
    fn guard(&self) -> usize {
        self.strips.vector() as usize
    }

    /// A place for a value of this shape.
    pub fn place(&mut self, lanes: u32, width: u32) -> Place {
        let element = storage(&self.strips, lanes, width);
        if lanes == 1 {
            let place = Place { offset: self.size, element, lanes, width, moves: false };
            self.size += place.bytes();
            return self.take(place.offset, place);
        }
        let (strip, reach) = (self.strips.strip(lanes), self.strips.reach(lanes));
        let least = self.guard();
        let guard = ((strip + reach) as usize * element as usize / 8).next_multiple_of(least);
        let offset = self.size.next_multiple_of(least) + guard;
        let place = Place { offset, element, lanes, width, moves: false };
        self.size = (place.lane(lanes) + guard).next_multiple_of(least);
        self.take(offset - guard, place)
    }
}

/// The memory of a function.
pub(super) struct Surrounded<'a> {
    layout: &'a Layout,
    memories: &'a [MemoryAt],
    /// It is called for each of several units.
    has_units: bool,
    /// What functions of the same edge have changed.
    committed: RefCell<Vec<Touched>>,
}

impl<'a> Surrounded<'a> {
    pub fn new(layout: &'a Layout, memories: &'a [MemoryAt], has_units: bool) -> Self {
        Surrounded { layout, memories, has_units, committed: RefCell::default() }
    }
}

impl Surroundings for Surrounded<'_> {
    fn extent(&self, base: Base, at: i64) -> Option<Extent> {
        let memory = |is_it: &dyn Fn(&MemoryAt) -> bool| Some(self.memories.iter().find(|it| is_it(it))?.extent());
        match base {
            Base::State | Base::Unit => {
                let extent = self.layout.taken[self.layout.index(at)?];
                Some(Extent { is_state: extent.start < self.layout.state as i64, ..extent })
            }
            Base::Known(address) => memory(&|memory| memory.address == address),
            Base::Stored(offset) => memory(&|memory| memory.table == Some(offset as usize)).or_else(|| {
                let rows = self.layout.addresses.iter().find(|(at, _)| *at == offset as usize)?;
                Some(Extent { start: 0, end: rows.1 as i64, integer: 0, most: u64::MAX, is_state: false })
            }),
            Base::Scratch => None,
        }
    }

    fn has_units(&self) -> bool {
        self.has_units
    }

    fn committed(&self) -> Option<&RefCell<Vec<Touched>>> {
        Some(&self.committed)
    }

    fn is_address(&self, offset: i64) -> bool {
        self.extent(Base::Stored(offset), 0).is_some()
    }
}

/// The layout of a memory's words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Words {
    /// Bytes of a word.
    pub word: usize,
    /// Bytes from a lane to the next.
    pub lane: usize,
    /// Bytes from an address to the next.
    pub address: usize,
    /// Bytes of the whole bank.
    pub size: usize,
    /// If lanes are stored separately: the offset, from a lane's first byte, to which a disabled write port writes.
    pub nowhere: usize,
}

impl Words {
    /// The layout of memories side by side, with the first byte of each. They have the same number of lanes, and
    /// `depth` words in each.
    ///
    /// If all lanes have the same address, their words are adjacent. Otherwise each lane's words are together, and
    /// lanes are skewed by a cache line, because a power of two between them would map all to one cache set.
    pub fn side_by_side(
        widths: &[u32],
        lanes: u32,
        depth: usize,
        together: bool,
        strips: &StripSizes,
    ) -> Vec<(usize, Words)> {
        let word = |width: u32| (if together { storage(strips, lanes, width) } else { element(width) }) as usize / 8;
        let padded = lanes.next_multiple_of(strips.strip(lanes)) as usize;
        let vector = strips.vector() as usize / 8;
        let row = |width: u32| if together { (padded * word(width)).next_multiple_of(vector) } else { word(width) };
        // The largest first, so that all are aligned.
        let mut order: Vec<usize> = (0..widths.len()).collect();
        order.sort_by_key(|&i| std::cmp::Reverse(row(widths[i])));
        let mut firsts = vec![0; widths.len()];
        let mut used = 0;
        for &i in &order {
            firsts[i] = used;
            used += row(widths[i]);
        }
        let address = used.next_multiple_of(row(widths[order[0]]).min(8));
        let nowhere = if together { 0 } else { (depth * address).next_multiple_of(LINE) };
        let apart = nowhere + address.next_multiple_of(LINE);
        let size = if together { depth * address } else { apart * lanes as usize };
        let words = widths.iter().map(|&width| {
            let word = word(width);
            Words { word, lane: if together { word } else { apart }, address, size, nowhere }
        });
        firsts.into_iter().zip(words).collect()
    }

    /// The first byte of a word.
    pub fn at(&self, lane: u32, address: u32) -> usize {
        lane as usize * self.lane + address as usize * self.address
    }

    /// Whether the words of all lanes at an address are adjacent.
    pub fn together(&self) -> bool {
        self.nowhere == 0
    }
}

/// Bytes of a cache line.
const LINE: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_one_bank_are_aligned_and_apart() {
        let strips = StripSizes::default();
        for widths in [vec![8], vec![24, 24], vec![1, 100, 13], vec![13, 48, 8, 30], vec![65, 1, 1]] {
            for (lanes, together) in [(1, false), (5, false), (5, true)] {
                let together = together && widths.iter().all(|&width| width <= 64);
                let words = Words::side_by_side(&widths, lanes, 7, together, &strips);
                let mut used = vec![false; words[0].1.size];
                for (first, words) in &words {
                    for (lane, address) in (0..lanes).flat_map(|lane| (0..7).map(move |address| (lane, address))) {
                        let at = first + words.at(lane, address);
                        assert!(at.is_multiple_of(words.word.min(8)), "{widths:?} {lanes} {together}");
                        assert!(used[at..at + words.word].iter().all(|used| !used), "{widths:?} {lanes} {together}");
                        used[at..at + words.word].fill(true);
                    }
                    assert!(together || words.nowhere + words.word <= words.lane);
                }
            }
        }
        // Two words of 24 bits in the 8 bytes of one address.
        let [colour, depth] = Words::side_by_side(&[24, 24], 1, 16, false, &strips)[..] else { panic!("two memories") };
        assert_eq!((colour.0, colour.1.address, depth.0, depth.1.address), (0, 8, 4, 8));
    }
}

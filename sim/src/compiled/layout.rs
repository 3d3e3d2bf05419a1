//! Where values and memories stand in the memory that generated code works on.
//!
//! A value of one lane takes its 64-bit limbs, so that a testbench reads and writes it in place. A value of several
//! lanes takes an array of the smallest element that holds its width, each lane one element, padded to whole vectors
//! at both ends so that a strip may begin or end outside; 1-bit values are masks there. Wider values take limbs.

use tilewright_hdl::limbs_for;

use crate::program::{Memory, Value};

/// Bytes in front of and behind an array of lanes that code may read: the largest vector.
pub(super) const GUARD: usize = 64;

/// Where a value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    /// The byte of the first lane.
    pub offset: usize,
    /// Bits of an element: 8, 16, 32 or 64; above 64 the limbs of a lane together.
    pub element: u32,
    /// How many lanes there are.
    pub lanes: u32,
    /// The width of a lane in bits.
    pub width: u32,
}

impl Place {
    /// The byte of one lane.
    pub fn lane(&self, lane: u32) -> usize {
        self.offset + lane as usize * self.bytes()
    }

    /// Bytes from one lane to the next.
    pub fn bytes(&self) -> usize {
        self.element as usize / 8
    }
}

/// The smallest element that holds `width` bits; whole limbs above 64.
pub(super) fn element(width: u32) -> u32 {
    match width {
        0..=8 => 8,
        9..=16 => 16,
        17..=32 => 32,
        _ => limbs_for(width) as u32 * 64,
    }
}

/// Gives out places.
#[derive(Debug, Clone, Default)]
pub(super) struct Layout {
    /// How many bytes are taken.
    pub size: usize,
}

impl Layout {
    /// A place for a value of this shape.
    pub fn place(&mut self, lanes: u32, width: u32) -> Place {
        if lanes == 1 {
            let element = limbs_for(width) as u32 * 64;
            let place = Place { offset: self.size, element, lanes, width };
            self.size += place.bytes();
            return place;
        }
        let element = element(width);
        let offset = self.size.next_multiple_of(GUARD) + GUARD;
        let place = Place { offset, element, lanes, width };
        self.size = (place.lane(lanes)).next_multiple_of(GUARD) + GUARD;
        place
    }

    /// A place for a value of the program.
    pub fn of(&mut self, value: &Value) -> Place {
        self.place(value.lanes, value.width)
    }
}

/// How the words of a memory stand: word `address` of lane `lane` is at `lane * lane_stride + address * word` bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Words {
    /// Bytes of a word.
    pub word: usize,
    /// Bytes from a lane to the next.
    pub stride: usize,
    /// Bytes of it all.
    pub size: usize,
}

impl Words {
    /// Every address that its width can express has a word, so that reads need no check: those beyond the depth stay
    /// zero. Lanes are skewed by a cache line, as a power of two between them would put all into one cache set.
    pub fn of(memory: &Memory, address_width: u32) -> Words {
        let word = element(memory.width) as usize / 8;
        let depth = (memory.depth as usize).max(1 << address_width);
        let stride = (depth * word).next_multiple_of(GUARD) + if memory.lanes > 1 { GUARD } else { 0 };
        Words { word, stride, size: stride * memory.lanes as usize }
    }

    /// The first byte of a word.
    pub fn at(&self, lane: u32, address: u32) -> usize {
        lane as usize * self.stride + address as usize * self.word
    }
}

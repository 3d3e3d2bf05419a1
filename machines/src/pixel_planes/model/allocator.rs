//! The region allocator: one region a clock, to the free renderer with the lowest number.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

pub(super) struct Allocator {
    /// The number of regions given so far, and of all.
    given: usize,
    regions: usize,
    /// The clock after the one in which the last region was given.
    next: u64,
    /// The free renderers, a bit each.
    free: u64,
    /// The renderers that will be free, and the first clock of that.
    later: BinaryHeap<Reverse<(u64, usize)>>,
}

impl Allocator {
    pub fn new(renderers: usize, regions: usize) -> Allocator {
        let free = u64::MAX >> (64 - renderers);
        Allocator { given: 0, regions, next: 0, free, later: BinaryHeap::new() }
    }

    /// The clock in which it gives the next region, as far as it is known.
    pub fn next(&self) -> Option<u64> {
        if self.given == self.regions {
            return None;
        }
        let first = match self.free {
            0 => self.later.peek()?.0.0,
            _ => 0,
        };
        Some(first.max(self.next))
    }

    /// Gives it in that clock. Returns the numbers of the region and of its renderer.
    pub fn give(&mut self, now: u64) -> (usize, usize) {
        while let Some(&Reverse((_, number))) = self.later.peek().filter(|Reverse((clock, _))| *clock <= now) {
            self.later.pop();
            self.free |= 1 << number;
        }
        let number = self.free.trailing_zeros() as usize;
        self.free &= self.free - 1;
        (self.next, self.given) = (now + 1, self.given + 1);
        (self.given - 1, number)
    }

    /// Marks a renderer as free from a clock on.
    pub fn free(&mut self, number: usize, clock: u64) {
        self.later.push(Reverse((clock, number)));
    }
}

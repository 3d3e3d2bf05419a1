//! The patches that have a page in the buffer that a processing element draws.
//!
//! The first access to a patch gives it a page. A swap frees all pages of a local frame buffer (VC1-PT). After one because of an overflow,
//! the access that found no page takes one of the other buffer (VC1-SW4).

use tilewright_rtl::swap::SwapState;

use crate::areas::{Area, Areas};

/// What is known of the pages in a run.
pub(crate) struct Pages {
    /// The side of a patch in pixels, and the size of the screen.
    side: u32,
    screen: [u32; 2],
    /// By processing element and patch.
    areas: Areas<(u32, [u32; 2])>,
    /// By processing element, the patch whose access found no page.
    waiting: Vec<Option<[u32; 2]>>,
    /// By processing element, the patch that it drew last.
    last: Vec<[u32; 2]>,
}

impl Pages {
    pub fn new(side: u32, screen: [u32; 2], processors: u32) -> Pages {
        let processors = processors as usize;
        Pages { side, screen, areas: Areas::new(), waiting: vec![None; processors], last: vec![[0; 2]; processors] }
    }

    /// A local frame buffer takes a pixel.
    pub fn draws(&mut self, time: u64, number: u32, pixel: [u32; 2]) {
        let patch = pixel.map(|at| at / self.side);
        self.last[number as usize] = patch;
        self.take(time, number, patch);
    }

    /// The swap control's state before and after an edge.
    pub fn swap(&mut self, time: u64, number: u32, states: [SwapState; 2]) {
        let last = self.last[number as usize];
        match states {
            [SwapState::Draw, SwapState::Overflow] => {
                self.waiting[number as usize] = Some(last);
                self.areas.end(time, &(number, last));
            }
            [SwapState::Due | SwapState::Overflow, SwapState::Clear] => {
                self.areas.end_all(time, |(of, _)| *of == number)
            }
            [SwapState::Clear, SwapState::Draw] => {
                if let Some(patch) = self.waiting[number as usize].take() {
                    self.take(time, number, patch);
                }
            }
            _ => {}
        }
    }

    /// A patch takes a page unless it has one.
    fn take(&mut self, time: u64, number: u32, patch: [u32; 2]) {
        if self.areas.has(&(number, patch)) {
            return;
        }
        let place = patch.map(|at| at * self.side);
        let size = [0, 1].map(|axis| self.side.min(self.screen[axis] - place[axis]));
        self.areas.begin((number, patch), Area { from: time, to: u64::MAX, painter: number, level: 0, place, size });
    }

    /// All pages by the time at which they were taken.
    pub fn into_areas(self) -> Vec<Area> {
        self.areas.take()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_overflow_frees_all_pages_and_its_patch_takes_one_afterwards() {
        use SwapState::{Clear, Draw, Overflow};
        let mut pages = Pages::new(4, [10, 8], 2);
        pages.draws(1, 0, [0, 0]);
        pages.draws(2, 0, [3, 3]);
        pages.draws(3, 1, [9, 0]);
        pages.draws(4, 0, [4, 4]);
        for (time, states) in [(5, [Draw, Overflow]), (6, [Overflow, Clear]), (7, [Clear, Draw])] {
            pages.swap(time, 0, states);
        }
        let told: Vec<_> =
            pages.into_areas().iter().map(|it| (it.painter, it.place, it.size, it.from, it.to)).collect();
        let end = u64::MAX;
        let first = [(0, [0, 0], [4, 4], 1, 6), (1, [8, 0], [2, 4], 3, end), (0, [4, 4], [4, 4], 4, 5)];
        assert_eq!(told, [first.as_slice(), &[(0, [4, 4], [4, 4], 7, end)]].concat());
    }
}

//! A processing element: runs its program clock by clock against the ports of its local frame buffer unit.
//!
//! Source: VC1-PE, VC1-ACC. The i860 goes on computing as soon as the local frame buffer has taken an access, and stalls as long as
//! it has not.

use super::program::{Access, Program, Step, Work};
use tilewright_rtl::swap::SwapState;

/// A processing element in the middle of a frame.
pub(crate) struct Processor<'a> {
    program: Program<'a>,
    state: State,
    /// What it goes on with when it has cleared its patch table after an overflow.
    suspended: Option<State>,
    /// What the swap control says in the coming clock.
    may: SwapState,
    /// Clocks since the frame's beginning.
    clock: u64,
    tally: Tally,
}

/// What a processing element did in a frame so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    /// Pixels that the local frame buffer took.
    pub requests: u64,
    /// Clocks for which it did not take what stood at its ports.
    pub stalls: u64,
    /// Swaps for want of a page.
    pub overflows: u64,
    /// Clocks for which it waited for these.
    pub overflow_waits: u64,
    /// The clock at whose edge the program ended.
    pub ended_at: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Computing for so many clocks more, at least 1, before an access or the end.
    Computing(u64, Option<Access>),
    /// At the port.
    Accessing(Access),
    Ended,
}

impl<'a> Processor<'a> {
    pub fn new(program: Program<'a>) -> Processor<'a> {
        let mut processor = Processor {
            program,
            state: State::Ended,
            suspended: None,
            may: SwapState::Clear,
            clock: 0,
            tally: Tally::default(),
        };
        processor.fetch();
        processor
    }

    /// What stands at its ports in the coming clock.
    pub fn access(&self) -> Option<Access> {
        match self.state {
            State::Accessing(access) if !self.waits() => Some(access),
            _ => None,
        }
    }

    /// Whether it has drawn its frame, and says so: its contribution to the sync line.
    pub fn done(&self) -> bool {
        self.state == State::Ended && self.may == SwapState::Draw
    }

    /// Whether its program has ended.
    pub fn ended(&self) -> bool {
        self.state == State::Ended
    }

    /// Whether its frame is over: its local frame buffer has swapped.
    pub fn swapped(&self) -> bool {
        self.state == State::Ended && self.may == SwapState::Clear
    }

    /// Whether it waits for a swap of its local frame buffer.
    fn waits(&self) -> bool {
        matches!(self.may, SwapState::Due | SwapState::Overflow)
    }

    /// An edge of its clock; `taken` says whether its local frame buffer took the access, `may` what the swap control says from then on.
    pub fn edge(&mut self, taken: bool, may: SwapState) {
        self.clock += 1;
        let before = std::mem::replace(&mut self.may, may);
        match (before, self.state) {
            (SwapState::Overflow, _) => self.tally.overflow_waits += 1,
            (SwapState::Due, _) | (_, State::Ended) => {}
            (_, State::Computing(left, then)) => self.compute(left - 1, then),
            (_, State::Accessing(_)) if !taken => self.tally.stalls += 1,
            (_, State::Accessing(access)) => {
                self.tally.requests += u64::from(matches!(access, Access::Draw(_)));
                self.fetch();
            }
        }
        if (before, may) == (SwapState::Overflow, SwapState::Clear) {
            self.tally.overflows += 1;
            self.suspended = Some(self.state);
            self.program.clear_again();
            self.fetch();
        }
    }

    fn fetch(&mut self) {
        if self.program.entries_left() == 0
            && let Some(suspended) = self.suspended.take()
        {
            self.state = suspended;
            return;
        }
        let Step { clocks, access } = self.program.step();
        // The last clock of an access is the one at the port.
        self.compute(clocks - u64::from(access.is_some()), access);
    }

    fn compute(&mut self, clocks: u64, then: Option<Access>) {
        self.state = match (clocks, then) {
            (1.., _) => State::Computing(clocks, then),
            (0, Some(access)) => State::Accessing(access),
            (0, None) => {
                self.tally.ended_at = self.clock;
                State::Ended
            }
        };
    }

    pub fn tally(&self) -> Tally {
        self.tally
    }

    pub fn work(&self) -> Work {
        self.program.work
    }

    /// Polygons that it has not begun.
    pub fn polygons_left(&self) -> usize {
        self.program.polygons_left()
    }

    /// Entries of the patch table that are not yet cleared.
    pub fn entries_left(&self) -> usize {
        let in_hand = match self.state {
            State::Computing(_, Some(Access::Clear(_))) | State::Accessing(Access::Clear(_)) => 1,
            _ => 0,
        };
        in_hand + self.program.entries_left()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vc1::assignment::Polygon;
    use crate::vc1::cost::CostTable;
    use tilewright_scenes::{ScreenVertex, Size, set_up};

    /// A row of two pixels, then a polygon without packets; the local frame buffer is busy for two clocks at the second pixel.
    #[test]
    fn it_computes_waits_for_its_local_frame_buffer_and_ends() {
        let at = |x, y| ScreenVertex { x, y, z: 1, rgb: [0; 3] };
        let packet = set_up(&[at(0, 0), at(30, 0), at(0, 100)], Size::new(4, 1).expect("in range"));
        let packets = [packet.expect("covers pixels")];
        let polygons =
            [(7, 0..1), (8, 1..1)].map(|(number, packets)| Polygon { number, packets, vertices: 1, clipped: 0 });
        let costs = CostTable { vertex: 1, polygon: 2, area: 0, clip: 0, set_up: 0, row: 0, pixel: 2, clear: 1 };
        let mut processor = Processor::new(Program::new(costs, &packets, &polygons, 1));
        let mut wave = String::new();
        let busy = [7, 8];
        for clock in 0..14 {
            let access = processor.access();
            let taken = access.is_some() && !busy.contains(&clock);
            wave.push(match access {
                Some(Access::Clear(_)) => 'c',
                Some(Access::Draw(_)) if taken => 'd',
                Some(Access::Draw(_)) => 'w',
                None if processor.ended() => ' ',
                None => '.',
            });
            processor.edge(taken, SwapState::Draw);
        }
        assert_eq!(wave, "c....d.wwd... ");
        assert_eq!(processor.tally(), Tally { requests: 2, stalls: 2, ended_at: 13, ..Tally::default() });
    }

    /// The first pixel finds no page: the program waits where it is, clears its table of two entries, and goes on.
    #[test]
    fn it_waits_clears_and_goes_on_after_an_overflow() {
        let at = |x, y| ScreenVertex { x, y, z: 1, rgb: [0; 3] };
        let packet = set_up(&[at(0, 0), at(30, 0), at(0, 100)], Size::new(4, 1).expect("in range"));
        let packets = [packet.expect("covers pixels")];
        let polygons = [Polygon { number: 7, packets: 0..1, vertices: 0, clipped: 0 }];
        let costs = CostTable { vertex: 0, polygon: 1, area: 0, clip: 0, set_up: 0, row: 0, pixel: 3, clear: 2 };
        let mut processor = Processor::new(Program::new(costs, &packets, &polygons, 2));
        let mut wave = String::new();
        for clock in 0..22 {
            let access = processor.access();
            wave.push(match access {
                Some(Access::Clear(patch)) => char::from(b'0' + patch as u8),
                Some(Access::Draw(_)) => 'd',
                None if processor.done() => 'D',
                None if processor.ended() => ' ',
                None => '.',
            });
            // What the swap control says from the next clock on.
            let may = match clock {
                0..3 | 14..18 => SwapState::Clear,
                9..14 => SwapState::Overflow,
                _ => SwapState::Draw,
            };
            processor.edge(access.is_some(), may);
        }
        assert_eq!(wave, ".0.1...d........0.1dDD");
        let tally = processor.tally();
        assert_eq!((tally.requests, tally.stalls, tally.overflows, tally.overflow_waits), (2, 0, 1, 5));
    }
}

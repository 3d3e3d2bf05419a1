//! A processing element: runs its program clock by clock against the ports of its local frame buffer unit.
//!
//! Source: VC1-PE, VC1-ACC. The i860 goes on computing as soon as the local frame buffer has taken an access, and stalls as long as
//! it has not.

use super::program::{Access, Program, Work};

/// A processing element in the middle of a frame.
pub(crate) struct Processor<'a> {
    program: Program<'a>,
    state: State,
    /// Clocks since the frame's beginning.
    clock: u64,
    tally: Tally,
}

/// What a processing element did in a frame so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    /// Pixels that the local frame buffer took.
    pub requests: u64,
    /// Clocks for which it did not take the pixel at its port.
    pub request_stalls: u64,
    /// Clocks for which it did not take the cleared entry at its port.
    pub clear_stalls: u64,
    /// The clock at whose edge the last entry of the patch table was cleared.
    pub cleared_at: u64,
    /// The clock at whose edge the program ended.
    pub ended_at: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Computing for so many clocks more, at least 1, then at the port.
    Computing(u64, Access),
    /// At the port.
    Accessing(Access),
    Ended,
}

impl<'a> Processor<'a> {
    pub fn new(program: Program<'a>) -> Processor<'a> {
        let mut processor = Processor { program, state: State::Ended, clock: 0, tally: Tally::default() };
        processor.fetch();
        processor
    }

    /// What stands at its ports in the coming clock.
    pub fn access(&self) -> Access {
        match self.state {
            State::Accessing(access) => access,
            State::Computing(..) | State::Ended => Access::End,
        }
    }

    /// Whether its program has ended: its contribution to the sync line.
    pub fn ended(&self) -> bool {
        self.state == State::Ended
    }

    /// An edge of its clock; `taken` says whether its local frame buffer took the access.
    pub fn edge(&mut self, taken: bool) {
        self.clock += 1;
        match &mut self.state {
            State::Computing(left, access) => {
                *left -= 1;
                if *left == 0 {
                    self.state = State::Accessing(*access);
                    self.end_if_done();
                }
            }
            State::Accessing(Access::Draw(_)) if !taken => self.tally.request_stalls += 1,
            State::Accessing(_) if !taken => self.tally.clear_stalls += 1,
            State::Accessing(access) => {
                match access {
                    Access::Draw(_) => self.tally.requests += 1,
                    _ => self.tally.cleared_at = self.clock,
                }
                self.fetch();
            }
            State::Ended => {}
        }
    }

    fn fetch(&mut self) {
        let step = self.program.step();
        // The last clock of an access is the one at the port; the end has none.
        let before = match step.access {
            Access::End => step.clocks,
            _ => step.clocks - 1,
        };
        self.state = match before {
            0 => State::Accessing(step.access),
            clocks => State::Computing(clocks, step.access),
        };
        self.end_if_done();
    }

    fn end_if_done(&mut self) {
        if self.state == State::Accessing(Access::End) {
            self.state = State::Ended;
            self.tally.ended_at = self.clock;
        }
    }

    pub fn tally(&self) -> Tally {
        self.tally
    }

    pub fn work(&self) -> Work {
        self.program.work
    }

    /// The number of the polygon that it draws, if it has come to one.
    pub fn polygon(&self) -> Option<u32> {
        self.program.polygon()
    }

    /// Polygons that it has not begun.
    pub fn polygons_left(&self) -> usize {
        self.program.polygons_left()
    }
}

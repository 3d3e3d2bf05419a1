//! The three clocks of the machine, and the crossings between them.
//!
//! Edge `k` of a clock of period `p` is at `k p`, and ends clock `k`. A register that changes at an edge has its new value in the next clock. At
//! an edge of several clocks, each sees the values before it.

use tilewright_rtl::clocks::{MERGE, PE};
use tilewright_rtl::gfb::{BLANK_LINES, Blanking};
use tilewright_rtl::vc1::Vc1;

/// Picoseconds of a clock of the processing elements, and of the merger.
pub(super) const PE_PERIOD: u64 = PE.period.picoseconds();
pub(super) const MERGE_PERIOD: u64 = MERGE.period.picoseconds();

/// The edge after which a synchronizer shows a change at that time: the second one after it.
pub(super) fn crossed(time: u64, period: u64) -> u64 {
    time / period + 2
}

/// The edge of the processing elements' clock at which an outside observer sees a change at that time.
pub(super) fn seen(time: u64) -> u64 {
    time.div_ceil(PE_PERIOD)
}

/// The display, with the times of its blankings.
#[derive(Clone, Copy, Debug)]
pub(super) struct Display {
    period: u64,
    /// Edges in the reset.
    reset: u64,
    line: u64,
    refresh: u64,
    /// Clocks in which the banks may change, from the beginning of a blanking on.
    window: u64,
}

/// The end of the reset, which lasts until every clock has had an edge.
pub(super) fn reset_time(vc1: &Vc1) -> u64 {
    let display = vc1.display.period.picoseconds();
    PE_PERIOD.max(MERGE_PERIOD).max(display)
}

impl Display {
    pub fn new(vc1: &Vc1) -> Display {
        let read_out = vc1.gfb().read_out();
        let (period, line) = (vc1.display.period.picoseconds(), read_out.line_clocks());
        let window = match read_out.blanking {
            Blanking::AtStart => line,
            Blanking::Within => u64::from(BLANK_LINES - 2) * line,
        };
        Display { period, reset: reset_time(vc1) / period, line, refresh: read_out.refresh_clocks(), window }
    }

    /// The refresh at that time; each begins with its blanking.
    pub fn refresh_at(&self, time: u64) -> u64 {
        time / self.period / self.refresh
    }

    /// The first and the last clock in which the merger knows that the banks may change in that refresh.
    fn window(&self, refresh: u64) -> (u64, u64) {
        let opens = self.reset + 1 + refresh * self.refresh;
        let known = |edge: u64| crossed(edge * self.period, MERGE_PERIOD);
        (known(opens) + 1, known(opens + self.window))
    }

    /// A refresh that is over before that clock of the merger, or one soon after.
    fn before(&self, clock: u64) -> u64 {
        (clock * MERGE_PERIOD / (self.refresh * self.period)).saturating_sub(2)
    }

    /// The first clock of the merger from that one on in which the banks may change.
    pub fn open_from(&self, clock: u64) -> u64 {
        let mut refresh = self.before(clock);
        loop {
            let (first, last) = self.window(refresh);
            if clock <= last {
                return clock.max(first);
            }
            refresh += 1;
        }
    }

    /// The first clock of the merger from that one on in which the banks may not change.
    pub fn closed_from(&self, clock: u64) -> u64 {
        let windows = (self.before(clock)..).map(|refresh| self.window(refresh));
        let ends = windows.take_while(|(first, _)| *first <= clock).map(|(_, last)| last + 1);
        ends.last().map_or(clock, |end| end.max(clock))
    }

    /// The edge of the processing elements' clock just before the end of a blanking, not before that one; and that of the first pixel after it.
    pub fn dawn_from(&self, edge: u64) -> (u64, u64) {
        let mut refresh = self.before(edge * PE_PERIOD / MERGE_PERIOD);
        loop {
            let pixels = self.reset + u64::from(BLANK_LINES) * self.line + refresh * self.refresh;
            let dawn = seen((pixels - self.line / 2) * self.period);
            if dawn >= edge {
                return (dawn, seen((pixels + 1) * self.period));
            }
            refresh += 1;
        }
    }
}

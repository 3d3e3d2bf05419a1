//! The coverage test unit: finds the quarters of a window that a polygon may cover (MPG-EQ5, MPG-WIN).
//!
//! ```text
//! works ===>[held]--> window of a quarter ---> [ < 0 ? ]--> covered?   no: the next quarter
//!              |                                               | yes
//!              '----> planes of the quarter, one a clock ------'==========> parts
//! ```
//!
//! A quarter passes under two conditions. Each edge function must be at least 0 at the corner where it is greatest. The
//! quarter must overlap the rectangle of pixels around the polygon; without those four bounds up to 35 % more windows
//! pass (facts B). An edge function is stored as its greatest value in the window. So a test is one subtraction and a
//! check of the sign. It subtracts the decrease on the way to the quarter's corner: the decrease per sample, shifted.
//!
//! Latency and throughput: the tests of a window take `4 k_e` clocks with one adder, or 4 with an adder for each edge.
//! Each quarter that passes takes `k_p` = 4 more, in which one adder moves its planes to its upper left sample. The
//! quarters come one after another, and wait for their receiver. The next window is taken in the last clock of its
//! predecessor.

use std::fmt;

use super::divider::{DividerIn, DividerOut};
use super::format::{Format, PLANES, Window, Work};
use super::lanes::lane_by_lane;
use super::tally::Tally;
use crate::prelude::*;

/// How the edge functions of a quarter are tested, which determines the cost of a test (MPG-EQ5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Test {
    /// One edge after another, with one adder.
    Serial,
    /// All edges in one clock, with an adder for each.
    Parallel,
}

impl fmt::Display for Test {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Test::Serial => "serial",
            Test::Parallel => "parallel",
        })
    }
}

block! {
    /// Tests the quarters of windows, and sends on those that their polygon may cover.
    pub struct CoverageTest {
        /// The generator's format.
        pub format: Format,
        /// How the edges are tested.
        pub test: Test,
        /// The size of the largest input window: the binary logarithm of its side, from 1.
        pub from: u32,
        /// The number of sizes of input windows, each half of the previous one.
        pub sizes: u32,
    }
    latency(self) = match self.test {
        Test::Serial => "a window takes a clock for each edge of each quarter, and 4 for each quarter that passes",
        Test::Parallel => "a window takes a clock for each quarter, and 4 more for each that passes",
    };
    source = "sparse-raster quadtree generator, equation 5 (MPG-EQ5, MPG-WIN)";
    in(self) = DividerIn::widths(self.format);
    out(self) = DividerOut::widths(self.format, self.sizes);
}

impl CoverageTest {
    fn build(&self, m: Module, i: DividerIn) -> DividerOut {
        def!(busy = m.reg(bit()).reset(0));
        def!(held = m.reg(Work::widths(self.format)));
        def!(number = m.reg(2).reset(0));
        def!(moves = m.reg(bit()).reset(0));
        def!(step = m.reg(below(Format::MAX_EDGES)).reset(0));
        let Work { polygon, window } = *held;
        let size = match self.sizes {
            1 => lit(up_to(self.format.levels()), self.from - 1),
            _ => window.size - 1,
        };

        // The test of a quarter.
        def!(tests = busy & !moves);
        let Tested { edges, is_outside, is_last } = self.edges(m, tests, *step, *number, size, &held);
        let bounds = window.bounds.quarter(*number, size, self.format.matrix());
        def!(misses = is_outside | bounds.is_beyond());
        def!(passes = tests & is_last & !misses);
        def!(fails = tests & is_last & misses);

        // The planes of a quarter that passes. The quarter is sent with the last of them.
        let moved = |plane: Signal, is_beside: Signal, add: Signal| plane + mux(is_beside, add << size, 0);
        def!(plane_of_window = window.planes.pick(*step));
        def!(plane_x = polygon.plane_x.pick(*step));
        def!(plane_y = polygon.plane_y.pick(*step));
        def!(plane = moved(moved(plane_of_window, number.bit(0), plane_x), number.bit(1), plane_y));
        let planes = lane_by_lane(m, "planes", PLANES, *moves, *step, plane).row;
        def!(ready = moves & step.eq(PLANES - 1));
        let place = |at: Signal, is_beside: Signal| at | (is_beside.zext(self.format.levels()) << size);
        let (x, y) = (place(window.x, number.bit(0)), place(window.y, number.bit(1)));
        let quarter = Work { polygon, window: Window { size, x, y, edges, bounds, planes } };
        let (parts, sent) = m.offer(ready, quarter);

        def!(ends_quarter = fails | sent);
        def!(ends = ends_quarter & number.all_ones());
        let next = i.works.take_when(!busy | ends);
        busy.when(next.taken, 1).when(ends, 0);
        held.when(next.taken, *next);
        number.when(ends_quarter, number + 1);
        moves.when(passes, 1).when(sent, 0);
        step.when(passes | ends_quarter, 0).when(busy & !ready, step + 1);

        def!(waits = ready & !sent);
        let tally = (0..self.sizes).map(|level| {
            let here = if self.sizes == 1 { lit(1, 1) } else { window.size.eq(self.from - level) };
            let is = Tally { busy: busy & !waits & here, stalled: waits & here, results: sent & here };
            m.within(&format!("size{}", self.from - level), || Tally::count(m, is))
        });
        DividerOut { parts, idle: !busy & !i.works.valid, tally: tally.collect() }
    }

    /// The edge functions of a quarter, while `tests` is high.
    fn edges(&self, m: Module, tests: Signal, step: Signal, number: Signal, size: Signal, work: &Work) -> Tested {
        let Work { polygon, window } = *work;
        let all = [window.edges, polygon.step_x, polygon.step_y, polygon.right, polygon.lower];
        match self.test {
            Test::Parallel => {
                let edges = greatest(all, number, size);
                Tested { edges, is_outside: edges.is_negative().or_all(), is_last: lit(1, 1) }
            }
            Test::Serial => {
                let [edge, step_x, step_y, right, lower] = all.map(|row| row.pick(step));
                def!(edge_of_window = edge);
                def!(step_x = step_x);
                def!(step_y = step_y);
                def!(right = right);
                def!(lower = lower);
                def!(value = greatest([edge_of_window, step_x, step_y, right, lower], number, size));
                let edges = lane_by_lane(m, "edges", self.format.edges(), tests, step, value.bits()).kept.signed();
                def!(is_last = step.eq(polygon.last_edge));
                def!(outside = m.reg(bit()).reset(0));
                def!(is_outside = outside | value.is_negative());
                outside.when(tests, is_outside & !is_last);
                Tested { edges, is_outside, is_last }
            }
        }
    }
}

/// The result of a test in a clock.
struct Tested {
    /// The edge functions of the quarter, once it has passed.
    edges: Signal,
    /// An edge function is negative in the whole quarter.
    is_outside: Signal,
    /// The test ends in this clock.
    is_last: Signal,
}

/// The greatest value of each edge function in a quarter, from its greatest value in the window. The decrease is
/// subtracted unless the quarter has the same corner.
fn greatest([value, step_x, step_y, right, lower]: [Signal; 5], number: Signal, size: Signal) -> Signal {
    let decrease = |decrease: Signal, is_greatest_there: Signal, is_there: Signal| {
        mux(is_greatest_there.eq(is_there), 0, decrease.zext(value.width()) << size).signed()
    };
    value - decrease(step_x, right, number.bit(0)) - decrease(step_y, lower, number.bit(1))
}

#[cfg(test)]
mod tests;

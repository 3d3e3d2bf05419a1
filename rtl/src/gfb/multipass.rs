//! The control of pictures of several passes: when a pass is added up, when the average is shown, and when the banks may change (VC1-ACB).
//!
//! ```text
//! reset --> Pass -- swap to the last pass --> LastSum -- summed, in a blanking --> Turn -- the blanking ends --> Average
//!            ^                                                                                                     |
//!            '------------------------------------------------- swap ----------------------------------------------'
//! ```
//!
//! Latency: a sum starts in the clock of the swap that puts its pass on display. The average is shown 1 clock after the
//! first clock in which the last sum is complete and the display is in a blanking.
//!
//! The host's settings at the swap to a first pass decide whether a picture begins and how many passes it has. Later
//! settings apply to the next picture. Without accumulation a swap shows a frame, and nothing is added.
//!
//! The banks may not change while a sum runs. After the last sum they may not change before the average has been on
//! display for a whole refresh. That refresh runs from the blanking in which the average appears to the next blanking.
//! If merging takes two refreshes and a sum more than one, a picture of n passes takes 2 n + 1 refreshes:
//!
//! ```text
//! blankings  |    |    |    |    |    |        n = 2
//! swaps      1         2              1
//! sums       [=====]   [=====]        [=====]
//! display    | pass 1  | pass 2  | av | pass 1
//! ```
//!
//! If the last sum ends in the blanking in which it begins, the average appears in that blanking, and no refresh shows
//! its pass. Only a screen much smaller than the paper's has such a short sum.

use super::accumulation::Passes;
use crate::prelude::*;

record! {
    /// The host's settings for pictures of several passes.
    pub struct Multipass {
        /// The next picture is the average of several passes.
        accumulates: bit(),
        /// The number of passes of the next picture: a code of [`Passes`].
        passes: one_of::<Passes>(),
    }
}

impl Multipass<u64> {
    /// The settings for pictures of `passes` passes.
    pub fn pictures_of(passes: Passes) -> Multipass<u64> {
        Multipass { accumulates: 1, passes: passes.code() }
    }
}

codes! {
    /// The state of the display.
    enum Stage {
        /// A pass, or a frame without accumulation.
        Pass,
        /// The last pass of a picture, while it is added up and until the next blanking.
        LastSum,
        /// The average, for its first refresh.
        Turn,
        /// The average, until the next picture.
        Average,
    }
}

block! {
    /// Decides when a pass is added up, when the average is shown, and when the banks may change.
    pub struct MultipassControl;
    latency = "0 clocks from a swap to its sum; 1 clock from the blanking to the average";
    source = "VC-1, section 3.3, accumulation buffer (VC1-ACB)";
    in MultipassControlIn {
        /// High for one clock when the banks are exchanged.
        swap: bit(),
        /// The settings from the host.
        host: Multipass,
        /// A sum is under way.
        busy: bit(),
        /// The display is in the part of its blanking in which its source may change.
        blanking: bit(),
    }
    out MultipassControlOut {
        /// High for one clock when a sum starts.
        start: bit(),
        /// The sum that begins with `start` is that of the first pass of a picture.
        first: bit(),
        /// The number of passes of the picture being made or shown: a code of [`Passes`].
        passes: one_of::<Passes>(),
        /// The average is shown.
        averages: bit(),
        /// The banks may change.
        may_swap: bit(),
    }
}

impl MultipassControl {
    fn build(&self, m: Module, i: MultipassControlIn) -> MultipassControlOut {
        use Stage::{Average, LastSum, Pass, Turn};
        // The passes of a picture.
        def!(number = m.reg(below(Passes::Sixteen.count())).reset(0));
        def!(first = number.eq(0));
        def!(start = i.swap & (i.host.accumulates | !first));
        def!(passes = m.reg(one_of::<Passes>()).reset(Passes::Two));
        passes.when(start & first, i.host.passes);
        def!(last = number.eq(passes.choose(|passes: Passes| lit(number.width(), passes.count() - 1))));
        number.when(start & last, 0).when(start, number + 1);

        // What is on display.
        def!(stage = m.fsm(Pass));
        def!(summed = stage.is(LastSum) & !i.busy);
        def!(averages = m.reg(bit()).reset(0));
        stage.next(|stage| match stage {
            Pass => when(start & last, LastSum),
            LastSum => when(summed & i.blanking, Turn),
            Turn => when(!i.blanking, Average),
            Average => when(i.swap, Pass),
        });
        averages.when(summed & i.blanking, 1).when(i.swap, 0);
        def!(may_change = stage.is(Pass) & !i.busy | stage.is(Average));

        m.assume(i.swap.implies(!i.busy), "the banks do not change while a sum is under way");
        m.assume(m.rose(i.busy).implies(m.past(start)), "a sum gets under way in the clock after its start");
        m.assume(
            i.swap.implies(!stage.is(LastSum) & !stage.is(Turn)),
            "the banks do not change before the average has been shown for a whole refresh",
        );
        m.assert(
            averages.eq(stage.is(Turn) | stage.is(Average)),
            "the average is shown when the sum of all passes is complete",
        );
        m.assert(averages.implies(!i.busy), "no sum is under way while its average is shown");
        m.cover("a picture begins while the average of the previous one is shown", start & averages);
        m.cover("a frame without accumulation follows an average", i.swap & !start & averages);
        m.cover("a last sum waits for the blanking", summed & !i.blanking);
        m.cover("a blanking passes while a sum is under way", i.blanking & i.busy);
        MultipassControlOut { start, first, passes: *passes, averages: *averages, may_swap: i.blanking & may_change }
    }
}

#[cfg(test)]
mod tests;

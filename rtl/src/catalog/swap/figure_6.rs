//! The paper's Figure 6 as a scenario of four frames; the last one overflows a local frame buffer.

use tilewright_hdl::{Bits, Scenario, Script, below};

use crate::catalog::shared::idle;
use crate::clocks::PE;
use crate::swap::{SwapControl, SwapControlIn};

/// The processor clocks, in addition to T_m, until the merger has seen a swap and stored the contents of its chain.
const CROSSINGS: u64 = 18;
/// The processor clocks in which the merger, and then a local frame buffer, sees a blanking and swaps.
const BLANKING: u64 = 8;

type Inputs = SwapControlIn<Bits>;

/// The inputs of a script, for all processing elements or for some.
struct Figure<'a> {
    control: &'a SwapControl,
    script: Script<SwapControl>,
    all: Bits,
    /// The processing element that overflows, and the others.
    first: Bits,
    others: Bits,
}

impl Figure<'_> {
    fn idle(&self) -> Inputs {
        let one = Bits::new(1, 1);
        let (bus, host, enable) = (one.clone(), one.clone(), one);
        SwapControlIn { idle: self.all.clone(), bus, host, enable, ..idle(self.control) }
    }

    /// T_m in processor clocks: the time in which everything is sent.
    fn merge_clocks(&self) -> u64 {
        self.control.local.merge_clocks
    }

    /// These processing elements clear their tables and draw for some clocks.
    fn clear_and_draw(&mut self, drawing: &Bits, clocks: u64, others: &Inputs) {
        let width = below(self.control.local.patches).bits();
        for entry in 0..u64::from(self.control.local.patches) {
            let patch = Bits::join(&vec![Bits::new(width, entry); drawing.width() as usize]);
            self.script.clock_bits(&SwapControlIn { clears: drawing.clone(), patch, ..others.clone() });
        }
        for _ in 0..clocks {
            self.script.clock_bits(&SwapControlIn { draws: drawing.clone(), ..others.clone() });
        }
    }

    /// All finish drawing, the first one some clocks before the others. One clock later all see the line high.
    fn end(&mut self, inputs: &Inputs) {
        let early = SwapControlIn { done: self.first.clone(), draws: self.others.clone(), ..inputs.clone() };
        (0..2).for_each(|_| self.script.clock_bits(&early));
        self.script.clock_bits(&SwapControlIn { done: self.all.clone(), ..inputs.clone() });
        self.script.clock_bits(inputs);
    }

    /// What has been sent since a swap some clocks ago is merged, and the banks change in the next blanking.
    fn merge(&mut self, ago: u64, inputs: &Inputs) {
        let sending = SwapControlIn { sending: self.all.clone(), ..inputs.clone() };
        (ago..self.merge_clocks()).for_each(|_| self.script.clock_bits(&sending));
        (0..CROSSINGS).for_each(|_| self.script.clock_bits(inputs));
        let blanking = SwapControlIn { blanking: Bits::new(1, 1), ..inputs.clone() };
        (0..BLANKING).for_each(|_| self.script.clock_bits(&blanking));
    }
}

/// Events 1 to 8, in this sequence.
pub(super) fn figure_6(control: &SwapControl) -> Scenario {
    let all = Bits::ones(control.global.processors);
    let first = Bits::new(1, 1).resize(all.width());
    let others = first.not().resize(all.width());
    let script = Script::new(control, PE.period);
    let mut figure = Figure { control, script, all, first, others };
    let (all, first, others) = (figure.all.clone(), figure.first.clone(), figure.others.clone());
    let (rests, clears) = (figure.idle(), u64::from(control.local.patches));
    let sends = SwapControlIn { sending: all.clone(), ..rests.clone() };

    // 1: all swap. 2: they draw the next frame. 3: the last one is merged. 4: it is shown.
    figure.clear_and_draw(&all, 2, &rests);
    figure.end(&rests);
    figure.clear_and_draw(&all, 3, &sends);
    figure.merge(clears + 3, &rests);
    // 5: The second frame ends after that, and the third one long before the second is shown.
    figure.end(&rests);
    figure.clear_and_draw(&all, 1, &sends);
    figure.end(&sends);
    figure.merge(clears + 5, &rests);
    // 6: In the fourth frame the first element finds no page after the others have finished. 7: it alone swaps. 8: it
    // draws on.
    figure.clear_and_draw(&all, 1, &sends);
    let overflows = SwapControlIn { done: others.clone(), overflow: first.clone(), idle: others, ..rests.clone() };
    figure.merge(clears + 1, &overflows);
    let draws_on = SwapControlIn { done: overflows.done, sending: first.clone(), ..rests };
    figure.clear_and_draw(&first, 4, &draws_on);
    figure.script.finish(
        "Figure 6, events 1 to 8: a frame ends, is merged and shown; one that is drawn early waits; one overflows a buffer, which swaps, and drawing goes on",
    )
}

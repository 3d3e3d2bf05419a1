//! The paper's Figure 6 as a scenario: four frames, of which the last overflows a local frame buffer.

use tilewright_hdl::{Bits, Scenario, Script, below};

use crate::catalog::shared::idle;
use crate::clocks::PE;
use crate::swap::{SwapControl, SwapControlIn};

/// Clocks of a processing element until the merger knows of a swap, and has stored what its chain holds, beside T_m.
const CROSSINGS: u64 = 18;
/// Clocks of a processing element in which the merger and then a local frame buffer see a blanking, and swap.
const BLANKING: u64 = 8;

type Inputs = SwapControlIn<Bits>;

/// The inputs of a script, of all processing elements or of some.
struct Figure<'a> {
    control: &'a SwapControl,
    script: Script<SwapControl>,
    all: Bits,
    /// The one that overflows, and those that do not.
    first: Bits,
    others: Bits,
}

impl Figure<'_> {
    fn idle(&self) -> Inputs {
        let one = Bits::new(1, 1);
        let (bus, host, enable) = (one.clone(), one.clone(), one);
        SwapControlIn { idle: self.all.clone(), bus, host, enable, ..idle(self.control) }
    }

    /// T_m, in which all is sent.
    fn merge_clocks(&self) -> u64 {
        self.control.local.merge_clocks
    }

    /// Those processing elements clear their tables, and draw for some clocks.
    fn clear_and_draw(&mut self, who: &Bits, clocks: u64, others: &Inputs) {
        let width = below(self.control.local.patches).bits();
        for entry in 0..u64::from(self.control.local.patches) {
            let entry = Bits::new(width, entry);
            let patch = (1..who.width()).fold(entry.clone(), |all, _| all.concat(&entry));
            self.script.clock_bits(&SwapControlIn { clears: who.clone(), patch, ..others.clone() });
        }
        for _ in 0..clocks {
            self.script.clock_bits(&SwapControlIn { draws: who.clone(), ..others.clone() });
        }
    }

    /// All have drawn, the first one some clocks before the others; in the clock after that the line is seen.
    fn end(&mut self, inputs: &Inputs) {
        let early = SwapControlIn { done: self.first.clone(), draws: self.others.clone(), ..inputs.clone() };
        (0..2).for_each(|_| self.script.clock_bits(&early));
        self.script.clock_bits(&SwapControlIn { done: self.all.clone(), ..inputs.clone() });
        self.script.clock_bits(inputs);
    }

    /// What is sent since a swap some clocks ago is sent and merged, and the banks change in the blanking behind that.
    fn merge(&mut self, ago: u64, inputs: &Inputs) {
        let sending = SwapControlIn { sending: self.all.clone(), ..inputs.clone() };
        (ago..self.merge_clocks()).for_each(|_| self.script.clock_bits(&sending));
        (0..CROSSINGS).for_each(|_| self.script.clock_bits(inputs));
        let blanking = SwapControlIn { blanking: Bits::new(1, 1), ..inputs.clone() };
        (0..BLANKING).for_each(|_| self.script.clock_bits(&blanking));
    }
}

/// Events 1 to 8, in this order.
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
    // The second frame ends after that, and the third one long before the second is shown: 5.
    figure.end(&rests);
    figure.clear_and_draw(&all, 1, &sends);
    figure.end(&sends);
    figure.merge(clears + 5, &rests);
    // 6: in the fourth frame the first finds no page, when the others have drawn theirs. 7: it alone swaps. 8: it draws on.
    figure.clear_and_draw(&all, 1, &sends);
    let overflows = SwapControlIn { done: others.clone(), overflow: first.clone(), idle: others, ..rests.clone() };
    figure.merge(clears + 1, &overflows);
    let draws_on = SwapControlIn { done: overflows.done, sending: first.clone(), ..rests };
    figure.clear_and_draw(&first, 4, &draws_on);
    figure.script.finish(
        "Figure 6, events 1 to 8: a frame ends, is merged and shown; one that is drawn early waits; one overflows a buffer, which swaps and draws on",
    )
}

//! Clocks whose registers begin with values at power-on, in a design whose blocks name them with a reset.

use crate::draft::Draft;
use crate::elaboration;
use crate::module::Module;
use tilewright_circuit::{Clock, Loc, Mistake, Problem, Reset};

impl Module {
    /// From here on, `clock` is of the kind [`Reset::PowerOn`] in the whole design, also in blocks that name it with a
    /// reset: its registers begin with their reset values, and it has no reset port.
    ///
    /// This is for the top of an FPGA. A PLL makes the clock there, and no pin resets it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const VIDEO: Clock = Clock::new("video", Period::ns(40));
    ///
    /// block! {
    ///     /// Counts the pixels of a line, from a reset on.
    ///     struct Column;
    ///     out ColumnOut { x: bits(10) }
    /// }
    ///
    /// impl Column {
    ///     fn build(&self, m: Module, _: ()) -> ColumnOut {
    ///         def!(x = m.on(VIDEO).reg(10).reset(7));
    ///         x.next(x + 1);
    ///         ColumnOut { x: *x }
    ///     }
    /// }
    ///
    /// block! {
    ///     /// Has no pin for a reset.
    ///     struct Board;
    ///     out BoardOut { x: bits(10) }
    /// }
    ///
    /// impl Board {
    ///     fn build(&self, m: Module, _: ()) -> BoardOut {
    ///         m.reset_by_power_on(VIDEO);
    ///         BoardOut { x: m.instance("u_column", &Column, ()).x }
    ///     }
    /// }
    ///
    /// assert_eq!(elaborate(&Column)?.top().clocks[0].reset.as_deref(), Some("video_rst"));
    /// let design = elaborate(&Board)?;
    /// assert_eq!(design.top().clocks[0].reset, None);
    /// assert!(tilewright_gen::verilog(&design)[0].text.contains("initial x = 10'd7;"));
    /// # Ok::<(), Problems>(())
    /// ```
    ///
    /// Anything that named the clock before this line is a problem.
    #[track_caller]
    pub fn reset_by_power_on(self, clock: Clock) {
        let loc = Loc::caller();
        elaboration::with(|e| {
            if let Some((_, first)) = e.clocks.get(clock.name).copied() {
                let name = clock.name;
                let message = format!("clock `{name}` has no reset from here on and {} before", clock.reset.words());
                let problem =
                    Problem::new(Mistake::TwoResets, loc, message).note(format!("`{name}` is first used"), first);
                e.report(problem.help("write this line first in the top, whose ports are on other clocks"));
            }
            e.by_power_on.push(clock.name);
            let names = e.by_power_on.clone();
            e.drafts.iter_mut().for_each(|draft| draft.by_power_on.clone_from(&names));
        });
    }
}

impl Draft {
    /// The clock with the kind of reset that it has in this design.
    pub fn as_it_resets(&self, clock: Clock) -> Clock {
        if self.by_power_on.contains(&clock.name) { clock.reset(Reset::PowerOn) } else { clock }
    }
}

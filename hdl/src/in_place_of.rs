//! Clocks that run in place of others, for blocks whose own description names a clock.

use crate::draft::Draft;
use crate::elaboration::{self, Elaboration};
use crate::ir;
use crate::module::Module;
use tilewright_circuit::{Clock, DefaultClock, Loc, Mistake, Problem};

/// A named clock in whose place another one runs.
#[derive(Clone, Copy)]
pub(crate) struct Renamed {
    pub inner: Clock,
    /// The clock that runs; `None` for the module's own.
    pub outer: Option<Clock>,
}

/// The module's own clock runs in place of this one, so both must have the same period.
#[derive(Clone, Copy)]
pub(crate) struct OwnPeriod {
    pub of: Clock,
    pub loc: Loc,
}

impl Module {
    /// Within `describe`, this handle's clock runs in place of `clock`. It replaces `clock` in `m.on(clock)`, and the
    /// clocks of that name in instances. So a block that names its clocks runs on others. Both clocks must have the
    /// same period, because a block may rely on the period of its clocks.
    ///
    /// A block of one clock needs none of this, because it runs on the clock of the handle that instantiates it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const VIDEO: Clock = Clock::new("video", Period::ns(40));
    /// const PANEL: Clock = Clock::new("panel", Period::ns(40));
    ///
    /// block! {
    ///     /// Counts the pixels of a line, always on the clock `video`.
    ///     struct Column;
    ///     out ColumnOut { x: bits(10) }
    /// }
    ///
    /// impl Column {
    ///     fn build(&self, m: Module, _: ()) -> ColumnOut {
    ///         def!(x = m.on(VIDEO).reg(10).reset(0));
    ///         x.next(x + 1);
    ///         ColumnOut { x: *x }
    ///     }
    /// }
    ///
    /// block! {
    ///     /// Has no clock `video`.
    ///     struct Panel;
    ///     out PanelOut { x: bits(10) }
    /// }
    ///
    /// impl Panel {
    ///     fn build(&self, m: Module, _: ()) -> PanelOut {
    ///         let column = m.on(PANEL).in_place_of(VIDEO, || m.instance("u_column", &Column, ()));
    ///         PanelOut { x: column.x }
    ///     }
    /// }
    ///
    /// let design = elaborate(&Panel)?;
    /// let clocks: Vec<_> = design.top().clocks.iter().map(|clock| &*clock.port).collect();
    /// assert_eq!(clocks, ["panel_clk"]);
    /// # Ok::<(), Problems>(())
    /// ```
    #[track_caller]
    pub fn in_place_of<R>(self, clock: Clock, describe: impl FnOnce() -> R) -> R {
        let loc = Loc::caller();
        elaboration::with(|e| {
            match self.clock {
                Some(outer) => check(e, OwnPeriod { of: clock, loc }, named(outer), outer, None),
                None => e.draft().own_periods.push(OwnPeriod { of: clock, loc }),
            }
            e.draft().renamed.push(Renamed { inner: clock, outer: self.clock });
        });
        let result = describe();
        elaboration::draft(|draft| draft.renamed.pop());
        result
    }

    /// The clock of this module that drives a child's clock. For the child's own clock it is this handle's, otherwise
    /// the clock of the same name, or the one in its place.
    pub(crate) fn bind(self, e: &mut Elaboration, clock: &ir::Clock) -> ir::ClockId {
        let of: Option<Clock> = clock.name.map(|name| e.clocks[name].0);
        let draft = e.draft();
        let clock = of.map_or(self.clock, |clock| draft.in_use(clock));
        draft.use_clock(clock)
    }

    /// Checks the period of the clock that drives an instance of `child`, if that clock runs in place of another one
    /// there.
    pub(crate) fn check_own_periods(self, e: &mut Elaboration, child: ir::ModuleId, loc: Loc) {
        for needed in e.own_periods[child.0 as usize].clone() {
            match self.clock {
                Some(clock) => check(e, needed, named(clock), clock, Some(loc)),
                None => e.draft().own_periods.push(needed),
            }
        }
    }
}

impl Draft {
    /// The clock that runs where the description names this one; `None` for the module's own.
    pub fn in_use(&self, clock: Clock) -> Option<Clock> {
        let renamed = self.renamed.iter().rev().find(|renamed| renamed.inner.name == clock.name);
        renamed.map_or(Some(self.as_it_resets(clock)), |renamed| renamed.outer)
    }
}

/// Checks the period of the design's default clock, if that clock runs in place of another one.
pub(crate) fn check_default(e: &mut Elaboration, clock: DefaultClock) {
    for needed in e.own_periods.last().cloned().unwrap_or_default() {
        check(e, needed, "the default clock".to_owned(), clock, None);
    }
}

fn named(clock: Clock) -> String {
    format!("`{}`", clock.name)
}

fn check(e: &mut Elaboration, needed: OwnPeriod, by: String, clock: impl Into<DefaultClock>, given: Option<Loc>) {
    let (OwnPeriod { of, loc }, clock) = (needed, clock.into());
    let place = format!("{by}, which runs in its place,");
    let (message, help) = if of.period != clock.period {
        let message = format!("clock `{}` has a period of {}, but {place} of {}", of.name, of.period, clock.period);
        (message, "a block may rely on the periods of its clocks: make the clock a parameter of the block")
    } else if of.reset != clock.reset {
        let message = format!("clock `{}` has {}, but {place} {}", of.name, of.reset.words(), clock.reset.words());
        (message, "give both clocks the same reset, or make the clock a parameter of the block")
    } else if of.edge != clock.edge {
        let message = format!("clock `{}` {}, but {place} {}", of.name, of.edge.words(), clock.edge.words());
        (message, "give both clocks the same edge, or make the clock a parameter of the block")
    } else {
        return;
    };
    let mut problem = Problem::new(Mistake::OtherPeriod, loc, message);
    if let Some(given) = given {
        problem = problem.note(format!("{by} is given to the instance"), given);
    }
    e.report(problem.help(help));
}

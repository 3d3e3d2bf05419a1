//! The arena that a description writes into while it runs.
//!
//! Signals are `Copy` handles into the arena, so expressions need no lifetimes, and helpers are plain functions. A
//! thread runs at most one elaboration; a guard clears the arena even when a description panics. Every handle carries
//! the stamp of its elaboration and the number of its module, so a stale or foreign handle is a clear error.

use crate::clock::OwnClock;
use crate::draft::Draft;
use crate::in_place_of::OwnPeriod;
use crate::limits::check_period;
use crate::summary::Summary;
use std::any::{Any, TypeId};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, HashMap};
use std::hash::Hash;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::rc::Rc;
use std::sync::atomic::{AtomicU32, Ordering};
use tilewright_circuit::ir::latency::Delay;
use tilewright_circuit::ir::{Module, ModuleId, NodeId};
use tilewright_circuit::{Clock, Edge, Loc, Mistake, Problem, Problems, Reset};

/// The state of the design that is being elaborated on this thread.
pub(crate) struct Elaboration {
    pub stamp: u32,
    pub done: Vec<Module>,
    pub summaries: Vec<Summary>,
    /// The delays of the outputs of the first finished modules: as many as a stated latency has needed.
    pub delays: Vec<Vec<Delay>>,
    /// For each finished module, the output bundle of its block, as a shape.
    pub shapes: Vec<Rc<dyn Any>>,
    /// For each finished module, the place of its first instance.
    pub instantiated: Vec<Loc>,
    /// For each finished module, the clocks whose enables are its last inputs: `None` for its own.
    pub enables: Vec<Vec<Option<&'static str>>>,
    /// For each finished module, the clocks in whose place its own runs.
    pub own_periods: Vec<Vec<OwnPeriod>>,
    /// The modules of the blocks that have been elaborated.
    pub known: KnownBlocks,
    /// The modules under construction, the innermost last.
    pub drafts: Vec<Draft>,
    pub drafts_begun: u32,
    /// Every named clock, and the place of its first use.
    pub clocks: BTreeMap<&'static str, (Clock, Loc)>,
    /// The clocks whose registers begin with values at power-on, whatever their descriptions say.
    pub by_power_on: Vec<&'static str>,
    /// How a clock acts that no module's name tells: as the top's own, or in the usual way where the reset is given.
    pub unnamed: OwnClock,
    /// For each finished module, what of its default clock it depends on.
    pub depends_on: Vec<DependsOn>,
    pub problems: Vec<Problem>,
}

/// What of its own clock a module depends on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DependsOn {
    pub reset: bool,
    pub edge: bool,
}

impl DependsOn {
    /// What it depends on, of this clock.
    pub fn of(self, own: OwnClock) -> Needs {
        (self.reset.then_some(own.reset), self.edge.then_some(own.edge))
    }
}

/// The reset and the edge of its own clock that a module was made for, if it depends on them.
pub(crate) type Needs = (Option<Reset>, Option<Edge>);

/// Blocks by type and value, independent of their `Debug` text: for each type, a `HashMap` of its blocks. A block has a
/// module for each kind of clock that it was made for, and each set of clocks on which its instances are in an enabled
/// part.
#[derive(Default)]
pub(crate) struct KnownBlocks(HashMap<TypeId, Box<dyn Any>>);

/// A module of a block.
struct Made {
    gated: Vec<Option<&'static str>>,
    needs: Needs,
    id: ModuleId,
}

impl KnownBlocks {
    pub fn get<B: Eq + Hash + 'static>(
        &self,
        block: &B,
        gated: &[Option<&'static str>],
        own: OwnClock,
    ) -> Option<ModuleId> {
        let is_it = |made: &&Made| {
            let (reset, edge) = made.needs;
            made.gated == gated && reset.is_none_or(|of| of == own.reset) && edge.is_none_or(|of| of == own.edge)
        };
        self.modules(block)?.iter().find(is_it).map(|made| made.id)
    }

    /// Whether the block has a module.
    pub fn has<B: Eq + Hash + 'static>(&self, block: &B) -> bool {
        self.modules(block).is_some()
    }

    fn modules<B: Eq + Hash + 'static>(&self, block: &B) -> Option<&Vec<Made>> {
        let of_type: &HashMap<B, Vec<Made>> = self.0.get(&TypeId::of::<B>())?.downcast_ref()?;
        of_type.get(block)
    }

    pub fn insert<B: Eq + Hash + 'static>(
        &mut self,
        block: B,
        gated: Vec<Option<&'static str>>,
        needs: Needs,
        id: ModuleId,
    ) {
        let of_type = self.0.entry(TypeId::of::<B>()).or_insert_with(|| Box::new(HashMap::<B, Vec<Made>>::new()));
        let of_type = of_type.downcast_mut::<HashMap<B, Vec<Made>>>().expect("a map of that type");
        let modules = of_type.entry(block).or_default();
        if modules.iter().all(|made| made.gated != gated || made.needs != needs) {
            modules.push(Made { gated, needs, id });
        }
    }
}

thread_local! {
    static CURRENT: RefCell<Option<Elaboration>> = const { RefCell::new(None) };
}

thread_local! {
    static GIVEN_RESET: Cell<Option<Reset>> = const { Cell::new(None) };
}

/// The reset that is given for the own clock of tops, in place of what their elaboration says.
pub(crate) fn given_reset() -> Option<Reset> {
    GIVEN_RESET.get()
}

/// Elaborates with this reset of the top's own clock.
pub(crate) fn with_reset<R>(reset: Reset, elaborate: impl FnOnce() -> R) -> R {
    /// Takes the reset back, also after a panic.
    struct Given;
    impl Drop for Given {
        fn drop(&mut self) {
            GIVEN_RESET.set(None);
        }
    }
    GIVEN_RESET.set(Some(reset));
    let _given = Given;
    elaborate()
}

static STAMPS: AtomicU32 = AtomicU32::new(1);

/// Clears the arena when elaboration ends, by return or by panic.
struct Guard;

impl Drop for Guard {
    fn drop(&mut self) {
        CURRENT.with_borrow_mut(|current| *current = None);
    }
}

/// The payload with which a description that cannot continue unwinds to [`run`].
struct Stopped;

/// Reports a problem after which not even a stand-in is possible.
pub(crate) fn stop(problem: Problem) -> ! {
    with(|e| e.report(problem));
    resume_unwind(Box::new(Stopped))
}

/// A mistake after which the description cannot continue. While a block is built, it is a problem; elsewhere it is a
/// panic with the same sentence and number.
#[track_caller]
pub(crate) fn mistake(mistake: Mistake, message: String, help: &str) -> ! {
    let loc = Loc::caller();
    if CURRENT.with_borrow(Option::is_some) {
        stop(Problem::new(mistake, loc, message).help(help))
    }
    panic!("{message} [{mistake}], at {loc}: {help}")
}

/// Runs `describe` with a fresh arena, for a top whose own clock acts in this way, and returns the arena's contents.
pub(crate) fn run(own: OwnClock, describe: impl FnOnce()) -> Result<Elaboration, Problems> {
    CURRENT.with_borrow_mut(|current| {
        assert!(current.is_none(), "`elaborate` was called inside a block's `build`: use `m.instance` there");
        *current = Some(Elaboration {
            stamp: STAMPS.fetch_add(1, Ordering::Relaxed),
            done: Vec::new(),
            summaries: Vec::new(),
            delays: Vec::new(),
            shapes: Vec::new(),
            instantiated: Vec::new(),
            enables: Vec::new(),
            own_periods: Vec::new(),
            known: KnownBlocks::default(),
            drafts: Vec::new(),
            drafts_begun: 0,
            clocks: BTreeMap::new(),
            by_power_on: Vec::new(),
            unnamed: OwnClock { reset: given_reset().map_or(own.reset, |_| Reset::default()), ..own },
            depends_on: Vec::new(),
            problems: Vec::new(),
        });
    });
    let guard = Guard;
    if let Err(panic) = catch_unwind(AssertUnwindSafe(describe))
        && !panic.is::<Stopped>()
    {
        resume_unwind(panic);
    }
    let ended = CURRENT.with_borrow_mut(Option::take).expect("the arena lives until its guard drops");
    drop(guard);
    if ended.problems.is_empty() { Ok(ended) } else { Err(Problems(ended.problems)) }
}

/// Calls `f` with the current arena.
#[track_caller]
pub(crate) fn with<R>(f: impl FnOnce(&mut Elaboration) -> R) -> R {
    let loc = Loc::caller();
    CURRENT.with_borrow_mut(|current| match current {
        Some(elaboration) => f(elaboration),
        None => panic!("a signal is used outside of `elaborate`, at {loc}: signals exist only while a block is built"),
    })
}

/// Calls `f` with the module under construction.
#[track_caller]
pub(crate) fn draft<R>(f: impl FnOnce(&mut Draft) -> R) -> R {
    with(|e| f(e.draft()))
}

impl Elaboration {
    /// The module under construction.
    pub fn draft(&mut self) -> &mut Draft {
        self.drafts.last_mut().expect("a module is being built")
    }

    /// Registers a clock; its name has one period, one kind of reset and one edge in the whole design.
    pub fn meet_clock(&mut self, clock: Clock, loc: Loc) {
        let clock = if self.by_power_on.contains(&clock.name) { clock.reset(Reset::PowerOn) } else { clock };
        let (known, first) = match self.clocks.get(clock.name) {
            Some(known) => *known,
            None => {
                check_period(self, &format!("clock `{}`", clock.name), clock.period, loc);
                self.clocks.insert(clock.name, (clock, loc));
                return;
            }
        };
        let Clock { name, period, reset, edge } = clock;
        if reset != known.reset {
            let message = format!("clock `{name}` has {} here and {} elsewhere", reset.words(), known.reset.words());
            let problem = Problem::new(Mistake::TwoResets, loc, message).note(format!("`{name}` is first used"), first);
            self.report(problem.help("a clock resets in one way in the whole design"));
        }
        if edge != known.edge {
            let message = format!("clock `{name}` {} here and {} elsewhere", edge.words(), known.edge.words());
            let problem = Problem::new(Mistake::TwoEdges, loc, message).note(format!("`{name}` is first used"), first);
            self.report(
                problem.help("a clock has one edge in the whole design: the opposite one is a clock of its own"),
            );
        }
        if period != known.period {
            let message = format!("clock `{name}` has a period of {period} here and of {} elsewhere", known.period);
            let problem =
                Problem::new(Mistake::TwoPeriods, loc, message).note(format!("`{name}` is first used"), first);
            self.report(problem.help("a clock has one period in the whole design"));
        }
    }

    pub fn report(&mut self, problem: Problem) {
        // A closure that runs for each code or lane repeats the same mistake.
        if !self.problems.iter().rev().take(16).any(|known| *known == problem) {
            self.problems.push(problem);
        }
    }

    /// Forgets the problems from this one on that were known before: those of a block that is described again.
    pub fn forget_repeated(&mut self, from: usize) {
        let again = self.problems.split_off(from);
        let new = again.into_iter().filter(|problem| !self.problems.contains(problem)).collect::<Vec<_>>();
        self.problems.extend(new);
    }

    /// Like [`Elaboration::report`], for an expression that a stand-in replaces: its operands count as used. If one
    /// of them follows from another problem, nothing is reported.
    pub fn report_instead_of(&mut self, operands: &[NodeId], problem: Problem) {
        let draft = self.draft();
        draft.in_problems.extend(operands);
        if !draft.follows_a_problem(operands) {
            self.report(problem);
        }
    }
}

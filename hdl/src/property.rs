//! Properties of a circuit: assertions, assumptions about its inputs, covers, and displays.

use crate::draft::{Draft, DraftProperty};
use crate::elaboration;
use crate::module::Module;
use crate::operand::IntoSignal;
use crate::select::condition;
use crate::signal::Signal;
use tilewright_circuit::ir::{Directive, Piece, Property, Shown};
use tilewright_circuit::{Loc, Mistake, Problem};

/// Properties are checked at every edge of the module's clock while its reset is low, in every lane. A property that
/// looks at a [past value](Module::past) waits until that value exists. A simulation checks properties. Verilog
/// states them to simulators and formal tools; synthesizers do not see them.
///
/// ```
/// # use tilewright_hdl::*;
/// block! {
///     /// Counts the pages taken since the last restart.
///     pub struct Taken { pub most: u64 }
///     in TakenIn { take: bit(), restart: bit() }
///     out(self) TakenOut { taken: up_to(self.most) }
/// }
///
/// impl Taken {
///     fn build(&self, m: Module, i: TakenIn) -> TakenOut {
///         def!(taken = m.reg(up_to(self.most)).reset(0));
///         def!(full = taken.eq(self.most));
///         taken.when(i.restart, 0).when(i.take, taken + 1);
///         m.assume(i.take.implies(!full | i.restart), "nothing is taken when all pages are");
///         m.assert(taken.le(self.most), "no more pages are taken than exist");
///         m.assert(m.past(i.restart).implies(taken.eq(0)), "a restart returns all pages");
///         m.cover("all is taken", m.rose(full));
///         TakenOut { taken: *taken }
///     }
/// }
/// # elaborate(&Taken { most: 5 }).unwrap();
/// ```
impl Module {
    /// Asserts that `holds` is high at every edge while the reset is low. If it is not, the circuit is wrong and a
    /// simulation stops.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(used = m.reg(up_to(12)).reset(0));
    /// let take = used.lt(12);
    /// used.when(take, used + 1);
    /// m.assert(take.implies(used.ne(12)), "a page is taken only while one is free");
    /// # });
    /// // A failing assertion would have ended the run with that message.
    /// assert_eq!(example.values("used"), [0, 1, 2, 3]);
    /// ```
    #[track_caller]
    pub fn assert(self, holds: impl IntoSignal, message: &str) {
        self.state(Directive::Assert, condition(holds.into(), "assert"), message);
    }

    /// Like [`Module::assert`], for the block's inputs: if it fails, the stimulus is wrong. A formal tool considers
    /// only inputs that satisfy it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { take: bit(), free: below(12) } out { page: below(12) }
    /// m.assume(i.take.implies(i.free.lt(12)), "of 12 pages");
    /// #     ShownOut { page: i.free }
    /// # };
    /// let mut sim = tilewright_sim::Simulation::from_design(&design).unwrap();
    /// let (take, free) = (sim.port("take").unwrap(), sim.port("free").unwrap());
    /// sim.set(take, 1);
    /// sim.set(free, 13);
    /// assert!(sim.try_step().unwrap_err().to_string().contains("of 12 pages"));
    /// ```
    #[track_caller]
    pub fn assume(self, holds: impl IntoSignal, message: &str) {
        self.state(Directive::Assume, condition(holds.into(), "assume"), message);
    }

    /// Covers `happens`: it is expected to be high at some edge while the reset is low. A simulation counts these
    /// edges; a test asks for the count by the cover's name. A formal tool searches for a trace that reaches one.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(2) }
    /// def!(count = m.reg(2).reset(0));
    /// count.when(i.enable, count + 1);
    /// m.cover("it is full", count.all_ones());
    /// #     ShownOut { count: *count }
    /// # };
    /// let mut sim = tilewright_sim::Simulation::from_design(&design).unwrap();
    /// sim.run(10);
    /// assert_eq!(sim.covered("it is full").unwrap(), 0); // the test never enables it
    /// ```
    #[track_caller]
    pub fn cover(self, name: &str, happens: impl IntoSignal) {
        self.state(Directive::Cover, condition(happens.into(), "cover"), name);
    }

    /// Shows a text in a simulation at every edge where `when` is high and the reset is low. The values stand where the
    /// text has `{}`, `{:x}` or `{:b}`. `{}` is a decimal number, with its sign if it is signed, or the name of a code;
    /// the others are hexadecimal and binary digits. A test gets the lines from its simulation. In Verilog, it is
    /// `$display`, which synthesizers do not see.
    ///
    /// If `when` has lanes, each lane in which it is high has a line, with that lane's values.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { take: bit() } out { used: up_to(9) }
    /// def!(used = m.reg(up_to(9)).reset(7));
    /// used.when(i.take, used + 1);
    /// m.display(i.take, "{} pages of 9 are used, {:b}", &[*used, *used]);
    /// #     ShownOut { used: *used }
    /// # };
    /// let mut sim = tilewright_sim::Simulation::from_design(&design)?;
    /// let messages = sim.messages();
    /// sim.set(sim.port("take")?, 1);
    /// sim.run(2);
    /// assert_eq!(messages.lines(), ["7 pages of 9 are used, 111", "8 pages of 9 are used, 1000"]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    pub fn display(self, when: impl IntoSignal, text: &str, values: &[Signal]) {
        let loc = Loc::caller();
        let when = condition(when.into(), "display");
        let mut shown = Vec::new();
        for value in values {
            let value = value.with_lanes_of(when, "display");
            shown.push(Shown { node: value.id_at(loc), kind: value.kind });
        }
        let places = Piece::of(text).map(|pieces| pieces.iter().filter(|it| matches!(it, Piece::Value(_))).count());
        let problem = match places {
            Err(problem) => Some(format!("{problem} in the text of a `display`: \"{text}\"")),
            Ok(places) if places != values.len() => {
                let count = values.len();
                Some(format!("the number of values of a `display` is {count}, but its text shows {places}: \"{text}\""))
            }
            Ok(_) => None,
        };
        match problem {
            None => self.state_of(Directive::Display, when, text, shown),
            Some(problem) => elaboration::with(|e| {
                let problem = Problem::new(Mistake::DisplayText, loc, problem);
                let nodes: Vec<_> = shown.iter().map(|shown| shown.node).chain([when.node]).collect();
                e.report_instead_of(&nodes, problem.help("a value is `{}`, `{:x}` or `{:b}`; a brace is `{{` or `}}`"));
            }),
        }
    }

    #[track_caller]
    fn state(self, directive: Directive, condition: Signal, message: &str) {
        self.state_of(directive, condition, message, Vec::new());
    }

    #[track_caller]
    fn state_of(self, directive: Directive, condition: Signal, message: &str, values: Vec<Shown>) {
        let (loc, condition) = (Loc::caller(), condition.id());
        elaboration::with(|e| {
            let draft = e.draft();
            let (clock, part) = (draft.use_clock(self.clock), draft.part);
            let problem = (directive == Directive::Cover).then(|| second_cover(draft, message, loc)).flatten();
            let message = message.to_owned();
            draft
                .properties
                .push(DraftProperty { property: Property { directive, clock, condition, message, values, loc }, part });
            problem.into_iter().for_each(|problem| e.report(problem));
        });
    }
}

/// A problem if another cover has this name, because a test asks for a cover by name.
fn second_cover(draft: &mut Draft, name: &str, loc: Loc) -> Option<Problem> {
    let Some(&first) = draft.covers.get(name) else {
        draft.covers.insert(name.to_owned(), loc);
        return None;
    };
    let problem = Problem::new(Mistake::SecondCover, loc, format!("a second cover is called `{name}`"));
    Some(
        problem.note("the first one is stated", first).help("give each cover its own name: a test asks for it by name"),
    )
}

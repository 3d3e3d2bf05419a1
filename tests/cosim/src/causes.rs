//! The causes of values in random designs: forcing what is no cause changes nothing, and forcing the cause does.
//!
//! A *cone* is the tree of a signal without limits, and its *leaves* are the bits of inputs, registers and words at its
//! ends. In a cone of one clock all leaves are of one time. In a cone of many clocks, inputs have the times at which
//! they counted, and registers and words are those of the start.
//!
//! - Everything but the leaves gets random values: the signal is as it was.
//! - A leaf bit is *live* if another value of this bit alone changes the signal. In a cone that *answers*, some leaf
//!   bit is live, or random values of all leaves change the signal. A cone is *deaf* if it does not answer although
//!   random values of everything change the signal. There are constant signals, which nothing changes.

use crate::Campaign;
use crate::drawn::Kind;
use crate::stimulus::Numbers;
use crate::tally::tally;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use tilewright_hdl::ir::{Design, Shape};
use tilewright_hdl::{Bits, Reset};
use tilewright_sim::program::hierarchy::index;
use tilewright_sim::{Cause, Checkpoint, End, EngineKind, Error, Limits, Simulation};

/// How many signals of a design are asked about, and how often everything else is forced.
const SIGNALS: usize = 2;
const FORCED: usize = 4;
/// How often all leaves are forced where no single one is live, and how many are tried one by one.
const TRIES: usize = 24;
const FLIPS: usize = 24;

tally! {
    /// What was found.
    pub struct Found {
        /// Designs.
        designs: "designs",
        /// Cones, of one clock and of many.
        cones: "cones",
        /// Leaf bits of these.
        leaves: "leaf bits",
        /// How often everything but the leaves was forced.
        forced: "forced",
        /// Leaf bits that were given another value.
        flipped: "flipped",
        /// Those of them that are live.
        live: "live",
        /// Cones that answer.
        answer: "cones that answer",
        /// Deaf cones.
        deaf: "deaf",
    }
}

/// What a testbench does at one time.
#[derive(Debug, Clone)]
struct Step {
    /// By input.
    inputs: Vec<Bits>,
    /// By clock: its reset is active.
    resets: Vec<bool>,
    /// A word that is set: a memory, an address, a value.
    word: Option<(String, u32, Bits)>,
}

/// The bits that count, by time and by name.
type Leaves = BTreeMap<(u64, String), Bits>;

/// What is done from a state on.
struct Run<'a> {
    from: &'a Checkpoint,
    steps: &'a [Step],
}

/// A design that runs, again and again.
struct Subject {
    design: Design,
    kind: EngineKind,
    seed: u64,
    steps: Vec<Step>,
    /// The names and shapes of the inputs.
    inputs: Vec<(String, Shape)>,
}

impl Subject {
    fn new(design: Design, seed: u64, kind: EngineKind) -> Subject {
        let top = design.top();
        let inputs = top.inputs.iter().map(|input| (input.name.clone(), top.node(input.node).shape)).collect();
        let mut subject = Subject { kind, seed, steps: Vec::new(), inputs, design };
        let mut numbers = Numbers(seed);
        let count = 1 + numbers.draw() % 20;
        subject.steps = (0..count).map(|_| subject.step(&mut numbers)).collect();
        subject
    }

    /// A random step.
    fn step(&self, numbers: &mut Numbers) -> Step {
        let top = self.design.top();
        let last = self.steps.last();
        let keeps = |numbers: &mut Numbers| last.is_some() && numbers.draw().is_multiple_of(3);
        let input = |(index, input): (usize, &tilewright_hdl::ir::Input)| match keeps(numbers) {
            true => last.expect("there is one").inputs[index].clone(),
            false => numbers.lanes(top.node(input.node)),
        };
        let inputs = top.inputs.iter().enumerate().map(input).collect();
        let can_reset = |clock: &tilewright_hdl::ir::Clock| clock.reset.is_some() && clock.kind != Reset::PowerOn;
        let resets = top.clocks.iter().map(|clock| can_reset(clock) && numbers.draw().is_multiple_of(12)).collect();
        let memory = top.memories.get(numbers.draw() as usize % top.memories.len().max(1));
        let memory = memory.filter(|memory| memory.shape.is_plain() && numbers.draw().is_multiple_of(8));
        let word = memory
            .map(|memory| (memory.name.clone(), numbers.draw() as u32 % memory.depth, numbers.bits(memory.width)));
        Step { inputs, resets, word }
    }

    fn start(&self) -> Simulation {
        let sim = Simulation::from_design(&self.design).unwrap_or_else(|error| panic!("{error}"));
        sim.on(self.kind).seeded(self.seed)
    }

    /// Makes the changes of a step, with the inputs that `input` makes of its inputs.
    fn change(&self, sim: &mut Simulation, step: &Step, mut input: impl FnMut(&str, Shape, &Bits) -> Bits) {
        for ((name, shape), value) in self.inputs.iter().zip(&step.inputs) {
            sim.set(sim.port(name).expect("it is an input"), input(name, *shape, value));
        }
        let clocks: Vec<String> = sim.program().clocks.iter().map(|clock| clock.name.clone()).collect();
        for (clock, active) in clocks.iter().zip(&step.resets) {
            if sim.program().clocks.iter().any(|it| it.name == *clock && it.kind != Reset::PowerOn) {
                sim.set_reset(clock, *active);
            }
        }
        if let Some((memory, address, value)) = &step.word {
            sim.poke_memory(memory, *address, value.clone()).expect("it is a memory");
        }
    }

    /// Runs up to the last step, and makes its changes; fewer steps if an assertion fails.
    fn run(&mut self, sim: &mut Simulation) {
        for index in 0..self.steps.len() {
            let step = self.steps[index].clone();
            self.change(sim, &step, |_, _, value| value.clone());
            if index + 1 < self.steps.len() && !goes_on(sim) {
                self.steps.truncate(index + 1);
                break;
            }
        }
    }

    /// The value of a signal in a run from a state, or from the last step, where all has the value that `force` gives;
    /// `None` if an assertion fails.
    fn forced(
        &self,
        sim: &mut Simulation,
        &Run { from, steps }: &Run,
        signal: &str,
        mut force: impl FnMut(u64, &str, &Bits) -> Bits,
    ) -> Option<Bits> {
        let start = from.forced(|name, value| force(from.time(), name, value));
        sim.restore(&start).expect("it is the design");
        for (index, step) in steps.iter().enumerate() {
            let now = sim.time();
            self.change(sim, step, |name, shape, value| {
                let width = value.width() / shape.lanes();
                let lane = |lane: u32| {
                    let name = format!("{name}{}", index_of(shape, lane));
                    force(now, &name, &value.slice(lane * width..(lane + 1) * width))
                };
                Bits::join(&(0..shape.lanes()).map(lane).collect::<Vec<_>>())
            });
            if index + 1 < steps.len() && !goes_on(sim) {
                return None;
            }
        }
        Some(sim.peek(signal).expect("it is a signal"))
    }

    /// The leaves of a cone from a time on, lane by lane; not what the testbench sets again in another way.
    fn leaves(&self, cause: &Cause, from: u64) -> Leaves {
        let mut leaves = Leaves::new();
        assert!(cause.iter().all(|cause| cause.end != Some(End::Cut)), "there are no limits");
        let sets_again = |leaf: &Cause| matches!(leaf.end, Some(End::Reset | End::Testbench)) && leaf.time > from;
        for leaf in cause.iter().filter(|cause| is_leaf(cause) && !sets_again(cause)) {
            let whole = self.inputs.iter().find(|(name, shape)| *name == leaf.name && !shape.is_plain());
            let lanes = whole.map_or(1, |(_, shape)| shape.lanes());
            let width = leaf.bits.width() / lanes;
            for lane in 0..lanes {
                let name = whole.map_or(String::new(), |(_, shape)| index_of(*shape, lane));
                let bits = leaf.bits.slice(lane * width..(lane + 1) * width);
                let key = (leaf.time.max(from), format!("{}{name}", leaf.name));
                let bits = leaves.get(&key).map_or(bits.clone(), |known| merged(known, &bits));
                leaves.insert(key, bits);
            }
        }
        leaves
    }

    /// Checks a cone.
    ///
    /// # Panics
    ///
    /// What is no cause changes the signal.
    fn check(&self, found: &mut Found, sim: &mut Simulation, run: &Run, cause: &Cause, numbers: &mut Numbers) {
        // The name of the root is the one asked for, which may not be the best one.
        if is_leaf(cause) {
            return;
        }
        let (leaves, signal) = (self.leaves(cause, run.from.time()), cause.name.as_str());
        let mine = |time: u64, name: &str, width: u32| {
            leaves.get(&(time, name.to_owned())).cloned().unwrap_or_else(|| Bits::zero(width))
        };
        let same = self.forced(sim, run, signal, |_, _, value| value.clone());
        assert_eq!(same.as_ref(), Some(&cause.value), "`{signal}` is not the same again");
        found.cones += 1;
        for _ in 0..FORCED {
            let value = self.forced(sim, run, signal, |time, name, value| {
                mixed(&mine(time, name, value.width()), value, &numbers.bits(value.width()))
            });
            // An assertion may fail on the way.
            let Some(value) = value else { continue };
            found.forced += 1;
            assert_eq!(value, cause.value, "`{signal}` depends on something else than:\n{cause}");
        }
        let all: Vec<(&(u64, String), u32)> =
            leaves.iter().flat_map(|(key, bits)| ones(bits).into_iter().map(move |bit| (key, bit))).collect();
        found.leaves += all.len() as u64;
        let every = all.len().div_ceil(FLIPS).max(1);
        let mut answers = false;
        for ((time, name), bit) in all.iter().step_by(every) {
            let value = self.forced(sim, run, signal, |at, of, value| match at == *time && of == name {
                true => mixed(&Bits::zero(value.width()), value, &flipped(value, *bit)),
                false => value.clone(),
            });
            found.flipped += 1;
            let is_live = value.is_some_and(|value| value != cause.value);
            found.live += u64::from(is_live);
            answers |= is_live;
        }
        let mut any = |only_leaves: bool| {
            (0..TRIES).any(|_| {
                let value = self.forced(sim, run, signal, |time, name, value| {
                    let free = if only_leaves { mine(time, name, value.width()) } else { Bits::ones(value.width()) };
                    mixed(&free.not(), value, &numbers.bits(value.width()))
                });
                value.is_some_and(|value| value != cause.value)
            })
        };
        answers = answers || !all.is_empty() && any(true);
        found.answer += u64::from(answers);
        found.deaf += u64::from(!answers && any(false));
    }
}

/// Whether a cause has an end of its own.
fn is_leaf(cause: &Cause) -> bool {
    !matches!(cause.end, None | Some(End::Elsewhere | End::Constant))
}

/// Steps; whether all assertions pass.
fn goes_on(sim: &mut Simulation) -> bool {
    match sim.try_step() {
        Err(Error::Violated(_)) => false,
        done => done.map(|()| true).unwrap_or_else(|error| panic!("{error}")),
    }
}

fn index_of(shape: Shape, lane: u32) -> String {
    index(shape, lane)
}

/// The bits of a value where `mine` is 1, and those of another one elsewhere.
fn mixed(mine: &Bits, value: &Bits, other: &Bits) -> Bits {
    let limbs = mine.limbs().iter().zip(value.limbs()).zip(other.limbs());
    let limbs: Vec<u64> = limbs.map(|((mine, value), other)| mine & value | !mine & other).collect();
    Bits::from_limbs(value.width(), &limbs)
}

fn merged(a: &Bits, b: &Bits) -> Bits {
    mixed(a, a, b)
}

fn flipped(value: &Bits, bit: u32) -> Bits {
    let mut limbs = value.limbs().to_vec();
    limbs[bit as usize / 64] ^= 1 << (bit % 64);
    Bits::from_limbs(value.width(), &limbs)
}

/// The indices of the bits that are 1.
fn ones(bits: &Bits) -> Vec<u32> {
    (0..bits.width()).filter(|&bit| bits.bit(bit)).collect()
}

/// The names of all signals.
fn signals(sim: &Simulation) -> Vec<String> {
    let hierarchy = &sim.program().hierarchy;
    let places = hierarchy.places(0).into_iter();
    let named = places.flat_map(|place| {
        let signals = hierarchy.scope(place.scope).signals.iter();
        signals.flat_map(move |signal| {
            (0..signal.shape.lanes())
                .map(move |lane| hierarchy.path_in(place, &format!("{}{}", signal.name, index(signal.shape, lane))))
        })
    });
    named.collect()
}

/// Asks for the causes of some signals of a random design, in one clock and in many, and checks them.
///
/// # Panics
///
/// What is no cause of a signal changes it, or asking changes the simulation.
pub fn check(design: Design, seed: u64, kind: EngineKind) -> Found {
    let mut subject = Subject::new(design, seed, kind);
    let mut numbers = Numbers(!seed);
    let mut found = Found { designs: 1, ..Found::default() };
    let mut sim = subject.start();
    let start = sim.checkpoint();
    sim.remember_often(1 << 28, 1 + seed % 7);
    subject.run(&mut sim);
    let here = sim.checkpoint();
    let mut without = subject.start();
    without.restore(&here).expect("it is the design");
    let (names, mut other) = (signals(&sim), subject.start());
    for _ in 0..SIGNALS {
        let signal = &names[numbers.draw() as usize % names.len()];
        let limits = Limits { kept: true, ..Limits::none() };
        let cause = sim.why_within(signal.as_str(), &limits).unwrap_or_else(|error| panic!("{error}"));
        assert!(sim.checkpoint() == here, "to ask why changes the simulation");
        let run = Run { from: &start, steps: &subject.steps };
        subject.check(&mut found, &mut other, &run, &cause, &mut numbers);
        let cause = without.why_within(signal.as_str(), &limits).unwrap_or_else(|error| panic!("{error}"));
        let now = Step { word: None, ..subject.steps.last().expect("there is a step").clone() };
        subject.check(&mut found, &mut other, &Run { from: &here, steps: &[now] }, &cause, &mut numbers);
    }
    found
}

/// Checks designs of a seed, from a number on; gives the numbers of those that fail.
pub fn run(kind: Kind, seed: u64, first: u64, designs: u64) -> (Found, Vec<u64>) {
    let campaign = Campaign { kind, ..Campaign::icarus(seed, designs) };
    let (mut all, mut failing) = (Found::default(), Vec::new());
    for number in first..first + designs {
        let drawn = campaign.design(number);
        let design = drawn.design(number).unwrap_or_else(|problems| panic!("{problems}"));
        // Machine code takes long to make.
        let kind = if number % 32 == 5 { EngineKind::Compiled } else { EngineKind::Interpreter };
        let check = || check(design, drawn.stimulus().seed ^ number, kind);
        match catch_unwind(AssertUnwindSafe(check)) {
            Ok(found) => all += found,
            Err(_) => failing.push(number),
        }
    }
    (all, failing)
}

//! Runs a design in our simulator under random inputs, and keeps what went in and came out.

mod pads;

use crate::spec::{Pattern, Stimulus};
use tilewright_hdl::ir::Node;
use tilewright_hdl::{Bits, Design, Recording};
use tilewright_sim::{Covered, EngineKind, Passes, Simulation};

/// A small generator of numbers (SplitMix64): the same everywhere for a seed.
#[derive(Debug, Clone)]
pub struct Numbers(pub u64);

impl Numbers {
    /// The next number.
    pub fn draw(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A value that is an edge case half of the time.
    pub fn bits(&mut self, width: u32) -> Bits {
        let random = |numbers: &mut Numbers| {
            let limbs: Vec<u64> = (0..width.div_ceil(64)).map(|_| numbers.draw()).collect();
            Bits::from_limbs(width, &limbs)
        };
        match self.draw() % 12 {
            0 => Pattern::Zero.bits(width),
            1 => Pattern::Ones.bits(width),
            2 => Pattern::One.bits(width),
            3 => Pattern::Sign.bits(width),
            4 => Pattern::Sign.bits(width).not(),
            5 => Pattern::Alternating.bits(width),
            6 => Bits::new(width, self.draw() % 8),
            _ => random(self),
        }
    }

    /// A value of a port, lane beside lane: each lane one of its own, most often.
    pub fn lanes(&mut self, node: &Node) -> Bits {
        let lanes = node.shape.lanes();
        if node.shape.is_plain() || self.draw().is_multiple_of(4) {
            return self.bits(node.width * lanes);
        }
        Bits::join(&(0..lanes).map(|_| self.bits(node.width)).collect::<Vec<_>>())
    }
}

/// The recorded run of a design under a random stimulus, on both engines; all resets and single ones are given at random, and it ends where
/// an assertion fails. A run with other passes has to show the same.
///
/// # Errors
///
/// What the simulator says if it does not take the design.
///
/// # Panics
///
/// The engines differ, or a pass changes what the design does.
pub fn run(design: &Design, stimulus: &Stimulus) -> Result<Run, tilewright_sim::Error> {
    let recording = record(design, stimulus, Simulation::from_design(design)?.on(EngineKind::Both))?;
    let passes = passes(stimulus.seed);
    let sim = Simulation::with_passes(design, &passes)?;
    let sim = match passes == Passes::none() {
        true => sim.on(EngineKind::Interpreter),
        // Most of them begin on the interpreter.
        false => sim.code_after(stimulus.seed % 5),
    };
    for sim in one_or_two(sim, stimulus) {
        let other = record(design, stimulus, sim)?;
        let same = (&recording.recording.steps, recording.fails, &recording.covers, &recording.shown)
            == (&other.recording.steps, other.fails, &other.covers, &other.shown);
        assert!(same, "it does something else with {passes:?}");
    }
    Ok(recording)
}

/// The simulation, and for a third of the designs another one, which takes the code that the first makes.
pub(crate) fn one_or_two(sim: Simulation, stimulus: &Stimulus) -> Vec<Simulation> {
    let another = stimulus.seed.is_multiple_of(3).then(|| sim.another());
    [sim].into_iter().chain(another).collect()
}

/// A recorded run.
#[derive(Debug)]
pub struct Run {
    /// What went in and came out.
    pub recording: Recording,
    /// An assertion failed at its last edge.
    pub fails: bool,
    /// The covers, with how often each was hit.
    pub covers: Vec<Covered>,
    /// What displays showed, sorted.
    pub shown: Vec<String>,
}

/// All passes but one, or none at all; code for held inputs and functions that are cut early, no memory near.
pub(crate) fn passes(seed: u64) -> Passes {
    let versions = Passes { versions_after: 2, versions_from: 0, ..Passes::default() };
    let mut passes = Passes { held_after: 3, looks_after: 2, longest: 20, near: 0, pack_from: 8, ..versions };
    match seed % 13 {
        0 => passes = Passes::none(),
        1 => passes.siblings = false,
        2 => passes.fold = false,
        3 => passes.share = false,
        4 => passes.uniform = false,
        5 => passes.lift = false,
        6 => passes.postpone = false,
        7 => passes.branch = false,
        8 => passes.lookups = false,
        9 => passes.side_by_side = false,
        10 => passes.fields = false,
        11 => passes.pack_from = u32::MAX,
        _ => passes.blanks = false,
    }
    passes
}

pub(crate) fn record(design: &Design, stimulus: &Stimulus, mut sim: Simulation) -> Result<Run, tilewright_sim::Error> {
    let mut numbers = Numbers(stimulus.seed);
    let top = design.top();
    let inputs = top.inputs.iter().map(|input| Ok((sim.port(&input.name)?, top.node(input.node))));
    let inputs = inputs.collect::<Result<Vec<_>, tilewright_sim::Error>>()?;
    let outsides = pads::outsides(design, &sim);
    // A third starts from garbage.
    if stimulus.seed.is_multiple_of(3) {
        sim = sim.seeded(stimulus.seed | 1);
    }
    let (recording, messages) = (sim.recording(), sim.messages());
    // Of a FIFO between clocks both sides are reset, or neither.
    let crosses = design.modules().iter().any(|module| module.name.contains("dual_clock_fifo"));
    let resets = top.clocks.iter().filter(|clock| clock.reset.is_some() && !crosses).map(|clock| clock.port.as_str());
    let mut resets: Vec<(&str, bool)> = resets.map(|clock| (clock, false)).collect();
    let mut fails = false;
    for _ in 0..stimulus.steps {
        for (port, node) in &inputs {
            // Inputs that stay let state machines and enables show their other side.
            if !numbers.draw().is_multiple_of(4) {
                sim.set(*port, numbers.lanes(node));
            }
        }
        if numbers.draw().is_multiple_of(16) && !resets.is_empty() {
            let clock = numbers.draw() as usize % resets.len();
            let (clock, active) = &mut resets[clock];
            *active = !*active;
            sim.set_reset(*clock, *active);
        }
        outsides.iter().for_each(|outside| outside.give_way(&mut sim, &mut numbers));
        let resets_all = numbers.draw().is_multiple_of(12);
        if resets_all {
            resets.iter_mut().for_each(|(_, active)| *active = false);
        }
        let done = if resets_all { sim.try_reset() } else { sim.try_step() };
        match done {
            Err(tilewright_sim::Error::Violated(_)) => {
                fails = true;
                break;
            }
            done => done?,
        }
    }
    // Arrays are in another order where they run one by one.
    let mut covers = sim.covers();
    covers.sort_by(|a, b| (&a.path, a.count).cmp(&(&b.path, b.count)));
    let mut shown = messages.lines();
    shown.sort();
    Ok(Run { recording: recording.take(), fails, covers, shown })
}

//! Random networks of streams: blocks of the library one behind the other, side by side, in loops, and from one clock to another.

mod step;

use crate::features::Feature;
use crate::spec::Stimulus;
use proptest::prelude::*;
use tilewright_blocks::{Slice, StreamBlocks, StreamIn, StreamOut, Turns};
use tilewright_hdl::{
    Clock, DEFAULT_PERIOD, DefaultClock, Design, Module, Period, Problems, Reset, Stream, Width, bits, block,
    elaborate_at, stream,
};

/// A network, and what is done to it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Spec {
    /// The bits of a word.
    pub width: u32,
    /// What the words go through, in order.
    pub steps: Vec<Step>,
    /// The period of the second clock in picoseconds, if there is one; the first has 10 ns.
    pub second_period: Option<u64>,
    /// The inputs over time.
    pub stimulus: Stimulus,
}

/// What words go through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Step {
    /// A queue.
    Fifo {
        /// Its words.
        depth: u32,
        /// It is in a block RAM.
        block_ram: bool,
    },
    /// A stack of so many words.
    Lifo(u32),
    /// Registers.
    Slice(Slice),
    /// So many sides of a fork, of which the last has a queue of so many words, joined again.
    Fork {
        /// The sides.
        receivers: u32,
        /// The words.
        depth: u32,
    },
    /// Words by their lowest bits: the last of so many ways has a stack of so many words, and they meet again.
    Split {
        /// The ways.
        ways: u32,
        /// The words.
        depth: u32,
        /// Whose turn it is where they meet.
        turns: Turns,
    },
    /// Wider words of so many, and back.
    Parts(u32),
    /// An array of two queues of so many words.
    Array(u32),
    /// Odd words once more from the start, increased, through a stack.
    Again(u32),
    /// A record made of each word, with a row in it, through a queue and a stack of so many.
    Record {
        /// Their words.
        depth: u32,
        /// The queue is in a block RAM.
        block_ram: bool,
    },
    /// The same through an array of two queues.
    Records(u32),
    /// So many stages of a pipeline, with a word in each.
    Stages {
        /// The stages.
        count: u32,
        /// The words are records.
        records: bool,
    },
    /// A queue to the other clock, if there is one: the logarithm of its words.
    Cross(u32),
}

/// Random networks.
pub fn designs() -> impl Strategy<Value = Spec> {
    let depth = 1u32..5;
    let step = prop_oneof![
        (depth.clone(), any::<bool>()).prop_map(|(depth, block_ram)| Step::Fifo { depth, block_ram }),
        depth.clone().prop_map(Step::Lifo),
        prop::sample::select(vec![Slice::Forward, Slice::Backward, Slice::Both]).prop_map(Step::Slice),
        (2..5u32, depth.clone()).prop_map(|(receivers, depth)| Step::Fork { receivers, depth }),
        (2..5u32, depth.clone(), prop::sample::select(vec![Turns::RoundRobin, Turns::Priority]))
            .prop_map(|(ways, depth, turns)| Step::Split { ways, depth, turns }),
        (1u32..4).prop_map(Step::Parts),
        depth.clone().prop_map(Step::Array),
        depth.clone().prop_map(Step::Again),
        (depth.clone(), any::<bool>()).prop_map(|(depth, block_ram)| Step::Record { depth, block_ram }),
        depth.prop_map(Step::Records),
        (1..4u32, any::<bool>()).prop_map(|(count, records)| Step::Stages { count, records }),
        (1..4u32).prop_map(Step::Cross),
    ];
    let second_period = proptest::option::weighted(0.5, prop::sample::select(vec![10_000u64, 14_000, 26_002, 6_000]));
    let stimulus = (10..60u8, any::<u64>()).prop_map(|(steps, seed)| Stimulus { steps, seed });
    (prop_oneof![2u32..12, 15u32..30, 60u32..70], prop::collection::vec(step, 1..6), second_period, stimulus)
        .prop_map(|(width, steps, second_period, stimulus)| Spec { width, steps, second_period, stimulus })
}

/// The design, whose modules' names begin with `name`: those of several designs go to one run of another simulator.
///
/// # Errors
///
/// The rules that it breaks, which is a mistake of the library or of the language.
pub fn design(spec: &Spec, name: &str) -> Result<Design, Problems> {
    let clocks = spec.second_period.map(|period| [("first", 10_000), ("second", period)]);
    let [own, second] = spec.stimulus.resets();
    // Of a FIFO between clocks both sides are reset, or neither.
    let second = if [own, second].contains(&Reset::PowerOn) { own } else { second };
    let [edge, other_edge] = spec.stimulus.edges();
    let clocks = clocks.map(|[first, other]| {
        [(first, own, edge), (other, second, other_edge)]
            .map(|((name, period), reset, edge)| Clock { edge, ..Clock::new(name, Period::ps(period)).reset(reset) })
    });
    let network = Network { width: spec.width, steps: spec.steps.clone(), clocks };
    let mut modules =
        elaborate_at(&network, DefaultClock { edge, ..DefaultClock::new(DEFAULT_PERIOD).reset(own) })?.into_modules();
    modules.iter_mut().for_each(|module| module.name = format!("{name}_{}", module.name));
    modules.last_mut().expect("there is a top").name = name.to_owned();
    Design::new(modules)
}

block! {
    /// Words through some steps.
    struct Network {
        width: u32,
        steps: Vec<Step>,
        clocks: Option<[Clock; 2]>,
    }
    in(self) = StreamIn { into: self.input() };
    out(self) = StreamOut { out: stream(bits(self.width)) };
}

impl Network {
    fn input(&self) -> Stream<Width, Width> {
        let words = stream(bits(self.width));
        self.clocks.map_or(words, |[first, _]| words.on(first))
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        let (mut clocks, mut at) = (self.clocks, m);
        if let Some([first, _]) = clocks {
            at = m.on(first);
        }
        // A step may be wires alone, and every design has a clock.
        let mut words = at.slice("u_first", Slice::Forward, i.into);
        for (number, step) in self.steps.iter().enumerate() {
            let name = format!("u{number}");
            if let (Step::Cross(places), Some([here, there])) = (step, clocks) {
                Feature::CrossByFifo.used();
                words = m.cross_by_fifo(&name, 1 << places, (here, there), words);
                (clocks, at) = (Some([there, here]), m.on(there));
            } else {
                words = step.build(at, &name, words);
            }
        }
        StreamOut { out: words }
    }
}

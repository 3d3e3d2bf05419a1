//! Random networks of streams: blocks of the library one behind the other, side by side, and in loops.

use crate::spec::Stimulus;
use proptest::prelude::*;
use tilewright_blocks::{Fifo, Slice, Storage, StreamBlocks, StreamIn, StreamOut, Turns};
use tilewright_hdl::{Design, Module, Problems, Stream, bits, block, bundle, elaborate, stack, stream};

/// A network, and what is done to it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Spec {
    /// The bits of a word.
    pub width: u32,
    /// What the words go through, in order.
    pub steps: Vec<Step>,
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
    /// Both sides of a fork, of which one has a queue of so many words, joined again.
    Fork(u32),
    /// Odd words through a stack, even ones around it.
    Split(u32, Turns),
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
}

bundle! {
    /// What is made of a word.
    struct Record<T> { lanes: T, word: T, odd: T }
}

/// Random networks.
pub fn designs() -> impl Strategy<Value = Spec> {
    let depth = 1u32..5;
    let step = prop_oneof![
        (depth.clone(), any::<bool>()).prop_map(|(depth, block_ram)| Step::Fifo { depth, block_ram }),
        depth.clone().prop_map(Step::Lifo),
        prop::sample::select(vec![Slice::Forward, Slice::Backward, Slice::Both]).prop_map(Step::Slice),
        depth.clone().prop_map(Step::Fork),
        (depth.clone(), prop::sample::select(vec![Turns::RoundRobin, Turns::Priority]))
            .prop_map(|(depth, turns)| Step::Split(depth, turns)),
        (1u32..4).prop_map(Step::Parts),
        depth.clone().prop_map(Step::Array),
        depth.clone().prop_map(Step::Again),
        (depth.clone(), any::<bool>()).prop_map(|(depth, block_ram)| Step::Record { depth, block_ram }),
        depth.prop_map(Step::Records),
    ];
    let stimulus = (10..60u8, any::<u64>()).prop_map(|(steps, seed)| Stimulus { steps, seed });
    (prop_oneof![2u32..12, 15u32..30, 60u32..70], prop::collection::vec(step, 1..6), stimulus)
        .prop_map(|(width, steps, stimulus)| Spec { width, steps, stimulus })
}

/// The design, whose modules' names begin with `name`: those of several designs go to one run of another simulator.
///
/// # Errors
///
/// The rules that it breaks, which is a mistake of the library or of the language.
pub fn design(spec: &Spec, name: &str) -> Result<Design, Problems> {
    let mut modules = elaborate(&Network { width: spec.width, steps: spec.steps.clone() })?.into_modules();
    modules.iter_mut().for_each(|module| module.name = format!("{name}_{}", module.name));
    modules.last_mut().expect("there is a top").name = name.to_owned();
    Design::new(modules)
}

block! {
    /// Words through some steps.
    struct Network {
        width: u32,
        steps: Vec<Step>,
    }
    in(self) = StreamIn { into: stream(bits(self.width)) };
    out(self) = StreamOut { out: stream(bits(self.width)) };
}

impl Network {
    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        // A step may be wires alone, and every design has a clock.
        let mut words = m.slice("u_first", Slice::Forward, i.into);
        for (number, step) in self.steps.iter().enumerate() {
            words = step.build(m, &format!("u{number}"), words);
        }
        StreamOut { out: words }
    }
}

impl Step {
    fn build(self, m: Module, name: &str, words: Stream) -> Stream {
        let part = |part: &str| format!("{name}_{part}");
        match self {
            Step::Fifo { depth, block_ram: false } => m.fifo(name, depth, words),
            Step::Fifo { depth, block_ram: true } => m.block_ram_fifo(name, depth, words),
            Step::Lifo(depth) => m.lifo(name, depth, words),
            Step::Slice(cuts) => m.slice(name, cuts, words),
            Step::Fork(depth) => {
                let [one, other] = m.fork(name, words);
                let other = m.fifo(&part("fifo"), depth, other);
                m.join(one, other, |one, other| one ^ (other + 1))
            }
            Step::Split(depth, turns) => {
                let [even, odd] = m.split_by(words, |word| word.bit(0));
                let odd = m.lifo(&part("lifo"), depth, odd);
                m.arbiter(name, turns, [even, odd])
            }
            Step::Parts(parts) => {
                let wide = m.widen(&part("widen"), parts, words);
                m.narrow(name, parts, wide)
            }
            Step::Array(depth) => {
                let fifo = Fifo::new(depth, words.width(), Storage::Registers);
                let parts: [_; 2] = m.split_by(words, |word| word.msb());
                let rows = m.array(&part("fifo"), 2, &fifo, |_| StreamIn { into: stack(parts) });
                m.arbiter(name, Turns::RoundRobin, rows.out.lanes())
            }
            Step::Again(depth) => {
                let again = m.stream_wire(&part("again"), words.width());
                let all = m.arbiter(name, Turns::Priority, [*again, words]);
                let [even, odd] = m.split_by(m.fifo(&part("fifo"), depth, all), |word| word.bit(0));
                again.drive(m.lifo(&part("lifo"), depth, odd.with(*odd + 1)));
                even
            }
            Step::Record { depth, block_ram } => {
                let records = to_records(words);
                let records = match block_ram {
                    false => m.fifo(name, depth, records),
                    true => m.block_ram_fifo(name, depth, records),
                };
                to_words(m.slice(&part("slice"), Slice::Both, m.lifo(&part("lifo"), depth, records)))
            }
            Step::Records(depth) => {
                let records = to_records(words);
                let packed = records.packed();
                let fifo = Fifo::new(depth, packed.width(), Storage::Registers);
                let parts: [_; 2] = m.split_by(packed, |word| word.bit(0));
                let rows = m.array(&part("fifo"), 2, &fifo, |_| StreamIn { into: stack(parts) });
                let all = m.arbiter(name, Turns::RoundRobin, rows.out.lanes());
                to_words(all.unpacked(&*records))
            }
        }
    }
}

/// Records whose fields are computed of words.
fn to_records(words: Stream) -> Stream<Record> {
    let lanes = stack([*words, !*words, *words + 1]);
    words.with(Record { lanes, word: *words, odd: words.bit(0) })
}

/// Words that all fields are in.
fn to_words(records: Stream<Record>) -> Stream {
    let all = (records.lanes.xor_all() ^ records.word) + records.odd.zext(records.word.width());
    records.with(all)
}

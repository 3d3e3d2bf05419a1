//! Every block of streams under random stalls.

use crate::streams::property::{BACKWARD, BOTH, Cuts, End, FORWARD, NONE, Stalls, through};
use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_hdl::{Block, Bundle, Module, Stream, Width, below, bits, lit, stream};
use tilewright_sim::{Port, Simulation};

pub fn stalls() -> impl Strategy<Value = Stalls> {
    let percent = || prop_oneof![Just(0), Just(50), 1u64..90];
    (percent(), percent(), any::<u64>()).prop_map(|(senders, receivers, seed)| Stalls { senders, receivers, seed })
}

fn words(below: u64) -> impl Strategy<Value = Vec<u64>> {
    prop::collection::vec(0..below, 0..60)
}

/// The words that each receiver takes from the block, for the senders' words.
fn result<B: Block>(
    block: &B,
    into: impl Fn(&<B::In as Bundle>::Of<Port>) -> Vec<Stream<Port, Port>>,
    out: impl Fn(&<B::Out as Bundle>::Of<Port>) -> Vec<Stream<Port, Port>>,
    (words, counts): (&[Vec<u64>], &[usize]),
    stalls: Stalls,
    cuts: Cuts,
) -> Vec<Vec<u64>> {
    // Registers without a reset, and memories, start with any value.
    let mut sim = Simulation::of(block).unwrap().seeded(stalls.seed);
    sim.reset();
    let ends = |streams: Vec<Stream<Port, Port>>| streams.into_iter().map(End::of).collect::<Vec<_>>();
    let (into, out) = (ends(into(&sim.i)), ends(out(&sim.o)));
    through(&mut sim, (&into, &out), words, counts, stalls, cuts)
}

/// The words that the receiver takes from a block with one stream in and one out; `count` words are expected.
pub fn passed<B: Block<In = StreamIn, Out = StreamOut>>(
    block: &B,
    words: &[u64],
    count: usize,
    stalls: Stalls,
    cuts: Cuts,
) -> Vec<u64> {
    result(block, |i| vec![i.into], |o| vec![o.out], (&[words.to_vec()], &[count]), stalls, cuts).remove(0)
}

/// A split of words whose upper part is the receiver's number.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct SplitWords(u32);

impl Block for SplitWords {
    type In = StreamIn;
    type Out = ForkOut;

    fn inputs(&self) -> StreamIn<Width> {
        StreamIn { into: stream(bits(below(self.0).bits() + 8)) }
    }

    fn build(&self, m: Module, i: StreamIn) -> ForkOut {
        let like = Addressed { to: lit(below(self.0), 0), word: lit(8, 0) };
        let out = m.instance("u_split", &Split::new(self.0, 8), SplitIn { into: i.into.unpacked(&like) }).out;
        ForkOut { out }
    }
}

#[test]
#[should_panic(expected = "a word goes to one of 3 receivers")]
fn a_word_without_a_receiver() {
    result(
        &SplitWords(3),
        |i| vec![i.into],
        |o| o.out.clone(),
        (&[vec![0x300]], &[0; 3]),
        Stalls { senders: 0, receivers: 0, seed: 1 },
        NONE,
    );
}

/// Stages, each of which adds its number.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Stages(u32);

impl Block for Stages {
    type In = StreamIn;
    type Out = StreamOut;

    fn inputs(&self) -> StreamIn<Width> {
        StreamIn { into: stream(8) }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        StreamOut { out: m.stream_stages(self.0, i.into, |stage, word| word + stage) }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn queues(depth in 1u32..10, block_ram: bool, words in words(256), stalls in stalls()) {
        let storage = if block_ram { Storage::BlockRam } else { Storage::Registers };
        prop_assert_eq!(passed(&Fifo::new(depth, 8, storage), &words, words.len(), stalls, BOTH), words);
    }

    #[test]
    fn register_slices(kind in 0usize..3, words in words(256), stalls in stalls()) {
        let (cuts, paths) = [(Slice::Forward, FORWARD), (Slice::Backward, BACKWARD), (Slice::Both, BOTH)][kind];
        prop_assert_eq!(passed(&RegisterSlice { width: 8, cuts }, &words, words.len(), stalls, paths), words);
    }

    #[test]
    fn stages_of_streams(count in 1u32..6, words in words(200), stalls in stalls()) {
        let expected: Vec<u64> = words.iter().map(|word| word + u64::from(count * (count + 1) / 2)).collect();
        prop_assert_eq!(passed(&Stages(count), &words, words.len(), stalls, FORWARD), expected);
    }

    #[test]
    fn forks(receivers in 1u32..5, words in words(256), stalls in stalls()) {
        let fork = Fork::new(receivers, 8);
        let received = result(&fork, |i| vec![i.into], |o| o.out.clone(), (std::slice::from_ref(&words), &vec![words.len(); receivers as usize]), stalls, NONE);
        prop_assert_eq!(received, vec![words; receivers as usize]);
    }

    #[test]
    fn splits(receivers in 1u32..6, words in words(256), stalls in stalls()) {
        let to = |word: &u64| word % u64::from(receivers);
        let sent: Vec<u64> = words.iter().map(|word| to(word) << 8 | word).collect();
        let of = |number: u32| words.iter().copied().filter(|word| to(word) == number.into()).collect::<Vec<_>>();
        let expected: Vec<_> = (0..receivers).map(of).collect();
        let counts: Vec<_> = expected.iter().map(Vec::len).collect();
        let split = SplitWords(receivers);
        let received = result(&split, |i| vec![i.into], |o| o.out.clone(), (&[sent], &counts), stalls, NONE);
        prop_assert_eq!(received, expected);
    }

    #[test]
    fn joins(left in words(256), right in words(16), stalls in stalls()) {
        let count = left.len().min(right.len());
        let sent = [left[..count].to_vec(), right[..count].to_vec()];
        let pairs: Vec<u64> = left.iter().zip(&right).map(|(left, right)| left << 4 | right).collect();
        let received = result(&Join::new(8, 4), |i| vec![i.left, i.right], |o| vec![o.out], (&sent, &[count]), stalls, NONE);
        prop_assert_eq!(received, vec![pairs]);
    }

    #[test]
    fn arbiters(fair: bool, sent in prop::collection::vec(words(256), 1..6), stalls in stalls()) {
        let turns = if fair { Turns::RoundRobin } else { Turns::Priority };
        // A word encodes its sender.
        let from = |sender: usize, words: &Vec<u64>| words.iter().map(|word| (sender as u64) << 8 | word).collect();
        let sent: Vec<Vec<u64>> = sent.iter().enumerate().map(|(sender, words)| from(sender, words)).collect();
        let count = sent.iter().map(Vec::len).sum();
        let arbiter = Arbiter::new(sent.len() as u32, 11, turns);
        let received = result(&arbiter, |i| i.into.clone(), |o| vec![o.out], (&sent, &[count]), stalls, NONE).remove(0);
        let of = |sender: u64| received.iter().copied().filter(|word| word >> 8 == sender).collect::<Vec<_>>();
        prop_assert_eq!((0..sent.len() as u64).map(of).collect::<Vec<_>>(), sent);
    }

    #[test]
    fn narrower_words(parts in 1u32..6, words in words(1 << 3), stalls in stalls()) {
        // Each part encodes its word and its position.
        let all: u64 = (0..parts).map(|place| u64::from(place) << (6 * place)).sum();
        let repeated = |word: u64| (0..parts).map(|place| word << (6 * place + 3)).sum::<u64>();
        let sent: Vec<u64> = words.iter().map(|word| all | repeated(*word)).collect();
        let expected: Vec<u64> = words.iter().flat_map(|word| (0..parts).map(move |place| word << 3 | u64::from(place))).collect();
        prop_assert_eq!(passed(&Narrow::new(parts, 6), &sent, expected.len(), stalls, NONE), expected);
    }

    #[test]
    fn wider_words(parts in 1u32..6, words in words(256), stalls in stalls()) {
        let whole = words.chunks_exact(parts as usize);
        let expected: Vec<u64> = whole.map(|parts| parts.iter().rev().fold(0, |word, part| word << 8 | part)).collect();
        prop_assert_eq!(passed(&Widen::new(parts, 8), &words, expected.len(), stalls, FORWARD), expected);
    }
}

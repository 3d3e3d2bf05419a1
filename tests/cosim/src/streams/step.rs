//! What words go through, as hardware.

use super::Step;
use crate::features::Feature;
use tilewright_blocks::{Fifo, Slice, Storage, StreamBlocks, StreamIn, Turns};
use tilewright_hdl::{Module, Signal, Stream, bundle, codes, mux, stack};

codes! {
    /// Fewer codes than two bits have.
    enum Hue { Cyan, Magenta, Yellow }
}

bundle! {
    /// What is made of a word: lanes, itself, a bit, a code, and a signed number.
    struct Record<T> { lanes: T, word: T, odd: T, hue: T, height: T }
}

impl Step {
    /// The words behind it.
    pub fn build(self, m: Module, name: &str, words: Stream) -> Stream {
        let part = |part: &str| format!("{name}_{part}");
        match self {
            Step::Fifo { depth, block_ram: false } => m.fifo(name, depth, words),
            Step::Fifo { depth, block_ram: true } => m.block_ram_fifo(name, depth, words),
            Step::Lifo(depth) => m.lifo(name, depth, words),
            Step::Slice(cuts) => m.slice(name, cuts, words),
            Step::Fork { receivers, depth } => {
                let mut sides = forked(m, name, receivers, words);
                let last = sides.pop().expect("a fork has receivers");
                sides.push(m.fifo(&part("fifo"), depth, last));
                let joined = |one, other| m.join(one, other, |one: Signal, other: Signal| one ^ (other + 1));
                sides.into_iter().reduce(joined).expect("a fork has receivers")
            }
            Step::Split { ways, depth, turns } => {
                let mut all = split(m, ways, words);
                let last = all.pop().expect("there are ways");
                all.push(m.lifo(&part("lifo"), depth, last));
                if ways > 2 {
                    Feature::ArbiterOfMany.used();
                }
                m.arbiter(name, turns, all)
            }
            Step::Parts(parts) => {
                let wide = m.widen(&part("widen"), parts, words);
                m.narrow(name, parts, wide)
            }
            Step::Array(depth) => {
                let fifo = Fifo::new(depth, words.width(), Storage::Registers);
                let parts: [_; 2] = m.split_by(words, |word| word.msb().any_stage());
                let rows = m.array(&part("fifo"), 2, &fifo, |_| StreamIn { into: stack(parts) });
                m.arbiter(name, Turns::RoundRobin, rows.out.lanes())
            }
            Step::Again(depth) => {
                let again = m.stream_wire(&part("again"), words.width());
                let all = m.arbiter(name, Turns::Priority, [*again, words]);
                let [even, odd] = m.split_by(m.fifo(&part("fifo"), depth, all), is_odd);
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
                let parts: [_; 2] = m.split_by(packed, is_odd);
                let rows = m.array(&part("fifo"), 2, &fifo, |_| StreamIn { into: stack(parts) });
                let all = m.arbiter(name, Turns::RoundRobin, rows.out.lanes());
                to_words(all.unpacked(&*records))
            }
            Step::Stages { count, records: true } => {
                Feature::StreamStages.used();
                let stage = |_, now: Record| Record {
                    hue: mux(now.hue.is(Hue::Cyan), Hue::Yellow, now.hue),
                    height: now.height - 1,
                    ..now
                };
                to_words(m.within(name, || m.stream_stages(count, to_records(words), stage)))
            }
            Step::Stages { count, records: false } => {
                Feature::StreamStages.used();
                m.within(name, || m.stream_stages(count, words, |stage, word| word + u64::from(stage % 2)))
            }
            // There is no other clock.
            Step::Cross(_) => words,
        }
    }
}

/// The lowest bit, which says where a word goes: whether the stage of a pipeline before it is ready follows from that.
fn is_odd(word: &Signal) -> Signal {
    word.bit(0).any_stage()
}

/// So many copies of a stream, from 2 to 4.
fn forked(m: Module, name: &str, receivers: u32, words: Stream) -> Vec<Stream> {
    if receivers > 2 {
        Feature::ForkToMany.used();
    }
    match receivers {
        2 => m.fork::<_, 2>(name, words).into(),
        3 => m.fork::<_, 3>(name, words).into(),
        _ => m.fork::<_, 4>(name, words).into(),
    }
}

/// The words of a stream by their lowest bits, to so many receivers, from 2 to 4.
fn split(m: Module, ways: u32, words: Stream) -> Vec<Stream> {
    if ways > 2 {
        Feature::SplitToMany.used();
    }
    let low = |word: &Signal| word.trunc(2).any_stage();
    match ways {
        2 => m.split_by::<_, 2>(words, is_odd).into(),
        // To one of three: what ends with 3 goes to the first.
        3 => m.split_by::<_, 3>(words, |word| mux(low(word).all_ones(), 0, low(word))).into(),
        _ => m.split_by::<_, 4>(words, low).into(),
    }
}

/// Records whose fields are computed of words.
fn to_records(words: Stream) -> Stream<Record> {
    Feature::CodeInAStream.used();
    Feature::SignedInAStream.used();
    let lanes = stack([*words, !*words, *words + 1]);
    let other: Signal = mux(words.msb(), Hue::Magenta, Hue::Yellow);
    let hue = mux(words.bit(0), Hue::Cyan, other);
    words.with(Record { lanes, word: *words, odd: words.bit(0), hue, height: words.signed() >> 1 })
}

/// Words that all fields are in.
fn to_words(records: Stream<Record>) -> Stream {
    let Record { lanes, word, odd, hue, height } = *records;
    let coloured = hue.choose(|hue| match hue {
        Hue::Cyan => word + odd.zext(word.width()),
        Hue::Magenta => word - 1,
        Hue::Yellow => !word,
    });
    records.with((lanes.xor_all() ^ coloured) + mux(height.lt(0), -height, height + 1).bits())
}

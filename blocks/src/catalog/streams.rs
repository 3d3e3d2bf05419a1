//! The entries of blocks of streams.
//!
//! A scenario does not react to the block's outputs. So it keeps each word on the inputs for as many clocks as the
//! block needs.

use crate::{
    Addressed, Arbiter, ArbiterIn, DualClockFifo, Fifo, Fork, Join, JoinIn, Lifo, Narrow, RegisterSlice, Slice, Split,
    SplitIn, Storage, StreamIn, Turns, Widen,
};
use tilewright_hdl::catalog::{CatalogError, Entry, Parameter, Values};
use tilewright_hdl::{Block, Clock, DEFAULT_PERIOD, Period, Scenario, Script, Stream, elaborate};

const DEPTH: Parameter = Parameter { name: "depth", default: 3, min: 1, max: 4096, meaning: "capacity in words" };
const WIDTH: Parameter = Parameter { name: "width", default: 8, min: 4, max: 1024, meaning: "bits of a word" };

pub(super) const FIFO: Entry = Entry {
    name: "fifo",
    summary: "a queue in registers or distributed memory",
    parameters: &[DEPTH, WIDTH],
    design: |values| Ok(elaborate(&fifo(values, Storage::Registers))?),
    scenario: |values| Ok(fill_and_empty(&fifo(values, Storage::Registers), values.get("depth"))),
};

pub(super) const BLOCK_RAM_FIFO: Entry = Entry {
    name: "block-ram-fifo",
    summary: "a queue in a block RAM",
    parameters: &[DEPTH, WIDTH],
    design: |values| Ok(elaborate(&fifo(values, Storage::BlockRam))?),
    scenario: |values| Ok(fill_and_empty(&fifo(values, Storage::BlockRam), values.get("depth"))),
};

pub(super) const DUAL_CLOCK_FIFO: Entry = Entry {
    name: "dual-clock-fifo",
    summary: "a queue from one clock to another",
    parameters: &[
        Parameter { name: "depth", default: 4, min: 2, max: 4096, meaning: "capacity in words, a power of two" },
        WIDTH,
    ],
    design: |values| Ok(elaborate(&dual_clock_fifo(values)?)?),
    scenario: |values| Ok(cross(&dual_clock_fifo(values)?)),
};

pub(super) const LIFO: Entry = Entry {
    name: "lifo",
    summary: "a stack",
    parameters: &[
        Parameter { name: "depth", default: 3, min: 1, max: 4096, meaning: "capacity in words, besides the one shown" },
        WIDTH,
    ],
    design: |values| Ok(elaborate(&lifo(values))?),
    scenario: |values| Ok(fill_and_empty(&lifo(values), values.get("depth") + 1)),
};

pub(super) const FORWARD_SLICE: Entry = Entry {
    name: "forward-slice",
    summary: "registers on `valid` and the payload of a stream",
    parameters: &[WIDTH],
    design: |values| Ok(elaborate(&slice(values, Slice::Forward))?),
    scenario: |values| Ok(a_stall(&slice(values, Slice::Forward))),
};

pub(super) const BACKWARD_SLICE: Entry = Entry {
    name: "backward-slice",
    summary: "a register on `ready` of a stream",
    parameters: &[WIDTH],
    design: |values| Ok(elaborate(&slice(values, Slice::Backward))?),
    scenario: |values| Ok(a_stall(&slice(values, Slice::Backward))),
};

pub(super) const SKID_BUFFER: Entry = Entry {
    name: "skid-buffer",
    summary: "registers on both directions of a stream",
    parameters: &[WIDTH],
    design: |values| Ok(elaborate(&slice(values, Slice::Both))?),
    scenario: |values| Ok(a_stall(&slice(values, Slice::Both))),
};

pub(super) const FORK: Entry = Entry {
    name: "fork",
    summary: "gives each word to several receivers",
    parameters: &[Parameter { name: "receivers", default: 2, min: 2, max: 64, meaning: "number of receivers" }, WIDTH],
    design: |values| Ok(elaborate(&fork(values))?),
    scenario: |values| Ok(one_after_another(&fork(values), values.get("receivers"))),
};

pub(super) const JOIN: Entry = Entry {
    name: "join",
    summary: "joins a word of each of two streams into one word",
    parameters: &[
        Parameter { name: "left", default: 8, min: 4, max: 512, meaning: "bits of a word of the left stream" },
        Parameter { name: "right", default: 4, min: 4, max: 512, meaning: "bits of a word of the right stream" },
    ],
    design: |values| Ok(elaborate(&join(values))?),
    scenario: |values| Ok(one_waits_for_the_other(&join(values))),
};

pub(super) const SPLIT: Entry = Entry {
    name: "split",
    summary: "sends each word to the receiver whose number comes with it",
    parameters: &[Parameter { name: "receivers", default: 3, min: 2, max: 64, meaning: "number of receivers" }, WIDTH],
    design: |values| Ok(elaborate(&split(values))?),
    scenario: |values| Ok(to_each_in_turn(&split(values), values.get("receivers"))),
};

const SENDERS: Parameter = Parameter { name: "senders", default: 3, min: 2, max: 64, meaning: "number of senders" };

pub(super) const ROUND_ROBIN_ARBITER: Entry = Entry {
    name: "round-robin-arbiter",
    summary: "merges several streams into one, round robin",
    parameters: &[SENDERS, WIDTH],
    design: |values| Ok(elaborate(&arbiter(values, Turns::RoundRobin))?),
    scenario: |values| Ok(all_at_once(&arbiter(values, Turns::RoundRobin), values.get("senders"))),
};

pub(super) const PRIORITY_ARBITER: Entry = Entry {
    name: "priority-arbiter",
    summary: "merges several streams into one, the lowest stream first",
    parameters: &[SENDERS, WIDTH],
    design: |values| Ok(elaborate(&arbiter(values, Turns::Priority))?),
    scenario: |values| Ok(all_at_once(&arbiter(values, Turns::Priority), values.get("senders"))),
};

const PARTS: Parameter = Parameter { name: "parts", default: 3, min: 1, max: 64, meaning: "parts of the wide word" };
const PART: Parameter = Parameter { name: "width", default: 4, min: 4, max: 64, meaning: "bits of a part" };

pub(super) const NARROW: Entry = Entry {
    name: "narrow",
    summary: "sends each word in parts",
    parameters: &[PARTS, PART],
    design: |values| Ok(elaborate(&narrow(values))?),
    scenario: |values| Ok(two_words_in_parts(&narrow(values), values.get("parts"))),
};

pub(super) const WIDEN: Entry = Entry {
    name: "widen",
    summary: "joins several parts into a word",
    parameters: &[PARTS, PART],
    design: |values| Ok(elaborate(&widen(values))?),
    scenario: |values| Ok(parts_of_two_words(&widen(values), values.get("parts"))),
};

/// The inputs with a word of the sender, or with none.
fn word(word: Option<u64>) -> StreamIn<u64> {
    StreamIn { into: Stream::of(word.is_some().into(), word.unwrap_or(0)) }
}

fn fifo(values: &Values, storage: Storage) -> Fifo {
    Fifo::new(values.get_u32("depth"), values.get_u32("width"), storage)
}

fn lifo(values: &Values) -> Lifo {
    Lifo::new(values.get_u32("depth"), values.get_u32("width"))
}

fn fill_and_empty<B: Block<In = StreamIn>>(block: &B, capacity: u64) -> Scenario {
    let mut script = Script::new(block, DEFAULT_PERIOD);
    for number in 1..=capacity {
        script.clock(&word(Some(number % 16)));
    }
    script.clock(&word(Some((capacity + 1) % 16)));
    script.ready("out", true);
    script.hold(&word(Some((capacity + 1) % 16)), 2);
    script.hold(&word(None), capacity + 3);
    script.finish(
        "the block is filled, and one more word waits until the receiver takes the first; then the block is emptied",
    )
}

fn dual_clock_fifo(values: &Values) -> Result<DualClockFifo, CatalogError> {
    let depth = values.get_u32("depth");
    if !depth.is_power_of_two() {
        let next = depth.next_power_of_two();
        return Err(CatalogError::Parameters(format!(
            "depth = {depth} is no power of two: set {next}, or {}",
            next / 2
        )));
    }
    let clock = |name, period| Clock::new(name, Period::ns(period));
    Ok(DualClockFifo::new(depth, values.get_u32("width"), clock("write", 10), clock("read", 14)))
}

fn cross(fifo: &DualClockFifo) -> Scenario {
    let mut script = Script::new(fifo, Period::ns(10));
    script.ready("out", true);
    for number in 1..=2 {
        script.clock(&word(Some(number)));
    }
    script.hold(&word(None), 10);
    script.finish("two words are written on a clock of 10 ns, and come out on one of 14 ns, 3 of its edges later")
}

fn slice(values: &Values, cuts: Slice) -> RegisterSlice {
    RegisterSlice { width: values.get_u32("width"), cuts }
}

fn a_stall(slice: &RegisterSlice) -> Scenario {
    let mut script = Script::new(slice, DEFAULT_PERIOD);
    script.ready("out", true);
    script.clock(&word(Some(1)));
    script.clock(&word(Some(2)));
    script.ready("out", false);
    let has_room = slice.cuts != Slice::Forward;
    if has_room {
        script.clock(&word(Some(3)));
    }
    script.hold(&word(Some(4)), 2);
    script.ready("out", true);
    script.hold(&word(Some(4)), 1 + u64::from(has_room));
    script.clock(&word(Some(5)));
    script.hold(&word(None), 3);
    script.finish("words pass; the receiver pauses, a word waits, and then all words continue in sequence")
}

fn fork(values: &Values) -> Fork {
    Fork::new(values.get_u32("receivers"), values.get_u32("width"))
}

fn one_after_another(fork: &Fork, receivers: u64) -> Scenario {
    let mut script = Script::new(fork, DEFAULT_PERIOD);
    (0..receivers).for_each(|receiver| script.ready(&format!("out.{receiver}"), true));
    script.clock(&word(Some(1)));
    (0..receivers).for_each(|receiver| script.ready(&format!("out.{receiver}"), false));
    for receiver in 0..receivers {
        script.ready(&format!("out.{receiver}"), true);
        script.clock(&word(Some(2)));
    }
    script.hold(&word(None), 2);
    script.finish("all receivers take a word at once; the next word is taken by one receiver after another")
}

fn join(values: &Values) -> Join {
    Join::new(values.get_u32("left"), values.get_u32("right"))
}

fn one_waits_for_the_other(join: &Join) -> Scenario {
    let mut script = Script::new(join, DEFAULT_PERIOD);
    let words = |left: Option<u64>, right: Option<u64>| JoinIn { left: word(left).into, right: word(right).into };
    script.ready("out", true);
    script.clock(&words(Some(1), None));
    script.clock(&words(Some(1), Some(5)));
    script.clock(&words(None, Some(6)));
    script.clock(&words(Some(2), Some(6)));
    script.ready("out", false);
    script.hold(&words(Some(3), Some(7)), 2);
    script.ready("out", true);
    script.clock(&words(Some(3), Some(7)));
    script.hold(&words(None, None), 2);
    script.finish("a word of the left stream waits for the right one, a word of the right for the left, and both for the receiver")
}

fn split(values: &Values) -> Split {
    Split::new(values.get_u32("receivers"), values.get_u32("width"))
}

fn to_each_in_turn(split: &Split, receivers: u64) -> Scenario {
    let mut script = Script::new(split, DEFAULT_PERIOD);
    let word = |valid: u64, to, word| SplitIn { into: Stream::of(valid, Addressed { to, word }) };
    (0..receivers).for_each(|receiver| script.ready(&format!("out.{receiver}"), true));
    for receiver in 0..receivers {
        script.clock(&word(1, receiver, (receiver + 1) % 16));
    }
    script.ready("out.0", false);
    script.hold(&word(1, 0, 9), 2);
    script.ready("out.0", true);
    script.clock(&word(1, 0, 9));
    script.hold(&word(0, 0, 0), 2);
    script.finish("a word goes to each receiver; another one waits while the first receiver is not ready")
}

fn arbiter(values: &Values, turns: Turns) -> Arbiter {
    Arbiter::new(values.get_u32("senders"), values.get_u32("width"), turns)
}

fn all_at_once(arbiter: &Arbiter, senders: u64) -> Scenario {
    let mut script = Script::new(arbiter, DEFAULT_PERIOD);
    let send = |valid: u64| ArbiterIn { into: (0..senders).map(|sender| Stream::of(valid, sender % 16)).collect() };
    script.ready("out", true);
    script.hold(&send(1), senders + 2);
    script.ready("out", false);
    script.hold(&send(1), 2);
    script.ready("out", true);
    script.hold(&send(1), 2);
    script.hold(&send(0), 2);
    script.finish("every sender always has a word, its own number; the receiver takes words, pauses, and goes on")
}

fn narrow(values: &Values) -> Narrow {
    Narrow::new(values.get_u32("parts"), values.get_u32("width"))
}

fn two_words_in_parts(narrow: &Narrow, parts: u64) -> Scenario {
    let mut script = Script::new(narrow, DEFAULT_PERIOD);
    script.ready("out", true);
    script.hold(&word(Some(7)), parts);
    script.ready("out", false);
    script.hold(&word(Some(9)), 2);
    script.ready("out", true);
    script.hold(&word(Some(9)), parts);
    script.hold(&word(None), 2);
    script.finish("a word is sent in parts, the least significant first; the next word waits for the receiver")
}

fn widen(values: &Values) -> Widen {
    Widen::new(values.get_u32("parts"), values.get_u32("width"))
}

fn parts_of_two_words(widen: &Widen, parts: u64) -> Scenario {
    let mut script = Script::new(widen, DEFAULT_PERIOD);
    for part in 0..parts {
        script.clock(&word(Some((part + 1) % 16)));
    }
    script.hold(&word(Some(9)), 2);
    script.ready("out", true);
    script.hold(&word(Some(9)), parts);
    script.hold(&word(None), 2);
    script.finish("parts are joined into a word, which waits for the receiver; then the next parts follow")
}

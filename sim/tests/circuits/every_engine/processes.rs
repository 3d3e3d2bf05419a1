//! Several processes in one test: what they see, their sequence, and the messages for their mistakes.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::circuits::engine::of;
use tilewright_hdl::*;
use tilewright_sim::{Pauses, Simulation, monitor};

const FAST: Clock = Clock::new("fast", Period::ns(4));
const SLOW: Clock = Clock::new("slow", Period::ns(6));

bundle! {
    /// A word with its number.
    struct Item<T> { number: T, word: T }
}

block! {
    /// Stores an item; the word comes out increased by the step.
    struct Held;
    in HeldIn { items: stream(Item { number: bits(8), word: bits(70) }), step: bits(4) }
    out HeldOut { sums: stream(Item = _) }
}

impl Held {
    fn build(&self, m: Module, i: HeldIn) -> HeldOut {
        let full = m.reg("full", bit()).reset(0);
        let held = m.reg("held", Item { number: bits(8), word: bits(70) });
        let (sums, sent) = m.offer(full, Item { word: held.word + i.step.zext(70), ..*held });
        let items = i.items.take_when(!full | sent);
        held.when(items.taken, *items);
        full.when(items.taken, 1).when(sent, 0);
        HeldOut { sums }
    }
}

block! {
    /// A register on each of two clocks.
    struct Registers;
    in RegistersIn { fast: bits(8).on(FAST), slow: bits(8).on(SLOW) }
    out RegistersOut { was_fast: bits(8), was_slow: bits(8) }
}

impl Registers {
    fn build(&self, m: Module, i: RegistersIn) -> RegistersOut {
        let was_fast = m.on(FAST).reg("was_fast", 8).reset(0);
        was_fast.next(i.fast);
        let was_slow = m.on(SLOW).reg("was_slow", 8).reset(0);
        was_slow.next(i.slow);
        RegistersOut { was_fast: *was_fast, was_slow: *was_slow }
    }
}

fn held() -> Simulation<HeldIn, HeldOut> {
    let mut sim = of(&Held);
    sim.reset();
    sim
}

fn items(numbers: std::ops::Range<u64>) -> Vec<Item<u64>> {
    numbers.map(|number| Item { number, word: 10 * number }).collect()
}

/// The message of a panic.
fn message(run: impl FnOnce()) -> String {
    let payload = catch_unwind(AssertUnwindSafe(run)).expect_err("it panics");
    payload
        .downcast_ref::<String>()
        .cloned()
        .or_else(|| payload.downcast_ref::<&str>().map(|text| text.to_string()))
        .unwrap()
}

/// The number of the line of this file with this end.
fn line(end: &str) -> String {
    let number = include_str!("processes.rs").lines().position(|line| line.ends_with(end)).unwrap() + 1;
    format!("sim/tests/circuits/every_engine/processes.rs:{number}:")
}

#[test]
fn a_producer_a_consumer_and_a_checker() {
    let mut sim = held();
    let (into, out, step) = (sim.i.items, sim.o.sums, sim.i.step);
    let t = sim.testbench();
    t.set(step, 3);
    let mut most = 0;
    let producer = async {
        for item in items(0..20) {
            t.send(into, item).await;
        }
        "sent"
    };
    let consumer = async {
        let mut numbers = Vec::new();
        for pause in 0..20 {
            t.wait(pause % 4).await;
            let item = t.receive(out).await;
            assert_eq!(item.word, 10 * item.number + 3);
            numbers.push(item.number);
        }
        numbers
    };
    let checker = async {
        loop {
            t.step().await;
            most = most.max(t.get_u64(out.number));
        }
    };
    let (sent, numbers, ()) = t.run((producer, consumer, monitor(checker)));
    assert_eq!((sent, numbers, most), ("sent", (0..20).collect(), 19));
}

#[test]
fn the_order_of_processes_does_not_matter() {
    let run = |reversed: bool| {
        let mut sim = held();
        let (into, out) = (sim.i.items, sim.o.sums);
        let wave = sim.record([into.valid, into.ready, out.valid, out.ready, out.number]);
        let t = sim.testbench();
        let send = t.send_all(into, items(0..30), Pauses::percent(40, 1));
        let receive = t.receive_all(out, 30, Pauses::percent(60, 2));
        let received = if reversed { t.run((receive, send)).0 } else { t.run((send, receive)).1 };
        (received.len(), t.time(), wave.to_string())
    };
    assert_eq!(run(false), run(true));
    assert_eq!(run(false), run(false));
}

#[test]
fn a_process_sees_what_was_before_the_edge() {
    let mut sim = of(&Registers);
    sim.reset();
    let (i, o) = (sim.i, sim.o);
    let t = sim.testbench();
    let [first, second] = [(1, 0), (2, 1)];
    let writer = async {
        t.set(i.fast, first.0);
        t.on(FAST).step().await;
        t.set(i.fast, second.0);
        assert_eq!(t.get_u64(i.fast), first.0, "it is set after the edge");
        t.on(FAST).step().await;
    };
    let reader = async {
        t.on(FAST).step().await;
        assert_eq!((t.get_u64(i.fast), t.get_u64(o.was_fast)), first);
        t.on(FAST).step().await;
        assert_eq!((t.get_u64(i.fast), t.get_u64(o.was_fast)), second);
    };
    t.run((writer, reader));
    assert_eq!(t.get_u64(o.was_fast), 2, "the last edge happens");
}

#[test]
fn each_process_has_its_clock() {
    let mut sim = of(&Registers);
    let t = sim.testbench();
    let times = async |name: &'static str| {
        let t = t.on(name);
        let mut times = Vec::new();
        for _ in 0..3 {
            t.step().await;
            times.push(t.time());
        }
        times
    };
    let any = async {
        t.wait(4).await;
        t.time()
    };
    let (fast, slow, any) = t.run((times("fast"), times("slow_clk"), any));
    assert_eq!(fast, [4_000, 8_000, 12_000]);
    assert_eq!(slow, [6_000, 12_000, 18_000]);
    assert_eq!(any, 12_000, "after 4, 6 and 8 ns");
    assert_eq!(t.time(), 18_000);
}

#[test]
fn waiting_for_a_condition() {
    let mut sim = held();
    let (into, out) = (sim.i.items, sim.o.sums);
    let t = sim.testbench();
    let waits = async {
        t.until(out.number.is_at_least(3)).await;
        t.get_u64(out.number)
    };
    let sends = async {
        t.set(out.ready, 1);
        t.send_all(into, items(0..6), Pauses::NONE).await;
    };
    assert_eq!(t.run((waits, sends)), (3, ()));
    t.run((async { t.wait(0).await },));
    assert_eq!(t.get_u64(out.number), 5, "no edge for nothing");
}

#[test]
fn several_of_a_kind() {
    let mut sim = held();
    let t = &sim.testbench();
    let each = (1..4).map(|edges| async move {
        t.wait(edges).await;
        edges
    });
    let start = t.time();
    assert_eq!(t.run((t.all(each),)), (vec![1, 2, 3],));
    assert_eq!(t.time(), start + 30_000);
}

#[test]
fn what_if_an_input_were_another() {
    let mut sim = held();
    let (step, out) = (sim.i.step, sim.o.sums);
    let t = sim.testbench();
    let word = || t.get(out.payload.word);
    t.set(step, 2);
    assert_eq!(t.suppose(step, 9, word), Bits::new(70, 9));
    assert_eq!((word(), t.get_u64(step)), (Bits::new(70, 2), 2));
}

#[test]
fn a_run_that_does_not_end_says_what_each_waits_for() {
    let text = message(|| {
        let mut sim = held();
        let (into, out) = (sim.i.items, sim.o.sums);
        let t = sim.testbench();
        t.limit(50);
        let sends = async {
            t.send(into, items(0..1).remove(0)).await;
            t.send(into, items(1..2).remove(0)).await; // nobody receives
        };
        let waits = async {
            t.until(out.number.is_not(0)).await; // it is 0
        };
        t.run((sends, waits, monitor(t.holds(out)), async { t.wait(3).await })); // runs
    });
    let expected = [
        ("the processes of the run at ", "// runs", " have not ended after 50 instants:"),
        ("one has waited since 20000 ps for `items_ready` to be 1\n  --> ", "// nobody receives", ""),
        ("one has waited since 10000 ps for `sums_number` to be other than 0\n  --> ", "// it is 0", ""),
        ("if they need longer, say so with `.limit(instants)`", "", ""),
    ];
    let mut lines = String::new();
    for (before, at, after) in expected {
        lines += &format!("{before}{}{after}\n", if at.is_empty() { String::new() } else { line(at) });
    }
    assert_eq!(without_columns(&text), lines.trim_end());
}

/// The text, without the columns of its places.
fn without_columns(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once(".rs:") {
        let (number, after) = after.split_once(':').unwrap();
        plain += &format!("{before}.rs:{number}:");
        rest = after.trim_start_matches(|c: char| c.is_ascii_digit());
    }
    plain + rest
}

#[test]
fn an_input_has_one_driver_at_an_edge() {
    let text = message(|| {
        let mut sim = held();
        let step = sim.i.step;
        let t = sim.testbench();
        let one = async {
            t.set(step, 1);
            t.set(step, 2); // of one process the last counts
            t.step().await;
        };
        let other = async {
            t.step().await;
            t.set(step, 3);
        };
        t.run((one, other));
        assert_eq!(t.get_u64(step), 3);
        let third = async { t.set(step, 4) }; // the third
        let fourth = async { t.set(step, 4) }; // the fourth
        t.run((third, fourth));
    });
    let (third, fourth) = (line("// the third"), line("// the fourth"));
    let expected = format!(
        "input `step` is set by two processes at one edge, at {third} and at {fourth}: leave it to one of them"
    );
    assert_eq!(without_columns(&text), expected);
}

#[test]
fn a_wrong_word_is_told_at_its_line() {
    let text = message(|| {
        let mut sim = held();
        let (into, out) = (sim.i.items, sim.o.sums);
        let t = sim.testbench();
        let mut expected = items(0..5);
        expected[3].word = 31;
        let receive = t.expect_all(out, expected, Pauses::NONE); // expects
        t.run((t.send_all(into, items(0..5), Pauses::NONE), receive));
    });
    let expected = "word 3 of `sums`, at 60000 ps, is Item { number: 3, word: 30 }, not Item { number: 3, word: 31 }";
    assert_eq!(without_columns(&text), format!("{expected}\n  --> {}", line("// expects")));
}

#[test]
fn a_word_too_many_is_told_at_its_line() {
    let text = message(|| {
        let mut sim = held();
        let (into, out) = (sim.i.items, sim.o.sums);
        let t = sim.testbench();
        let silent = t.expect_silence(out, 9); // silence
        t.run((t.send_all(into, items(4..5), Pauses::NONE), silent));
    });
    let expected = "`sums` shows one more word, Item { number: 4, word: 40 }, at 30000 ps";
    assert_eq!(without_columns(&text), format!("{expected}\n  --> {}", line("// silence")));
}

#[test]
fn a_word_that_changes_is_told_at_its_line() {
    let text = message(|| {
        let mut sim = held();
        let (into, out, step) = (sim.i.items, sim.o.sums, sim.i.step);
        let t = sim.testbench();
        let changes = async {
            t.wait(4).await;
            t.set(step, 1);
            t.step().await;
        };
        let holds = t.holds(out); // holds
        t.run((t.send_all(into, items(4..5), Pauses::NONE), changes, monitor(holds)));
    });
    let expected = "`sums` showed Some(Item { number: 4, word: 40 }) and, before it was taken, at 60000 ps, \
                    shows Some(Item { number: 4, word: 41 })";
    assert_eq!(without_columns(&text), format!("{expected}\n  --> {}", line("// holds")));
}

#[test]
#[should_panic(expected = "a process calls `run`, at sim/tests/")]
fn a_run_within_a_process() {
    let mut sim = held();
    let t = sim.testbench();
    t.run((async { t.run((t.step(),)) },));
}

#[test]
#[should_panic(expected = "there is no clock `fats`: did you mean `fast`?")]
fn a_clock_that_is_not_there() {
    of(&Registers).testbench().on("fats");
}

#[test]
#[should_panic(expected = "pauses of 100 percent or more let nothing through: from 0 to 99")]
fn pauses_without_end() {
    Pauses::percent(100, 1);
}

#[test]
fn pauses_are_as_long_as_they_are_to_be() {
    for percent in [0, 1, 30, 50, 90, 99] {
        let mut pauses = Pauses::percent(percent, 5);
        let clocks: u32 = (0..10_000).map(|_| pauses.next_length()).sum();
        let (mean, expected) = (f64::from(clocks) / 10_000.0, percent as f64 / (100 - percent) as f64);
        assert!((mean - expected).abs() <= 0.05 * expected.max(0.1), "{percent} percent: {mean}, not {expected}");
    }
}

//! The queue between two clocks.

use crate::streams::property::{BOTH, End, through};
use crate::streams::stalls::stalls;
use proptest::prelude::*;
use tilewright_blocks::{DualClockFifo, StreamIn, StreamOut};
use tilewright_hdl::{Clock, Period};
use tilewright_sim::{Port, Simulation};

/// The clocks of the writer and of the reader, by their periods in picoseconds. A clock's name has one period within a
/// design; other designs may use another.
const fn clocks(write: u64, read: u64) -> (Clock, Clock) {
    (Clock::new("write", Period::ps(write)), Clock::new("read", Period::ps(read)))
}

fn fifo(depth: u32, (write, read): (Clock, Clock)) -> DualClockFifo {
    DualClockFifo::new(depth, 8, write, read)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_is_lost_between_clocks(
        depth in 1u32..5,
        write in 500u64..5000,
        read in 500u64..5000,
        words in prop::collection::vec(0u64..256, 0..60),
        stalls in stalls(),
    ) {
        let (write, read) = clocks(2 * write, 2 * read);
        let mut sim = Simulation::of(&fifo(1 << depth, (write, read))).unwrap().seeded(stalls.seed);
        sim.reset();
        let ends = ([End::on(sim.i.into, write)], [End::on(sim.o.out, read)]);
        let received = through(&mut sim, (&ends.0, &ends.1), std::slice::from_ref(&words), &[words.len()], stalls, BOTH);
        prop_assert_eq!(received, vec![words]);
    }
}

type Queue = Simulation<StreamIn, StreamOut>;

fn queue(write: Clock, read: Clock) -> Queue {
    let mut sim = Simulation::of(&fifo(4, (write, read))).unwrap().seeded(7);
    sim.reset();
    sim.step_clock(write, 1);
    sim
}

/// Sets a port for one edge of a clock.
fn pulse(sim: &mut Queue, port: Port, clock: Clock) {
    let before = sim.cycles(clock).unwrap();
    sim.set(port, 1);
    while sim.cycles(clock).unwrap() == before {
        sim.step();
    }
    sim.set(port, 0);
}

/// The number of edges of a clock until a port is high.
fn edges_until(sim: &mut Queue, port: Port, clock: Clock) -> u64 {
    let start = sim.cycles(clock).unwrap();
    while sim.get_u64(port) == 0 {
        sim.step();
        assert!(sim.cycles(clock).unwrap() < start + 9, "the queue does not go on");
    }
    sim.cycles(clock).unwrap() - start
}

const CLOCKS: [(Clock, Clock); 5] =
    [clocks(4000, 4000), clocks(4000, 9002), clocks(9002, 4000), clocks(1000, 7002), clocks(7002, 1000)];

fn periods(write: Clock, read: Clock) -> String {
    format!("periods of {} and {}", write.period, read.period)
}

/// The edges count from the one that takes the word. Words go twice around the queue.
#[test]
fn a_word_is_shown_after_three_edges_of_the_reader() {
    for (write, read) in CLOCKS {
        let periods = periods(write, read);
        let mut sim = queue(write, read);
        for word in 0..9 {
            let (valid, shown, ready) = (sim.i.into.valid, sim.o.out.valid, sim.o.out.ready);
            pulse(&mut sim, valid, write);
            assert_eq!(edges_until(&mut sim, shown, read), 3, "word {word}, {periods}");
            pulse(&mut sim, ready, read);
        }
    }
}

#[test]
fn a_full_queue_takes_a_word_after_two_edges_of_the_writer() {
    for (write, read) in CLOCKS {
        let periods = periods(write, read);
        let mut sim = queue(write, read);
        let (valid, free, shown, ready) = (sim.i.into.valid, sim.i.into.ready, sim.o.out.valid, sim.o.out.ready);
        (0..4).for_each(|_| pulse(&mut sim, valid, write));
        for word in 0..9 {
            assert_eq!(sim.get_u64(free), 0, "word {word}, {periods}");
            edges_until(&mut sim, shown, read);
            pulse(&mut sim, ready, read);
            assert_eq!(edges_until(&mut sim, free, write), 2, "word {word}, {periods}");
            pulse(&mut sim, valid, write);
        }
    }
}

#[test]
fn a_full_queue_takes_nothing() {
    let (write, read) = clocks(4000, 6000);
    let mut sim = Simulation::of(&fifo(4, (write, read))).unwrap();
    sim.reset();
    sim.set(sim.i.into.valid, 1);
    let mut taken = 0;
    for _ in 0..40 {
        let before = sim.cycles(write).unwrap();
        let ready = sim.get_u64(sim.i.into.ready);
        sim.step();
        taken += ready * (sim.cycles(write).unwrap() - before);
    }
    assert_eq!(taken, 4);
}

/// In every state of both sides, a reset leaves the queue empty and ready.
#[test]
fn a_reset_empties_the_queue() {
    for ((write, read), words, taken) in CLOCKS
        .into_iter()
        .flat_map(|clocks| (0..6).flat_map(move |words| (0..=words).map(move |taken| (clocks, words, taken))))
    {
        let case = format!("{words} words, {taken} taken, {}", periods(write, read));
        let mut sim = queue(write, read);
        let (valid, free, shown, ready) = (sim.i.into.valid, sim.i.into.ready, sim.o.out.valid, sim.o.out.ready);
        for word in 0..words {
            edges_until(&mut sim, free, write);
            pulse(&mut sim, valid, write);
            if word < taken {
                edges_until(&mut sim, shown, read);
                pulse(&mut sim, ready, read);
            }
            if word >= taken + 3 {
                break;
            }
        }
        sim.reset();
        for _ in 0..20 {
            assert_eq!((sim.get_u64(shown), sim.get_u64(free)), (0, 1), "{case}");
            sim.step();
        }
        for word in 0..4 {
            assert_eq!(sim.get_u64(free), 1, "{case}");
            sim.set(sim.i.into.payload, 10 + word);
            pulse(&mut sim, valid, write);
        }
        assert_eq!(sim.get_u64(free), 0, "{case}");
        for word in 0..4 {
            edges_until(&mut sim, shown, read);
            assert_eq!(sim.get_u64(sim.o.out.payload), 10 + word, "{case}");
            pulse(&mut sim, ready, read);
        }
    }
}

#[test]
#[should_panic(expected = "a dual-clock FIFO of 6 words: Gray code needs a power of two from 2 on")]
fn a_depth_that_gray_code_has_not() {
    fifo(6, clocks(4000, 6000));
}

#[test]
#[should_panic(expected = "a dual-clock FIFO on clock `a` alone: use `Fifo`")]
fn one_clock() {
    let clock = Clock::new("a", Period::ns(4));
    DualClockFifo::new(4, 8, clock, clock);
}

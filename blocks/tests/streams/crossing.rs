//! The queue between two clocks.

use crate::property::{BOTH, End, through};
use crate::stalls::stalls;
use proptest::prelude::*;
use tilewright_blocks::DualClockFifo;
use tilewright_hdl::{Clock, Period};
use tilewright_sim::Simulation;

/// Clocks of the same name have one period in a design, not in all.
fn fifo(depth: u32, write: u64, read: u64) -> DualClockFifo {
    DualClockFifo::new(depth, 8, Clock::new("write", Period::ps(write)), Clock::new("read", Period::ps(read)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn nothing_is_lost_between_clocks(
        depth in 1u32..5,
        write in 500u64..5000,
        read in 500u64..5000,
        words in prop::collection::vec(0u64..256, 0..60),
        stalls in stalls(),
    ) {
        let mut sim = Simulation::of(&fifo(1 << depth, 2 * write, 2 * read)).unwrap().seeded(stalls.seed);
        sim.reset();
        let ends = ([End::on(sim.i.into, "write")], [End::on(sim.o.out, "read")]);
        let received = through(&mut sim, (&ends.0, &ends.1), std::slice::from_ref(&words), stalls, BOTH);
        prop_assert_eq!(received, vec![words]);
    }
}

/// How many edges of the reader come after the one of the writer that takes a word, until it is shown.
fn latency(write: u64, read: u64) -> u64 {
    let mut sim = Simulation::of(&fifo(4, write, read)).unwrap();
    sim.reset();
    sim.step_clock("write", 1);
    let taken = sim.cycles("write").unwrap();
    sim.set(sim.i.into.valid, 1);
    while sim.cycles("write").unwrap() == taken {
        sim.step();
    }
    sim.set(sim.i.into.valid, 0);
    let start = sim.cycles("read").unwrap();
    while sim.get_u64(sim.o.out.valid) == 0 {
        sim.step();
    }
    sim.cycles("read").unwrap() - start
}

#[test]
fn a_word_is_shown_after_three_edges_of_the_reader() {
    for (write, read) in [(4000, 4000), (4000, 9002), (9002, 4000), (1000, 7002), (7002, 1000)] {
        assert_eq!(latency(write, read), 3, "periods of {write} and {read} ps");
    }
}

#[test]
fn a_full_queue_takes_nothing() {
    let mut sim = Simulation::of(&fifo(4, 4000, 6000)).unwrap();
    sim.reset();
    sim.set(sim.i.into.valid, 1);
    let mut taken = 0;
    for _ in 0..40 {
        let before = sim.cycles("write").unwrap();
        let ready = sim.get_u64(sim.i.into.ready);
        sim.step();
        taken += ready * (sim.cycles("write").unwrap() - before);
    }
    assert_eq!(taken, 4);
}

#[test]
#[should_panic(expected = "a dual-clock FIFO of 6 words: Gray code needs a power of two from 2 on")]
fn a_depth_that_gray_code_has_not() {
    fifo(6, 4000, 6000);
}

#[test]
#[should_panic(expected = "a dual-clock FIFO on clock `a` alone: take `Fifo`")]
fn one_clock() {
    let clock = Clock::new("a", Period::ns(4));
    DualClockFifo::new(4, 8, clock, clock);
}

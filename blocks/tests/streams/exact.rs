//! The blocks of streams clock by clock.

use crate::streams::clocks::play;
use tilewright_blocks::*;
use tilewright_hdl::Block;
use tilewright_sim::Simulation;

#[test]
fn a_queue_in_registers() {
    play(
        &Fifo::new(2, 8, Storage::Registers),
        &[
            (Some(1), 0, 1, None),
            (Some(2), 0, 1, Some(1)),
            (Some(3), 0, 0, Some(1)), // full
            (Some(3), 1, 0, Some(1)), // `ready` does not pass
            (Some(3), 1, 1, Some(2)),
            (None, 1, 1, Some(3)),
            (None, 1, 1, None),
        ],
    );
}

#[test]
fn a_queue_in_a_block_ram() {
    play(
        &Fifo::new(3, 8, Storage::BlockRam),
        &[
            (Some(1), 1, 1, None),
            (Some(2), 1, 1, None),
            (Some(3), 1, 1, Some(1)),
            (Some(4), 1, 1, Some(2)),
            (None, 1, 1, Some(3)),
            (None, 0, 1, Some(4)),
            (None, 1, 1, Some(4)),
            (Some(5), 1, 1, None),
            (None, 1, 1, None),
            (None, 1, 1, Some(5)),
        ],
    );
}

#[test]
fn a_forward_slice() {
    play(
        &RegisterSlice { width: 8, cuts: Slice::Forward },
        &[
            (Some(1), 0, 1, None),
            (Some(2), 0, 0, Some(1)),
            (Some(2), 1, 1, Some(1)),
            (Some(3), 1, 1, Some(2)),
            (None, 1, 1, Some(3)),
            (None, 1, 1, None),
        ],
    );
}

#[test]
fn a_backward_slice() {
    play(
        &RegisterSlice { width: 8, cuts: Slice::Backward },
        &[
            (Some(1), 1, 1, Some(1)),
            (Some(2), 0, 1, Some(2)),
            (Some(3), 0, 0, Some(2)),
            (Some(3), 1, 0, Some(2)),
            (Some(3), 1, 1, Some(3)),
            (None, 1, 1, None),
        ],
    );
}

#[test]
fn a_skid_buffer() {
    play(
        &RegisterSlice { width: 8, cuts: Slice::Both },
        &[
            (Some(1), 0, 1, None),
            (Some(2), 0, 1, Some(1)),
            (Some(3), 0, 0, Some(1)),
            (Some(3), 1, 0, Some(1)),
            (Some(3), 1, 1, Some(2)),
            (Some(4), 1, 1, Some(3)),
            (None, 1, 1, Some(4)),
            (None, 1, 1, None),
        ],
    );
}

#[test]
fn narrower_and_wider_words() {
    play(
        &Narrow::new(3, 4),
        &[
            (Some(0x321), 1, 0, Some(1)),
            (Some(0x321), 0, 0, Some(2)),
            (Some(0x321), 1, 0, Some(2)),
            (Some(0x321), 1, 1, Some(3)),
            (Some(0x654), 1, 0, Some(4)),
        ],
    );
    play(
        &Widen::new(3, 4),
        &[
            (Some(1), 1, 1, None),
            (Some(2), 1, 1, None),
            (None, 1, 1, None),
            (Some(3), 0, 1, None),
            (Some(4), 0, 0, Some(0x321)),
            (Some(4), 1, 1, Some(0x321)),
            (Some(5), 1, 1, None),
            (Some(6), 1, 1, None),
            (None, 1, 1, Some(0x654)),
        ],
    );
}

/// Checks that a reset empties a block after words have gone in, and some have gone out.
fn empties<B: Block<In = StreamIn, Out = StreamOut>>(block: &B) {
    let mut sim = Simulation::of(block).unwrap();
    sim.set(sim.i.into.valid, 1);
    for ready in [0, 1, 1, 0, 0, 0] {
        sim.set(sim.o.out.ready, ready);
        sim.step();
    }
    sim.reset();
    sim.set(sim.i.into.valid, 0);
    for clock in 0..4 {
        let seen = (sim.get_u64(sim.i.into.ready), sim.get_u64(sim.o.out.valid));
        assert_eq!(seen, (1, 0), "clock {clock} of {block:?}");
        sim.step();
    }
}

#[test]
fn a_reset_empties_slices_and_queues() {
    for cuts in [Slice::Forward, Slice::Backward, Slice::Both] {
        empties(&RegisterSlice { width: 8, cuts });
    }
    for storage in [Storage::Registers, Storage::BlockRam] {
        (1..5).for_each(|depth| empties(&Fifo::new(depth, 8, storage)));
    }
}

/// Each row is a clock: the senders with a word, the receiver's `ready`, and the sender served.
fn arbiter(turns: Turns, rows: &[([u64; 3], u64, Option<u64>)]) {
    let mut sim = Simulation::of(&Arbiter::new(3, 8, turns)).unwrap().seeded(7);
    sim.reset();
    let mut seen = Vec::new();
    for &(valid, ready, _) in rows {
        for (sender, valid) in valid.into_iter().enumerate() {
            sim.set(sim.i.into[sender].valid, valid);
            sim.set(sim.i.into[sender].payload, sender as u64);
        }
        sim.set(sim.o.out.ready, ready);
        let shows = sim.get_u64(sim.o.out.valid) == 1;
        let shown = shows.then(|| sim.get_u64(sim.o.out.payload));
        for (sender, valid) in valid.into_iter().enumerate() {
            let taken = sim.get_u64(sim.i.into[sender].ready) & valid;
            assert_eq!(taken == 1, ready == 1 && shown == Some(sender as u64));
        }
        seen.push((valid, ready, shown));
        sim.step();
    }
    assert_eq!(seen, rows);
}

#[test]
fn turns() {
    arbiter(
        Turns::RoundRobin,
        &[
            ([1, 1, 1], 1, Some(0)),
            ([1, 1, 1], 1, Some(1)),
            ([1, 1, 1], 1, Some(2)),
            ([1, 1, 1], 1, Some(0)),
            ([1, 0, 0], 1, Some(0)),
            ([1, 0, 1], 0, Some(2)),
            ([1, 1, 1], 1, Some(2)), // a shown word stays
            ([0, 0, 0], 1, None),
            ([0, 1, 1], 1, Some(1)),
        ],
    );
}

/// A reset does so in every state of the round robin, and with any power-on values.
#[test]
fn a_reset_begins_the_turns_again() {
    for (seed, words, ready) in
        (0..8).flat_map(|seed| (0..4).flat_map(move |words| [(seed, words, 0), (seed, words, 1)]))
    {
        let mut sim = Simulation::of(&Arbiter::new(3, 8, Turns::RoundRobin)).unwrap().seeded(seed);
        sim.reset();
        for (sender, into) in sim.i.into.clone().into_iter().enumerate() {
            sim.set(into.valid, 1);
            sim.set(into.payload, sender as u64);
        }
        sim.set(sim.o.out.ready, 1);
        sim.run(words);
        sim.set(sim.o.out.ready, ready);
        sim.step();
        sim.reset();
        assert_eq!(sim.get_u64(sim.o.out.payload), 0, "seed {seed}, after {words} words, ready {ready}");
        sim.set(sim.o.out.ready, 1);
        sim.step();
        assert_eq!(sim.get_u64(sim.o.out.payload), 1, "seed {seed}, after {words} words, ready {ready}");
    }
}

#[test]
fn priority() {
    arbiter(
        Turns::Priority,
        &[
            ([1, 1, 1], 1, Some(0)),
            ([0, 1, 1], 0, Some(1)),
            ([1, 1, 1], 1, Some(1)), // a shown word stays
            ([1, 0, 1], 1, Some(0)),
            ([0, 0, 1], 1, Some(2)),
            ([0, 0, 0], 1, None),
        ],
    );
}

#[test]
fn a_fork() {
    let mut sim = Simulation::of(&Fork::new(3, 8)).unwrap().seeded(7);
    sim.reset();
    // The sender's `valid`, the receivers' `ready`; the block's `ready`, and `valid` at the receivers.
    let rows = [
        (1, [1, 1, 1], 1, [1, 1, 1]),
        (1, [1, 0, 0], 0, [1, 1, 1]),
        (1, [0, 1, 0], 0, [0, 1, 1]), // the first has it already
        (1, [0, 0, 1], 1, [0, 0, 1]),
        (1, [0, 0, 0], 0, [1, 1, 1]),
        (1, [0, 0, 1], 0, [1, 1, 1]),
        (1, [1, 1, 0], 1, [1, 1, 0]),
        (1, [1, 1, 1], 1, [1, 1, 1]),
        (0, [1, 1, 1], 1, [0, 0, 0]),
    ];
    for (clock, (valid, ready, taken, shown)) in rows.into_iter().enumerate() {
        sim.set(sim.i.into.valid, valid);
        for (receiver, ready) in ready.into_iter().enumerate() {
            sim.set(sim.o.out[receiver].ready, ready);
        }
        let seen = [0, 1, 2].map(|receiver| sim.get_u64(sim.o.out[receiver].valid));
        assert_eq!((sim.get_u64(sim.i.into.ready), seen), (taken, shown), "clock {clock}");
        sim.step();
    }
}

#[test]
fn a_join() {
    let mut sim = Simulation::of(&Join::new(8, 4)).unwrap();
    sim.reset();
    // The words of both sides, the receiver's `ready`; the block's two `ready`, and the word at the receiver.
    let rows = [
        (Some(1), None, 1, [0, 0], None),
        (Some(1), Some(5), 0, [0, 0], Some(0x15)),
        (Some(1), Some(5), 1, [1, 1], Some(0x15)),
        (None, Some(6), 1, [0, 0], None),
        (Some(2), Some(6), 1, [1, 1], Some(0x26)),
        (None, None, 1, [0, 0], None),
    ];
    for (clock, (left, right, ready, taken, shown)) in rows.into_iter().enumerate() {
        for (stream, word) in [(sim.i.left, left), (sim.i.right, right)] {
            sim.set(stream.valid, word.is_some());
            sim.set(stream.payload, word.unwrap_or(0));
        }
        sim.set(sim.o.out.ready, ready);
        let shows = sim.get_u64(sim.o.out.valid) == 1;
        let seen = shows.then(|| sim.get_u64(sim.o.out.payload));
        let accepted = [sim.i.left, sim.i.right].map(|stream| sim.get_u64(stream.ready));
        assert_eq!((accepted, seen), (taken, shown), "clock {clock}");
        sim.step();
    }
}

#[test]
fn a_split() {
    let mut sim = Simulation::of(&Split::new(3, 8)).unwrap();
    sim.reset();
    // The receiver's number, if any, the receivers' `ready`; the block's `ready`, and `valid` at the receivers.
    let rows = [
        (Some(0), [1, 0, 0], 1, [1, 0, 0]),
        (Some(1), [1, 0, 1], 0, [0, 1, 0]), // only the receiver's `ready` counts
        (Some(1), [0, 1, 0], 1, [0, 1, 0]),
        (Some(2), [0, 0, 1], 1, [0, 0, 1]),
        (None, [1, 1, 1], 0, [0, 0, 0]),
    ];
    for (clock, (to, ready, taken, shown)) in rows.into_iter().enumerate() {
        sim.set(sim.i.into.valid, to.is_some());
        sim.set(sim.i.into.to, to.unwrap_or(0));
        sim.set(sim.i.into.word, 7 + clock as u64);
        for (receiver, ready) in ready.into_iter().enumerate() {
            sim.set(sim.o.out[receiver].ready, ready);
            assert_eq!(sim.get_u64(sim.o.out[receiver].payload), 7 + clock as u64, "clock {clock}");
        }
        let seen = [0, 1, 2].map(|receiver| sim.get_u64(sim.o.out[receiver].valid));
        assert_eq!((sim.get_u64(sim.i.into.ready), seen), (taken, shown), "clock {clock}");
        sim.step();
    }
}

#[test]
#[should_panic(expected = "a FIFO of 0 words of 8 bits holds nothing")]
fn a_queue_of_nothing() {
    Fifo::new(0, 8, Storage::Registers);
}

#[test]
#[should_panic(expected = "a fork to 0 receivers takes nothing")]
fn a_fork_without_receivers() {
    Fork::new(0, 8);
}

#[test]
#[should_panic(expected = "a join of words of 8 and 0 bits: each has 1 or more")]
fn a_join_of_nothing() {
    Join::new(8, 0);
}

#[test]
#[should_panic(expected = "a split to 0 receivers takes nothing")]
fn a_split_without_receivers() {
    Split::new(0, 8);
}

#[test]
#[should_panic(expected = "an arbiter of 0 senders sends nothing")]
fn an_arbiter_without_senders() {
    Arbiter::new(0, 8, Turns::Priority);
}

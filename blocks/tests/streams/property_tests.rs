//! The check of the property finds faults.

use crate::streams::property::{BACKWARD, Cuts, End, FORWARD, NONE, Stalls, through};
use tilewright_blocks::{RegisterSlice, Slice, StreamIn, StreamOut};
use tilewright_hdl::*;
use tilewright_sim::Simulation;

/// The fault of a bad block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Fault {
    /// The block changes a word while it is shown.
    Changes,
    /// The block loses a word that arrives while another one waits.
    Loses,
    /// The block sends each word twice.
    Doubles,
    /// The block takes no word.
    Sticks,
}

/// A block with a fault.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Bad(Fault);

impl Block for Bad {
    type In = StreamIn;
    type Out = StreamOut;

    fn inputs(&self) -> StreamIn<Width> {
        StreamIn { into: stream(8) }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        def!(clocks = m.reg(8).reset(0));
        clocks.next(clocks + 1);
        def!(full = m.reg(bit()).reset(0));
        def!(held = m.reg(8));
        let out = match self.0 {
            Fault::Changes => {
                let (out, _) = m.offer(i.into.valid, i.into.payload ^ clocks);
                i.into.take_when(out.ready);
                out
            }
            Fault::Loses => {
                let (out, sent) = m.offer(full, *held);
                let into = i.into.take_when(1);
                held.when(into.taken & (!full | sent), *into);
                full.when(into.taken, 1).when(sent, 0);
                out
            }
            Fault::Doubles => {
                def!(again = m.reg(bit()).reset(0));
                let (out, sent) = m.offer(full, *held);
                let into = i.into.take_when(!full);
                held.when(into.taken, *into);
                full.when(into.taken, 1).when(sent & *again, 0);
                again.when(sent, !again);
                out
            }
            Fault::Sticks => {
                i.into.take_when(0);
                m.offer(full & !i.into.valid & i.into.payload.bit(0), *held).0
            }
        };
        if self.0 == Fault::Changes || self.0 == Fault::Sticks {
            held.next(0);
            full.next(0);
        }
        StreamOut { out }
    }
}

fn run<B: Block<In = StreamIn, Out = StreamOut>>(block: &B, cuts: Cuts) -> Vec<u64> {
    let mut sim = Simulation::of(block).unwrap();
    sim.reset();
    let ends = ([End::of(sim.i.into)], [End::of(sim.o.out)]);
    let stalls = Stalls { senders: 20, receivers: 50, seed: 7 };
    through(&mut sim, (&ends.0, &ends.1), &[(1..30).collect()], &[29], stalls, cuts).remove(0)
}

block! {
    /// Shows its word only to a receiver that is ready. The language rejects this for a stream, so the ports are plain.
    struct Waits;
    in WaitsIn { ready: bit() }
    out WaitsOut { valid: _, payload: _ }
}

impl Waits {
    fn build(&self, m: Module, i: WaitsIn) -> WaitsOut {
        WaitsOut { valid: i.ready, payload: m.pipe("ready_before", i.ready) }
    }
}

#[test]
#[should_panic(expected = "an output waits for `ready` of output 0")]
fn a_sender_that_waits_for_its_receiver() {
    let mut sim = Simulation::of(&Waits).unwrap();
    let out = End::of(Stream { valid: sim.o.valid, ready: sim.i.ready, payload: sim.o.payload });
    through(&mut sim, (&[], &[out]), &[], &[9], Stalls { senders: 0, receivers: 50, seed: 7 }, NONE);
}

#[test]
#[should_panic(expected = "`out` showed Some(")]
fn a_word_that_changes() {
    run(&Bad(Fault::Changes), NONE);
}

#[test]
#[should_panic(expected = "ps for `out_valid` to be 1")]
fn a_word_that_is_lost() {
    run(&Bad(Fault::Loses), NONE);
}

#[test]
#[should_panic(expected = "`out` shows one more word, ")]
fn a_word_that_is_doubled() {
    run(&Bad(Fault::Doubles), NONE);
}

#[test]
#[should_panic(expected = "ps for `into_ready` to be 1")]
fn a_block_that_takes_nothing() {
    run(&Bad(Fault::Sticks), NONE);
}

#[test]
#[should_panic(expected = "a path from `ready` of output 0 to that of an input")]
fn a_path_back() {
    run(&RegisterSlice { width: 8, cuts: Slice::Forward }, BACKWARD);
}

#[test]
#[should_panic(expected = "a path from input 0 to an output")]
fn a_path_through() {
    run(&RegisterSlice { width: 8, cuts: Slice::Backward }, FORWARD);
}

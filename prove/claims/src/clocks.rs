//! Blocks of several clocks.

use crate::{Claim, claim, design};
use tilewright_blocks::{DualClockFifo, StreamIn};
use tilewright_hdl::*;

const WRITE: Clock = Clock::new("write", Period::ns(10));
// The proof is for all periods. With equal ones the mutant fails after few edges.
const READ: Clock = Clock::new("read", Period::ns(10));
const RED: u64 = 1;
const BLUE: u64 = 2;

block! {
    /// Coloured words through a queue from one clock to another, as in `streams`. The mutant may send a second red word.
    struct Crossed { depth: u32, wrong: bool }
    in CrossedIn { offers: bit().on(WRITE), colour: bits(2).on(WRITE), takes: bit().on(READ) }
    out CrossedOut { taken: bit() }
}

impl Crossed {
    fn build(&self, m: Module, i: CrossedIn) -> CrossedOut {
        let (write, read) = (m.on(WRITE), m.on(READ));
        let (into, sent) = write.offer(i.offers, i.colour);
        let queue = DualClockFifo::new(self.depth, 2, WRITE, READ);
        let word = m.instance("u_queue", &queue, StreamIn { into }).out.take_when(i.takes);
        let seen = |clock: Module, name: &str, happens: Signal| clock.reg(name, 1).reset(0).when(happens, 1);
        let red_in = seen(write, "red_in", sent & i.colour.eq(RED));
        let blue_in = seen(write, "blue_in", sent & i.colour.eq(BLUE));
        let red_out = seen(read, "red_out", word.taken & word.eq(RED));
        let blue_out = seen(read, "blue_out", word.taken & word.eq(BLUE));
        let is_red = if self.wrong { !blue_in } else { !red_in };
        write.assume(i.colour.ne(3), "there are three colours");
        write.assume((sent & i.colour.eq(RED)).implies(is_red), "one word is red");
        write.assume((sent & i.colour.eq(BLUE)).implies(red_in & !blue_in), "one word behind it is blue");
        read.assert(word.taken.implies(word.ne(3)), "no word has another colour");
        read.assert((word.taken & word.eq(RED)).implies(!red_out), "the red word comes once");
        read.assert((word.taken & word.eq(BLUE)).implies(red_out & !blue_out), "the blue word comes once, behind it");
        CrossedOut { taken: word.taken }
    }
}

fn crossed(depth: u32, wrong: bool) -> Design {
    design(&Crossed { depth, wrong })
}

/// What is proved of blocks of several clocks.
pub fn claims() -> Vec<Claim> {
    let order = "keeps the sequence, loses nothing, repeats nothing";
    vec![
        claim(&["dual-clock-fifo"], "dual-clock queue, 2 words", order, [2, 8], |wrong| crossed(2, wrong)),
        Claim {
            by_hand: true,
            ..claim(&["dual-clock-fifo"], "dual-clock queue, 4 words", order, [2, 8], |wrong| crossed(4, wrong))
        },
    ]
}

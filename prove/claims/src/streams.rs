//! Queues, slices, the stack and the arbiters: order, no loss, no duplication.
//!
//! A block that does not look at its words treats all alike. So it suffices to send white words, one red and one blue
//! behind it (Wolper). What comes out has to be coloured in the same way.

use crate::{Claim, claim, design};
use tilewright_blocks::{Arbiter, ArbiterIn, Fifo, Lifo, RegisterSlice, Slice, Storage, StreamBlocks, StreamIn, Turns};
use tilewright_hdl::*;

const RED: u64 = 1;
const BLUE: u64 = 2;

/// A block with a stream in and a stream out that keeps the sequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Line {
    Queue(u32, Storage),
    Cut(Slice),
    /// Into halves, and back.
    Halves,
}

block! {
    /// Coloured words through a line. The mutant may send a second red word.
    struct Coloured { line: Line, wrong: bool }
    in ColouredIn { offers: bit(), colour: bits(2), takes: bit() }
    out ColouredOut { taken: bit() }
}

impl Coloured {
    fn build(&self, m: Module, i: ColouredIn) -> ColouredOut {
        let (into, sent) = m.offer(i.offers, i.colour);
        let out = match self.line {
            Line::Queue(depth, storage) => m.instance("u_line", &Fifo::new(depth, 2, storage), StreamIn { into }).out,
            Line::Halves => m.widen("u_widen", 2, m.narrow("u_narrow", 2, into)),
            Line::Cut(cuts) => m.instance("u_line", &RegisterSlice { width: 2, cuts }, StreamIn { into }).out,
        };
        let word = out.take_when(i.takes);
        let seen = |name: &str, happens: Signal| m.reg(name, 1).reset(0).when(happens, 1);
        let red_in = seen("red_in", sent & i.colour.eq(RED));
        let blue_in = seen("blue_in", sent & i.colour.eq(BLUE));
        let red_out = seen("red_out", word.taken & word.eq(RED));
        let blue_out = seen("blue_out", word.taken & word.eq(BLUE));
        let is_red = if self.wrong { !blue_in } else { !red_in };
        m.assume(i.colour.ne(3), "there are three colours");
        if self.line == Line::Halves {
            let waits = m.past(i.offers & !sent);
            m.assume(waits.implies(i.offers & m.stable(i.colour)), "an offered word stays until it is taken");
        }
        m.assume((sent & i.colour.eq(RED)).implies(is_red), "one word is red");
        m.assume((sent & i.colour.eq(BLUE)).implies(red_in & !blue_in), "one word behind it is blue");
        m.assert(word.taken.implies(word.ne(3)), "no word has another colour");
        m.assert((word.taken & word.eq(RED)).implies(!red_out), "the red word comes once");
        m.assert((word.taken & word.eq(BLUE)).implies(red_out & !blue_out), "the blue word comes once, behind it");
        ColouredOut { taken: word.taken }
    }
}

fn coloured(line: Line, wrong: bool) -> Design {
    design(&Coloured { line, wrong })
}

block! {
    /// A stack of coloured words: the last one in comes out first.
    struct Stacked { wrong: bool }
    in StackedIn { offers: bit(), marks: bit(), takes: bit() }
    out StackedOut { taken: bit() }
}

impl Stacked {
    fn build(&self, m: Module, i: StackedIn) -> StackedOut {
        let (into, sent) = m.offer(i.offers, i.marks);
        let out = m.instance("u_stack", &Lifo::new(3, 1), StreamIn { into }).out;
        def!(shows = out.valid);
        let word = out.take_when(i.takes);
        // The words that come out before the marked one; 7 if it is not in the stack. A shown word stays shown, and a
        // word that comes while it is taken is shown next.
        def!(before = m.reg(3).reset(7));
        def!(enters = sent & i.marks);
        let is_in = before.ne(7);
        let waits = is_in & before.ne(0);
        m.assume(enters.implies(!is_in), "one word in the stack is marked");
        before
            .when(enters, (shows & !word.taken).zext(3))
            .when(word.taken & before.eq(0), 7)
            .when(sent & !word.taken & waits, before + 1)
            .when(word.taken & !sent & waits, before - 1);
        let top = if self.wrong { 1 } else { 0 };
        m.assert(
            word.taken.implies(word.eq(before.eq(top))),
            "of the words that are not shown, the last one in comes out first",
        );
        StackedOut { taken: word.taken }
    }
}

block! {
    /// Three senders. Each word says from which it is.
    struct Arbitrated { turns: Turns, wrong: bool }
    in ArbitratedIn { offers: bits(3), takes: bit() }
    out ArbitratedOut { taken: bit() }
}

impl Arbitrated {
    fn build(&self, m: Module, i: ArbitratedIn) -> ArbitratedOut {
        let offered = (0..3u32).map(|sender| m.offer(i.offers.bit(sender), lit(2, u64::from(sender))));
        let (into, sent): (Vec<Stream>, Vec<Signal>) = offered.unzip();
        let arbiter = Arbiter::new(3, 2, self.turns);
        let out = m.instance("u_arbiter", &arbiter, ArbiterIn { into }).out;
        def!(shown = out.valid);
        let word = out.take_when(i.takes);
        let takes = |sender: usize| word.taken & word.eq(sender as u64);
        for (sender, sent) in sent.iter().enumerate() {
            m.assert(sent.eq(takes(sender)), "a sender's word is taken if and only if it comes out");
        }
        m.assert(shown.eq(i.offers.any_one()), "a word comes out if one is offered");
        let taken = concat(&sent.iter().rev().copied().collect::<Vec<_>>());
        m.assume((m.past(i.offers & !taken) & !i.offers).eq(0), "an offered word stays until it is taken");
        if self.turns == Turns::RoundRobin {
            // While sender 0 waits, others are served at most twice.
            def!(passed = m.reg(2).reset(0));
            let waits = i.offers.bit(0) & !takes(0);
            passed.when(!waits, 0).when(word.taken, passed + 1);
            let most = if self.wrong { 1 } else { 2 };
            m.assert(passed.le(most), "a sender waits for each other one at most once");
        } else {
            let other = if self.wrong { takes(0) } else { takes(1) };
            def!(waited = m.reg(1).reset(0));
            waited.next(shown & !word.taken);
            m.assert(
                (other & !waited).implies(!i.offers.bit(0)),
                "the first sender is served first unless a word waits",
            );
        }
        ArbitratedOut { taken: word.taken }
    }
}

/// What is proved of streams.
pub fn claims() -> Vec<Claim> {
    let order = "keeps the sequence, loses nothing, repeats nothing";
    vec![
        claim(&["fifo"], "queue, 1 word in registers", order, [4; 2], |wrong| {
            coloured(Line::Queue(1, Storage::Registers), wrong)
        }),
        claim(&["fifo"], "queue, 2 words in registers", order, [4; 2], |wrong| {
            coloured(Line::Queue(2, Storage::Registers), wrong)
        }),
        claim(&["fifo"], "queue, 3 words in registers", order, [4; 2], |wrong| {
            coloured(Line::Queue(3, Storage::Registers), wrong)
        }),
        claim(&["fifo"], "queue, 4 words in registers", order, [4; 2], |wrong| {
            coloured(Line::Queue(4, Storage::Registers), wrong)
        }),
        claim(&["block-ram-fifo"], "queue, 3 words in block RAM", order, [5; 2], |wrong| {
            coloured(Line::Queue(3, Storage::BlockRam), wrong)
        }),
        claim(&["forward-slice"], "forward register slice", order, [4; 2], |wrong| {
            coloured(Line::Cut(Slice::Forward), wrong)
        }),
        claim(&["backward-slice"], "backward register slice", order, [4; 2], |wrong| {
            coloured(Line::Cut(Slice::Backward), wrong)
        }),
        claim(&["skid-buffer"], "skid buffer", order, [4; 2], |wrong| coloured(Line::Cut(Slice::Both), wrong)),
        claim(&["narrow", "widen"], "narrowed to halves, and widened again", order, [9; 2], |wrong| {
            coloured(Line::Halves, wrong)
        }),
        claim(
            &["lifo"],
            "stack, 3 words",
            "of the words that are not shown, the last one in comes out first",
            [4; 2],
            |wrong| design(&Stacked { wrong }),
        ),
        claim(
            &["round-robin-arbiter"],
            "round-robin arbiter, 3 senders",
            "loses nothing, repeats nothing, and nobody waits for more than two others",
            [4; 2],
            |wrong| design(&Arbitrated { turns: Turns::RoundRobin, wrong }),
        ),
        claim(
            &["priority-arbiter"],
            "priority arbiter, 3 senders",
            "loses nothing, repeats nothing, and serves the first sender first unless a word waits",
            [4; 2],
            |wrong| design(&Arbitrated { turns: Turns::Priority, wrong }),
        ),
    ]
}

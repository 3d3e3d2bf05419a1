//! Merges several streams into one.

use crate::encode::first;
use crate::ports::StreamOut;
use tilewright_hdl::{Module, Signal, bits, block, concat, def, mux, select, stream};

/// The stream that is served when several have a word.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::{StreamBlocks, Turns};
/// # let example = tilewright_sim::traced(|m| {
/// for (name, turns) in [("by_turns", Turns::RoundRobin), ("by_rank", Turns::Priority)] {
///     let streams = [1, 2].map(|word| m.offer(lit(1, 1), lit(8, word)).0);
///     let word = m.arbiter(&format!("u_{name}"), turns, streams).take_when(1);
///     let _ = word.named(name);
/// }
/// # });
/// assert_eq!(example.values("by_turns"), [1, 2, 1, 2]);
/// assert_eq!(example.values("by_rank"), [1, 1, 1, 1]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Turns {
    /// Round robin: the next stream after the last one served. Each stream waits for at most one word of each other
    /// stream.
    RoundRobin,
    /// Fixed priority: the lowest stream that has a word. The others may wait forever.
    Priority,
}

block! {
    /// Merges the words of several streams into one stream.
    ///
    /// ```text
    /// into.0 ===>|\
    /// into.1 ===>| |===> out      [locked] to the sender whose word is shown, until it is taken
    /// into.2 ===>|/
    /// ```
    ///
    /// Latency 0, one word per clock. A word on `out` stays there even if one with a higher priority arrives. No
    /// `valid` waits for `ready`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{StreamBlocks, Turns};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(2).reset(0));
    /// count.next(count + 1);
    /// let (often, _) = m.offer(lit(1, 1), lit(8, 2));
    /// let (seldom, _) = m.offer(count.eq(2), lit(8, 1));
    /// let word = m.arbiter("u_arbiter", Turns::Priority, [seldom, often]).take_when(1);
    /// def!(sent = *word);
    /// # });
    /// assert_eq!(example.values("sent"), [2, 2, 1, 2, 2, 2, 1]);
    /// ```
    pub struct Arbiter {
        senders: u32,
        width: u32,
        turns: Turns,
    }
    latency = "0 clocks";
    in(self) ArbiterIn {
        /// A stream of words from each sender.
        into: [stream(bits(self.width)); self.senders],
    }
    out(self) = StreamOut { out: stream(bits(self.width)) };
}

impl Arbiter {
    /// An arbiter of `senders` senders, each of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::{Arbiter, Turns};
    ///
    /// assert_eq!(Arbiter::new(4, 8, Turns::RoundRobin).name(), "arbiter_senders4_width8_turns_round_robin");
    /// ```
    ///
    /// # Panics
    ///
    /// `senders` is 0.
    #[track_caller]
    pub fn new(senders: u32, width: u32, turns: Turns) -> Arbiter {
        assert!(senders > 0, "an arbiter of 0 senders sends nothing");
        Arbiter { senders, width, turns }
    }

    fn build(&self, m: Module, i: ArbiterIn) -> StreamOut {
        // Bit 0 is sender 0; at most one bit is high in each of the others.
        let valid: Vec<Signal> = i.into.iter().rev().map(|stream| stream.valid).collect();
        def!(requests = concat(&valid));
        def!(locked = m.reg(self.senders).reset(0));
        let last = matches!(self.turns, Turns::RoundRobin).then(|| m.reg("last", self.senders).reset(0));
        let next = match last {
            None => first(requests),
            Some(last) => {
                def!(after = requests & !(last | (last - 1)));
                mux(after.any_one(), first(after), first(requests))
            }
        };
        def!(chosen = mux(locked.any_one(), locked, next));

        let arms = i.into.iter().zip(0..).map(|(stream, sender)| (chosen.bit(sender), stream.payload));
        let (out, sent) = m.offer(requests.any_one(), select(arms.skip(1).collect::<Vec<_>>(), i.into[0].payload));
        locked.next(mux(sent, 0, chosen));
        if let Some(last) = last {
            last.when(sent, chosen);
        }
        for (stream, sender) in i.into.iter().zip(0..) {
            stream.take_when(chosen.bit(sender) & out.ready);
        }
        let waits = requests.any_one() & !sent;
        m.assert(m.past(waits).implies(m.stable(chosen)), "a word stays chosen until it is taken");
        m.cover("a word waits while another one arrives", m.past(waits) & m.past(requests).lt(requests));
        StreamOut { out }
    }
}

//! One stream to one of several receivers.

use crate::encode::one_hot;
use tilewright_hdl::{Data, Module, Signal, Stream, below, bits, block, lit};

block! {
    /// Sends each word to the receiver whose number comes with it.
    ///
    /// ```text
    ///             .===> out.0
    /// into ===>--+===> out.1
    ///          to--'===> out.2
    /// ```
    ///
    /// Latency 0. No `valid` waits for `ready`. `into.ready` is that of the word's receiver, and low while there is no
    /// word. The number may also be a function of the word: [`StreamBlocks::split_by`](crate::StreamBlocks::split_by).
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Addressed, Split, SplitIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// let (into, sent) = m.offer(lit(1, 1), Addressed { to: count.bit(0), word: *count });
    /// count.when(sent, count + 1);
    /// def!(split = m.instance(&Split::new(2, 4), SplitIn { into }));
    /// let out = split.out;
    /// def!(even_taken = out[0].take_when(1).taken);
    /// def!(slow = m.reg(1).reset(0));
    /// slow.next(!slow);
    /// def!(odd_taken = out[1].take_when(!slow).taken);
    /// # });
    /// assert_eq!(example.values("even_taken"), [1, 0, 0, 1, 0, 1]);
    /// assert_eq!(example.values("odd_taken"), [0, 0, 1, 0, 1, 0]); // while an odd word waits, so does the next
    /// ```
    pub struct Split {
        receivers: u32,
        width: u32,
    }
    in(self) SplitIn {
        /// A word for one of the receivers.
        into: stream(pub struct Addressed {
            /// The number of the receiver.
            to: below(self.receivers),
            /// The word that the receiver gets.
            word: bits(self.width),
        }),
    }
    out(self) SplitOut {
        /// The words for each receiver.
        out: [stream(bits(self.width)); self.receivers],
    }
}

impl Split {
    /// A split to `receivers` receivers of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Split;
    ///
    /// assert_eq!(Split::new(3, 8).name(), "split_receivers3_width8");
    /// ```
    ///
    /// # Panics
    ///
    /// `receivers` is 0.
    #[track_caller]
    pub fn new(receivers: u32, width: u32) -> Split {
        assert!(receivers > 0, "a split to 0 receivers takes nothing");
        Split { receivers, width }
    }

    fn build(&self, m: Module, i: SplitIn) -> SplitOut {
        m.cover("a word waits for its receiver", i.into.valid & !i.into.ready);
        let (out, has_receiver) = split(m, &i.into.with(i.into.word), i.into.to, self.receivers);
        if let Some(has_receiver) = has_receiver {
            m.assume(has_receiver, &goes_to_one_of(self.receivers));
        }
        SplitOut { out }
    }
}

/// The sentence of the assertion about a word's receiver.
pub(crate) fn goes_to_one_of(receivers: u32) -> String {
    format!("a word goes to one of {receivers} receivers")
}

/// Splits a stream: each word goes to the receiver with number `to`. If a number may have no receiver, an assertion
/// checks it.
#[track_caller]
pub(crate) fn split<P: Data>(
    m: Module,
    stream: &Stream<P>,
    to: Signal,
    receivers: u32,
) -> (Vec<Stream<P>>, Option<Signal>) {
    let chosen = one_hot(to, receivers);
    let mut ready = lit(1, 0);
    // A loop, because a closure would be the caller in error messages.
    let mut streams = Vec::new();
    for number in 0..receivers {
        let (out, sent) = m.offer(stream.valid & chosen.bit(number), stream.payload.clone());
        ready |= sent;
        streams.push(out);
    }
    stream.take_when(ready);
    let has_none = to.width() < 64 && u64::from(receivers) != 1 << to.width();
    (streams, has_none.then(|| stream.valid.implies(chosen.any_one())))
}

//! One stream to several receivers.

use crate::ports::StreamIn;
use tilewright_hdl::{Module, bit, bits, block, lit, stream};

block! {
    /// Gives each word to all receivers, to each when it is ready; receivers that have the word wait for the others.
    ///
    /// ```text
    ///          .---> out.0
    /// into ====+---> out.1      [done] for each: it has the word already
    ///          '---> out.2
    /// ```
    ///
    /// Latency 0. No `valid` waits for any `ready`; `into.ready` is one function of all receivers' `ready`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Fork, StreamIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// let (into, sent) = m.offer(lit(1, 1), *count);
    /// count.when(sent, count + 1);
    /// def!(fork = m.instance(&Fork::new(2, 4), StreamIn { into }));
    /// let out = fork.out;
    /// def!(slow = m.reg(1).reset(0));
    /// slow.next(!slow);
    /// def!(fast_takes = out[0].take_when(1).taken);
    /// def!(slow_takes = out[1].take_when(*slow).taken);
    /// # });
    /// assert_eq!(example.values("fast_takes"), [1, 0, 1, 0]); // the fast one waits for the slow one
    /// assert_eq!(example.values("slow_takes"), [0, 1, 0, 1]);
    /// ```
    pub struct Fork {
        receivers: u32,
        width: u32,
    }
    latency = "0 clocks";
    in(self) = StreamIn { into: stream(bits(self.width)) };
    out(self) ForkOut {
        /// All words, for each receiver.
        out: [stream(bits(self.width)); self.receivers],
    }
}

impl Fork {
    /// A fork to `receivers` receivers of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Fork;
    ///
    /// assert_eq!(Fork::new(3, 8).name(), "fork_receivers3_width8");
    /// ```
    ///
    /// # Panics
    ///
    /// `receivers` is 0.
    #[track_caller]
    pub fn new(receivers: u32, width: u32) -> Fork {
        assert!(receivers > 0, "a fork to 0 receivers takes nothing");
        Fork { receivers, width }
    }

    fn build(&self, m: Module, i: StreamIn) -> ForkOut {
        let mut all = lit(1, 1);
        let (mut out, mut has) = (Vec::new(), Vec::new());
        for receiver in 0..self.receivers {
            let done = m.reg(&format!("done{receiver}"), bit()).reset(0);
            let (stream, sent) = m.offer(i.into.valid & !done, i.into.payload);
            all &= done | stream.ready;
            out.push(stream);
            has.push((done, sent));
        }
        let into = i.into.take_when(all);
        for (done, sent) in has {
            done.when(into.taken, 0).when(sent, 1);
        }
        ForkOut { out }
    }
}

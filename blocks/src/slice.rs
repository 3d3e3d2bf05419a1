//! Register slices: registers on one direction of a stream, or on both.

use crate::ports::{StreamIn, StreamOut, state_that_it_stays};
use tilewright_hdl::{Module, bit, bits, block, def, mux, stream};

/// The paths that a [`RegisterSlice`] cuts.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::{RegisterSlice, Slice, StreamIn};
/// # let example = tilewright_sim::traced(|m| {
/// for (name, cuts) in [("forward", Slice::Forward), ("backward", Slice::Backward), ("skid", Slice::Both)] {
///     let (into, _) = m.offer(lit(1, 1), lit(8, 7));
///     let out = m.instance(&format!("u_{name}"), &RegisterSlice { width: 8, cuts }, StreamIn { into }).out;
///     let _ = out.take_when(1).taken.named(&format!("{name}_takes"));
/// }
/// # });
/// assert_eq!(example.values("forward_takes"), [0, 1, 1]);
/// assert_eq!(example.values("backward_takes"), [1, 1, 1]);
/// assert_eq!(example.values("skid_takes"), [0, 1, 1]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Slice {
    /// `valid` and the payload come from registers; `ready` passes. Latency 1 clock.
    ///
    /// ```text
    /// into ===>[held]===> out
    ///   ready <---------- ready
    /// ```
    Forward,
    /// `ready` comes from a register; `valid` and the payload pass, or wait in a second register. Latency 0.
    ///
    /// ```text
    /// into ===+===========>|\
    ///         '==>[held]==>|/===> out
    ///   ready <---[full]
    /// ```
    Backward,
    /// All come from registers: a skid buffer of two words. Latency 1 clock.
    ///
    /// ```text
    /// into ===+============>|\
    ///         '==>[spare]==>|/==>[held]===> out
    ///   ready <---[spare_full]
    /// ```
    Both,
}

block! {
    /// Puts registers on one direction of a stream, or on both, and passes a word each clock.
    ///
    /// The registers cut long paths; [`Slice`] lists the three kinds and their latencies.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{RegisterSlice, Slice, StreamIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// let (into, sent) = m.offer(lit(1, 1), *count);
    /// count.when(sent, count + 1);
    /// let skid = RegisterSlice { width: 4, cuts: Slice::Both };
    /// m.instance("u_skid", &skid, StreamIn { into }).out.take_when(0);
    /// # });
    /// assert_eq!(example.values("count"), [0, 1, 2, 2, 2]); // a skid buffer has room for two words
    /// ```
    pub struct RegisterSlice {
        /// The width of the payload.
        pub width: u32,
        /// The paths to cut.
        pub cuts: Slice,
    }
    latency(self) = match self.cuts {
        Slice::Forward | Slice::Both => "1 clock",
        Slice::Backward => "0 clocks",
    };
    in(self) = StreamIn { into: stream(bits(self.width)) };
    out(self) = StreamOut { out: stream(bits(self.width)) };
}

impl RegisterSlice {
    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        def!(full = m.reg(bit()).reset(0));
        def!(held = m.reg(self.width));
        match self.cuts {
            Slice::Forward => {
                let (out, sent) = m.offer(full, *held);
                let into = i.into.take_when(!full | out.ready);
                held.when(into.taken, *into);
                full.when(into.taken, 1).when(sent, 0);
                state_that_it_stays(m, &out);
                StreamOut { out }
            }
            Slice::Backward => {
                let into = i.into.take_when(!full);
                let (out, sent) = m.offer(full | into.valid, mux(full, held, *into));
                held.when(into.taken, *into);
                full.when(sent, 0).when(into.taken, 1);
                StreamOut { out }
            }
            Slice::Both => {
                def!(spare_full = m.reg(bit()).reset(0));
                def!(spare = m.reg(self.width));
                let (out, _) = m.offer(full, *held);
                let into = i.into.take_when(!spare_full);
                let moves = !full | out.ready;
                held.when(moves, mux(spare_full, spare, *into));
                full.when(moves, spare_full | into.valid);
                spare.when(into.taken, *into);
                spare_full.when(moves, 0).when(into.taken, 1);
                state_that_it_stays(m, &out);
                m.cover("both registers are full", m.rose(spare_full));
                StreamOut { out }
            }
        }
    }
}

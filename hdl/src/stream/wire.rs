//! A stream that is taken before it is made, for a loop of blocks.

use crate::data::{Data, Layout};
use crate::fields::Fields;
use crate::module::Module;
use crate::names::port_name;
use crate::signal::Signal;
use crate::stream::Stream;
use crate::width::bit;
use crate::wire::Wire;
use std::ops::Deref;
use tilewright_circuit::Loc;

/// A stream declared before its sender, made by [`Module::stream_wire`]. It reads as the stream; call
/// [`drive`](StreamWire::drive) exactly once.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// def!(words = m.stream_wire(8));
/// let word = words.take_when(1); // taken here, ..
/// words.drive(m.offer(lit(1, 1), lit(8, 7)).0); // .. made there
/// m.assert(word.taken & word.eq(7), "as in the opposite sequence");
/// # });
/// ```
#[derive(Debug, Clone, Copy)]
#[must_use]
pub struct StreamWire<P = Signal> {
    stream: Stream<P>,
    /// The index of `valid`; the payload's fields follow.
    index: usize,
}

impl<P> Deref for StreamWire<P> {
    type Target = Stream<P>;

    fn deref(&self) -> &Stream<P> {
        &self.stream
    }
}

impl Module {
    /// A stream that is taken before it is described, as in a loop of blocks. Its payload is declared like that of a
    /// [`stream`](crate::stream()), and its nets are named like those of a port. In the loop, both directions need a
    /// register: a queue, or a slice that cuts both.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     /// Stores a number.
    /// #     struct Slot { full: bool }
    /// #     in SlotIn { into: stream(8) }
    /// #     out SlotOut { out: stream(8) }
    /// # }
    /// # impl Slot {
    /// #     fn build(&self, m: Module, i: SlotIn) -> SlotOut {
    /// #         def!(full = m.reg(bit()).reset(self.full));
    /// #         def!(held = m.reg(8).reset(0));
    /// #         let (out, sent) = m.offer(full, *held);
    /// #         let into = i.into.take_when(!full);
    /// #         held.when(into.taken, *into);
    /// #         full.when(into.taken, 1).when(sent, 0);
    /// #         SlotOut { out }
    /// #     }
    /// # }
    /// # block! {
    /// #     /// A number that circulates and grows by one each time.
    /// #     struct Ring;
    /// #     out RingOut { number: bits(8) }
    /// # }
    /// # impl Ring {
    /// #     fn build(&self, m: Module, (): ()) -> RingOut {
    /// def!(again = m.stream_wire(8));
    /// let first = m.instance("u_first", &Slot { full: false }, SlotIn { into: *again }).out;
    /// let second = m.instance("u_second", &Slot { full: true }, SlotIn { into: first }).out;
    /// again.drive(second.with(*second + 1));
    /// #         RingOut { number: again.payload }
    /// #     }
    /// # }
    /// # let mut sim = tilewright_sim::Simulation::of(&Ring)?;
    /// # sim.reset();
    /// # sim.run(10);
    /// # assert_eq!(sim.get_u64(sim.o.number), 6);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    pub fn stream_wire<L: Layout>(self, name: &str, payload: L) -> StreamWire<L::Value> {
        let loc = Loc::caller();
        let valid = self.net(&port_name(name, "valid"), bit(), loc);
        let payload = payload.layout().map_fields("", &mut |path, width| {
            let path = if path.is_empty() { "payload" } else { path };
            self.net(&port_name(name, path), *width, loc).signal
        });
        StreamWire { stream: self.offer(*valid, payload).0, index: valid.index }
    }
}

impl<P: Data> StreamWire<P> {
    /// Says which stream it is, and takes that stream.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(words = m.stream_wire(8));
    /// let (sent, takes) = m.offer(lit(1, 1), lit(8, 7));
    /// words.drive(sent);
    /// let _ = words.take_when(0);
    /// m.assert(!takes, "its `ready` comes from the receiver of the wire");
    /// # });
    /// ```
    #[track_caller]
    pub fn drive(&self, stream: Stream<P>) {
        let fields = |stream: &Stream<P>| [vec![stream.valid], signals(&stream.payload)].concat();
        for (i, (signal, driver)) in fields(&self.stream).into_iter().zip(fields(&stream)).enumerate() {
            Wire { signal, index: self.index + i }.drive(driver);
        }
        stream.take_when(self.stream.ready);
    }
}

fn signals<P: Data>(payload: &P) -> Vec<Signal> {
    payload.leaves().into_iter().map(|(_, signal)| signal).collect()
}

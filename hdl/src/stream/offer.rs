//! What a description does with streams: it takes them, offers them, and gives them another payload.

use crate::data::Data;
use crate::elaboration;
use crate::loc::Loc;
use crate::module::Module;
use crate::operand::{IntoSignal, Operand, Value};
use crate::record;
use crate::select::condition;
use crate::signal::Signal;
use crate::stream::{Origin, Stream, take, untaken};
use std::ops::Deref;

/// A stream that is being taken, made by [`Stream::take_when`]. It reads as its payload.
#[derive(Debug, Clone, Copy)]
pub struct Taken<P> {
    /// The payload goes over at this edge: it is valid, and this side is ready.
    pub taken: Signal,
    /// The sender has a payload.
    pub valid: Signal,
    /// What goes over where `taken` is high.
    pub payload: P,
}

impl<P> Deref for Taken<P> {
    type Target = P;

    fn deref(&self) -> &P {
        &self.payload
    }
}

impl<P: Data> Stream<P> {
    /// Takes the stream's payload at each edge where it is valid and `can_accept`, 1 bit, is high, which is its `ready`.
    #[track_caller]
    pub fn take_when(&self, can_accept: impl Operand) -> Taken<P> {
        let loc = Loc::caller();
        let ready = match can_accept.operand() {
            Value::Signal(signal) => condition(signal, "take_when"),
            number => number.like(self.ready, "take_when"),
        };
        take(self.ready, ready, loc);
        Taken { taken: self.valid & ready, valid: self.valid, payload: self.payload.clone() }
    }

    /// The stream with another payload, which is made of this one in the same cycle: `jobs.with(jobs.page)`.
    pub fn with<Q: Data>(&self, payload: Q) -> Stream<Q> {
        Stream { valid: self.valid, ready: self.ready, payload }
    }

    /// The stream with its payload's fields side by side in one signal, the first most significant; so are the lanes of a field, lane 0 in the
    /// lowest bits.
    #[track_caller]
    pub fn packed(&self) -> Stream {
        self.with(record::pack_any(&self.payload, self.valid.shape))
    }
}

impl Stream {
    /// The stream with a payload like `like`, which its own one is packed of.
    #[track_caller]
    pub fn unpacked<P: Data>(&self, like: &P) -> Stream<P> {
        self.with(record::unpack_any(like, self.payload))
    }
}

impl Module {
    /// A stream that this block sends: `payload`, where `valid`, 1 bit, is high. Given back are the stream, which is returned among the
    /// outputs or fed to an instance, and a signal that says that its receiver takes the payload at this edge. `valid` must not wait
    /// for that signal.
    ///
    /// See [`Stream`] for a block that does it. The stream's `ready` belongs to this handle's clock.
    #[track_caller]
    pub fn offer<P: Data>(self, valid: impl IntoSignal, payload: P) -> (Stream<P>, Signal) {
        let loc = Loc::caller();
        let valid = condition(valid.into(), "offer");
        let ready = elaboration::with(|e| untaken(e, Origin::Offered, valid.shape, self.clock, loc));
        (Stream { valid, ready, payload }, valid & ready)
    }
}

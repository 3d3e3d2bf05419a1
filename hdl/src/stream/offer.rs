//! Operations on streams: taking them, offering them, and changing their payload.

use crate::data::Data;
use crate::elaboration;
use crate::module::Module;
use crate::operand::{IntoSignal, Operand, Value};
use crate::record;
use crate::select::condition;
use crate::signal::Signal;
use crate::stream::{Origin, Stream, take, untaken};
use std::ops::Deref;
use tilewright_circuit::Loc;

/// A stream that is being taken, made by [`Stream::take_when`]. It reads as its payload.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// def!(count = m.reg(4).reset(0));
/// let (numbers, sent) = m.offer(lit(1, 1), *count);
/// count.when(sent, count + 1);
///
/// def!(busy = m.reg(1).reset(0));
/// let number = numbers.take_when(!busy);
/// busy.next(number.taken);
/// def!(sum = m.reg(8).reset(0));
/// sum.when(number.taken, sum + number.zext(8)); // it reads as the payload
/// # });
/// assert_eq!(example.values("count"), [0, 1, 1, 2, 2, 3]);
/// assert_eq!(example.values("sum"), [0, 0, 0, 1, 1, 3]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Taken<P> {
    /// The payload is transferred at this edge: it is valid, and this side is ready.
    pub taken: Signal,
    /// The sender has a payload.
    pub valid: Signal,
    /// The data, transferred where `taken` is high.
    pub payload: P,
}

impl<P> Deref for Taken<P> {
    type Target = P;

    fn deref(&self) -> &P {
        &self.payload
    }
}

impl<P: Data> Stream<P> {
    /// Takes the stream's payload at each edge where it is valid and `can_accept`, 1 bit, is high. `can_accept`
    /// drives the stream's `ready`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(left = m.reg(4).reset(3));
    /// let (tokens, sent) = m.offer(left.ne(0), *left);
    /// left.when(sent, left - 1);
    ///
    /// def!(wait = m.reg(1).reset(1));
    /// wait.next(0);
    /// let token = tokens.take_when(!wait);
    /// def!(taken = token.taken);
    /// # });
    /// // It is ready from the second clock on, and takes three payloads.
    /// assert_eq!(example.values("taken"), [0, 1, 1, 1, 0]);
    /// ```
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

    /// The stream with another payload, computed from this one in the same cycle: `jobs.with(jobs.page)`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Job<T> { page: T, last: T } }
    ///
    /// let (jobs, _) = m.offer(lit(1, 1), Job { page: lit(4, 11), last: lit(1, 0) });
    /// let addresses = jobs.with(jobs.page.zext(12) << 8);
    /// let address = addresses.take_when(1);
    /// m.assert(address.taken & address.eq(0xb00), "the same handshake, so it is `jobs` that is taken");
    /// # });
    /// ```
    pub fn with<Q: Data>(&self, payload: Q) -> Stream<Q> {
        Stream { valid: self.valid, ready: self.ready, payload }
    }

    /// The stream with its payload packed into one signal: the fields side by side, the first most significant; the
    /// lanes of a field with lane 0 in the lowest bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Job<T> { page: T, last: T } }
    ///
    /// let (jobs, _) = m.offer(lit(1, 1), Job { page: lit(4, 0xa), last: lit(1, 1) });
    /// let words = jobs.packed();
    /// m.assert(words.take_when(1).eq(0b1010_1), "for a block that carries words, not records");
    /// # });
    /// ```
    #[track_caller]
    pub fn packed(&self) -> Stream {
        self.with(record::pack_any(&self.payload, self.valid.shape))
    }
}

impl Stream {
    /// The stream with its packed payload unpacked again, to a payload like `like`. If an instance sends the stream,
    /// fields that are computed with are named after it and themselves.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Job<T> { page: T, last: T } }
    ///
    /// let like = Job { page: lit(4, 0), last: lit(1, 0) };
    /// let (words, _) = m.offer(lit(1, 1), lit(5, 0b1010_1));
    /// let job = words.unpacked(&like).take_when(1);
    /// m.assert(job.page.eq(0xa) & job.last, "only the widths of `like` matter");
    /// # });
    /// ```
    #[track_caller]
    pub fn unpacked<P: Data>(&self, like: &P) -> Stream<P> {
        let (word, payload) = (self.payload.id(), record::unpack_any(like, self.payload));
        elaboration::draft(|draft| {
            let fields = payload.leaves().into_iter().filter(|(_, field)| field.node != word);
            draft.unpacked.extend(fields.map(|(path, field)| (word, field.node, path)));
        });
        self.with(payload)
    }
}

impl Module {
    /// A stream that this block sends: `payload`, where `valid`, 1 bit, is high. It returns the stream and a signal
    /// that is high when the receiver takes the payload at this edge. Return the stream among the outputs, or feed an
    /// instance with it. `valid` must not wait for that signal.
    ///
    /// See [`Stream`] for a block that uses it. The stream's `ready` belongs to this handle's clock.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// let (numbers, sent) = m.offer(count.lt(3), *count);
    /// count.when(sent, count + 1);
    /// let number = numbers.take_when(1);
    /// def!(taken = number.taken);
    /// # });
    /// assert_eq!(example.values("count"), [0, 1, 2, 3, 3]);
    /// assert_eq!(example.values("taken"), [1, 1, 1, 0, 0]);
    /// ```
    #[track_caller]
    pub fn offer<P: Data>(self, valid: impl IntoSignal, payload: P) -> (Stream<P>, Signal) {
        let loc = Loc::caller();
        let valid = condition(valid.into(), "offer");
        let ready = elaboration::with(|e| untaken(e, Origin::Offered, valid.shape, self.clock, loc));
        (Stream { valid, ready, payload }, valid & ready)
    }
}

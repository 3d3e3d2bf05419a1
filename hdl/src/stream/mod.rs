//! Streams: a payload that is transferred where its sender is valid and its receiver is ready.

mod connect;
mod lanes;
mod offer;
mod wire;

pub(crate) use connect::{DraftStream, Origin, Sent, backwards, inputs_of_stream, leave, say_untaken, take, untaken};
pub(crate) use lanes::stack_ready;
pub use offer::Taken;
use tilewright_circuit::Clock;
pub use wire::StreamWire;

use crate::bundle::join;
use crate::data::{Data, Layout};
use crate::fields::{Fields, Leaf, Visited};
use crate::width::{Width, bit};
use std::ops::Deref;

/// A payload with its handshake. It is transferred at an edge where `valid` and `ready` are both high. The sender
/// must not wait for `ready` before it raises `valid`. Once `valid` is high, the sender keeps `valid` and the payload
/// unchanged until the transfer.
///
/// In a [`bundle!`](crate::bundle!), a stream is a field that runs both ways: the `ready` of an input stream is an
/// output port, and the `ready` of an output stream is an input port. The ports of `jobs: Stream<Job<T>, T>` are
/// `jobs_valid`, `jobs_ready` and one for each field of the payload, such as `jobs_page`. A payload that is one
/// signal has the port `jobs_payload`. The payload's fields can be read directly: `i.jobs.page`.
///
/// A stream is taken exactly once: by [`take_when`](Stream::take_when), by an instance that it feeds, or by being
/// returned. A block makes the streams that it sends with [`Module::offer`](crate::Module::offer).
///
/// ```
/// # use tilewright_hdl::*;
/// bundle! {
///     /// A request.
///     pub struct Job<T> { pub page: T, pub last: T }
///     /// The stream that comes in.
///     pub struct DelayIn<T> { pub jobs: Stream<Job<T>, T> }
///     /// The stream that goes out.
///     pub struct DelayOut<T> { pub delayed: Stream<Job<T>, T> }
/// }
///
/// /// Stores one job; latency one clock.
/// #[derive(Debug, Clone, PartialEq, Eq, Hash)]
/// struct Delay { pages: u32 }
///
/// impl Block for Delay {
///     type In = DelayIn;
///     type Out = DelayOut;
///
///     fn inputs(&self) -> DelayIn<Width> {
///         DelayIn { jobs: stream(Job { page: below(self.pages), last: bit() }) }
///     }
///
///     fn build(&self, m: Module, i: DelayIn) -> DelayOut {
///         def!(full = m.reg(bit()).reset(0));
///         def!(held = m.reg(Job { page: below(self.pages), last: bit() }));
///         let (delayed, sent) = m.offer(full, *held);
///         let jobs = i.jobs.take_when(!full | sent);
///         held.when(jobs.taken, *jobs);
///         full.when(jobs.taken, 1).when(sent, 0);
///         DelayOut { delayed }
///     }
/// }
///
/// let design = elaborate(&Delay { pages: 12 })?;
/// let names = |ports: Vec<&str>| ports.join(" ");
/// assert_eq!(names(design.top().inputs.iter().map(|port| &*port.name).collect()), "jobs_valid jobs_page jobs_last delayed_ready");
/// assert_eq!(names(design.top().outputs.iter().map(|port| &*port.name).collect()), "delayed_valid delayed_page delayed_last jobs_ready");
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Stream<P = crate::Signal, T = crate::Signal> {
    /// The sender has a payload.
    pub valid: T,
    /// The receiver takes it.
    pub ready: T,
    /// The data: a signal or a record.
    pub payload: P,
}

impl<P, T> Deref for Stream<P, T> {
    type Target = P;

    fn deref(&self) -> &P {
        &self.payload
    }
}

impl<P, T: Default> Stream<P, T> {
    /// The values for a testbench to drive: `Stream::of(1, Job { page: 7, last: 0 })`. They do not include `ready`,
    /// which the block itself drives.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// bundle! { struct Job<T> { page: T, last: T } }
    ///
    /// let idle = Stream::of(0u64, Job { page: 0, last: 0 });
    /// let last = Stream::of(1, Job { last: 1, ..idle.payload });
    /// assert_eq!((last.valid, last.last, last.ready), (1, 1, 0));
    /// ```
    pub fn of(valid: T, payload: P) -> Stream<P, T> {
        Stream { valid, ready: T::default(), payload }
    }
}

/// The width of a stream's port; the payload is a signal of this width or a record of widths: `stream(8)`,
/// `stream(Job { page: below(12), last: bit() })`.
///
/// ```
/// # use tilewright_hdl::*;
/// bundle! { struct Job<T> { page: T, last: T } }
///
/// let jobs = stream(Job { page: below(12), last: bit() });
/// assert_eq!((jobs.valid.bits(), jobs.ready.bits(), jobs.page.bits()), (1, 1, 4));
/// assert_eq!(stream(8).leaves()[2].0, "payload");
/// ```
#[track_caller]
pub fn stream<L: Layout>(payload: L) -> Stream<<L::Value as Data>::Like<Width>, Width> {
    Stream { valid: bit(), ready: bit(), payload: payload.layout() }
}

impl<P: Fields<Width, With<Width> = P>> Stream<P, Width> {
    /// The same stream, all of it synchronous to `clock`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # const HOST: Clock = Clock::new("host", Period::ns(30));
    /// type Bytes<T> = Stream<T, T>;
    ///
    /// block! {
    ///     struct Sink;
    ///     in SinkIn { bytes: Bytes = stream(8).on(HOST) }
    ///     out SinkOut { last: bits(8) }
    /// }
    ///
    /// impl Sink {
    ///     fn build(&self, m: Module, i: SinkIn) -> SinkOut {
    ///         let bytes = i.bytes.take_when(1);
    ///         let last = m.on(HOST).reg("last_byte", 8).reset(0);
    ///         last.when(bytes.taken, *bytes);
    ///         SinkOut { last: *last }
    ///     }
    /// }
    ///
    /// elaborate(&Sink)?;
    /// # Ok::<(), Problems>(())
    /// ```
    pub fn on(self, clock: Clock) -> Self {
        self.map(|width| width.on(clock))
    }
}

impl<T: Leaf, P: Fields<T>> Fields<T> for Stream<P, T> {
    type With<U: Leaf> = Stream<P::With<U>, U>;

    fn documentation(path: &str, said: &str, f: &mut dyn FnMut(&str, &str)) {
        P::documentation(path, said, f);
    }

    fn map_fields<U: Leaf>(&self, path: &str, f: &mut dyn FnMut(&str, &T) -> U) -> Self::With<U> {
        let valid = f(&join(path, "valid"), &self.valid);
        let ready = f(&join(path, "ready"), &self.ready);
        // A payload that is a leaf has no name of its own.
        let payload = self.payload.map_fields(path, &mut |field, leaf| match field == path {
            true => f(&join(path, "payload"), leaf),
            false => f(field, leaf),
        });
        Stream { valid, ready, payload }
    }

    fn map_leaves<U: Leaf>(&self, f: &mut impl FnMut(&T) -> U) -> Self::With<U> {
        let (valid, ready) = (f(&self.valid), f(&self.ready));
        Stream { valid, ready, payload: self.payload.map_leaves(f) }
    }

    fn visit(&self, f: &mut impl FnMut(Visited<T>)) {
        f(Visited::Leaf(&self.valid));
        f(Visited::Back(&self.ready));
        self.payload.visit(f);
    }
}

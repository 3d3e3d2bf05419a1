//! Streams: untaken ones, streams taken twice, and signals that are no streams.

use crate::messages::common::*;
use tilewright_hdl::*;

bundle! {
    pub struct Job<T> { pub page: T, pub last: T }
    pub struct JobsIn<T> { pub jobs: Stream<Job<T>, T>, pub go: T }
    pub struct JobsOut<T> { pub found: Stream<T, T>, pub copy: Vec<Stream<T, T>> }
}

/// Describes the outputs of a [`Streams`].
type BuildStreams = fn(Module, JobsIn) -> JobsOut;

/// A block of one stream in, described by a function.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
struct Streams(BuildStreams);

impl std::fmt::Debug for Streams {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Streams {{ at: {} }}", self.0 as usize)
    }
}

impl Block for Streams {
    type In = JobsIn;
    type Out = JobsOut;

    fn inputs(&self) -> JobsIn<Width> {
        JobsIn { jobs: stream(Job { page: bits(8), last: bit() }), go: bit() }
    }

    fn build(&self, m: Module, i: JobsIn) -> JobsOut {
        m.ignore(&i);
        (self.0)(m, i)
    }

    fn name(&self) -> String {
        "streams".to_owned()
    }
}

#[track_caller]
fn expect(build: BuildStreams, expected: &str) {
    let lines: Vec<_> = expected.lines().map(str::trim_start).collect();
    let found = problems(&Streams(build));
    let found: Vec<_> = found.lines().map(str::trim_start).collect();
    assert_eq!(found.join("\n"), lines.join("\n").trim());
}

#[test]
fn a_stream_that_comes_in_and_is_never_taken() {
    expect(
        |m, i| JobsOut { found: m.offer(i.go, i.jobs.page).0, copy: vec![] },
        "stream `jobs` in `Streams` is never taken [T701]
         --> [JobsIn { jobs: stream(Job { page: bits(8), last: bit() }), go: bit() }]
         help: take it with `.take_when(condition)`, feed an instance with it, or return it among the outputs",
    );
}

#[test]
fn a_stream_that_is_offered_to_nobody() {
    expect(
        |m, i| {
            let (lost, _) = m.offer(i.go, i.jobs.payload);
            let _ = lost;
            JobsOut { found: i.jobs.with(i.jobs.page), copy: vec![] }
        },
        "a stream that is offered in `Streams` is never taken [T701]
         --> [let (lost, _) = m.offer(i.go, i.jobs.payload);]
         help: return it among the outputs, or feed an instance with it",
    );
}

#[test]
fn streams_of_instances_that_nobody_takes() {
    expect(
        |m, i| {
            let u = m.instance("u_pass", &Pass, Passed { x: i.jobs.with(i.jobs.page) });
            JobsOut { found: m.offer(i.go, u.y.payload).0, copy: vec![] }
        },
        "stream `y` of `u_pass` in `Streams` is never taken [T701]
         --> [let u = m.instance(\"u_pass\", &Pass, Passed { x: i.jobs.with(i.jobs.page) });]
         help: take it with `.take_when(condition)`, feed an instance with it, or return it among the outputs",
    );
}

#[test]
fn streams_that_are_taken_twice() {
    expect(
        |m, i| {
            i.jobs.take_when(1);
            let jobs = i.jobs.take_when(i.go);
            JobsOut { found: m.offer(i.go, jobs.page).0, copy: vec![] }
        },
        "stream `jobs` is taken twice [T702]
         --> [let jobs = i.jobs.take_when(i.go);]
         the first time is at [i.jobs.take_when(1);]
         stream `jobs` is declared at [JobsIn { jobs: stream(Job { page: bits(8), last: bit() }), go: bit() }]
         help: a stream has one receiver: a fork makes two of it",
    );
    expect(
        |m, i| {
            let page = i.jobs.with(i.jobs.page);
            let u = m.instance("u_pass", &Pass, Passed { x: page });
            let _ = m.instance("u_twice", &Pass, Passed { x: page }).y.take_when(i.go);
            JobsOut { found: u.y, copy: vec![] }
        },
        "stream `jobs` is taken twice [T702]
         --> [let _ = m.instance(\"u_twice\", &Pass, Passed { x: page }).y.take_when(i.go);]
         the first time is at [let u = m.instance(\"u_pass\", &Pass, Passed { x: page });]
         stream `jobs` is declared at [JobsIn { jobs: stream(Job { page: bits(8), last: bit() }), go: bit() }]
         help: a stream has one receiver: a fork makes two of it",
    );
}

#[test]
fn streams_that_are_returned_twice() {
    expect(
        |m, i| {
            let jobs = i.jobs.take_when(i.go);
            let (found, _) = m.offer(jobs.valid, jobs.page);
            JobsOut { found, copy: vec![found] }
        },
        "a stream that is offered is taken twice [T702]
         --> [let (found, _) = m.offer(jobs.valid, jobs.page);]
         help: a stream has one receiver: a fork makes two of it",
    );
}

#[test]
fn what_is_no_stream() {
    expect(
        |_, i| {
            let jobs = i.jobs.take_when(i.go);
            let made = Stream { valid: jobs.valid, ready: i.go, payload: jobs.page };
            JobsOut { found: made, copy: vec![] }
        },
        "`go` is used as the `ready` of a stream, but is not one [T703]
         --> [JobsIn { jobs: stream(Job { page: bits(8), last: bit() }), go: bit() }]
         help: a stream is an input, an output of an instance, or made by `m.offer`; registers and memories store its payload",
    );
}

#[test]
fn conditions_and_lanes_of_streams() {
    expect(
        |m, i| {
            let jobs = i.jobs.take_when(i.jobs.page);
            JobsOut { found: m.offer(i.jobs.page, jobs.page).0, copy: vec![] }
        },
        "the condition of `take_when` is 1 bit, but `jobs_page` has 8 bits [T106]
         --> [let jobs = i.jobs.take_when(i.jobs.page);]
         `jobs_page` is made at [JobsIn { jobs: stream(Job { page: bits(8), last: bit() }), go: bit() }]
         help: compare it, as in `.ne(0)`, or take one `.bit(i)`

         the condition of `offer` is 1 bit, but `jobs_page` has 8 bits [T106]
         --> [JobsOut { found: m.offer(i.jobs.page, jobs.page).0, copy: vec![] }]
         `jobs_page` is made at [JobsIn { jobs: stream(Job { page: bits(8), last: bit() }), go: bit() }]
         help: compare it, as in `.ne(0)`, or take one `.bit(i)`

         2 problems in this description",
    );
    expect(
        |m, i| {
            let cells = m.array("u_cell", 2, &Pass, |_| Passed { x: i.jobs.with(i.jobs.page) });
            let page = cells.y.take_when(i.go).lane(0);
            JobsOut { found: m.offer(i.go, page).0, copy: vec![] }
        },
        "stream `jobs` has no lanes, but is taken by 2 lanes [T705]
         --> [let cells = m.array(\"u_cell\", 2, &Pass, |_| Passed { x: i.jobs.with(i.jobs.page) });]
         stream `jobs` is declared at [JobsIn { jobs: stream(Job { page: bits(8), last: bit() }), go: bit() }]
         help: a stream has one receiver: give each lane a stream of its own",
    );
}

#[test]
fn a_sender_that_waits_for_its_receiver() {
    expect(
        |m, i| {
            let jobs = i.jobs.take_when(1);
            let answer = m.wire("answer", bit());
            let (found, _) = m.offer(jobs.valid & answer, jobs.page);
            answer.drive(found.ready);
            JobsOut { found, copy: vec![] }
        },
        "stream `found` of `Streams` waits for its receiver: its `valid` follows from its `ready` [T704]
         --> [let (found, _) = m.offer(jobs.valid & answer, jobs.page);]
         help: offer the payload in any case, and let `sent` tell whether it is taken: the receiver may wait for `valid`",
    );
}

bundle! {
    struct Passed<T> { x: Stream<T, T> }
    struct PassedOn<T> { y: Stream<T, T>, taken: T }
}

/// Passes its stream on unchanged.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Pass;

impl Block for Pass {
    type In = Passed;
    type Out = PassedOn;

    fn inputs(&self) -> Passed<Width> {
        Passed { x: stream(8) }
    }

    fn build(&self, m: Module, i: Passed) -> PassedOn {
        let x = i.x.take_when(1);
        let held = m.pipe("held", *x);
        PassedOn { y: m.offer(x.valid, held).0, taken: x.taken }
    }
}

#[test]
fn stream_wires_that_are_not_driven_once() {
    expect(
        |m, i| {
            let back = m.stream_wire("back", 8);
            JobsOut { found: m.offer(i.go, i.jobs.page).0, copy: vec![*back, i.jobs.with(i.jobs.page)] }
        },
        "wire `back_valid` of `Streams` is never driven [T301]
         --> [let back = m.stream_wire(\"back\", 8);]
         help: drive it with `.drive(value)`

         wire `back_payload` of `Streams` is never driven [T301]
         --> [let back = m.stream_wire(\"back\", 8);]
         help: drive it with `.drive(value)`

         2 problems in this description",
    );
    expect(
        |m, i| {
            let back = m.stream_wire("back", 8);
            back.drive(i.jobs.with(i.jobs.page));
            JobsOut { found: m.offer(i.go, i.jobs.page).0, copy: vec![] }
        },
        "a stream that is offered in `Streams` is never taken [T701]
         --> [let back = m.stream_wire(\"back\", 8);]
         help: return it among the outputs, or feed an instance with it",
    );
    expect(
        |m, i| {
            let back = m.stream_wire("back", 8);
            back.drive(i.jobs.with(i.jobs.page));
            back.drive(m.offer(i.go, i.jobs.page).0);
            JobsOut { found: *back, copy: vec![] }
        },
        "`back_valid` is driven twice [T302]
         --> [back.drive(m.offer(i.go, i.jobs.page).0);]
         the first time is at [back.drive(i.jobs.with(i.jobs.page));]
         `back_valid` is declared at [let back = m.stream_wire(\"back\", 8);]
         help: choose between the two with `mux` or `select`

         `back_payload` is driven twice [T302]
         --> [back.drive(m.offer(i.go, i.jobs.page).0);]
         the first time is at [back.drive(i.jobs.with(i.jobs.page));]
         `back_payload` is declared at [let back = m.stream_wire(\"back\", 8);]
         help: choose between the two with `mux` or `select`

         2 problems in this description",
    );
}

#[test]
fn lanes_of_streams() {
    expect(
        |m, i| {
            let page = i.jobs.with(i.jobs.page);
            let cells = m.array("u_cell", 2, &Pass, |_| Passed { x: stack([page, page]) });
            JobsOut { found: m.offer(i.go, i.jobs.page).0, copy: cells.y.lanes() }
        },
        "stream `jobs` is taken twice [T702]
         --> [let cells = m.array(\"u_cell\", 2, &Pass, |_| Passed { x: stack([page, page]) });]
         stream `jobs` is declared at [JobsIn { jobs: stream(Job { page: bits(8), last: bit() }), go: bit() }]
         help: a stream has one receiver: a fork makes two of it",
    );
    expect(
        |m, i| {
            let offered = m.offer(i.go, i.jobs.page).0;
            let x = stack([i.jobs.with(i.jobs.page), offered]);
            let cells = m.array("u_cell", 2, &Pass, |_| Passed { x });
            JobsOut { found: cells.y.lanes()[0], copy: vec![] }
        },
        "stream `y[1]` of `u_cell` in `Streams` is never taken [T701]
         --> [JobsOut { found: cells.y.lanes()[0], copy: vec![] }]
         help: take it with `.take_when(condition)`, feed an instance with it, or return it among the outputs",
    );
    expect(
        |m, i| {
            let x = stack([i.jobs.with(i.jobs.page), m.offer(i.go, i.jobs.page).0]);
            JobsOut { found: m.offer(i.go, x.payload.lane(1)).0, copy: vec![] }
        },
        "a stream that is offered in `Streams` is never taken [T701]
         --> [let x = stack([i.jobs.with(i.jobs.page), m.offer(i.go, i.jobs.page).0]);]
         help: return it among the outputs, or feed an instance with it",
    );
    expect(
        |_, i| {
            let lanes = i.jobs.with(i.jobs.page).lanes();
            JobsOut { found: lanes[0], copy: vec![] }
        },
        "`.lanes` needs a row, but `jobs_valid` has no lanes [T602]
         --> [let lanes = i.jobs.with(i.jobs.page).lanes();]
         `jobs_valid` is made at [JobsIn { jobs: stream(Job { page: bits(8), last: bit() }), go: bit() }]
         help: lanes come from a register, a port or a wire that is declared with some, as in `bits(8).of(row(4))`, or from `stack`",
    );
}

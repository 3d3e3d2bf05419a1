//! Mistakes with the methods of `StreamBlocks` are reported at the line that makes them.

use tilewright_blocks::*;
use tilewright_hdl::*;

bundle! {
    struct TwoIn<T> { narrow: Stream<T, T>, wide: Stream<T, T> }
}

/// Describes the one output of a [`Case`].
type Build = fn(Module, TwoIn) -> Stream;

/// A block of two streams, described by a function.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "building a block twice for one function does no harm")]
struct Case(Build);

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Case")
    }
}

impl Block for Case {
    type In = TwoIn;
    type Out = StreamOut;

    fn inputs(&self) -> TwoIn<Width> {
        TwoIn { narrow: stream(7), wide: stream(8) }
    }

    fn build(&self, m: Module, i: TwoIn) -> StreamOut {
        m.ignore(&i);
        StreamOut { out: (self.0)(m, i) }
    }
}

/// Compares the first problem with a message, and the line at its place with `at`.
#[track_caller]
fn expect(build: Build, message: &str, at: &str) {
    let text = elaborate(&Case(build)).expect_err("the description is wrong").to_string();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(message), "{text}");
    let place = lines.next().unwrap();
    let number = place.split(':').nth(1).and_then(|number| number.parse::<usize>().ok());
    assert!(place.contains("blocks/tests/messages.rs"), "{text}");
    assert_eq!(include_str!("messages.rs").lines().nth(number.unwrap() - 1).map(str::trim), Some(at), "{text}");
}

#[test]
fn streams_of_several_widths_at_one_arbiter() {
    expect(
        |m, i| {
            m.arbiter("u_arbiter", Turns::RoundRobin, [i.narrow, i.wide]) //
        },
        "input `into_1_payload` of `u_arbiter` has 7 bits, but `wide_payload` has 8 bits [T503]",
        "m.arbiter(\"u_arbiter\", Turns::RoundRobin, [i.narrow, i.wide]) //",
    );
}

#[test]
fn a_branch_of_a_fork_that_nobody_takes() {
    expect(
        |m, i| {
            i.wide.take_when(1);
            let [out, _] = m.fork("u_fork", i.narrow);
            out
        },
        "stream `out_1` of `u_fork` in `Case` is never taken [T701]",
        "let [out, _] = m.fork(\"u_fork\", i.narrow);",
    );
}

#[test]
fn words_that_do_not_divide_into_parts() {
    expect(
        |m, i| {
            i.wide.take_when(1);
            m.narrow("u_narrow", 2, i.narrow) //
        },
        "input `into_payload` of `u_narrow` has 6 bits, but `narrow_payload` has 7 bits [T503]",
        "m.narrow(\"u_narrow\", 2, i.narrow) //",
    );
}

#[test]
fn a_stream_in_two_places() {
    expect(
        |m, i| {
            let queued = m.fifo("u_fifo", 4, i.wide);
            i.narrow.take_when(1);
            m.join(queued, i.wide, |left, right| left ^ right) //
        },
        "stream `wide` is taken twice [T702]",
        "m.join(queued, i.wide, |left, right| left ^ right) //",
    );
}

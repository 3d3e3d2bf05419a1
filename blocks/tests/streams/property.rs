//! The one property of all blocks of streams, under any stalls: a word once shown stays until it is taken, no `valid`
//! waits for a `ready`, and the paths documented as cut are cut. The words received are returned for comparison.

use tilewright_hdl::{Bundle, Clock, Stream};
use tilewright_sim::{Pauses, Port, Simulation, Testbench, monitor};

/// A stream of the block, and its clock if the block has several.
#[derive(Clone, Copy)]
pub struct End {
    stream: Stream<Port, Port>,
    clock: Option<Clock>,
}

impl End {
    pub fn of(stream: Stream<Port, Port>) -> End {
        End { stream, clock: None }
    }

    pub fn on(stream: Stream<Port, Port>, clock: Clock) -> End {
        End { stream, clock: Some(clock) }
    }
}

/// How often both sides pause, in percent of the clocks, and the seed of the pauses.
#[derive(Debug, Clone, Copy)]
pub struct Stalls {
    pub senders: u64,
    pub receivers: u64,
    pub seed: u64,
}

/// The combinational paths that the block excludes, besides those from a `ready` to a `valid`, which no block has.
#[derive(Debug, Clone, Copy)]
pub struct Cuts {
    /// From the input words to the output words.
    pub forward: bool,
    /// From the receivers' `ready` to that for the senders.
    pub backward: bool,
}

pub const NONE: Cuts = Cuts { forward: false, backward: false };
pub const FORWARD: Cuts = Cuts { forward: true, backward: false };
pub const BACKWARD: Cuts = Cuts { forward: false, backward: true };
pub const BOTH: Cuts = Cuts { forward: true, backward: true };

/// Sends each sender's words through the block, which has been reset, and returns the words that each receiver took.
/// Each receiver takes as many words as `counts` says, and no more words may come after that.
///
/// # Panics
///
/// The block violates the stream protocol, or is stuck.
pub fn through<I: Bundle, O: Bundle>(
    sim: &mut Simulation<I, O>,
    (into, out): (&[End], &[End]),
    words: &[Vec<u64>],
    counts: &[usize],
    stalls: Stalls,
    cuts: Cuts,
) -> Vec<Vec<u64>> {
    let t = sim.testbench();
    t.limit(4_000 + 400 * words.iter().map(Vec::len).sum::<usize>() as u64);
    let of = |end: &End| end.clock.map_or(t.clone(), |clock| t.on(clock));
    let (from, to): (Vec<_>, Vec<_>) = (into.iter().map(of).collect(), out.iter().map(of).collect());
    let mut seeds = stalls.seed..;
    let mut pauses = |percent| Pauses::percent(percent, seeds.next().expect("endless"));

    let senders = from.iter().zip(into).zip(words);
    let senders = senders.map(|((t, end), words)| t.send_all(end.stream, words.clone(), pauses(stalls.senders)));
    let senders = t.all(senders.collect::<Vec<_>>());
    let receivers = to.iter().zip(out).zip(counts).map(|((t, end), &count)| {
        let pauses = pauses(stalls.receivers);
        async move {
            let words = t.receive_all(end.stream, count, pauses).await;
            t.expect_silence(end.stream, 60).await;
            words
        }
    });
    let receivers = t.all(receivers.collect::<Vec<_>>());
    let holds = t.all(to.iter().zip(out).map(|(t, end)| t.holds(end.stream)));
    t.run((senders, receivers, monitor(holds), monitor(has_no_path(&t, into, out, cuts)))).1
}

/// Checks at every instant that an output without a path from an input does not change when that input is inverted.
async fn has_no_path(t: &Testbench<'_>, into: &[End], out: &[End], cuts: Cuts) {
    let shown = || out.iter().map(|end| t.shown(&end.stream)).collect::<Vec<_>>();
    let accepted = || into.iter().map(|end| t.get_u64(end.stream.ready)).collect::<Vec<_>>();
    loop {
        t.step().await;
        let (shows, accepts) = (shown(), accepted());
        for (k, End { stream, .. }) in out.iter().enumerate() {
            t.suppose(stream.ready, 1 - t.get_u64(stream.ready), || {
                assert_eq!(shown(), shows, "an output waits for `ready` of output {k}");
                if cuts.backward {
                    assert_eq!(accepted(), accepts, "a path from `ready` of output {k} to that of an input");
                }
            });
        }
        for (k, End { stream, .. }) in into.iter().enumerate().filter(|_| cuts.forward) {
            let other = 1 - t.get_u64(stream.valid);
            t.suppose(stream.valid, other, || {
                t.suppose(stream.payload, 1, || assert_eq!(shown(), shows, "a path from input {k} to an output"));
            });
        }
    }
}

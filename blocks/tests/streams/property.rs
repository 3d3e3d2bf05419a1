//! The one property of all blocks of streams: whatever stalls there are, a word that is shown stays until it is taken, no `valid` waits for
//! a `ready`, and what the page of the block says is cut is cut. What went through is given back, to be compared with what should have.

use tilewright_hdl::{Bundle, Stream};
use tilewright_sim::{Port, Simulation};

/// A stream of the block, and its clock if the block has several.
#[derive(Clone, Copy)]
pub struct End {
    stream: Stream<Port, Port>,
    clock: Option<&'static str>,
}

impl End {
    pub fn of(stream: Stream<Port, Port>) -> End {
        End { stream, clock: None }
    }

    pub fn on(stream: Stream<Port, Port>, clock: &'static str) -> End {
        End { stream, clock: Some(clock) }
    }
}

/// How often both sides pause, in percent of the clocks, and what draws them.
#[derive(Debug, Clone, Copy)]
pub struct Stalls {
    pub senders: u64,
    pub receivers: u64,
    pub seed: u64,
}

/// The paths within a clock that the block says it does not have, besides those from a `ready` to a `valid`, which none has.
#[derive(Debug, Clone, Copy)]
pub struct Cuts {
    /// From what comes in to what goes out.
    pub forward: bool,
    /// From the receivers' `ready` to that for the senders.
    pub backward: bool,
}

pub const NONE: Cuts = Cuts { forward: false, backward: false };
pub const FORWARD: Cuts = Cuts { forward: true, backward: false };
pub const BACKWARD: Cuts = Cuts { forward: false, backward: true };
pub const BOTH: Cuts = Cuts { forward: true, backward: true };

/// Draws numbers (xorshift).
struct Chance(u64);

impl Chance {
    fn percent(&mut self, percent: u64) -> bool {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % 100 < percent
    }
}

/// What a sender does in a clock.
#[derive(Clone, Copy)]
struct Sender {
    /// How many of its words were taken.
    taken: usize,
    shows: bool,
}

/// Sends each sender's words through the block, which has been reset, and gives what each receiver took.
///
/// # Panics
///
/// The block does what no stream may, or is stuck.
#[track_caller]
pub fn through<I: Bundle, O: Bundle>(
    sim: &mut Simulation<I, O>,
    (into, out): (&[End], &[End]),
    words: &[Vec<u64>],
    stalls: Stalls,
    cuts: Cuts,
) -> Vec<Vec<u64>> {
    let mut chance = Chance(stalls.seed | 1);
    let mut senders = vec![Sender { taken: 0, shows: false }; into.len()];
    let mut ready = vec![false; out.len()];
    let mut shown: Vec<Option<u64>> = vec![None; out.len()];
    let mut received = vec![Vec::new(); out.len()];
    let mut ticked = vec![true; into.len() + out.len()];
    let count: usize = words.iter().map(Vec::len).sum();
    let (mut idle, mut instants) = (0, 0);
    while idle < 60 {
        instants += 1;
        assert!(instants < 4_000 + 400 * count, "it is stuck: {received:?} of {words:?}");

        // What both sides do changes after an edge of their clock.
        for (k, sender) in senders.iter_mut().enumerate().filter(|(k, _)| ticked[*k]) {
            sender.shows |= sender.taken < words[k].len() && !chance.percent(stalls.senders);
            drive(sim, into[k], sender.shows, words[k].get(sender.taken).copied());
        }
        for (k, ready) in ready.iter_mut().enumerate().filter(|(k, _)| ticked[into.len() + *k]) {
            *ready = !chance.percent(stalls.receivers);
            sim.set(out[k].stream.ready, *ready);
        }

        let now: Vec<Option<u64>> = out.iter().map(|end| shows(sim, end)).collect();
        for (k, (before, now)) in shown.iter().zip(&now).enumerate() {
            assert!(before.is_none() || before == now, "output {k} takes back {before:?} and shows {now:?}");
        }
        check_paths(sim, (into, out), (&senders, &ready), words, &now, cuts);

        let taken: Vec<bool> = into.iter().map(|end| sim.get_u64(end.stream.ready) == 1).collect();
        let before = ticks(sim, into, out);
        sim.step();
        ticked = ticks(sim, into, out).iter().zip(before).map(|(now, before)| *now != before).collect();
        for (k, sender) in senders.iter_mut().enumerate().filter(|(k, _)| ticked[*k]) {
            if sender.shows && taken[k] {
                *sender = Sender { taken: sender.taken + 1, shows: false };
            }
        }
        for (k, word) in now.iter().enumerate() {
            let goes = ticked[into.len() + k] && ready[k];
            shown[k] = word.filter(|_| !goes);
            received[k].extend(word.filter(|_| goes));
        }
        let all_sent = senders.iter().zip(words).all(|(sender, words)| sender.taken == words.len());
        idle = if all_sent && now.iter().all(Option::is_none) { idle + 1 } else { 0 };
    }
    received
}

fn drive<I: Bundle, O: Bundle>(sim: &mut Simulation<I, O>, end: End, valid: bool, word: Option<u64>) {
    sim.set(end.stream.valid, valid);
    sim.set(end.stream.payload, if valid { word.unwrap_or(0) } else { 0 });
}

/// The word that goes out there, if one does.
fn shows<I: Bundle, O: Bundle>(sim: &mut Simulation<I, O>, end: &End) -> Option<u64> {
    (sim.get_u64(end.stream.valid) == 1).then(|| sim.get_u64(end.stream.payload))
}

/// How often the clock of each end has risen.
fn ticks<I: Bundle, O: Bundle>(sim: &Simulation<I, O>, into: &[End], out: &[End]) -> Vec<u64> {
    let ends = into.iter().chain(out);
    ends.map(|end| end.clock.map_or(sim.time(), |clock| sim.cycles(clock).unwrap())).collect()
}

/// Turns each input over, within the clock, and looks at what must not follow.
#[track_caller]
fn check_paths<I: Bundle, O: Bundle>(
    sim: &mut Simulation<I, O>,
    (into, out): (&[End], &[End]),
    (senders, ready): (&[Sender], &[bool]),
    words: &[Vec<u64>],
    now: &[Option<u64>],
    cuts: Cuts,
) {
    let answers: Vec<u64> = into.iter().map(|end| sim.get_u64(end.stream.ready)).collect();
    for (k, end) in out.iter().enumerate() {
        sim.set(end.stream.ready, !ready[k]);
        for (other, word) in out.iter().zip(now) {
            assert_eq!(shows(sim, other), *word, "what goes out waits for `ready` of output {k}");
        }
        for (sender, answer) in into.iter().zip(&answers).filter(|_| cuts.backward) {
            assert_eq!(
                sim.get_u64(sender.stream.ready),
                *answer,
                "a path from `ready` of output {k} to that of an input"
            );
        }
        sim.set(end.stream.ready, ready[k]);
    }
    for (k, end) in into.iter().enumerate().filter(|_| cuts.forward) {
        drive(sim, *end, !senders[k].shows, Some(1));
        for (other, word) in out.iter().zip(now) {
            assert_eq!(shows(sim, other), *word, "a path from input {k} to an output");
        }
        drive(sim, *end, senders[k].shows, words[k].get(senders[k].taken).copied());
    }
}

//! Streams from block to block: through instances, lanes, other clocks, and as Verilog.

use tilewright_hdl::*;
use tilewright_sim::{Batch, Pauses, Simulation, monitor};

bundle! {
    struct Job<T> { page: T, last: T }
    struct JobsIn<T> { jobs: Stream<Job<T>, T> }
    struct JobsOut<T> { delayed: Stream<Job<T>, T> }
}

fn job() -> Job<Width> {
    Job { page: bits(4), last: bit() }
}

/// Stores one job.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Delay;

impl Block for Delay {
    type In = JobsIn;
    type Out = JobsOut;

    fn inputs(&self) -> JobsIn<Width> {
        JobsIn { jobs: stream(job()) }
    }

    fn build(&self, m: Module, i: JobsIn) -> JobsOut {
        let full = m.reg("full", bit()).reset(0);
        let held = m.reg("held", job());
        let (delayed, sent) = m.offer(full, *held);
        let jobs = i.jobs.take_when(!full | sent);
        held.when(jobs.taken, *jobs);
        full.when(jobs.taken, 1).when(sent, 0);
        JobsOut { delayed }
    }
}

/// Several delays in sequence.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Chain {
    length: u32,
}

impl Block for Chain {
    type In = JobsIn;
    type Out = JobsOut;

    fn inputs(&self) -> JobsIn<Width> {
        Delay.inputs()
    }

    fn build(&self, m: Module, i: JobsIn) -> JobsOut {
        let mut jobs = i.jobs;
        for place in 0..self.length {
            jobs = m.instance(&format!("u_delay{place}"), &Delay, JobsIn { jobs }).delayed;
        }
        JobsOut { delayed: jobs }
    }
}

/// Sends the pages through the block, with pauses on both sides, and expects them at the other end.
#[track_caller]
fn through<B: Block<In = JobsIn, Out = JobsOut>>(block: &B, pages: &[u64]) {
    let mut sim = Simulation::of(block).unwrap();
    sim.reset();
    let (jobs, delayed) = (sim.i.jobs, sim.o.delayed);
    let t = sim.testbench();
    let words = || pages.iter().map(|&page| Job { page, last: page & 1 });
    t.run((
        t.send_all(jobs, words(), Pauses::percent(30, 1)),
        t.expect_all(delayed, words(), Pauses::percent(60, 2)),
        monitor(t.holds(delayed)),
    ));
}

#[test]
fn nothing_is_lost_in_instances() {
    let pages = [3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8, 9, 7, 9];
    for length in 1..4 {
        through(&Chain { length }, &pages);
    }
}

#[test]
fn a_stream_that_is_passed_on_is_wires() {
    let mut sim = Simulation::of(&Chain { length: 0 }).unwrap();
    for (valid, page, ready) in [(0, 3, 1), (1, 4, 0), (1, 5, 1)] {
        sim.set(sim.i.jobs.valid, valid);
        sim.set(sim.i.jobs.page, page);
        sim.set(sim.o.delayed.ready, ready);
        let seen = [sim.o.delayed.valid, sim.o.delayed.page, sim.i.jobs.ready].map(|port| sim.get_u64(port));
        assert_eq!(seen, [valid, page, ready]);
    }
}

#[test]
fn verilog_has_the_ports_of_both_directions() {
    let files = tilewright_gen::verilog(&elaborate(&Chain { length: 2 }).unwrap());
    let text = &files.iter().find(|file| file.name == "chain_length2.v").unwrap().text;
    let squeezed = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for port in [
        "input wire jobs_valid",
        "input wire [3:0] jobs_page",
        "output wire jobs_ready",
        "output wire delayed_valid",
        "input wire delayed_ready",
        ".delayed_ready (delayed_ready)",
    ] {
        assert!(squeezed.contains(port), "{port} in\n{text}");
    }
    if let Err(problems) = tilewright_gen::tools::lint(&files) {
        panic!("{problems}");
    }
}

fn sent(valid: u64, page: u64) -> JobsIn<u64> {
    JobsIn { jobs: Stream::of(valid, Job { page, last: 0 }) }
}

fn seen(valid: u64, ready: u64, page: u64) -> JobsOut<u64> {
    JobsOut { delayed: Stream { valid, ready, payload: Job { page, last: 0 } } }
}

#[test]
fn testbenches_drive_streams() {
    let mut sim = Simulation::of(&Delay).unwrap();
    sim.reset();
    sim.drive(sent(1, 7));
    sim.step();
    sim.drive(sent(1, 8));
    assert_eq!((sim.read_u64(), sim.get_u64(sim.i.jobs.ready)), (seen(1, 0, 7), 0));
    sim.set(sim.o.delayed.ready, 1);
    assert_eq!((sim.read_u64(), sim.get_u64(sim.i.jobs.ready)), (seen(1, 1, 7), 1));

    let mut batch = Batch::of(&Delay, 2).unwrap();
    batch.reset();
    (0..2).for_each(|run: u32| batch.drive(run, sent(run.into(), 4)));
    batch.step();
    assert_eq!([batch.read_u64(0), batch.read_u64(1)], [seen(0, 0, 0), seen(1, 0, 4)]);
}

#[test]
fn scenarios_have_streams() {
    let mut script = Script::new(&Delay, DEFAULT_PERIOD);
    script.clock(&sent(1, 7));
    script.wait(1);
    let scenario = script.finish("a job comes");
    assert_eq!(scenario.events.iter().map(|event| &*event.input).collect::<Vec<_>>(), ["jobs_valid", "jobs_page"]);
    let mut sim = Simulation::of(&Delay).unwrap();
    sim.play(&scenario).unwrap();
    assert_eq!(sim.read_u64(), seen(1, 0, 7));
}

/// Delays side by side, each with its own streams.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Lanes;

impl Block for Lanes {
    type In = JobsIn;
    type Out = JobsOut;

    fn inputs(&self) -> JobsIn<Width> {
        JobsIn { jobs: stream(job()).map(|width| width.of(row(3))) }
    }

    fn build(&self, m: Module, i: JobsIn) -> JobsOut {
        JobsOut { delayed: m.array("u_delay", 3, &Delay, |_| JobsIn { jobs: i.jobs }).delayed }
    }
}

#[test]
fn lanes_have_streams_of_their_own() {
    let mut sim = Simulation::of(&Lanes).unwrap();
    sim.reset();
    sim.set_lanes(sim.i.jobs.valid, [1, 0, 1]);
    sim.set_lanes(sim.i.jobs.page, [5, 6, 7]);
    sim.set_lanes(sim.o.delayed.ready, [1, 1, 0]);
    sim.step();
    assert_eq!(sim.lanes(sim.o.delayed.valid), [1, 0, 1]);
    assert_eq!(sim.lanes(sim.o.delayed.page), [5, 0, 7]);
    assert_eq!(sim.lanes(sim.i.jobs.ready), [1, 1, 0]);
}

const FAST: Clock = Clock::new("fast", Period::ns(4));
const SLOW: Clock = Clock::new("slow", Period::ns(10));

/// Delays on two independent clocks.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct TwoClocks;

bundle! {
    struct TwoIn<T> { fast: Stream<Job<T>, T>, slow: Stream<Job<T>, T> }
    struct TwoOut<T> { quick: Stream<Job<T>, T>, late: Stream<Job<T>, T> }
}

impl Block for TwoClocks {
    type In = TwoIn;
    type Out = TwoOut;

    fn inputs(&self) -> TwoIn<Width> {
        TwoIn { fast: stream(job()).on(FAST), slow: stream(job()).on(SLOW) }
    }

    fn build(&self, m: Module, i: TwoIn) -> TwoOut {
        let quick = m.on(FAST).instance("u_fast", &Delay, JobsIn { jobs: i.fast }).delayed;
        let late = m.on(SLOW).instance("u_slow", &Delay, JobsIn { jobs: i.slow }).delayed;
        TwoOut { quick, late }
    }
}

#[test]
fn a_receiver_is_on_the_clock_of_its_sender() {
    let design = elaborate(&TwoClocks).unwrap();
    let clock = |name: &str| {
        let port = design.top().inputs.iter().find(|input| input.name == name).unwrap();
        design.top().clocks[port.clock.unwrap().0 as usize].name
    };
    assert_eq!((clock("quick_ready"), clock("late_ready")), (Some("fast"), Some("slow")));
}

/// Takes the stream of one clock on another.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Crossed;

impl Block for Crossed {
    type In = JobsIn;
    type Out = JobsOut;

    fn inputs(&self) -> JobsIn<Width> {
        JobsIn { jobs: stream(job()).on(FAST) }
    }

    fn build(&self, m: Module, i: JobsIn) -> JobsOut {
        m.on(SLOW).instance("u_slow", &Delay, JobsIn { jobs: i.jobs })
    }
}

#[test]
fn a_stream_does_not_cross_clocks_by_itself() {
    let problems = elaborate(&Crossed).expect_err("it crosses clocks").to_string();
    assert!(problems.starts_with("`jobs_valid` is on clock `fast` but reaches"), "{problems}");
}

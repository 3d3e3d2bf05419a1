//! The testbench interface: setting, reading, stepping, peeking, and every error.

use crate::circuits::engine::of;
use tilewright_hdl::{Bits, Module, ReadUnderWrite, bit, bits, block, bundle, codes, def, mux, when};
use tilewright_sim::{EngineKind, Error, Simulation};

block! {
    struct Counter { width: u32, limit: u64 }
    in CounterIn { enable: bit() }
    out CounterOut { count: _, wrapped: _ }
}

impl Counter {
    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        let count = m.reg("count", self.width).reset(0);
        def!(at_end = count.eq(self.limit - 1));
        count.enable(i.enable).next(mux(at_end, 0, count + 1));
        CounterOut { count: *count, wrapped: at_end & i.enable }
    }
}

const COUNTER: Counter = Counter { width: 4, limit: 3 };

#[test]
fn outputs_settle_and_registers_step() {
    let mut sim = of(&COUNTER);
    sim.set(sim.i.enable, 1);
    assert_eq!(sim.get(sim.o.count), 0);
    sim.run(2);
    assert_eq!(sim.read_u64(), CounterOut { count: 2, wrapped: 1 });
    sim.drive(CounterIn { enable: 0 });
    assert_eq!(sim.get_u64(sim.o.wrapped), 0);
    sim.step();
    assert_eq!(sim.get(sim.o.count), 2);
    sim.drive_bits(CounterIn { enable: Bits::new(1, 1) });
    sim.step();
    assert_eq!(sim.read(), CounterOut { count: Bits::new(4, 0), wrapped: Bits::new(1, 0) });
    assert_eq!((sim.time(), sim.cycles("clk")), (40_000, Ok(4)));
}

#[test]
fn a_run_of_no_cycles_does_nothing() {
    let mut sim = of(&COUNTER);
    sim.set(sim.i.enable, 1);
    for cycles in [0, 1, 4] {
        sim.run(cycles);
        let before = (sim.time(), sim.get_u64(sim.o.count));
        sim.run(0);
        assert_eq!((sim.time(), sim.get_u64(sim.o.count)), before);
    }
    assert_eq!(sim.cycles("clk"), Ok(5));
}

#[test]
fn a_stream_gives_the_outputs_of_every_cycle() {
    let mut sim = of(&COUNTER);
    let counts = sim.stream([1, 1, 0, 1].map(|enable| CounterIn { enable })).into_iter().map(|out| out.count);
    assert_eq!(counts.collect::<Vec<_>>(), [0, 1, 2, 2]);
}

#[test]
fn a_reset_returns_to_the_reset_values() {
    let mut sim = of(&COUNTER);
    sim.set(sim.i.enable, true);
    sim.step();
    sim.reset();
    assert_eq!(sim.get(sim.o.count), 0);
    sim.step();
    assert_eq!(sim.get(sim.o.count), 1);
}

#[test]
fn names_inside_can_be_read() {
    let mut sim = of(&COUNTER);
    assert_eq!(sim.peek("at_end").unwrap(), 0);
    sim.set(sim.i.enable, 1);
    sim.run(2);
    assert_eq!(sim.peek("at_end").unwrap(), 1);
    let error = sim.peek("at_ned").unwrap_err().to_string();
    assert_eq!(error, "there is no signal `at_ned`: did you mean `at_end`?");
    let error = sim.peek("u_core.count").unwrap_err().to_string();
    assert_eq!(error, "there is no signal `u_core`: there is none here");
    assert!(sim.port("enabel").unwrap_err().to_string().ends_with("did you mean `enable`?"));
    assert!(sim.cycles("slow").unwrap_err().to_string().contains("there is no clock `slow`: did you mean `clk`?"));
}

#[test]
#[should_panic(expected = "input `enable` has 1 bit and cannot hold 2")]
fn a_value_that_does_not_fit_is_refused() {
    let mut sim = of(&COUNTER);
    sim.set(sim.i.enable, 2);
}

#[test]
#[should_panic(expected = "`count` is an output and cannot be set")]
fn an_output_cannot_be_set() {
    let mut sim = of(&COUNTER);
    sim.set(sim.o.count, 2);
}

#[test]
fn mistakes_in_the_description_are_reported() {
    let error = Simulation::of(&Counter { width: 4, limit: 100 }).unwrap_err();
    assert!(matches!(error, Error::Description(_)), "{error}");
    assert!(error.to_string().contains("`99` does not fit in 4 bits"), "{error}");
}

bundle! {
    pub struct Request<T> { pub request: T }
    pub struct Answer<T> { pub answer: T }
}

block! {
    /// Combinational, and wider than an integer.
    struct Inverter;
    in = Request { request: bits(100) };
    out = Answer { answer: bits(100) };
}

impl Inverter {
    fn build(&self, _: Module, i: Request) -> Answer {
        Answer { answer: !i.request }
    }
}

#[test]
fn a_design_without_clocks_has_instants() {
    let mut sim = of(&Inverter);
    let (recorder, wave) = (sim.recording(), sim.record(["answer"]));
    sim.set(sim.i.request, Bits::ones(100));
    assert_eq!(sim.get(sim.o.answer), 0);
    sim.set(sim.i.request, -2);
    assert_eq!(sim.get(sim.o.answer), 1);
    sim.step();
    sim.reset();
    sim.set(sim.i.request, 7);
    sim.run_to(30_000);
    assert_eq!((sim.time(), recorder.take().steps.len()), (30_000, 3));
    wave.expect("answer | 1           | ffffffffffffffffffffffff8 |");
    let (i, o) = (sim.i, sim.o);
    let t = sim.testbench();
    let process = async {
        t.set(i.request, -4);
        t.step().await;
        assert_eq!(t.get(o.answer), 3);
    };
    t.run((process,));
}

#[test]
#[should_panic(expected = "is wider than 64 bits: use `get`")]
fn a_wide_port_is_not_cut_to_an_integer() {
    let mut sim = of(&Inverter);
    sim.get_u64(sim.o.answer);
}

codes! {
    enum Phase { Idle, Busy }
}

block! {
    /// Asserts that it is not started twice.
    struct Worker;
    in = Request { request: bit() };
    out = Answer { answer: bit() };
}

impl Worker {
    fn build(&self, m: Module, Request { request: start }: Request) -> Answer {
        let phase = m.fsm("phase", Phase::Idle);
        phase.next(|now| match now {
            Phase::Idle => when(start, Phase::Busy),
            Phase::Busy => tilewright_hdl::goto(Phase::Idle),
        });
        m.assert(!(phase.is(Phase::Busy) & start), "started while busy");
        Answer { answer: phase.is(Phase::Busy) }
    }
}

#[test]
fn a_failed_assertion_names_cycle_time_and_place() {
    let mut sim = of(&Worker);
    sim.set(sim.i.request, 1);
    sim.step();
    let Err(Error::Violated(violations)) = sim.try_step() else { panic!("the assertion holds") };
    let text = violations[0].to_string();
    let expected = "assertion failed in `worker` in cycle 1 of `clk`, at 20000 ps: started while busy\n  --> ";
    assert!(text.starts_with(expected) && text.contains("testbench.rs:"), "{text}");
    assert_eq!(sim.time(), 10_000, "the edge does not happen");
    assert_eq!(sim.peek("phase").unwrap(), 1);
    sim.set(sim.i.request, 0);
    sim.step();
    assert_eq!(sim.time(), 20_000);
}

#[test]
#[should_panic(expected = "started while busy")]
fn a_step_panics_if_an_assertion_fails() {
    let mut sim = of(&Worker);
    sim.set(sim.i.request, 1);
    sim.run(2);
}

#[test]
fn assertions_rest_while_the_reset_is_high() {
    let mut sim = of(&Worker);
    sim.set(sim.i.request, 1);
    sim.step();
    sim.reset();
    assert_eq!(sim.get(sim.o.answer), 0);
}

#[test]
fn a_wave_shows_clock_levels_buses_and_states() {
    let mut sim = of(&COUNTER);
    let wave = sim.record([sim.i.enable, sim.o.count, sim.o.wrapped]);
    for enable in [0, 1, 1, 1, 0, 0] {
        sim.set(sim.i.enable, enable);
        sim.step();
    }
    wave.expect(
        r"
        clk     |___/~\_/~\_/~\_/~\_/~\_/
        enable  |___/~~~~~~~~~~~\________
        count   | 0     | 1 | 2 | 0     |
        wrapped |___________/~~~\________",
    );

    let mut sim = of(&Worker);
    let wave = sim.record(["phase"]);
    for start in [1, 0, 0] {
        sim.set(sim.i.request, start);
        sim.step();
    }
    wave.expect(
        r"
        clk   |______/~~~\__/~~~\__/
        phase | Idle | Busy | Idle |",
    );
}

#[test]
#[should_panic(expected = "the wave differs.\nexpected:\nclk |____\nactual:\nclk |___/")]
fn a_wave_that_differs_is_shown() {
    let mut sim = of(&COUNTER);
    let wave = sim.record([""; 0]);
    sim.step();
    wave.expect("clk |____");
}

#[test]
fn a_recording_has_the_values_before_each_edge() {
    let mut sim = of(&COUNTER);
    let recording = sim.recording();
    for enable in [1, 0] {
        sim.set(sim.i.enable, enable);
        sim.step();
    }
    let recording = recording.take();
    let [first, second] = &recording.steps[..] else { panic!("two steps") };
    assert_eq!((first.time_ps, &first.rising[..], &first.resets[..]), (10_000, &[0][..], &[][..]));
    assert_eq!((&first.inputs[0], &first.outputs[0]), (&Bits::new(1, 1), &Bits::new(4, 0)));
    assert_eq!((&second.inputs[0], &second.outputs[0]), (&Bits::new(1, 0), &Bits::new(4, 1)));
}

block! {
    /// A memory with one port in each direction, with a policy.
    struct Store { policy: ReadUnderWrite }
    in StoreIn { write: bit(), to: bits(3), from: bits(3), data: bits(70) }
    out = Answer { answer: bits(70) };
}

impl Store {
    fn build(&self, m: Module, i: StoreIn) -> Answer {
        let store = m.memory("store", 6, 70, self.policy);
        store.write(i.write, i.to, i.data);
        Answer { answer: store.read(i.from) }
    }
}

/// The result of a read that collides with the write of 5 over `old`.
fn collision(policy: ReadUnderWrite) -> Bits {
    let mut sim = of(&Store { policy });
    sim.poke_memory("store", 2, 9).unwrap();
    sim.drive(StoreIn { write: 1, to: 2, from: 2, data: 5 });
    sim.step();
    assert_eq!(sim.peek_memory("store", 2).unwrap(), 5);
    sim.peek("store_read").unwrap()
}

#[test]
fn a_read_under_write_follows_the_policy() {
    assert_eq!(collision(ReadUnderWrite::Old), 9);
    assert_eq!(collision(ReadUnderWrite::Any), -10);
}

#[test]
fn addresses_beyond_the_depth_read_zero_and_write_nothing() {
    let mut sim = of(&Store { policy: ReadUnderWrite::Old }).seeded(7);
    let words = |sim: &Simulation<_, _>| -> Vec<Bits> {
        (0..6).map(|address| sim.peek_memory("store", address).unwrap()).collect()
    };
    let before = words(&sim);
    sim.drive(StoreIn { write: 1, to: 7, from: 3, data: 5 });
    sim.step();
    assert_ne!(sim.get(sim.o.answer), 0, "the seed fills memories");
    assert_eq!(words(&sim), before);
    sim.drive(StoreIn { write: 0, to: 0, from: 7, data: 5 });
    sim.step();
    assert_eq!(sim.get(sim.o.answer), 0);
    let error = sim.peek_memory("stor", 0).unwrap_err().to_string();
    assert_eq!(error, "there is no memory `stor`: did you mean `store`?");
}

#[test]
#[should_panic(expected = "address 6 of memory `store`, which has 6 words")]
fn a_memory_has_no_word_beyond_its_depth() {
    let sim = of(&Store { policy: ReadUnderWrite::Old });
    let _ = sim.peek_memory("store", 6);
}

#[test]
fn equal_seeds_start_alike_and_others_do_not() {
    let start = |seed| {
        let sim = of(&Store { policy: ReadUnderWrite::Old }).seeded(seed);
        (0..6).map(|address| sim.peek_memory("store", address).unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(start(3), start(3));
    assert_ne!(start(3), start(4));
    assert!(start(0).iter().all(Bits::is_zero));
}

#[test]
fn a_run_in_one_piece_is_as_many_steps() {
    use EngineKind::{Both, Compiled, Interpreter, Reference, Tiered};
    for kind in [Reference, Interpreter, Compiled, Tiered, Both] {
        let mut pieces = Simulation::of(&Counter { width: 8, limit: 200 }).unwrap().on(kind);
        let mut whole = Simulation::of(&Counter { width: 8, limit: 200 }).unwrap().on(kind);
        for sim in [&mut pieces, &mut whole] {
            sim.set(sim.i.enable, 1);
        }
        (0..37).for_each(|_| pieces.step());
        whole.run(37);
        assert_eq!(pieces.get(pieces.o.count), whole.get(whole.o.count));
        assert_eq!((pieces.time(), pieces.cycles("clk").unwrap()), (whole.time(), whole.cycles("clk").unwrap()));
        assert_eq!(whole.get_u64(whole.o.count), 37);
    }
}

#[test]
fn without_generated_code_the_interpreter_runs_and_says_why() {
    let sim = Simulation::of(&COUNTER).unwrap();
    assert_eq!((sim.engine(), sim.fallback()), (EngineKind::Tiered, None));
    for chosen in [EngineKind::Compiled, EngineKind::Tiered, EngineKind::Both] {
        let mut sim = Simulation::of(&COUNTER).unwrap().on(chosen).without_code("it is a typewriter").seeded(3);
        assert_eq!((sim.engine(), sim.fallback()), (EngineKind::Interpreter, Some("it is a typewriter")));
        sim.set(sim.i.enable, 1);
        sim.run(2);
        assert_eq!(sim.get(sim.o.count), 2);
    }
    let sim = Simulation::of(&COUNTER).unwrap().without_code("it is a typewriter").on(EngineKind::Reference);
    assert_eq!((sim.engine(), sim.fallback()), (EngineKind::Reference, None));
}

//! Waves and recordings of a part of a run, and the messages for mistakes in a testbench.

use tilewright_hdl::recording::Initial;
use tilewright_hdl::{Bits, Block, Module, ReadUnderWrite, Width, bit, bits, block, bundle, cat, codes, goto, stack};
use tilewright_sim::{Batch, Simulation, WaveRadix};

bundle! {
    pub struct SumIn<T> { pub add: Vec<T>, pub at: T }
    pub struct SumOut<T> { pub sum: T, pub word: T }
}

block! {
    /// Adds up, and looks up, in two memories that it never writes.
    struct Sum;
    in = SumIn { add: vec![bits(8), bits(8)], at: bits(3) };
    out = SumOut { sum: bits(8), word: bits(8) };
}

impl Sum {
    fn build(&self, m: Module, i: SumIn) -> SumOut {
        let sum = m.reg("sum", 8).reset(0);
        sum.next(sum + i.add[0] + i.add[1]);
        let store = m.memory("store", 8, 8, ReadUnderWrite::Old);
        SumOut { sum: *sum, word: store.read(i.at) }
    }
}

fn sum() -> Simulation<SumIn, SumOut> {
    Simulation::of(&Sum).unwrap()
}

#[test]
#[should_panic(expected = "input `add` is a list of 2, but is set to a list of 1")]
fn a_shorter_list_is_not_driven() {
    sum().drive(SumIn { add: vec![1], at: 0 });
}

#[test]
#[should_panic(expected = "input `add` is a list of 2, but is set to a list of 3")]
fn a_longer_list_is_not_driven() {
    sum().drive_bits(SumIn { add: vec![Bits::zero(8), Bits::zero(8), Bits::zero(3)], at: Bits::zero(3) });
}

#[test]
#[should_panic(expected = "input `add` is a list of 2, but is set to a list of 0")]
fn a_shorter_list_is_not_driven_into_a_batch() {
    Batch::of(&Sum, 2).unwrap().drive(1, SumIn { add: vec![], at: 0 });
}

#[test]
fn a_mistake_in_a_description_reads_well_where_main_ends_with_it() {
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Wrong;
    impl Block for Wrong {
        type In = SumIn;
        type Out = SumOut;
        fn inputs(&self) -> SumIn<Width> {
            SumIn { add: vec![bits(8)], at: bit() }
        }
        fn build(&self, _: Module, i: SumIn) -> SumOut {
            SumOut { sum: i.add[0] + i.at, word: i.at }
        }
    }
    let error = Simulation::of(&Wrong).unwrap_err();
    let text = format!("Error: {error:?}");
    assert!(
        text.starts_with("Error: \n`+` needs equal widths: `add_0` has 8 bits, `at` has 1 bit [T101]\n  --> "),
        "{text}"
    );
    let unknown = format!("{:?}", tilewright_sim::Error::from(sum().peek("some").unwrap_err()));
    assert_eq!(unknown, "there is no signal `some`: did you mean `sum`?");
}

#[test]
fn a_wave_of_some_cycles() {
    let mut sim = sum();
    let (late, by_time, stopped) =
        (sim.record(["sum"]).cycles("clk", 2..4), sim.record(["sum"]).times(15_000..35_000), sim.record(["sum"]));
    sim.drive(SumIn { add: vec![1, 2], at: 0 });
    sim.run(2);
    stopped.stop();
    sim.run(4);
    late.expect(
        "
        clk |~\\_/~\\_/
        sum | 6 | 9 |",
    );
    by_time.expect(
        "
        clk |~\\_/~\\_/~\\_/
        sum | 3 | 6 | 9 |",
    );
    stopped.expect(
        "
        clk |___/~\\_/
        sum | 0 | 3 |",
    );
}

#[test]
fn a_wave_in_decimal() {
    let mut sim = sum();
    let (plain, decimal) = (sim.record(["sum"]), sim.record(["sum"]).decimal());
    sim.drive(SumIn { add: vec![60, 39], at: 0 });
    sim.run(2);
    plain.expect(
        "
        clk |____/~~\\_/
        sum | 0  | 63 |",
    );
    decimal.expect(
        "
        clk |____/~~\\_/
        sum | 0  | 99 |",
    );
}

codes! { enum Phase { Idle, Run, Done } }

bundle! {
    pub struct Pixel<T> { pub z: T, pub rgb: T }
    pub struct StepIn<T> { pub z: T }
    pub struct StepOut<T> { pub phase: T, pub pixel: Pixel<T>, pub depth: T, pub lanes: T }
}

/// Goes through three phases with a pixel, and with a depth that becomes negative.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Step;

impl Block for Step {
    type In = StepIn;
    type Out = StepOut;

    fn inputs(&self) -> StepIn<Width> {
        StepIn { z: bits(8) }
    }

    fn build(&self, m: Module, i: StepIn) -> StepOut {
        let phase = m.fsm("phase", Phase::Idle);
        phase.next(|phase| match phase {
            Phase::Idle => goto(Phase::Run),
            Phase::Run | Phase::Done => goto(Phase::Done),
        });
        let pixel = m.reg("pixel", Pixel { z: bits(8), rgb: bits(24) }).reset(0);
        pixel.next(Pixel { z: i.z, rgb: cat![i.z, i.z, i.z] });
        let depth = m.reg("depth", bits(8).signed()).reset(10);
        depth.next(depth - 18);
        StepOut { phase: *phase, pixel: *pixel, depth: *depth, lanes: stack([i.z, i.z + 1]) }
    }
}

#[test]
fn a_wave_of_a_code_a_record_and_each_radix() {
    let mut sim = Simulation::of(&Step).unwrap();
    let o = &sim.o;
    let rows = [o.phase, o.pixel.z, o.pixel.rgb, o.depth];
    let wave = sim.record(rows).radix("pixel_z", WaveRadix::Decimal);
    let other = sim.record(["z", "depth"]).radix("depth", WaveRadix::Hexadecimal).radix("z", WaveRadix::Binary);
    let lanes = sim.record(["lanes[*]"]).radix("lanes", WaveRadix::Decimal);
    let all_lanes = sim.record(["lanes"]).radix("lanes", WaveRadix::Decimal);
    let all = sim.record(["phase", "z", "depth"]).radix_of_all(WaveRadix::Binary);
    sim.set(sim.i.z, 99);
    sim.run(3);
    wave.expect(
        "
        clk       |______/~~~\\__/~~~\\__/
        phase     | Idle | Run  | Done |
        pixel_z   | 0    | 99          |
        pixel_rgb | 0    | 636363      |
        depth     | 10   | -8   | -26  |",
    );
    other.expect(
        "
        clk   |_____/~~\\__/~~\\__/
        z     | 1100011         |
        depth | a   | -8  | -1a |",
    );
    for lanes in [lanes, all_lanes] {
        lanes.expect(
            "
            clk      |___/~\\_/~\\_/
            lanes[0] | 99        |
            lanes[1] | 100       |",
        );
    }
    all.expect(
        "
        clk   |________/~~~~\\___/~~~~\\___/
        phase | Idle   | Run    | Done   |
        z     | 1100011                  |
        depth | 1010   | -1000  | -11010 |",
    );
}

#[test]
#[should_panic(expected = "there is no row `squre`: did you mean `sum`?")]
fn a_radix_of_no_row() {
    let _ = sum().record(["sum"]).radix("squre", WaveRadix::Decimal);
}

#[test]
#[should_panic(expected = "there is no clock `clok`: did you mean `clk`?")]
fn a_wave_of_cycles_of_no_clock() {
    let _ = sum().record(["sum"]).cycles("clok", 2..4);
}

#[test]
fn a_recording_starts_from_what_was_poked() {
    let mut sim = sum();
    sim.poke_memory("store", 5, 0x55).unwrap();
    let recorder = sim.recording();
    [(1, 1), (6, 7), (6, 0x66)].into_iter().for_each(|(at, word)| sim.poke_memory("store", at, word).unwrap());
    sim.run(2);
    let recording = recorder.take();
    let word = |value| Bits::new(8, value);
    let initial = |address, words: &[Bits]| Initial { path: "store".to_owned(), address, words: words.to_vec() };
    assert_eq!(recording.initial, [initial(1, &[word(1)]), initial(5, &[word(0x55), word(0x66)])]);
    assert_eq!(recording.steps.len(), 2);
    // A new start does not report what it forgets.
    let mut again = sum();
    again.poke_memory("store", 5, 0x55).unwrap();
    let mut again = again.seeded(0);
    let recorder = again.recording();
    again.step();
    assert_eq!(recorder.take().initial, []);
}

#[test]
fn a_recording_of_a_run_starts_from_what_was_poked_there() {
    let mut batch = Batch::of(&Sum, 3).unwrap();
    let recorder = batch.recording(1);
    [(0, 1), (1, 2), (2, 3)].into_iter().for_each(|(run, at)| batch.poke_memory("store", run, at, 9).unwrap());
    batch.step();
    batch.poke_memory("store", 2, 0, 1).unwrap();
    let initial = recorder.take().initial;
    assert_eq!(initial.iter().map(|it| it.address).collect::<Vec<_>>(), [2]);
}

#[test]
#[should_panic(expected = "`store` is poked after the first step of a recording, which could not be repeated")]
fn a_recorded_memory_is_not_poked_later() {
    let mut sim = sum();
    let _recorder = sim.recording();
    sim.step();
    let _ = sim.poke_memory("store", 5, 1);
}

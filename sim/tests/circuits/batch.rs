//! Many runs at once: each is the same as a simulation of its own.

use std::fs;
use std::path::PathBuf;

use crate::circuits::store::Store;
use tilewright_hdl::{
    Bits, Block, Design, Module, ReadUnderWrite, bits, block, cat, codes, constants, elaborate, mux, stack, when,
};
use tilewright_sim::{Batch, EngineKind, Error, Port, Simulation, Vcd};

block! {
    /// A memory and a register of 12 bits, both without a known start.
    struct Cell;
    in CellIn { left: bits(12), own: bits(12) }
    out CellOut { value: _ }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let value = m.reg("value", 12);
        let store = m.memory("store", 5, 12, ReadUnderWrite::Any);
        store.write(i.left.bit(0), value.slice(0..3), i.left + i.own);
        let read = store.read(i.left.slice(0..3));
        value.next(mux(i.own.bit(1), value + i.left, read ^ i.own));
        CellOut { value: *value }
    }
}

codes! {
    enum Turn { Left, Right }
}

block! {
    /// An array with memories, a memory of its own, a value of 100 bits, a state machine, and state without a reset.
    struct Mixed;
    in MixedIn { x: bits(12), mix: bits(100), at: bits(3) }
    out MixedOut { sum: _, wide: _, word: _, scrambled: _ }
}

impl Mixed {
    fn build(&self, m: Module, i: MixedIn) -> MixedOut {
        let cells = m.array("u_cell", 3, &Cell, |a| CellIn {
            left: a.value.previous(i.x),
            own: constants(bits(12).of(3), |lane| u64::from(lane) + 2),
        });
        let wide = m.reg("wide", 100).reset(1);
        wide.next(wide + (i.mix ^ cat![wide.slice(0..50), wide.slice(50..100)]));
        let words = m.memory("words", 6, 9, ReadUnderWrite::Old);
        words.write(i.x.bit(3), i.at, i.x.slice(0..9));
        let turn = m.fsm("turn", Turn::Left);
        turn.next(|now| match now {
            Turn::Left => when(i.x.bit(1), Turn::Right),
            Turn::Right => when(i.x.bit(2), Turn::Left),
        });
        let scrambled = m.reg("scrambled", 33);
        scrambled.next(mux(turn.is(Turn::Left), scrambled + wide.slice(3..36), *scrambled));
        let word = words.read_async(i.at) ^ words.read(i.x.slice(4..7));
        MixedOut { sum: cells.value.sum(), wide: *wide, word, scrambled: *scrambled }
    }
}

block! {
    /// A sum that must stay below 100, in an instance.
    struct Limit { inside: bool }
    in LimitIn { add: bits(4) }
    out LimitOut { total: _ }
}

impl Limit {
    fn build(&self, m: Module, i: LimitIn) -> LimitOut {
        if self.inside {
            let total = m.reg("total", 8).reset(0);
            total.next(total + i.add.zext(8));
            m.assert(total.lt(100), "the sum is too large");
            return LimitOut { total: *total };
        }
        let limits = m.array("u_limit", 2, &Limit { inside: true }, |_| LimitIn { add: stack([i.add, i.add >> 1]) });
        LimitOut { total: limits.total.sum() }
    }
}

/// A stimulus: the same for a run, alone or in a batch.
fn random(run: u32, step: u32, port: u32) -> Bits {
    let mut z = u64::from(run) << 40 | u64::from(step) << 16 | u64::from(port);
    let mut draw = || {
        z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let y = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let y = (y ^ (y >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        y ^ (y >> 31)
    };
    Bits::from_limbs(128, &[draw(), draw()])
}

/// The inputs and outputs of a design: names and widths.
fn ports(design: &Design) -> (Vec<(String, u32)>, Vec<String>) {
    let top = design.top();
    let inputs = top.inputs.iter().map(|input| (input.name.clone(), top.width(input.node)));
    (inputs.collect(), top.outputs.iter().map(|output| output.name.clone()).collect())
}

const STEPS: u32 = 40;
/// Before which steps the reset of the first clock becomes active and is released.
const RESETS: [u32; 2] = [28, 31];

/// The outputs after every step of a run alone, on the reference engine, and its waveform.
fn alone(design: &Design, run: u32, file: PathBuf) -> (Vec<Vec<Bits>>, Vec<u8>) {
    let (inputs, outputs) = ports(design);
    let mut sim = Simulation::from_design(design).unwrap().on(EngineKind::Reference).seeded(u64::from(run) * 7);
    sim.trace(Vcd::to(&file)).unwrap();
    let mut all = Vec::new();
    for step in 0..STEPS {
        for (index, (name, width)) in (0..).zip(&inputs) {
            let port = sim.port(name).unwrap();
            sim.set(port, random(run, step, index).slice(0..*width));
        }
        if RESETS.contains(&step) {
            sim.set_reset(&design.top().clocks[0].port, step == RESETS[0]);
        }
        if step == 20 {
            sim.reset()
        } else {
            sim.step()
        }
        all.push(outputs.iter().map(|name| sim.peek(name).unwrap()).collect());
    }
    sim.finish().unwrap();
    (all, fs::read(file).unwrap())
}

fn check(name: &str, block: &impl Block) {
    let design = elaborate(block).unwrap();
    let (inputs, outputs) = ports(&design);
    let file = |name: String| PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("batch_{name}.vcd"));
    let singles: Vec<_> = (0..64).map(|run| alone(&design, run, file(format!("{name}_alone")))).collect();
    for (runs, kind) in [
        (1, EngineKind::Both),
        (3, EngineKind::Both),
        (16, EngineKind::Both),
        (17, EngineKind::Both),
        (64, EngineKind::Compiled),
        (5, EngineKind::Reference),
        (6, EngineKind::Interpreter),
    ] {
        let mut batch = Batch::from_design(&design, runs).unwrap().on(kind).seeded(|run| u64::from(run) * 7);
        assert_eq!((batch.runs(), batch.engine()), (runs, kind));
        let traced = [0, runs / 2, runs - 1];
        let path = |run: u32| file(format!("{name}_{runs}_{run}"));
        traced.iter().for_each(|&run| batch.trace(run, Vcd::to(path(run))).unwrap());
        for step in 0..STEPS {
            for (index, (name, width)) in (0..).zip(&inputs) {
                let port = batch.port(name).unwrap();
                batch.set_each(port, |run| random(run, step, index).slice(0..*width));
            }
            if RESETS.contains(&step) {
                batch.set_reset(&design.top().clocks[0].port, step == RESETS[0]);
            }
            if step == 20 {
                batch.reset()
            } else {
                batch.step()
            }
            for (index, output) in outputs.iter().enumerate() {
                let port: Port = batch.port(output).unwrap();
                let expected: Vec<Bits> =
                    singles[..runs as usize].iter().map(|single| single.0[step as usize][index].clone()).collect();
                assert_eq!(batch.get_each(port), expected, "{output} of {runs} runs after step {step} on {kind:?}");
                assert_eq!(batch.get(port, runs - 1), singles[runs as usize - 1].0[step as usize][index]);
            }
        }
        batch.finish().unwrap();
        for run in traced {
            assert!(fs::read(path(run)).unwrap() == singles[run as usize].1, "the waveform of run {run} of {runs}");
        }
    }
}

#[test]
fn an_array_memories_and_wide_values() {
    check("mixed", &Mixed);
}

#[test]
fn two_clocks() {
    check("store", &Store { policy: ReadUnderWrite::Any });
}

#[test]
fn names_and_memories_are_those_of_a_run() {
    let word = |value| Bits::new(9, value);
    let mut batch = Batch::of(&Mixed, 4).unwrap().on(EngineKind::Both);
    batch.drive(2, MixedIn { x: 0b1000, mix: 5, at: 4 });
    batch.poke_memory("u_cell[1].store", 3, 2, 77).unwrap();
    batch.step();
    assert_eq!((batch.peek_memory("words", 2, 4), batch.peek_memory("words", 1, 4)), (Ok(word(8)), Ok(word(0))));
    let words: Vec<_> = (0..4).map(|run| batch.peek_memory("u_cell[1].store", run, 2).unwrap()).collect();
    assert_eq!(words, [0, 0, 0, 77].map(|word| Bits::new(12, word)));
    assert_eq!(batch.peek("wide", 2).unwrap(), batch.read(2).wide);
    assert_ne!(batch.peek("wide", 2), batch.peek("wide", 1));
    let error = batch.peek("wids", 1).unwrap_err().to_string();
    assert_eq!(error, "there is no signal `wids`: did you mean `wide`?");
    batch.set_all(batch.i.at, 4);
    let read: Vec<_> = (0..4).map(|run| batch.read(run).word.to_u64()).collect();
    assert_eq!(read, [Some(0), Some(0), Some(8), Some(0)]);
}

#[test]
fn a_recording_and_a_wave_are_of_a_run() {
    let mut batch = Batch::of(&Limit { inside: true }, 3).unwrap().seeded(|run| u64::from(run == 1));
    let recorder = batch.recording(2);
    let wave = batch.record(2, ["add", "total"]);
    batch.set_each(batch.i.add, |run| run);
    batch.run(3);
    let outputs: Vec<_> = recorder.take().steps.iter().map(|step| step.outputs[0].to_u64()).collect();
    assert_eq!(outputs, [Some(0), Some(2), Some(4)]);
    wave.expect(
        r"
        clk   |___/~\_/~\_/
        add   | 2         |
        total | 0 | 2 | 4 |",
    );
}

#[test]
fn a_failed_assertion_names_its_runs_and_stops_all() {
    for kind in [EngineKind::Reference, EngineKind::Interpreter, EngineKind::Compiled, EngineKind::Both] {
        let mut batch = Batch::of(&Limit { inside: false }, 20).unwrap().on(kind);
        batch.set_each(batch.i.add, |run| if run == 3 || run == 17 { 15 } else { run % 3 });
        let Err(Error::Violated(violations)) = batch.try_run(100) else { panic!("the assertions hold") };
        let found: Vec<_> = violations.iter().map(|it| (it.run, it.instance.as_str(), it.cycle)).collect();
        assert_eq!(found, [(Some(3), "u_limit[0]", 7), (Some(17), "u_limit[0]", 7)], "{kind:?}");
        let text = violations[1].to_string();
        let expected = "assertion failed in `u_limit[0]` of run 17 in cycle 7 of `clk`, at 80000 ps: the sum is too";
        assert!(text.starts_with(expected), "{text}");
        assert_eq!((batch.time(), batch.cycles("clk")), (70_000, Ok(7)));
        let totals: Vec<_> = batch.get_each(batch.o.total).iter().map(Bits::to_u64).collect();
        assert_eq!((totals[2], totals[17]), (Some(7 * 3), Some(7 * 22)));
        batch.set_all(batch.i.add, 0);
        batch.reset();
        batch.run(5);
    }
}

#[test]
fn what_makes_no_sense_is_an_error() {
    let error = Batch::of(&Mixed, 0).unwrap_err().to_string();
    assert_eq!(error, "a batch of this design has from 1 to 349525 runs, not 0");
    assert!(matches!(Batch::of(&Mixed, 400_000), Err(Error::Runs { runs: 400_000, most: 349_525 })));
}

#[test]
#[should_panic(expected = "there is no run 4: the batch has 4, from 0")]
fn a_run_beyond_the_last() {
    let mut batch = Batch::of(&Mixed, 4).unwrap();
    batch.set(batch.i.x, 4, 1);
}

#[test]
#[should_panic(expected = "`sum` is an output and cannot be set")]
fn an_output_is_not_set() {
    let mut batch = Batch::of(&Mixed, 4).unwrap();
    batch.set_all(batch.o.sum, 1);
}

block! {
    /// The least of two lanes, and one of them by number. A loop over the runs has the number of a run's first lane in a
    /// table: it reads that lane, and adds to the number.
    struct Lanes;
    in LanesIn { a: bits(65), b: bits(65), at: bits(1) }
    out LanesOut { both: _ }
}

impl Lanes {
    fn build(&self, m: Module, i: LanesIn) -> LanesOut {
        let lanes = stack([i.a, i.b]);
        let both = m.reg("both", 1).reset(0);
        both.next(lanes.minimum().bit(0) & lanes.pick(i.at).bit(0));
        LanesOut { both: *both }
    }
}

#[test]
fn numbers_of_lanes_in_a_table() {
    check("lanes", &Lanes);
}

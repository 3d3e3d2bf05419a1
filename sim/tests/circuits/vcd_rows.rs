//! A waveform whose steps are written many at a time equals one that is written step by step.

use std::fs;
use std::path::{Path, PathBuf};

use tilewright_hdl::{Module, ReadUnderWrite, bit, bits, block, codes, lit, when};
use tilewright_sim::{EngineKind, Error, Passes, Simulation, Trace, Vcd};

codes! {
    enum Phase { Idle, Load, Store }
}

block! {
    /// Values of all kinds in a row: one bit, several bits, several limbs, names of codes, words of a memory; and an
    /// assertion on a count.
    pub(super) struct Mix;
    in MixIn { go: bit(), word: bits(33), limit: bits(12) }
    out MixOut { wide: _, read: _ }
}

impl Mix {
    fn build(&self, m: Module, i: MixIn) -> MixOut {
        let count = m.reg("count", 12).reset(0);
        count.next(count + 1);
        m.assert(count.ne(i.limit) | i.limit.eq(0), "the count is at its limit");
        let phase = m.fsm("phase", Phase::Idle);
        phase.next(|now| match now {
            Phase::Idle => when(i.go, Phase::Load),
            Phase::Load => when(count.bit(1), Phase::Store),
            Phase::Store => when(count.bit(0), Phase::Idle),
        });
        let wide = m.reg("wide", 130).reset(1);
        wide.next(wide.rotate_left(3) ^ i.word.zext(130));
        let long = m.reg("long", 300).reset(5);
        long.enable(i.go).next(long.rotate_left(7) ^ wide.zext(300));
        let memory = m.memory("memory", 16, 33, ReadUnderWrite::Old).fill(tilewright_hdl::Bits::zero(33));
        memory.write(phase.is(Phase::Store), count.trunc(4), i.word);
        let read = memory.read_async(count.slice(2..6));
        for number in 0..70 {
            let part = m.reg(&format!("part{number}"), 1 + number % 9).reset(0);
            part.enable(count.bit(number % 5)).next(part + lit(1 + number % 9, 1));
        }
        MixOut { wide: *wide, read }
    }
}

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("rows_{name}.vcd"))
}

/// The file of a run in which inputs and resets change now and then and an assertion fails; `vcd` selects what is
/// traced.
fn waves(kind: EngineKind, looks_after: u64, vcd: impl FnOnce(&Path) -> Trace) -> Vec<u8> {
    let design = tilewright_hdl::elaborate(&Mix).unwrap();
    let passes = Passes { looks_after, ..Passes::default() };
    let mut sim = Simulation::with_passes(&design, &passes).unwrap().on(kind);
    let [go, word, limit] = ["go", "word", "limit"].map(|name| sim.port(name).unwrap());
    let file = path(&format!("{kind:?}_{looks_after}"));
    sim.trace(vcd(&file)).unwrap();
    for round in 0..4_u64 {
        sim.run(100);
        sim.set(go, round % 2);
        for number in 0..40 {
            sim.set(word, number * 0x1234_5678 % (1_u64 << 33));
            sim.step();
        }
        sim.run_until(sim.port("read").unwrap().is_not(0), 300);
        sim.run_to(sim.time() + 333_333);
        if round == 1 {
            sim.reset();
        }
    }
    let count = sim.cycles("clk").unwrap();
    sim.reset();
    sim.set(limit, 500);
    assert!(matches!(sim.try_run(1000), Err(Error::Violated(_))));
    assert!(matches!(sim.try_run(1000), Err(Error::Violated(_))));
    assert_eq!(sim.cycles("clk").unwrap(), count + 501);
    sim.set(limit, 0);
    sim.run(700);
    sim.finish().unwrap();
    fs::read(file).unwrap()
}

#[test]
fn rows_give_the_file_that_steps_give() {
    let choices: [fn(&Path) -> Trace; 4] = [
        |file| Vcd::to(file),
        |file| Vcd::to(file).only("wide").only("phase").only("part1*"),
        |file| Vcd::to(file).times(1_234_567..9_876_543),
        |file| Vcd::to(file).only("clk"),
    ];
    for vcd in choices {
        let expected = waves(EngineKind::Reference, u64::MAX, vcd);
        for looks_after in [0, 50, u64::MAX] {
            assert!(waves(EngineKind::Compiled, looks_after, vcd) == expected, "after {looks_after}");
        }
    }
}

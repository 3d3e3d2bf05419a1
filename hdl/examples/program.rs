//! A sequencer whose program is a memory of records: one record type serves the assembler, the decoder and the wave.
//! `cargo run -p tilewright-hdl --example program`

use tilewright_hdl::*;
use tilewright_sim::Simulation;

codes! {
    /// The effect of an instruction on the sum.
    enum Alu { Load, Add, Double }
}

bundle! {
    /// An instruction; it is executed once and then `more` times again.
    struct Step<T> { alu: T, operand: T, more: T, ends: T }
}

/// The assembler: a function that returns a record of numbers.
fn step(alu: Alu, operand: u64) -> Step<u64> {
    Step { alu: alu.code(), operand, more: 0, ends: 0 }
}

block! {
    /// Runs its program whenever it is started.
    struct Run;
    in RunIn { start: bit() }
    out RunOut { sum: bits(8), busy: bit() }
}

impl Run {
    fn build(&self, m: Module, i: RunIn) -> RunOut {
        let layout = Step { alu: one_of::<Alu>(), operand: bits(8), more: bits(2), ends: bit() };
        def!(
            program = m.rom(
                layout,
                [
                    step(Alu::Load, 3),
                    step(Alu::Add, 5),
                    Step { more: 2, ..step(Alu::Double, 0) },
                    Step { ends: 1, ..step(Alu::Add, 100) },
                ],
            )
        );
        def!(busy = m.reg(bit()).reset(0));
        def!(at = m.reg(program.address_width()).reset(0));
        def!(done = m.reg(2).reset(0));
        def!(sum = m.reg(8).reset(0));

        def!(step = program.read_async(at));
        def!(last = done.eq(step.more));
        busy.when(i.start, 1).when(last & step.ends, 0);
        at.when(i.start, 0).when(busy & last, at + 1);
        done.when(i.start | last, 0).when(busy, done + 1);
        let result = choose!(step.alu, Alu {
            Load => step.operand,
            Add => sum + step.operand,
            Double => sum << 1,
        });
        sum.when(busy, result);
        RunOut { sum: *sum, busy: *busy }
    }
}

/// Runs it; a test does so too.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut sim = Simulation::of(&Run)?;
    sim.reset();
    let wave = sim.record(["start", "busy", "at", "step_alu", "step_operand", "done", "sum"]);
    for start in [1, 0, 0, 0, 0, 0, 0, 0] {
        sim.drive(RunIn { start });
        sim.step();
    }
    assert_eq!(sim.get(sim.o.sum), (3 + 5) * 8 + 100);
    println!("The program's steps in the wave:\n{wave}");
    print!("{}", tilewright_gen::verilog(&elaborate(&Run)?)[0].text);
    Ok(())
}

//! A counter: described, tested, drawn as a wave, printed as Verilog. `cargo run -p tilewright-hdl --example counter`

use tilewright_hdl::*;
use tilewright_sim::{Simulation, Vcd};

block! {
    /// Counts from 0 to `limit - 1` and starts again.
    struct Counter {
        width: u32,
        limit: u64,
    }
    in CounterIn { enable: bit() }
    out(self) CounterOut { count: bits(self.width), wraps: bit() }
}

impl Counter {
    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        def!(count = m.reg(self.width).reset(0));
        def!(at_end = count.eq(self.limit - 1));
        count.when(i.enable, mux(at_end, 0, count + 1));
        CounterOut { count: *count, wraps: at_end & i.enable }
    }
}

/// Runs it; a test does so too.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let counter = Counter { width: 4, limit: 3 };

    let mut sim = Simulation::of(&counter)?;
    let vcd = std::env::temp_dir().join("counter.vcd");
    sim.trace(Vcd::to(&vcd))?;
    let wave = sim.record([sim.i.enable, sim.o.count, sim.o.wraps]);
    for (enable, count) in [(1, 0), (1, 1), (0, 2), (1, 2), (1, 0)] {
        sim.drive(CounterIn { enable });
        assert_eq!(sim.get(sim.o.count), count);
        sim.step();
    }
    sim.finish()?;
    println!("{} holds this wave:\n{wave}", vcd.display());

    print!("{}", tilewright_gen::verilog(&elaborate(&counter)?)[0].text);
    Ok(())
}

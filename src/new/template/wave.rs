//! Shows the counter's wave: as text, and in `counter.vcd` for a viewer such as Surfer or GTKWave.
//! `cargo run --example wave`

use my_block::{Counter, CounterIn};
use tilewright_sim::{Error, Simulation, Vcd};

fn main() -> Result<(), Error> {
    let mut sim = Simulation::of(&Counter { limit: 3 })?;
    sim.trace(Vcd::to("counter.vcd"))?;
    let wave = sim.record([sim.i.enable, sim.o.count, sim.o.wraps]);
    sim.drive(CounterIn { enable: 1 });
    sim.run(8);
    sim.finish()?;
    print!("{wave}");
    Ok(())
}

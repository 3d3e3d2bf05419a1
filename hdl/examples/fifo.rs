//! A first-in first-out queue: a memory, two pointers, and flags that are always correct.
//! `cargo run -p tilewright-hdl --example fifo`

use tilewright_hdl::*;
use tilewright_sim::{Simulation, Vcd};

block! {
    /// Stores up to `depth` words, a power of two; the oldest is at the head. A push when full and a pop when empty
    /// have no effect.
    struct Fifo {
        depth: u32,
        width: u32,
    }
    in(self) FifoIn { push: bit(), data: bits(self.width), pop: bit() }
    out(self) FifoOut { head: bits(self.width), empty: bit(), full: bit() }
}

impl Fifo {
    fn build(&self, m: Module, i: FifoIn) -> FifoOut {
        def!(words = m.memory(self.depth, self.width, ReadUnderWrite::Old));
        let address = words.address_width(); // One bit more tells full from empty.
        def!(oldest = m.reg(address + 1).reset(0));
        def!(free = m.reg(address + 1).reset(0));
        def!(empty = oldest.eq(free));
        def!(full = (oldest ^ free).eq(self.depth));
        words.write(i.push & !full, free.low(), i.data);
        free.when(i.push & !full, free + 1);
        oldest.when(i.pop & !empty, oldest + 1);
        FifoOut { head: words.read_async(oldest.low()), empty, full }
    }
}

/// Runs it; a test does so too.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let fifo = Fifo { depth: 4, width: 8 };
    let mut sim = Simulation::of(&fifo)?;
    let vcd = std::env::temp_dir().join("fifo.vcd");
    sim.trace(Vcd::to(&vcd))?;
    let wave = sim.record([sim.i.push, sim.i.data, sim.i.pop, sim.o.head, sim.o.empty, sim.o.full]);
    for data in [10, 11, 12, 13, 14] {
        sim.drive(FifoIn { push: 1, data, pop: 0 });
        sim.step();
    }
    for data in [10, 11, 12, 13] {
        sim.drive(FifoIn { push: 0, data: 0, pop: 1 });
        assert_eq!(sim.get(sim.o.head), data);
        sim.step();
    }
    assert_eq!(sim.get(sim.o.empty), true);
    sim.finish()?;
    println!("{} holds this wave:\n{wave}", vcd.display());
    print!("{}", tilewright_gen::verilog(&elaborate(&fifo)?)[0].text);
    Ok(())
}

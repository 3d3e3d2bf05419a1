//! A simulated board.

use tilewright_boards::receiver::{Lines, Seen, received};
use tilewright_boards::ulx3s::SERIAL;
use tilewright_hdl::Block;
use tilewright_sim::Simulation;

/// What the pins of a ULX3S send in clocks of their lines. At an edge upwards the pin of the model has the first bit,
/// and its register the second one.
pub fn sent<B: Block>(top: &B, clocks: usize) -> Lines {
    let mut sim = Simulation::of(top).unwrap().seeded(5);
    let mut lines = Lines::default();
    for _ in 0..clocks {
        sim.step_clock(SERIAL, 1);
        for (lane, line) in lines.iter_mut().enumerate() {
            let bit = |place: &str| sim.peek(&format!("u_tmds[{lane}].{place}")).unwrap() == 1;
            line.extend(["first", "second"].map(bit));
        }
    }
    assert_eq!(sim.peek("locked").unwrap(), 1);
    lines
}

/// What a receiver sees of it.
pub fn seen<B: Block>(top: &B, clocks: usize) -> Vec<Seen> {
    received(&sent(top, clocks)).unwrap()
}

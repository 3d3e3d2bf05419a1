//! Plays a block clock by clock.

use tilewright_blocks::{StreamIn, StreamOut};
use tilewright_hdl::Block;
use tilewright_sim::Simulation;

/// The inputs and outputs of a clock: the sender's word, if any, and the receiver's `ready`; the block's `ready`, and
/// the word that it shows, if any.
pub type Row = (Option<u64>, u64, u64, Option<u64>);

/// Plays the inputs of the rows, and compares the outputs.
#[track_caller]
pub fn play<B: Block<In = StreamIn, Out = StreamOut>>(block: &B, rows: &[Row]) {
    let mut sim = Simulation::of(block).unwrap();
    sim.reset();
    let mut seen = Vec::new();
    for &(word, ready, ..) in rows {
        sim.set(sim.i.into.valid, word.is_some());
        sim.set(sim.i.into.payload, word.unwrap_or(0));
        sim.set(sim.o.out.ready, ready);
        let shows = sim.get_u64(sim.o.out.valid) == 1;
        let shown = shows.then(|| sim.get_u64(sim.o.out.payload));
        seen.push((word, ready, sim.get_u64(sim.i.into.ready), shown));
        sim.step();
    }
    assert_eq!(seen, rows);
}

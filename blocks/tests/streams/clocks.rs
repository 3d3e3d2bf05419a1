//! Plays a block clock by clock.

use tilewright_blocks::{StreamIn, StreamOut};
use tilewright_hdl::Block;
use tilewright_sim::Simulation;

/// A clock's inputs and outputs: the sender's word or none, and the receiver's `ready`; whether the block takes the
/// word, and the word that it shows.
pub type Row = (Option<u64>, u64, u64, Option<u64>);

/// Plays the rows and compares.
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

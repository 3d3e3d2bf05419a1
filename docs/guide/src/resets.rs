//! Chapter 9: a reset from a pin.

use tilewright_hdl::*;

/// The clock of a board with a button that pulls the reset low.
pub const BOARD: Clock = Clock::new("board", Period::ns(20)).reset(Reset::AsynchronousLow);

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_blocks::ResetSynchronizer;
    use tilewright_sim::Simulation;

    #[test]
    fn a_reset_begins_at_once_and_ends_at_an_edge() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&ResetSynchronizer::new(BOARD))?;
        let wave = sim.record([sim.o.reset]);
        sim.run(3);
        sim.set_reset(BOARD, true);
        sim.run(2);
        sim.set_reset(BOARD, false);
        sim.run(3);
        wave.expect(
            r"
            board_clk |___/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
            reset     |~~~~~~~\___/~~~~~~~~~~~~~~~\____",
        );
        Ok(())
    }
}

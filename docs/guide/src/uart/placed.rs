//! Chapter 9: the echo on the clocks of a board, which can pause its line.

use super::two_clocks::{LINE, SYSTEM, ShoutingEcho, ShoutingEchoIn};
use tilewright_hdl::*;

/// The clock of the board's oscillator, with the period of the line's.
pub const OSCILLATOR: Clock = Clock::new("oscillator", LINE.period);

block! {
    /// The echo, whose line stands still while it is paused.
    pub struct Board {
        /// How long a bit is, in clocks of the oscillator.
        pub clocks_per_bit: u32,
    }
    in BoardIn {
        /// The line from the other side.
        rx: bit().on(OSCILLATOR),
        /// The line runs.
        run: bit().on(OSCILLATOR),
    }
    out BoardOut {
        /// The line to the other side.
        tx: bit(),
        /// A byte was lost since the reset.
        lost: bit(),
    }
}

impl Board {
    fn build(&self, m: Module, i: BoardIn) -> BoardOut {
        let board = m.on(OSCILLATOR);
        let echo = ShoutingEcho { clocks_per_bit: self.clocks_per_bit };
        let place = || m.instance("u_echo", &echo, ShoutingEchoIn { rx: i.rx });
        let named = || board.in_place_of(LINE, || m.in_place_of(SYSTEM, place));
        let echo = board.enabled(i.run, named);
        BoardOut { tx: echo.tx, lost: echo.lost }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uart::far_end;
    use tilewright_sim::{Simulation, monitor};

    #[test]
    fn a_bit_is_as_long_as_the_line_runs() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::at(&Board { clocks_per_bit: 13 }, SYSTEM.period)?;
        sim.drive(BoardIn { rx: 1, run: 1 });
        sim.reset();
        let (i, o) = (sim.i, sim.o);
        let t = &sim.testbench();
        let board = &t.on("oscillator");
        // The line runs in every second clock, so a bit takes twice as many.
        let pauses = async {
            for clock in 0.. {
                board.set(i.run, clock % 2_u64);
                board.step().await;
            }
        };
        let talks = async {
            far_end::sends(board, i.rx, b'a', 26).await;
        };
        let listens = async { assert_eq!(far_end::receives(board, o.tx, 26).await, b'A') };
        t.run((monitor(pauses), talks, listens));
        Ok(())
    }
}

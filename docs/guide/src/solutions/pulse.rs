//! Chapter 9: a pulse from one clock to another.

use crate::uart::two_clocks::{LINE, SYSTEM};
use tilewright_hdl::*;

block! {
    /// A pulse of one clock of the line becomes one of one clock of the system.
    pub struct Pulse;
    in PulseIn { pulse: bit().on(LINE) }
    out PulseOut { seen: bit() }
}

impl Pulse {
    fn build(&self, m: Module, i: PulseIn) -> PulseOut {
        def!(flipped = m.on(LINE).toggle(i.pulse));
        def!(arrived = m.on(SYSTEM).synchronize(flipped));
        def!(before = m.on(SYSTEM).reg(bit()).reset(0));
        before.next(arrived);
        PulseOut { seen: arrived ^ before }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn a_pulse_is_seen_once() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Pulse)?;
        let wave = sim.record(["pulse", "flipped", "arrived", "seen"]);
        sim.set(sim.i.pulse, 1);
        sim.run_to(90_000);
        sim.set(sim.i.pulse, 0);
        sim.run_to(200_000);
        wave.expect(
            r"
            line_clk   |___________________/~~~~~~~~~\_________/~~~~~~~~
            system_clk |___/~\_/~\_/~\_/~~~~~\_/~\_/~\_/~\_/~~~~~\_/~\_/
            pulse      |~~~~~~~~~~~~~~~~~~~\____________________________
            flipped    |___________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~
            arrived    |___________________________/~~~~~~~~~~~~~~~~~~~~
            seen       |___________________________/~~~\________________",
        );
        Ok(())
    }
}

//! The sync line: one bit that all processing elements, the bus and any participating host share (VC1-NET, VC1-SW1).
//!
//! ```text
//! ready[0] --.
//! ready[1] --+--> & --> line
//!    ..      |
//! bus -------+
//! host ------'
//! ```
//!
//! Latency: none, because the line is a wired AND. A party that does not participate releases the line.

use crate::prelude::*;

block! {
    /// One bit that is high unless a processing element, the bus or the host pulls it low.
    pub struct SyncLine {
        /// The number of processing elements.
        pub processors: u32,
    }
    ranges { processors: 1.. }
    latency = "0 clocks";
    source = "VC-1, sections 3.1 and 4, sync line (VC1-NET, VC1-SW1)";
    in(self) SyncLineIn {
        /// For each processing element: the frame is drawn, and the last swap is over.
        ready: [bit(); self.processors],
        /// The broadcast bus is idle.
        bus: bit(),
        /// The host releases the sync line.
        host: bit(),
    }
    out SyncLineOut {
        /// The sync line: high unless a unit pulls it low.
        line: bit(),
    }
}

impl SyncLine {
    fn build(&self, m: Module, i: SyncLineIn) -> SyncLineOut {
        def!(line = stack(i.ready).and_all() & i.bus & i.host);
        m.cover("all have drawn a frame", m.rose(line));
        SyncLineOut { line }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tilewright_sim::Simulation;

    use super::*;

    #[test]
    fn it_is_high_when_no_unit_pulls_it_low() {
        let mut sim = Simulation::of(&SyncLine { processors: 2 }).unwrap();
        let wave = sim.record([sim.i.ready[0], sim.i.ready[1], sim.i.bus, sim.i.host, sim.o.line]);
        sim.reset();
        let steps = [
            ([0, 0], 1, 1),
            ([1, 0], 1, 1),
            ([1, 1], 1, 1),
            ([0, 1], 1, 1),
            ([1, 1], 1, 0),
            ([1, 1], 1, 1),
            ([1, 1], 0, 1),
        ];
        for (ready, bus, host) in steps {
            sim.drive(SyncLineIn { ready: ready.to_vec(), bus, host });
            sim.step();
        }
        wave.expect(
            r"
            clk     |___/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
            ready_0 |_______/~~~~~~~\___/~~~~~~~~~~~~
            ready_1 |___________/~~~~~~~~~~~~~~~~~~~~
            bus     |___/~~~~~~~~~~~~~~~~~~~~~~~\____
            host    |___/~~~~~~~~~~~~~~~\___/~~~~~~~~
            line    |___________/~~~\_______/~~~\____
            ",
        );
        assert_eq!(sim.covered("all have drawn a frame").unwrap(), 2);
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// Compares the line with the number of units that pull it low (VC1-SW1).
        #[test]
        fn it_is_low_while_any_unit_pulls_it_low(
            ready in prop::collection::vec(prop::bool::weighted(0.9), 1..40),
            bus: bool,
            host: bool,
        ) {
            let mut sim = Simulation::of(&SyncLine { processors: ready.len() as u32 }).unwrap();
            sim.reset();
            let releases = ready.iter().map(|it| u64::from(*it)).collect();
            sim.drive(SyncLineIn { ready: releases, bus: bus.into(), host: host.into() });
            let low = ready.iter().filter(|ready| !**ready).count() + usize::from(!bus) + usize::from(!host);
            prop_assert_eq!(sim.get_u64(sim.o.line) == 1, low == 0);
        }
    }
}

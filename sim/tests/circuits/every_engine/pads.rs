//! Pads: what a line shows of both sides, and the assertion that they do not differ.

use tilewright_hdl::*;
use tilewright_sim::{EngineKind, Error, Simulation};

const ENGINES: [EngineKind; 4] =
    [EngineKind::Reference, EngineKind::Interpreter, EngineKind::Compiled, EngineKind::Both];

block! {
    /// An open drain with a pull-up, and a bus.
    pub struct Chip;
    in ChipIn {
        /// The chip pulls the wire low.
        pull: bit(),
        /// The chip drives the word.
        drive: bit(),
        /// The word.
        word: bits(4),
        /// The others on the wire.
        scl: Outside::widths(1),
        /// The others on the bus.
        bus: Outside::widths(4),
    }
    out ChipOut {
        /// What the wire shows.
        scl_line: bit(),
        /// What the bus shows.
        bus_line: bits(4),
    }
}

impl Chip {
    fn build(&self, m: Module, i: ChipIn) -> ChipOut {
        def!(scl = m.instance(&Pad::new(1).pull_up(), PadIn::open_drain(i.pull, i.scl)));
        def!(bus = m.instance(&Pad::new(4), PadIn { out: i.word, enable: i.drive, outside: i.bus }));
        ChipOut { scl_line: scl.line, bus_line: bus.line }
    }
}

#[test]
fn a_line_shows_the_side_that_drives_it() {
    // What each side does, `None` if it is released, and what the lines show.
    let rows = [
        ((0, None), (None, None), (1, 0)),
        ((1, None), (None, None), (0, 0)),
        ((0, Some(0)), (None, Some(9)), (0, 9)),
        ((1, Some(0)), (Some(5), None), (0, 5)),
        ((0, Some(1)), (Some(5), Some(5)), (1, 5)),
        ((0, None), (Some(0), None), (1, 0)),
    ];
    let outside = |side: Option<u64>| Outside { value: side.unwrap_or(0), drives: u64::from(side.is_some()) };
    for kind in ENGINES {
        let mut sim = Simulation::of(&Chip).unwrap().on(kind);
        for ((pull, scl), (word, bus), lines) in rows {
            let (drive, word) = (u64::from(word.is_some()), word.unwrap_or(3));
            sim.drive(ChipIn { pull, drive, word, scl: outside(scl), bus: outside(bus) });
            assert_eq!((sim.get_u64(sim.o.scl_line), sim.get_u64(sim.o.bus_line)), lines, "{kind:?}");
            sim.try_step().unwrap();
        }
        for (pull, word, scl, bus, pad) in [(0, 5, 0, Some(4), "u_bus"), (1, 0, 1, None, "u_scl")] {
            let mut sim = Simulation::of(&Chip).unwrap().on(kind);
            let scl = Outside { value: scl, drives: scl };
            sim.drive(ChipIn { pull, drive: 1, word, scl, bus: outside(bus) });
            let Err(Error::Violated(violations)) = sim.try_step() else { panic!("{kind:?}: both sides drive") };
            let said = violations[0].to_string();
            assert!(said.contains(pad) && said.contains("do not drive different values"), "{said}");
        }
    }
}

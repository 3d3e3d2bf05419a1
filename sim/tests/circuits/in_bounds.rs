//! Memories whose addresses are said to stay below the depth, on every engine.

use tilewright_hdl::*;
use tilewright_sim::{EngineKind, Simulation};

const VIDEO: Clock = Clock::new("video", Period::ns(10));

block! {
    /// Five words, five words in each of two lanes, and five constant ones, with every kind of port.
    struct Ports;
    in PortsIn {
        writes: bit(),
        to: below(5),
        reads: bit(),
        from: below(5),
        at_once: below(5).on(VIDEO),
        mask: bits(2),
        lanes: bits(6),
        enabled: bit(),
    }
    out PortsOut { word: bits(8), now: bits(8), each: bits(8).of(row(2)) }
}

impl Ports {
    fn build(&self, m: Module, i: PortsIn) -> PortsOut {
        def!(words = m.memory(5, 8, ReadUnderWrite::Any).fill(3).in_bounds());
        words.write(i.writes, i.to, 9);
        let word = m.enabled(i.enabled, || words.read_when(i.reads, i.from));
        let now = m.rom("constants", 8, [1, 2, 3, 4, 5]).in_bounds().on(VIDEO).read_async(i.at_once);
        def!(rows = m.memory(5, bits(8).of(row(2)), ReadUnderWrite::Any).fill(4).in_bounds());
        rows.write(i.mask.unpack(row(2)), i.to, 7);
        PortsOut { word, now, each: rows.read(i.lanes.unpack(row(2))) }
    }
}

const QUIET: PortsIn<u64> = PortsIn { writes: 0, to: 0, reads: 0, from: 0, at_once: 0, mask: 0, lanes: 0, enabled: 1 };

/// What every engine says of a step with these inputs; nothing where no assertion fails.
fn said(inputs: &PortsIn<u64>) -> String {
    let said = [EngineKind::Interpreter, EngineKind::Both].map(|kind| {
        let mut sim = Simulation::of(&Ports).unwrap().on(kind);
        sim.drive(*inputs);
        sim.try_step().err().map(|error| error.to_string()).unwrap_or_default()
    });
    assert_eq!(said[0], said[1]);
    said[0].clone()
}

#[test]
fn an_access_beyond_the_depth_fails_where_its_enable_is_high() {
    assert_eq!(said(&QUIET), "");
    assert_eq!(said(&PortsIn { to: 5, from: 7, ..QUIET }), "", "nothing is written or read");
    assert_eq!(said(&PortsIn { from: 7, reads: 1, enabled: 0, ..QUIET }), "", "the part is not enabled");
    assert_eq!(said(&PortsIn { to: 4, writes: 1, mask: 3, from: 4, reads: 1, lanes: 0o44, ..QUIET }), "");
    for (inputs, address, memory) in [
        (PortsIn { to: 5, writes: 1, ..QUIET }, "to", "words"),
        (PortsIn { from: 7, reads: 1, ..QUIET }, "from", "words"),
        (PortsIn { at_once: 6, ..QUIET }, "at_once", "constants"),
        (PortsIn { to: 6, mask: 2, ..QUIET }, "to", "rows"),
        (PortsIn { lanes: 0o50, ..QUIET }, "lanes.unpack()", "rows"),
    ] {
        let (message, said) = (format!("`{address}` is an address of `{memory}`, below 5"), said(&inputs));
        assert!(said.contains(&message), "{inputs:?}: {said}");
    }
}

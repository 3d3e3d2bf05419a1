use tilewright_hdl::{Module, bit, bits, block, def};

use crate::testbench::for_examples::Counter;
use crate::{Probe, Simulation};

block! {
    /// A register behind a stream.
    struct Taker;
    in TakerIn { items: stream(bits(8)), when: bit() }
    out TakerOut { last: bits(8) }
}

impl Taker {
    fn build(&self, m: Module, i: TakerIn) -> TakerOut {
        let taken = i.items.take_when(i.when);
        def!(last = m.reg(8).reset(0));
        last.when(taken.taken, taken.payload);
        TakerOut { last: *last }
    }
}

fn count(svg: &str, what: &str) -> usize {
    svg.matches(what).count()
}

#[test]
fn values_are_hexagons_and_bits_lines() {
    let mut sim = Simulation::of(&Counter).unwrap();
    let wave = sim.record([Probe::from("enable"), "count".into(), "square".into()]);
    sim.set(sim.i.enable, 1);
    sim.run(4);
    let svg = wave.svg();
    assert_eq!([count(&svg, "class=\"clock\""), count(&svg, "class=\"bit\"")], [1, 1]);
    // 0 to 3 and their squares.
    assert_eq!(count(&svg, "class=\"bus\""), 8);
    assert!(svg.contains(">9</text>") && !svg.contains("class=\"taken\""), "{svg}");
    assert_eq!(svg, wave.svg());
    // A wave that goes on below has its names twice.
    sim.run(100);
    assert!(count(&wave.svg(), ">square</text>") > 1);
}

#[test]
fn fields_are_below_their_record_and_what_is_taken_has_a_dot() {
    let mut sim = Simulation::of(&Taker).unwrap();
    let ports = ["items_valid", "items_payload", "items_ready", "when", "last"];
    let wave = sim.record(ports.map(Probe::from));
    let items = sim.i.items;
    for (valid, when) in [(0, 1), (1, 0), (1, 1), (1, 1), (0, 0)] {
        sim.set(items.valid, valid);
        sim.set(items.payload, 77);
        sim.set(sim.i.when, when);
        sim.step();
    }
    let svg = wave.svg();
    assert!(svg.contains("class=\"group\"") && svg.contains(">items</text>") && svg.contains(">valid</text>"), "{svg}");
    assert!(!svg.contains("items_valid</text>"), "{svg}");
    // Two items, and the one in the legend.
    assert_eq!(count(&svg, "<circle"), 3, "{svg}");
}

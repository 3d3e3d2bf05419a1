//! The simulator computes the checksums that other simulators agree on.

use tilewright_benches::{RESET_CYCLES, Subject};
use tilewright_sim::Simulation;

/// Runs a subject through all known checksums of at most so many cycles.
#[track_caller]
fn check(name: &str, most: u64) {
    let subject: Subject = name.parse().unwrap();
    let mut sim = Simulation::from_design(&subject.design().unwrap()).unwrap();
    let [rst, csum] = ["rst", "csum"].map(|port| sim.port(port).unwrap());
    sim.set(rst, 1);
    sim.run(RESET_CYCLES);
    sim.set(rst, 0);
    let mut cycle = 0;
    for (cycles, checksum) in subject.known().take_while(|(cycles, _)| *cycles <= most) {
        sim.run(cycles - cycle);
        cycle = cycles;
        assert_eq!(sim.get_u64(csum), checksum.into(), "{name} after {cycles} cycles");
    }
    assert_eq!(cycle, most, "no checksum is known");
}

#[test]
fn pim() {
    check("pim16", 20_000);
}

#[test]
fn qt() {
    check("qt1", 300_000);
    check("qt16", 20_000);
}

#[test]
fn simd() {
    check("simd16", 1000);
    check("simd64", 200);
}

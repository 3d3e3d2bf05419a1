//! The simulator computes the checksums that other simulators agree on.

use tilewright_benches::{Subject, reset};
use tilewright_sim::Simulation;

/// Runs a subject through all known checksums of at most so many cycles.
#[track_caller]
fn check(name: &str, most: u64) {
    let subject: Subject = name.parse().unwrap();
    let mut sim = Simulation::from_design(&subject.design().unwrap()).unwrap();
    let csum = sim.port("csum").unwrap();
    reset(&mut sim).unwrap();
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
    check("pim16", 300_000);
}

#[test]
fn qt() {
    check("qt1", 300_000);
    check("qt16", 300_000);
}

#[test]
fn simd() {
    check("simd16", 20_000);
    check("simd64", 200);
}

#[test]
fn vc1() {
    check("vc1x3@32x16", 200_000);
}

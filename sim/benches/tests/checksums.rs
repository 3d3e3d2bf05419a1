//! The simulator computes the checksums that other simulators agree on.

use std::ops::ControlFlow;
use std::time::Duration;
use tilewright_benches::designs::{Processor, ProcessorIn, ProcessorOut};
use tilewright_benches::{Effort, Rivals, Subject, measure, reset};
use tilewright_sim::Simulation;

/// Runs a subject through all known checksums of at most `most` cycles.
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
        assert_eq!(sim.get_u64(csum), u64::from(checksum), "{name} after {cycles} cycles");
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
fn core() {
    check("core1", 500_000);
}

#[test]
fn the_processor_sorts() {
    let mut sim = Simulation::of(&Processor).unwrap();
    sim.drive(ProcessorIn { rst: 1, word: 12345 });
    sim.step();
    sim.set(sim.i.rst, 0);
    let words = |sim: &Simulation<ProcessorIn, ProcessorOut>| {
        let byte = |lane, at| sim.peek_memory(&format!("byte{lane}"), at).unwrap().to_u64().unwrap() as u32;
        (0..32).map(|at| (0..4).map(|lane| byte(lane, at) << (8 * lane)).sum::<u32>() as i32).collect::<Vec<_>>()
    };
    let is_sorted = |words: &[i32]| words.windows(2).all(|pair| pair[0] < pair[1]);
    let sorted = (0..5000).any(|_| {
        sim.step();
        is_sorted(&words(&sim))
    });
    assert!(sorted, "{:?}", words(&sim));
}

#[test]
fn simd() {
    check("simd16", 20_000);
    check("simd64", 200);
}

#[test]
fn pxpl() {
    check("pxpl16", 20_000);
    check("pxpl32", 20_000);
    check("pxpl128", 20_000);
}

#[test]
fn vc1() {
    check("vc1x3@32x16", 200_000);
    check("vc1x16@160x120", 500_000);
}

#[test]
fn renderer() {
    check("renderer8", 20_000);
    check("renderer32", 20_000);
    check("renderer64", 1000);
    check("renderer128", 1000);
}

#[test]
fn nodes() {
    check("nodes20", 2000);
}

#[test]
fn every_stimulus_of_several_at_once() {
    for name in ["qt1*16", "qt3*5", "pim2*4", "simd3*3"] {
        let effort = Effort { rounds: 1, time: Duration::from_millis(1) };
        let measured =
            measure(name.parse().unwrap(), Rivals::default(), effort, &mut |_, _| ControlFlow::Continue(())).unwrap();
        let names: Vec<&str> = measured.simulators.iter().map(|it| it.simulator.as_str()).collect();
        assert!(names[0].ends_with(" at once") && names[1] == "compiled engine", "{names:?}");
    }
}

/// If two clocks rise at one instant, that is one cycle of the simulator: there are slightly fewer than stated.
#[test]
fn frames_follow_each_other_as_is_said() {
    for name in ["vc1x3@32x16", "vc1x16@32x16"] {
        let subject: Subject = name.parse().unwrap();
        let mut sim = Simulation::from_design(&subject.design().unwrap()).unwrap();
        let mut next_frame = || {
            let shown = sim.peek("shown").unwrap().to_u64();
            let mut cycles = 0;
            while sim.peek("shown").unwrap().to_u64() == shown {
                sim.step();
                cycles += 1;
            }
            cycles
        };
        next_frame();
        let said = subject.frame_cycles().unwrap();
        for _ in 0..2 {
            let cycles: u64 = next_frame();
            assert!((said * 8 / 10..=said).contains(&cycles), "{name}: {cycles} of {said}");
        }
    }
}

//! A model that is wrong in a clock is found, and what is left out at rest is nothing.

use std::collections::BTreeSet;

use proptest::prelude::*;
use tilewright_rtl::pixel_planes::instruction::Operation;
use tilewright_rtl::pixel_planes::linear_tree::Coefficients;
use tilewright_rtl::pixel_planes::programs::{clear, flat, save};
use tilewright_scenes::Size;
use tilewright_sim::Vcd;

use super::super::config::Config;
use super::super::model::{Model, Step};
use super::*;

fn program() -> Vec<Instruction<u64>> {
    let edges = [[3, -2, -5], [-5, 7, 9]].map(|[a, b, c]| Coefficients { a, b, c });
    [clear(0x10_20_30), flat(8, &edges, 0xff), save(6)].concat()
}

/// What comes of a renderer that follows a timing of two regions, after a change of it.
fn followed(change: impl FnOnce(&mut RendererTiming)) -> Result<usize, Error> {
    let config = Config { renderers: 1, side: 8, ring: 400, queue: 2, ..Config::new(Size::VGA) };
    let program = program();
    let steps = Step::of(&program);
    let timing = Model::new(&config)?.run(&[&steps[..], &steps[..]]);
    let mut timing = timing.renderers.into_iter().next().expect("there is one");
    change(&mut timing);
    let course = Course { number: 4, timing: &timing, regions: vec![(6, &program[..]), (6, &program[..])] };
    course.run(&config.renderer()?, (EngineKind::Compiled, true), None, &|_, _| Ok(()), None).map(|planes| planes.len())
}

#[test]
fn a_model_that_is_wrong_by_a_clock_is_found() {
    assert_eq!(followed(|_| ()).expect("the model is right"), 2 * 48 * 8);
    type Change = fn(&mut RendererTiming);
    let changes: [(&str, Change); 6] = [
        ("taken", |it| it.taken[2] += 1),
        ("taken", |it| it.taken[5] -= 1),
        ("ended", |it| it.ended.iter_mut().for_each(|clock| *clock += 1)),
        ("shown", |it| it.shown[0] += 1),
        ("shown", |it| it.shown[1] -= 1),
        ("planes", |it| it.planes[0] = it.shown[0] - 1),
    ];
    for (what, change) in changes {
        let error = followed(change).expect_err(what);
        assert!(matches!(error, Error::Differs { .. }), "{what}: {error}");
        let sentence = error.to_string();
        assert!(
            sentence.starts_with("internal error: in clock ") && sentence.contains(" of renderer 4 is "),
            "{sentence}"
        );
    }
}

/// How many variables but the clock change in some clocks of a renderer, which begin so many clocks after the last bit of a program.
fn changes_after(rest: u64, quadratic: bool, coefficient: u64) -> usize {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rest.vcd");
    let renderer = Renderer { side: 16, queue: 8, quadratic };
    let mut sim = Simulation::at(&renderer, PERIOD).expect("it can be built");
    sim.try_reset().expect("no assertion");
    sim.set(sim.i.side_by_side, true);
    sim.set(sim.o.planes.ready, true);
    let coefficients = Coefficients { a: coefficient, b: coefficient >> 1, c: coefficient >> 2 };
    let curve = Instruction { operation: Operation::Curve as u64, skip: 0, length: 1, read: 0, write: 0, coefficients };
    let bent = |it: Instruction<u64>| [curve, it].into_iter().skip(usize::from(!quadratic));
    let program = program().into_iter().flat_map(bent).map(|it| Instruction { coefficients, ..it });
    for instruction in program.filter(|it| it.microcode().on_tree == 1) {
        show(&mut sim, &instruction);
        sim.set(sim.i.instructions.valid, true);
        while sim.get_u64(sim.i.instructions.ready) == 0 {
            sim.step();
        }
        sim.step();
    }
    sim.set(sim.i.instructions.valid, false);
    while sim.get_u64(sim.o.idle) == 0 {
        sim.step();
    }
    sim.run(rest);
    sim.trace(Vcd::to(&path)).expect("the file can be written");
    sim.run(60);
    sim.finish().expect("the file can be written");
    let text = std::fs::read_to_string(&path).expect("it was written");
    let (_, changes) = text.split_once("$dumpvars").expect("it begins with all values");
    let (_, changes) = changes.split_once("$end").expect("those end");
    let ids = changes.lines().filter(|line| !line.starts_with(['#', '$']) && !line.is_empty());
    let ids: BTreeSet<&str> = ids.map(|line| line.split_once(' ').map_or(&line[1..], |(_, id)| id)).collect();
    ids.len() - 1
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn at_rest_nothing_changes(quadratic in any::<bool>(), coefficient in 0..1u64 << 40) {
        prop_assert_eq!(changes_after(Renderer::REST, quadratic, coefficient), 0);
    }
}

#[test]
fn before_that_something_does() {
    for (quadratic, clocks) in [(false, 40), (true, 55)] {
        assert!(changes_after(clocks, quadratic, 0x80_1234_5678) > 0);
    }
}

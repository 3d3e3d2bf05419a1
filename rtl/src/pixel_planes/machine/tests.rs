//! The machine draws each region as its instructions say, whichever renderer draws it. The crate `tilewright-machines`
//! compares its clocks with those of the transaction model.

use std::collections::VecDeque;

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::model::Model;
use super::super::programs::SMOOTH_LEAST;
use super::super::programs::{clear, save, smooth_least};
use super::super::testing::{primitives, spheres};
use super::*;

const SIDE: u32 = 8;

/// Acts as the host: sends the instructions of each region between a clear and a save.
fn draw(
    machine: &PixelPlanes5,
    regions: &[Vec<Instruction<u64>>],
    side_by_side: bool,
) -> Simulation<PixelPlanes5In, PixelPlanes5Out> {
    let mut sim = Simulation::of(machine).unwrap();
    sim.reset();
    let quiet = |bins: &[VecDeque<Instruction<u64>>], next: Option<u64>| PixelPlanes5In {
        regions: Stream::of(next.is_some().into(), next.unwrap_or(0)),
        bins: bins
            .iter()
            .map(|bin| Stream::of((!bin.is_empty()).into(), *bin.front().unwrap_or(&save(0)[0])))
            .collect(),
        open: (0..).zip(bins).map(|(number, bin)| u64::from(!bin.is_empty()) << number).sum(),
        side_by_side: side_by_side.into(),
        read: ReadLine { enable: 0, region: 0, line: 0 },
    };
    let mut bins = vec![VecDeque::new(); machine.renderers as usize];
    let (mut given, mut planes) = (0, 0);
    while planes < regions.len() * (48 * SIDE) as usize {
        assert!(sim.time() < 1_000_000_000, "the machine hangs");
        sim.drive(quiet(&bins, (given < regions.len()).then_some(given as u64)));
        let ready: Vec<u64> = sim.i.bins.clone().iter().map(|bin| sim.get_u64(bin.ready)).collect();
        let out = sim.read_u64();
        planes += out.plane_goes as usize;
        for (bin, ready) in bins.iter_mut().zip(ready) {
            if ready == 1 {
                bin.pop_front();
            }
        }
        if out.given != 0 {
            let number = out.given.trailing_zeros() as usize;
            assert_eq!((out.given.count_ones(), out.region), (1, given as u64));
            bins[number] = [clear(0x10_20_30), regions[given].clone(), save(given as u32)].concat().into();
            given += 1;
        }
        sim.step();
    }
    sim.drive(quiet(&bins, None));
    sim
}

/// The instructions of a triangle, or of a sphere if renderers evaluate quadratics.
fn drawings(quadratic: bool) -> impl Strategy<Value = Vec<Instruction<u64>>> {
    let triangle = primitives(SIDE).prop_map(|it| smooth_least(SIDE, &it.edges, &it.surface));
    let sphere = spheres(SIDE).prop_map(|it| SMOOTH_LEAST.draw_sphere(SIDE, &it.inside, &it.surface));
    prop_oneof![1 => triangle, u32::from(quadratic) => sphere]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn each_region_is_what_its_instructions_mean(
        (quadratic, regions) in any::<bool>()
            .prop_flat_map(|quadratic| (Just(quadratic), prop::collection::vec(prop::collection::vec(drawings(quadratic), 0..4), 1..6))),
        (renderers, queue, rate) in (1..4u32, 1..9u32, prop_oneof![1..40u32, 100..600u32]),
        side_by_side in any::<bool>(),
    ) {
        let screen = Screen::new(SIDE * regions.len() as u32, SIDE).unwrap();
        let machine = PixelPlanes5 { screen, renderers, side: SIDE, queue, rate, quadratic };
        let regions: Vec<Vec<_>> = regions.iter().map(|drawings| drawings.concat()).collect();
        let mut sim = draw(&machine, &regions, side_by_side);
        for (number, region) in (0u64..).zip(&regions) {
            let mut model = Model::new(SIDE);
            let program = [clear(0x10_20_30), region.clone(), save(number as u32)].concat();
            program.iter().for_each(|instruction| model.run(instruction));
            for (line, words) in (0u64..).zip(model.saved[0].1.chunks(SIDE as usize)) {
                sim.set(sim.i.read.enable, 1);
                sim.set(sim.i.read.region, number);
                sim.set(sim.i.read.line, line);
                sim.step();
                prop_assert_eq!(sim.lanes(sim.o.words), words, "region {}, line {}", number, line);
            }
        }
    }
}

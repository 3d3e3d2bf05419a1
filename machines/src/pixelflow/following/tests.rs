//! The ways of pixels of right frames, and faults that are planted by hand.

use std::collections::BTreeSet;

use tilewright_rtl::pixelflow::ARRAY;
use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_rtl::pixelflow::instruction::Instruction;
use tilewright_rtl::pixelflow::pixel::Source;
use tilewright_rtl::pixelflow::programs::{clear, give_bank, move_word};
use tilewright_scenes::deferred::{Samples, Shading, project_deferred};
use tilewright_scenes::{Scene, Size, project_polygons};
use tilewright_sim::Simulation;

use super::*;
use crate::pixelflow::hardware::ArraySimulation;
use crate::pixelflow::{Config, Machine};
use crate::run::Watch;
use crate::way::{Follower, Way};

fn config(size: Size) -> Config {
    Config { nodes: 4, shaders: 1, array: [8, 8], ..Config::new(size) }
}

/// The way of a pixel of the textured scene, with that many samples.
fn way(samples: Samples, [width, height]: [u32; 2], pixel: [u32; 2]) -> Way {
    let (scene, size) = (Scene::builtin("textured").expect("built in"), Size::new(width, height).expect("in range"));
    let deferred = project_deferred(&scene, size, samples).expect("in front");
    let follower = Follower::new(pixel);
    let machine = Machine::new(config(size)).expect("it can be built").following(&follower);
    machine.render(&deferred, &mut Watch::default()).expect("nobody stops it");
    follower.take().expect("a frame was rendered")
}

#[test]
fn the_way_of_a_right_pixel_is_whole_and_differs_nowhere() {
    let way = way(Samples::One, [16, 12], [8, 6]);
    assert_eq!(way.first_difference(), None);
    let blocks: BTreeSet<&str> = way.steps.iter().map(|step| step.block).collect();
    let expected = [
        "array-controller",
        "communication-registers",
        "compositor",
        "linear-evaluator",
        "pixelflow",
        "pixelflow-frame-buffer",
        "pixelflow-node",
        "pixelflow-pixel",
        "texture-memory",
        "texture-unit",
    ];
    assert_eq!(blocks.into_iter().collect::<Vec<_>>(), expected);
    assert!(way.steps.is_sorted_by_key(|step| step.time));
    assert!(!way.primitives.is_empty() && way.primitives.iter().all(|it| it.golden == it.hardware), "{way:?}");
    assert_eq!(way.primitives.iter().filter(|it| it.wins).count(), 1);
    // Two rasterizers, a shader: the first loads, the second composes, the others pass the word on.
    let lesser = way.steps.iter().filter(|step| step.does == "passes on the lesser of two words").count();
    assert_eq!(lesser, 1);
}

#[test]
fn ways_of_other_systems_differ_nowhere_either() {
    for shading in [Shading::EachSample, Shading::OncePerPixel] {
        let way = way(Samples::Eight(shading), [8, 6], [4, 3]);
        assert_eq!(way.first_difference(), None, "{shading:?}");
        assert!(way.steps.iter().any(|step| step.does == "displays the pixel"));
    }
    let (scene, size) = (Scene::builtin("star").expect("built in"), Size::new(16, 12).expect("in range"));
    let polygons = project_polygons(&scene, size).expect("in front");
    let follower = Follower::new([8, 6]);
    let machine = Machine::new(Config { shaders: 0, ..config(size) }).expect("it can be built").following(&follower);
    machine.render_resident(&polygons, scene.background, &mut Watch::default()).expect("nobody stops it");
    let way = follower.take().expect("a frame was rendered");
    assert!(way.first_difference().is_none() && way.primitives.iter().any(|it| it.wins), "{way:?}");
}

#[test]
fn a_pixel_beyond_the_picture_has_no_way() {
    let (scene, size) = (Scene::builtin("star").expect("built in"), Size::new(16, 12).expect("in range"));
    let deferred = project_deferred(&scene, size, Samples::One).expect("in front");
    let works = Works::deferred(&config(size), &deferred.passes, &deferred.shader).expect("it fits");
    assert!(Pixel::new(&works, [16, 0]).is_none() && Pixel::new(&works, [0, 12]).is_none());
    let last = Pixel::new(&works, [15, 11]).expect("it is there");
    assert_eq!((last.region, last.place.at, last.sample(&works)), (3, [7, 3], [15, 11]));
}

/// The block at which the first difference is, if something happens to the array in a tick.
fn blamed(at: u64, fault: impl Fn(&mut ArraySimulation)) -> Option<&'static str> {
    let array = PixelArray { width: 8, height: 8 };
    let place = Place { chip: 1, pixel: 9, at: [1, 3] };
    let mut observer = ArrayObserver::new("a node", &array, true, place);
    let mut sim = Simulation::of(&array).expect("it can be built");
    sim.set(sim.i.side_by_side, true);
    sim.set(sim.i.bank_done, 0);
    sim.set(sim.i.texture_done, false);
    for port in [sim.i.network[0].writes, sim.i.network[1].writes, sim.i.texture.writes] {
        sim.set(port, false);
    }
    // The network looks at a register of the pixel.
    sim.set(sim.i.network[1].pixel, place.pixel);
    sim.set(sim.i.network[1].address, 3);
    sim.reset();
    let clocks = sim.cycles(ARRAY).expect("there is one");
    while sim.cycles(ARRAY).expect("there is one") == clocks {
        sim.step();
    }
    let sum = Instruction {
        source: Source::Expression as u64,
        skip: 2,
        length: 2,
        a: 700,
        b: 300,
        c: 90_000,
        ..clear(16, 1)[0]
    };
    let moved = [clear(0, 8), move_word(0, 256, 8), clear(288, 4)].concat();
    let mut program: Vec<Instruction<u64>> = [&moved[..], &[sum, give_bank(1)]].concat();
    program.reverse();
    for tick in 0..200 {
        if tick == at {
            fault(&mut sim);
        }
        let next = program.last().copied();
        sim.set(sim.i.instructions.valid, next.is_some());
        if let Some(next) = next {
            sim.set_record(sim.i.instructions.payload, next);
        }
        let is_taken = sim.get_u64(sim.i.instructions.ready) == 1;
        observer.shows(next);
        observer.look(&mut sim, tick, tick % 2 == 1);
        sim.step();
        if tick % 2 == 1 && is_taken {
            program.pop();
        }
    }
    let steps = observer.told.take();
    steps.into_iter().find(Step::differs).map(|step| step.block)
}

#[test]
fn a_fault_is_named_at_the_unit_that_has_it() {
    assert_eq!(blamed(0, |_| {}), None);
    // A byte changes in a pixel after it is cleared, and before it is moved.
    let changes = |path: &'static str, address: u32| {
        move |sim: &mut ArraySimulation| {
            let byte = sim.peek_memory(path, address).expect("it has a memory").to_u64().expect("a byte");
            sim.poke_memory(path, address, byte ^ 1).expect("it has a memory");
        }
    };
    assert_eq!(blamed(32, changes("u_pixel[1][9].memory", 7)), Some("pixelflow-pixel"));
    // A register changes that was just written.
    assert_eq!(blamed(160, changes("u_bank1.by_array[1][9]", 3)), Some("communication-registers"));
    // That of another pixel is none of this one's.
    assert_eq!(blamed(160, changes("u_bank1.by_array[1][8]", 3)), None);
}

#[test]
fn a_fault_in_a_register_is_named_at_its_unit() {
    let changes = |register: &'static str| {
        move |sim: &mut ArraySimulation| {
            let before = sim.checkpoint();
            let forced = before.forced(|name, value| if name == register { value.not() } else { value.clone() });
            assert!(!before.differences(&forced).is_empty(), "there is no {register}");
            sim.restore(&forced).expect("it is the same array");
        }
    };
    // A byte of the expression is under way to the pixel, or to the one beside it.
    assert_eq!(blamed(50, changes("u_evaluator.value_sum[1][9]")), Some("linear-evaluator"));
    assert_eq!(blamed(50, changes("u_evaluator.value_sum[1][8]")), None);
    // A bank is given away too early, or again.
    for at in [50, 100] {
        assert_eq!(blamed(at, changes("u_controller.sent1_given_banks")), Some("array-controller"), "in tick {at}");
    }
}

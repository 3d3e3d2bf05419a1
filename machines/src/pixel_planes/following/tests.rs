//! The ways of pixels of right frames, and faults that are planted by hand.

use std::collections::BTreeSet;

use tilewright_rtl::pixel_planes::PERIOD;
use tilewright_rtl::pixel_planes::instruction::Instruction;
use tilewright_rtl::pixel_planes::linear_tree::Coefficients;
use tilewright_rtl::pixel_planes::programs::{clear, flat, save};
use tilewright_rtl::pixel_planes::renderer::Renderer;
use tilewright_scenes::golden::{Rule, render_polygons};
use tilewright_scenes::{Scene, Size, project_polygons};
use tilewright_sim::Simulation;

use super::observer::{Part, Sim};
use super::*;
use crate::pixel_planes::hardware::show;
use crate::pixel_planes::{Config, Machine};
use crate::run::Watch;
use crate::way::{Follower, Step, Way};

/// The way of a pixel, which has the golden word at its end.
fn way(name: &str, size: [u32; 2], pixel: [u32; 2], config: impl Fn(Config) -> Config) -> Way {
    let (scene, size) = (Scene::builtin(name).expect("built in"), Size::new(size[0], size[1]).expect("in range"));
    let polygons = project_polygons(&scene, size).expect("in front");
    let config = config(Config { renderers: 2, side: 16, ..Config::new(size) });
    let rule = if config.strict { Rule::Strict } else { Rule::Least };
    let follower = Follower::new(pixel);
    let machine = Machine::new(config).expect("it can be built").following(&follower);
    machine.render(&polygons, scene.background, &mut Watch::default()).expect("nobody stops it");
    let way = follower.take().expect("a frame was rendered");
    let word = render_polygons(&polygons, rule, scene.background).words[(pixel[1] * size.width() + pixel[0]) as usize];
    let last = way.steps.last().expect("it has steps");
    assert_eq!((last.unit.as_str(), &last.values[0].hardware), ("picture", &format!("{word:012x}")));
    way
}

#[test]
fn the_way_of_a_right_pixel_is_whole_and_differs_nowhere() {
    let way = way("star", [32, 24], [16, 12], |it| it);
    assert_eq!(way.first_difference(), None);
    let blocks: BTreeSet<&str> = way.steps.iter().map(|step| step.block).collect();
    let expected = [
        "backing-store",
        "frame-buffer",
        "image-generation-controller",
        "linear-tree",
        "pixel-planes-5",
        "pixel-processor",
        "region-allocator",
        "ring",
    ];
    assert_eq!(blocks.into_iter().collect::<Vec<_>>(), expected);
    assert!(way.steps.is_sorted_by_key(|step| step.time));
    assert!(!way.primitives.is_empty() && way.primitives.iter().all(|it| it.golden == it.hardware), "{way:?}");
    assert_eq!(way.primitives.iter().filter(|it| it.wins).count(), 1);
    // Each edge of a primitive at the pixel.
    let number = way.primitives[0].number;
    let is_edge = |step: &&Step| step.primitive == Some(number) && step.values.iter().any(|it| it.what == "sign");
    assert_eq!(way.steps.iter().filter(is_edge).count(), 3);
}

#[test]
fn ways_of_other_machines_differ_nowhere_either() {
    for (name, quadratic, strict, side_by_side) in [("star", false, true, false), ("molecule", true, false, true)] {
        let config = |it| Config { quadratic, strict, side_by_side, side: 8, ..it };
        let way = way(name, [16, 12], [7, 6], config);
        assert_eq!(way.first_difference(), None, "{name}");
        assert!(way.primitives.iter().filter(|it| it.golden.is_some()).all(|it| it.golden == it.hardware), "{way:?}");
    }
    let scene = Scene::builtin("star").expect("built in");
    let size = Size::new(16, 12).expect("in range");
    let polygons = project_polygons(&scene, size).expect("in front");
    let follower = Follower::new([16, 0]);
    let machine = Machine::new(Config { side: 16, ..Config::new(size) }).expect("it can be built").following(&follower);
    machine.render(&polygons, scene.background, &mut Watch::default()).expect("nobody stops it");
    assert!(follower.take().is_none(), "a pixel beyond the picture has no way");
}

/// The block at which the first difference is, if something happens to the renderer in a clock, and the host sends another instruction than it says.
fn blamed(at: u64, fault: impl Fn(&mut Sim), changed: Option<usize>) -> Option<&'static str> {
    let renderer = Renderer { side: 8, queue: 4, quadratic: false };
    let edges = [[3, -2, -5], [-5, 7, 9]].map(|[a, b, c]| Coefficients { a, b, c });
    let program = [clear(0x10_20_30), flat(8, &edges, 0xff), save(6)].concat();
    let part = |instruction| Part { instruction, primitive: None, here: true };
    let mut observer = Observer::new(0, &renderer, true, [3, 2], 6, program.iter().map(part).collect());
    let mut sim = Simulation::at(&renderer, PERIOD).expect("it can be built");
    sim.set(sim.i.side_by_side, true);
    sim.set(sim.o.planes.ready, true);
    sim.set(sim.i.instructions.valid, false);
    sim.reset();
    let mut sent = 0;
    for clock in 0..700 {
        if clock == at {
            fault(&mut sim);
        }
        sim.set(sim.i.instructions.valid, sent < program.len());
        if let Some(&instruction) = program.get(sent) {
            let coefficients = Coefficients { c: instruction.coefficients.c ^ 1, ..instruction.coefficients };
            let other = Instruction { coefficients, ..instruction };
            show(&mut sim, if changed == Some(sent) { &other } else { &instruction });
        }
        let is_taken = sim.get_u64(sim.i.instructions.valid) & sim.get_u64(sim.i.instructions.ready) == 1;
        observer.look(&mut sim, clock);
        sim.step();
        sent += usize::from(is_taken);
    }
    let steps = observer.told.take();
    assert!(steps.iter().any(|step| step.block == "backing-store"));
    steps.iter().filter(|step| step.differs()).min_by_key(|step| step.time).map(|step| step.block)
}

#[test]
fn a_fault_is_named_at_the_unit_that_has_it() {
    assert_eq!(blamed(0, |_| {}, None), None);
    let changes = |path: &'static str, address: u32| {
        move |sim: &mut Sim| {
            let bit = sim.peek_memory(path, address).expect("it has a memory").bit(0);
            sim.poke_memory(path, address, !bit).expect("it has a memory");
        }
    };
    // A bit of the depth changes after it is cleared, and before it is saved.
    assert_eq!(blamed(64, changes("u_pixel[2][3].memory", 30), None), Some("pixel-processor"));
    // That of another pixel is none of this one's.
    assert_eq!(blamed(64, changes("u_pixel[2][4].memory", 30), None), None);
    // A bit of the region changes before the pixel's line is sent.
    assert_eq!(blamed(220, changes("u_store.bits[2][3]", 9), None), Some("backing-store"));
    // The controller gets another instruction than the host's.
    assert_eq!(blamed(0, |_| {}, Some(3)), Some("renderer"));
}

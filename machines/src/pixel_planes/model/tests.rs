//! The model beside the whole machine in RTL, and beside what can be counted by hand.

use std::collections::VecDeque;

use proptest::prelude::*;
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::pixel_planes::instruction::{Instruction, Operation};
use tilewright_rtl::pixel_planes::linear_tree::Coefficients;
use tilewright_rtl::pixel_planes::machine::PixelPlanes5;
use tilewright_rtl::pixel_planes::pixel::Source;
use tilewright_rtl::pixel_planes::programs::{clear, flat, save};
use tilewright_scenes::Size;
use tilewright_sim::Simulation;

use super::*;

/// Handshakes of a whole machine, each by its clock.
#[derive(Debug, Default, PartialEq)]
struct Handshakes {
    /// Of regions: the renderer and the clock.
    given: Vec<(usize, u64)>,
    /// By renderer, of its instructions.
    arrived: Vec<Vec<u64>>,
    /// Of those, from the queue to the controller.
    taken: Vec<Vec<u64>>,
    /// Of its planes.
    planes: Vec<Vec<u64>>,
    /// The clocks in which a renderer becomes idle, by renderer.
    idle: Vec<Vec<u64>>,
}

impl Handshakes {
    fn of(timing: &Timing) -> Handshakes {
        let each = |of: fn(&RendererTiming) -> Vec<u64>| timing.renderers.iter().map(of).collect::<Vec<_>>();
        Handshakes {
            given: timing.regions.iter().map(|it| (it.renderer, it.given)).collect(),
            arrived: each(|it| it.arrived.clone()),
            taken: each(|it| it.taken.clone()),
            planes: each(|it| it.planes.clone()),
            idle: each(idle),
        }
    }
}

/// Clocks in which a renderer becomes idle: its queue shows nothing, and the last bit is gone.
fn idle(timing: &RendererTiming) -> Vec<u64> {
    let mut clocks = Vec::new();
    let mut last = 0;
    for (at, &ended) in timing.ended.iter().enumerate() {
        last = last.max(ended);
        let next = timing.arrived.get(at + 1).map_or(u64::MAX, |arrived| arrived + 1);
        if next > last + 1 {
            clocks.push(last + 1);
        }
    }
    clocks
}

/// Runs the machine in RTL until all planes have been sent, and some clocks longer.
fn simulate(config: &Config, regions: &[Vec<Instruction<u64>>]) -> Handshakes {
    let Config { renderers, side, queue, .. } = *config;
    let screen = Screen::new(side * regions.len() as u32, side).unwrap();
    let machine = PixelPlanes5::new(screen, renderers, side, queue, config.ring().unwrap().rate()).unwrap();
    let mut sim = Simulation::of(&machine).unwrap();
    sim.reset();
    let count = renderers as usize;
    let empty = || vec![Vec::new(); count];
    let mut seen = Handshakes { arrived: empty(), taken: empty(), planes: empty(), idle: empty(), given: Vec::new() };
    let mut bins: Vec<VecDeque<Instruction<u64>>> = vec![VecDeque::new(); count];
    let mut was_idle = u64::MAX;
    let (mut left, mut after) = (regions.len() * (48 * side) as usize, 20);
    for now in 0.. {
        assert!(now < 400_000, "it hangs: {seen:?}");
        let next = seen.given.len();
        sim.set(sim.i.regions.valid, next < regions.len());
        sim.set(sim.i.regions.payload, next as u64);
        sim.set(sim.i.side_by_side, config.side_by_side);
        sim.set(sim.i.open, (0..).zip(&bins).map(|(number, bin)| u64::from(!bin.is_empty()) << number).sum::<u64>());
        for (number, bin) in bins.iter().enumerate() {
            let (valid, p) = (sim.i.bins[number].valid, sim.i.bins[number].payload);
            sim.set(valid, !bin.is_empty());
            let Some(it) = bin.front() else { continue };
            let Coefficients { a, b, c } = it.coefficients;
            let fields = [p.operation, p.skip, p.length, p.read, p.write, p.coefficients.a, p.coefficients.b];
            let values = [it.operation, it.skip, it.length, it.read, it.write, a, b];
            fields.into_iter().zip(values).for_each(|(port, value)| sim.set(port, value));
            sim.set(p.coefficients.c, c);
        }
        let ports: Vec<_> = sim.i.bins.iter().map(|bin| bin.ready).collect();
        let ready: Vec<u64> = ports.into_iter().map(|port| sim.get_u64(port)).collect();
        let out = sim.read_u64();
        for number in 0..count {
            let mut goes = |stream: &str| {
                let mut is = |part: &str| sim.peek(&format!("u_renderer{number}.{stream}_{part}")).unwrap() == 1;
                is("valid") && is("ready")
            };
            if goes("u_controller.instructions") {
                seen.taken[number].push(now);
            }
            if goes("planes") {
                seen.planes[number].push(now);
                left -= 1;
            }
            if ready[number] == 1 && bins[number].pop_front().is_some() {
                seen.arrived[number].push(now);
            }
        }
        let rises = out.idle & !was_idle;
        (0..count).filter(|number| rises >> number & 1 == 1).for_each(|number| seen.idle[number].push(now));
        was_idle = out.idle;
        if out.given != 0 {
            let number = out.given.trailing_zeros() as usize;
            bins[number] = regions[next].iter().copied().collect();
            seen.given.push((number, now));
        }
        if left == 0 {
            after -= 1;
            if after == 0 {
                break;
            }
        }
        sim.step();
    }
    seen
}

fn modelled(config: &Config, regions: &[Vec<Instruction<u64>>]) -> Timing {
    let steps: Vec<Vec<Step>> = regions.iter().map(|program| Step::of(program)).collect();
    Model::new(config).unwrap().run(&steps)
}

/// Any instruction but a save.
fn instructions() -> impl Strategy<Value = Instruction<u64>> {
    let length = prop_oneof![4 => 1..12u64, 1 => 12..65u64];
    (0..Operation::Save as u64, 0..20u64, length).prop_map(|(operation, skip, length)| {
        let coefficients = Coefficients { a: 3, b: 5, c: 7 };
        let whole = Instruction { operation, skip: 0, length, read: 100, write: 100, coefficients };
        let alone = [Operation::Enable, Operation::Disable, Operation::Flag].map(|it| it as u64);
        let length = if alone.contains(&operation) { 1 } else { length };
        // An expression has as many bits as the tree has levels.
        let is_expression = whole.microcode().source == Source::Expression as u64;
        let skip = if is_expression { skip.max(4_u64.saturating_sub(length)) } else { 0 };
        Instruction { skip, length, ..whole }
    })
}

fn programs() -> impl Strategy<Value = Vec<Vec<Instruction<u64>>>> {
    let program =
        prop_oneof![prop::collection::vec(instructions(), 0..4), prop::collection::vec(instructions(), 0..40)];
    prop::collection::vec(program.prop_map(|program| [program, save(0)].concat()), 1..8)
}

fn configs() -> impl Strategy<Value = Config> {
    let ring = prop_oneof![2 => 1..40u32, 3 => 40..160u32, 2 => 160..1000u32].prop_map(|bits| 40 * bits);
    (1..5u32, prop::sample::select(vec![8, 16]), 1..9u32, ring, any::<bool>()).prop_map(
        |(renderers, side, queue, ring, side_by_side)| {
            let size = Size::new(64, 64).unwrap();
            Config { renderers, side, queue, ring, side_by_side, ..Config::new(size) }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Each handshake in its clock: regions, instructions to the queue and to the controller, planes; and when renderers become idle.
    #[test]
    fn the_model_is_the_hardware_clock_for_clock(config in configs(), regions in programs()) {
        let regions: Vec<Vec<_>> = (0..).zip(regions).map(|(number, mut program)| {
            program.last_mut().unwrap().coefficients.c = number;
            program
        }).collect();
        prop_assert_eq!(Handshakes::of(&modelled(&config, &regions)), simulate(&config, &regions));
    }
}

fn config(renderers: u32, side_by_side: bool) -> Config {
    let size = Size::new(64, 64).unwrap();
    Config { renderers, side: 8, ring: Config::AMPLE_RING, side_by_side, ..Config::new(size) }
}

#[test]
fn first_look() {
    let edges = [[64, -64, -300], [-64, 64, 300], [64, 64, -100], [-64, -64, 700]];
    let edges = edges.map(|[a, b, c]| Coefficients { a, b, c });
    for side_by_side in [false, true] {
        for count in [1, 2, 5, 6, 20] {
            let program = [clear(0), vec![flat(8, &edges, 0xff); count].concat(), save(0)].concat();
            let timing = modelled(&config(1, side_by_side), &[program.clone(), program.clone(), program]);
            println!("{side_by_side} {count} {:?} {:?}", timing.regions, timing.first_starved);
        }
    }
}

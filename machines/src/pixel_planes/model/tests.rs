//! The model beside the whole machine in RTL, and beside what can be counted by hand.

use std::collections::VecDeque;

use proptest::prelude::*;
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::pixel_planes::instruction::{Instruction, Operation};
use tilewright_rtl::pixel_planes::linear_tree::Coefficients;
use tilewright_rtl::pixel_planes::machine::PixelPlanes5;
use tilewright_rtl::pixel_planes::pixel::Source;
use tilewright_rtl::pixel_planes::programs::{Edges, Expression, FLAT, Surface, clear, save};
use tilewright_scenes::Size;
use tilewright_sim::Simulation;

use super::super::formulas::first_starved;
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
    let (rate, quadratic) = (config.ring().unwrap().rate, config.quadratic);
    let machine = PixelPlanes5 { screen, renderers, side, queue, rate, quadratic };
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
            if out.takes >> number & 1 == 1 {
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
    (1..5u32, prop::sample::select(vec![8, 16]), 1..9u32, ring, any::<[bool; 2]>()).prop_map(
        |(renderers, side, queue, ring, [side_by_side, quadratic])| {
            let size = Size::new(64, 64).unwrap();
            Config { renderers, side, queue, ring, side_by_side, quadratic, ..Config::new(size) }
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
            // A curve before every other expression.
            let curve = Instruction { operation: Operation::Curve as u64, skip: 0, length: 1, read: 0, write: 0, ..program[0] };
            let is_curved = |it: &Instruction<u64>| config.quadratic && it.skip % 2 == 1;
            program.into_iter().flat_map(|it| is_curved(&it).then_some(curve).into_iter().chain([it])).collect()
        }).collect();
        prop_assert_eq!(Handshakes::of(&modelled(&config, &regions)), simulate(&config, &regions));
    }
}

fn config(renderers: u32, side_by_side: bool) -> Config {
    let size = Size::new(64, 64).unwrap();
    Config { renderers, side: 8, ring: Config::AMPLE_RING, side_by_side, ..Config::new(size) }
}

/// A vector through the whole region, in one colour.
fn vector() -> Vec<Instruction<u64>> {
    let edges = [[64, -64, -300], [-64, 64, 300], [64, 64, -100], [-64, -64, 700]];
    let edges = edges.map(|[a, b, c]| Expression { a, b, c });
    FLAT.draw(8, Edges::Own, &edges, &Surface::of_one_colour(Expression { a: 0, b: 0, c: 0 }, 0xff))
}

fn region_of(primitives: usize) -> Vec<Instruction<u64>> {
    [clear(0), vec![vector(); primitives].concat(), save(0)].concat()
}

/// When all renderers have finished their last region, in hardware.
fn drawn(seen: &Handshakes) -> u64 {
    seen.idle.iter().filter_map(|clocks| clocks.last()).copied().max().unwrap()
}

/// PP5-UT where the ring brings enough: the worst renderer takes N clocks for each of its primitives and so many for each of its regions,
/// from the clock on in which it gets the first one.
#[test]
fn the_update_time_is_that_of_the_worst_renderers_primitives_and_regions() {
    // One at a time N are all clocks of a vector; side by side the last word of a vector is written under the edges of the next one, and
    // of the clear's 48 clocks and the save's, one word runs under edges, too.
    for (side_by_side, overhead) in [(false, Model::REGION_OVERHEAD), (true, Model::REGION_OVERHEAD - 20)] {
        let config = config(2, side_by_side);
        let model = Model::new(&config).unwrap();
        let all: u64 = Step::of(&vector()).iter().map(Step::clocks).sum();
        let n = if side_by_side { all - 23 } else { all };
        assert_eq!(model.clocks_of(&Step::of(&vector())), (n, overhead), "side by side: {side_by_side}");
        // Long enough for the region before to be sent meanwhile: 20 + 15 vectors on renderer 1, 30 on renderer 0.
        let regions = [30, 20, 15].map(region_of);
        let timing = modelled(&config, &regions);
        assert_eq!(timing.first_starved, None);
        assert_eq!(timing.renderers[1].regions, [1, 2]);
        assert_eq!(timing.drawn, 1 + 35 * n + 2 * overhead);
        assert_eq!(drawn(&simulate(&config, &regions)), timing.drawn);
    }
}

/// Where it does not: the first clock by the rate of the ring.
#[test]
fn the_first_clock_without_an_instruction_follows_from_the_rings_rate() {
    let mut never = Vec::new();
    for (renderers, bits) in [(1, 60), (1, 100), (2, 200), (3, 400), (4, 500), (4, 520), (1, 154), (2, 308), (4, 700)] {
        let config = Config { renderers, ring: 40 * bits, queue: 500, ..config(renderers, false) };
        // What clears takes long, so instructions gather in the queue; then each takes less than the ring needs for one.
        let short = Instruction { length: 1, ..clear(0)[0] };
        let program = [clear(0), vec![short; 400], save(0)].concat();
        let clocks: Vec<u64> = Step::of(&program).iter().map(Step::clocks).collect();
        let predicted = first_starved(renderers as usize, bits.into(), &clocks);
        let regions = vec![program; renderers as usize];
        let timing = modelled(&config, &regions);
        assert_eq!(timing.first_starved.map(|it| it.clock), predicted, "{renderers} renderers, {bits} bits a clock");
        // The hardware: the first instruction that is taken as soon as it is seen, though it could have been before.
        let seen = simulate(&config, &regions);
        let starved = (0..renderers as usize).filter_map(|number| {
            let mut wanted = seen.given[number].1 + 2;
            seen.taken[number].iter().zip(&clocks).find_map(|(&taken, clocks)| {
                let is_late = taken > wanted;
                let at = wanted;
                wanted = taken + clocks;
                is_late.then_some(at)
            })
        });
        assert_eq!(starved.min(), predicted, "{renderers} renderers, {bits} bits a clock, in hardware");
        match predicted {
            // Not before the clear is done.
            Some(clock) => assert!(clock > 50, "{clock}"),
            None => never.push((renderers, bits)),
        }
    }
    assert_eq!(never, [(1, 154), (2, 308), (4, 700)]);
}

/// What the ring and the stores make of a frame of equal regions, beside what is counted by hand.
#[test]
fn a_slow_ring_is_loaded_and_makes_renderers_wait() {
    let config = Config { ring: 40 * 4, ..config(2, true) };
    let timing = modelled(&config, &vec![region_of(2); 6]);
    let instructions = 6 * region_of(2).len() as u64;
    assert_eq!((timing.ring.instructions, timing.ring.planes), (instructions, 6 * 48 * 8));
    assert_eq!(timing.ring.bits, 154 * instructions + 8 * timing.ring.planes);
    assert!(timing.ring.load() > 0.7, "{:?}", timing.ring);
    assert!(timing.first_starved.is_some() && timing.renderers.iter().all(|it| it.starved > 0));
    // An ample one brings all in time, but a region is drawn sooner than the one before is sent.
    let timing = modelled(&Config { ring: Config::AMPLE_RING, ..config }, &vec![region_of(2); 6]);
    assert_eq!((timing.first_starved, timing.renderers[0].starved), (None, 0));
    assert!(timing.renderers.iter().all(|it| it.waited_for_store > 0));
}

/// 10^5 primitives of nine instructions in an instant, on 32 renderers.
#[test]
fn many_primitives_are_counted_fast() {
    let steps = [Step::of(&clear(0)), vec![Step::on_tree(20); 9 * 1000], Step::of(&save(0))].concat();
    let config = Config { renderers: 32, side: 128, ..config(32, true) };
    let timing = Model::new(&config).unwrap().run(&vec![steps; 100]);
    assert_eq!(timing.ring.instructions, 100 * 9003);
    // The last renderers have four regions, one after another.
    assert_eq!(timing.first_starved, None);
    assert_eq!(timing.renderers.iter().map(|it| it.regions.len()).max(), Some(4));
}

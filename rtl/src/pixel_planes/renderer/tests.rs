//! The renderer against the meaning of its instructions, and against the integer contract.

use proptest::prelude::*;
use tilewright_sim::{Pauses, Simulation, monitor};

use super::super::instruction::Operation;
use super::super::linear_tree::Coefficients;
use super::super::model::Model;
use super::super::programs::{
    Edges, Expression, FLAT, FLAT_LEAST, FLAT_STRICT, Program, Quadratic, SMOOTH_LEAST, SMOOTH_STRICT, Surface, clear,
    save, smooth_least,
};
use super::super::testing::{Primitive, Shape, Sphere, instructions, polygons, primitives, spheres};
use super::super::{PERIOD, SIDE};
use super::*;

/// The renderer's parameters, and the behaviour of both its neighbours.
#[derive(Debug, Clone, Copy)]
struct Manner {
    quadratic: bool,
    side_by_side: bool,
    queue: u32,
    /// How often sender and receiver pause, in percent.
    pauses: [u64; 2],
    seed: u64,
}

fn manners() -> impl Strategy<Value = Manner> {
    let percent = || prop_oneof![Just(0), 1..60u64];
    (any::<[bool; 2]>(), 1..6u32, [percent(), percent()], any::<u64>()).prop_map(
        |([quadratic, side_by_side], queue, pauses, seed)| Manner { quadratic, side_by_side, queue, pauses, seed },
    )
}

/// Runs instructions in a renderer; returns the regions that it sends, each with its pixels' words line by line.
fn sent(side: u32, instructions: &[Instruction<u64>], manner: Manner) -> Vec<(u64, Vec<u64>)> {
    let renderer = Renderer { side, queue: manner.queue, quadratic: manner.quadratic };
    let mut sim = Simulation::of(&renderer).unwrap().seeded(manner.seed);
    sim.reset();
    sim.set(sim.i.side_by_side, u64::from(manner.side_by_side));
    let is_save = |instruction: &&Instruction<u64>| instruction.operation == Operation::Save.code();
    let regions = instructions.iter().filter(is_save).count();
    let (i, o) = (sim.i, sim.o);
    let t = sim.testbench();
    t.limit(1_000_000);
    let send = async {
        let mut pauses = Pauses::percent(manner.pauses[0], manner.seed);
        for instruction in instructions {
            t.wait(pauses.next_length().into()).await;
            t.send(i.instructions, *instruction).await;
        }
    };
    let receive = async {
        let mut pauses = Pauses::percent(manner.pauses[1], manner.seed.wrapping_add(1));
        let mut received = Vec::new();
        for _ in 0..regions {
            let mut words = vec![0; (side * side) as usize];
            let mut region = 0;
            for line in 0..side {
                for plane in 0..48 {
                    t.wait(pauses.next_length().into()).await;
                    let sent = t.receive_bits(o.planes).await;
                    let [sent_line, sent_plane, number] = [&sent.line, &sent.plane, &sent.region].map(Bits::to_u64);
                    assert_eq!([sent_line, sent_plane], [Some(line.into()), Some(plane)]);
                    region = number.unwrap();
                    for x in 0..side {
                        words[(line * side + x) as usize] |= u64::from(sent.bits.bit(x)) << plane;
                    }
                }
            }
            received.push((region, words));
        }
        t.until(o.idle).await;
        t.expect_silence(o.planes, 60).await;
        received
    };
    t.run((send, receive, monitor(t.holds_bits(o.planes)))).1
}

fn constant(operation: Operation, write: u64, length: u64) -> Instruction<u64> {
    let coefficients = Coefficients { a: 0, b: 0, c: 0x5a_0ff0_12b5 };
    Instruction { operation: operation.code(), skip: 0, length, read: 0, write, coefficients }
}

/// Gives every bit of memory a value, because a reset does not, and clears both flags.
fn filled() -> Vec<Instruction<u64>> {
    let words = [(0, 64), (64, 64), (128, 64), (192, 16)];
    let words = words.map(|(write, length)| constant(Operation::Fill, write, length));
    [&words[..], &[constant(Operation::Disable, 0, 1), constant(Operation::Flag, 0, 1)]].concat()
}

/// Sends all of the memory.
fn all_memory() -> Vec<Instruction<u64>> {
    let parts = [0, 48, 96, 144, 160];
    parts
        .into_iter()
        .flat_map(|read| save(read as u32).into_iter().map(move |part| Instruction { read, ..part }))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever overlaps, memory and flags end as if each instruction began when its predecessor had ended.
    #[test]
    fn instructions_do_what_they_do_one_after_another(
        (side, program, manner) in (prop::sample::select(vec![2, 4, 8]), manners()).prop_flat_map(|(side, manner)| {
            (Just(side), prop::collection::vec(instructions(side, manner.quadratic), 1..60), Just(manner))
        }),
    ) {
        // The last instructions write the flags to memory, too.
        let enable = Instruction { skip: 7, ..constant(Operation::EvaluateEnabled, 207, 1) };
        let flags = vec![constant(Operation::FillFlagged, 206, 1), enable];
        let program = [filled(), program, flags, all_memory()].concat();
        let mut model = Model::new(side);
        program.iter().for_each(|instruction| model.run(instruction));
        prop_assert_eq!(sent(side, &program, manner), model.saved);
    }
}

/// A rule, the program that implements it, and what a pixel keeps of its word and a fragment's.
#[derive(Debug, Clone, Copy)]
struct Rule {
    program: &'static Program,
    word: fn(&Shape, u32, u32) -> u64,
    keeps: fn(u64, u64) -> u64,
}

impl Rule {
    fn draw(&self, side: u32, form: Edges, shape: &Shape) -> Vec<Instruction<u64>> {
        let program = self.program;
        match shape {
            Shape::Polygon(Primitive { edges, surface, rgb }) => {
                let flat = Surface::of_one_colour(surface.z, *rgb);
                program.draw(side, form, edges, if program.is_flat { &flat } else { surface })
            }
            Shape::Sphere(Sphere { inside, surface, rgb }) => {
                let flat = Surface::of_one_colour(surface.z, *rgb);
                program.draw_sphere(side, inside, if program.is_flat { &flat } else { surface })
            }
        }
    }
}

fn nearest(kept: u64, new: u64) -> u64 {
    if new >> 24 < kept >> 24 { new } else { kept }
}

const RULES: [Rule; 5] = [
    Rule {
        program: &FLAT,
        word: |shape, x, y| shape.flat_word(x, y) & 0xff_ffff,
        keeps: |kept, new| kept >> 24 << 24 | new,
    },
    Rule { program: &FLAT_STRICT, word: Shape::flat_word, keeps: nearest },
    Rule { program: &FLAT_LEAST, word: Shape::flat_word, keeps: u64::min },
    Rule { program: &SMOOTH_STRICT, word: Shape::smooth_word, keeps: nearest },
    Rule { program: &SMOOTH_LEAST, word: Shape::smooth_word, keeps: u64::min },
];

/// Triangles, and polygons of up to eight edges; spheres, if the renderer evaluates quadratics.
fn any_shape(side: u32, quadratic: bool) -> impl Strategy<Value = Shape> {
    prop_oneof![
        1 => primitives(side).prop_map(Shape::Polygon),
        1 => polygons(side).prop_map(Shape::Polygon),
        if quadratic { 4 } else { 0 } => spheres(side).prop_map(Shape::Sphere),
    ]
}

/// The words of a region by the contract: a plain loop over pixels.
fn drawn(side: u32, background: u32, rule: Rule, shapes: &[Shape]) -> Vec<u64> {
    let pixels = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    let word = |(x, y)| {
        let fragments = shapes.iter().filter(|shape| shape.covers(x, y)).map(|shape| (rule.word)(shape, x, y));
        fragments.fold(0xff_ffff << 24 | u64::from(background), rule.keeps)
    };
    pixels.map(word).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Regions one after another, each read while the next is drawn.
    #[test]
    fn a_region_is_what_the_contract_says(
        (side, regions, manner) in (prop_oneof![Just(8u32), Just(16)], manners()).prop_flat_map(|(side, manner)| {
            let shapes = prop::collection::vec(any_shape(side, manner.quadratic), 0..8);
            (Just(side), prop::collection::vec(shapes, 1..4), Just(manner))
        }),
        rule in prop::sample::select(RULES.to_vec()),
        form in prop::sample::select(Edges::ALL.to_vec()),
    ) {
        let mut program = Vec::new();
        let mut expected = Vec::new();
        for (number, shapes) in (40..).zip(&regions) {
            program.extend(clear(0x10_20_30));
            program.extend(shapes.iter().flat_map(|shape| rule.draw(side, form, shape)));
            program.extend(save(number));
            expected.push((number.into(), drawn(side, 0x10_20_30, rule, shapes)));
        }
        prop_assert_eq!(sent(side, &program, manner), expected);
    }
}

/// The machine's own size, with triangles that cover much of it.
#[test]
fn a_region_of_128_x_128_pixels_is_what_the_contract_says() {
    let edge = |a, b, c| Coefficients { a, b, c };
    let plane = |a, b, c: i64| Coefficients { a, b, c: c << 16 };
    let primitive = |edges: [Expression; 3], depth| Primitive {
        edges: edges.to_vec(),
        surface: Surface { z: depth, rgb: [plane(90_000, 0, 9), plane(0, 80_000, 7), plane(-40_000, 30_000, 99)] },
        rgb: 0,
    };
    let primitives = [
        primitive([edge(1, 0, -3), edge(0, 1, -5), edge(-1, -2, 250)], plane(1 << 16, 0, 1000)),
        primitive([edge(-1, 0, 120), edge(0, -1, 125), edge(300, 200, -40_000)], plane(-(1 << 16), 0, 1140)),
    ];
    let program = primitives.iter().flat_map(|primitive| smooth_least(SIDE, &primitive.edges, &primitive.surface));
    let program = [clear(0x20_40_60), program.collect(), save(5)].concat();
    let words = drawn(SIDE, 0x20_40_60, RULES[4], &primitives.map(Shape::Polygon));
    let far = words.iter().filter(|word| **word >> 24 == 0xff_ffff).count();
    assert!((2000..8000).contains(&far), "{far} pixels show the background");
    let manner = Manner { quadratic: false, side_by_side: true, queue: 16, pauses: [0, 0], seed: 1 };
    assert_eq!(sent(SIDE, &program, manner), [(5, words)]);
}

/// The machine's own size, with spheres that intersect.
#[test]
fn spheres_in_a_region_of_128_x_128_pixels_are_what_the_contract_says() {
    let ball = |[x, y]: [i64; 2], radius: i64, depth: i64, shades: [i64; 3]| {
        let inside = Quadratic { a: 0, b: 0, c: radius * radius, d: -1, e: 0, f: -1 };
        let over =
            |at_edge: i64, times: i64| Quadratic { c: inside.c * times + (at_edge << 16), ..inside.times(times) };
        let surface = Surface { z: over(depth, -9000), rgb: shades.map(|shade| over(30, shade)) };
        let moved = |of: Quadratic| of.moved([-x, -y]);
        let surface = Surface { z: moved(surface.z), rgb: surface.rgb.map(moved) };
        Sphere { inside: moved(inside.times(1 << 22)), surface, rgb: 0 }
    };
    let balls = [
        ball([50, 60], 45, 900, [5000, 900, 0]),
        ball([90, 70], 40, 880, [0, 4000, 7000]),
        ball([120, 0], 30, 870, [1; 3]),
    ];
    let draw = |ball: &Sphere| SMOOTH_LEAST.draw_sphere(SIDE, &ball.inside, &ball.surface);
    let program = [clear(0x20_40_60), balls.iter().flat_map(draw).collect(), save(5)].concat();
    let words = drawn(SIDE, 0x20_40_60, RULES[4], &balls.map(Shape::Sphere));
    let far = words.iter().filter(|word| **word >> 24 == 0xff_ffff).count();
    assert!((4000..10_000).contains(&far), "{far} pixels show the background");
    let manner = Manner { quadratic: true, side_by_side: true, queue: 16, pauses: [0, 0], seed: 1 };
    assert_eq!(sent(SIDE, &program, manner), [(5, words)]);
}

/// PP5-UT: N clocks for each primitive, and the same start-up for any number of them. The clocks of programs are tested
/// with the controller.
#[test]
fn the_array_never_waits_while_the_queue_has_instructions() {
    let edge = |a, b, c| Coefficients { a, b, c };
    let edges = [edge(64, -64, -300), edge(-64, 64, 300), edge(64, 64, -100), edge(-64, -64, 700)];
    let surface = Surface::of_one_colour(edge(1 << 16, 0, 1000 << 16), 0xff);
    let program = FLAT_STRICT.draw(8, Edges::Own, &edges, &surface);
    let clocks = |primitives: usize, side_by_side: u64| {
        let mut sim = Simulation::at(&Renderer { side: 8, queue: 6, quadratic: false }, PERIOD).unwrap();
        sim.reset();
        sim.set(sim.i.side_by_side, side_by_side);
        let start = sim.time();
        let (i, o) = (sim.i, sim.o);
        let t = sim.testbench();
        t.run((async {
            for instruction in vec![program.clone(); primitives].concat() {
                t.send(i.instructions, instruction).await;
            }
            t.until(o.idle).await;
            (t.time() - start) / PERIOD.picoseconds()
        },))
            .0
    };
    let bits: u64 = edges.iter().map(|edge| u64::from(Edges::Own.bits(8, edge))).sum();
    for (side_by_side, n) in [(0, bits + 40 + 24 + 24), (1, bits + 40 + 2)] {
        let start_up = clocks(1, side_by_side) - n;
        for primitives in [2, 3, 20] {
            assert_eq!(clocks(primitives, side_by_side), start_up + n * primitives as u64);
        }
    }
}

/// Facts E3: the next region is drawn while one is sent, S bits a clock; only its save waits.
#[test]
fn a_region_is_sent_in_48_clocks_a_line_while_the_next_is_drawn() {
    let mut sim = Simulation::at(&Renderer { side: 8, queue: 4, quadratic: false }, PERIOD).unwrap();
    sim.reset();
    let (i, o) = (sim.i, sim.o);
    sim.set(i.side_by_side, 1);
    sim.set(o.planes.ready, 1);
    let t = sim.testbench();
    let send = async {
        for instruction in [clear(1), save(1), clear(2), save(2)].concat() {
            t.send(i.instructions, instruction).await;
        }
    };
    let watch = async {
        let mut clocks = Vec::new();
        for _ in 0..2 * 48 * 8 {
            t.receive(o.planes).await;
            clocks.push(t.time() / 25_000);
        }
        clocks
    };
    let ((), clocks) = t.run((send, watch));
    let region = 48 * 8;
    let is_without_pause = |clocks: &[u64]| clocks.last().unwrap() - clocks[0] == region - 1;
    assert!(clocks.chunks(region as usize).all(is_without_pause));
    // Between them the store is free, and the planes of the second region are read and pass the pixels' pipeline. The
    // region's clear ended long before.
    let between = clocks[region as usize] - clocks[region as usize - 1];
    assert_eq!(between, 1 + 48 + u64::from(LinearTree { side: 8 }.latency()) + 2);
}

#[test]
fn there_is_no_renderer_of_any_other_side() {
    let complaint = |side, queue| Renderer { side, queue, quadratic: false }.checked().unwrap_err().to_string();
    for side in [0, 1, 12, 512] {
        let sentence = format!("`side` of `Renderer` is {side}: it has to be a power of two, from 2 to 256");
        assert_eq!(complaint(side, 8), sentence);
    }
    assert_eq!(complaint(8, 0), "`queue` of `Renderer` is 0: it has to be from 1 to 4096");
    for side in (1..9).map(|level| 1 << level) {
        for quadratic in [false, true] {
            let renderer = Renderer { side, queue: 8, quadratic };
            assert_eq!(elaborate(&renderer).unwrap().modules().len(), 6);
        }
    }
}

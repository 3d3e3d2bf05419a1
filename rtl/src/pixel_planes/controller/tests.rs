//! The controller clock by clock, the clocks of a primitive, and the instructions that it refuses.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::pixel::{Enabling, Mask};
use super::super::programs::{
    Edges, Expression, FLAT, FLAT_LEAST, FLAT_STRICT, Program, Quadratic, SMOOTH_LEAST, SMOOTH_STRICT, Surface, save,
};
use super::super::schedule::{Schedule, Step, Times};
use super::super::testing::instructions;
use super::*;

type Controller = Simulation<ImageGenerationControllerIn, ImageGenerationControllerOut>;

fn started(side: u32) -> Controller {
    started_with(ImageGenerationController { side, quadratic: false })
}

fn started_with(controller: ImageGenerationController) -> Controller {
    let mut sim = Simulation::of(&controller).unwrap();
    sim.reset();
    sim.set(sim.i.store_free, 1);
    sim.set(sim.i.side_by_side, 1);
    sim
}

fn instruction(operation: Operation, skip: u64, length: u64, write: u64) -> Instruction<u64> {
    let coefficients = Coefficients { a: 0, b: 0, c: 0b0101 };
    Instruction { operation: operation.code(), skip, length, read: 9, write, coefficients }
}

/// Offers instructions one after another for `clocks` clocks; returns the clocks in which they are taken.
fn run(sim: &mut Controller, instructions: &[Instruction<u64>], clocks: u64) -> Vec<u64> {
    watched(sim, instructions, clocks, |_, _| {})
}

/// Like [`run`]; `look` gets the outputs of each clock.
fn watched(
    sim: &mut Controller,
    instructions: &[Instruction<u64>],
    clocks: u64,
    mut look: impl FnMut(u64, ImageGenerationControllerOut<u64>),
) -> Vec<u64> {
    let (i, mut taken) = (sim.i, Vec::new());
    for clock in 0..clocks {
        let next = instructions.get(taken.len());
        sim.set(i.instructions.valid, u64::from(next.is_some()));
        if let Some(next) = next {
            let leaves = [next.operation, next.skip, next.length, next.read, next.write];
            let Coefficients { a, b, c } = next.coefficients;
            let p = i.instructions.payload;
            let ports = [p.operation, p.skip, p.length, p.read, p.write];
            ports.into_iter().zip(leaves).for_each(|(port, value)| sim.set(port, value));
            [(p.coefficients.a, a), (p.coefficients.b, b), (p.coefficients.c, c)]
                .into_iter()
                .for_each(|(port, value)| sim.set(port, value));
            if sim.get_u64(i.instructions.ready) == 1 {
                taken.push(clock);
            }
        }
        look(clock, sim.read_u64());
        sim.step();
    }
    taken
}

#[test]
fn the_control_of_pixels_comes_with_the_expression() {
    let mut sim = started(2);
    let signals = [
        "instructions_valid",
        "instructions_ready",
        "first",
        "coefficients_c",
        "tree_left",
        "memory_left",
        "control_mask",
        "control_write",
        "control_first",
        "control_enabling",
    ];
    let wave = sim.record(signals);
    let program = [
        instruction(Operation::Add, 1, 3, 20),
        instruction(Operation::Fill, 0, 3, 30),
        // The two skipped bits need no memory.
        instruction(Operation::TestLast, 2, 1, 0),
    ];
    run(&mut sim, &program, 14);
    wave.expect(
        r"
        clk                |~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        instructions_valid |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\______________________
        instructions_ready |~~~~~~~~~~\________________________________/~~~~~~~~~~~~~~~~~~~~~\______________________
        first              |__________/~~~~~~~~~~\___________________________________________/~~~~~~~~~~\___________
        coefficients_c     |__________/~~~~~~~~~~\__________/~~~~~~~~~~\_____________________/~~~~~~~~~~\___________
        tree_left          | 0        | 4        | 3        | 2        | 1        | 0        | 3        | 2        |
        memory_left        | 0                                                    | 3        | 2        | 1        |
        control_mask       | Nobody                                    | Enabled                        | Everyb.. |
        control_write      | 0                              | 14                  | 15       | 16       | 1e       |
        control_first      |___________________________________________/~~~~~~~~~~\_________________________________
        control_enabling   | Keep                                                                                  |

        clk                |~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        instructions_valid |__________________________________________________________________
        instructions_ready |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        first              |__________________________________________________________________
        coefficients_c     |~~~~~~~~~~\_______________________________________________________
        tree_left          | 1        | 0                                                    |
        memory_left        | 0                                                               |
        control_mask       | Everybody           | Nobody                                    |
        control_write      | 1f       | 20       | 0        | 1                              |
        control_first      |__________________________________________________________________
        control_enabling   | Keep                | Restrict | Keep                           |
        ",
    );
}

#[test]
fn one_at_a_time_each_begins_with_the_last_bit_of_the_one_before() {
    let mut sim = started(2);
    sim.set(sim.i.side_by_side, 0);
    let program = [
        instruction(Operation::Test, 4, 1, 0),
        instruction(Operation::Fill, 0, 3, 30),
        instruction(Operation::Evaluate, 5, 2, 0),
        instruction(Operation::Copy, 0, 64, 64),
        instruction(Operation::Enable, 0, 1, 0),
    ];
    assert_eq!(run(&mut sim, &program, 80), [0, 5, 8, 15, 79]);
}

#[test]
fn side_by_side_only_what_meets_waits() {
    let taken = |program: &[Instruction<u64>]| run(&mut started(2), program, 100);
    let copy = instruction(Operation::CopyFlagged, 0, 40, 64);
    // A test need not wait. A word of memory must wait. So must a capture into the flag that the copy uses: it is taken
    // with the copy's last bit.
    assert_eq!(taken(&[copy, instruction(Operation::Test, 9, 1, 0)]), [0, 1]);
    assert_eq!(taken(&[copy, instruction(Operation::Evaluate, 16, 8, 0)]), [0, 24]);
    assert_eq!(taken(&[copy, instruction(Operation::TestLast, 9, 1, 0)]), [0, 31]);
    assert_eq!(taken(&[copy, instruction(Operation::Flag, 0, 1, 0)]), [0, 40]);
    assert_eq!(taken(&[copy, instruction(Operation::Enable, 0, 1, 0)]), [0, 1]);
    // An instruction waits until the word before it has reached the memory.
    assert_eq!(taken(&[instruction(Operation::Evaluate, 16, 8, 0), copy]), [0, 24]);
    assert_eq!(taken(&[instruction(Operation::TestLast, 9, 1, 0), copy]), [0, 10]);
    assert_eq!(taken(&[instruction(Operation::Test, 9, 1, 0), copy]), [0, 1]);
}

#[test]
fn a_region_is_saved_when_the_store_is_free() {
    let mut sim = started(8);
    sim.set(sim.i.store_free, 0);
    let program = save(77);
    assert_eq!(run(&mut sim, &program, 9), []);
    assert_eq!(sim.get_u64(sim.o.save.claim), 0);
    sim.set(sim.i.store_free, 1);
    assert_eq!([sim.get_u64(sim.o.save.claim), sim.get_u64(sim.o.save.region)], [1, 77]);
    // The planes arrive when the pixels have read them, 2 log2 S clocks after the controller's signal.
    let planes: Vec<u64> = (0..60)
        .map(|clock| {
            let taken = run(&mut sim, &program[..usize::from(clock == 0)], 1);
            assert_eq!(taken.len(), usize::from(clock == 0));
            sim.get_u64(sim.o.save.plane)
        })
        .collect();
    let [idle, busy] = [0, 1].map(|plane| move |count: usize| vec![plane; count]);
    assert_eq!(planes, [idle(6), busy(48), idle(6)].concat());
}

/// Clocks from the first instruction of a primitive to that of the next, for many equal primitives (PP5-UT).
fn clocks(program: &[Instruction<u64>], side_by_side: u64) -> u64 {
    clocks_of(false, program, side_by_side)
}

/// Like [`clocks`], for a controller that may take curves.
fn clocks_of(quadratic: bool, program: &[Instruction<u64>], side_by_side: u64) -> u64 {
    const MANY: usize = 6;
    let mut sim = started_with(ImageGenerationController { side: 128, quadratic });
    sim.set(sim.i.side_by_side, side_by_side);
    let taken = run(&mut sim, &vec![program.to_vec(); MANY].concat(), 2000);
    assert_eq!(taken.len(), MANY * program.len());
    let begins: Vec<u64> = taken.iter().step_by(program.len()).copied().collect();
    let [.., before, last] = begins[..] else { unreachable!("there are six primitives") };
    assert_eq!(last - before, before - begins[MANY - 3], "the clocks of a primitive are constant");
    last - before
}

/// Edges through the region, with this number of bits in their values there.
fn edges(count: u32, bits: u32) -> Vec<Expression> {
    let c = -1 << (bits - 4);
    (0..count).map(|_| Coefficients { a: 1 << (bits - 9), b: -1 << (bits - 9), c }).collect()
}

/// Facts E3: vectors of four edges of 15 bits, triangles of three of 16, on 128 x 128 pixels.
#[test]
fn a_primitive_takes_the_clocks_of_its_edges_and_planes() {
    const SIDE: u32 = 128;
    let plane = Coefficients { a: 70_000, b: -50_000, c: 1 << 30 };
    let surface = Surface { z: plane, rgb: [plane; 3] };
    let (vector, triangle) = (edges(4, 15), edges(3, 16));
    let both = |program: &Program, edges: &[Expression]| {
        let program = program.draw(SIDE, Edges::Own, edges, &surface);
        [clocks(&program, 0), clocks(&program, 1)]
    };
    assert_eq!(both(&FLAT, &vector), [60 + 24, 61]);
    assert_eq!(both(&FLAT_STRICT, &vector), [60 + 40 + 24 + 24, 102]);
    assert_eq!(both(&FLAT_LEAST, &vector), [60 + 24 + 40 + 48, 102]);
    assert_eq!(both(&SMOOTH_STRICT, &triangle), [48 + 40 + 72 + 24, 161]);
    assert_eq!(both(&SMOOTH_LEAST, &triangle), [48 + 72 + 40 + 48, 161]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Each bit of each instruction comes in its clock, and nothing comes in any other clock.
    #[test]
    fn every_bit_comes_in_its_clock(
        (quadratic, program) in any::<bool>()
            .prop_flat_map(|quadratic| (Just(quadratic), prop::collection::vec(instructions(8, quadratic), 1..30))),
        side_by_side in any::<bool>(),
        seed in any::<u64>(),
    ) {
        let late = if quadratic { 12 } else { 6 };
        let mut sim = Simulation::of(&ImageGenerationController { side: 8, quadratic }).unwrap().seeded(seed);
        sim.reset();
        sim.set(sim.i.store_free, 1);
        sim.set(sim.i.side_by_side, u64::from(side_by_side));
        let mut schedule = Schedule::new(side_by_side);
        let times: Vec<Times> = Step::of(&program).iter().map(|step| schedule.take(step)).collect();
        let end = times.iter().map(|it| it.ends).max().unwrap();
        let mut seen = Vec::new();
        let taken = watched(&mut sim, &program, end + late + 2, |_, out| seen.push(out));
        prop_assert_eq!(taken, times.iter().map(|it| it.taken).collect::<Vec<_>>());

        let nothing = Control {
            source: 0, constant: 0, adds: 0, first: 0, mask: Mask::Nobody.code(), compares: 0, gates: 0,
            enabling: Enabling::Keep.code(), captures: 0, read: 0, write: 0,
        };
        // The control of the pixels in each clock, as far as it has an effect.
        let mut expected = vec![nothing; seen.len()];
        let mut first = vec![0; seen.len()];
        let mut curve = [0; 3];
        for (next, Times { begins, .. }) in program.iter().zip(&times) {
            let code = Operation::ALL[next.operation as usize].microcode();
            let is_expression = code.source == Source::Expression.code();
            let Coefficients { a, b, c } = next.coefficients;
            let bends = if is_expression { std::mem::take(&mut curve) } else { [0; 3] };
            if next.operation == Operation::Curve.code() {
                curve = [a, b, c];
            }
            for at in 0..next.skip + next.length {
                let clock = (begins + at) as usize;
                if is_expression {
                    first[clock] = u64::from(at == 0);
                    let bit = |number: u64| ((number << 24) as i64 >> 24 >> at.min(63)) as u64 & 1;
                    let out = seen[clock].coefficients;
                    prop_assert_eq!([out.a, out.b, out.c], [a, b, c].map(bit));
                    let curves: Vec<_> = seen[clock].curve.iter().map(|out| [out.d, out.e, out.f]).collect();
                    prop_assert_eq!(curves, vec![bends.map(bit); usize::from(quadratic)]);
                }
                let Some(bit) = at.checked_sub(next.skip) else { continue };
                let is_last = bit + 1 == next.length;
                let control = &mut expected[clock + late as usize];
                if code.on_memory == 1 {
                    *control = Control {
                        source: code.source,
                        adds: code.adds,
                        first: u64::from(bit == 0) & code.begins,
                        mask: code.mask,
                        compares: code.compares,
                        gates: code.gates,
                        read: next.read + bit,
                        write: next.write + bit,
                        ..*control
                    };
                    if code.source == Source::Constant.code() && code.on_tree == 0 {
                        control.constant = ((next.coefficients.c << 24) as i64 >> 24 >> bit.min(63)) as u64 & 1;
                    }
                }
                if is_last && code.on_tree == 1 {
                    (control.enabling, control.captures) = (code.enabling, code.captures);
                }
            }
        }
        for (clock, (out, expected)) in seen.iter().zip(&expected).enumerate() {
            prop_assert_eq!(out.first, first[clock], "clock {}", clock);
            // The fields that have an effect, whatever the others are.
            let does = |c: Control<u64>| {
                let writes = c.mask != Mask::Nobody.code();
                let works = writes || c.compares == 1;
                let reads = c.source == Source::Memory.code() || c.adds == 1 || c.compares == 1;
                [
                    c.mask, c.adds, c.compares, c.enabling, c.captures,
                    if works { c.source } else { 0 },
                    if works && c.source == Source::Constant.code() { c.constant } else { 0 },
                    if c.adds == 1 || c.compares == 1 { c.first } else { 0 },
                    if c.compares == 1 { c.gates } else { 0 },
                    if works && reads { c.read } else { 0 },
                    if writes { c.write } else { 0 },
                ]
            };
            prop_assert_eq!(does(out.control), does(*expected), "clock {}", clock);
            prop_assert_eq!([out.save.plane, out.save.claim], [0, 0]);
            // Nothing from before the reset is left.
            prop_assert!(clock as u64 >= late || out.control == nothing, "clock {}", clock);
        }
        prop_assert_eq!(seen.last().unwrap().idle, 1);
    }
}

#[test]
fn a_curve_is_of_the_next_expression_alone_whatever_comes_between() {
    let mut sim = started_with(ImageGenerationController { side: 2, quadratic: true });
    let wave = sim.record(["instructions_ready", "tree_left", "first", "coefficients_c", "curve_0_d", "curve_0_f"]);
    let curve = Coefficients { a: 0b101_0011, b: 0, c: 0b11_0110 };
    let program = [
        Instruction { coefficients: curve, ..instruction(Operation::Curve, 0, 1, 0) },
        instruction(Operation::Flag, 0, 1, 0),
        instruction(Operation::Fill, 0, 2, 30),
        instruction(Operation::Evaluate, 0, 4, 0),
        instruction(Operation::Test, 2, 1, 0),
    ];
    run(&mut sim, &program, 12);
    wave.expect(
        r"
        clk                |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        instructions_ready |~~~~~~~~~~~\___/~~~\___________/~~~\_______/~~~~
        tree_left          | 0 | 1     | 0     | 4 | 3 | 2 | 1 | 3 | 2 | 1 |
        first              |___________________/~~~\___________/~~~\________
        coefficients_c     |_______/~~~\___/~~~~~~~\___/~~~\___/~~~\___/~~~~
        curve_0_d          |___________________/~~~~~~~\____________________
        curve_0_f          |_______________________/~~~~~~~\________________
        ",
    );
}

/// A sphere in 128 x 128 pixels: the bits of its silhouette, the words of its planes, and a clock for each curve.
#[test]
fn a_sphere_takes_the_clocks_of_its_silhouette_and_its_planes() {
    const SIDE: u32 = 128;
    let sphere = Quadratic { a: 0, b: 0, c: 60 * 60, d: -1, e: 0, f: -1 }.moved([-64, -64]);
    let z = Quadratic { c: 1000 << 16, ..sphere.times(-9000) };
    let surface = Surface { z, rgb: [sphere.times(3000); 3] };
    let flat = Surface::of_one_colour(z, 0xff);
    for n in [24, 37] {
        let inside = sphere.times(1 << (n - 14));
        assert_eq!(inside.bits(SIDE), n);
        let n = u64::from(n);
        let both = |program: &Program| {
            let program = program.draw_sphere(SIDE, &inside, if program.is_flat { &flat } else { &surface });
            [0, 1].map(|side_by_side| clocks_of(true, &program, side_by_side))
        };
        assert_eq!(both(&FLAT), [n + 26, n + 3]);
        assert_eq!(both(&FLAT_STRICT), [n + 90, (n + 44).max(72)]);
        assert_eq!(both(&FLAT_LEAST), [n + 114, 96]);
        assert_eq!(both(&SMOOTH_STRICT), [n + 141, n + 118]);
        assert_eq!(both(&SMOOTH_LEAST), [n + 165, (n + 118).max(147)]);
    }
}

fn taken_wrongly(wrong: Instruction<u64>) {
    run(&mut started(16), &[wrong], 2);
}

#[test]
#[should_panic(expected = "an expression has at least as many bits as each tree has levels")]
fn a_short_expression_is_an_error() {
    taken_wrongly(instruction(Operation::Evaluate, 0, 3, 0));
}

#[test]
#[should_panic(expected = "a word has 1 to 64 bits")]
fn an_empty_word_is_an_error() {
    taken_wrongly(instruction(Operation::Fill, 0, 0, 0));
}

#[test]
#[should_panic(expected = "only an expression has bits to skip")]
fn what_skips_without_an_expression_is_an_error() {
    taken_wrongly(instruction(Operation::Copy, 1, 8, 0));
}

#[test]
#[should_panic(expected = "a whole word is saved, as planes 0 to 47")]
fn a_part_of_a_word_that_is_saved_is_an_error() {
    taken_wrongly(instruction(Operation::Save, 0, 24, 0));
}

#[test]
#[should_panic(expected = "a whole word is saved, as planes 0 to 47")]
fn a_word_that_is_saved_as_other_planes_is_an_error() {
    taken_wrongly(instruction(Operation::Save, 0, 48, 1));
}

#[test]
#[should_panic(expected = "a word is within the memory of 208 bits")]
fn a_word_that_reaches_beyond_the_memory_is_an_error() {
    taken_wrongly(instruction(Operation::Fill, 0, 9, 200));
}

#[test]
#[should_panic(expected = "the code of an instruction is an operation")]
fn a_code_that_is_no_operation_is_an_error() {
    taken_wrongly(Instruction { operation: 31, ..instruction(Operation::Fill, 0, 1, 0) });
}

#[test]
#[should_panic(expected = "only the controller of a quadratic tree takes a curve")]
fn a_curve_for_a_linear_tree_is_an_error() {
    taken_wrongly(instruction(Operation::Curve, 0, 1, 0));
}

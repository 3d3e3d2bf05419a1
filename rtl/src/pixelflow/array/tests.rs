//! Random programs, compared with the emulator at every pixel, and the time of a simulated clock.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::emulator::Pixel;
use super::super::pixel::{Enabling, Flagging, Function, Mask, Source};
use super::super::testing::{edge, instructions, processor_time};
use super::*;

type Array = Simulation<PixelArrayIn, PixelArrayOut>;

fn started(array: &PixelArray, side_by_side: bool) -> Array {
    let mut sim = Simulation::of(array).unwrap();
    sim.set(sim.i.side_by_side, side_by_side);
    sim.reset();
    sim
}

/// Offers an instruction, or none, for a clock of the array; returns whether it is taken.
fn clock(sim: &mut Array, instruction: Option<&Instruction<u64>>) -> bool {
    let i = sim.i.clone();
    sim.set(i.instructions.valid, instruction.is_some());
    sim.set_record(i.instructions.payload, *instruction.unwrap_or(&Instruction::NOTHING));
    let taken = instruction.is_some() && sim.get_u64(i.instructions.ready) == 1;
    sim.step_clock(ARRAY, 1);
    taken
}

/// Sends the program with pauses, and lets it end in the pixels; returns the clocks.
fn run(sim: &mut Array, array: &PixelArray, program: &[Instruction<u64>], pauses: &[u32]) -> u64 {
    let start = sim.cycles(ARRAY).unwrap();
    for (number, instruction) in program.iter().enumerate() {
        (0..pauses[number % pauses.len()]).for_each(|_| assert!(!clock(sim, None)));
        while !clock(sim, Some(instruction)) {}
    }
    sim.set(sim.i.instructions.valid, 0);
    while sim.get_u64(sim.o.idle) == 0 {
        sim.step_clock(ARRAY, 1);
    }
    sim.step_clock(ARRAY, array.latency().into());
    sim.cycles(ARRAY).unwrap() - start
}

/// The whole state of a pixel in the circuit.
fn held(sim: &mut Array, array: &PixelArray, x: u32, y: u32) -> Pixel {
    let mut pixel = Pixel::new();
    // A row for each chip, which has two lines.
    let place = format!("[{}][{}]", y / 2, y % 2 * array.width + x);
    let name = |what: &str| format!("u_pixel{place}.{what}");
    let number = |sim: &mut Array, what: &str| sim.peek(&name(what)).unwrap().to_u64().unwrap();
    let byte = |memory: &str, at: u64| sim.peek_memory(memory, at as u32).unwrap().to_u64().unwrap() as u8;
    let registers = |instance: &str, at: u64| {
        let [by_array, by_port] = ["by_array", "by_port"].map(|side| byte(&format!("{instance}.{side}{place}"), at));
        by_array ^ by_port
    };
    (0..256).for_each(|at| pixel.memory[at as usize] = byte(&name("memory"), at));
    for (instance, first, bytes) in [("u_bank0", 256, 32), ("u_bank1", 288, 32), ("u_texture", 320, 64)] {
        (0..bytes).for_each(|at| pixel.memory[first + at as usize] = registers(instance, at));
    }
    pixel.accumulator = number(sim, "accumulator") as u8;
    pixel.carry = number(sim, "carry") == 1;
    pixel.flag = number(sim, "flag") == 1;
    pixel.enable = number(sim, "enable") as u32;
    pixel
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Instructions may overlap. The final state is as if each began when its predecessor had ended.
    #[test]
    fn instructions_do_what_they_do_one_after_another(
        extents in prop::array::uniform2(1..4u32),
        program in prop::collection::vec(instructions(), 1..60),
        side_by_side in any::<bool>(),
        pauses in prop::collection::vec(prop_oneof![4 => Just(0u32), 1 => 0..9u32], 1..8),
    ) {
        let [width, height] = extents.map(|extent| 1 << extent);
        let array = PixelArray { width, height };
        let mut sim = started(&array, side_by_side);
        run(&mut sim, &array, &program, &pauses);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let mut pixel = Pixel::new();
            pixel.run(&program, x, y);
            prop_assert_eq!(held(&mut sim, &array, x, y), pixel, "pixel {} of line {}", x, y);
        }
    }
}

/// Prints the nanoseconds per clock of an array of 128 x 64 pixels, for each activity of the array and of a port:
/// `cargo test --release -p tilewright-rtl --lib -- --ignored --nocapture nanoseconds_of_the_machine_s_array`
#[test]
#[ignore = "it measures"]
fn nanoseconds_of_the_machine_s_array() {
    const CLOCKS: u64 = 20_000;
    let array = PixelArray { width: 128, height: 64 };
    let word =
        Instruction { mask: Mask::Everybody.code(), stores: 1, length: 8, read: 8, write: 40, ..Instruction::NOTHING };
    let (expression, constant) = (Source::Expression.code(), Source::Constant.code());
    let numbers = Instruction { a: 70_000, b: 50_000, c: 1 << 30, ..word };
    let of = |source: u64, function: Function| Instruction { source, function: function.code(), ..numbers };
    let edge = edge(Enabling::Restrict, [-3, 5, 1 << 20], 4);
    let compare = Instruction { flagging: Flagging::EnabledCondition.code(), ..of(expression, Function::Compare) };
    let all = [
        ("nothing", Instruction::NOTHING),
        ("an edge", edge),
        ("an expression is written", of(expression, Function::Operand)),
        ("an expression is compared", compare),
        ("a constant is added", of(constant, Function::Add)),
        ("a word is copied where flagged", Instruction { mask: Mask::Flagged.code(), ..of(constant, Function::Word) }),
        ("a word is copied to the registers", Instruction { write: 256, ..of(constant, Function::Word) }),
    ];
    for (what, instruction) in all {
        for port in ["rests", "reads", "writes"] {
            let mut sim = started(&array, true);
            clock(&mut sim, Some(&instruction));
            sim.set(sim.i.network[0].writes, port == "writes");
            sim.run(1000);
            let begin = processor_time();
            if port == "reads" {
                for number in 0..2 * CLOCKS {
                    sim.set(sim.i.network[0].pixel, number % 256);
                    let _ = sim.get(sim.o.network_seen[0]);
                    sim.step();
                }
            } else {
                sim.run(2 * CLOCKS);
            }
            println!("{what}, the network {port}: {} ns", (processor_time() - begin) / CLOCKS);
        }
    }
}

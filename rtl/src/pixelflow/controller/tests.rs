//! The controller clock by clock, the clocks of a primitive, and the instructions that it refuses.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::emulator::{byte_of, effect, signed};
use super::super::model::{controls, step};
use super::super::pixel::Begin;
use super::super::testing::{edge, instructions, triangle};
use super::*;
use crate::pixel_planes::schedule::{Schedule, Times};

type Controller = Simulation<ArrayControllerIn, ArrayControllerOut>;

fn started(side_by_side: u64) -> Controller {
    let mut sim = Simulation::of(&ArrayController { width: 2, height: 2 }).unwrap();
    sim.reset();
    sim.drive(inputs(None, side_by_side));
    sim
}

fn inputs(next: Option<&Instruction<u64>>, side_by_side: u64) -> ArrayControllerIn<u64> {
    let instructions = Stream::of(next.is_some().into(), *next.unwrap_or(&Instruction::NOTHING));
    ArrayControllerIn { instructions, side_by_side, bank_done: 0, texture_done: 0 }
}

/// Offers instructions one after another for `clocks` clocks; returns the clocks in which they are taken.
fn run(sim: &mut Controller, instructions: &[Instruction<u64>], clocks: u64) -> Vec<u64> {
    watched(sim, instructions, clocks, |_| {})
}

/// Runs as [`run`], and shows the outputs of each clock to `look`.
fn watched(
    sim: &mut Controller,
    instructions: &[Instruction<u64>],
    clocks: u64,
    mut look: impl FnMut(ArrayControllerOut<u64>),
) -> Vec<u64> {
    let (side_by_side, mut taken) = (sim.get_u64(sim.i.side_by_side), Vec::new());
    for clock in 0..clocks {
        let next = instructions.get(taken.len());
        sim.drive(inputs(next, side_by_side));
        if next.is_some() && sim.get_u64(sim.i.instructions.ready) == 1 {
            taken.push(clock);
        }
        look(sim.read_u64());
        sim.step();
    }
    taken
}

/// All pixels write the sum of a constant and a word.
fn fill(length: u64, write: u64) -> Instruction<u64> {
    let (function, begin, mask) = (Function::Add.code(), Begin::Zero.code(), Mask::Everybody.code());
    Instruction { function, begin, mask, stores: 1, length, write, c: 0x0403_0201, ..Instruction::NOTHING }
}

/// A copy of a word where the flag is set.
fn copy(length: u64) -> Instruction<u64> {
    let (function, mask) = (Function::Word.code(), Mask::Flagged.code());
    Instruction { function, mask, stores: 1, length, read: 100, write: 200, ..Instruction::NOTHING }
}

fn evaluate(skip: u64, length: u64) -> Instruction<u64> {
    let (source, mask) = (Source::Expression.code(), Mask::Enabled.code());
    Instruction { source, mask, stores: 1, skip, length, c: 0xff_0403_0201, ..Instruction::NOTHING }
}

fn in_step(sync: Sync, bank: u64) -> Instruction<u64> {
    Instruction { sync: sync.code(), c: bank, ..Instruction::NOTHING }
}

fn test(bytes: u64) -> Instruction<u64> {
    edge(Enabling::Restrict, [0, 0, 0x0605_0403], bytes)
}

#[test]
fn the_control_of_pixels_comes_with_the_expression() {
    let mut sim = started(1);
    let signals = [
        "instructions_valid",
        "instructions_ready",
        "first",
        "coefficients_c",
        "evaluator_left",
        "memory_left",
        "control_mask",
        "control_constant",
        "control_begin",
        "control_write",
        "control_enabling",
    ];
    let wave = sim.record(signals);
    // While three bytes are written, an edge is tested.
    run(&mut sim, &[evaluate(1, 2), fill(3, 30), test(2)], 11);
    wave.expect(
        r"
        clk                |~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        instructions_valid |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_________________________________
        instructions_ready |~~~~~~~~~~\_____________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        first              |__________/~~~~~~~~~~\________________________________/~~~~~~~~~~\______________________
        coefficients_c     | 0        | 1        | 2        | 3        | 4        | 3        | 4        | 5        |
        evaluator_left     | 0        | 3        | 2        | 1        | 0        | 2        | 1        | 0        |
        memory_left        | 0                                         | 3        | 2        | 1        | 0        |
        control_mask       | Nobody                                               | Enabled             | Everyb.. |
        control_constant   | 0                                         | 1        | 2        | 3        | 1        |
        control_begin      | Kept                                                                       | Zero     |
        control_write      | 0                                                               | 1        | 1e       |
        control_enabling   | Keep                                                                                  |

        clk                |~~~~~\____/~~~~~\____/~~~~~\____/
        instructions_valid |_________________________________
        instructions_ready |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        first              |_________________________________
        coefficients_c     | 6        | 0                   |
        evaluator_left     | 0                              |
        memory_left        | 0                              |
        control_mask       | Everybody           | Nobody   |
        control_constant   | 2        | 3        | 5        |
        control_begin      | Kept                           |
        control_write      | 1f       | 20       | 1        |
        control_enabling   | Keep     | Restrict | Keep     |
        ",
    );
}

#[test]
fn one_at_a_time_each_is_taken_with_the_last_byte_of_its_predecessor() {
    let program = [test(4), fill(3, 30), evaluate(5, 2), copy(8), in_step(Sync::GiveBank, 1), evaluate(7, 8), test(1)];
    assert_eq!(run(&mut started(0), &program, 60), [0, 4, 7, 14, 22, 23, 38]);
}

#[test]
fn side_by_side_an_instruction_waits_only_for_what_it_needs() {
    let taken = |program: &[Instruction<u64>]| run(&mut started(1), program, 40);
    // An edge does not wait. An instruction that needs the ALU starts so that its word follows the copy.
    assert_eq!(taken(&[copy(8), test(4), test(4)]), [0, 1, 5]);
    assert_eq!(taken(&[copy(8), evaluate(2, 3)]), [0, 6]);
    assert_eq!(taken(&[copy(8), evaluate(0, 3)]), [0, 8]);
    let set = Instruction { enabling: Enabling::Set.code(), ..Instruction::NOTHING };
    assert_eq!(taken(&[copy(8), set]), [0, 1]);
    // A test that looks at the carry needs the ALU.
    let by_carry = Instruction { condition: Condition::Carry.code(), ..test(1) };
    assert_eq!(taken(&[copy(8), by_carry]), [0, 8]);
    // An edge that also sets the flag needs the ALU, too.
    let captures = Instruction { flagging: Flagging::EnabledCondition.code(), ..test(4) };
    assert_eq!(taken(&[copy(8), captures]), [0, 5]);
    // A copy waits for the end of a word that will be written, but does not wait for an edge.
    assert_eq!(taken(&[evaluate(2, 3), copy(8)]), [0, 5]);
    assert_eq!(taken(&[test(4), copy(8)]), [0, 1]);
    // One more copy may wait for the memory.
    assert_eq!(taken(&[copy(8), copy(8), test(4), copy(8), test(4)]), [0, 1, 2, 8, 9]);
}

/// A bank is given, then read by the network while the other one is filled, and given again.
#[test]
fn a_bank_is_awaited_until_the_network_has_done_with_it() {
    let mut sim = started(1);
    let signals =
        ["instructions_ready", "banks_under_way", "bank_done", "given_banks", "control_write", "control_mask"];
    let wave = sim.record(signals);
    let program = [fill(2, 288), in_step(Sync::GiveBank, 1), in_step(Sync::AwaitBank, 0), in_step(Sync::AwaitBank, 1)];
    let mut shown = program.iter().peekable();
    for clock in 0..13 {
        sim.drive(ArrayControllerIn { bank_done: if clock == 9 { 2 } else { 0 }, ..inputs(shown.peek().copied(), 1) });
        shown.next_if(|_| sim.get_u64(sim.i.instructions.ready) == 1);
        sim.step();
    }
    wave.expect(
        r"
        clk                |~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/
        instructions_ready |~~~~~\_____/~~~~~~~~~~~\___________________________________/~~~~~~~~~~~~~~~~~~
        banks_under_way    | 0               | 2                                       | 0               |
        bank_done          | 0                                                   | 2   | 0               |
        given_banks        | 0                                 | 2   | 0                                 |
        control_write      | 0                     | 120 | 121 | 0                                       |
        control_mask       | Nobody                | Everybody | Nobody                                  |
        ",
    );
}

#[test]
fn the_texture_unit_is_awaited_until_it_has_done() {
    let mut sim = started(1);
    let (start, wait) = (in_step(Sync::StartTexture, 0), in_step(Sync::AwaitTexture, 0));
    assert_eq!(run(&mut sim, &[wait, start, wait], 20), [0, 1]);
    sim.drive(ArrayControllerIn { texture_done: 1, ..inputs(None, 1) });
    sim.step();
    let mut starts = Vec::new();
    let taken = watched(&mut sim, &[wait, start], 8, |out| starts.push(out.given.texture));
    assert_eq!(taken, [0, 1]);
    // The start is taken in clock 1, and its byte is sent in clock 2. The pixels get the byte 3 clocks later, as they
    // would get an expression.
    assert_eq!(starts, [0, 0, 0, 0, 0, 1, 0, 0]);
}

#[test]
fn what_is_given_is_given_with_the_last_byte() {
    let given = |next: Instruction<u64>| {
        let mut given = Vec::new();
        watched(&mut started(1), &[next], 8, |out| given.push([out.given.banks, out.given.texture]));
        given
    };
    // One word is on the memory, and one on the evaluator. The pixels get the bytes in clocks 4 to 6.
    for word in [fill(3, 288), evaluate(0, 3)] {
        for (sync, last) in [(Sync::GiveBank, [2, 0]), (Sync::StartTexture, [0, 1])] {
            let expected = [0, 1, 2, 3, 4, 5, 6, 7].map(|clock| if clock == 6 { last } else { [0, 0] });
            assert_eq!(given(Instruction { sync: sync.code(), ..word }), expected);
        }
    }
}

/// The clocks from the first instruction of a primitive to that of the next, for many equal primitives.
fn clocks(program: &[Instruction<u64>], side_by_side: u64) -> u64 {
    const MANY: usize = 6;
    let mut sim = started(side_by_side);
    let taken = run(&mut sim, &vec![program.to_vec(); MANY].concat(), 400);
    assert_eq!(taken.len(), MANY * program.len());
    let begins: Vec<u64> = taken.iter().step_by(program.len()).copied().collect();
    let [.., before, last] = begins[..] else { unreachable!("many") };
    assert_eq!(last - before, before - begins[MANY - 3], "the time of a primitive is constant");
    last - before
}

/// Facts E4: 12 bytes of edges, 5 of depth, 9 of colours and 6 of the copy take 0.32 us. Side by side, the copy runs
/// during the edges, and costs only the clock in which its instruction is taken.
#[test]
fn a_gouraud_triangle_takes_32_clocks_and_27_side_by_side() {
    let program = triangle([[1, 2, 3]; 3], 4, [[1, 2, 3]; 4]);
    assert_eq!([0, 1].map(|side_by_side| clocks(&program, side_by_side)), [32, 27]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// Each byte of each instruction comes in its clock, and no byte in any other clock.
    #[test]
    fn every_byte_comes_in_its_clock(
        program in prop::collection::vec(instructions(), 1..40),
        side_by_side in any::<bool>(),
        seed in any::<u64>(),
    ) {
        let controller = ArrayController { width: 2, height: 2 };
        let late = u64::from(controller.evaluator().latency());
        let mut sim = Simulation::of(&controller).unwrap().seeded(seed);
        sim.reset();
        sim.drive(inputs(None, side_by_side.into()));
        let mut schedule = Schedule::new(side_by_side);
        let times: Vec<Times> = program.iter().map(|next| schedule.take(&step(next))).collect();
        let end = times.iter().map(|it| it.ends).max().unwrap();
        let mut seen = Vec::new();
        let taken = watched(&mut sim, &program, end + late + 2, |out| seen.push(out));
        prop_assert_eq!(taken, times.iter().map(|it| it.taken).collect::<Vec<_>>());

        let mut expected = vec![Control::ZERO; seen.len()];
        let (mut first, mut sends) = (vec![0; seen.len()], vec![0; seen.len()]);
        for (next, Times { begins, .. }) in program.iter().zip(&times) {
            if next.source == Source::Expression.code() {
                first[*begins as usize] = 1;
                for at in 0..next.skip + next.length {
                    sends[(begins + at) as usize] = 1;
                    let sent = [next.a, next.b, next.c].map(|number| byte_of(signed(number), at).into());
                    let out = seen[(begins + at) as usize].coefficients;
                    prop_assert_eq!([out.a, out.b, out.c], sent);
                }
            }
            for (clock, control) in (begins + next.skip + late..).zip(controls(next)) {
                let at = &mut expected[clock as usize];
                let (enabling, by_sign) = (control.enabling, control.by_sign);
                if step(next).on_memory {
                    *at = Control { enabling: at.enabling, by_sign: at.by_sign, ..control };
                }
                if step(next).on_tree {
                    *at = Control { enabling, by_sign, ..*at };
                }
            }
        }
        for (clock, (out, expected)) in seen.iter().zip(&expected).enumerate() {
            prop_assert_eq!([out.first, out.sends], [first[clock], sends[clock]], "clock {}", clock);
            prop_assert_eq!(effect(&out.control), effect(expected), "clock {}", clock);
            prop_assert_eq!([out.given.banks, out.given.texture], [0, 0]);
        }
        prop_assert_eq!(seen.last().unwrap().idle, 1);
    }
}

fn taken_wrongly(wrong: Instruction<u64>) {
    run(&mut started(1), &[wrong], 2);
}

#[test]
#[should_panic(expected = "a word has 1 to 8 bytes")]
fn an_empty_word_is_an_error() {
    taken_wrongly(fill(0, 0));
}

#[test]
#[should_panic(expected = "only bytes of an expression are skipped")]
fn what_skips_without_an_expression_is_an_error() {
    taken_wrongly(Instruction { skip: 1, ..fill(1, 0) });
}

/// Checks that each of the instructions is refused with this message.
fn expect_refused(wrong: &[Instruction<u64>], message: &str) {
    for wrong in wrong {
        let mut sim = started(1);
        sim.drive(inputs(Some(wrong), 1));
        let problem = sim.try_step().unwrap_err().to_string();
        assert!(problem.contains(message), "{wrong:?}: {problem}");
    }
}

#[test]
fn a_word_that_reaches_beyond_the_memory_is_an_error() {
    let reads = |length, read| Instruction { read, ..fill(length, 0) };
    let wrong = [fill(5, 380), fill(1, 511), reads(5, 380), reads(1, 511)];
    expect_refused(&wrong, "a word is within the 384 bytes of a pixel");
}

#[test]
#[should_panic(expected = "a word is within the 384 bytes of a pixel")]
fn a_word_that_goes_down_below_the_memory_is_an_error() {
    taken_wrongly(Instruction { descends: 1, read: 7, ..fill(5, 3) });
}

#[test]
fn words_at_both_ends_of_the_memory_are_taken() {
    let down = Instruction { descends: 1, read: 383, ..fill(5, 4) };
    assert_eq!(run(&mut started(1), &[fill(4, 380), down], 9), [0, 1]);
}

#[test]
fn a_code_that_does_not_exist_is_an_error() {
    let word = fill(1, 0);
    let wrong = [
        Instruction { function: 11, ..word },
        Instruction { begin: 3, ..word },
        Instruction { condition: 3, ..word },
        Instruction { enabling: 7, ..word },
        Instruction { flagging: 3, ..word },
        Instruction { sync: 5, ..word },
    ];
    expect_refused(&wrong, "each field has a valid code");
}

#[test]
#[should_panic(expected = "a bank is given only when the network is done with it")]
fn a_bank_that_is_given_twice_is_an_error() {
    run(&mut started(1), &[in_step(Sync::GiveBank, 1), in_step(Sync::GiveBank, 0), in_step(Sync::GiveBank, 1)], 9);
}

#[test]
#[should_panic(expected = "the texture unit begins only when it is done")]
fn a_texture_unit_that_begins_twice_is_an_error() {
    run(&mut started(1), &[in_step(Sync::StartTexture, 0), in_step(Sync::StartTexture, 0)], 9);
}

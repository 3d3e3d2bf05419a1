//! Testbenches pass on what the hardware does, and fail on what it does not.

mod blocks;

use blocks::{Counter, Row};
use tilewright_gen::tools::{self, Problems};
use tilewright_gen::{Initial, Replay, ReplayStep, testbench, verilog};
use tilewright_hdl::{Bits, Block, elaborate};

/// Steps of one clock of 10 ns: reset, inputs, outputs, each with its width.
fn replay(steps: &[(bool, &[(u32, u64)], &[(u32, u64)])]) -> Replay {
    let bits = |values: &[(u32, u64)]| values.iter().map(|&(width, value)| Bits::new(width, value)).collect();
    let step = |(cycle, &(reset, inputs, outputs)): (usize, &(bool, &[(u32, u64)], &[(u32, u64)]))| ReplayStep {
        time_ps: 10_000 * (cycle as u64 + 1),
        rising: vec![0],
        resets: if reset { vec![0] } else { vec![] },
        inputs: bits(inputs),
        outputs: bits(outputs),
    };
    Replay { steps: steps.iter().enumerate().map(step).collect(), initial: Vec::new() }
}

fn run<B: Block>(block: &B, replay: &Replay) -> Result<(), Problems> {
    let design = elaborate(block).expect("the block is sound");
    let (files, bench) = (verilog(&design), testbench(&design, replay));
    let _ = tools::replay_in_icarus(&files, &bench)?;
    let _ = tools::replay_in_verilator(&files, &bench)?;
    Ok(())
}

fn counting() -> Replay {
    let on: &[(u32, u64)] = &[(1, 1)];
    replay(&[
        (true, on, &[(8, 0), (1, 0)]),
        (false, on, &[(8, 0), (1, 0)]),
        (false, &[(1, 0)], &[(8, 1), (1, 0)]),
        (false, on, &[(8, 1), (1, 0)]),
        (false, on, &[(8, 2), (1, 1)]),
        (false, on, &[(8, 0), (1, 0)]),
    ])
}

#[test]
fn a_counter_passes() {
    run(&Counter { width: 8, limit: 3 }, &counting()).unwrap();
}

#[test]
fn a_wrong_expectation_fails_with_port_and_cycle() {
    let mut wrong = counting();
    wrong.steps[4].outputs[0] = Bits::new(8, 7);
    let design = elaborate(&Counter { width: 8, limit: 3 }).expect("the block is sound");
    match tools::replay_in_icarus(&verilog(&design), &testbench(&design, &wrong)) {
        Ok(checked) => assert_eq!(checked, tools::Checked::Skipped, "Icarus accepts a wrong expectation"),
        Err(problems) => {
            let text = problems.to_string();
            assert!(text.contains("FAIL: cycle 4: count is 02, expected 07"), "{text}");
            assert!(text.contains("FAIL: 1 mismatches in 6 cycles"), "{text}");
        }
    }
}

#[test]
fn lanes_and_memories_start_from_what_the_replay_says() {
    let inputs: &[(u32, u64)] = &[(1, 0), (8, 5)];
    let mut row = replay(&[(false, inputs, &[(1, 0), (1, 0), (8, 9), (8, 12), (8, 0x67)])]);
    row.initial = [(0, 1), (1, 2), (4, 9)]
        .map(|(lane, value)| Initial { path: format!("u_cell[{lane}].q"), words: vec![Bits::new(8, value)] })
        .to_vec();
    run(&Row { lanes: 5 }, &row).unwrap();
}

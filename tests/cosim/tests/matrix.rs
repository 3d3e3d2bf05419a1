//! Every operator, at every width from 1 to 130 bits.

use tilewright_cosim::batch::{self, Tool};
use tilewright_cosim::matrix;
use tilewright_cosim::operators::OPERATORS;

/// Widths around those of machine words.
const SELECTED: [u32; 10] = [1, 2, 3, 8, 16, 31, 33, 64, 65, 130];

#[test]
fn our_simulator_agrees_with_big_integers() {
    let compared: u64 = (1..=130).map(|width| matrix::run(width).unwrap_or_else(|wrong| panic!("{wrong}")).1).sum();
    println!("results compared with big integers: {compared}");
    // Seven edge values against each other, and 32 vectors of random ones, at each width.
    assert_eq!(compared, 130 * (7 * 7 + 32) * OPERATORS.len() as u64);
}

fn compare_in(tool: Tool, widths: impl IntoIterator<Item = u32>) {
    if !tool.is_here() {
        return;
    }
    let widths: Vec<u32> = widths.into_iter().collect();
    let printed: Vec<_> = widths.iter().map(|width| matrix::printed(*width).unwrap()).collect();
    let verdicts = batch::run(tool, &printed, batch::PATIENCE).unwrap();
    for (width, wrong) in widths.iter().zip(verdicts) {
        assert!(wrong.is_none(), "{} differs at {width} bits:\n{}", tool.name(), wrong.unwrap_or_default());
    }
}

#[test]
fn icarus_agrees_at_every_width() {
    compare_in(Tool::Icarus, 1..=130);
}

#[test]
fn verilator_agrees_at_selected_widths() {
    compare_in(Tool::Verilator, SELECTED);
}

//! The clocks of instructions: a model of the rules of a node's controller.
//!
//! The rules are those of Pixel-planes' [`Schedule`]. The fields of an instruction tell what it needs:
//!
//! | instruction | slot | uses ALU and memory |
//! |---|---|---|
//! | with an expression, or that reads or changes `enable` | the evaluator's, in sequence | unless it is quiet |
//! | any other | the memory's | yes |
//!
//! An instruction is quiet if it writes nothing and tests only an expression's sign, which bypasses the ALU. Edges are
//! quiet: while the evaluator has them, the previous primitive's result may still be written.

use super::instruction::{Instruction, Sync};
use super::pixel::{Condition, Enabling, Flagging, Function, Mask, Source};
use crate::pixel_planes::schedule::{Schedule, Step, Times};
use crate::prelude::Codes;

/// The resources that an instruction needs.
pub fn step(i: &Instruction<u64>) -> Step {
    let has_expression = i.source == Source::Expression.code();
    let enabling = Enabling::ALL[i.enabling as usize];
    let uses_enable =
        enabling != Enabling::Keep || i.mask == Mask::Enabled.code() || i.flagging == Flagging::EnabledCondition.code();
    let on_tree = has_expression || uses_enable;
    Step {
        on_tree,
        on_memory: !on_tree || !is_quiet(i, has_expression, enabling),
        saves: false,
        skip: i.skip as u8,
        length: i.length as u8,
    }
}

fn is_quiet(i: &Instruction<u64>, has_expression: bool, enabling: Enabling) -> bool {
    let writes = i.mask != Mask::Nobody.code() && (i.accumulates == 1 || i.stores == 1);
    let is_conditional = matches!(enabling, Enabling::Replace | Enabling::Restrict | Enabling::Push);
    let is_sign = has_expression && i.condition == Condition::Positive.code();
    i.function == Function::Operand.code()
        && !writes
        && i.flagging == Flagging::Keep.code()
        && (!is_conditional || is_sign)
}

/// The clocks of a program, one instruction at a time.
///
/// ```
/// use tilewright_rtl::pixelflow::{programs::clear, schedule::one_at_a_time};
/// assert_eq!(one_at_a_time(&clear(256, 21)), 21);
/// ```
pub fn one_at_a_time(program: &[Instruction<u64>]) -> u64 {
    program.iter().map(Instruction::clocks).sum()
}

/// The clocks from the beginning of a program to that of the next one, in a long sequence of equal programs. Evaluator
/// and memory work side by side, and no instruction waits for a port.
pub fn side_by_side(program: &[Instruction<u64>]) -> u64 {
    let steps: Vec<Step> = program.iter().map(step).collect();
    let mut schedule = Schedule::new(true);
    let mut begins = || {
        let times: Vec<u64> =
            program.iter().zip(&steps).map(|(i, step)| take(&mut schedule, i, step, 0).taken).collect();
        times.first().copied().unwrap_or(0)
    };
    // The first programs begin with an idle controller.
    let (_, _, third, fourth) = (begins(), begins(), begins(), begins());
    fourth - third
}

/// Takes an instruction as soon as possible, but not before clock `from`, in which its port is ready. Returns its
/// times. An instruction that synchronizes with a port runs alone.
///
/// ```
/// use tilewright_rtl::pixel_planes::schedule::Schedule;
/// use tilewright_rtl::pixelflow::programs::{await_bank, clear};
/// use tilewright_rtl::pixelflow::schedule::{step, take};
///
/// let mut schedule = Schedule::new(true);
/// let word = clear(256, 4)[0];
/// assert_eq!(take(&mut schedule, &word, &step(&word), 0).taken, 0);
/// // The network is done with the bank in clock 2, but the word's last byte is sent in clock 4.
/// let waits = await_bank(0);
/// assert_eq!(take(&mut schedule, &waits, &step(&waits), 2).taken, 4);
/// assert_eq!(take(&mut schedule, &word, &step(&word), 0).taken, 5);
/// ```
pub fn take(schedule: &mut Schedule, i: &Instruction<u64>, step: &Step, from: u64) -> Times {
    let ready = schedule.ready(step).max(from);
    let is_alone = i.sync != Sync::Nothing.code();
    schedule.take_at(step, if is_alone { ready.max(schedule.idle() - 1) } else { ready })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::{model, testing};
    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(4000) })]

        /// Compares with a model that is written independently and agrees with the controller.
        #[test]
        fn an_instruction_takes_what_it_takes_in_the_model(instruction in testing::instructions()) {
            prop_assert_eq!(step(&instruction), model::step(&instruction));
        }
    }
}

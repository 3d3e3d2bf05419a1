//! What the paper states of its machine, each with the rule by which it is judged. The rules were fixed before there were numbers.

mod apr;
mod machine;
mod memory;
mod reasons;
mod scaling;
mod section_6;
mod table_1;
#[cfg(test)]
mod tests;

pub use scaling::derived;
pub use section_6::best;

use super::found::Found;
use tilewright_report::{Rule, Verdicts};

/// What differs from the paper's number by rounding, or by what a rounded number is derived from.
const WITHIN_HALF: Rule = Rule::Within { percent: 0.5 };
const WITHIN_1: Rule = Rule::Within { percent: 1.0 };
const WITHIN_2: Rule = Rule::Within { percent: 2.0 };
const WITHIN_5: Rule = Rule::Within { percent: 5.0 };
/// What depends on costs of programs and on scenes that are not the paper's own.
const WITHIN_10: Rule = Rule::Within { percent: 10.0 };

/// "Without significant performance degradation" (VC1-F8), and a difference that is one.
const LITTLE: f64 = 1.05;
/// "The most appropriate" (VC1-F9).
const ALMOST_LEAST: f64 = 1.01;
/// The floor that merger and display set, in milliseconds (VC1-33).
const FLOOR: f64 = 33.3;
/// T_m and a refresh, in milliseconds: with more drawing no guard of a swap can bind.
const GUARDS: f64 = 42.1;

/// All statements, in the order of the paper's sections.
pub fn verdicts(found: &Found) -> Verdicts {
    let all = [
        machine::statements(found),
        scaling::statements(found),
        memory::statements(found),
        apr::statements(found),
        table_1::statements(found),
        section_6::statements(found),
    ];
    Verdicts::new("statements", "Statements of the paper, each by the rule beneath it")
        .states(all.into_iter().flatten())
}

fn place(scene: &str, processors: u32) -> String {
    format!("{scene}, n = {processors}")
}

/// As it stands in places.
pub fn named(threshold: Option<u32>) -> String {
    threshold.map_or_else(|| "off".to_owned(), |pixels| pixels.to_string())
}

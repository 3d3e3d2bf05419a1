//! The paper's statements about its machine, each with its rule. The rules were fixed before there were numbers.

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

/// For numbers that differ from the paper's by rounding, or are derived from rounded numbers.
const WITHIN_HALF: Rule = Rule::Within { percent: 0.5 };
const WITHIN_1: Rule = Rule::Within { percent: 1.0 };
const WITHIN_2: Rule = Rule::Within { percent: 2.0 };
const WITHIN_5: Rule = Rule::Within { percent: 5.0 };
/// For numbers that depend on the costs of programs and on scenes other than the paper's.
const WITHIN_10: Rule = Rule::Within { percent: 10.0 };

/// "Without significant performance degradation" (VC1-F8), and a difference that is significant.
const LITTLE: f64 = 1.05;
/// "The most appropriate" (VC1-F9).
const ALMOST_LEAST: f64 = 1.01;
/// The floor that merger and display set, in milliseconds (VC1-33).
const FLOOR: f64 = 33.3;
/// T_m and a refresh, in milliseconds. With more drawing no condition of a swap can delay it.
const GUARDS: f64 = 42.1;

/// All statements, in the sequence of the paper's sections.
pub fn verdicts(found: &Found) -> Verdicts {
    let all = [
        machine::statements(found),
        scaling::statements(found),
        memory::statements(found),
        apr::statements(found),
        table_1::statements(found),
        section_6::statements(found),
    ];
    Verdicts::new("statements", "Statements of the paper, each with its rule").states(all.into_iter().flatten())
}

fn place(scene: &str, processors: u32) -> String {
    format!("{scene}, n = {processors}")
}

/// A threshold as a place.
pub fn named(threshold: Option<u32>) -> String {
    threshold.map_or_else(|| "off".to_owned(), |pixels| pixels.to_string())
}

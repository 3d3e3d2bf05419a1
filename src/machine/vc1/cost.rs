//! `--cost NAME=CLOCKS`: the clocks of a step of the processing elements' program.

use crate::names::{are_alike, unknown};
use crate::shell::{Exit, Failure};
use tilewright_machines::vc1::CostTable;

/// The most clocks of a step.
const MOST: u64 = 1_000_000;

/// A step of the program, by its name, and its clocks.
#[derive(Clone, Copy)]
pub struct Cost {
    name: &'static str,
    clocks: u64,
}

/// What the help says.
pub fn help() -> String {
    let mut costs = CostTable::default();
    let usual = |(name, _): (&str, u64)| Some(format!("{name}={}", costs.step(name)?));
    let usual: Vec<String> = CostTable::STEPS.into_iter().filter_map(usual).collect();
    format!("Clocks of a step of the processing elements' program; may be repeated [default: {}]", usual.join(" "))
}

/// Reads one.
///
/// # Errors
/// A sentence that says what to give.
pub fn cost(text: &str) -> Result<Cost, String> {
    let (name, clocks) = text
        .split_once('=')
        .ok_or_else(|| format!("give a step and its clocks, such as row=60; the steps are {}", names(|_| true)))?;
    let found = CostTable::STEPS.into_iter().find(|(known, _)| are_alike(name, known));
    let (name, least) = found
        .ok_or_else(|| unknown(&format!("there is no step `{name}`"), name, &CostTable::STEPS.map(|(name, _)| name)))?;
    let range = least..=MOST;
    let clocks = clocks.parse().ok().filter(|clocks| range.contains(clocks));
    let clocks = clocks.ok_or_else(|| {
        let sentence = format!("{name} has to be from {least} to {MOST} clocks");
        match least {
            0 => sentence,
            _ => format!("{sentence}; steps that can take 0 clocks are {}", names(|least| least == 0)),
        }
    })?;
    Ok(Cost { name, clocks })
}

/// The usual costs, with these in their place.
///
/// # Errors
/// A step is given twice.
pub fn table(given: &[Cost]) -> Result<CostTable, Failure> {
    let mut costs = CostTable::default();
    for (i, &Cost { name, clocks }) in given.iter().enumerate() {
        if given[..i].iter().any(|earlier| earlier.name == name) {
            return Err(Failure::new(Exit::BadInput, format!("--cost {name} is given twice: leave one out")));
        }
        if let Some(step) = costs.step(name) {
            *step = clocks;
        }
    }
    Ok(costs)
}

/// The names of the steps for which the least number of clocks is meant.
fn names(is_meant: impl Fn(u64) -> bool) -> String {
    let names: Vec<&str> =
        CostTable::STEPS.into_iter().filter(|(_, least)| is_meant(*least)).map(|(name, _)| name).collect();
    names.join(", ")
}

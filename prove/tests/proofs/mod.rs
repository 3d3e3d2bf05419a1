//! What is proved of the blocks: each claim is a harness around a block, and a mutant of it that must fail.

mod arithmetic;
mod machines;
mod streams;

use crate::harness::proof;
use std::time::Instant;
use tilewright_hdl::ir::Directive;
use tilewright_hdl::{Block, Design, elaborate};
use tilewright_prove::{Outcome, Statement};

/// A claim about a block.
pub struct Claim {
    /// The block and its size.
    pub block: &'static str,
    /// What is proved.
    pub says: &'static str,
    /// The clocks to search.
    pub depth: u32,
    /// The harness; of the mutant if `true`.
    pub design: fn(bool) -> Design,
}

/// The design of a harness.
pub fn design<B: Block>(block: &B) -> Design {
    elaborate(block).unwrap_or_else(|problems| panic!("{problems}"))
}

/// All claims, for the table.
#[allow(dead_code)]
pub fn claims() -> Vec<Claim> {
    [streams::claims(), arithmetic::claims(), machines::claims()].into_iter().flatten().collect()
}

/// The row of a claim in the table, without the last column, and the seconds; `None` if a program is missing.
///
/// # Panics
///
/// It is not proved.
#[track_caller]
pub fn row(claim: &Claim) -> Option<(String, f64)> {
    let begin = Instant::now();
    let found = proof(&(claim.design)(false), claim.depth)?;
    let Claim { block, says, .. } = claim;
    let mut depths = Vec::new();
    for it in found.statements.iter().filter(|it| it.directive == Directive::Assert) {
        match it.outcome {
            Outcome::Proved { depth } => depths.push(depth),
            _ => panic!("{block}: {says}: {it:#?}"),
        }
    }
    let deepest = depths.iter().flatten().max();
    let by = match deepest.filter(|_| !depths.contains(&None)) {
        Some(clocks) => format!("induction, k = {clocks}"),
        None => "an invariant".to_owned(),
    };
    Some((format!("| {block} | {says} | {by} |"), begin.elapsed().as_secs_f64()))
}

/// All assertions of these claims are proved, as the page says, and one of each mutant fails.
#[track_caller]
fn check(claims: Vec<Claim>) {
    for claim in claims {
        let Some((row, _)) = row(&claim) else { return };
        assert!(include_str!("../../../docs/proofs.md").contains(&row), "docs/proofs.md lacks: {row}");
        let Some(found) = proof(&(claim.design)(true), claim.depth) else { return };
        let fails = |it: &Statement| it.directive == Directive::Assert && it.fails();
        assert!(found.statements.iter().any(fails), "the mutant of {} passes: {}", claim.block, claim.says);
    }
}

#[test]
fn of_streams() {
    check(streams::claims());
}

#[test]
fn of_arithmetic() {
    check(arithmetic::claims());
}

#[test]
fn of_machines() {
    check(machines::claims());
}

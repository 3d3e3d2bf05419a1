//! What is proved of the blocks: each claim is a harness around a block, and a mutant of it that must fail.

mod arithmetic;
mod clocks;
mod frame_buffers;
mod machines;
mod pixels;
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
    /// The clocks in which the mutant fails.
    pub fails_within: u32,
    /// It takes too long for a test, and is proved by hand.
    pub by_hand: bool,
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
    let all = [
        streams::claims(),
        clocks::claims(),
        arithmetic::claims(),
        machines::claims(),
        frame_buffers::claims(),
        pixels::claims(),
    ];
    all.into_iter().flatten().collect()
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
    let (mut depths, mut edges) = (Vec::new(), "");
    for it in found.statements.iter().filter(|it| it.directive == Directive::Assert) {
        match it.outcome {
            Outcome::Proved { depth, needs_periods } => {
                depths.push(depth);
                if needs_periods {
                    edges = ", for the periods";
                }
            }
            _ => panic!("{block}: {says}: {it:#?}"),
        }
    }
    let deepest = depths.iter().flatten().max();
    let by = match deepest.filter(|_| !depths.contains(&None)) {
        Some(clocks) => format!("induction, k = {clocks}"),
        None => "an invariant".to_owned(),
    };
    let star = if claim.by_hand { " \\*" } else { "" };
    Some((format!("| {block}{star} | {says} | {by}{edges} |"), begin.elapsed().as_secs_f64()))
}

/// Whether an assertion of the mutant fails; `None` if a program is missing.
#[track_caller]
pub fn mutant_fails(claim: &Claim) -> Option<bool> {
    let found = proof(&(claim.design)(true), claim.fails_within)?;
    let fails = |it: &Statement| it.directive == Directive::Assert && it.fails();
    Some(found.statements.iter().any(fails))
}

/// All assertions of these claims are proved, as the page says, and one of each mutant fails.
#[track_caller]
fn check(claims: Vec<Claim>) {
    for claim in claims.into_iter().filter(|claim| !claim.by_hand) {
        let Some((row, _)) = row(&claim) else { return };
        assert!(include_str!("../../../docs/proofs.md").contains(&row), "docs/proofs.md lacks: {row}");
        let Some(fails) = mutant_fails(&claim) else { return };
        assert!(fails, "the mutant of {} passes: {}", claim.block, claim.says);
    }
}

#[test]
fn of_streams() {
    check(streams::claims());
}

#[test]
fn of_clocks() {
    check(clocks::claims());
}

#[test]
fn of_arithmetic() {
    check(arithmetic::claims());
}

#[test]
fn of_machines() {
    check(machines::claims());
}

#[test]
fn of_frame_buffers() {
    check(frame_buffers::claims());
}

#[test]
fn of_pixels() {
    check(pixels::claims());
}

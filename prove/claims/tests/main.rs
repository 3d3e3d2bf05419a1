//! All claims are proved, as the page says, and a mutant of each fails.

use std::collections::BTreeSet;
use tilewright_claims::{Claim, all};
use tilewright_gen::tools::{Checked, skipped_without};
use tilewright_hdl::ir::Directive;
use tilewright_prove::{Prover, Statement};

const PAGE: &str = include_str!("../../../docs/proofs.md");

/// Proves every claim whose number leaves this rest when divided by `OF`, so that all processors have work.
#[track_caller]
fn check(rest: usize) {
    if let Some(Checked::Skipped) = skipped_without(&["yosys", "z3"]) {
        return;
    }
    let claims = all().into_iter().skip(rest).step_by(OF);
    for claim in claims.filter(|claim| !claim.by_hand) {
        let Claim { block, says, depth, fails_within, design, .. } = claim;
        let prove = |depth, design| Prover::new().depth(depth).prove(&design).unwrap_or_else(|error| panic!("{error}"));
        let proof = prove(depth, design(false));
        let row = claim.row(&proof).unwrap_or_else(|| panic!("{block}: {says}: {:#?}", proof.statements));
        assert!(PAGE.contains(&row), "docs/proofs.md lacks: {row}");
        let fails = |it: &Statement| it.directive == Directive::Assert && it.fails();
        assert!(prove(fails_within, design(true)).statements.iter().any(fails), "the mutant of {block} passes: {says}");
    }
}

const OF: usize = 4;

#[test]
fn first_quarter() {
    check(0);
}

#[test]
fn second_quarter() {
    check(1);
}

#[test]
fn third_quarter() {
    check(2);
}

#[test]
fn last_quarter() {
    check(3);
}

#[test]
fn the_page_has_a_line_for_each_claim_and_no_other() {
    let claimed: BTreeSet<String> = all()
        .iter()
        .map(|it| format!("| {}{} | {} |", it.block, if it.by_hand { " \\*" } else { "" }, it.says))
        .collect();
    let table =
        PAGE.lines().skip_while(|line| !line.starts_with("|---")).skip(1).take_while(|line| line.starts_with('|'));
    let listed: BTreeSet<String> =
        table.map(|line| line.split(" | ").take(2).collect::<Vec<_>>().join(" | ") + " |").collect();
    assert_eq!(listed, claimed);
}

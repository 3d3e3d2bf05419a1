//! Proves the claims, and prints the table of `docs/proofs.md`. An argument chooses the blocks whose names contain it.
//! The mutants of what is proved by hand are here seen to fail, those of the others in the tests.

use std::time::Instant;
use tilewright_hdl::ir::Directive;
use tilewright_prove::{Error, Prover, Statement};

fn main() -> Result<(), Error> {
    println!("| block | what is proved | by | seconds |\n|---|---|---|---|");
    let wanted = std::env::args().nth(1).unwrap_or_default();
    for claim in tilewright_claims::all().into_iter().filter(|claim| claim.block.contains(&wanted)) {
        let begin = Instant::now();
        let proof = Prover::new().depth(claim.depth).prove(&(claim.design)(false))?;
        let row = claim.row(&proof).unwrap_or_else(|| panic!("{}: {}: {proof:#?}", claim.block, claim.says));
        println!("{row} {:.1} |", begin.elapsed().as_secs_f64());
        if claim.by_hand {
            let mutant = Prover::new().depth(claim.fails_within).prove(&(claim.design)(true))?;
            let fails = |it: &Statement| it.directive == Directive::Assert && it.fails();
            assert!(mutant.statements.iter().any(fails), "the mutant of {} passes", claim.block);
        }
    }
    Ok(())
}

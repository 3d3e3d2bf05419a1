//! Proves the claims of the tests, and prints the table of `docs/proofs.md`. An argument chooses the blocks whose names
//! contain it. The mutants of what is proved by hand are here seen to fail, those of the others in the tests.

#[path = "../tests/harness.rs"]
#[allow(dead_code)]
mod harness;
#[path = "../tests/proofs/mod.rs"]
#[allow(dead_code)]
mod proofs;

fn main() {
    println!("| block | what is proved | by | seconds |\n|---|---|---|---|");
    let wanted = std::env::args().nth(1).unwrap_or_default();
    for claim in proofs::claims().into_iter().filter(|claim| claim.block.contains(&wanted)) {
        match proofs::row(&claim) {
            Some((row, seconds)) => println!("{row} {seconds:.1} |"),
            None => return,
        }
        if claim.by_hand && proofs::mutant_fails(&claim) == Some(false) {
            panic!("the mutant of {} passes", claim.block);
        }
    }
}

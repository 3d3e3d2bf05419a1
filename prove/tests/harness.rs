//! What the tests share.

use tilewright_gen::tools::{Checked, skipped_without};
use tilewright_hdl::{Block, Design, elaborate};
use tilewright_prove::{Outcome, Proof, Prover};

/// The block's design.
#[track_caller]
pub fn design<B: Block>(block: &B) -> Design {
    elaborate(block).unwrap_or_else(|problems| panic!("{problems}"))
}

/// The proof of a design; `None` if a program is missing.
#[track_caller]
pub fn proof(design: &Design, depth: u32) -> Option<Proof> {
    if let Some(Checked::Skipped) = skipped_without(&["yosys", "z3"]) {
        return None;
    }
    Some(Prover::new().depth(depth).prove(design).unwrap_or_else(|error| panic!("{error}")))
}

/// An outcome in a word.
pub fn word(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Proved { depth, needs_periods } => {
            let over = depth.map_or(String::new(), |depth| format!(" over {depth}"));
            format!("proved{over}{}", if *needs_periods { " for the periods" } else { "" })
        }
        Outcome::Fails(run) => format!("happens in {}", run.clock),
        Outcome::Holds { clocks } => format!("holds for {clocks}"),
    }
}

/// The outcomes in words, by message.
pub fn words(proof: &Proof) -> Vec<(&str, String)> {
    proof.statements.iter().map(|it| (it.message.as_str(), word(&it.outcome))).collect()
}

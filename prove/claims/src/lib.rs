//! What is proved of the blocks: each claim is a harness around a block, and a mutant of it that must fail.

mod arithmetic;
mod clocks;
mod frame_buffers;
mod machines;
mod pixels;
mod streams;

use tilewright_hdl::ir::Directive;
use tilewright_hdl::{Block, Design, elaborate};
use tilewright_prove::{Outcome, Proof};

/// A claim about a block.
///
/// ```
/// let claim = tilewright_claims::of("merging-unit").next().expect("there is one");
/// assert_eq!(claim.says, "four clocks later the lesser word comes out");
/// assert_eq!((claim.design)(false).top().properties.len(), 2);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// The blocks in the catalogue that it is about.
    pub of: &'static [&'static str],
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

impl Claim {
    /// The row of the table in `docs/proofs.md`, without the last column; `None` if an assertion is not proved.
    ///
    /// ```
    /// use tilewright_prove::{Error, Prover};
    ///
    /// let claim = tilewright_claims::of("rotator").next().expect("there is one");
    /// match Prover::new().depth(claim.depth).prove(&(claim.design)(false)) {
    ///     Ok(proof) => {
    ///         let row = claim.row(&proof).expect("it is proved");
    ///         assert_eq!(row, "| rotator, 8 bits | no bit is lost in a rotation | induction, k = 1 |");
    ///     }
    ///     Err(Error::Missing(_)) => {} // Yosys or Z3 is not installed
    ///     Err(error) => panic!("{error}"),
    /// }
    /// ```
    pub fn row(&self, proof: &Proof) -> Option<String> {
        let (mut depths, mut edges) = (Vec::new(), "");
        for it in proof.statements.iter().filter(|it| it.directive == Directive::Assert) {
            let Outcome::Proved { depth, needs_periods } = it.outcome else { return None };
            depths.push(depth);
            if needs_periods {
                edges = ", for the periods";
            }
        }
        let deepest = depths.iter().flatten().max();
        let by = match deepest.filter(|_| !depths.contains(&None)) {
            Some(clocks) => format!("induction, k = {clocks}"),
            None => "an invariant".to_owned(),
        };
        let star = if self.by_hand { " \\*" } else { "" };
        Some(format!("| {}{star} | {} | {by}{edges} |", self.block, self.says))
    }
}

/// All claims, in the sequence of the table.
///
/// ```
/// assert!(tilewright_claims::all().len() >= 37);
/// ```
pub fn all() -> Vec<Claim> {
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

/// The claims about a block of the catalogue.
///
/// ```
/// assert_eq!(tilewright_claims::of("dual-clock-fifo").count(), 2);
/// assert_eq!(tilewright_claims::of("ticks").count(), 0);
/// ```
pub fn of(block: &str) -> impl Iterator<Item = Claim> {
    all().into_iter().filter(move |claim| claim.of.contains(&block))
}

/// A claim that the tests prove: the clocks to search, and those in which the mutant fails.
fn claim(
    of: &'static [&'static str],
    block: &'static str,
    says: &'static str,
    [depth, fails_within]: [u32; 2],
    design: fn(bool) -> Design,
) -> Claim {
    Claim { of, block, says, depth, fails_within, by_hand: false, design }
}

/// The design of a harness.
fn design<B: Block>(block: &B) -> Design {
    elaborate(block).unwrap_or_else(|problems| panic!("{problems}"))
}

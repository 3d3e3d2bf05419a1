//! What a proof is made of: what stands in a block, or what each harness around it claims.

use super::{Prove, table};
use crate::block::design;
use crate::shell::{Exit, Failure, Progress, interrupt, terminal};
use std::time::{Duration, Instant};
use tilewright_claims::Claim;
use tilewright_hdl::Design;
use tilewright_hdl::catalog::{Entry, Values};
use tilewright_prove::{Error, Proof, Prover, Statement};

/// A design that is proved.
pub struct Part {
    /// The block and the size that a harness is around; none for the block itself.
    pub harness: Option<&'static str>,
    pub design: Design,
    pub proof: Proof,
}

/// The statements of all parts, in the sequence of their numbers.
pub fn statements(parts: &[Part]) -> impl Iterator<Item = (&Part, &Statement)> {
    parts.iter().flat_map(|part| part.proof.statements.iter().map(move |statement| (part, statement)))
}

/// The tables of all parts.
pub fn text(parts: &[Part]) -> String {
    let (mut text, mut first) = (String::new(), 1);
    for part in parts {
        if let Some(block) = part.harness {
            text += &format!("a harness around {block}\n");
        }
        text += &table(&part.proof, &part.design, first);
        first += part.proof.statements.len();
    }
    text
}

impl Prove {
    /// Proves what stands in the block; or what harnesses claim, if that is asked for, or the block states nothing.
    pub fn parts(&self, entry: &'static Entry, values: &Values) -> Result<Vec<Part>, Failure> {
        let claims: Vec<Claim> = tilewright_claims::of(entry.name).collect();
        if self.harness && claims.is_empty() {
            let sentence =
                format!("no harness is around {0}: leave out --harness to prove what stands in it", entry.name);
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        if !self.harness
            && let Some(part) = self.own(entry, values, !claims.is_empty())?
        {
            return Ok(vec![part]);
        }
        let begin = Instant::now();
        claims.into_iter().map(|claim| self.claimed(&claim, begin)).collect()
    }

    /// Proves what stands in the block; `None` if that is nothing, but harnesses claim something of this size.
    fn own(&self, entry: &'static Entry, values: &Values, is_claimed: bool) -> Result<Option<Part>, Failure> {
        let design = design(entry, values)?;
        let proof = match self.prove(&design, self.depth, self.seconds.map(Duration::from_secs)) {
            Err(Error::Nothing(_)) if is_claimed && *values == entry.values([])? => return Ok(None),
            Err(Error::Nothing(name)) if is_claimed => {
                let sentence =
                    format!("`{name}` states nothing itself, and harnesses have sizes of their own: leave out --set");
                return Err(Failure::new(Exit::BadInput, sentence));
            }
            proof => proof?,
        };
        if is_claimed && !self.json {
            terminal::talk(&format!("harnesses around {} claim more: --harness proves that", entry.name));
        }
        Ok(Some(Part { harness: None, design, proof }))
    }

    /// Proves what a harness claims. Statements of the block in it are left to the block itself.
    fn claimed(&self, claim: &Claim, begin: Instant) -> Result<Part, Failure> {
        let design = (claim.design)(false);
        let left = |seconds| Duration::from_secs(seconds).saturating_sub(begin.elapsed()).max(Duration::from_secs(1));
        let mut proof = self.prove(&design, claim.depth, self.seconds.map(left))?;
        proof.statements.retain(|it| it.module == design.top().name);
        Ok(Part { harness: Some(claim.block), design, proof })
    }

    fn prove(&self, design: &Design, depth: u32, time: Option<Duration>) -> Result<Proof, Error> {
        let prover = Prover::new().depth(depth);
        let prover = time.map_or(prover, |time| prover.seconds(time.as_secs().max(1)));
        // The flag is raised instead of the program being ended, so that the solver is ended, too.
        interrupt::flag();
        let progress = Progress::new();
        prover.prove_watched(design, &|done| progress.show("proving", done), &interrupt::asked)
    }
}

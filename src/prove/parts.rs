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
        text += &table(part, first);
        first += part.proof.statements.len();
    }
    text
}

impl Prove {
    /// Proves what stands in the block, and what harnesses around it claim; these alone, if that is asked for.
    pub fn parts(&self, entry: &'static Entry, values: &Values) -> Result<Vec<Part>, Failure> {
        let mut claims: Vec<Claim> = tilewright_claims::of(entry.name).collect();
        if self.harness && claims.is_empty() {
            let sentence =
                format!("no harness is around {0}: leave out --harness to prove what stands in it", entry.name);
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        // Harnesses have sizes of their own.
        let is_claimed_elsewhere = !claims.is_empty() && *values != entry.values([])?;
        if is_claimed_elsewhere {
            claims.clear();
        }
        let begin = Instant::now();
        // They are proved in seconds, and what stands in a large block takes all of the time.
        let mut parts = claims.iter().map(|it| self.claimed(it, begin)).collect::<Result<Vec<Part>, Failure>>()?;
        if self.harness {
            return Ok(parts);
        }
        let design = design(entry, values)?;
        match self.prove(&design, self.depth, begin) {
            Ok(proof) => parts.insert(0, Part { harness: None, design, proof }),
            Err(Error::Nothing(_)) if !parts.is_empty() => {}
            Err(Error::Nothing(name)) if is_claimed_elsewhere => {
                let sentence =
                    format!("`{name}` states nothing itself, and harnesses have sizes of their own: leave out --set");
                return Err(Failure::new(Exit::BadInput, sentence));
            }
            Err(error) => return Err(error.into()),
        }
        if is_claimed_elsewhere && !self.json {
            let name = entry.name;
            terminal::talk(&format!("harnesses around {name} claim more, at sizes of their own: without --set"));
        }
        Ok(parts)
    }

    /// Proves what a harness claims. Statements of the block in it are left to the block itself.
    fn claimed(&self, claim: &Claim, begin: Instant) -> Result<Part, Failure> {
        let design = (claim.design)(false);
        let mut proof = self.prove(&design, claim.depth, begin)?;
        proof.statements.retain(|it| it.module == design.top().name);
        Ok(Part { harness: Some(claim.block), design, proof })
    }

    /// Proves a design in what is left of the time.
    fn prove(&self, design: &Design, depth: u32, begin: Instant) -> Result<Proof, Error> {
        let prover = Prover::new().depth(depth);
        let left = |seconds| Duration::from_secs(seconds).saturating_sub(begin.elapsed());
        let prover = self.seconds.map_or(prover, |all| prover.seconds(left(all).as_secs_f64().ceil() as u64));
        // The flag is raised instead of the program being ended, so that the solver is ended, too.
        interrupt::flag();
        let progress = Progress::new();
        prover.prove_watched(design, &|done| progress.show("proving", done), &interrupt::asked)
    }
}

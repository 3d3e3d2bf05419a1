//! Proofs and counterexamples.

mod agreement;
mod counterexamples;
mod harness;
mod proofs;

//! Proofs and counterexamples.

mod agreement;
mod clocks;
mod counterexamples;
mod harness;
mod proofs;

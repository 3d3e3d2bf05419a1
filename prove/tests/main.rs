//! Proofs and counterexamples.

mod agreement;
mod clocks;
mod counterexamples;
mod equality;
mod harness;

//! Tests of causes: each rule with all operands, and ways back in small circuits.

mod rules;
mod ways;

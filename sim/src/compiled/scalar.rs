//! Elementwise operations on one lane, in general registers.

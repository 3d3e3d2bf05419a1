//! A synchronous hardware language embedded in Rust.

//! The blocks without streams, each against what its page says.

mod codes;
mod counters;
mod decimal;
mod many;
mod memories;
mod numbers;
mod start;

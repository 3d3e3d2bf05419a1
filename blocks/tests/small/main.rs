//! The blocks without streams, each against what its page says.

mod counters;
mod memories;
mod numbers;
mod start;

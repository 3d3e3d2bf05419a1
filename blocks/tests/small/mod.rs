//! The blocks without streams, each compared with its documentation.

mod codes;
mod counters;
mod decimal;
mod many;
mod memories;
mod numbers;
mod rounding;
mod start;

//! The blocks against what their pages say.

mod catalog;
mod formal;
mod messages;
mod small;
mod streams;
mod verilog;

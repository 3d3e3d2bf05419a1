//! The blocks, compared with their documentation.

mod catalog;
mod chips;
mod examples;
mod formal;
mod messages;
mod pins;
mod small;
mod streams;
mod verilog;

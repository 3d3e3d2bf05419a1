//! The blocks, compared with their documentation.

mod catalog;
mod formal;
mod messages;
mod pins;
mod small;
mod streams;
mod verilog;

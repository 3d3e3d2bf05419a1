//! Tests that run on every engine.

mod answers;
mod arithmetic;
mod arrays;
mod clocks;
mod displays;
mod enabled;
mod in_place_of;
mod kinds;
mod lane_values;
mod lists;
mod memory_waves;
mod pads;
mod processes;
mod properties;
mod shorthand;
mod signed_words;
mod testbench;
mod until;
mod updates;
mod vcd;
mod vcd_values;
mod write_first;

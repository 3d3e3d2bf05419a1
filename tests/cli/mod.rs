//! The command line as a user meets it: what it prints, what it writes, how it fails.

mod bad_input;
mod bench;
mod compare;
mod deferred;
mod determinism;
mod documentation;
mod engine;
mod explain;
mod harness;
mod interruption;
mod limits;
mod lines;
mod list;
mod output;
mod pixel_planes;
mod pixelflow;
mod places;
mod quadtree;
mod render;
mod reproduce;
mod spheres;
mod standard_output;
mod terminal;
mod turn;
mod verilog;
mod wave;

//! The blocks of streams: under stalls, and clock by clock.

mod axi_lite;
mod axi_stream;
mod clocks;
mod crossing;
mod exact;
mod numbers;
mod property;
mod property_tests;
mod quadtree;
mod records;
mod stack;
mod stalls;

//! Blocks with mistakes, for the chapters to show the messages.

#![allow(missing_docs, reason = "they are as short as their mistakes")]

pub mod crossing;
pub mod stages;
pub mod undriven;
pub mod unguarded;
pub mod widths;

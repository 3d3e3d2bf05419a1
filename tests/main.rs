//! The program, its documents and its examples, as their readers meet them.

// The examples of a new crate find its block in this one.
extern crate self as my_block;
use cli::new::block::{Counter, CounterIn};

mod cli;
mod documents;
mod examples;
mod first_block;
mod glossary;
mod guide;
mod papers;
mod ports;
mod tree;

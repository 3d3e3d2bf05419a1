//! The program, its documents and its examples, as their readers meet them.

mod cli;
mod documents;
mod examples;
mod first_block;
mod glossary;
mod papers;
mod ports;

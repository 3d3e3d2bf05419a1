//! The program, its documents and its examples, as their readers meet them.

mod cli;
mod examples;
mod glossary;
mod papers;
mod readme;

//! Every message for a mistake in a description, with the user's own lines that it names.
//!
//! In the expected texts, the source line replaces each place, so that the texts survive edits of this file.

mod choices;
mod clocks;
mod common;
mod elaborations;
mod enabled;
mod first_mistakes;
mod foreign;
mod handles;
mod instances;
mod integers;
mod kinds;
mod limits;
mod lists;
mod loops;
mod names;
mod numbers;
mod outputs;
mod properties;
mod ranges;
mod records;
mod remedies;
mod reports;
mod shapes;
mod stages;
mod state;
mod streams;
mod unused;
mod widths;

//! The language: what descriptions mean, and what is said of those that are wrong.

mod blocks;
mod examples;
mod integers;
mod kept;
mod latency;
mod messages;
mod records;
mod rustc_words;
mod scale;
mod shapes;
mod streams;
mod synchronizers;
mod validate;

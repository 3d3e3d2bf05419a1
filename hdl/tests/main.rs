//! The language: the meaning of descriptions, and the messages for wrong ones.

mod blocks;
mod enabled;
mod examples;
mod integers;
mod kept;
mod latency;
mod messages;
mod records;
mod resets;
mod rustc_words;
mod scale;
mod shapes;
mod streams;
mod synchronizers;
mod validate;

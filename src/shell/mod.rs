//! How a command meets its user: exit codes, errors, output, progress, interruption.

pub mod crash;
mod exit;
pub mod interrupt;
pub mod output;
pub mod place;
pub mod progress;
pub mod terminal;
pub mod text;

pub use exit::{Exit, Failure};
pub use progress::Progress;

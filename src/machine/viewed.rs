//! What the page of `view` knows of a machine beside its frame.

use super::job::Job;
use tilewright_view::{Clock, Grid};

/// A job whose frame can be viewed as it comes into being.
pub trait Viewed: Job {
    /// The clock in which the history's times are counted; all of them are multiples of its period.
    fn clock(&self, report: &Self::Report) -> Clock;

    /// The parts of the screen that the machine treats as a whole.
    fn grid(&self) -> Option<Grid>;
}

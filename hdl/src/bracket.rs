//! The message for `signal[3]`.

use crate::signal::Signal;
use std::ops::Index;

/// Never implemented: `[..]` of a signal would have to return a reference.
#[diagnostic::on_unimplemented(
    message = "a signal is not indexed by `[..]`",
    label = "no `[..]` of a signal",
    note = "one bit is `.bit(3)`, bits 0 to 3 are `.slice(0..4)` or `.part(0, 4)`, a lane is `.lane(3)`, and what a signal selects is `.pick(index)`"
)]
pub trait InBrackets {}

impl<I: InBrackets> Index<I> for Signal {
    type Output = Signal;

    fn index(&self, _: I) -> &Signal {
        unreachable!("nothing is indexed by it")
    }
}

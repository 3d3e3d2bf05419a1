//! The ranges of a block's parameters, and the error for a parameter outside of its range.

use std::fmt::{self, Display};
use std::ops::{Bound, RangeBounds};

use crate::declare::sentence;
use crate::names::{short, unraw};

/// The error for a parameter outside of the range that [`block!`](crate::block!) declares for it. One sentence says
/// which values are valid.
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Counter { width: u32 }
/// #     ranges { width: 1..=64 }
/// # }
/// # impl Counter {
/// #     fn build(&self, _: Module, (): ()) {}
/// # }
/// let problem: OutOfRange = Counter { width: 65 }.checked().unwrap_err();
/// assert_eq!(problem.to_string(), "`width` of `Counter` is 65: it has to be from 1 to 64");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutOfRange(String);

impl Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for OutOfRange {}

/// Checks that a parameter of block `B` is in its range; `said` is the documentation that gives the reason.
#[doc(hidden)]
pub fn in_range<B, T: PartialOrd + Display>(
    name: &str,
    value: &T,
    range: impl RangeBounds<T>,
    said: &[&str],
) -> Result<(), OutOfRange> {
    if range.contains(value) {
        return Ok(());
    }
    let block = short(std::any::type_name::<B>());
    let name = unraw(name);
    let mut problem = format!("`{name}` of `{block}` is {value}: it has to be {}", in_words(&range));
    let reason = sentence(said);
    if !reason.is_empty() {
        problem += &format!(". {reason}");
    }
    Err(OutOfRange(problem))
}

fn in_words<T: Display>(range: &impl RangeBounds<T>) -> String {
    let (start, end) = (range.start_bound(), range.end_bound());
    if let (Bound::Included(least), Bound::Included(most)) = (start, end) {
        return format!("from {least} to {most}");
    }
    let least = match start {
        Bound::Included(least) => Some(format!("at least {least}")),
        Bound::Excluded(below) => Some(format!("above {below}")),
        Bound::Unbounded => None,
    };
    let most = match end {
        Bound::Included(most) => Some(format!("at most {most}")),
        Bound::Excluded(above) => Some(format!("below {above}")),
        Bound::Unbounded => None,
    };
    least.into_iter().chain(most).collect::<Vec<_>>().join(" and ")
}

//! Why a statement differs.

use maud::{Markup, html};
use serde::Serialize;

/// Why a statement differs, in two parts of at least a sentence each.
///
/// ```
/// use tilewright_report::Reason;
///
/// let reason = Reason::new("β is ours.", "The paper would have to print its β.");
/// assert_eq!(Reason::from(["β is ours.", "The paper would have to print its β."]), reason);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Reason {
    /// Where the difference comes from.
    pub why: String,
    /// What would have to change to make the statement true, in the paper or in its reading.
    pub change: String,
}

impl Reason {
    /// A reason.
    ///
    /// ```
    /// let reason = tilewright_report::Reason::new("β is ours.", "The paper would have to print its β.");
    /// assert_eq!(reason.why, "β is ours.");
    /// ```
    pub fn new(why: impl Into<String>, change: impl Into<String>) -> Reason {
        Reason { why: why.into(), change: change.into() }
    }

    pub(crate) fn html(&self) -> Markup {
        html! {
            div.reason {
                p { strong { "Why it differs" } " " (self.why) }
                p { strong { "What would have to change" } " " (self.change) }
            }
        }
    }
}

impl<S: Into<String>> From<[S; 2]> for Reason {
    fn from([why, change]: [S; 2]) -> Reason {
        Reason::new(why, change)
    }
}

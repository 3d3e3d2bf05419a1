//! Why there is no diagram.

use std::fmt;

/// Why there is no diagram.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{Around, DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
/// let around = Around { net: "helt".to_owned(), steps: 1 };
/// let error = diagram(&design, &DiagramOptions { around: Some(around), ..DiagramOptions::default() }).unwrap_err();
/// assert_eq!(error.to_string(), "there is no net `helt`: did you mean `held`?");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DiagramError {
    /// There is no net of that name.
    UnknownNet {
        /// The name.
        net: String,
        /// The one that it may mean.
        similar: Option<String>,
    },
    /// A depth of 0, or around a net within no steps.
    Nothing,
}

impl fmt::Display for DiagramError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            DiagramError::UnknownNet { net, similar: Some(similar) } => {
                write!(f, "there is no net `{net}`: did you mean `{similar}`?")
            }
            DiagramError::UnknownNet { net, similar: None } => {
                write!(
                    f,
                    "there is no net `{net}`: name one of the diagram or of the block's description, or open more levels"
                )
            }
            DiagramError::Nothing => f.write_str("depth and steps are at least 1: less shows nothing"),
        }
    }
}

impl std::error::Error for DiagramError {}

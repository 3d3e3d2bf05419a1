//! Why there is no diagram.

use std::fmt;

/// Why there is no diagram.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{Around, DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
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
        /// The most similar name, if one is close.
        similar: Option<String>,
    },
    /// The depth or the number of steps is 0.
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
                    "there is no net `{net}`: name a port, register, memory, instance or named net of the levels shown, or show more levels"
                )
            }
            DiagramError::Nothing => {
                f.write_str("depth and steps have to be at least 1: with less there is nothing to show")
            }
        }
    }
}

impl std::error::Error for DiagramError {}

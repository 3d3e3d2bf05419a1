//! Errors of the catalogue.

use std::fmt;
use tilewright_circuit::Problems;

use crate::ranges::OutOfRange;

/// Why an entry is not available.
///
/// ```
/// # use tilewright_hdl::catalog::*;
/// # use tilewright_sim::for_examples::COUNTER;
/// let error = COUNTER.values([("clocks", 1000)]).unwrap_err();
/// assert_eq!(error, CatalogError::OutOfRange { name: "clocks", value: 1000, range: [1, 100] });
/// assert_eq!(error.to_string(), "clocks = 1000 is out of range: it is from 1 to 100");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CatalogError {
    /// The block has no such parameter.
    UnknownParameter {
        /// The block.
        block: &'static str,
        /// The name.
        name: String,
        /// The block's parameters.
        known: Vec<&'static str>,
    },
    /// The value is outside of the parameter's range.
    OutOfRange {
        /// The parameter.
        name: &'static str,
        /// The value.
        value: u64,
        /// The least and the greatest value.
        range: [u64; 2],
    },
    /// No hardware exists for these parameters. One sentence gives the reason and the values that would work.
    Parameters(String),
    /// The description has mistakes.
    Description(Problems),
}

impl fmt::Display for CatalogError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            CatalogError::UnknownParameter { block, name, known } if known.is_empty() => {
                write!(f, "{block} has no parameters, so `{name}` cannot be set")
            }
            CatalogError::UnknownParameter { block, name, known } => {
                write!(f, "{block} has no parameter `{name}`; it has {}", known.join(", "))
            }
            CatalogError::OutOfRange { name, value, range: [min, max] } => {
                write!(f, "{name} = {value} is out of range: it is from {min} to {max}")
            }
            CatalogError::Parameters(sentence) => f.write_str(sentence),
            CatalogError::Description(problems) => problems.fmt(f),
        }
    }
}

impl std::error::Error for CatalogError {}

impl From<OutOfRange> for CatalogError {
    fn from(problem: OutOfRange) -> CatalogError {
        CatalogError::Parameters(problem.to_string())
    }
}

impl From<Problems> for CatalogError {
    fn from(problems: Problems) -> CatalogError {
        CatalogError::Description(problems)
    }
}

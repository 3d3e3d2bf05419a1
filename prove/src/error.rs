//! Why there is no proof.

use tilewright_gen::tools::Missing;

/// Why a design cannot be proved, or its proof does not end.
///
/// ```
/// use tilewright_gen::tools::Missing;
/// let missing = Missing { program: "z3", remedy: "apt-get install z3" };
/// assert_eq!(tilewright_prove::Error::from(missing).to_string(), "z3 is not installed: apt-get install z3");
/// ```
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A program is not installed.
    #[error(transparent)]
    Missing(#[from] Missing),
    /// The design of this name has neither an assertion nor a cover.
    #[error("`{0}` states nothing to prove: add m.assert(..) or m.cover(..)")]
    Nothing(String),
    /// The design is not one that can be proved.
    #[error("{0}")]
    Refused(String),
    /// A program fails.
    #[error("{program} fails: {output}")]
    Tool {
        /// Its name.
        program: &'static str,
        /// Its output.
        output: String,
    },
    /// The watcher asked to stop.
    #[error("the proof was interrupted")]
    Interrupted,
    /// The simulator does not show a counterexample.
    #[error(
        "the simulator does not show a counterexample: {0}: this is a mistake in tilewright, please report the design"
    )]
    Unshown(String),
}

impl Error {
    /// A program that fails with this output.
    pub(crate) fn tool(program: &'static str, output: impl Into<String>) -> Error {
        Error::Tool { program, output: output.into() }
    }
}

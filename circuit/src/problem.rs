//! Problems of a description, in whole sentences that name the user's own lines.

use crate::loc::Loc;
use crate::mistake::Mistake;
use std::fmt;

/// One mistake in a hardware description.
///
/// Its text has the sentence with its [number](Mistake), the place, the values involved and a remedy:
///
/// ```text
/// `+` needs equal widths: `count` has 8 bits, `limit` has 7 bits [T101]
///   --> src/counter.rs:11:25
///   `count` is made at src/counter.rs:8:47
///   `limit` is made at src/counter.rs:8:67
///   help: widen the narrow side with `.zext(8)` or `.sext(8)`, or cut the wide one with `.trunc(7)`
/// ```
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Half;
/// #     in HalfIn { word: bits(8) }
/// #     out HalfOut { half: bits(4) }
/// # }
/// # impl Half {
/// #     fn build(&self, _: Module, i: HalfIn) -> HalfOut {
/// HalfOut { half: i.word.slice(4..9) }
/// #     }
/// # }
/// let problem = &elaborate(&Half).unwrap_err().0[0];
/// assert_eq!(problem.help, "a slice is `low..high` with low < high <= 8");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The kind of mistake. Its number ends the sentence, and finds it in the index of messages.
    pub mistake: Mistake,
    /// The sentence, without the number.
    pub message: String,
    /// Where it was noticed: the operator or the call.
    pub loc: Loc,
    /// The other places that matter, each with its description.
    pub notes: Vec<(String, Loc)>,
    /// The remedy.
    pub help: String,
}

impl Problem {
    #[doc(hidden)]
    pub fn new(mistake: Mistake, loc: Loc, message: impl Into<String>) -> Problem {
        Problem { mistake, message: message.into(), loc, notes: Vec::new(), help: String::new() }
    }

    #[doc(hidden)]
    pub fn note(mut self, what: impl Into<String>, loc: Loc) -> Problem {
        self.notes.push((what.into(), loc));
        self
    }

    #[doc(hidden)]
    pub fn help(mut self, help: impl Into<String>) -> Problem {
        self.help = help.into();
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} [{}]\n  --> {}", self.message, self.mistake, self.loc)?;
        for (what, loc) in &self.notes {
            write!(f, "\n  {what} at {loc}")?;
        }
        if !self.help.is_empty() {
            write!(f, "\n  help: {}", self.help)?;
        }
        Ok(())
    }
}

/// All mistakes found in a description, in the sequence in which they were noticed.
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Mixed;
/// #     in MixedIn { a: bits(8), b: bits(7) }
/// #     out MixedOut { sum: bits(8), top: bit() }
/// # }
/// # impl Mixed {
/// #     fn build(&self, _: Module, i: MixedIn) -> MixedOut {
/// let out = MixedOut { sum: i.a + i.b, top: i.a.bit(8) };
/// #         out
/// #     }
/// # }
/// # let problems = elaborate(&Mixed).unwrap_err();
/// assert!(problems.to_string().ends_with("2 problems in this description"));
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Problems(pub Vec<Problem>);

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, problem) in self.0.iter().enumerate() {
            let gap = if i > 0 { "\n\n" } else { "" };
            write!(f, "{gap}{problem}")?;
        }
        match self.0.len() {
            1 => Ok(()),
            n => write!(f, "\n\n{n} problems in this description"),
        }
    }
}

/// Like [`Display`](fmt::Display), after a line break, so that `elaborate(..).unwrap()` reads well.
impl fmt::Debug for Problems {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl std::error::Error for Problems {}

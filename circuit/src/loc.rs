//! A place in the user's source.

use std::fmt;
use std::panic::Location;

/// The place of a call, as `rtl/src/merger/unit.rs:41:9`.
///
/// ```
/// # use tilewright_hdl::*;
/// let here = Loc::caller();
/// assert_eq!(here.to_string(), format!("{}:{}:{}", here.file(), here.line(), here.column()));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Loc(&'static Location<'static>);

impl Loc {
    /// The place where the function that calls this was called, through every `#[track_caller]` above it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// #[track_caller]
    /// fn declared() -> Loc {
    ///     Loc::caller()
    /// }
    /// let (first, second) = (declared(), declared());
    /// assert_eq!(first.line(), second.line());
    /// assert!(first.column() < second.column());
    /// ```
    #[track_caller]
    pub fn caller() -> Loc {
        Loc(Location::caller())
    }

    /// The file, relative to the workspace. A file outside of it is given by its last three components, so that no
    /// absolute path reaches an output.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert!(!Loc::caller().file().starts_with('/'));
    /// ```
    pub fn file(&self) -> &'static str {
        let file = self.0.file();
        if !file.starts_with('/') {
            return file;
        }
        file.rmatch_indices('/').nth(2).map_or(file, |(at, _)| &file[at + 1..])
    }

    /// The line, from 1.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let (here, below) = (
    ///     Loc::caller(),
    ///     Loc::caller(),
    /// );
    /// assert_eq!(here.line() + 1, below.line());
    /// ```
    pub fn line(&self) -> u32 {
        self.0.line()
    }

    /// The column, from 1.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let (left, right) = (Loc::caller(), Loc::caller());
    /// assert_eq!(right.column() - left.column(), "Loc::caller(), ".len() as u32);
    /// ```
    pub fn column(&self) -> u32 {
        self.0.column()
    }
}

impl fmt::Display for Loc {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file(), self.line(), self.column())
    }
}

impl fmt::Debug for Loc {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

//! What a page shows, as its program knows it.

use crate::Page;

/// The data of a page. The server calls it from several threads.
///
/// ```
/// use tilewright_view::{Answer, Page, Site};
///
/// struct Nothing;
///
/// impl Site for Nothing {
///     fn page(&self) -> Page {
///         Page::Frame
///     }
///     fn about(&self) -> String {
///         "{}".to_owned()
///     }
///     fn data(&self, _: &str, _: &str) -> Answer {
///         Answer::Unknown
///     }
/// }
/// assert_eq!(Nothing.data("frame/vc1", ""), Answer::Unknown);
/// ```
pub trait Site: Send + Sync {
    /// The page that shows it.
    ///
    /// ```
    /// use tilewright_view::{Page, Site, for_examples::Empty};
    ///
    /// assert!(matches!(Empty.page(), Page::Frame));
    /// ```
    fn page(&self) -> Page;

    /// What the page has to know before it asks for data: a JSON object.
    ///
    /// ```
    /// use tilewright_view::{Site, for_examples::Empty};
    ///
    /// assert_eq!(Empty.about(), "{}");
    /// ```
    fn about(&self) -> String;

    /// The data of that name, such as `frame/vc1`. It returns within about a tenth of a second, and the page asks again while the data are
    /// being made. The query is what follows a `?`.
    ///
    /// ```
    /// use tilewright_view::{Answer, Site, for_examples::Empty};
    ///
    /// assert_eq!(Empty.data("frame/vc1", "clock=3"), Answer::Unknown);
    /// ```
    fn data(&self, name: &str, query: &str) -> Answer;
}

/// An answer to a page that asks for data.
///
/// ```
/// use tilewright_view::Answer;
///
/// let half = Answer::Working { what: "drawing".to_owned(), done: Some(0.5) };
/// assert_ne!(half, Answer::Unknown);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// The data, as JSON.
    Whole(Vec<u8>),
    /// They are being made. The part that is done is from 0 to 1.
    Working {
        /// The current work.
        what: String,
        /// The part of it that is done, if that is known.
        done: Option<f64>,
    },
    /// They cannot be made, for the reason of this sentence.
    Refused(String),
    /// There are none of that name.
    Unknown,
}

//! The values that a block's parameter may have, and the error for a parameter with another one.

use std::fmt::{self, Display};
use std::ops::{Bound, Range, RangeBounds, RangeFrom, RangeFull, RangeInclusive, RangeTo, RangeToInclusive};

use crate::declare::sentence;
use crate::integers::Integer;
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

/// Checks that a parameter of block `B`, or a field of one, is in its range; `said` is the documentation that gives the
/// reason.
#[doc(hidden)]
pub fn in_range<B, T: Display>(
    path: &[&str],
    value: &T,
    values: impl Values<T>,
    said: &[&str],
) -> Result<(), OutOfRange> {
    if values.allow(value) {
        return Ok(());
    }
    let block = short(std::any::type_name::<B>());
    let name = path.iter().map(|name| unraw(name)).collect::<Vec<_>>().join(".");
    let mut problem = format!("`{name}` of `{block}` is {value}: it has to be {}", values.in_words());
    let reason = sentence(said);
    if !reason.is_empty() {
        problem += &format!(". {reason}");
    }
    Err(OutOfRange(problem))
}

/// The values that a parameter may have, in the `ranges` of [`block!`](crate::block!): a range such as `1..=8`,
/// [`powers_of_two`], [`multiples_of`] or [`any_of`].
///
/// ```
/// # use tilewright_hdl::*;
/// block! {
///     struct Renderer { side: u32, queue: u32, edge: u32 }
///     ranges {
///         side: powers_of_two(2..=256),
///         queue: 1..=64,
///         edge: any_of([4, 8]),
///     }
/// }
/// # impl Renderer {
/// #     fn build(&self, _: Module, (): ()) {}
/// # }
///
/// assert!(Renderer { side: 128, queue: 5, edge: 8 }.checked().is_ok());
/// assert!(Renderer { side: 120, queue: 5, edge: 8 }.checked().is_err());
/// ```
#[diagnostic::on_unimplemented(
    message = "a `{Self}` does not say which values a parameter may have",
    note = "a range such as `1..=8`, `powers_of_two(2..=256)`, `multiples_of(4, 4..=64)` or `any_of([4, 8])` does, with numbers of the parameter's type"
)]
pub trait Values<T> {
    #[doc(hidden)]
    fn allow(&self, value: &T) -> bool;

    /// The end of the sentence that begins with "it has to be".
    #[doc(hidden)]
    fn in_words(&self) -> String;
}

macro_rules! ranges {
    ($($range:ty)*) => {$(
        impl<T: PartialOrd + Display> Values<T> for $range {
            fn allow(&self, value: &T) -> bool {
                self.contains(value)
            }

            fn in_words(&self) -> String {
                in_words::<T>(self)
            }
        }
    )*};
}
ranges!(Range<T> RangeInclusive<T> RangeFrom<T> RangeTo<T> RangeToInclusive<T> RangeFull);

/// The powers of two in a range, for a parameter in the `ranges` of [`block!`](crate::block!).
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Renderer { side: u32 }
/// #     ranges { side: powers_of_two(2..=256) }
/// # }
/// # impl Renderer {
/// #     fn build(&self, _: Module, (): ()) {}
/// # }
/// // side: powers_of_two(2..=256)
/// let problem = Renderer { side: 12 }.checked().unwrap_err().to_string();
/// assert_eq!(problem, "`side` of `Renderer` is 12: it has to be a power of two, from 2 to 256");
/// ```
pub fn powers_of_two<R>(range: R) -> PowersOfTwo<R> {
    PowersOfTwo(range)
}

/// The result of [`powers_of_two`].
///
/// ```
/// # use tilewright_hdl::*;
/// let sides: PowersOfTwo<_> = powers_of_two(2..=256);
/// # let _: &dyn Values<u32> = &sides;
/// ```
#[derive(Debug, Clone, Copy)]
pub struct PowersOfTwo<R>(R);

impl<T: Integer + PartialOrd, R: RangeBounds<T>> Values<T> for PowersOfTwo<R> {
    fn allow(&self, value: &T) -> bool {
        self.0.contains(value) && u128::try_from(value.integer()).is_ok_and(u128::is_power_of_two)
    }

    fn in_words(&self) -> String {
        within("a power of two", &self.0)
    }
}

/// The multiples of a number in a range, for a parameter in the `ranges` of [`block!`](crate::block!).
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Line { pixels: u32 }
/// #     ranges { pixels: multiples_of(8, 8..) }
/// # }
/// # impl Line {
/// #     fn build(&self, _: Module, (): ()) {}
/// # }
/// // pixels: multiples_of(8, 8..)
/// let problem = Line { pixels: 12 }.checked().unwrap_err().to_string();
/// assert_eq!(problem, "`pixels` of `Line` is 12: it has to be a multiple of 8, at least 8");
/// ```
pub fn multiples_of<R>(number: u32, range: R) -> MultiplesOf<R> {
    MultiplesOf { number, range }
}

/// The result of [`multiples_of`].
///
/// ```
/// # use tilewright_hdl::*;
/// let pixels: MultiplesOf<_> = multiples_of(8, 8..);
/// # let _: &dyn Values<u32> = &pixels;
/// ```
#[derive(Debug, Clone, Copy)]
pub struct MultiplesOf<R> {
    number: u32,
    range: R,
}

impl<T: Integer + PartialOrd, R: RangeBounds<T>> Values<T> for MultiplesOf<R> {
    fn allow(&self, value: &T) -> bool {
        self.range.contains(value) && value.integer().checked_rem(self.number.into()) == Some(0)
    }

    fn in_words(&self) -> String {
        within(&format!("a multiple of {}", self.number), &self.range)
    }
}

/// A few values, for a parameter in the `ranges` of [`block!`](crate::block!).
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Patches { edge: u32 }
/// #     ranges { edge: any_of([4, 8, 16]) }
/// # }
/// # impl Patches {
/// #     fn build(&self, _: Module, (): ()) {}
/// # }
/// // edge: any_of([4, 8, 16])
/// let problem = Patches { edge: 5 }.checked().unwrap_err().to_string();
/// assert_eq!(problem, "`edge` of `Patches` is 5: it has to be 4, 8 or 16");
/// ```
pub fn any_of<T, const N: usize>(values: [T; N]) -> AnyOf<T, N> {
    AnyOf(values)
}

/// The result of [`any_of`].
///
/// ```
/// # use tilewright_hdl::*;
/// let edges: AnyOf<u32, 3> = any_of([4, 8, 16]);
/// # let _: &dyn Values<u32> = &edges;
/// ```
#[derive(Debug, Clone, Copy)]
pub struct AnyOf<T, const N: usize>([T; N]);

impl<T: PartialEq + Display, const N: usize> Values<T> for AnyOf<T, N> {
    fn allow(&self, value: &T) -> bool {
        self.0.contains(value)
    }

    fn in_words(&self) -> String {
        let values: Vec<String> = self.0.iter().map(T::to_string).collect();
        match values.split_last() {
            Some((last, [])) => last.clone(),
            Some((last, others)) => format!("{} or {last}", others.join(", ")),
            None => "none".to_owned(),
        }
    }
}

/// What a value is, and its range unless that is unbounded.
fn within<T: Display>(what: &str, range: &impl RangeBounds<T>) -> String {
    let range = in_words(range);
    if range.is_empty() { what.to_owned() } else { format!("{what}, {range}") }
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

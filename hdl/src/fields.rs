//! Records: leaves, and whatever contains leaves.

use crate::bundle::join;
use crate::integers::for_integers;
use crate::signal::Signal;
use crate::width::Width;
use crate::{Bits, Loc};

/// The leaf of a bundle: a signal, a width, a value or a handle.
///
/// ```
/// # use tilewright_hdl::*;
/// bundle! { struct Pixel<T> { z: T, rgb: T } }
///
/// let widths = Pixel { z: bits(16), rgb: bits(24) };
/// let names: Pixel<String> = widths.map_fields("nearest", &mut |path, _| path.to_owned());
/// assert_eq!(names.rgb, "nearest.rgb");
/// ```
pub trait Leaf: Clone {}

impl Leaf for Signal {}
impl Leaf for Width {}
impl Leaf for Bits {}
impl Leaf for Loc {}
impl Leaf for String {}
impl Leaf for bool {}
impl Leaf for u128 {}

macro_rules! leaves {
    ($($ty:ty)*) => {$(
        impl Leaf for $ty {}
    )*};
}
for_integers!(leaves);

/// An item that [`Fields::visit`] shows.
///
/// ```
/// # use tilewright_hdl::*;
/// let mut seen = Vec::new();
/// [stream(8)].to_vec().visit(&mut |part| {
///     seen.push(match part {
///         Visited::Leaf(width) => format!("{} forth", width.bits()),
///         Visited::Back(width) => format!("{} back", width.bits()),
///         Visited::List(count) => format!("{count} of these:"),
///     });
/// });
/// assert_eq!(seen, ["1 of these:", "1 forth", "1 back", "8 forth"]); // `valid`, `ready` and the payload
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Visited<'a, T> {
    /// A leaf.
    Leaf(&'a T),
    /// A leaf in the opposite direction, as the `ready` of a [`Stream`](crate::Stream).
    Back(&'a T),
    /// A `Vec` of this length; its elements follow.
    List(usize),
}

/// A record with leaves `T`: a leaf itself, an array or list of records, or a struct made by
/// [`bundle!`](crate::bundle!).
///
/// ```
/// # use tilewright_hdl::*;
/// bundle! {
///     struct Pixel<T> { z: T, rgb: T }
///     struct Pair<T> { left: Pixel<T>, others: Vec<Pixel<T>> }
/// }
///
/// let pixel = Pixel { z: bits(16), rgb: bits(24) };
/// let pair = Pair { left: pixel, others: vec![pixel; 2] };
/// assert_eq!(pair.leaves().iter().map(|(_, width)| width.bits()).sum::<u32>(), 120);
/// assert_eq!(pair.leaves()[4].0, "others.1.z");
/// ```
pub trait Fields<T: Leaf>: Sized {
    /// The same record with leaves `U`.
    type With<U: Leaf>: Fields<U>;

    /// The record with `f` applied to each leaf, in the sequence of declaration; `f` also gets the leaf's path, such
    /// as `left.z`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// bundle! { struct Pixel<T> { z: T, rgb: T } }
    ///
    /// let mut paths = Vec::new();
    /// Pixel { z: 1u64, rgb: 2 }.map_fields("left", &mut |path, value| {
    ///     paths.push(format!("{path} = {value}"));
    ///     *value
    /// });
    /// assert_eq!(paths, ["left.z = 1", "left.rgb = 2"]);
    /// ```
    fn map_fields<U: Leaf>(&self, path: &str, f: &mut dyn FnMut(&str, &T) -> U) -> Self::With<U>;

    /// The record with `f` applied to each leaf.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// bundle! { struct Pixel<T> { z: T, rgb: T } }
    ///
    /// let widths = Pixel { z: bits(16), rgb: bits(24) };
    /// let largest: Pixel<Bits> = widths.map(|width| Bits::ones(width.bits()));
    /// assert_eq!(largest.rgb, 0xff_ffff);
    /// ```
    fn map<U: Leaf>(&self, mut f: impl FnMut(&T) -> U) -> Self::With<U> {
        self.map_leaves(&mut f)
    }

    /// Like [`Fields::map_fields`], without the cost of making paths.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// bundle! { struct Pixel<T> { z: T, rgb: T } }
    ///
    /// let zeros = Pixel { z: 5u64, rgb: 7 }.map_leaves(&mut |_| 0u64);
    /// assert_eq!(zeros, Pixel { z: 0, rgb: 0 });
    /// ```
    fn map_leaves<U: Leaf>(&self, f: &mut impl FnMut(&T) -> U) -> Self::With<U> {
        self.map_fields("", &mut |_, leaf| f(leaf))
    }

    /// Shows `f` each leaf in the sequence of declaration, and the length of each `Vec` before its elements.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let list: Vec<u64> = vec![3, 4];
    /// let mut sum = 0;
    /// list.visit(&mut |part| {
    ///     if let Visited::Leaf(value) = part {
    ///         sum += value;
    ///     }
    /// });
    /// assert_eq!(sum, 7);
    /// ```
    fn visit(&self, f: &mut impl FnMut(Visited<T>)) {
        self.map_leaves(&mut |leaf| {
            f(Visited::Leaf(leaf));
            leaf.clone()
        });
    }

    /// Shows `f` the documentation of each record and each leaf, with its path; in these paths, elements of lists
    /// have no number.
    #[doc(hidden)]
    fn documentation(path: &str, said: &str, f: &mut dyn FnMut(&str, &str)) {
        f(path, said);
    }

    /// Each leaf with its path, in the sequence of declaration.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let leaves = [5u64, 6].leaves();
    /// assert_eq!(leaves, [("0".to_owned(), 5), ("1".to_owned(), 6)]); // list elements are named by their index
    /// ```
    fn leaves(&self) -> Vec<(String, T)> {
        let mut leaves = Vec::new();
        self.map_fields("", &mut |path, leaf| {
            leaves.push((path.to_owned(), leaf.clone()));
            leaf.clone()
        });
        leaves
    }
}

impl<T: Leaf> Fields<T> for T {
    type With<U: Leaf> = U;

    fn map_fields<U: Leaf>(&self, path: &str, f: &mut dyn FnMut(&str, &T) -> U) -> U {
        f(path, self)
    }

    fn map_leaves<U: Leaf>(&self, f: &mut impl FnMut(&T) -> U) -> U {
        f(self)
    }

    fn visit(&self, f: &mut impl FnMut(Visited<T>)) {
        f(Visited::Leaf(self));
    }
}

/// Elements are named by their index.
impl<T: Leaf, B: Fields<T>> Fields<T> for Vec<B> {
    type With<U: Leaf> = Vec<B::With<U>>;

    fn documentation(path: &str, said: &str, f: &mut dyn FnMut(&str, &str)) {
        B::documentation(path, said, f);
    }

    fn map_fields<U: Leaf>(&self, path: &str, f: &mut dyn FnMut(&str, &T) -> U) -> Self::With<U> {
        self.iter().enumerate().map(|(i, element)| element.map_fields(&join(path, &i.to_string()), f)).collect()
    }

    fn map_leaves<U: Leaf>(&self, f: &mut impl FnMut(&T) -> U) -> Self::With<U> {
        self.iter().map(|element| element.map_leaves(f)).collect()
    }

    fn visit(&self, f: &mut impl FnMut(Visited<T>)) {
        f(Visited::List(self.len()));
        self.iter().for_each(|element| element.visit(f));
    }
}

/// Elements are named by their index.
impl<T: Leaf, B: Fields<T>, const N: usize> Fields<T> for [B; N] {
    type With<U: Leaf> = [B::With<U>; N];

    fn documentation(path: &str, said: &str, f: &mut dyn FnMut(&str, &str)) {
        B::documentation(path, said, f);
    }

    fn map_fields<U: Leaf>(&self, path: &str, f: &mut dyn FnMut(&str, &T) -> U) -> Self::With<U> {
        std::array::from_fn(|i| self[i].map_fields(&join(path, &i.to_string()), f))
    }

    fn map_leaves<U: Leaf>(&self, f: &mut impl FnMut(&T) -> U) -> Self::With<U> {
        std::array::from_fn(|i| self[i].map_leaves(f))
    }

    fn visit(&self, f: &mut impl FnMut(Visited<T>)) {
        self.iter().for_each(|element| element.visit(f));
    }
}

/// No fields: the inputs of a block that has none.
impl<T: Leaf> Fields<T> for () {
    type With<U: Leaf> = ();

    fn map_fields<U: Leaf>(&self, _: &str, _: &mut dyn FnMut(&str, &T) -> U) {}

    fn visit(&self, _: &mut impl FnMut(Visited<T>)) {}
}

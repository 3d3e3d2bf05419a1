//! Bundles: one record type for widths, signals, values and names.

use crate::fields::{Fields, Leaf};
use crate::names::unraw;
use crate::signal::Signal;

/// A record of signals, one of a family of record types. [`bundle!`](crate::bundle!) and
/// [`record!`](crate::record!) implement this trait.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// bundle! { struct Pixel<T> { z: T, rgb: T } }
///
/// /// The record whose first field is less.
/// fn nearer<B: Bundle + Fits<B>>(a: B, b: B) -> B {
///     let depth = |record: &B| record.leaves()[0].1;
///     mux(depth(&a).le(depth(&b)), a, b)
/// }
///
/// let [a, b] = [7, 5].map(|z| Pixel { z: lit(8, z), rgb: lit(24, z) });
/// m.assert(nearer(a, b).rgb.eq(5), "a helper for any record");
/// # });
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a record of signals",
    note = "a record is a struct that `record!` or `bundle!` makes"
)]
pub trait Bundle: Fields<Signal, With<Signal> = Self> + Clone + 'static {
    /// The same record type with other leaves.
    type Of<T: Leaf>: Fields<T, With<Signal> = Self> + Clone;

    /// The record with `f` applied to each signal and its path.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Pixel<T> { z: T, rgb: T } }
    ///
    /// let pixel = Pixel { z: lit(16, 5), rgb: lit(24, 7) };
    /// let widths: Pixel<u32> = pixel.of(&mut |_, signal| signal.width());
    /// m.assert(pixel.z.eq(5) & pixel.rgb.eq(lit(widths.rgb, 7)), "each field has its value");
    /// # });
    /// ```
    fn of<U: Leaf>(&self, f: &mut dyn FnMut(&str, &Signal) -> U) -> Self::Of<U>;

    /// The record of signals with `f` applied to each leaf and its path.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Pixel<T> { z: T, rgb: T } }
    ///
    /// let numbers = Pixel { z: 5, rgb: 7u64 };
    /// let pixel = Pixel::signals(&numbers, &mut |_, number| lit(24, *number));
    /// m.assert(pixel.z.eq(5) & pixel.rgb.eq(7), "constants");
    /// # });
    /// ```
    fn signals<T: Leaf>(of: &Self::Of<T>, f: &mut dyn FnMut(&str, &T) -> Signal) -> Self;

    /// The record with `f` applied to each leaf and its path.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// bundle! { struct Pixel<T> { z: T, rgb: T } }
    ///
    /// let numbers = Pixel { z: 5u64, rgb: 7 };
    /// let words: Pixel<String> = <Pixel as Bundle>::convert(&numbers, &mut |path, number| format!("{path} is {number}"));
    /// assert_eq!(words.rgb, "rgb is 7");
    /// ```
    fn convert<T: Leaf, U: Leaf>(of: &Self::Of<T>, f: &mut dyn FnMut(&str, &T) -> U) -> Self::Of<U>;

    /// Like [`Bundle::convert`], without the cost of making paths.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// bundle! { struct Pixel<T> { z: T, rgb: T } }
    ///
    /// /// Doubles each number of a record of any type.
    /// fn doubled<B: Bundle>(numbers: &B::Of<u64>) -> B::Of<u64> {
    ///     B::convert_leaves(numbers, &mut |number: &u64| 2 * number)
    /// }
    /// assert_eq!(doubled::<Pixel>(&Pixel { z: 5, rgb: 7 }), Pixel { z: 10, rgb: 14 });
    /// ```
    fn convert_leaves<T: Leaf, U: Leaf>(of: &Self::Of<T>, f: &mut impl FnMut(&T) -> U) -> Self::Of<U>;
}

impl Bundle for () {
    type Of<T: Leaf> = ();

    fn of<U: Leaf>(&self, _: &mut dyn FnMut(&str, &Signal) -> U) {}

    fn signals<T: Leaf>(_: &(), _: &mut dyn FnMut(&str, &T) -> Signal) {}

    fn convert<T: Leaf, U: Leaf>(_: &(), _: &mut dyn FnMut(&str, &T) -> U) {}

    fn convert_leaves<T: Leaf, U: Leaf>(_: &(), _: &mut impl FnMut(&T) -> U) {}
}

#[doc(hidden)]
pub fn join(path: &str, field: &str) -> String {
    let field = unraw(field);
    if path.is_empty() { field.to_owned() } else { [path, ".", field].concat() }
}

/// Declares records that serve as widths, signals, values and names at once. [`record!`](crate::record!) also gives
/// each field its width.
///
/// The declaration is a plain generic struct. The leaf type defaults to `Signal`. Records may nest, and may contain
/// arrays and `Vec`s of leaves or records.
///
/// ```
/// use tilewright_hdl::{bundle, bits, Bits, Fields, Width};
///
/// bundle! {
///     /// A sample of an image.
///     pub struct Pixel<T> {
///         /// Depth; nearer is smaller.
///         pub z: T,
///         /// Colour.
///         pub rgb: T,
///     }
///
///     /// The inputs of a comparison.
///     pub struct Pair<T> {
///         pub left: Pixel<T>,
///         pub right: Pixel<T>,
///     }
/// }
///
/// let widths: Pixel<Width> = Pixel { z: bits(24), rgb: bits(24) };
/// let value: Pair<u64> = Pair { left: Pixel { z: 5, rgb: 0 }, right: Pixel { z: 7, rgb: 1 } };
/// assert_eq!(value.leaves()[2], ("right.z".to_owned(), 7));
/// # let _ = widths;
/// ```
///
/// A record of numbers has a default, in which every number is 0 and every list is empty. So a test names what is
/// not 0:
///
/// ```
/// # use tilewright_hdl::*;
/// # bundle! { struct LampIn<T> { on: T, red: T, green: T, blue: T } }
/// let red = LampIn { on: 1, red: 200u64, ..LampIn::default() };
/// assert_eq!(red, LampIn { on: 1, red: 200, green: 0, blue: 0 });
/// ```
///
/// A record of signals is a value. Registers, wires and memories store it ([`Reg`](crate::Reg), [`Mem`](crate::Mem));
/// [`mux`](crate::mux()), [`select`](crate::select()) and [`case`](crate::case()) choose between records. Packed into
/// a word, the fields stand side by side, the first most significant:
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// bundle! { struct Pixel<T> { z: T, rgb: T } }
///
/// let layout = Pixel { z: bits(24), rgb: bits(24) };
/// def!(pixel = layout.unpack(lit(48, 0x000005_ff8000)));       // nets `pixel_z` and `pixel_rgb`
/// let darker = Pixel { rgb: pixel.rgb >> 1, ..pixel };
/// let word: Signal = darker.pack();
/// m.assert(word.eq(0x000005_7fc000), "the depth is unchanged");
/// # });
/// ```
#[macro_export]
macro_rules! bundle {
    ($($(#[$attribute:meta])* $vis:vis struct $name:ident<$leaf:ident> {
        $($(#[$($field_attribute:tt)*])* $field_vis:vis $field:ident: $ty:ty),* $(,)?
    })*) => {$(
        $(#[$attribute])*
        #[derive(Debug, Clone, PartialEq)]
        $vis struct $name<$leaf = $crate::Signal> {
            $($(#[$($field_attribute)*])* $field_vis $field: $ty),*
        }

        impl<$leaf: Copy> Copy for $name<$leaf> where $($ty: Copy),* {}

        /// Zeros, for the numbers of a test; a list is empty.
        impl<$leaf: Default> Default for $name<$leaf> where $($ty: Default),* {
            fn default() -> Self {
                $name { $($field: Default::default()),* }
            }
        }

        impl<$leaf: $crate::Leaf> $crate::Fields<$leaf> for $name<$leaf> {
            type With<U: $crate::Leaf> = $name<U>;

            fn documentation(path: &str, said: &str, f: &mut dyn FnMut(&str, &str)) {
                f(path, said);
                $(<$ty as $crate::Fields<$leaf>>::documentation(
                    &$crate::join(path, stringify!($field)),
                    &$crate::sentence(&[$($crate::doc_line!($($field_attribute)*)),*]),
                    f,
                );)*
            }

            fn map_fields<U: $crate::Leaf>(
                &self,
                path: &str,
                f: &mut dyn FnMut(&str, &$leaf) -> U,
            ) -> $name<U> {
                $name { $($field: <$ty as $crate::Fields<$leaf>>::map_fields(
                    &self.$field,
                    &$crate::join(path, stringify!($field)),
                    f,
                )),* }
            }

            fn map_leaves<U: $crate::Leaf>(&self, f: &mut impl FnMut(&$leaf) -> U) -> $name<U> {
                $name { $($field: <$ty as $crate::Fields<$leaf>>::map_leaves(&self.$field, f)),* }
            }

            fn visit(&self, f: &mut impl FnMut($crate::Visited<$leaf>)) {
                $(<$ty as $crate::Fields<$leaf>>::visit(&self.$field, f);)*
            }
        }

        impl $crate::Bundle for $name {
            type Of<$leaf: $crate::Leaf> = $name<$leaf>;

            fn of<U: $crate::Leaf>(&self, f: &mut dyn FnMut(&str, &$crate::Signal) -> U) -> $name<U> {
                $crate::Fields::map_fields(self, "", f)
            }

            fn signals<T: $crate::Leaf>(
                of: &$name<T>,
                f: &mut dyn FnMut(&str, &T) -> $crate::Signal,
            ) -> $name {
                $crate::Fields::map_fields(of, "", f)
            }

            fn convert<T: $crate::Leaf, U: $crate::Leaf>(
                of: &$name<T>,
                f: &mut dyn FnMut(&str, &T) -> U,
            ) -> $name<U> {
                $crate::Fields::map_fields(of, "", f)
            }

            fn convert_leaves<T: $crate::Leaf, U: $crate::Leaf>(
                of: &$name<T>,
                f: &mut impl FnMut(&T) -> U,
            ) -> $name<U> {
                $crate::Fields::map_leaves(of, f)
            }
        }

        impl<$leaf: $crate::Leaf + $crate::IntoWidth> $crate::Layout for $name<$leaf> {
            type Value = $name;

            fn layout(self) -> $name<$crate::Width> {
                $crate::Fields::map(&self, |width| $crate::IntoWidth::into_width(width.clone()))
            }
        }

        impl<$leaf: $crate::Leaf + $crate::Operand> $crate::Fits<$name> for $name<$leaf> {
            fn given(self) -> $crate::Given<$name> {
                $crate::Given::Each($crate::Fields::map(&self, |leaf| $crate::Operand::operand(leaf.clone())))
            }
        }

        #[allow(dead_code)]
        impl $name {
            /// The fields side by side in one signal, the first most significant, as in [`cat!`]($crate::cat!).
            #[track_caller]
            $vis fn pack(&self) -> $crate::Signal {
                $crate::pack(self)
            }

            /// Names the net of each field `NAME_FIELD` in waves and in Verilog.
            #[track_caller]
            $vis fn named(&self, name: &str) -> $name {
                $crate::named(self, name)
            }

            /// The same record, freed from the pipeline check: it may meet values of any stage.
            #[track_caller]
            $vis fn any_stage(&self) -> $name {
                $crate::any_stage(self)
            }

            /// The input of a pipeline whose registers for the chosen fields are cleared by a reset in each stage, as
            /// in `start.cleared(|start| start.valid)`.
            $vis fn cleared<WhichFields: $crate::Fields<usize>>(
                self,
                which: impl FnOnce($name<usize>) -> WhichFields,
            ) -> $crate::Start<$name> {
                $crate::cleared(self, which)
            }
        }

        #[allow(dead_code)]
        impl $name<$crate::Width> {
            /// The same widths, for values that are all synchronous to `clock`.
            $vis fn on(self, clock: $crate::Clock) -> Self {
                $crate::Fields::map(&self, |width| width.on(clock))
            }

            /// The record whose fields stand side by side in `word`, the first most significant.
            #[track_caller]
            $vis fn unpack(&self, word: impl Into<$crate::Signal>) -> $name {
                $crate::unpack(self, word.into())
            }
        }
    )*};
}

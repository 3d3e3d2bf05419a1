//! `record!`: records whose declaration gives each field its width.

use crate::bundle::Bundle;
use crate::width::Width;

/// A record whose widths follow from its name: one that [`record!`](crate::record!) declares without parameters.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
///
/// /// A register for any such record.
/// fn cleared<R: Record>(m: Module, name: &str) -> Reg<R>
/// where
///     R::Of<Width>: Layout<Value = R>,
/// {
///     m.reg(name, R::widths()).reset(0)
/// }
///
/// let nearest = cleared::<Pixel>(m, "nearest");
/// nearest.next(Pixel { z: nearest.z + 1, ..*nearest });
/// # });
/// assert_eq!(example.values("nearest_z"), [0, 1, 2]);
/// ```
#[diagnostic::on_unimplemented(
    message = "the name `{Self}` does not say how wide the fields are",
    label = "a record with widths of its own is expected here",
    note = "it does for a `record!` without parameters; otherwise the widths are given, as in `entry: Entry::widths(12)` \
            or `entry: Entry = self.entry()`"
)]
pub trait Record: Bundle {
    /// The width of each field.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// record! { struct Pixel { z: bits(16), rgb: bits(24) } }
    ///
    /// assert_eq!(<Pixel as Record>::widths().rgb.bits(), 24);
    /// ```
    fn widths() -> Self::Of<Width>;
}

/// Declares records together with the width of each field: a [`bundle!`](crate::bundle!) with a function `widths`.
///
/// ```
/// # use tilewright_hdl::*;
/// codes! {
///     /// The function of an ALU.
///     pub enum Function { Add, Subtract, And }
/// }
///
/// record! {
///     /// The control of an ALU.
///     pub struct Control {
///         /// What it computes.
///         function: one_of::<Function>(),
///         /// The second operand.
///         constant: bits(8),
///     }
/// }
///
/// block! {
///     /// An ALU with an accumulator.
///     pub struct Alu;
///     in AluIn {
///         /// What it does in this clock.
///         control: Control,
///     }
///     out AluOut { accumulator: bits(8) }
/// }
///
/// impl Alu {
///     fn build(&self, m: Module, i: AluIn) -> AluOut {
///         def!(current = m.reg(Control::widths()).reset(Control::ZERO));
///         current.next(i.control);
///         def!(accumulator = m.reg(8).reset(0));
///         accumulator.next(current.function.choose(|function| match function {
///             Function::Add => accumulator + current.constant,
///             Function::Subtract => accumulator - current.constant,
///             Function::And => accumulator & current.constant,
///         }));
///         AluOut { accumulator: *accumulator }
///     }
/// }
///
/// let mut sim = tilewright_sim::Simulation::of(&Alu)?;
/// sim.drive(AluIn { control: Control { constant: 5, ..Control::ZERO } }); // 0 is `Add`
/// sim.run(3);
/// assert_eq!(sim.get(sim.o.accumulator), 10);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
///
/// A field is written as a port of [`block!`](crate::block!) is, and is as visible as the record. Its documentation
/// stands beside the port in Verilog. The macro declares:
///
/// | name | meaning |
/// |---|---|
/// | `Control` | the record: [`bundle!`](crate::bundle!) says what it is good for |
/// | `Control::widths()` | the width of each field, to declare a register, wire, memory or port |
/// | `Control::ZERO` | zeros, as numbers; of a record with a list, whose length is not known there, it does not exist |
/// | `control: Control` | a field or a port of this record, in `record!` and in [`block!`](crate::block!); also `[Control; 4]` and `stream(Control)` |
///
/// The widths of a record may depend on parameters, which become those of `widths`:
///
/// ```
/// # use tilewright_hdl::*;
/// record! {
///     /// A place on a screen.
///     struct Position(columns: u32, rows: u32) { x: below(columns), y: below(rows) }
///
///     /// A line between two places.
///     struct Line(side: u32) {
///         ends: [Position::widths(side, side); 2],
///         thick: bit(),
///     }
/// }
///
/// block! {
///     /// Says which lines are thick.
///     struct Filter { side: u32 }
///     in(self) FilterIn { line: Line::widths(self.side) }
///     out FilterOut { is_thick: bit() }
/// }
/// # impl Filter {
/// #     fn build(&self, m: Module, i: FilterIn) -> FilterOut {
/// #         m.ignore(&i);
/// #         FilterOut { is_thick: i.line.thick }
/// #     }
/// # }
///
/// assert_eq!(Filter { side: 640 }.inputs().line.ends[1].y.bits(), 10);
/// ```
#[macro_export]
macro_rules! record {
    () => {};
    ($(#[$($said:tt)*])* $vis:vis struct $name:ident $(($($given:tt)*))? { $($fields:tt)* } $($more:tt)*) => {
        $crate::block_ports! { @ports [record [$([$($said)*])*] [$vis] $name [$(($($given)*))?]] [] [$($fields)*] }
        $crate::record! { $($more)* }
    };

    // The fields are known: the documentation, name, type and width of each.
    (@declare [$([$($said:tt)*])*] [$vis:vis] $name:ident [$(($($given:tt)*))?]
        $({[$([$($field_said:tt)*])*] $field:ident [$($ty:tt)*] [$($width:expr)?]})*
    ) => {
        $crate::bundle! {
            $(#[$($said)*])*
            $vis struct $name<T> { $($(#[$($field_said)*])* $vis $field: $($ty)*),* }
        }

        #[allow(dead_code)]
        impl $name<$crate::Width> {
            /// The width of each field.
            #[must_use]
            $vis fn widths($($($given)*)?) -> $name<$crate::Width> {
                $name { $($field: $crate::record!(@width $field $($width)?)),* }
            }
        }

        #[allow(dead_code)]
        impl<T: $crate::Leaf> $name<T> where (): $crate::Numbers<Are = T>, $($($ty)*: $crate::Zero),* {
            /// Each field is 0.
            $vis const ZERO: $name<T> = $name { $($field: $crate::Zero::ZERO),* };
        }

        impl<T: $crate::Leaf> $crate::Zero for $name<T> where $($($ty)*: $crate::Zero),* {
            const ZERO: $name<T> = $name { $($field: $crate::Zero::ZERO),* };
        }

        $crate::record! { @by_name $name [$(($($given)*))?] }
    };

    (@by_name $name:ident []) => {
        impl $crate::Record for $name {
            fn widths() -> $name<$crate::Width> {
                $name::widths()
            }
        }
    };
    (@by_name $name:ident $given:tt) => {};

    (@width $field:ident $width:expr) => {
        $width
    };
    (@width $field:ident) => {{
        $crate::wrong_field! { HasWidth $field }
        ::std::unreachable!()
    }};

    // What is no record.
    ($(#[$($said:tt)*])* $vis:vis struct $name:tt <$leaf:ident> { $($fields:tt)* } $($more:tt)*) => {
        $crate::wrong_field! { TakesNoType $name }
        $crate::bundle! { $(#[$($said)*])* $vis struct $name<$leaf> { $($fields)* } }
        $crate::record! { $($more)* }
    };
    ($(#[$($said:tt)*])* $vis:vis $what:ident $name:tt $($more:tt)*) => {
        $crate::wrong_field! { HasFields $name }
    };
}

/// A mistake in a declaration that rustc is to report at this name, in the words of this trait.
#[doc(hidden)]
#[macro_export]
macro_rules! wrong_field {
    ($rule:ident $name:tt) => {
        // As a value, the name is where rustc reports the mistake.
        const _: fn() = || {
            #[allow(non_camel_case_types, dead_code)]
            struct $name;
            fn follows(_: impl $crate::rules::$rule) {}
            follows($name)
        };
    };
}

/// The rules of a declaration. Nothing implements them: rustc's message for what does not is that of the rule.
#[doc(hidden)]
pub mod rules {
    macro_rules! rules {
        ($($name:ident: $message:literal, $help:literal;)*) => {$(
            #[diagnostic::on_unimplemented(message = $message, label = "in this declaration", note = $help)]
            pub trait $name {}
        )*};
    }

    rules! {
        IsField: "a field of a record and a port are declared as `name: width,`",
            "a width is `bit()`, `bits(n)`, `below(n)`, `up_to(n)` or a record";
        HasWidth: "a field of a record has a width",
            "`_` is as wide as its driver, and is for the outputs of a block";
        HasNoPub: "a field of a record and a port have no `pub`", "they are as visible as the struct";
        TakesNoType: "a record that is declared with its widths has no type parameter",
            "`record!` adds it by itself; without widths, write `bundle!`";
        HasFields: "a record is a struct with fields in braces",
            "without parameters `struct Entry {{ page: bits(4) }}`, with parameters `struct Entry(pages: u32) {{ page: below(pages) }}`";
    }
}

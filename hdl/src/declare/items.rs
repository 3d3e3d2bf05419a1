//! The items that `block!` generates once its clauses are read.

use crate::module::Module;

/// The bundles of a block's ports, and the functions of its `impl Block`.
#[doc(hidden)]
#[macro_export]
macro_rules! block_items {
    (@name []) => {};
    (@name [=> $said:expr]) => { $crate::block_items! { @name [self => $said] } };
    (@name [$this:ident => $said:expr]) => {
        fn name(&$this) -> String {
            $said.to_string()
        }
    };

    (@port_names []) => {};
    (@port_names [[] $($ports:tt)*]) => { $crate::block_items! { @port_names [[self] $($ports)*] } };
    (@port_names [[$this:ident] $({$port:ident [$said:expr]})*]) => {
        fn port_names(&$this) -> ::std::vec::Vec<(&'static str, ::std::string::String)> {
            ::std::vec![$((::std::stringify!($port), $said.to_string())),*]
        }
    };

    (@foreign []) => {};
    (@foreign [=> $module:expr]) => { $crate::block_items! { @foreign [self => $module] } };
    (@foreign [$this:ident => $module:expr]) => {
        fn foreign(&$this) -> ::std::option::Option<$crate::Foreign> {
            ::std::option::Option::Some($module)
        }
    };

    (@bundle $vis:tt $what:literal $name:ident []) => {};
    (@bundle $vis:tt $what:literal $name:ident [= $($bundle:tt)*]) => {};
    (@bundle [$vis:vis] $what:literal $name:ident [
        [$bundle:ident $($this:ident)?] [$({[$([$($said:tt)*])*] $port:ident [$($ty:tt)*] $width:tt})*]
    ]) => {
        $crate::bundle! {
            #[doc = concat!($what, stringify!($name), "`].")]
            $vis struct $bundle<T> { $($(#[$($said)*])* $vis $port: $($ty)*),* }
        }
    };

    (@inputs []) => {
        type In = ();

        fn inputs(&self) {}
    };
    (@inputs [= $bundle:ident [] $widths:tt]) => { $crate::block_items! { @inputs [= $bundle [self] $widths] } };
    (@inputs [= $bundle:ident [$this:ident] [$widths:expr]]) => {
        type In = $bundle;

        fn inputs(&$this) -> $bundle<$crate::Width> {
            $widths
        }
    };
    (@inputs [[$bundle:ident] $ports:tt]) => { $crate::block_items! { @inputs [[$bundle self] $ports] } };
    (@inputs [[$bundle:ident $this:ident] [$({$said:tt $port:ident $ty:tt [$width:expr]})*]]) => {
        type In = $bundle;

        fn inputs(&$this) -> $bundle<$crate::Width> {
            $bundle { $($port: $width),* }
        }
    };

    (@outputs []) => {
        type Out = ();
    };
    (@outputs [= $bundle:ident [] $widths:tt]) => { $crate::block_items! { @outputs [= $bundle [self] $widths] } };
    (@outputs [= $bundle:ident [$this:ident] [$widths:expr]]) => {
        type Out = $bundle;

        fn outputs(&$this) -> Vec<(String, $crate::Width)> {
            $crate::declared("", &$widths)
        }
    };
    (@outputs [[$bundle:ident] $ports:tt]) => { $crate::block_items! { @outputs [[$bundle self] $ports] } };
    (@outputs [[$bundle:ident $this:ident] [$({$said:tt $port:ident $ty:tt [$($width:expr)?]})*]]) => {
        type Out = $bundle;

        fn outputs(&$this) -> Vec<(String, $crate::Width)> {
            let mut widths = Vec::new();
            $($(widths.extend($crate::declared(stringify!($port), &$width));)?)*
            widths
        }
    };

    (@checked [] $($rest:tt)*) => {};
    (@checked $ranges:tt [$vis:vis] $name:ident [$($of:ident: [$($bound:ident)+])*]) => {
        #[allow(dead_code)]
        impl<$($of),*> $name<$($of),*>
        where $($of: $($bound +)+ ::std::fmt::Debug + Clone + Eq + ::std::hash::Hash + 'static),* {
            /// The block, if its parameters are in range.
            ///
            /// # Errors
            ///
            /// The first parameter that is out of range.
            $vis fn checked(self) -> Result<Self, $crate::OutOfRange> {
                $crate::Block::check(&self).map(|()| self)
            }
        }
    };

    (@ranges []) => {};
    (@ranges [[] $($parameters:tt)*]) => { $crate::block_items! { @ranges [[self] $($parameters)*] } };
    (@ranges [[$this:ident] $({[$([$($said:tt)*])*] [$parameter:ident $($field:ident)*] [$range:expr]})*]) => {
        fn check(&$this) -> Result<(), $crate::OutOfRange> {
            $($crate::in_range::<Self, _>(
                &[stringify!($parameter) $(, stringify!($field))*],
                &$this.$parameter $(.$field)*,
                $range,
                &[$($crate::doc_line!($($said)*)),*],
            )?;)*
            Ok(())
        }
    };

    (@about $said:tt [$latency:expr] $source:tt) => { $crate::block_items! { @about $said [self $latency] $source } };
    (@about [$([$($attribute:tt)*])*] [$this:ident $latency:expr] [$source:expr]) => {
        fn about(&$this) -> $crate::ir::About {
            $crate::about::<Self::In, Self::Out>(
                &[$($crate::doc_line!($($attribute)*)),*],
                $latency.to_string(),
                $source.to_string(),
            )
        }
    };
}

/// A block without a `build` gets this one, so that the compiler names the missing method.
#[doc(hidden)]
pub trait AddTheBuildOfThisBlock {
    fn build(&self, _: Module, _: impl Sized) -> NoBuild {
        NoBuild
    }
}

impl<T> AddTheBuildOfThisBlock for T {}

#[doc(hidden)]
#[derive(Debug)]
pub struct NoBuild;

//! The macro `block!`, and the functions that its expansion calls.

use std::collections::BTreeMap;

use crate::bundle::{Bundle, join};
use crate::fields::Fields;
use crate::ir::About;
use crate::limits::MOST_PORTS;
use crate::mistake::Mistake;
use crate::module::Module;
use crate::signal::Signal;
use crate::stream::backwards;
use crate::width::Width;

/// Declares a block: its parameters, its ports with their widths, and its documentation.
///
/// ```
/// use tilewright_hdl::{Module, below, bit, block, def, elaborate, up_to};
///
/// block! {
///     /// Names the next free page.
///     pub struct PageIdGenerator {
///         /// The number of pages.
///         pub pages: u32,
///     }
///     latency = "1 clock from `take` to the next page";
///     source = "VC-1, section 3.3";
///     in PageIdGeneratorIn {
///         /// All pages are free again.
///         restart: bit(),
///         /// The next free page is taken.
///         take: bit(),
///     }
///     out(self) PageIdGeneratorOut {
///         /// The next free page, unless all are taken.
///         page: below(self.pages),
///         /// All pages are taken.
///         exhausted: bit(),
///     }
/// }
///
/// impl PageIdGenerator {
///     fn build(&self, m: Module, i: PageIdGeneratorIn) -> PageIdGeneratorOut {
///         def!(used = m.reg(up_to(self.pages)).reset(0));
///         used.when(i.restart, 0).when(i.take, used + 1);
///         PageIdGeneratorOut { page: used.trunc(below(self.pages)), exhausted: used.eq(self.pages) }
///     }
/// }
///
/// let design = elaborate(&PageIdGenerator { pages: 12 }).unwrap();
/// assert_eq!(design.top().about.summary, "Names the next free page.");
/// assert_eq!(design.top().about.inputs["take"], "The next free page is taken.");
/// ```
///
/// The macro generates the struct with the derives that a [`Block`](crate::Block) needs, a
/// [`bundle!`](crate::bundle!) of the inputs, one of the outputs, and the `impl Block`, which calls `build`. The
/// first paragraph of the struct's documentation heads the Verilog; each port's documentation stands beside the port.
/// Elaboration checks the result of `build` against the widths of the outputs.
///
/// The clauses are optional and come in any sequence. A clause whose expressions use `self` has `(self)` after its
/// first word, because a macro cannot supply that word: `latency(self) = format!("{} clocks", self.clocks());`.
/// Without it, rustc says `expected value, found module self` (E0424).
///
/// A constant latency needs no clause, because it is counted ([`Design::latencies`](crate::Design::latencies)). The
/// clause `ranges` gives the legal values of a parameter, with a reason if it is not obvious: a range,
/// [`powers_of_two`](crate::powers_of_two), [`multiples_of`](crate::multiples_of) or [`any_of`](crate::any_of).
/// Elaboration checks them; the method `checked` checks them earlier:
///
/// ```
/// # use tilewright_hdl::*;
/// block! {
///     /// A screen's picture in pages.
///     pub struct Pages { width: u32, height: u32, pages: u32 }
///     ranges(self) {
///         width: 1..=2048,
///         height: 1..=2048,
///         /// A page has at least one pixel.
///         pages: 2..=self.width * self.height,
///     }
/// }
/// # impl Pages {
/// #     fn build(&self, _: Module, (): ()) {}
/// # }
///
/// let pages = |pages| Pages { width: 4, height: 2, pages }.checked();
/// assert_eq!(pages(8)?.pages, 8);
/// let problem: OutOfRange = pages(9).unwrap_err();
/// assert_eq!(problem.to_string(), "`pages` of `Pages` is 9: it has to be from 2 to 8. A page has at least one pixel.");
/// # Ok::<(), OutOfRange>(())
/// ```
///
/// The forms of a port:
///
/// | written | meaning |
/// |---|---|
/// | `take: bit()` | a signal, or lanes of one: `bits(8).of(row(4))` |
/// | `scan: ScanControl { restart: bit(), enable: bit() }.on(MERGE)` | a record |
/// | `host: pub struct Host { start: bit(), swap: bit() }.on(MERGE)`, `jobs: stream(pub struct Job { page: bits(4) })` | a record declared in place: its fields are written once, each with its own documentation |
/// | `control: Control`, `place: Position::widths(self.columns, self.rows)`, each also with `.on(CLOCK)` | a record declared by [`record!`](crate::record!), which has the widths |
/// | `preset: Position = self.position()` | a record whose widths an expression gives |
/// | `samples: [bits(48); self.units]`, `all: [Control; 4]`, `nearest: [Position = self.position(); 4]`, `jobs: [stream(bits(8)); 3]` | a list, which is a `Vec` |
/// | `jobs: stream(bits(8))`, `jobs: stream(Job { page: bits(4), last: bit() })`, `jobs: stream(Control)`, `jobs: stream(Job = self.job())` | a [`Stream`](crate::Stream) of signals or of records |
/// | `sum: _`, `nearest: Pixel = _`, `all: [Pixel] = _`, `sent: stream(Job = _)`, `all: [stream(_)]` | an output as wide as its driver |
///
/// A block without a `build` does not compile:
///
/// ```compile_fail
/// # use tilewright_hdl::*;
/// block! {
///     /// Does nothing yet.
///     pub struct Nothing;
///     out NothingOut { nothing: bit() }
/// }
/// ```
///
/// Ports that several blocks share are a [`bundle!`](crate::bundle!), declared by its widths:
/// `in(self) = StreamIn { into: stream(bits(self.width)) };`.
///
/// A block of several clocks has them among its parameters. In the module's name, each clock appears by its own name:
///
/// ```
/// # use tilewright_hdl::*;
/// # const HOST: Clock = Clock::new("host", Period::ns(10));
/// # const VIDEO: Clock = Clock::new("video", Period::ns(14));
/// block! {
///     /// Brings a bit from one clock to another.
///     pub struct Across { from: Clock, to: Clock }
///     in(self) AcrossIn { flag: bit().on(self.from) }
///     out AcrossOut { seen: bit() }
/// }
///
/// impl Across {
///     fn build(&self, m: Module, i: AcrossIn) -> AcrossOut {
///         let held = m.on(self.from).pipe("held", i.flag);
///         AcrossOut { seen: m.on(self.to).synchronize("passed", held) }
///     }
/// }
///
/// assert_eq!(elaborate(&Across { from: HOST, to: VIDEO })?.top().name, "across_from_host_to_video");
/// # Ok::<(), Problems>(())
/// ```
///
/// A block may have type parameters with bounds, as in `struct Queue<C: Codes> { .. }`. The clause `name` gives its
/// module a name of its own, as the top of a design wants it. Without the clause, the name is made of the parameters.
///
/// ```
/// # use tilewright_hdl::*;
/// block! {
///     /// Sends bytes over a line.
///     pub struct Uart { pub clocks_per_bit: u32 }
///     name = "uart";
///     out UartOut { tx: bit() }
/// }
/// # impl Uart {
/// #     fn build(&self, _: Module, (): ()) -> UartOut {
/// #         UartOut { tx: lit(1, u32::from(self.clocks_per_bit > 0)) }
/// #     }
/// # }
///
/// assert_eq!(elaborate(&Uart { clocks_per_bit: 868 })?.top().name, "uart");
/// # Ok::<(), Problems>(())
/// ```
#[macro_export]
macro_rules! block {
    ($(#[$($attribute:tt)*])* $vis:vis struct $name:ident; $($clauses:tt)*) => {
        $(#[$($attribute)*])*
        #[derive(Debug, Clone, PartialEq, Eq, Hash)]
        $vis struct $name;

        $crate::block! { @clauses [[$([$($attribute)*])*] [$vis] $name [] [] []] [""] [""] [] [] $($clauses)* }
    };
    ($(#[$($attribute:tt)*])* $vis:vis struct $name:ident $(<$($of:ident: $first:ident $(+ $bound:ident)*),+>)? {
        $($fields:tt)*
    } $($clauses:tt)*) => {
        $(#[$($attribute)*])*
        #[derive(Debug, Clone, PartialEq, Eq, Hash)]
        $vis struct $name $(<$($of: $first $(+ $bound)*),+>)? { $($fields)* }

        $crate::block! {
            @clauses [[$([$($attribute)*])*] [$vis] $name [$($($of: [$first $($bound)*])+)?] [] []] [""] [""] [] [] $($clauses)*
        }
    };

    // The clauses, in sequence: the ranges of parameters, the name, the latency, the source, the inputs and the outputs.
    (@clauses [$attributes:tt $vis:tt $name:ident $of:tt [] $called:tt] $latency:tt $source:tt $in:tt $out:tt ranges $(($this:ident))? {
        $($(#[$($said:tt)*])* $parameter:ident: $range:expr),* $(,)?
    } $($rest:tt)*) => {
        $crate::block! {
            @clauses [$attributes $vis $name $of [[$($this)?] $({[$([$($said)*])*] $parameter [$range]})*] $called]
            $latency $source $in $out $($rest)*
        }
    };
    (@clauses [$attributes:tt $vis:tt $name:ident $of:tt $ranges:tt []] $latency:tt $source:tt $in:tt $out:tt
        name $(($this:ident))? = $said:expr; $($rest:tt)*
    ) => {
        $crate::block! {
            @clauses [$attributes $vis $name $of $ranges [$($this)? => $said]] $latency $source $in $out $($rest)*
        }
    };
    (@clauses $block:tt $latency:tt $source:tt $in:tt $out:tt latency $(($this:ident))? = $said:expr; $($rest:tt)*) => {
        $crate::block! { @clauses $block [$($this)? $said] $source $in $out $($rest)* }
    };
    (@clauses $block:tt $latency:tt $source:tt $in:tt $out:tt source = $said:expr; $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency [$said] $in $out $($rest)* }
    };
    (@clauses $block:tt $latency:tt $source:tt [] $out:tt in $(($this:ident))? $name:ident { $($ports:tt)* } $($rest:tt)*) => {
        $crate::block! { @ports [in $name $($this)?] [] [$($ports)*] $block $latency $source [] $out $($rest)* }
    };
    (@clauses $block:tt $latency:tt $source:tt $in:tt [] out $(($this:ident))? $name:ident { $($ports:tt)* } $($rest:tt)*) => {
        $crate::block! { @ports [out $name $($this)?] [] [$($ports)*] $block $latency $source $in [] $($rest)* }
    };
    (@clauses $block:tt $latency:tt $source:tt [] $out:tt in $(($this:ident))? = $bundle:ident { $($ports:tt)* }; $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source [= $bundle [$($this)?] [$bundle { $($ports)* }]] $out $($rest)* }
    };
    (@clauses $block:tt $latency:tt $source:tt $in:tt [] out $(($this:ident))? = $bundle:ident { $($ports:tt)* }; $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source $in [= $bundle [$($this)?] [$bundle { $($ports)* }]] $($rest)* }
    };

    // The ports of a bundle, in sequence: the documentation, name, type and, if given, width of each.
    (@ports [record $($of:tt)+] [$($done:tt)*] [$field:tt: $($record:ident =)? _ $(, $($more:tt)*)?]) => {
        $crate::wrong_field! { HasWidth $field }
        $crate::block! { @ports [record $($of)+] [$($done)* {[] $field [T] [$crate::bit()]}] [$($($more)*)?] }
    };
    (@ports [record $($of:tt)+] $done:tt [#[$($said:tt)*] $field:tt: $($record:ident =)? _ $($more:tt)*]) => {
        $crate::block! { @ports [record $($of)+] $done [$field: _ $($more)*] }
    };
    (@ports $of:tt [$($done:tt)*] [$(#[$($said:tt)*])* $port:ident: _ $(, $($more:tt)*)?] $($state:tt)*) => {
        $crate::block! { @ports $of [$($done)* {[$([$($said)*])*] $port [T] []}] [$($($more)*)?] $($state)* }
    };
    // A record declared together with its widths becomes a bundle of its own.
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: $vis:vis struct $record:ident {
            $($(#[$($field_said:tt)*])* $field:ident: $width:expr),* $(,)?
        } $(.on($clock:expr))? $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::bundle! {
            $(#[$($said)*])*
            $vis struct $record<T> { $($(#[$($field_said)*])* $vis $field: T),* }
        }
        $crate::block! {
            @ports $of [$($done)* {
                [$([$($said)*])*] $port [$record<T>] [$record { $($field: $width),* } $(.on($clock))?]
            }]
            [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: stream($vis:vis struct $record:ident {
            $($(#[$($field_said:tt)*])* $field:ident: $width:expr),* $(,)?
        }) $(.on($clock:expr))? $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::bundle! {
            $(#[$($said)*])*
            $vis struct $record<T> { $($(#[$($field_said)*])* $vis $field: T),* }
        }
        $crate::block! {
            @stream [$record { $($field: $width),* }] [$($clock)?] [] [$([$($said)*])*] $port
            @ports $of [$($done)*] [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: stream($($payload:tt)*) $(.on($clock:expr))? $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block! {
            @stream [$($payload)*] [$($clock)?] [] [$([$($said)*])*] $port @ports $of [$($done)*] [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: [stream($($payload:tt)*) $(.on($clock:expr))? $(; $count:expr)?] $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block! {
            @stream [$($payload)*] [$($clock)?] [list $($count)?] [$([$($said)*])*] $port
            @ports $of [$($done)*] [$($($more)*)?] $($state)*
        }
    };
    // A list of records whose widths follow from the name, or from the name and parameters.
    (@ports $of:tt $done:tt [
        $(#[$($said:tt)*])* $port:ident: [$record:ident $(::widths($($given:tt)*))? $(.on($clock:expr))?; $count:expr] $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block! {
            @ports $of $done [
                $(#[$($said)*])*
                $port: [$record = $crate::block!(@widths $record $(($($given)*))?) $(.on($clock))?; $count] $(, $($more)*)?
            ]
            $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: $record:ident = _ $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block! { @ports $of [$($done)* {[$([$($said)*])*] $port [$record<T>] []}] [$($($more)*)?] $($state)* }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: $record:ident = $widths:expr $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block! {
            @ports $of [$($done)* {[$([$($said)*])*] $port [$record<T>] [$widths]}] [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: $record:ident { $($fields:tt)* } $(.on($clock:expr))? $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block! {
            @ports $of [$($done)* {[$([$($said)*])*] $port [$record<T>] [$record { $($fields)* } $(.on($clock))?]}]
            [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: [$record:ident = $widths:expr; $count:expr] $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block! {
            @ports $of [$($done)* {[$([$($said)*])*] $port [Vec<$record<T>>] [$crate::list($widths, $count)]}]
            [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: [$record:ident] = _ $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block! { @ports $of [$($done)* {[$([$($said)*])*] $port [Vec<$record<T>>] []}] [$($($more)*)?] $($state)* }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: [$width:expr; $count:expr] $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block! {
            @ports $of [$($done)* {[$([$($said)*])*] $port [Vec<T>] [$crate::list($width, $count)]}]
            [$($($more)*)?] $($state)*
        }
    };
    // A record whose widths follow from its name, or from its name and parameters. rustc reports mistakes at a name
    // that is matched as `tt`, and one that is matched as `ident` is no other width.
    (@ports $of:tt $done:tt [
        $(#[$($said:tt)*])* $port:ident: $record:tt $(::widths($($given:tt)*))? $(.on($clock:expr))? $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block! {
            @name $record $record [$(($($given)*))?] [$(.on($clock))?] [$([$($said)*])*] $port [$($($more)*)?]
            @ports $of $done $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [$(#[$($said:tt)*])* $port:ident: $width:expr $(, $($more:tt)*)?] $($state:tt)*) => {
        $crate::block! { @ports $of [$($done)* {[$([$($said)*])*] $port [T] [$width]}] [$($($more)*)?] $($state)* }
    };
    (@ports [record $($of:tt)+] [$($done:tt)*] []) => { $crate::record! { @declare $($of)+ $($done)* } };
    // A field of `record!` or a port that is written in another way.
    (@ports $of:tt $done:tt [$(#[$($said:tt)*])* pub $port:tt: $($more:tt)*] $($state:tt)*) => {
        $crate::wrong_field! { HasNoPub $port }
        $crate::block! { @ports $of $done [$(#[$($said)*])* $port: $($more)*] $($state)* }
    };
    (@ports $of:tt $done:tt [$(#[$($said:tt)*])* pub ($($scope:tt)*) $($port:tt)*] $($state:tt)*) => {
        $crate::block! { @ports $of $done [$(#[$($said)*])* pub $($port)*] $($state)* }
    };
    (@ports $of:tt $done:tt [#[$($said:tt)*] $($port:tt)+] $($state:tt)*) => {
        $crate::block! { @ports $of $done [$($port)+] $($state)* }
    };
    (@ports $of:tt [$($done:tt)*] [$port:tt $($more:tt)*] $($state:tt)*) => {
        $crate::wrong_field! { IsField $port }
        $crate::block! { @ports $of [$($done)* {[] $port [T] [$crate::bit()]}] [] $($state)* }
    };
    (@ports [in $($of:tt)+] $ports:tt [] $block:tt $latency:tt $source:tt [] $out:tt $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source [[$($of)+] $ports] $out $($rest)* }
    };
    (@ports [out $($of:tt)+] $ports:tt [] $block:tt $latency:tt $source:tt $in:tt [] $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source $in [[$($of)+] $ports] $($rest)* }
    };

    // A stream: its type by that of its payload, and its widths if given.
    (@stream [_] [] $($port:tt)*) => { $crate::block! { @put [T] [] $($port)* } };
    (@stream [$record:ident $(::widths($($given:tt)*))?] $clock:tt $($port:tt)*) => {
        $crate::block! { @stream [$record = $crate::block!(@widths $record $(($($given)*))?)] $clock $($port)* }
    };
    (@stream [$record:ident = _] [] $($port:tt)*) => { $crate::block! { @put [$record<T>] [] $($port)* } };
    (@stream [$record:ident = $widths:expr] [$($clock:expr)?] $($port:tt)*) => {
        $crate::block! { @put [$record<T>] [$crate::stream($widths) $(.on($clock))?] $($port)* }
    };
    (@stream [$record:ident { $($fields:tt)* }] [$($clock:expr)?] $($port:tt)*) => {
        $crate::block! { @put [$record<T>] [$crate::stream($record { $($fields)* }) $(.on($clock))?] $($port)* }
    };
    (@stream [$width:expr] [$($clock:expr)?] $($port:tt)*) => {
        $crate::block! { @put [T] [$crate::stream($width) $(.on($clock))?] $($port)* }
    };
    (@put [$($payload:tt)*] [$($widths:expr)?] [] $said:tt $port:ident @ports $of:tt [$($done:tt)*] $($state:tt)*) => {
        $crate::block! { @ports $of [$($done)* {$said $port [$crate::Stream<$($payload)*, T>] [$($widths)?]}] $($state)* }
    };
    (@put [$($payload:tt)*] [$($widths:expr)?] [list $($count:expr)?] $said:tt $port:ident @ports $of:tt [$($done:tt)*] $($state:tt)*) => {
        $crate::block! {
            @ports $of
            [$($done)* {$said $port [Vec<$crate::Stream<$($payload)*, T>>] [$($crate::list($widths, $count))?]}]
            $($state)*
        }
    };

    (@name $is:ident $record:tt [$($given:tt)?] [$($on:tt)*] $said:tt $port:ident $more:tt @ports $of:tt [$($done:tt)*] $($state:tt)*) => {
        $crate::block! {
            @ports $of [$($done)* {$said $port [$record<T>] [$crate::block!(@widths $record $($given)?) $($on)*]}] $more $($state)*
        }
    };
    (@name $width:tt $same:tt [] [$($on:tt)*] $said:tt $port:ident $more:tt @ports $of:tt [$($done:tt)*] $($state:tt)*) => {
        $crate::block! { @ports $of [$($done)* {$said $port [T] [$width $($on)*]}] $more $($state)* }
    };
    (@widths $record:tt) => {
        <$record as $crate::Record>::widths()
    };
    (@widths $record:tt ($($given:tt)*)) => {
        $record::widths($($given)*)
    };

    // Everything is known.
    (@clauses [[$([$($attribute:tt)*])*] $vis:tt $name:ident [$($of:ident: [$($bound:ident)+])*] $ranges:tt $called:tt]
        $latency:tt [$source:expr] $in:tt $out:tt
    ) => {
        $crate::block! { @bundle $vis "The inputs of [`" $name $in }
        $crate::block! { @bundle $vis "The outputs of [`" $name $out }

        $crate::block! { @checked $ranges $vis $name [$($of: [$($bound)+])*] }

        impl<$($of),*> $crate::Block for $name<$($of),*>
        where $($of: $($bound +)+ ::std::fmt::Debug + Clone + Eq + ::std::hash::Hash + 'static),* {
            $crate::block! { @inputs $in }
            $crate::block! { @outputs $out }
            $crate::block! { @ranges $ranges }
            $crate::block! { @name $called }
            $crate::block! { @about [$([$($attribute)*])*] $latency [$source] }

            fn declared(&self) -> ::std::option::Option<$crate::Loc> {
                ::std::option::Option::Some($crate::Loc::caller())
            }

            fn build(&self, m: $crate::Module, i: Self::In) -> Self::Out {
                // The struct's own `build` takes precedence over those of traits. Without one, this call would
                // recurse; a second trait makes it an error instead.
                use $crate::AddTheBuildOfThisBlock as _;
                Self::build(self, m, i)
            }
        }
    };

    // None of these clauses. What it says is left out, so that nothing follows from it.
    (@clauses $block:tt $latency:tt $source:tt $in:tt $out:tt $clause:tt $($rest:tt)*) => {
        $crate::no_clause! { $clause $clause }
        $crate::block! { @after $block $latency $source $in $out $clause $($rest)* }
    };
    (@after $block:tt $latency:tt $source:tt [] $out:tt input $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source [] $out in $($rest)* }
    };
    (@after $block:tt $latency:tt $source:tt [] $out:tt inputs $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source [] $out in $($rest)* }
    };
    (@after $block:tt $latency:tt $source:tt $in:tt [] output $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source $in [] out $($rest)* }
    };
    (@after $block:tt $latency:tt $source:tt $in:tt [] outputs $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source $in [] out $($rest)* }
    };
    (@after $block:tt $latency:tt $source:tt $in:tt $out:tt $clause:ident $(($($this:tt)*))? $($name:ident)? {
        $($inner:tt)*
    } $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source $in $out $($rest)* }
    };
    (@after $block:tt $latency:tt $source:tt $in:tt $out:tt $clause:ident $(($($this:tt)*))? = $said:expr; $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source $in $out $($rest)* }
    };
    (@after $block:tt $latency:tt $source:tt $in:tt $out:tt $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source $in $out }
    };

    (@name []) => {};
    (@name [=> $said:expr]) => { $crate::block! { @name [self => $said] } };
    (@name [$this:ident => $said:expr]) => {
        fn name(&$this) -> String {
            $said.to_string()
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
    (@inputs [= $bundle:ident [] $widths:tt]) => { $crate::block! { @inputs [= $bundle [self] $widths] } };
    (@inputs [= $bundle:ident [$this:ident] [$widths:expr]]) => {
        type In = $bundle;

        fn inputs(&$this) -> $bundle<$crate::Width> {
            $widths
        }
    };
    (@inputs [[$bundle:ident] $ports:tt]) => { $crate::block! { @inputs [[$bundle self] $ports] } };
    (@inputs [[$bundle:ident $this:ident] [$({$said:tt $port:ident $ty:tt [$width:expr]})*]]) => {
        type In = $bundle;

        fn inputs(&$this) -> $bundle<$crate::Width> {
            $bundle { $($port: $width),* }
        }
    };

    (@outputs []) => {
        type Out = ();
    };
    (@outputs [= $bundle:ident [] $widths:tt]) => { $crate::block! { @outputs [= $bundle [self] $widths] } };
    (@outputs [= $bundle:ident [$this:ident] [$widths:expr]]) => {
        type Out = $bundle;

        fn outputs(&$this) -> Vec<(String, $crate::Width)> {
            $crate::declared("", &$widths)
        }
    };
    (@outputs [[$bundle:ident] $ports:tt]) => { $crate::block! { @outputs [[$bundle self] $ports] } };
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
    (@ranges [[] $($parameters:tt)*]) => { $crate::block! { @ranges [[self] $($parameters)*] } };
    (@ranges [[$this:ident] $({[$([$($said:tt)*])*] $parameter:ident [$range:expr]})*]) => {
        fn check(&$this) -> Result<(), $crate::OutOfRange> {
            $($crate::in_range::<Self, _>(
                stringify!($parameter),
                &$this.$parameter,
                $range,
                &[$($crate::doc_line!($($said)*)),*],
            )?;)*
            Ok(())
        }
    };

    (@about $said:tt [$latency:expr] $source:tt) => { $crate::block! { @about $said [self $latency] $source } };
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

/// The text of a documentation line; of any other attribute, nothing.
#[doc(hidden)]
#[macro_export]
macro_rules! doc_line {
    (doc = $text:expr) => {
        $text
    };
    ($($other:tt)*) => {
        ""
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

/// A list of identical ports.
#[doc(hidden)]
#[track_caller]
pub fn list<W: Clone>(widths: W, count: impl crate::Integer) -> Vec<W> {
    let count = crate::integers::count(count);
    if count > MOST_PORTS {
        let help = "lanes are one port: `bits(8).of(row(lanes))`";
        crate::elaboration::mistake(
            Mistake::TooManyPorts,
            format!("a list of {count} ports, more than {MOST_PORTS}"),
            help,
        );
    }
    vec![widths; count as usize]
}

/// The declared widths of an output, each with its path.
#[doc(hidden)]
pub fn declared(port: &str, widths: &impl Fields<Width>) -> Vec<(String, Width)> {
    // A port may be a raw identifier; the empty name means all ports of a bundle.
    let port = if port.is_empty() { String::new() } else { join("", port) };
    let path = |path: String| if path.is_empty() { port.clone() } else { join(&port, &path) };
    // A leaf that runs backwards, as the `ready` of a stream, is no output.
    let outputs = widths.leaves().into_iter().zip(backwards(widths)).filter(|(_, back)| !back);
    outputs.map(|((inner, width), _)| (path(inner), width)).collect()
}

/// The description in words of a block's declaration.
#[doc(hidden)]
pub fn about<I: Bundle, O: Bundle>(said: &[&str], latency: String, source: String) -> About {
    About { summary: sentence(said), latency, source, inputs: ports::<I>(), outputs: ports::<O>() }
}

/// The documentation of a bundle's ports and of the records in it.
fn ports<B: Bundle>() -> BTreeMap<String, String> {
    let mut ports = BTreeMap::new();
    <B as Fields<Signal>>::documentation("", "", &mut |path, said| {
        if !said.is_empty() {
            ports.insert(path.to_owned(), said.to_owned());
        }
    });
    ports
}

/// The first paragraph of a documentation text, on one line, without its link targets.
#[doc(hidden)]
pub fn sentence(lines: &[&str]) -> String {
    let lines = lines.iter().map(|line| line.trim()).skip_while(|line| line.is_empty());
    let text = lines.take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    let mut plain = String::new();
    let mut rest = text.as_str();
    while let Some((before, link)) = rest.split_once("[`") {
        let Some((name, after)) = link.split_once("`]") else { break };
        plain += &format!("{before}`{name}`");
        rest = after.strip_prefix('(').and_then(|place| Some(place.split_once(')')?.1)).unwrap_or(after);
    }
    plain + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_paragraph_without_its_links() {
        assert_eq!(sentence(&[" Leads the", " scan.", "", " And more."]), "Leads the scan.");
        assert_eq!(sentence(&[" [`A`] and [`b`](super::b), not [c]."]), "`A` and `b`, not [c].");
        assert_eq!(sentence(&[]), "");
    }
}

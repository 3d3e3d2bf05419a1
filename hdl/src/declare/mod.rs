//! The macro `block!`: the sequence of its clauses.

mod documentation;
mod items;
mod ports;
mod widths;

pub use documentation::{about, sentence};
pub use items::{AddTheBuildOfThisBlock, NoBuild};
pub use widths::{declared, list};

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
/// A field of a parameter is `queues.depth: 1..=64`. Elaboration checks them; the method `checked` checks them earlier:
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
/// Ports that several blocks share are a record, `in(self) = LinkIn::widths(self.width);`, or a
/// [`bundle!`](crate::bundle!) with its widths, `in(self) = StreamIn { into: stream(bits(self.width)) };`:
///
/// ```
/// # use tilewright_hdl::*;
/// record! {
///     /// Two numbers.
///     struct Operands(width: u32) { left: bits(width), right: bits(width) }
///
///     /// One number.
///     struct Answer(width: u32) { number: bits(width) }
/// }
///
/// block! {
///     /// The sum of two numbers.
///     struct Sum { width: u32 }
///     in(self) = Operands::widths(self.width);
///     out(self) = Answer::widths(self.width);
/// }
/// # impl Sum {
/// #     fn build(&self, _: Module, i: Operands) -> Answer {
/// #         Answer { number: i.left + i.right }
/// #     }
/// # }
///
/// assert_eq!(Sum { width: 8 }.inputs().right.bits(), 8);
/// ```
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
///
/// The clause `port_names` gives ports the names of a standard, from which a packager of an IP core infers the interface.
/// The name of a stream or a record begins the name of each of its ports. A clock and its reset have names too: `clk`,
/// `rst` and `rst_n`.
///
/// ```
/// # use tilewright_hdl::*;
/// block! {
///     /// Counts the beats of packets.
///     pub struct Beats { lanes: u32 }
///     port_names { clk: "aclk", rst_n: "aresetn", beats: "s_axis_t" }
///     in(self) BeatsIn { beats: stream(struct Beat { data: bits(8 * self.lanes), last: bit() }) }
///     out BeatsOut { count: bits(16) }
/// }
///
/// impl Beats {
///     fn build(&self, m: Module, i: BeatsIn) -> BeatsOut {
///         m.ignore(&i.beats.data);
///         let beat = i.beats.take_when(lit(1, 1));
///         def!(count = m.reg(16).reset(0));
///         count.when(beat.taken, mux(beat.last, 0, count + 1));
///         BeatsOut { count: *count }
///     }
/// }
///
/// let axi = DefaultClock::new(Period::ns(10)).reset(Reset::SynchronousLow);
/// let design = elaborate_at(&Beats { lanes: 4 }, axi)?;
/// let text = &tilewright_gen::verilog(&design)[0].text;
/// for port in ["aclk", "aresetn", "s_axis_tvalid", "s_axis_tready", "s_axis_tdata", "s_axis_tlast"] {
///     assert!(text.contains(&format!(" {port},")), "{text}");
/// }
/// # Ok::<(), Problems>(())
/// ```
///
/// The clause `foreign` says which module of somebody else the block is in Verilog: [`Foreign::module`](crate::Foreign::module).
#[macro_export]
macro_rules! block {
    ($(#[$($attribute:tt)*])* $vis:vis struct $name:ident; $($clauses:tt)*) => {
        $(#[$($attribute)*])*
        #[derive(Debug, Clone, PartialEq, Eq, Hash)]
        $vis struct $name;

        $crate::block! { @clauses [[$([$($attribute)*])*] [$vis] $name [] [] [] [] []] [""] [""] [] [] $($clauses)* }
    };
    ($(#[$($attribute:tt)*])* $vis:vis struct $name:ident $(<$($of:ident: $first:ident $(+ $bound:ident)*),+>)? {
        $($fields:tt)*
    } $($clauses:tt)*) => {
        $(#[$($attribute)*])*
        #[derive(Debug, Clone, PartialEq, Eq, Hash)]
        $vis struct $name $(<$($of: $first $(+ $bound)*),+>)? { $($fields)* }

        $crate::block! {
            @clauses [[$([$($attribute)*])*] [$vis] $name [$($($of: [$first $($bound)*])+)?] [] [] [] []] [""] [""] [] [] $($clauses)*
        }
    };

    // The clauses, in sequence: the ranges of parameters, the name, the foreign module, the names of ports, the latency, the source, the inputs and the outputs.
    (@clauses [$attributes:tt $vis:tt $name:ident $of:tt [] $called:tt $foreign:tt $ports:tt] $latency:tt $source:tt $in:tt $out:tt ranges $(($this:ident))? {
        $($(#[$($said:tt)*])* $parameter:ident $(.$field:ident)*: $range:expr),* $(,)?
    } $($rest:tt)*) => {
        $crate::block! {
            @clauses [$attributes $vis $name $of [[$($this)?] $({[$([$($said)*])*] [$parameter $($field)*] [$range]})*] $called $foreign $ports]
            $latency $source $in $out $($rest)*
        }
    };
    (@clauses [$attributes:tt $vis:tt $name:ident $of:tt $ranges:tt [] $foreign:tt $ports:tt] $latency:tt $source:tt $in:tt $out:tt
        name $(($this:ident))? = $said:expr; $($rest:tt)*
    ) => {
        $crate::block! {
            @clauses [$attributes $vis $name $of $ranges [$($this)? => $said] $foreign $ports] $latency $source $in $out $($rest)*
        }
    };
    (@clauses [$attributes:tt $vis:tt $name:ident $of:tt $ranges:tt $called:tt [] $ports:tt] $latency:tt $source:tt $in:tt $out:tt
        foreign $(($this:ident))? = $module:expr; $($rest:tt)*
    ) => {
        $crate::block! {
            @clauses [$attributes $vis $name $of $ranges $called [$($this)? => $module] $ports]
            $latency $source $in $out $($rest)*
        }
    };
    (@clauses [$attributes:tt $vis:tt $name:ident $of:tt $ranges:tt $called:tt $foreign:tt []] $latency:tt $source:tt $in:tt $out:tt
        port_names $(($this:ident))? { $($port:ident: $said:expr),* $(,)? } $($rest:tt)*
    ) => {
        $crate::block! {
            @clauses [$attributes $vis $name $of $ranges $called $foreign [[$($this)?] $({$port [$said]})*]]
            $latency $source $in $out $($rest)*
        }
    };
    (@clauses $block:tt [""] $source:tt $in:tt $out:tt latency $(($this:ident))? = $said:expr; $($rest:tt)*) => {
        $crate::block! { @clauses $block [$($this)? $said] $source $in $out $($rest)* }
    };
    (@clauses $block:tt $latency:tt [""] $in:tt $out:tt source = $said:expr; $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency [$said] $in $out $($rest)* }
    };
    (@clauses $block:tt $latency:tt $source:tt [] $out:tt in $(($this:ident))? $name:ident { $($ports:tt)* } $($rest:tt)*) => {
        $crate::block_ports! { @ports [in $name $($this)?] [] [$($ports)*] $block $latency $source [] $out $($rest)* }
    };
    (@clauses $block:tt $latency:tt $source:tt $in:tt [] out $(($this:ident))? $name:ident { $($ports:tt)* } $($rest:tt)*) => {
        $crate::block_ports! { @ports [out $name $($this)?] [] [$($ports)*] $block $latency $source $in [] $($rest)* }
    };
    (@clauses $block:tt $latency:tt $source:tt [] $out:tt in $(($this:ident))? = $bundle:ident { $($ports:tt)* }; $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source [= $bundle [$($this)?] [$bundle { $($ports)* }]] $out $($rest)* }
    };
    (@clauses $block:tt $latency:tt $source:tt $in:tt [] out $(($this:ident))? = $bundle:ident { $($ports:tt)* }; $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source $in [= $bundle [$($this)?] [$bundle { $($ports)* }]] $($rest)* }
    };
    (@clauses $block:tt $latency:tt $source:tt [] $out:tt in $(($this:ident))? = $record:ident $(::widths($($given:tt)*))?; $($rest:tt)*) => {
        $crate::block! {
            @clauses $block $latency $source
            [= $record [$($this)?] [$crate::block_ports!(@widths $record $(($($given)*))?)]] $out $($rest)*
        }
    };
    (@clauses $block:tt $latency:tt $source:tt $in:tt [] out $(($this:ident))? = $record:ident $(::widths($($given:tt)*))?; $($rest:tt)*) => {
        $crate::block! {
            @clauses $block $latency $source $in
            [= $record [$($this)?] [$crate::block_ports!(@widths $record $(($($given)*))?)]] $($rest)*
        }
    };

    // Everything is known.
    (@clauses [[$([$($attribute:tt)*])*] $vis:tt $name:ident [$($of:ident: [$($bound:ident)+])*] $ranges:tt $called:tt $foreign:tt $ports:tt]
        $latency:tt [$source:expr] $in:tt $out:tt
    ) => {
        $crate::block_items! { @bundle $vis "The inputs of [`" $name $in }
        $crate::block_items! { @bundle $vis "The outputs of [`" $name $out }

        $crate::block_items! { @checked $ranges $vis $name [$($of: [$($bound)+])*] }

        impl<$($of),*> $crate::Block for $name<$($of),*>
        where $($of: $($bound +)+ ::std::fmt::Debug + Clone + Eq + ::std::hash::Hash + 'static),* {
            $crate::block_items! { @inputs $in }
            $crate::block_items! { @outputs $out }
            $crate::block_items! { @ranges $ranges }
            $crate::block_items! { @name $called }
            $crate::block_items! { @foreign $foreign }
            $crate::block_items! { @port_names $ports }
            $crate::block_items! { @about [$([$($attribute)*])*] $latency [$source] }

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
}

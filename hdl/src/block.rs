//! Blocks: a plain struct of parameters, and a function from an input bundle to an output bundle.

use crate::bundle::Bundle;
use crate::module::Module;
use crate::module_name::module_name;
use crate::ranges::OutOfRange;
use crate::width::Width;
use std::fmt::Debug;
use std::hash::Hash;
use tilewright_circuit::Loc;
use tilewright_circuit::ir::{About, Foreign};

/// A hardware block. The struct holds its parameters; [`build`](Block::build) describes its circuit. Instances of one
/// type with equal parameters share a module. The `Debug` text of the parameters goes into the module's name and into
/// messages.
///
/// [`block!`](crate::block!) generates everything but `build` from one declaration. Without the macro, write
/// `#[derive(Debug, Clone, PartialEq, Eq, Hash)]` before the struct. Floating-point parameters have no `Eq`: use
/// integers instead.
///
/// ```
/// # use tilewright_hdl::*;
/// bundle! {
///     struct GateIn<T> { a: T, b: T }
///     struct GateOut<T> { both: T }
/// }
///
/// #[derive(Debug, Clone, PartialEq, Eq, Hash)]
/// struct Gate { width: u32 }
///
/// impl Block for Gate {
///     type In = GateIn;
///     type Out = GateOut;
///
///     fn inputs(&self) -> GateIn<Width> {
///         GateIn { a: bits(self.width), b: bits(self.width) }
///     }
///
///     fn build(&self, _: Module, i: GateIn) -> GateOut {
///         GateOut { both: i.a & i.b }
///     }
/// }
///
/// assert_eq!(Gate { width: 8 }.name(), "gate_width8");
/// let design = elaborate(&Gate { width: 8 })?;
/// assert_eq!(design.top().node(design.top().outputs[0].node).width, 8);
/// # Ok::<(), Problems>(())
/// ```
pub trait Block: Debug + Clone + Eq + Hash + 'static {
    /// The input bundle.
    type In: Bundle;
    /// The output bundle. Its widths follow from the description and may be stated in [`outputs`](Block::outputs).
    type Out: Bundle;

    /// The widths of the inputs.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     struct Adder { width: u32 }
    ///     in(self) AdderIn { a: bits(self.width), b: bits(self.width) }
    ///     out AdderOut { sum: _ }
    /// }
    /// # impl Adder {
    /// #     fn build(&self, _: Module, i: AdderIn) -> AdderOut {
    /// #         AdderOut { sum: i.a + i.b }
    /// #     }
    /// # }
    ///
    /// assert_eq!(Adder { width: 12 }.inputs().b.bits(), 12);
    /// ```
    fn inputs(&self) -> <Self::In as Bundle>::Of<Width>;

    /// Checks that each parameter is in its range: the `ranges` of [`block!`](crate::block!). A block that fails this
    /// check is not elaborated.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     struct Queue { depth: u32 }
    ///     ranges { depth: 1.. }
    /// }
    /// # impl Queue {
    /// #     fn build(&self, _: Module, (): ()) {}
    /// # }
    ///
    /// assert!(Queue { depth: 1 }.check().is_ok() && Queue { depth: 0 }.check().is_err());
    /// ```
    ///
    /// # Errors
    ///
    /// The first parameter that is out of range.
    fn check(&self) -> Result<(), OutOfRange> {
        Ok(())
    }

    /// Describes the circuit.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     struct Adder { width: u32 }
    /// #     in(self) AdderIn { a: bits(self.width), b: bits(self.width) }
    /// #     out AdderOut { sum: _ }
    /// # }
    /// impl Adder {
    ///     // Plain Rust: this question is answered once, when the circuit is built.
    ///     fn build(&self, m: Module, i: AdderIn) -> AdderOut {
    ///         let sum = i.a + i.b;
    ///         AdderOut { sum: if self.width > 32 { m.pipe("late", sum) } else { sum } }
    ///     }
    /// }
    ///
    /// let registers = |width| Ok::<_, Problems>(elaborate(&Adder { width })?.top().registers.len());
    /// assert_eq!((registers(16)?, registers(64)?), (0, 1));
    /// # Ok::<(), Problems>(())
    /// ```
    fn build(&self, m: Module, i: Self::In) -> Self::Out;

    /// The required widths of the outputs, each with the port's path. Other outputs take the width of what drives
    /// them.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     struct Half;
    ///     in HalfIn { word: bits(8) }
    ///     out HalfOut { half: bits(4), rest: _ }
    /// }
    ///
    /// impl Half {
    ///     fn build(&self, _: Module, i: HalfIn) -> HalfOut {
    ///         HalfOut { half: i.word.part(4, 4), rest: i.word.part(0, 4) }
    ///     }
    /// }
    ///
    /// let outputs: Vec<_> = Half.outputs().into_iter().map(|(path, width)| (path, width.bits())).collect();
    /// assert_eq!(outputs, [("half".to_owned(), 4)]); // the width of `rest` is not stated
    /// ```
    fn outputs(&self) -> Vec<(String, Width)> {
        Vec::new()
    }

    /// The block's description in words: the header of its Verilog and its documentation.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// The sum of two bytes.
    ///     ///
    ///     /// Text after the first paragraph is for readers of the source.
    ///     struct Sum;
    ///     latency = "none";
    ///     in SumIn { a: bits(8), b: bits(8) }
    ///     out SumOut { sum: bits(8) }
    /// }
    /// # impl Sum {
    /// #     fn build(&self, _: Module, i: SumIn) -> SumOut {
    /// #         SumOut { sum: i.a + i.b }
    /// #     }
    /// # }
    ///
    /// assert_eq!((&*Sum.about().summary, &*Sum.about().latency), ("The sum of two bytes.", "none"));
    /// ```
    fn about(&self) -> About {
        About::default()
    }

    /// The module of somebody else that this block is in Verilog: the clause `foreign` of [`block!`](crate::block!).
    /// The block's circuit is a model of it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// A buffer of somebody's chip.
    ///     struct Buffer;
    ///     foreign = Foreign::module("BUF");
    ///     in BufferIn { word: bit() }
    ///     out BufferOut { same: bit() }
    /// }
    /// # impl Buffer {
    /// #     fn build(&self, _: Module, i: BufferIn) -> BufferOut {
    /// #         BufferOut { same: i.word }
    /// #     }
    /// # }
    ///
    /// assert_eq!(Buffer.foreign().unwrap().module, "BUF");
    /// ```
    fn foreign(&self) -> Option<Foreign> {
        None
    }

    /// The names that ports have in place of their own: the clause `port_names` of [`block!`](crate::block!).
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// Doubles numbers.
    ///     struct Doubler;
    ///     port_names { numbers: "s_axis_t", doubled: "m_axis_t" }
    ///     in DoublerIn { numbers: stream(struct Number { data: bits(8) }) }
    ///     out DoublerOut { doubled: stream(Number { data: bits(8) }) }
    /// }
    ///
    /// impl Doubler {
    ///     fn build(&self, _: Module, i: DoublerIn) -> DoublerOut {
    ///         let data = i.numbers.data << 1;
    ///         DoublerOut { doubled: i.numbers.with(Number { data }) }
    ///     }
    /// }
    ///
    /// let design = elaborate(&Doubler)?;
    /// let inputs: Vec<_> = design.top().inputs.iter().map(|input| &*input.name).collect();
    /// assert_eq!(inputs, ["s_axis_tvalid", "s_axis_tdata", "m_axis_tready"]);
    /// # Ok::<(), Problems>(())
    /// ```
    fn port_names(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// Whether it is a [`Pad`](crate::Pad).
    #[doc(hidden)]
    fn is_pad(&self) -> bool {
        false
    }

    /// The place of the block's `block!` declaration, if it has one.
    #[doc(hidden)]
    fn declared(&self) -> Option<Loc> {
        None
    }

    /// The name of its module in Verilog. By default it is the type's name in snake case, followed by its type
    /// arguments and parameters, as in `counter_width8`. Different blocks have different names; a clash of names is a
    /// problem.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     struct Fifo { depth: u32, registered: bool }
    ///     in FifoIn { word: bits(8) }
    ///     out FifoOut { word: bits(8) }
    /// }
    /// # impl Fifo {
    /// #     fn build(&self, _: Module, i: FifoIn) -> FifoOut {
    /// #         FifoOut { word: i.word }
    /// #     }
    /// # }
    ///
    /// assert_eq!(Fifo { depth: 16, registered: true }.name(), "fifo_depth16_registered");
    /// ```
    fn name(&self) -> String {
        module_name(std::any::type_name::<Self>(), &format!("{self:?}"))
    }
}

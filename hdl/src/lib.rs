//! A synchronous hardware language embedded in Rust.
//!
//! A block is a struct of parameters and a function from an input bundle to an output bundle:
//!
//! ```
//! use tilewright_hdl::*;
//!
//! block! {
//!     /// Counts from 0 to `limit - 1` and starts again.
//!     pub struct Counter { pub width: u32, pub limit: u64 }
//!     in CounterIn { enable: bit() }
//!     out(self) CounterOut { count: bits(self.width), wraps: bit() }
//! }
//!
//! impl Counter {
//!     fn build(&self, m: Module, i: CounterIn) -> CounterOut {
//!         def!(count = m.reg(self.width).reset(0));
//!         def!(at_end = count.eq(self.limit - 1));
//!         count.when(i.enable, mux(at_end, 0, count + 1));
//!         CounterOut { count: *count, wraps: at_end & i.enable }
//!     }
//! }
//!
//! let design = elaborate(&Counter { width: 8, limit: 10 })?;
//! assert_eq!(design.top().name, "counter_width8_limit10");
//! # Ok::<(), Problems>(())
//! ```
//!
//! | to describe | write |
//! |---|---|
//! | a block | [`block!`] and its `build` |
//! | the legal range of a parameter | `ranges(self) { depth: 2..=self.words }` in [`block!`]; [`powers_of_two`], [`multiples_of`], [`any_of`] |
//! | a port | its name and width in [`block!`]: [`bit`]`()`, [`bits`]`(n)`, [`below`]`(n)`, [`up_to`]`(n)`, or a record of these |
//! | an expression | `+ - & \| ^ ! << >>` and the methods of [`Signal`]; an integer takes the width of the other operand |
//! | a change of width | [`zext`](Signal::zext) [`sext`](Signal::sext) [`trunc`](Signal::trunc) [`slice`](Signal::slice) [`low`](Signal::low) [`part`](Signal::part) [`bit`](Signal::bit) [`cat!`] [`repeat`](Signal::repeat) |
//! | a choice | [`mux`], [`select`] (the first true condition), [`case`] (by value); between signals, numbers or records |
//! | signed arithmetic | [`Signal::signed`], [`Width::signed`]; either both operands are signed or neither is |
//! | a name, for the variable and its hardware at once | [`def!`]`(count = m.reg(8))`, `def!(at_end = count.eq(9))`; a computed name: `m.reg(&name, 8)`, [`Signal::named`]; a prefix: [`Module::within`] |
//! | a net read before it is driven | [`Module::wire`] |
//! | a register | [`Module::reg`], then [`reset`](Reg::reset), [`enable`](Reg::enable), [`next`](Reg::next) or [`when`](Reg::when); [`Module::pipe`] for a pipeline stage, [`Module::toggle`] for a bit that toggles |
//! | a pipeline | [`Module::stages`] of a record, [`Module::stream_stages`] between streams; [`any_stage`](Signal::any_stage) lets values of different stages meet |
//! | a state machine | [`codes!`], [`Module::fsm`], [`StateReg::next`]; the resulting [`Moves`] report which transition is taken |
//! | a memory | [`Module::memory`], [`Mem::read`], [`Mem::read_async`], [`Mem::write`], [`Mem::in_bounds`] |
//! | a record | [`record!`], with the width of each field, or [`bundle!`], without; a register, wire or memory declared with a record of widths is a record; `.pack()` makes a word of a record, `.unpack(word)` of a record of widths makes a record of a word |
//! | an enum | [`codes!`], [`one_of`], [`Signal::is`], [`choose!`]`(i.operation, Alu { Load => a, Add => b })`, [`Signal::choose`]; a code is a signal, by `Alu::Load.into()` in a record |
//! | lanes | `bits(8).of(row(4))`, [`row`], [`grid`]; elementwise operations are written as for one lane; [`previous`](Signal::previous), [`take`](Signal::take), [`pick`](Signal::pick), [`sum`](Signal::sum), [`rows`](Signal::rows), [`columns`](Signal::columns), [`stack`], [`tree`]; of records by [`Lanes`] |
//! | a stream: a payload with `valid` and `ready` | `stream(Job { .. })` in [`block!`] declares a field of type `Stream<Job<T>, T>`; [`Stream::take_when`], [`Module::offer`]; [`Module::stream_wire`] in a loop of blocks, [`Stream::lanes`] for the streams of an array |
//! | a number in another radix | [`hex`]`(0x3f)`, [`binary`]`(0b101)` |
//! | an instance, an array of instances | [`def!`]`(adder = m.instance(..))`; [`Module::instance`], [`Module::array`] |
//! | a module of somebody else: a PLL, a pin, a memory of the chip | `foreign = `[`Foreign::module`]`("SB_PLL40_CORE")..;` in [`block!`], whose `build` is a model of it, or [`Module::unmodelled`] |
//! | a pin that is driven from both sides | [`Pad`] in the top, with [`Outside`] among the top's inputs |
//! | another clock | [`Module::on`], [`Mem::on`], [`Width::on`]; [`Module::synchronize`], [`Module::synchronize_from`], [`Signal::quasi_static`] to cross |
//! | a property: an assertion, an assumption, a cover | [`Module::assert`], [`Module::assume`], [`Module::cover`], with [`implies`](Signal::implies), [`Module::past`], [`Module::rose`] |
//!
//! Both operands of an operator have equal widths, and results wrap. `==` does not compile; use [`Signal::eq`].
//! Elaboration finds every mistake in a description and reports all of them at once ([`Problems`]), each with the
//! source lines involved. The result of elaboration, a [`Design`], is the circuit that `tilewright-sim` runs and
//! `tilewright-gen` prints.
//!
//! The examples of this documentation are lines of a `build` whose module is `m`. They run as tests: each `m.assert`
//! is checked for 64 clocks, and `example.values("count")` lists the values of `count` just before each of the first
//! edges.

#[doc(inline)]
pub use tilewright_circuit::{
    About, Bits, Clock, DefaultClock, Design, Edge, Foreign, Loc, Mistake, Period, Problem, Problems, Radix,
    ReadUnderWrite, Recording, Reset, Shape, index_width, ir, limbs_for, recording, top_mask,
};

mod along;
mod attribute;
mod block;
mod bracket;
mod bundle;
mod by_power_on;
pub mod catalog;
mod check;
mod choose;
mod chosen;
mod clause;
mod clock;
mod codes;
mod compare;
mod contents;
mod data;
mod declare;
mod def;
mod described;
mod divide;
mod draft;
mod elaborating;
mod elaboration;
mod enabled;
mod fields;
mod finish;
mod foreign;
mod in_bounds;
mod in_place_of;
mod index;
mod instance;
mod integers;
mod lanes;
mod limits;
mod low;
mod machine;
mod memory;
mod module;
mod module_name;
mod moves;
mod names;
mod netlist;
mod operand;
mod pad;
mod parts;
mod past;
mod port_names;
mod property;
mod radix;
mod ranges;
mod record;
mod reduce;
mod register;
pub mod scenario;
mod select;
mod shaping;
mod shift;
mod shorthand;
mod signal;
mod signed;
mod stages;
mod stream;
mod stream_stages;
mod summary;
mod synchronize;
mod transparent;
mod tree;
mod uneven;
mod width;
mod wire;
mod within;

pub use along::Along;
pub use block::Block;
pub use bundle::Bundle;
#[doc(hidden)]
pub use bundle::join;
#[doc(hidden)]
pub use choose::ChosenArm;
#[doc(hidden)]
pub use clause::ClauseOfABlock;
pub use codes::{Codes, one_of};
#[doc(hidden)]
pub use data::Given;
pub use data::{Data, Fits, Layout};
#[doc(hidden)]
pub use declare::{AddTheBuildOfThisBlock, NoBuild, about, declared, list, sentence};
#[doc(hidden)]
pub use def::instance_name;
pub use elaborating::{DEFAULT_PERIOD, Typed, elaborate, elaborate_at, elaborate_typed};
pub use fields::{Fields, Leaf, Visited};
pub use index::Index;
pub use integers::Integer;
pub use lanes::{constants, interleave, stack};
pub use low::Low;
pub use machine::{StateReg, Transition, goto, hold, when};
pub use memory::Mem;
pub use module::Module;
pub use moves::Moves;
#[doc(hidden)]
pub use names::unraw;
#[doc(hidden)]
pub use operand::Value;
pub use operand::{IntoSignal, Operand, ShiftAmount};
pub use pad::{Outside, Pad, PadIn, PadOut};
pub use radix::{Written, binary, hex};
#[doc(hidden)]
pub use ranges::in_range;
pub use ranges::{AnyOf, MultiplesOf, OutOfRange, PowersOfTwo, Values, any_of, multiples_of, powers_of_two};
pub use record::{Lanes, Record, RecordUpdates};
#[doc(hidden)]
pub use record::{Numbers, Zero, named, pack, rules, unpack};
pub use register::{Reg, Updates};
pub use scenario::{Scenario, Script};
pub use select::{case, concat, lit, mux, select};
pub use shaping::{IntoShape, grid, row};
pub use signal::Signal;
pub use stages::Start;
#[doc(hidden)]
pub use stages::{any_stage, cleared};
pub use stream::{Stream, StreamWire, Taken, stream};
pub use tree::tree;
#[doc(hidden)]
pub use uneven::{Uneven, uneven};
pub use width::{IntoWidth, Width, below, bit, bits, up_to};
pub use wire::Wire;

//! Simulates a circuit cycle by cycle: engines, testbenches, waves.
//!
//! ```
//! use tilewright_hdl::{Module, bit, bits, block, def};
//! use tilewright_sim::Simulation;
//!
//! block! {
//!     /// Counts the clocks in which it is enabled.
//!     struct Counter { width: u32 }
//!     in CounterIn { enable: bit() }
//!     out(self) CounterOut { count: bits(self.width) }
//! }
//!
//! impl Counter {
//!     fn build(&self, m: Module, i: CounterIn) -> CounterOut {
//!         def!(count = m.reg(self.width).reset(0));
//!         count.when(i.enable, count + 1);
//!         CounterOut { count: *count }
//!     }
//! }
//!
//! # fn main() -> Result<(), tilewright_sim::Error> {
//! let mut sim = Simulation::of(&Counter { width: 4 })?;
//! let wave = sim.record([sim.i.enable, sim.o.count]);
//! for enable in [0, 1, 1, 0] {
//!     sim.set(sim.i.enable, enable);
//!     sim.step();
//! }
//! assert_eq!(sim.get(sim.o.count), 2);
//! wave.expect(r"
//!     clk    |___/~\_/~\_/~\_/
//!     enable |___/~~~~~~~\____
//!     count  | 0     | 1 | 2 |");
//! # Ok(())
//! # }
//! ```
//!
//! # The meaning of a run
//!
//! Values are two-valued and change only at instants.
//!
//! - **Time.** Every clock is low at time 0. It rises at each multiple of its period, first after one period, and
//!   falls half a period later. An *instant* is a time at which one or more clocks rise; [`Simulation::step`] goes to
//!   the next one.
//! - **An instant.** First, all expressions settle with the present inputs. Then the assertions and assumptions of
//!   the rising clocks are checked, unless the clock's reset is active. If one fails, the instant does not happen, and
//!   the error shows the values before it. Covers whose condition is true are counted ([`Simulation::covered`]).
//!   Next, the registers, memory reads and memory writes of all these clocks sample at once, and then they all
//!   change. So clocks that rise together see each other's previous values.
//! - **Inputs** keep their values until they are set again; at time 0 they are zero. Between two instants, the
//!   sequence of `set` and `get` does not affect the stored values.
//! - **The start** is the moment after a reset. Registers have their initial values, or else their reset values;
//!   memories have their contents. Everything else is zero: registers with neither value, the data of synchronous
//!   reads, and memories of unknown contents. With [`Simulation::seeded`], these values follow instead from the seed
//!   and the object's own hierarchical name. [`Simulation::reset`] keeps every reset active for an edge of each clock.
//! - **Memories.** A read gives the word before the instant. If a port of any clock writes that word at the same
//!   instant and the policy is `ReadUnderWrite::Any`, the read gives the old word inverted. So a circuit that relies
//!   on the result fails its tests. If two ports of one clock write one word, the later port wins; if ports of two
//!   clocks do at one instant, the clock that is later in the top module's list wins. Beyond the depth, reads give
//!   zero and writes have no effect. An asynchronous read follows its address and the memory's words immediately.
//! - **Arrays** mean the same as separate instances, however they are run.
//!
//! # Many runs at once
//!
//! A [`Batch`] runs one design under many stimuli, or from many seeds, at once. Inputs, names and memories take the
//! run as an argument; time is common to all runs. Each run equals a [`Simulation`] of its own, and its waveform is
//! the same byte for byte. A failing assertion names its run and stops all of them.
//!
//! ```
//! # use tilewright_hdl::{Module, bits, block, def};
//! # block! {
//! #     /// Adds up its inputs.
//! #     struct Sum;
//! #     in SumIn { x: bits(8) }
//! #     out SumOut { sum: bits(8) }
//! # }
//! # impl Sum {
//! #     fn build(&self, m: Module, i: SumIn) -> SumOut {
//! #         def!(sum = m.reg(8).reset(0));
//! #         sum.next(sum + i.x);
//! #         SumOut { sum: *sum }
//! #     }
//! # }
//! # fn main() -> Result<(), tilewright_sim::Error> {
//! let mut batch = tilewright_sim::Batch::of(&Sum, 16)?;
//! batch.set_each(batch.i.x, |run| run);
//! batch.run(10);
//! assert_eq!(batch.get(batch.o.sum, 7), 70);
//! # Ok(())
//! # }
//! ```
//!
//! # Going back in time
//!
//! A run follows from its inputs. A simulation that remembers them ([`Simulation::remember`]) goes to any earlier time
//! ([`Simulation::go_to`]), or back to the last time at which a condition was true ([`Simulation::run_until_back`]).
//! Nothing has to be recorded beforehand.
//!
//! ```
//! # use tilewright_sim::{Simulation, for_examples::Counter};
//! let mut sim = Simulation::of(&Counter)?;
//! sim.remember(64 << 20); // bytes
//! sim.set(sim.i.enable, 1);
//! sim.run(150);
//! let time = sim.run_until_back(sim.o.square.is(4))?;
//! assert_eq!((time, sim.get_u64(sim.o.count)), (Some(1_460_000), 146));
//! # Ok::<(), tilewright_sim::Error>(())
//! ```
//!
//! The state at one time is a [`Checkpoint`]. Simulations of the design on all engines read it, and so does a later
//! process, from a file. What it costs to remember is shown here, on two cores of a busy Intel Xeon, with the best of
//! 25 rounds. The last column is the time to go back over two thirds of the run:
//!
//! ```text
//! $ cargo bench -p tilewright-benches --bench past
//!                                                  ns     with    ratio  ms back
//! a processor of RV32I, run(n)                  15.99    16.29    1.018     0.79
//! a processor of RV32I, step                    18.01    18.36    1.020     0.79
//! a processor of RV32I, set, step, get_u64      42.57    54.35    1.277     1.40
//! 64x64 processors of 8 bits, run(n)           279.21   278.12    0.996    90.52
//! a VC-1 of 3 processors, run(n)                80.26    82.14    1.023   133.96
//! ```
//!
//! Each input that a testbench sets takes 12 ns and 24 bytes.
//!
//! # Why a value is what it is
//!
//! [`Simulation::why`] gives the cause of a value: the registers and inputs that decided it, step by step back to where
//! it came from. A choice counts its condition and its chosen side, and an AND that is 0 its zeros. A register counts
//! what was written last, however long ago. Nothing has to be recorded beforehand: the simulation goes back for it.
//!
//! ```
//! # use tilewright_sim::{Simulation, for_examples::Counter};
//! let mut sim = Simulation::of(&Counter)?;
//! sim.remember(64 << 20); // bytes
//! sim.set(sim.i.enable, 1);
//! sim.run(3);
//! sim.set(sim.i.enable, 0);
//! sim.run(1000);
//! let cause = sim.why("count")?; // written last at the end of cycle 2
//! assert_eq!((cause.cycle, cause.causes[1].name.as_str(), cause.causes[1].cycle), (3, "enable", 2));
//! println!("{cause}"); // a line for each cause, with its place in the description
//! # Ok::<(), tilewright_sim::Error>(())
//! ```
//!
//! # Engines
//!
//! [`program::compile`] makes a flat [`program::Program`] of a design, and an engine runs it. The default is
//! [`EngineKind::Tiered`]: an interpreter runs the circuit at once, and machine code takes over in a long run.
//! [`Simulation::on`] selects another. All engines give the same results. [`EngineKind::Reference`] is the simplest
//! one, and defines the correct results. [`EngineKind::Interpreter`] is faster, and [`EngineKind::Compiled`] makes
//! machine code at once. Where no code can be generated, the interpreter replaces it. Then [`Simulation::engine`] says
//! so, and [`Simulation::fallback`] says why. [`EngineKind::Both`] runs machine code beside the reference and ends with
//! [`Error::Differs`] at the first signal that differs. An instance array runs in vector lanes, all instances at once.
//! `sim/docs/engine.md` describes the generated code and how to build for wider vectors. [`Passes`] switches
//! optimisations off, for tests.
//!
//! # The cost of a testbench
//!
//! A run until a condition ([`Simulation::run_until`]) is as fast as one of a known length. A testbench that looks at
//! values in every clock pays for the call of each step and each look. The table is for an RV32I processor and for a
//! block with 32 inputs and 17 outputs. It shows the best of 25 rounds on two cores of an AMD EPYC:
//!
//! ```text
//! $ cargo bench -p tilewright-benches --bench testbench
//! a processor of RV32I                                ns    ratio
//!   run(n), a cycle                                 18.7     1.00
//!   run_until a register is a number                18.9     1.01
//!   run_until a result is a number                  19.0     1.01
//!   step                                            23.4     1.26
//!   step, get of a register                         26.2     1.40
//!   step, get_u64 of a register                     25.5     1.36
//!   step, get of a result                           33.6     1.80
//!   step, get_u64 of a result                       33.0     1.77
//!   step, read_u64 of 7 ports                       50.3     2.69
//!   set, step, get_u64 of a result                  56.8     3.04
//!   run(n) with a waveform of everything           159.1     8.52
//! 16 products and their sum                           ns    ratio
//!   run(n), a cycle                                  3.6     1.00
//!   32 sets                                         74.5    20.95
//!   32 sets, step, get_u64                         115.0    32.36
//!   set_list of 16 inputs, twice                    90.2    25.39
//!   get_list of 16 outputs                          45.0    12.65
//!   drive of 32 inputs                             269.9    75.91
//!   read_u64 of 17 outputs                          59.2    16.65
//! ```
//!
//! # The cost of a waveform
//!
//! A run without a trace pays nothing. With a [`Vcd`] of everything, each step looks only at values that the changed
//! clocks and inputs can affect, and writes only those that changed. A separate thread writes the file. For a small
//! circuit with one clock and no arrays, generated code instead collects all values of many instants, in rows. The
//! figures are for a frame of 640 x 480 pixels on the VC-1 with 16 processing elements (its teapot). They are medians
//! of 3 rounds on two cores of an AMD EPYC:
//!
//! ```text
//! $ cargo bench -p tilewright-machines --bench vcd
//! without a waveform    0.74 s
//! with a waveform       5.69 s, 7.70 times as long
//! the file               791 MB, 46.6 million changes at 6.4 million times
//! in the time added      160 MB/s, 9.4 million changes/s
//! ```

mod engine;
mod testbench;

/// The value of a port, as [`Simulation::get`] returns it.
#[doc(no_inline)]
pub use tilewright_circuit::Bits;
pub use tilewright_hdl::Bundle;

pub use engine::program;
pub use engine::{Difference, EngineKind, Explained, Pass, Passes, Target, Unsupported, explain};
#[doc(hidden)]
pub use engine::{Examined, examined};
pub use testbench::{
    Answer, Batch, Cause, Checkpoint, CheckpointError, Condition, Covered, End, Error, Fst, IntoValue, Limits, Memory,
    Message, Messages, Monitor, Nets, Part, Pauses, Port, Probe, Process, Processes, Recorder, Simulation,
    StateDifference, Testbench, Trace, UnknownName, Unremembered, Unrepeated, Vcd, Violation, Wave, WaveLine,
    WaveLines, WaveRadix, monitor,
};
#[doc(hidden)]
pub use testbench::{Traced, example, for_examples, traced};

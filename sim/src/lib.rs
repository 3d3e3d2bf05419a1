//! Runs a circuit cycle by cycle: engines, testbenches, waves.
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
//! # What a run means
//!
//! Values are two-valued and change at instants only.
//!
//! - **Time.** Every clock is low at time 0, rises at each multiple of its period, the first time after one period, and
//!   falls half a period later. An *instant* is a time at which one or more clocks rise; [`Simulation::step`] goes to
//!   the next one.
//! - **An instant.** All expressions are settled with the inputs of this moment. The assertions and assumptions of the
//!   clocks that rise are checked, unless the clock's reset is high; if one fails, the instant does not happen and the error
//!   shows the values before it. Covers that hold are counted likewise ([`Simulation::covered`]). Then the registers, memory reads and memory writes of all those clocks sample at once, and then
//!   they all change. Clocks that rise together therefore see each other's values from before.
//! - **Inputs** change when they are set and hold until they are set again; at time 0 they are zero. Between two instants
//!   the order of `set` and `get` does not matter to what is stored.
//! - **The start** is the moment after a reset: registers with a reset value hold it, those with an initial value hold that instead, and memories
//!   hold their contents. Everything else (registers with neither, the data of synchronous reads, memories of unknown contents) is
//!   zero, or follows from the seed given to [`Simulation::seeded`] and the object's own hierarchical name.
//!   [`Simulation::reset`] holds every reset high for an edge of each clock.
//! - **Memories.** A read gives the word from before the instant. If that word is written at the same instant, by a port
//!   on whichever clock, and the policy is `ReadUnderWrite::Any`, the read gives the old word with every bit inverted,
//!   so that a circuit that relies on it fails its tests. Of two writes to one word the later port of a clock wins;
//!   of two clocks at one instant, the later in the top module's list. Beyond the depth, reads give zero and writes do
//!   nothing. An asynchronous read follows its address and the memory's words at once.
//! - **Arrays** of instances mean as many instances, however they are run.
//!
//! # Many runs at once
//!
//! A [`Batch`] runs one design under many stimuli, or from many seeds, at a time: inputs, names and memories have a run
//! beside their name, time is the same for all. Each run is what a [`Simulation`] of it alone is, its waveform byte for
//! byte; an assertion that fails says in which run, and stops all.
//!
//! ```
//! # use tilewright_hdl::{Module, bits, block, def};
//! # block! {
//! #     /// Adds up what it is given.
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
//! # How it runs
//!
//! [`program::compile`] makes a flat [`program::Program`] of a design, and an engine runs it: [`EngineKind::Compiled`],
//! machine code made for the circuit, unless [`Simulation::on`] takes another one. All give the same results.
//! [`EngineKind::Reference`] is the plainest one, to which the others are held; [`EngineKind::Interpreter`] is faster, and
//! takes over by itself on a machine that no code can be generated for: [`Simulation::engine`] tells which one runs,
//! [`Simulation::fallback`] why. [`EngineKind::Both`] runs machine code beside the reference and ends with
//! [`Error::Differs`] at the first signal in which they are not alike. An instance array runs in lanes, all instances at a
//! time. How the code is made, and what one with wider vectors needs, is in `sim/docs/engine.md`.
//! [`Passes`] switches what makes it fast, for tests.
//!
//! # What a testbench costs
//!
//! A run until a condition ([`Simulation::run_until`]) is as fast as one of a known length; a testbench that looks every
//! clock pays for the call of each step and each look. Of a processor of RV32I, and a block with 32 inputs and 17 outputs,
//! the least of 25 rounds on two cores of an AMD EPYC:
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
//! # What a waveform costs
//!
//! A run without a trace pays nothing. With a [`Vcd`] of everything, only the values are looked at that the clocks and
//! inputs that changed can have changed, and only those that did are written, by a thread of its own. Of a small circuit
//! with one clock and no arrays, all values come in rows instead, many instants in one call of its code. On two cores of an
//! AMD EPYC, for a frame of 640 x 480 pixels on the VC-1 with 16 processing elements (its teapot), medians of 3 rounds:
//!
//! ```text
//! $ cargo bench -p tilewright-machines --bench vcd
//! without a waveform    0.74 s
//! with a waveform       5.69 s, 7.70 times as long
//! the file               791 MB, 46.6 million changes at 6.4 million times
//! in the time added      160 MB/s, 9.4 million changes/s
//! ```

mod engine;
mod limbs;
mod testbench;

/// The value of a port, as [`Simulation::get`] gives it.
#[doc(no_inline)]
pub use tilewright_hdl::{Bits, Bundle};

pub use engine::program;
pub use engine::{Difference, EngineKind, Explained, Pass, Passes, Unsupported, explain};
pub use testbench::{
    Batch, Condition, Covered, Error, IntoValue, Monitor, Pauses, Port, Probe, Process, Processes, Recorder,
    Simulation, Testbench, UnknownName, Vcd, Violation, Wave, WaveRadix, monitor,
};
#[doc(hidden)]
pub use testbench::{Traced, example, for_examples, traced};

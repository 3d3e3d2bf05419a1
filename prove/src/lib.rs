//! Proves what a circuit states: that its assertions hold at every edge, for every input that its assumptions allow.
//!
//! Yosys makes formulas of the printed Verilog, and the solver Z3 decides them. The *base case* searches the first
//! clocks, one after another. *Induction* shows that an assertion that held for `k` clocks holds in the next one.
//! Together they cover all time. Where induction does
//! not suffice, ABC searches an invariant that implies all assertions. A counterexample is a [`Recording`](tilewright_hdl::Recording): the simulator has
//! replayed it, and its assertion failed at the same edge.
//!
//! # The meaning of a proof
//!
//! A run begins as in the [simulator](tilewright_sim#the-meaning-of-a-run): registers have their initial or reset
//! values, and memories their contents. Everything else has any value: registers without either, the data of
//! synchronous reads, and memories of unknown contents. Inputs and resets have any value in each clock, and nothing is
//! checked while the reset is active. An assertion fails where no other one has failed before.
//!
//! Where a design has several clocks, a "clock" of a proof is an instant at which one or more of them have an edge. What
//! can be proved for edges in any sequence holds for all periods. The rest is proved, or searched, with the edges at the
//! exact times of the periods. All resets come together, and last until each clock has had an edge.
//!
//! ```
//! use tilewright_hdl::*;
//! use tilewright_prove::{Error, Outcome, Prover};
//!
//! block! {
//!     /// Counts the pages in use. It forgets to check that there is one to return.
//!     struct Pages;
//!     in PagesIn { take: bit(), give: bit() }
//!     out PagesOut { used: up_to(5) }
//! }
//!
//! impl Pages {
//!     fn build(&self, m: Module, i: PagesIn) -> PagesOut {
//!         def!(used = m.reg(up_to(5)).reset(0));
//!         used.when(i.take & !i.give & used.ne(5), used + 1).when(i.give & !i.take, used - 1);
//!         m.assert(used.le(5), "no more pages are used than exist");
//!         PagesOut { used: *used }
//!     }
//! }
//!
//! let design = elaborate(&Pages).unwrap();
//! match Prover::new().prove(&design) {
//!     Ok(proof) => {
//!         let Outcome::Fails(run) = &proof.statements[0].outcome else { panic!("it fails") };
//!         assert_eq!(run.clock, 1); // a page is returned in clock 0, where none is used
//!         let again = tilewright_sim::Simulation::from_design(&design).unwrap().starting_as(&run.recording);
//!         assert!(again.unwrap().replay(&run.recording).is_err()); // the simulator shows it
//!     }
//!     Err(Error::Missing(_)) => {} // Yosys or Z3 is not installed
//!     Err(error) => panic!("{error}"),
//! }
//! ```

mod answer;
mod edges;
mod equal;
mod error;
mod formulas;
mod induction;
mod invariant;
mod known;
mod model;
mod outcome;
mod pass;
mod places;
mod prepare;
mod process;
mod prover;
mod replay;
mod search;
mod solver;
mod start;

pub use equal::{Difference, Equivalence, Value, Verdict};
pub use error::Error;
pub use outcome::{Outcome, Proof, Run, Stage, Statement};
pub use prover::Prover;

//! The types of a catalogue of blocks: each entry has a name, parameters and a scenario. Libraries provide
//! catalogues; the command line lists, prints and shows their entries.
//!
//! ```
//! use tilewright_hdl::catalog::{CatalogError, Entry, Parameter, Values};
//! use tilewright_hdl::{DEFAULT_PERIOD, Module, Script, below, bit, block, def, elaborate};
//!
//! block! {
//!     /// Counts.
//!     struct Counter { limit: u64 }
//!     in CounterIn { enable: bit() }
//!     out(self) CounterOut { count: below(self.limit) }
//! }
//!
//! impl Counter {
//!     fn build(&self, m: Module, i: CounterIn) -> CounterOut {
//!         def!(count = m.reg(below(self.limit)).reset(0));
//!         count.when(i.enable, count + 1);
//!         CounterOut { count: *count }
//!     }
//! }
//!
//! const COUNTER: Entry = Entry {
//!     name: "counter",
//!     summary: "counts",
//!     parameters: &[Parameter { name: "limit", default: 4, min: 2, max: 1 << 20, meaning: "how many numbers there are" }],
//!     design: |values| Ok(elaborate(&Counter { limit: values.get("limit") })?),
//!     scenario: |values| {
//!         let mut script = Script::new(&Counter { limit: values.get("limit") }, DEFAULT_PERIOD);
//!         script.hold(&CounterIn { enable: 1 }, values.get("limit") + 1);
//!         Ok(script.finish("it counts until it starts again"))
//!     },
//! };
//!
//! assert_eq!(COUNTER.design(&COUNTER.values([("limit", 10)])?)?.top().name, "counter_limit10");
//! let error = COUNTER.values([("limit", 1)]).unwrap_err().to_string();
//! assert_eq!(error, "limit = 1 is out of range: it is from 2 to 1048576");
//! # Ok::<(), CatalogError>(())
//! ```

mod entry;
mod error;

pub use entry::{Entry, Parameter, Values};
pub use error::CatalogError;

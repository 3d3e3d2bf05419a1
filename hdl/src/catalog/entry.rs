//! An entry of the catalogue: a block, its parameters and its scenario.

use std::collections::BTreeMap;
use tilewright_circuit::Reset;

use super::CatalogError;
use crate::elaboration;
use crate::scenario::Scenario;
use tilewright_circuit::ir::Design;

/// A block of the catalogue.
///
/// ```
/// # use tilewright_hdl::catalog::*;
/// # use tilewright_hdl::{DEFAULT_PERIOD, Script, elaborate};
/// # use tilewright_sim::for_examples::{Counter, CounterIn};
/// const COUNTER: Entry = Entry {
///     name: "counter",
///     summary: "counts",
///     parameters: &[],
///     design: |_| Ok(elaborate(&Counter)?),
///     scenario: |_| {
///         let mut script = Script::new(&Counter, DEFAULT_PERIOD);
///         script.hold(&CounterIn { enable: 1 }, 10);
///         Ok(script.finish("it counts to 10"))
///     },
/// };
/// assert_eq!(COUNTER.scenario(&COUNTER.values([])?)?.about, "it counts to 10");
/// # Ok::<(), CatalogError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Its name on the command line, such as `merging-unit`.
    pub name: &'static str,
    /// A short description.
    pub summary: &'static str,
    /// The parameters that can be set.
    pub parameters: &'static [Parameter],
    /// Makes the circuit; called by [`Entry::design`].
    pub design: fn(&Values) -> Result<Design, CatalogError>,
    /// Writes the scenario; called by [`Entry::scenario`].
    pub scenario: fn(&Values) -> Result<Scenario, CatalogError>,
}

/// A parameter: a number that can be set.
///
/// ```
/// # use tilewright_hdl::catalog::*;
/// let units = Parameter { name: "units", default: 4, min: 1, max: 256, meaning: "merging units, one after another" };
/// assert!((units.min..=units.max).contains(&units.default));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its default value.
    pub default: u64,
    /// The least value.
    pub min: u64,
    /// The greatest value.
    pub max: u64,
    /// What it means.
    pub meaning: &'static str,
}

/// The values of an entry's parameters.
///
/// ```
/// # use tilewright_hdl::catalog::*;
/// # use tilewright_sim::for_examples::COUNTER;
/// let values: Values = COUNTER.values([])?;
/// assert_eq!(values, COUNTER.values([("clocks", 4)])?); // the default
/// # Ok::<(), CatalogError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Values(BTreeMap<&'static str, u64>);

impl Entry {
    /// The default values, overridden by `set`.
    ///
    /// ```
    /// # use tilewright_hdl::catalog::*;
    /// # use tilewright_sim::for_examples::COUNTER;
    /// assert_eq!(COUNTER.values([("clocks", 7)])?.get("clocks"), 7);
    /// assert_eq!(COUNTER.values([("clock", 7)]).unwrap_err().to_string(), "counter has no parameter `clock`; it has clocks");
    /// # Ok::<(), CatalogError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// An unknown parameter name, or a value out of range.
    pub fn values<'a>(&self, set: impl IntoIterator<Item = (&'a str, u64)>) -> Result<Values, CatalogError> {
        let mut values: BTreeMap<_, _> = self.parameters.iter().map(|p| (p.name, p.default)).collect();
        for (name, value) in set {
            let Some(parameter) = self.parameters.iter().find(|parameter| parameter.name == name) else {
                let known = self.parameters.iter().map(|parameter| parameter.name).collect();
                return Err(CatalogError::UnknownParameter { block: self.name, name: name.to_owned(), known });
            };
            if !(parameter.min..=parameter.max).contains(&value) {
                let range = [parameter.min, parameter.max];
                return Err(CatalogError::OutOfRange { name: parameter.name, value, range });
            }
            values.insert(parameter.name, value);
        }
        Ok(Values(values))
    }

    /// The circuit.
    ///
    /// ```
    /// # use tilewright_hdl::catalog::*;
    /// # use tilewright_sim::for_examples::COUNTER;
    /// assert_eq!(COUNTER.design(&COUNTER.values([])?)?.top().name, "counter");
    /// # Ok::<(), CatalogError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The combination of values is not possible.
    pub fn design(&self, values: &Values) -> Result<Design, CatalogError> {
        (self.design)(values)
    }

    /// The circuit with this reset of its own clock. The names of modules that depend on it tell a reset that is not the
    /// usual one, so circuits of several kinds go into one folder.
    ///
    /// ```
    /// # use tilewright_hdl::{Reset, catalog::*};
    /// # use tilewright_sim::for_examples::COUNTER;
    /// let top = |reset| Ok::<_, CatalogError>(COUNTER.design_with(&COUNTER.values([])?, reset)?.top().clone());
    /// let low = top(Reset::AsynchronousLow)?;
    /// assert_eq!((&*low.name, low.clocks[0].reset.as_deref()), ("counter_asynchronous_low", Some("rst_n")));
    /// assert_eq!(top(Reset::Synchronous)?.name, "counter");
    /// # Ok::<(), CatalogError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Entry::design`].
    pub fn design_with(&self, values: &Values, reset: Reset) -> Result<Design, CatalogError> {
        elaboration::with_reset(reset, || self.design(values))
    }

    /// A scenario that shows what the block does.
    ///
    /// ```
    /// # use tilewright_hdl::catalog::*;
    /// # use tilewright_sim::for_examples::COUNTER;
    /// let [short, long] = [3, 30].map(|clocks| COUNTER.scenario(&COUNTER.values([("clocks", clocks)]).unwrap()).unwrap());
    /// assert_eq!(long.end_ps - short.end_ps, 270_000); // in clocks of 10 ns
    /// ```
    ///
    /// # Errors
    ///
    /// The combination of values is not possible.
    pub fn scenario(&self, values: &Values) -> Result<Scenario, CatalogError> {
        (self.scenario)(values)
    }
}

impl Values {
    /// The value of one of the entry's parameters.
    ///
    /// ```
    /// # use tilewright_hdl::catalog::*;
    /// # use tilewright_sim::for_examples::COUNTER;
    /// assert_eq!(COUNTER.values([])?.get("clocks"), 4);
    /// # Ok::<(), CatalogError>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The entry has no parameter of this name.
    pub fn get(&self, name: &str) -> u64 {
        self.0[name]
    }

    /// Each parameter with its value, by name.
    ///
    /// ```
    /// # use tilewright_hdl::catalog::*;
    /// # use tilewright_sim::for_examples::COUNTER;
    /// assert_eq!(COUNTER.values([])?.iter().collect::<Vec<_>>(), [("clocks", 4)]);
    /// # Ok::<(), CatalogError>(())
    /// ```
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, u64)> + '_ {
        self.0.iter().map(|(name, value)| (*name, *value))
    }

    /// Like [`Values::get`], for a parameter whose range fits in 32 bits.
    ///
    /// ```
    /// # use tilewright_hdl::catalog::*;
    /// # use tilewright_sim::for_examples::COUNTER;
    /// let clocks: u32 = COUNTER.values([])?.get_u32("clocks");
    /// assert_eq!(clocks, 4);
    /// # Ok::<(), CatalogError>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The value needs more than 32 bits.
    pub fn get_u32(&self, name: &str) -> u32 {
        u32::try_from(self.get(name)).expect("every range is within 32 bits")
    }
}

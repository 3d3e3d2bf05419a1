//! Where a number comes from.

use serde::Serialize;

/// Where numbers come from. A page shows the origin beside each number. It also decides the column of a CSV file and the point of a chart.
/// So no value of a formula can pass for a measurement. Measurements name their seeds.
///
/// ```
/// use tilewright_report::Origin;
///
/// let origin = Origin::rtl([1, 2]);
/// assert_eq!((origin.name(), origin.seeds(), origin.is_measured()), ("RTL", &[1, 2][..], true));
/// assert!(!Origin::Formula.is_measured());
/// ```
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Origin {
    /// The paper's formula, evaluated here.
    Formula,
    /// Counted by a plain model, which knows what there is to do and no time.
    Count {
        /// Seeds of the random inputs; none where nothing is random.
        seeds: Vec<u64>,
    },
    /// Measured on a transaction-level model.
    Model {
        /// Seeds of the random inputs; none where nothing is random.
        seeds: Vec<u64>,
    },
    /// Measured on the hardware, clock by clock.
    Rtl {
        /// Seeds of the random inputs; none where nothing is random.
        seeds: Vec<u64>,
    },
    /// Read in the paper.
    Paper,
}

impl Origin {
    /// The origins' names, in the sequence of a CSV file's columns.
    pub(crate) const NAMES: [&str; 5] = ["formula", "plain count", "transaction model", "RTL", "paper"];

    /// The columns of measurements.
    pub(crate) const MEASURED: std::ops::Range<usize> = 1..4;

    /// Counted by a plain model, which knows what there is to do and no time.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Origin::count([7]).name(), "plain count");
    /// ```
    pub fn count(seeds: impl Into<Vec<u64>>) -> Origin {
        Origin::Count { seeds: seeds.into() }
    }

    /// A measurement on a transaction-level model.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Origin::model([7]).name(), "transaction model");
    /// ```
    pub fn model(seeds: impl Into<Vec<u64>>) -> Origin {
        Origin::Model { seeds: seeds.into() }
    }

    /// A measurement on the hardware.
    ///
    /// ```
    /// assert!(tilewright_report::Origin::rtl([]).is_measured()); // of something that has no seed
    /// ```
    pub fn rtl(seeds: impl Into<Vec<u64>>) -> Origin {
        Origin::Rtl { seeds: seeds.into() }
    }

    /// Its name on the page.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Origin::Formula.name(), "formula");
    /// ```
    pub fn name(&self) -> &'static str {
        Origin::NAMES[self.column()]
    }

    /// The index of its column.
    pub(crate) fn column(&self) -> usize {
        match self {
            Origin::Formula => 0,
            Origin::Count { .. } => 1,
            Origin::Model { .. } => 2,
            Origin::Rtl { .. } => 3,
            Origin::Paper => 4,
        }
    }

    /// The seeds of a measurement.
    ///
    /// ```
    /// assert!(tilewright_report::Origin::Paper.seeds().is_empty());
    /// ```
    pub fn seeds(&self) -> &[u64] {
        match self {
            Origin::Paper | Origin::Formula => &[],
            Origin::Count { seeds } | Origin::Model { seeds } | Origin::Rtl { seeds } => seeds,
        }
    }

    /// The seeds as a CSV cell.
    pub(crate) fn seeds_in_words(&self) -> String {
        self.seeds().iter().map(u64::to_string).collect::<Vec<_>>().join(" ")
    }

    /// Whether a machine or a model of it gave the numbers.
    ///
    /// ```
    /// assert!(tilewright_report::Origin::model([7]).is_measured());
    /// ```
    pub fn is_measured(&self) -> bool {
        Origin::MEASURED.contains(&self.column())
    }
}

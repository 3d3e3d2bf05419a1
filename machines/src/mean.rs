//! Means over random polygons, from sums in integers.

use serde::Serialize;

/// A mean over random polygons, and its error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mean {
    /// The mean.
    pub mean: f64,
    /// Its standard error; 0 for a single polygon.
    pub error: f64,
}

/// The sum of a number over polygons.
#[derive(Clone, Copy, Default)]
pub(crate) struct Sum {
    of_values: u128,
    of_squares: u128,
}

impl Sum {
    pub(crate) fn add(&mut self, other: Sum) {
        self.of_values += other.of_values;
        self.of_squares += other.of_squares;
    }

    /// The mean over `count` polygons, divided by `unit`.
    pub(crate) fn mean(self, count: u64, unit: f64) -> Mean {
        let (values, squares, count) = (self.of_values as f64, self.of_squares as f64, count as f64);
        let mean = values / count;
        let variance = (squares / count - mean * mean).max(0.0);
        Mean { mean: mean / unit, error: (variance / (count - 1.0).max(1.0)).sqrt() / unit }
    }
}

impl From<u64> for Sum {
    fn from(value: u64) -> Sum {
        let value = u128::from(value);
        Sum { of_values: value, of_squares: value * value }
    }
}

//! The scale of an axis, linear or logarithmic, with readable ticks.
//!
//! `plotters` has a type for each kind of scale. This is one type for both. Its ticks are counted, not summed, so that their number is
//! small for all values.

use super::svg::TENTHS;
use crate::number::{raised, shown};
use plotters::coord::ranged1d::{BoldPoints, KeyPointHint, KeyPointWeight, NoDefaultFormatting, ValueFormatter};
use plotters::prelude::*;
use std::ops::Range;

/// A scale from one number to another; for a logarithmic scale these are exponents of ten.
pub struct Scale {
    low: f64,
    high: f64,
    logarithmic: bool,
}

impl Scale {
    /// A scale that contains these values: linear with a margin, or logarithmic from one power of ten to another.
    pub fn around(values: impl Iterator<Item = f64>, logarithmic: bool) -> Scale {
        let place = |value: f64| if logarithmic { value.log10() } else { value };
        let ends =
            values.map(place).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| (low.min(it), high.max(it)));
        // Without values there is no scale.
        let (low, high) = if ends.0 <= ends.1 { ends } else { (0.0, 1.0) };
        if logarithmic {
            let low = low.floor();
            return Scale { low, high: high.ceil().max(low + 1.0), logarithmic };
        }
        // Equal values are in the middle.
        let margin = if low == high { low.abs().max(1e-9) / 2.0 } else { high / 20.0 - low / 20.0 };
        // A scale that begins near zero begins at zero.
        let start = if (0.0..=high / 3.0).contains(&low) { 0.0 } else { (low - margin).max(f64::MIN) };
        Scale { low: start, high: (high + margin).min(f64::MAX), logarithmic }
    }

    /// The width of a vertical axis's labels, in tenths.
    pub fn label_width(&self, labels: usize) -> i32 {
        let ticks = self.key_points(BoldPoints(labels));
        let longest = ticks.iter().map(|tick| self.format_ext(tick).chars().count()).max().unwrap_or(0);
        (longest as i32 * 7 + 14).max(30) * TENTHS
    }

    /// The multiples of a step on the scale, at most `count`. The step is 1, 2 or 5 times a power of ten.
    fn multiples(&self, count: usize) -> Vec<f64> {
        // Both ends can be the greatest possible numbers.
        let least = (self.high / 4.0 - self.low / 4.0) / count.max(1) as f64 * 4.0;
        let power = 10f64.powf(least.log10().floor());
        let step =
            [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power).into_iter().find(|step| *step >= least).unwrap_or(least);
        let (first, last) = ((self.low / step).ceil(), (self.high / step).floor());
        let all = (0..=count).map(|index| first + index as f64).take_while(|index| *index <= last);
        // Divide if the step is below one: 3 / 10 is exactly the number written 0.3.
        all.map(|index| if power < 1.0 { index * (step / power).round() / (1.0 / power).round() } else { index * step })
            .collect()
    }

    /// Powers of ten, at most `count`.
    fn powers(&self, count: usize) -> Vec<f64> {
        let every = ((self.high - self.low) as usize / count.max(1) + 1) as f64;
        let first = (self.low / every).ceil();
        let all = (0..=count).map(|index| (first + index as f64) * every).take_while(|exponent| *exponent <= self.high);
        all.map(|exponent| 10f64.powf(exponent)).collect()
    }
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let place = if self.logarithmic { value.log10() } else { *value };
        let share = (place / 4.0 - self.low / 4.0) / (self.high / 4.0 - self.low / 4.0);
        limit.0 + (share.clamp(0.0, 1.0) * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let (is_bold, count) = (matches!(hint.weight(), KeyPointWeight::Bold), hint.max_num_points());
        match (self.logarithmic, is_bold) {
            (false, _) => self.multiples(count),
            (true, true) => self.powers(count),
            // The numbers between powers, unless there are too many powers.
            (true, false) => {
                let powers = self.powers(count);
                let is_fine = (self.high - self.low) * 9.0 <= count as f64;
                let parts: &[f64] = if is_fine { &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0] } else { &[1.0] };
                let all = powers.iter().flat_map(|power| parts.iter().map(move |part| power * part));
                all.filter(|value| value.log10() <= self.high).collect()
            }
        }
    }

    fn range(&self) -> Range<f64> {
        if self.logarithmic { 10f64.powf(self.low)..10f64.powf(self.high) } else { self.low..self.high }
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, value: &f64) -> String {
        let exponent = value.log10().round();
        match self.logarithmic && !(-2.0..=3.0).contains(&exponent) {
            true => format!("10{}", raised(&exponent.to_string())),
            false => shown(*value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ticks(values: &[f64], logarithmic: bool, count: usize) -> Vec<String> {
        let scale = Scale::around(values.iter().copied(), logarithmic);
        scale.key_points(BoldPoints(count)).iter().map(|tick| scale.format_ext(tick)).collect()
    }

    #[test]
    fn linear_ticks_are_round_numbers() {
        assert_eq!(ticks(&[0.0, 0.97], false, 6), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!(ticks(&[0.4, 0.95], false, 8), ["0.4", "0.5", "0.6", "0.7", "0.8", "0.9"]);
        assert_eq!(ticks(&[100.0, 1900.0], false, 5), ["0", "500", "1000", "1500"]);
        assert_eq!(ticks(&[-7.0, 7.0], false, 4), ["−5", "0", "5"]);
        assert_eq!(ticks(&[4.0], false, 4), ["2", "3", "4", "5", "6"], "one value");
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten() {
        assert_eq!(ticks(&[0.05, 20.0], true, 8), ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(ticks(&[1.0, 99_999.0], true, 4), ["1", "100", "10⁴"]);
        assert_eq!(ticks(&[1e-5, 1e-4], true, 4), ["10⁻⁵", "10⁻⁴"]);
        assert_eq!(ticks(&[10.0], true, 4), ["10", "100"], "one value");
    }

    #[test]
    fn ticks_of_any_numbers_are_few() {
        for values in [
            [f64::MIN, f64::MAX],
            [5e-324, f64::MAX],
            [f64::MAX, f64::MAX],
            [1.0, 1.0 + f64::EPSILON],
            [5e-324, 1e-323],
        ] {
            for logarithmic in [false, true] {
                assert!(ticks(&values, logarithmic, 8).len() <= 9, "{values:?}");
            }
        }
    }
}

//! Constants of an array's lanes that follow a rule: a formula of the lane's number is clearer than a table.

use tilewright_circuit::Bits;

/// `first + step * ((lane / run) % period)`, which covers lane numbers, rows and columns of a grid, and multiples.
#[derive(Debug, PartialEq, Eq)]
pub struct Pattern {
    first: i64,
    step: i64,
    run: usize,
    period: Option<usize>,
}

impl Pattern {
    /// The rule of the values, if they follow one and fit in the 32 bits of a formula.
    pub fn of(values: &[Bits]) -> Option<Pattern> {
        let small = |value: &Bits| value.to_u64().filter(|&value| value < 1 << 31).map(|value| value as i64);
        let values: Vec<i64> = values.iter().map(small).collect::<Option<_>>()?;
        let first = *values.first()?;
        let run = values.iter().position(|&value| value != first).unwrap_or(values.len());
        let step = values.get(run).map_or(0, |second| second - first);
        let period = (2..values.len().div_ceil(run)).find(|&period| values[period * run] == first);
        let is_rule = run == values.len() || 2 * run <= values.len();
        let pattern = Pattern { first, step, run, period };
        (is_rule && (0..values.len()).all(|lane| values[lane] == pattern.value(lane))).then_some(pattern)
    }

    fn value(&self, lane: usize) -> i64 {
        let count = lane / self.run;
        self.first + self.step * self.period.map_or(count, |period| count % period) as i64
    }

    /// The formula, with `i` as the lane's number.
    pub fn text(&self, i: &str) -> String {
        let run = if self.run == 1 { i.to_string() } else { format!("{i} / {}", self.run) };
        let (count, simple) = match (self.period, self.run) {
            (None, run_length) => (run, run_length == 1),
            (Some(period), 1) => (format!("{run} % {period}"), false),
            (Some(period), _) => (format!("({run}) % {period}"), false),
        };
        let term = match self.step.abs() {
            1 => count,
            step if simple => format!("{step} * {count}"),
            step => format!("{step} * ({count})"),
        };
        let bracketed = if simple || self.step.abs() != 1 { term.clone() } else { format!("({term})") };
        match (self.first, self.step) {
            (first, 0) => first.to_string(),
            (0, step) if step > 0 => term,
            (first, step) => format!("{first} {} {bracketed}", if step > 0 { "+" } else { "-" }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn formula(value: fn(u64) -> u64) -> Option<String> {
        let values: Vec<Bits> = (0..48).map(|lane| Bits::new(16, value(lane))).collect();
        Pattern::of(&values).map(|pattern| pattern.text("i"))
    }

    #[test]
    fn rules_are_found() {
        assert_eq!(formula(|_| 7).as_deref(), Some("7"));
        assert_eq!(formula(|lane| lane).as_deref(), Some("i"));
        assert_eq!(formula(|lane| 100 - 2 * lane).as_deref(), Some("100 - 2 * i"));
        assert_eq!(formula(|lane| lane % 8).as_deref(), Some("i % 8"));
        assert_eq!(formula(|lane| lane / 8).as_deref(), Some("i / 8"));
        assert_eq!(formula(|lane| 1 + 16 * (lane / 4 % 3)).as_deref(), Some("1 + 16 * ((i / 4) % 3)"));
        assert_eq!(formula(|lane| 3 + lane % 2).as_deref(), Some("3 + (i % 2)"));
        assert_eq!(formula(|lane| lane / 24).as_deref(), Some("i / 24"));
        assert_eq!(formula(|lane| lane * lane), None);
        // A single, late step is not a rule.
        assert_eq!(formula(|lane| lane / 25), None);
        assert_eq!(formula(|lane| u64::from(lane == 47)), None);
    }
}

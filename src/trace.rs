//! The part of a run that goes to a waveform file.

use crate::shell::output::Waveform;
use crate::shell::{Exit, Failure, terminal};
use clap::Args;
use std::ops::Range;
use std::path::Path;
use tilewright_hdl::Bundle;
use tilewright_sim::{Simulation, Trace};

/// The heading of the options for a waveform file.
pub const WAVEFORM: &str = "Waveform";

/// Filters of a waveform file.
#[derive(Args, Clone, Default)]
#[command(next_help_heading = WAVEFORM)]
pub struct TraceOptions {
    /// Record only signals with a matching path, such as `u_cell[*].value`, or the path in the Verilog. `*` matches anything but a dot, `**` anything
    #[arg(long, value_name = "GLOB")]
    scope: Vec<String>,
    /// Record also the words of memories with a matching path, such as `u_queue.bytes`, or some of them, as `u_queue.bytes[0..8]`; at most 4096 words
    #[arg(long, value_name = "GLOB", value_parser = words)]
    memory: Vec<(String, Range<u32>)>,
    /// Record only from this simulated time on, such as 250ns or 1.5us
    #[arg(long, value_name = "TIME", value_parser = picoseconds)]
    from: Option<u64>,
    /// Record only up to this simulated time
    #[arg(long, value_name = "TIME", value_parser = picoseconds)]
    to: Option<u64>,
}

impl TraceOptions {
    /// Whether the user asks for words of memories.
    pub fn has_words(&self) -> bool {
        !self.memory.is_empty()
    }

    /// These signals alone, by patterns, in those picoseconds.
    pub fn of(scope: Vec<String>, times: Range<u64>) -> TraceOptions {
        TraceOptions { scope, from: Some(times.start), to: Some(times.end), memory: Vec::new() }
    }

    /// The same with a word of a memory.
    pub fn with_word(mut self, memory: &str, address: u32) -> TraceOptions {
        self.memory.push((memory.to_owned(), address..address + 1));
        self
    }

    /// Whether the user asks for some signals only.
    pub fn is_scoped(&self) -> bool {
        !self.scope.is_empty()
    }

    /// The simulated time to record, in picoseconds.
    pub fn times(&self) -> Range<u64> {
        self.from.unwrap_or(0)..self.to.unwrap_or(u64::MAX)
    }

    /// Warns if the run ended at `end` picoseconds, before the waveform begins.
    pub fn warn_if_empty(&self, end: u64) {
        if self.times().start > end {
            terminal::warn(&format!("the run ended at {end} ps, before --from, so the waveform shows nothing"));
        }
    }

    /// Checks that filters come with a waveform; `option` is the option that names its file.
    ///
    /// # Errors
    /// There is no waveform, or no time between `--from` and `--to`.
    pub fn check(&self, waveform: Option<&Path>, option: &str) -> Result<(), Failure> {
        let bad = |sentence: String| Err(Failure::new(Exit::BadInput, sentence));
        if self.times().is_empty() {
            return bad("no time is left between --from and --to: give --to a later time than --from".to_owned());
        }
        let is_filtered = self.is_scoped() || self.has_words() || self.from.is_some() || self.to.is_some();
        if waveform.is_none() && is_filtered {
            let sentence = "--scope, --memory, --from and --to are for a waveform file: name it with";
            return bad(format!("{sentence} {option} FILE"));
        }
        Ok(())
    }

    /// The waveform with these filters.
    ///
    /// # Errors
    /// The system has no room for another open file.
    pub fn trace(&self, waveform: &Waveform) -> Result<Trace, Failure> {
        let all = waveform.trace()?.times(self.times());
        let some = self.scope.iter().fold(all, |trace, pattern| trace.only(pattern));
        Ok(self.memory.iter().fold(some, |trace, (pattern, range)| trace.words(pattern, range.clone())))
    }

    /// Makes a simulation write the waveform with these filters; returns its header.
    ///
    /// # Errors
    /// A filter matches nothing, or it cannot be written.
    pub fn attach<I: Bundle, O: Bundle>(
        &self,
        waveform: &Waveform,
        sim: &mut Simulation<I, O>,
    ) -> Result<Vec<u8>, Failure> {
        let trace = self.trace(waveform)?;
        let header = sim.trace_header(&trace)?;
        waveform.clear()?;
        sim.trace(trace)?;
        Ok(header)
    }
}

/// A pattern of memories, and addresses such as `[0..8]` behind it.
fn words(text: &str) -> Result<(String, Range<u32>), &'static str> {
    let Some((pattern, range)) = text.strip_suffix(']').and_then(|rest| rest.rsplit_once('[')) else {
        return Ok((text.to_owned(), 0..u32::MAX));
    };
    let Some((start, end)) = range.split_once("..") else { return Ok((text.to_owned(), 0..u32::MAX)) };
    match (start.parse(), end.parse()) {
        (Ok(start), Ok(end)) if start < end => Ok((pattern.to_owned(), start..end)),
        _ => Err("give the first address, and the one after the last, such as `words[0..8]`"),
    }
}

/// A time such as `1.5us`, in picoseconds.
fn picoseconds(text: &str) -> Result<u64, String> {
    let units = [("ps", 1), ("ns", 1_000), ("us", 1_000_000), ("ms", 1_000_000_000), ("s", 1_000_000_000_000)];
    let parsed = units.into_iter().find_map(|(unit, size)| exact(text.strip_suffix(unit)?, size));
    parsed.ok_or_else(|| {
        "give a number with one of the units ps, ns, us, ms, s, such as 250ns or 1.5us, and at most 213 days".to_owned()
    })
}

/// `number` times `unit`, if that is a whole number. Decimals are exact, unlike those of a float.
fn exact(number: &str, unit: u64) -> Option<u64> {
    let (whole, decimals) = number.split_once('.').unwrap_or((number, ""));
    let scale = 10_u64.checked_pow(decimals.len().try_into().ok()?)?;
    let digits = [whole, decimals].concat();
    let digits = digits.bytes().all(|c| c.is_ascii_digit()).then_some(digits)?;
    let scaled = digits.parse::<u64>().ok()?.checked_mul(unit)?;
    (scaled % scale == 0).then_some(scaled / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_stand_behind_a_pattern() {
        let all = 0..u32::MAX;
        for (text, pattern, range) in [
            ("u_a.words", "u_a.words", all.clone()),
            ("u_a[3].words", "u_a[3].words", all.clone()),
            ("words[3]", "words[3]", all),
            ("u_a[*].words[1][4..16]", "u_a[*].words[1]", 4..16),
        ] {
            assert_eq!(words(text), Ok((pattern.to_owned(), range)));
        }
        for text in ["words[3..3]", "words[..3]", "words[3..]", "words[0..99999999999]", "words[a..b]"] {
            assert!(words(text).is_err(), "{text}");
        }
    }

    #[test]
    fn times_are_exact() {
        let good =
            [("0ps", 0), ("250ns", 250_000), ("1.5us", 1_500_000), ("0.3ms", 300_000_000), ("2s", 2_000_000_000_000)];
        for (text, value) in good {
            assert_eq!(picoseconds(text), Ok(value), "{text}");
        }
        for text in ["", "5", "ns", "-1ns", "1.0001ns ", "0.5ps", "1e3ns", "99999999999999999999s"] {
            assert!(picoseconds(text).is_err(), "{text}");
        }
    }
}

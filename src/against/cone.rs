//! What led to the first difference: the signal at which it begins, and the causes of its value.

use super::run::Instant;
use crate::block::simulation;
use crate::first_difference::{Both, State, cell, pairs_at};
use crate::moment::play_remembered;
use crate::shell::{Failure, progress};
use std::collections::BTreeMap;
use tilewright_hdl::{Bits, Design, Scenario};
use tilewright_sim::{Cause, EngineKind, Limits, Part, Simulation};

/// The causes of a value that is another one in the other run.
pub struct Cone {
    /// The pairs that differ, the one at which the difference begins first.
    pub pairs: Vec<usize>,
    /// The causes of its value in our run; nothing for a clock or a reset.
    pub cause: Option<Cause>,
    /// What its value comes from in the same clock, as far as that was not compared. All else
    /// that it comes from is the same in both runs.
    pub uncompared: Vec<String>,
    /// For each line of the tree, the other value if it is another one.
    pub others: Vec<Option<String>>,
}

impl Cone {
    /// Plays our run again up to the instant of the first difference, and asks why.
    ///
    /// # Errors
    /// It cannot be played.
    pub fn at(design: &Design, scenario: &Scenario, both: &Both, instant: &Instant) -> Result<Cone, Failure> {
        let mut sim = simulation(design, EngineKind::default())?;
        // The failure of an assertion is already known.
        play_remembered(&mut sim, scenario)?;
        sim.go_to(instant.picoseconds)?;
        progress::phase("looking for causes");
        let mut state = both.start();
        state.go_to(instant.until - 1);
        let mut pairs = pairs_at(both, instant.until - 1);
        let names = pairs.iter().map(|pair| (both.pairs[*pair].name.as_str(), *pair)).collect();
        let differing = Differing { names, both, state: &state };
        // A clock or a reset has no cause, and comes last.
        let limits = Limits { depth: 0, nodes: 1, ..Limits::default() };
        let has_cause = |pair: &usize| sim.why_within(both.pairs[*pair].name.as_str(), &limits).is_ok();
        let Some(any) = pairs.iter().copied().find(has_cause) else {
            return Ok(Cone { pairs, cause: None, uncompared: Vec::new(), others: Vec::new() });
        };
        let (origin, uncompared) = differing.origin(&mut sim, any)?;
        let cause = sim.why(both.pairs[origin].name.as_str())?;
        let mut others = Vec::new();
        differing.others(&cause, true, &mut others);
        pairs.sort_by_key(|pair| *pair != origin);
        Ok(Cone { pairs, cause: Some(cause), uncompared, others })
    }
}

/// The signals that differ at a time.
struct Differing<'a> {
    /// Their pairs by their names.
    names: BTreeMap<&'a str, usize>,
    both: &'a Both<'a>,
    state: &'a State<'a>,
}

impl Differing<'_> {
    /// Follows causes that differ as far as they lead within the clock, and tells what was not compared there.
    fn origin(&self, sim: &mut Simulation, from: usize) -> Result<(usize, Vec<String>), Failure> {
        let limits = Limits { depth: 1, nodes: 1000, ..Limits::default() };
        let mut here = from;
        // Within a clock no signal comes from itself.
        for _ in 0..=self.names.len() {
            let cause = sim.why_within(self.both.pairs[here].name.as_str(), &limits)?;
            let causes = if is_state(&cause) { &[][..] } else { &cause.causes[..] };
            let Some(next) = causes.iter().find_map(|cause| self.pair(cause)) else {
                let uncompared = causes.iter().filter(|cause| !self.is_compared(cause));
                return Ok((here, uncompared.map(|cause| cause.name.clone()).collect()));
            };
            here = next;
        }
        Ok((here, Vec::new()))
    }

    /// Whether a cause is a signal that both runs have.
    fn is_compared(&self, cause: &Cause) -> bool {
        self.both.pairs.binary_search_by(|pair| pair.name.cmp(&cause.name)).is_ok()
    }

    /// The pair of a cause whose bits that count differ.
    fn pair(&self, cause: &Cause) -> Option<usize> {
        let pair = *self.names.get(cause.name.as_str())?;
        let theirs = self.state.value(pair, 1)?;
        differs(&cause.value, &cause.bits, theirs).then_some(pair)
    }

    /// For each cause of the tree, in the sequence of its lines, the other value where it differs.
    fn others(&self, cause: &Cause, is_now: bool, others: &mut Vec<Option<String>>) {
        let pair = if is_now { self.pair(cause) } else { None };
        others.push(pair.map(|pair| {
            let theirs = self.state.value(pair, 1).unwrap_or_default();
            decimal(theirs).unwrap_or_else(|| format!("0x{}", cell(self.state, pair, 1)))
        }));
        // What a register or a word came from is of an earlier clock, where nothing differs.
        let is_now = is_now && !is_state(cause);
        cause.causes.iter().for_each(|cause| self.others(cause, is_now, others));
    }
}

/// Whether its causes are of an earlier clock.
fn is_state(cause: &Cause) -> bool {
    matches!(cause.part, Part::Register | Part::ReadData | Part::Word)
}

/// Whether a value has other bits than a text of bits, the highest first, where those count. An unknown bit is no other one.
fn differs(value: &Bits, counted: &Bits, theirs: &[u8]) -> bool {
    let bit = |at: u32| theirs.get((theirs.len() as u32).wrapping_sub(at + 1) as usize);
    (0..value.width()).filter(|at| counted.bit(*at)).any(|at| match bit(at) {
        Some(b'0') => value.bit(at),
        Some(b'1') => !value.bit(at),
        Some(b'x') => false,
        _ => true,
    })
}

/// A text of known bits as a decimal number.
fn decimal(bits: &[u8]) -> Option<String> {
    let text = std::str::from_utf8(bits).ok()?;
    u128::from_str_radix(text, 2).ok().map(|number| number.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_bits_that_count_and_are_known_differ() {
        let value = Bits::new(4, 0b1010);
        for (counted, theirs, expected) in [
            (0b1111, "1010", false),
            (0b1111, "1011", true),
            (0b1110, "1011", false),
            (0b1111, "101x", false),
            (0b1111, "101z", true),
            (0b1000, "010", true),
        ] {
            assert_eq!(differs(&value, &Bits::new(4, counted), theirs.as_bytes()), expected, "{counted:b} {theirs}");
        }
        assert_eq!((decimal(b"1010").as_deref(), decimal(b"10x0")), (Some("10"), None));
    }
}

//! ABC decides whether the outputs can differ.

use super::circuit::Circuit;
use super::miter::{DIFFERENT, QUIET};
use crate::invariant::ABC;
use crate::model::unwritable;
use crate::process::{printed, run};
use crate::solver::{Halt, Patience};
use crate::{Error, Stage};
use std::path::Path;
use std::time::{Duration, Instant};
use tilewright_gen::tools::Missing;

/// What is known of the two modules.
pub enum Decided {
    Equal,
    /// The inputs, clock by clock, by which they differ at the end.
    Differs(Vec<Vec<bool>>),
    Open {
        /// They are equal in as many clocks from the start.
        clocks: u32,
        /// What the time was too short for.
        late: Option<Stage>,
    },
}

/// All runs, and those without a reset after the first clock.
const ALL: &str = "all.aig";
const WITHOUT_RESET: &str = "quiet.aig";
const RUN: &str = "run.txt";
/// The seconds in which a shorter run is searched.
const SHORTENING: u64 = 3;
/// How hard ABC tries to show that two signals are equal before it keeps both. Adders and shifters take many conflicts.
const CONFLICTS: u32 = 10_000;
/// The time that ABC has to end by itself.
const GRACE: Duration = Duration::from_millis(500);

/// Compares the two modules.
///
/// # Errors
///
/// ABC is missing, or the watcher asks to stop.
pub fn decide(circuit: &Circuit, depth: u32, folder: &Path, patience: &Patience) -> Result<Decided, Halt> {
    for (name, assumed) in [(ALL, &[][..]), (WITHOUT_RESET, &[QUIET])] {
        std::fs::write(folder.join(name), circuit.question(DIFFERENT, assumed)).map_err(unwritable)?;
    }
    let abc = Abc { circuit, folder, patience };
    // Random inputs find most mistakes at once, and a proof is then in vain.
    let guessed = circuit.guess(DIFFERENT, QUIET);
    let said = match guessed {
        Some(_) => None,
        // Registers that are equal are found and merged. What is left of both modules is often nothing.
        None => Some(abc.prove(abc.part(3))?),
    };
    if said.as_ref().is_some_and(|said| said.text.contains("Property proved")) {
        return Ok(Decided::Equal);
    }
    // A shortest run is searched, first one without a further reset, which is easier to read. It is not longer than one
    // that random inputs have found.
    let most = guessed.as_ref().map_or(depth, |inputs| depth.min(inputs.len() as u32));
    let seconds = if guessed.is_some() { SHORTENING } else { abc.part(3) };
    if let Some(inputs) = abc.search(WITHOUT_RESET, most, seconds)?.run.or(guessed) {
        return Ok(Decided::Differs(inputs));
    }
    let searched = abc.search(ALL, depth, abc.part(1))?;
    let is_proof_late = said.as_ref().is_some_and(|said| said.is_late);
    Ok(match searched.run.or(said.and_then(|said| said.run)) {
        Some(inputs) => Decided::Differs(inputs),
        None => {
            let late = if searched.is_late { Some(Stage::Search) } else { is_proof_late.then_some(Stage::Invariant) };
            Decided::Open { clocks: clocks(&searched.text), late }
        }
    })
}

/// The clocks in which the search found nothing: it says so at its end, and has a line for each until then.
fn clocks(text: &str) -> u32 {
    let after = text.split("No output asserted in ").nth(1).and_then(|rest| rest.split_whitespace().next());
    let line = |line: &str| line.split_once(" + : Var =")?.0.trim().parse().ok();
    let last = || text.lines().rev().find_map(line).map_or(0, |last: u32| last + 1);
    after.and_then(|number| number.parse().ok()).unwrap_or_else(last)
}

/// What ABC said, and the run that it found.
struct Said {
    text: String,
    run: Option<Vec<Vec<bool>>>,
    /// Its seconds were too few.
    is_late: bool,
}

struct Abc<'a> {
    circuit: &'a Circuit,
    folder: &'a Path,
    patience: &'a Patience<'a>,
}

impl Abc<'_> {
    /// That part of the seconds that are left.
    fn part(&self, of: u64) -> u64 {
        let left = self.patience.end.map_or(60, |end| end.saturating_duration_since(Instant::now()).as_secs());
        (left / of).max(1)
    }

    /// Tries to prove that they never differ.
    fn prove(&self, seconds: u64) -> Result<Said, Halt> {
        self.run(ALL, &format!("scorr -C {CONFLICTS}; pdr -T {seconds}"), seconds)
    }

    /// Searches a shortest run.
    fn search(&self, file: &str, depth: u32, seconds: u64) -> Result<Said, Halt> {
        self.run(file, &format!("bmc3 -v -F {depth} -T {seconds}"), seconds)
    }

    /// Runs commands, of which not all look at the clock: they are ended soon after these seconds.
    fn run(&self, file: &str, commands: &str, seconds: u64) -> Result<Said, Halt> {
        let _ = std::fs::remove_file(self.folder.join(RUN));
        // What is assumed becomes a part of the output.
        let fold = if file == WITHOUT_RESET || self.circuit.has_constraints() { "fold; " } else { "" };
        let commands = format!("read_aiger {file}; {fold}orpos; {commands}; write_cex -a {RUN}");
        let missing = Missing { program: ABC, remedy: "install it (Debian: apt-get install yosys)" };
        let own = Instant::now() + Duration::from_secs(seconds) + GRACE;
        let end = Some(self.patience.end.map_or(own, |end| end.min(own)));
        let (text, is_ended) = match run(ABC, &["-c", &commands], self.folder, &Patience { end, ..*self.patience }) {
            Ok(ended) => (ended.ok_or_else(|| Error::from(missing))?.1, false),
            Err(Halt::Late) => (printed(self.folder), true),
            Err(failed) => return Err(failed),
        };
        let is_late = is_ended || ["Reached timeout", "Resource limit reached"].iter().any(|it| text.contains(it));
        let found = text.contains("was asserted in frame").then(|| self.inputs()).flatten();
        Ok(Said { text, run: found, is_late })
    }

    /// The inputs of the run that ABC has written; `None` if it is not one of the circuit.
    fn inputs(&self) -> Option<Vec<Vec<bool>>> {
        let text = std::fs::read_to_string(self.folder.join(RUN)).ok()?;
        let is_bits = |line: &&str| !line.is_empty() && line.chars().all(|c| c == '0' || c == '1');
        let lines = text.split(['\n', '#']).map(str::trim).filter(is_bits);
        // The first line is the state at the start.
        let bits = |line: &str| line.chars().map(|c| c == '1').collect::<Vec<bool>>();
        let inputs: Vec<Vec<bool>> = lines.skip(1).map(bits).collect();
        inputs.iter().all(|it| it.len() == self.circuit.inputs()).then_some(inputs).filter(|it| !it.is_empty())
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_clocks_of_a_search_are_read() {
        assert_eq!(super::clocks("No output asserted in 20 frames. Resource limit reached"), 20);
        let cut = "  0 + : Var =  46. Cla = 17.\n 11 + : Var =  52. Cla = 18.\n 12 + ";
        assert_eq!([super::clocks(cut), super::clocks("nothing")], [12, 0]);
    }
}

//! Many designs in one run of another simulator: a run of Icarus takes 20 ms for one design, and little more for a
//! hundred; a build with Verilator takes seconds for one.
//!
//! The benches of all designs become instances in one module. Each prints its verdict behind its own name, and none
//! ends the run: it is over when the last bench has nothing more to do.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fmt::Write;
use std::fs::File;
use std::process::Command;
use tempfile::TempDir;
use tilewright_gen::VerilogFile;
use tilewright_gen::tools::{self, WITH_COVERS, WITH_MODELS};

/// A design that was printed, with the testbench that replays its run.
#[derive(Debug, Clone)]
pub struct Printed {
    /// The Verilog and data files, the top module last.
    pub files: Vec<VerilogFile>,
    /// The testbench.
    pub bench: VerilogFile,
    /// The run ended at an assertion that did not hold, as the replay has to.
    pub fails: bool,
    /// The names of the covers that were hit, in whatever instance; nothing if nobody looked.
    pub covered: Option<BTreeSet<String>>,
    /// What its displays showed, sorted; nothing if nobody looked.
    pub shown: Option<Vec<String>>,
}

/// A simulator of Verilog.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tool {
    /// Icarus Verilog.
    Icarus,
    /// Verilator.
    Verilator,
    /// Verilator without the passes that make the C++ of whole machines twice as long.
    VerilatorOfLarge,
}

impl Tool {
    /// Its name, for messages.
    pub fn name(self) -> &'static str {
        match self {
            Tool::Icarus => "Icarus Verilog",
            Tool::Verilator | Tool::VerilatorOfLarge => "Verilator",
        }
    }

    fn programs(self) -> &'static [&'static str] {
        match self {
            Tool::Icarus => &["iverilog", "vvp"],
            Tool::Verilator | Tool::VerilatorOfLarge => &["verilator", "perl", "make", "g++"],
        }
    }

    /// Whether its programs and those that they call are installed; where one is not, says so, and fails if `CI` is set.
    pub fn is_here(self) -> bool {
        tools::skipped_without(self.programs()).is_none()
    }
}

/// Why a tool did not run the designs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Refused {
    /// It does not take the Verilog; what it printed.
    Verilog(String),
    /// It broke on what it made of the Verilog itself, or does not come to an end, which says nothing about the Verilog.
    /// Known of Icarus 11: a constant that comes out of an instance and is shifted by a signal; a chain of sums of a
    /// value with itself, which it computes twice as often at each link.
    Itself(String),
}

/// What the text of a display begins with in a random design. The design's prefix follows.
pub(crate) const SHOWN: &str = "SHOWN ";

/// Seconds of processor time for benches that come to an end: more than they need.
pub const PATIENCE: u64 = 300;

/// Runs the benches of all designs together: for each, nothing if it passed, else what it printed. Icarus is ended after so many seconds of
/// processor time.
///
/// # Errors
///
/// The tool does not run them; one design is enough for that.
pub fn run(tool: Tool, designs: &[Printed], seconds: u64) -> Result<Vec<Option<String>>, Refused> {
    let folder = temporary_folder();
    // Designs may share modules, of one text.
    let mut files: BTreeMap<&str, &str> = BTreeMap::new();
    let mut text = String::new();
    let mut instances = String::new();
    for (number, design) in designs.iter().enumerate() {
        for file in &design.files {
            if let Some(known) = files.insert(&file.name, &file.text) {
                assert_eq!(known, file.text, "two designs have different files of the name {}", file.name);
                continue;
            }
            match file.name.ends_with(".v") {
                // An assertion that fails must not end the other benches.
                true => text += &without_stops(&file.text),
                false => std::fs::write(folder.path().join(&file.name), &file.text).expect("a file can be written"),
            }
        }
        let name = design.bench.name.trim_end_matches(".v");
        text += &named_verdicts(&design.bench.text, number);
        writeln!(instances, "    {name} bench{number} ();").expect("a string takes text");
    }
    writeln!(text, "module all_benches;\n{instances}endmodule").expect("a string takes text");
    std::fs::write(folder.path().join("all_benches.v"), text).expect("a file can be written");
    let output = match tool {
        Tool::Icarus => icarus(&folder, seconds)?,
        Tool::Verilator => verilator(&folder, &[])?,
        Tool::VerilatorOfLarge => verilator(&folder, &["-fno-expand", "-fno-table"])?,
    };
    Ok(verdicts(&output, designs))
}

/// The bench with its number before each line that it prints, and without the end of the simulation.
fn named_verdicts(bench: &str, number: usize) -> String {
    let named = bench.replace("$display(\"", &format!("$display(\"{number}: "));
    assert!(named.contains("$finish;"), "the testbench does not end with $finish");
    without_stops(&named).replace("$finish;", "")
}

/// The text without what ends a simulation where something fails.
fn without_stops(text: &str) -> String {
    text.replace("$stop;", "").replace("$finish_and_return(1);", "")
}

fn verdicts(output: &str, designs: &[Printed]) -> Vec<Option<String>> {
    let mut lines: BTreeMap<usize, Vec<&str>> = BTreeMap::new();
    let mut asserted: BTreeMap<usize, &str> = BTreeMap::new();
    let mut covered: BTreeMap<usize, BTreeSet<String>> = BTreeMap::new();
    let mut shown: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for line in output.lines() {
        if let Some((prefix, _)) = line.strip_prefix(SHOWN).and_then(|rest| rest.split_once(' ')) {
            shown.entry(prefix).or_default().push(line);
        } else if let Some((_, place)) = line.split_once("all_benches.bench") {
            let number = place.split('.').next().and_then(|number| number.parse().ok());
            let number = number.expect("a statement says in which bench it is");
            match (line.starts_with("COVER: "), line.rsplit_once(": ")) {
                (true, Some((_, name))) => _ = covered.entry(number).or_default().insert(name.to_owned()),
                _ => _ = asserted.entry(number).or_insert(line),
            }
        } else if let Some((number, text)) = line.split_once(": ")
            && let Ok(number) = number.parse()
        {
            lines.entry(number).or_default().push(text);
        }
    }
    let verdict = |(number, design): (usize, &Printed)| {
        let asserted = asserted.get(&number);
        match lines.get(&number).map(Vec::as_slice) {
            Some([line]) if line.starts_with("PASS: ") => match (asserted, design.fails) {
                (Some(line), false) => Some((*line).to_owned()),
                (None, true) => Some("no assertion fails, but one did in the run".to_owned()),
                (None, false) => {
                    let (here, ours) = (covered.get(&number).cloned().unwrap_or_default(), design.covered.as_ref());
                    let differing = ours.filter(|ours| **ours != here);
                    let covered = differing.map(|ours| format!("covered are {here:?}, but {ours:?} in the run"));
                    covered.or_else(|| {
                        let prefix = design.bench.name.rsplit_once("_part").map_or("", |(prefix, _)| prefix);
                        let mut here = shown.get(prefix).cloned().unwrap_or_default();
                        here.sort_unstable();
                        let differing = design.shown.as_ref().filter(|ours| **ours != here);
                        differing.map(|ours| format!("shown is {here:#?}, but {ours:#?} in the run"))
                    })
                }
                _ => None,
            },
            Some(lines) => Some(lines.join("\n")),
            None => Some("the bench printed nothing".to_owned()),
        }
    };
    designs.iter().enumerate().map(verdict).collect()
}

/// A folder of this program, gone when it is dropped.
pub(crate) fn temporary_folder() -> TempDir {
    TempDir::with_prefix("tilewright-cosim-").expect("a temporary folder can be made")
}

fn icarus(folder: &TempDir, seconds: u64) -> Result<String, Refused> {
    let compile = ["-g2005", "-s", "all_benches", WITH_COVERS, WITH_MODELS, "-o", "all_benches.vvp", "all_benches.v"];
    let (succeeded, output) = execute(folder, Command::new("iverilog").args(compile));
    if !succeeded {
        // An assertion of its own is no complaint.
        return Err(if output.contains("Assertion `") { Refused::Itself(output) } else { Refused::Verilog(output) });
    }
    let (succeeded, output) = execute(folder, limited("vvp", seconds).args(["-n", "all_benches.vvp"]));
    if succeeded { Ok(output) } else { Err(Refused::Itself(output)) }
}

/// A program that is ended when it has had so many seconds of processor time: on a busy computer it takes longer, but no more of that.
pub(crate) fn limited(program: impl AsRef<OsStr>, seconds: u64) -> Command {
    let mut command = Command::new("sh");
    command.args(["-c", &format!("ulimit -t {seconds}; exec \"$0\" \"$@\"")]).arg(program);
    command
}

fn verilator(folder: &TempDir, without: &[&str]) -> Result<String, Refused> {
    // Gates put into the code of the benches would double the C++.
    let flags = [&["-Wno-fatal", "-Wno-lint", "-fno-gate", WITH_COVERS, WITH_MODELS], without].concat();
    match tools::verilated(folder.path(), &["all_benches.v"], "all_benches", &flags) {
        Ok(Some(program)) => Ok(execute(folder, &mut Command::new(program)).1),
        Ok(None) => Err(Refused::Itself("it is not installed".to_owned())),
        Err(problems) => Err(Refused::Verilog(problems.to_string())),
    }
}

/// Runs a program in the folder: whether it succeeded, and all that it printed.
pub(crate) fn execute(folder: &TempDir, command: &mut Command) -> (bool, String) {
    let name = command.get_program().to_string_lossy().into_owned();
    let printed = folder.path().join("printed.txt");
    let file = File::create(&printed).expect("a file can be written");
    let both = file.try_clone().expect("a file can be shared");
    let status = command.current_dir(folder.path()).stdout(file).stderr(both).status();
    let status = status.unwrap_or_else(|error| panic!("`{name}` cannot be run: {error}"));
    let text = std::fs::read(&printed).expect("what was written can be read");
    (status.success(), String::from_utf8_lossy(&text).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Stdio;

    #[test]
    fn what_is_covered_is_compared() {
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>();
        let bench = VerilogFile { name: "bench.v".into(), text: String::new() };
        let printed = |covered| Printed { files: vec![], bench: bench.clone(), fails: false, covered, shown: None };
        let output = "COVER: time 10000: all_benches.bench0.dut: rise 3\n\
                      COVER: time 20000: all_benches.bench0.dut.row[1]: rise 3\n0: PASS: 3 steps\n";
        let verdict = |covered| verdicts(output, &[printed(covered)]);
        assert_eq!(verdict(Some(names(&["rise 3"]))), [None]);
        assert_eq!(verdict(None), [None]);
        for wrong in [&["fall 2", "rise 3"][..], &[]] {
            let says = verdict(Some(names(wrong)))[0].clone().expect("another set is covered");
            assert!(says.starts_with("covered are {\"rise 3\"}, but "), "{says}");
        }
    }

    #[test]
    fn what_is_shown_is_compared() {
        let bench = VerilogFile { name: "d1_part0_tb.v".into(), text: String::new() };
        let printed = |shown: &[&str]| {
            let shown = Some(shown.iter().map(|line| (*line).to_owned()).collect());
            Printed { files: vec![], bench: bench.clone(), fails: false, covered: None, shown }
        };
        let output = "SHOWN d1 4: 7\nSHOWN d2 4: 7\nSHOWN d1 3: 9\n0: PASS: 3 steps\n";
        assert_eq!(verdicts(output, &[printed(&["SHOWN d1 3: 9", "SHOWN d1 4: 7"])]), [None]);
        let says = verdicts(output, &[printed(&["SHOWN d1 3: 9"])])[0].clone().expect("another line is shown");
        assert!(says.starts_with("shown is ["), "{says}");
    }

    #[test]
    fn a_program_that_does_not_end_is_ended() {
        let succeeds = |program: &str| limited(program, 1).stdout(Stdio::null()).status().unwrap().success();
        assert!(succeeds("true"));
        assert!(!succeeds("yes"));
        assert!(!succeeds("false"));
    }
}

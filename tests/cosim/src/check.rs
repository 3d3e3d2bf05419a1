//! One design through all tools: what our simulator records of it must be what the others make of the printed Verilog.

use crate::batch::{Printed, temporary_folder};
use crate::dump::{for_yosys, unreliable_reads};
use tilewright_gen::tools::{self, Problems};
use tilewright_gen::{testbench, verilog};
use tilewright_hdl::Design;
use tilewright_sim::{Error, Simulation, Vcd};

/// Runs a design under `stimulus`, and lets Icarus, Verilator and Yosys repeat the run.
///
/// # Panics
///
/// The simulator does not take the design, or the stimulus fails in it.
///
/// # Errors
///
/// What the tools complain about.
pub fn check_design(
    design: &Design,
    stimulus: impl FnOnce(&mut Simulation) -> Result<(), Error>,
) -> Result<(), Problems> {
    let run = Run::of(design, stimulus).unwrap_or_else(|error| panic!("{error}"));
    let Printed { files, bench, .. } = &run.printed;
    let _ = tools::replay_in_icarus(files, bench)?;
    let _ = tools::replay_in_verilator(files, bench)?;
    run.check_dump(design)
}

/// A run of a design, with everything that other tools need to repeat it.
#[derive(Debug)]
pub struct Run {
    /// The Verilog and its testbench.
    pub printed: Printed,
    /// The waveform, as VCD.
    dump: String,
}

impl Run {
    /// Runs a design under `stimulus`, recorded and dumped from the start.
    ///
    /// # Errors
    ///
    /// What the simulator says.
    pub fn of(design: &Design, stimulus: impl FnOnce(&mut Simulation) -> Result<(), Error>) -> Result<Run, Error> {
        let folder = temporary_folder();
        let path = folder.path().join("run.vcd");
        let mut sim = Simulation::from_design(design)?;
        sim.trace(Vcd::to(&path))?;
        let recording = sim.recording();
        stimulus(&mut sim)?;
        sim.finish()?;
        let printed = Printed {
            files: verilog(design),
            bench: testbench(design, &recording.take()),
            fails: false,
            covered: None,
            shown: None,
        };
        Ok(Run { printed, dump: std::fs::read_to_string(path).expect("the dump can be read") })
    }

    /// How many bytes the dump has: what Yosys takes for it goes by that.
    pub fn dump_size(&self) -> usize {
        self.dump.len()
    }

    /// Lets Yosys compare the dump with the printed Verilog: ports, registers and named nets are in both.
    ///
    /// # Errors
    ///
    /// What Yosys complains about.
    pub fn check_dump(&self, design: &Design) -> Result<(), Problems> {
        let top = design.top();
        let clocks: Vec<&str> = top.clocks.iter().map(|clock| clock.port.as_str()).collect();
        let folder = temporary_folder();
        let dump = folder.path().join("run.vcd");
        std::fs::write(&dump, for_yosys(&self.dump, &unreliable_reads(design))).expect("a dump can be written");
        tools::yosys_replay_vcd(&self.printed.files, &dump, &top.name, &clocks).map(|_| ())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether Yosys finds it if each value of a variable of a block's dump is inverted.
    fn is_found(block: &str, variable: &str) -> bool {
        let entry = tilewright_rtl::catalog::ENTRIES.iter().find(|entry| entry.name == block).expect("a block");
        let values = entry.values(Vec::new()).expect("its defaults");
        let (design, scenario) = (entry.design(&values).expect("sound"), entry.scenario(&values).expect("it has one"));
        let mut run = Run::of(&design, |sim| sim.play(&scenario)).expect("it runs");
        run.check_dump(&design).expect("Yosys agrees");
        let declared = run.dump.lines().find(|line| line.contains(&format!(" {variable} "))).expect("it is dumped");
        let id = declared.split(' ').nth(3).expect("an id");
        let invert = |line: &str| match line.strip_suffix(&format!(" {id}")) {
            Some(value) => {
                value
                    .chars()
                    .map(|it| {
                        if it == '0' {
                            '1'
                        } else if it == '1' {
                            '0'
                        } else {
                            it
                        }
                    })
                    .collect::<String>()
                    + " "
                    + id
            }
            None => line.to_owned(),
        };
        let (header, changes) = run.dump.split_once("$enddefinitions").expect("a header");
        let changes: Vec<String> = changes.lines().map(invert).collect();
        run.dump = format!("{header}$enddefinitions{}\n", changes.join("\n"));
        run.check_dump(&design).is_err_and(|problems| problems.to_string().contains("Signal difference"))
    }

    #[test]
    fn yosys_finds_a_wrong_lane_and_a_wrong_word() {
        if tools::skipped_without(&["yosys", "vcd2fst"]).is_none() {
            assert!(is_found("video-controller", "pixels_payload[1]"));
            assert!(is_found("video-buffer", "old0"));
        }
    }

    /// Nobody may rely on what a read gives whose word is written.
    #[test]
    fn yosys_is_not_asked_of_an_unreliable_read() {
        if tools::skipped_without(&["yosys", "vcd2fst"]).is_none() {
            assert!(!is_found("video-buffer", "bank0_read"));
        }
    }
}

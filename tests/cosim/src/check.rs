//! One design through all tools: what our simulator records of it must be what the others make of the printed Verilog.

use crate::batch::Printed;
use tempfile::TempDir;
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
    folder: TempDir,
}

impl Run {
    /// Runs a design under `stimulus`, recorded and dumped from the start.
    ///
    /// # Errors
    ///
    /// What the simulator says.
    pub fn of(design: &Design, stimulus: impl FnOnce(&mut Simulation) -> Result<(), Error>) -> Result<Run, Error> {
        let folder = TempDir::with_prefix("tilewright-cosim-").expect("a temporary folder can be made");
        let mut sim = Simulation::from_design(design)?;
        sim.trace(Vcd::to(folder.path().join("run.vcd")))?;
        let recording = sim.recording();
        stimulus(&mut sim)?;
        sim.finish()?;
        let printed = Printed {
            files: verilog(design),
            bench: testbench(design, &recording.take()),
            fails: false,
            covered: None,
        };
        Ok(Run { printed, folder })
    }

    /// Lets Yosys compare the dump with the printed Verilog: inputs and registers are in both.
    ///
    /// # Errors
    ///
    /// What Yosys complains about.
    pub fn check_dump(&self, design: &Design) -> Result<(), Problems> {
        let top = design.top();
        let clocks: Vec<&str> = top.clocks.iter().map(|clock| clock.port.as_str()).collect();
        let dump = self.folder.path().join("run.vcd");
        tools::yosys_replay_vcd(&self.printed.files, &dump, &top.name, &clocks).map(|_| ())
    }
}

//! From a top to its bitstream: Yosys, nextpnr, the packer.

use super::family::{Family, family};
use crate::shell::{Exit, Failure, progress};
use crate::synth::flow::{Workspace, failed, lacking, text};
use crate::synth::path::rounded;
use crate::synth::programs::{Ended, Program, Programs, packer};
use crate::synth::report::Resource;
use crate::synth::timing::{Timing, utilisation};
use serde::Serialize;
use std::ops::{ControlFlow, Range};
use tilewright_boards::Top;
use tilewright_gen::VerilogFile;
use tilewright_gen::tools::{Device, sources};
use tilewright_hdl::Design;

/// What is made, and by which programs.
pub struct Task {
    pub device: Device,
    pub family: Family,
    pub programs: Programs,
    packer: Program,
    pub seed: Option<u32>,
    /// Whether the netlist is wanted as Verilog.
    netlist: bool,
}

/// What came of it.
pub struct Made {
    /// The placer's.
    pub seed: u32,
    pub resources: Vec<Resource>,
    /// What there is too little of.
    pub lacking: Vec<Resource>,
    /// Nothing if it does not fit.
    pub clocks: Vec<Speed>,
    /// The bitstream's name; none if it does not fit or is not in time.
    pub bitstream: Option<String>,
}

/// A clock: what it reaches, and what the board's is.
#[derive(Serialize)]
pub struct Speed {
    pub name: String,
    pub mhz: f64,
    pub wanted: f64,
}

/// So many placements are tried if no seed is given.
pub const TRIES: u32 = 5;

const SCRIPT: &str = "synth.ys";
const SYNTHESIZED: &str = "synthesized.json";
const NETLIST: &str = "netlist.v";
const TIMING: &str = "timing.json";
const CONFIGURATION: &str = "configuration.txt";
const YOSYS_LOG: &str = "yosys.log";
const NEXTPNR_LOG: &str = "nextpnr.log";
const PACKER_LOG: &str = "packer.log";

/// What is kept of a run beside the printed files and the bitstream.
const KEPT: [&str; 5] = [SCRIPT, NETLIST, TIMING, YOSYS_LOG, NEXTPNR_LOG];

impl Task {
    /// # Errors
    /// A program is not installed.
    pub fn find(top: &Top, seed: Option<u32>, netlist: bool) -> Result<Task, Failure> {
        let (device, family) = (top.device, family(top.device.target()));
        let programs = Programs::find(device)?;
        let packer = packer(family.packer)?;
        Ok(Task { device, family, programs, packer, seed, netlist })
    }

    /// Makes the bitstream of a design from its files, of which the last one has the constraints.
    ///
    /// # Errors
    /// A tool fails, the user interrupts it, or the system has no room.
    pub fn make(&self, design: &Design, files: &[VerilogFile], space: &Workspace) -> Result<Made, Failure> {
        for file in files {
            space.write(&file.name, file.text.as_bytes())?;
        }
        let top = &design.top().name;
        let constraints = files.last().map_or("", |file| file.name.as_str());
        self.synthesize(top, files, space)?;
        let mut seeds = self.seeds();
        let made = loop {
            let seed = seeds.next().expect("the last one ends it");
            let (ended, made) = self.place(seed, constraints, space)?;
            if !made.lacking.is_empty() {
                return Ok(made);
            }
            if !matches!(ended, Ended::Well) {
                return Err(failed(space, NEXTPNR_LOG, &self.programs.nextpnr.name));
            }
            let clocks = speeds(space)?;
            let is_in_time = clocks.iter().all(|clock| clock.mhz >= clock.wanted);
            match is_in_time {
                true => break Made { clocks, ..made },
                false if seeds.is_empty() => return Ok(Made { clocks, ..made }),
                false => {}
            }
        };
        let name = format!("{top}.{}", self.family.ending);
        self.pack(&name, space)?;
        Ok(Made { bitstream: Some(name), ..made })
    }

    /// The seeds to try, one after the other.
    fn seeds(&self) -> Range<u32> {
        self.seed.map_or(1..1 + TRIES, |seed| seed..seed + 1)
    }

    /// The files for a user to keep.
    pub fn files(&self, printed: &[VerilogFile], space: &Workspace, made: Option<&Made>) -> Vec<(String, Vec<u8>)> {
        let bitstream = made.and_then(|made| made.bitstream.as_deref());
        let names = printed.iter().map(|file| file.name.as_str()).chain(KEPT).chain(bitstream);
        names.filter_map(|name| Some((name.to_owned(), space.read(name).ok()?))).collect()
    }

    fn synthesize(&self, top: &str, files: &[VerilogFile], space: &Workspace) -> Result<(), Failure> {
        progress::phase("synthesizing");
        let (sources, library, pass) = (sources(files).join(" "), self.family.library, self.device.pass());
        let netlist = if self.netlist { format!("write_verilog -noattr {NETLIST}\n") } else { String::new() };
        // A bit that is written as a constant alone takes no place in a memory. Yosys sees that only when the value that is
        // written while nothing is written does not matter to it.
        let script = format!(
            "read_verilog {sources}\nread_verilog -lib {library}\nhierarchy -check -top {top}\nproc\nflatten\nopt\n\
             opt_expr -mux_undef\nopt\n{pass} -top {top} -json {SYNTHESIZED}\nstat\n{netlist}"
        );
        space.write(SCRIPT, script.as_bytes())?;
        let arguments = ["-s", SCRIPT].map(str::to_owned);
        let yosys = &self.programs.yosys;
        match yosys.run(space.path(), &arguments, YOSYS_LOG, |_| ControlFlow::Continue(()))? {
            Ended::Well => Ok(()),
            _ => Err(failed(space, YOSYS_LOG, &yosys.name)),
        }
    }

    /// Runs nextpnr until it has ended or it is clear that the machine does not fit.
    fn place(&self, seed: u32, constraints: &str, space: &Workspace) -> Result<(Ended, Made), Failure> {
        progress::phase("placing");
        let Family { constraints: option, configuration, .. } = &self.family;
        let number = seed.to_string();
        let own = ["--json", SYNTHESIZED, option, constraints, configuration, CONFIGURATION];
        let how = ["--report", TIMING, "--seed", &number, "--timing-allow-fail"];
        let arguments = self.device.options().iter().copied().chain(own).chain(how).map(str::to_owned);
        let mut rows = Vec::new();
        let nextpnr = &self.programs.nextpnr;
        let ended = nextpnr.run(space.path(), &arguments.collect::<Vec<_>>(), NEXTPNR_LOG, |log| {
            if rows.is_empty() {
                rows = utilisation(&text(log));
            }
            match rows.iter().any(|row| row.used > row.available) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        })?;
        if rows.is_empty() {
            rows = utilisation(&text(&space.path().join(NEXTPNR_LOG)));
        }
        let resources: Vec<Resource> = rows
            .iter()
            .filter(|row| row.used > 0)
            .map(|row| Resource { name: row.name.clone(), used: row.used, available: row.available })
            .collect();
        let lacking = lacking(&resources, &rows);
        Ok((ended, Made { seed, resources, lacking, clocks: Vec::new(), bitstream: None }))
    }

    fn pack(&self, name: &str, space: &Workspace) -> Result<(), Failure> {
        progress::phase("packing");
        let files = [CONFIGURATION, name];
        let arguments: Vec<String> = self.family.options.iter().copied().chain(files).map(str::to_owned).collect();
        match self.packer.run(space.path(), &arguments, PACKER_LOG, |_| ControlFlow::Continue(()))? {
            Ended::Well => space.read(name).map(drop),
            _ => Err(failed(space, PACKER_LOG, &self.packer.name)),
        }
    }
}

/// What each clock reaches.
fn speeds(space: &Workspace) -> Result<Vec<Speed>, Failure> {
    let unreadable = |error| Failure::new(Exit::NoTool, format!("the report of nextpnr cannot be read: {error}"));
    let timing = Timing::read(&space.read(TIMING)?).map_err(unreadable)?;
    let speed = |clock: crate::synth::timing::Clocked| {
        // A net that a buffer of the chip distributes has the buffer's name, too.
        let net = clock.net.trim_start_matches("$glbnet$");
        let name = net.split('$').next().unwrap_or_default().to_owned();
        Speed { name, mhz: rounded(clock.mhz, 2), wanted: clock.wanted }
    };
    // A clock without a name is a constant that nextpnr distributes, as for a memory that is never clocked.
    Ok(timing.clocks().map(speed).filter(|speed| !speed.name.is_empty()).collect())
}

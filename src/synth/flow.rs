//! From a design to what it takes on a device: Yosys, flip-flops at the ports, nextpnr.

use super::device::{Counted, Device, How};
use super::netlist::{NO_CLOCK, Netlist};
use super::path::{Names, rounded};
use super::programs::{Ended, Programs};
use super::report::{ClockSpeed, Resource};
use super::sources::Sources;
use super::timing::{Row, Timing, utilisation};
use crate::shell::{Exit, Failure};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;
use tempfile::TempDir;
use tilewright_gen::VerilogFile;
use tilewright_gen::tools::sources;
use tilewright_hdl::Design;

/// What is asked of the tools.
pub struct Task<'a> {
    pub device: Device,
    pub programs: &'a Programs,
    pub seed: u32,
    /// In MHz.
    pub aim: u32,
    /// When a block is given up.
    pub deadline: Option<Instant>,
    /// Is told what is done.
    pub phase: fn(&'static str),
}

/// What a block takes.
pub struct Measured {
    pub resources: Vec<Resource>,
    /// What there is too little of.
    pub lacking: Vec<Resource>,
    /// Nothing if it does not fit.
    pub clocks: Vec<ClockSpeed>,
}

/// How a block ended.
pub enum Outcome {
    Measured(Measured),
    /// It was given up at the deadline.
    Late,
}

/// The files of a run: what the tools read and what they said.
pub struct Workspace(TempDir);

const SCRIPT: &str = "synth.ys";
const SYNTHESIZED: &str = "synthesized.json";
const NETLIST: &str = "netlist.json";
const TIMING: &str = "timing.json";
const YOSYS_LOG: &str = "yosys.log";
const NEXTPNR_LOG: &str = "nextpnr.log";

/// What is kept of a run beside the Verilog. The netlist of Yosys is left out: the one for nextpnr has all of it.
const KEPT: [&str; 5] = [SCRIPT, NETLIST, YOSYS_LOG, NEXTPNR_LOG, TIMING];

impl Workspace {
    /// # Errors
    /// The system's folder for temporary files takes none.
    pub fn new() -> Result<Workspace, Failure> {
        let made = TempDir::with_prefix("tilewright-").map_err(|error| Failure::no_temporary(&error));
        Ok(Workspace(made?))
    }

    /// Where the files are.
    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// # Errors
    /// The tools have left no such file.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, Failure> {
        std::fs::read(self.0.path().join(name))
            .map_err(|error| Failure::new(Exit::NoTool, format!("the tools have left no {name}: {error}")))
    }

    /// # Errors
    /// There is no room.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        std::fs::write(self.0.path().join(name), bytes).map_err(|error| Failure::no_temporary(&error))
    }

    /// The files that are there, for a user to keep.
    pub fn files(&self, verilog: &[VerilogFile]) -> Vec<(String, Vec<u8>)> {
        let own = verilog.iter().map(|file| file.name.as_str());
        let names = own.chain(KEPT);
        names.filter_map(|name| Some((name.to_owned(), self.read(name).ok()?))).collect()
    }
}

impl Task<'_> {
    /// Measures a design whose Verilog is in `files`.
    ///
    /// # Errors
    /// A tool fails, the user interrupts it, or the system has no room.
    pub fn measure(&self, design: &Design, files: &[VerilogFile], space: &Workspace) -> Result<Outcome, Failure> {
        for file in files {
            space.write(&file.name, file.text.as_bytes())?;
        }
        let top = &design.top().name;
        if !self.synthesize(top, files, space)? {
            return Ok(Outcome::Late);
        }
        let unreadable = |error| Failure::new(Exit::NoTool, format!("the netlist of Yosys cannot be read: {error}"));
        let mut netlist = Netlist::read(&space.read(SYNTHESIZED)?, top).map_err(unreadable)?;
        let counts: Vec<u64> = self.device.counted().iter().map(|it| own_cells(&netlist, it)).collect();
        let clocks: Vec<&str> = design.top().clocks.iter().map(|clock| clock.port.as_str()).collect();
        netlist.enclose(&clocks, self.device.flip_flop());
        space.write(NETLIST, &netlist.write(top))?;
        let (ended, rows) = self.place(space)?;
        let resources = resources(self.device, &counts, &rows);
        let lacking = lacking(&resources, &rows);
        if !lacking.is_empty() {
            return Ok(Outcome::Measured(Measured { resources, lacking, clocks: Vec::new() }));
        }
        match ended {
            Ended::Well => {}
            Ended::Stopped => return Ok(Outcome::Late),
            Ended::Badly => return Err(failed(space, NEXTPNR_LOG, &self.programs.nextpnr.name)),
        }
        let netlist = Netlist::read(&space.read(NETLIST)?, top).map_err(unreadable)?;
        let clocks = speeds(&netlist, &Sources::of(design, files), space)?;
        Ok(Outcome::Measured(Measured { resources, lacking, clocks }))
    }

    /// Runs Yosys; whether it was in time.
    fn synthesize(&self, top: &str, files: &[VerilogFile], space: &Workspace) -> Result<bool, Failure> {
        (self.phase)("synthesizing");
        let (sources, pass) = (sources(files).join(" "), self.device.chip().pass());
        let script = format!("read_verilog {sources}\n{pass} -top {top}\nwrite_json {SYNTHESIZED}\nstat\n");
        space.write(SCRIPT, script.as_bytes())?;
        let arguments = ["-s", SCRIPT].map(str::to_owned);
        let yosys = &self.programs.yosys;
        match yosys.run(space.0.path(), &arguments, YOSYS_LOG, |_| self.in_time())? {
            Ended::Well => Ok(true),
            Ended::Stopped => Ok(false),
            Ended::Badly => Err(failed(space, YOSYS_LOG, &yosys.name)),
        }
    }

    /// Runs nextpnr until it has ended or it is clear that the block does not fit.
    fn place(&self, space: &Workspace) -> Result<(Ended, Vec<Row>), Failure> {
        (self.phase)("placing");
        let (seed, aim) = (self.seed.to_string(), self.aim.to_string());
        let own = ["--json", NETLIST, "--report", TIMING, "--seed", &seed, "--freq", &aim, "--timing-allow-fail"];
        let arguments: Vec<String> =
            self.device.chip().options().iter().copied().chain(own).map(str::to_owned).collect();
        let mut rows = Vec::new();
        let ended = self.programs.nextpnr.run(space.0.path(), &arguments, NEXTPNR_LOG, |log| {
            if rows.is_empty() {
                rows = utilisation(&text(log));
                if rows.iter().any(|row| row.used > row.available) {
                    return ControlFlow::Break(());
                }
            }
            self.in_time()
        })?;
        if rows.is_empty() {
            rows = utilisation(&text(&space.0.path().join(NEXTPNR_LOG)));
        }
        Ok((ended, rows))
    }

    fn in_time(&self) -> ControlFlow<()> {
        match self.deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}

/// The sentence for a tool that failed: its own last error.
pub fn failed(space: &Workspace, log: &str, program: &str) -> Failure {
    let said = text(&space.0.path().join(log));
    let line = said.lines().rev().find(|line| line.contains("ERROR")).or(said.lines().last());
    let line = line.map_or("it prints nothing", str::trim);
    Failure::new(Exit::NoTool, format!("{program} fails: {line} (-o FOLDER keeps its log)"))
}

/// What a log has; nothing if it is not there.
pub fn text(path: &Path) -> String {
    String::from_utf8_lossy(&std::fs::read(path).unwrap_or_default()).into_owned()
}

/// The cells of that kind before flip-flops are put at the ports.
fn own_cells(netlist: &Netlist, counted: &Counted) -> u64 {
    match counted.how {
        How::Cells(kind) => netlist.count(kind),
        How::Rows(_) => 0,
    }
}

/// What is counted, in nextpnr's rows or in the netlist; a device lacks what has no row.
fn resources(device: Device, counts: &[u64], rows: &[Row]) -> Vec<Resource> {
    let row = |name: &str| rows.iter().find(|row| row.name == name);
    let resource = |(counted, own): (&Counted, &u64)| {
        let used = match counted.how {
            How::Cells(_) => *own,
            How::Rows(names) => names.iter().filter_map(|name| row(name)).map(|row| row.used).sum(),
        };
        Some(Resource { name: counted.name.to_owned(), used, available: row(counted.available)?.available })
    };
    device.counted().iter().zip(counts).filter_map(resource).collect()
}

/// What there is too little of: of what is counted, or else of what nextpnr calls otherwise.
pub fn lacking(resources: &[Resource], rows: &[Row]) -> Vec<Resource> {
    let short: Vec<Resource> = resources.iter().filter(|it| it.used > it.available).cloned().collect();
    if !short.is_empty() {
        return short;
    }
    let short = rows.iter().filter(|row| row.used > row.available);
    short.map(|row| Resource { name: row.name.clone(), used: row.used, available: row.available }).collect()
}

/// What each clock reaches, and its critical path.
fn speeds(netlist: &Netlist, sources: &Sources, space: &Workspace) -> Result<Vec<ClockSpeed>, Failure> {
    let unreadable = |error| Failure::new(Exit::NoTool, format!("the report of nextpnr cannot be read: {error}"));
    let timing = Timing::read(&space.read(TIMING)?).map_err(unreadable)?;
    let names = Names::of(netlist, sources);
    let speed = |it: super::timing::Clocked| {
        let wires_ns = it.path.iter().filter(|step| step.net.is_some()).map(|step| step.delay).sum();
        let cells_ns = it.path.iter().filter(|step| step.net.is_none()).map(|step| step.delay).sum();
        let name = if it.net == NO_CLOCK { "no clock".to_owned() } else { names.clock(it.net) };
        ClockSpeed {
            name,
            mhz: rounded(it.mhz, 2),
            cells_ns: rounded(cells_ns, 3),
            wires_ns: rounded(wires_ns, 3),
            path: names.points(it.path),
        }
    };
    Ok(timing.clocks().map(speed).collect())
}

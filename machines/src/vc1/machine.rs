//! A VC-1 as a whole: built for a configuration, it renders a frame and reports.

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::vc1::{Vc1In, Vc1Out};
use tilewright_scenes::{Frame, Projection};
use tilewright_sim::{EngineKind, Simulation};

use super::assignment::Assignment;
use super::config::Config;
use super::hardware::Hardware;
use super::host::Host;
use super::job::Job;
use super::processor::Processor;
use super::report::{ProcessorReport, Report};
use crate::error::Error;
use crate::run::Watch;

/// A VC-1, switched off.
pub struct Machine {
    config: Config,
    hardware: Hardware,
}

impl Machine {
    /// Builds the machine.
    ///
    /// # Errors
    /// [`Error::Parameter`] if a parameter is out of range.
    pub fn new(config: Config) -> Result<Machine, Error> {
        let hardware = Hardware::new(&config.hardware()?)?;
        Ok(Machine { config, hardware })
    }

    /// The same machine on that engine of the simulator; the compiled one is the default.
    ///
    /// # Panics
    /// A trace is attached.
    #[track_caller]
    pub fn on(mut self, engine: EngineKind) -> Machine {
        self.hardware.sim = self.hardware.sim.on(engine);
        self
    }

    /// The simulated hardware, to attach traces to. [`Machine::render`] ends them, also where it fails.
    pub fn simulation(&mut self) -> &mut Simulation<Vc1In, Vc1Out> {
        &mut self.hardware.sim
    }

    /// Renders a frame: the picture in the global frame buffer's memory, and the report.
    ///
    /// # Errors
    /// [`Error::Parameter`] if the projection is for another
    /// screen; [`Error::Cancelled`]; [`Error::Simulation`]; [`Error::Untraced`].
    pub fn render(
        mut self,
        projection: &Projection,
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Frame, Report), Error> {
        let rendered = self.run(projection, background, watch);
        Error::of_both(rendered, self.hardware.sim.finish())
    }

    fn run(
        &mut self,
        projection: &Projection,
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Frame, Report), Error> {
        let (asked, size) = (projection.size, self.config.size);
        if asked != size {
            let problem = format!("a projection of {asked} pixels on a machine of {size}: project the scene again");
            return Err(ParameterError(problem).into());
        }
        let job = Job::new(&self.config, projection)?;
        let mut processors = job.processors();
        self.hardware.reset(background)?;
        let mut host = Host::new(&mut self.hardware, watch);
        host.draw(&mut processors)?;
        let pages = host.pages_used();
        host.compose(&mut processors)?;
        let words = host.read_out(size.pixels() as u64)?;
        let phases = host.phases;

        let frame = Frame::from_words(size, words).expect("a word of 48 bits was read for each pixel");
        let processors = each_report(&job.assignment, &processors, &pages);
        let report = Report {
            machine: self.config.built()?,
            polygons: projection.counts.polygons,
            packets: projection.triangles.len() as u64,
            pixels: processors.iter().map(|it| it.pixels).sum(),
            processors,
            phases,
            merge_clocks: self.hardware.merge_clocks,
        };
        Ok((frame, report))
    }
}

/// What each processing element did, now that all have ended.
fn each_report(assignment: &Assignment, processors: &[Processor], pages: &[u32]) -> Vec<ProcessorReport> {
    let last = processors.iter().map(|it| it.tally().ended_at).max().unwrap_or_default();
    let report = |(k, it): (usize, &Processor)| ProcessorReport {
        polygons: assignment.polygons[k].len() as u32,
        expected: assignment.loads[k],
        pixels: it.tally().requests,
        pages: pages[k],
        work: it.work(),
        stalls: it.tally().stalls,
        overflows: it.tally().overflows,
        overflow_waits: it.tally().overflow_waits,
        waiting: last - it.tally().ended_at,
    };
    processors.iter().enumerate().map(report).collect()
}

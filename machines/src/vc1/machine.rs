//! A VC-1 as a whole: built for a configuration, it renders a frame and reports.

use tilewright_rtl::lfb::Patches;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::vc1::{Vc1, Vc1In, Vc1Out};
use tilewright_scenes::{Frame, Projection};
use tilewright_sim::Simulation;

use super::assignment::Assignment;
use super::config::{Built, Config};
use super::demand::demand;
use super::hardware::Hardware;
use super::host::{Host, Stop};
use super::overflow::Overflow;
use super::processor::Processor;
use super::program::Program;
use super::report::{ProcessorReport, Report};
use crate::error::Error;
use crate::run::Watch;

/// A VC-1, switched off.
pub struct Machine {
    config: Config,
    patches: Patches,
    pages: u32,
    hardware: Hardware,
}

impl Machine {
    /// Builds the machine.
    ///
    /// # Errors
    /// [`Error::Parameter`] if a parameter is out of range.
    pub fn new(config: Config) -> Result<Machine, Error> {
        config.check()?;
        let (patches, pages) = (config.patches()?, config.pages()?);
        let hardware = Hardware::new(&Vc1::new(patches, pages, config.processors)?)?;
        Ok(Machine { config, patches, pages, hardware })
    }

    /// The simulated hardware, to attach traces to. [`Machine::render`] ends them, also where it fails.
    pub fn simulation(&mut self) -> &mut Simulation<Vc1In, Vc1Out> {
        &mut self.hardware.sim
    }

    /// Renders a frame: the picture in the global frame buffer's memory, and the report.
    ///
    /// # Errors
    /// [`Error::Overflow`] if a processing element runs out of pages; [`Error::Parameter`] if the projection is for another
    /// screen; [`Error::Cancelled`]; [`Error::Simulation`].
    pub fn render(
        mut self,
        projection: &Projection,
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Frame, Report), Error> {
        let (asked, built) = (projection.size, self.config.size);
        if asked != built {
            let problem = format!("a projection of {asked} pixels on a machine of {built}: project the scene again");
            return Err(ParameterError(problem).into());
        }
        let rendered = self.run(projection, background, watch);
        let traced = self.hardware.sim.finish();
        let rendered = rendered?;
        traced?;
        Ok(rendered)
    }

    fn run(
        &mut self,
        projection: &Projection,
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Frame, Report), Error> {
        let Config { processors, cluster, costs, size, .. } = self.config;
        let assignment = Assignment::new(projection, processors, cluster, &costs);
        let program = |polygons| Program::new(costs, &projection.triangles, polygons, self.patches.count());
        let mut processors: Vec<Processor> =
            assignment.polygons.iter().map(|polygons| Processor::new(program(polygons))).collect();
        let pixels = size.pixels() as u64;

        self.hardware.reset(background)?;
        let mut host = Host::new(&mut self.hardware, watch);
        host.draw(&mut processors).map_err(|stop| match stop {
            Stop::Overflow(k) => {
                let pages = demand(&assignment, &projection.triangles, &self.patches).iter().map(|it| it.pages).max();
                Error::Overflow(Overflow {
                    processor: k,
                    pages: self.pages,
                    polygon: processors[k].last_drawn().unwrap_or_default(),
                    sufficient: pages.unwrap_or_default(),
                })
            }
            Stop::Error(error) => error,
        })?;
        let pages: Vec<u32> = (0..processors.len()).map(|k| host.hardware.pages_used(k)).collect();
        host.compose(pixels)?;
        let words = host.read_out(pixels)?;
        let phases = host.phases;
        let merge_clocks = self.hardware.merge_clocks();

        let frame = Frame::from_words(size, words).expect("a word of 48 bits was read for each pixel");
        let drawing_ended = phases[..2].iter().map(|phase| phase.pe_clocks).sum::<u64>();
        let report = |(k, it): (usize, &Processor)| ProcessorReport {
            polygons: assignment.polygons[k].len() as u32,
            expected: assignment.loads[k],
            pixels: it.tally().requests,
            pages: pages[k],
            work: it.work(),
            stalls: it.tally().stalls,
            waiting: drawing_ended - it.tally().ended_at,
        };
        let processors: Vec<ProcessorReport> = processors.iter().enumerate().map(report).collect();
        let report = Report {
            machine: self.built(),
            polygons: projection.counts.polygons,
            packets: projection.triangles.len() as u64,
            pixels: processors.iter().map(|it| it.pixels).sum(),
            processors,
            phases,
            merge_clocks,
        };
        Ok((frame, report))
    }

    fn built(&self) -> Built {
        let Config { size, processors, patch, cluster, costs, .. } = self.config;
        Built {
            width: size.width(),
            height: size.height(),
            processors,
            patch,
            patches: self.patches.count(),
            pages: self.pages,
            cluster,
            costs,
        }
    }
}

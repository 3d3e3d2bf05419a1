//! The host's program: the phases of a frame, from the command to draw to the picture read out.
//!
//! Source: VC1-FLOW, VC1-SW1 to SW4. All processing elements clear their patch tables and draw, through overflows. When all have
//! ended and their local frame buffers are idle, the hardware's swap control does the rest: the local frame buffers swap, the merger brings
//! the picture into the global frame buffer, and its banks change in a vertical blanking. The host reads the displayed bank.

use tilewright_rtl::clocks::{MERGE, PE};

use super::config::Config;
use super::hardware::Hardware;
use super::processor::Processor;
use super::report::{Phase, Report};
use crate::error::Error;
use crate::run::{PROGRESS_CLOCKS, Watch};

/// The host during a frame.
pub(crate) struct Host<'a, 'w> {
    hardware: &'a mut Hardware,
    watch: &'a mut Watch<'w>,
    /// The phases that are over.
    pub phases: Vec<Phase>,
    /// The phase that runs.
    current: &'static str,
}

impl<'a, 'w> Host<'a, 'w> {
    pub fn new(hardware: &'a mut Hardware, watch: &'a mut Watch<'w>) -> Host<'a, 'w> {
        Host { hardware, watch, phases: Vec::new(), current: "" }
    }

    /// Runs the programs until all have drawn the frame.
    pub fn draw(&mut self, processors: &mut [Processor]) -> Result<(), Error> {
        self.phase("clearing", |host| host.run(processors, |it| it.entries_left()))?;
        self.phase("drawing", |host| host.run(processors, |it| usize::from(!it.ended()) + it.polygons_left()))
    }

    /// Runs the programs until nothing is left of any.
    fn run(&mut self, processors: &mut [Processor], left: impl Fn(&Processor) -> usize) -> Result<(), Error> {
        let all: usize = processors.iter().map(&left).sum();
        for clock in 0.. {
            let rest: usize = processors.iter().map(&left).sum();
            if clock % PROGRESS_CLOCKS == 0 {
                self.progress(1.0 - rest as f64 / all.max(1) as f64)?;
            }
            if rest == 0 {
                break;
            }
            self.clock(processors)?;
        }
        Ok(())
    }

    /// One clock of the processing elements.
    fn clock(&mut self, processors: &mut [Processor]) -> Result<(), Error> {
        let mut taken = [false; Config::MAX_PROCESSORS as usize];
        for (k, processor) in processors.iter().enumerate() {
            self.hardware.present(k, processor.access());
            self.hardware.set_done(k, processor.done());
            taken[k] = self.hardware.takes(k);
        }
        self.hardware.tick(PE.name)?;
        for (k, processor) in processors.iter_mut().enumerate() {
            processor.edge(taken[k], self.hardware.state(k));
        }
        Ok(())
    }

    /// By processing element: the pages that it has taken since the last swap.
    pub fn pages_used(&mut self) -> Vec<u32> {
        (0..self.hardware.processors()).map(|k| self.hardware.pages_used(k)).collect()
    }

    /// Waits until the local frame buffers are swapped, then until the global frame buffer shows the frame.
    pub fn compose(&mut self, processors: &mut [Processor]) -> Result<(), Error> {
        self.phase("swapping", |host| {
            while !processors.iter().all(Processor::swapped) {
                host.clock(processors)?;
            }
            Ok(())
        })?;
        self.phase("merging", |host| {
            for clock in 0.. {
                if host.hardware.shown() {
                    break;
                }
                if clock % PROGRESS_CLOCKS == 0 {
                    host.progress((clock as f64 / host.hardware.merge_clocks as f64).min(1.0))?;
                }
                host.hardware.tick(MERGE.name)?;
            }
            Ok(())
        })
    }

    /// Reads the displayed bank of the global frame buffer, row by row from the upper left.
    pub fn read_out(&mut self, pixels: u64) -> Result<Vec<u64>, Error> {
        self.phase(Report::READ_OUT, |host| {
            let mut words = Vec::with_capacity(pixels as usize);
            for address in 0..pixels {
                if address % PROGRESS_CLOCKS == 0 {
                    host.progress(address as f64 / pixels as f64)?;
                }
                words.push(host.hardware.read_displayed(address)?);
            }
            Ok(words)
        })
    }

    /// Does a phase and notes what it took.
    fn phase<T>(&mut self, name: &'static str, body: impl FnOnce(&mut Self) -> Result<T, Error>) -> Result<T, Error> {
        self.current = name;
        let before = self.hardware.now();
        let result = body(self)?;
        self.watch.report(name, 1.0);
        let after = self.hardware.now();
        self.phases.push(Phase {
            name,
            pe_clocks: after.pe_clocks - before.pe_clocks,
            merge_clocks: after.merge_clocks - before.merge_clocks,
            picoseconds: after.time - before.time,
        });
        Ok(result)
    }

    /// Tells the caller how far the phase is, and stops if the caller wants it.
    fn progress(&mut self, fraction: f64) -> Result<(), Error> {
        self.watch.go_on(self.current, fraction, self.hardware.now().time)
    }
}

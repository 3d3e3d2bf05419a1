//! The host's program: the phases of a frame, from the command to draw to the picture read out.
//!
//! Source: VC1-FLOW, VC1-SW1, VC1-SW2. All processing elements clear their patch tables and draw; when all have ended and their
//! local frame buffers are idle, the sync line is high and all local frame buffers are swapped; a merging round moves the picture
//! into the global frame buffer, whose banks are then swapped; the host reads the displayed bank.

use tilewright_rtl::clocks::{MERGE, PE};

use super::config::Config;
use super::hardware::Hardware;
use super::job::Job;
use super::processor::Processor;
use super::report::{Phase, Report};
use crate::error::Error;
use crate::run::{PROGRESS_CLOCKS, Watch};

/// Clocks of the merger until a swap of the local frame buffers has come through the synchronizer to its side.
const SWAP_CROSSING: u64 = 2;

/// The host during a frame.
pub(crate) struct Host<'a, 'w> {
    hardware: &'a mut Hardware,
    job: &'a Job<'a>,
    watch: &'a mut Watch<'w>,
    /// The phases that are over.
    pub phases: Vec<Phase>,
    /// The phase that runs.
    current: &'static str,
}

impl<'a, 'w> Host<'a, 'w> {
    pub fn new(hardware: &'a mut Hardware, job: &'a Job<'a>, watch: &'a mut Watch<'w>) -> Host<'a, 'w> {
        Host { hardware, job, watch, phases: Vec::new(), current: "" }
    }

    /// Runs the programs until the sync line is high: all have ended, and no pixel is under way.
    pub fn draw(&mut self, processors: &mut [Processor]) -> Result<(), Error> {
        self.phase("clearing", |host| host.run(processors, |it| it.entries_left()))?;
        self.phase("drawing", |host| {
            host.run(processors, |it| usize::from(!it.ended()) + it.polygons_left())?;
            while !host.hardware.all_idle() {
                host.clock(processors)?;
            }
            Ok(())
        })
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
            if self.hardware.overflow(k) {
                let polygon = processor.last_drawn().expect("it drew the pixel that is held");
                return Err(self.job.overflow(k, polygon).into());
            }
            self.hardware.present(k, processor.access());
            taken[k] = self.hardware.takes(k);
        }
        self.hardware.tick(PE.name)?;
        processors.iter_mut().zip(taken).for_each(|(processor, taken)| processor.edge(taken));
        Ok(())
    }

    /// By processing element: the pages that it has taken since the last swap.
    pub fn pages_used(&mut self) -> Vec<u32> {
        (0..self.hardware.processors()).map(|k| self.hardware.pages_used(k)).collect()
    }

    /// Swaps the local frame buffers, merges, and swaps the global frame buffer.
    pub fn compose(&mut self) -> Result<(), Error> {
        self.phase("swapping", |host| {
            host.hardware.swap_local_buffers()?;
            (0..SWAP_CROSSING).try_for_each(|_| host.hardware.tick(MERGE.name))
        })?;
        self.phase("merging", |host| {
            host.hardware.start_merging()?;
            while host.hardware.merging() {
                let clocks = host.hardware.merge_clocks();
                if clocks % PROGRESS_CLOCKS == 0 {
                    host.progress(clocks as f64 / host.hardware.round_clocks as f64)?;
                }
                host.hardware.tick(MERGE.name)?;
            }
            host.hardware.swap_global_buffer()
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

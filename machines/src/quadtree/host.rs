//! The host's program, which includes the geometry processor's last step. It sends the packets, swaps the banks and reads the picture.
//!
//! Source: MPG-ARCH, and the protocol of [`tilewright_rtl::quadtree::generator`].

use tilewright_scenes::{Polygon, Size};
use tilewright_sim::Port;

use super::hardware::Hardware;
use super::history::Recording;
use super::report::{Phase, Report};
use crate::error::Error;
use crate::run::{PROGRESS_CLOCKS, Watch};

/// The host during a frame.
pub(crate) struct Host<'a, 'w> {
    hardware: &'a mut Hardware,
    watch: &'a mut Watch<'w>,
    /// The phases that are over.
    pub phases: Vec<Phase>,
    /// The recorded history, if there is one.
    pub recording: Option<Recording>,
    /// The current phase.
    current: &'static str,
    /// The clock of the next report of progress.
    next: u64,
}

impl<'a, 'w> Host<'a, 'w> {
    pub fn new(hardware: &'a mut Hardware, watch: &'a mut Watch<'w>) -> Host<'a, 'w> {
        Host { hardware, watch, phases: Vec::new(), recording: None, current: "", next: 0 }
    }

    /// Sends the packets, and waits until all pixels are drawn.
    pub fn draw(&mut self, packets: &[Polygon]) -> Result<(), Error> {
        self.phase(Report::DRAWING, |host| {
            let ready = host.hardware.sim.i.packets.ready;
            for (number, packet) in packets.iter().enumerate() {
                let done = number as f64 / packets.len() as f64;
                host.hardware.present(packet);
                host.wait_for(ready, done)?;
                host.step(done)?;
            }
            host.hardware.withdraw();
            host.wait_for(host.hardware.sim.o.idle, 1.0)
        })
    }

    /// Swaps the banks and reads what was drawn, line by line from the upper left.
    pub fn read_out(&mut self, size: Size, background: [u8; 3]) -> Result<Vec<u64>, Error> {
        self.phase(Report::READ_OUT, |host| {
            host.hardware.swap()?;
            host.hardware.show(background)?;
            let (pixels, width) = (size.pixels(), size.width() as usize);
            let showing = host.hardware.sim.o.showing;
            let mut words = Vec::with_capacity(pixels);
            // Groups of neighbouring pixels; the last group of a line may extend beyond its end.
            let mut line = 0;
            while host.hardware.is_high(showing) {
                if let Some(mut group) = host.hardware.words() {
                    group.truncate(width - line);
                    line = (line + group.len()) % width;
                    words.append(&mut group);
                }
                host.step(words.len() as f64 / pixels as f64)?;
            }
            Ok(words)
        })
    }

    /// Simulated picoseconds.
    pub fn time(&self) -> u64 {
        self.hardware.sim.time()
    }

    /// Waits until a flag is high; `done` is the part of the phase that is done.
    fn wait_for(&mut self, flag: Port, done: f64) -> Result<(), Error> {
        while !self.hardware.is_high(flag) {
            match self.recording {
                Some(_) => self.step(done)?,
                None => {
                    self.hardware.run_until(flag, PROGRESS_CLOCKS)?;
                    self.progress(done)?;
                }
            }
        }
        Ok(())
    }

    /// Advances by a clock.
    fn step(&mut self, done: f64) -> Result<(), Error> {
        self.hardware.step()?;
        if let Some(recording) = &mut self.recording {
            recording.see(self.hardware);
        }
        self.progress(done)
    }

    /// Runs a phase and notes its clocks.
    fn phase<T>(&mut self, name: &'static str, body: impl FnOnce(&mut Self) -> Result<T, Error>) -> Result<T, Error> {
        self.current = name;
        let (clocks, time) = (self.hardware.clocks(), self.hardware.sim.time());
        self.next = clocks;
        self.progress(0.0)?;
        let result = body(self)?;
        self.watch.report(name, 1.0);
        let (clocks, picoseconds) = (self.hardware.clocks() - clocks, self.hardware.sim.time() - time);
        self.phases.push(Phase { name, clocks, picoseconds });
        Ok(result)
    }

    /// Reports the progress of the phase from time to time, and stops if the caller asks for it.
    fn progress(&mut self, done: f64) -> Result<(), Error> {
        let now = self.hardware.clocks();
        if now < self.next {
            return Ok(());
        }
        self.next = now + PROGRESS_CLOCKS;
        self.watch.go_on(self.current, done, self.hardware.sim.time())
    }
}

//! The host's program, which includes the geometry processor's last step. It sends the packets, swaps the banks and reads the picture.
//!
//! Source: MPG-ARCH, and the protocol of [`tilewright_rtl::quadtree::generator`].

use tilewright_scenes::{Polygon, Size};
use tilewright_sim::Port;

use super::hardware::Hardware;
use super::history::Recording;
use super::report::{Phase, Report};
use super::way::Following;
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
    /// What follows a pixel, if one is followed.
    pub following: Option<Box<Following>>,
    /// The current phase.
    current: &'static str,
    /// The clock of the next report of progress.
    next: u64,
}

impl<'a, 'w> Host<'a, 'w> {
    pub fn new(hardware: &'a mut Hardware, watch: &'a mut Watch<'w>) -> Host<'a, 'w> {
        Host { hardware, watch, phases: Vec::new(), recording: None, following: None, current: "", next: 0 }
    }

    /// Sends the packets, and waits until all pixels are drawn.
    pub fn draw(&mut self, packets: &[Polygon]) -> Result<(), Error> {
        self.phase(Report::DRAWING, |host| {
            let drawn = host.send(packets);
            let clock = host.hardware.clocks() + 1;
            if let Some(following) = &mut host.following {
                following.ends(&mut host.hardware.sim, clock);
            }
            drawn
        })
    }

    fn send(&mut self, packets: &[Polygon]) -> Result<(), Error> {
        let ready = self.hardware.sim.i.packets.ready;
        for (number, packet) in packets.iter().enumerate() {
            let done = number as f64 / packets.len() as f64;
            self.hardware.present(packet);
            self.wait_for(ready, done)?;
            self.step(done)?;
        }
        self.hardware.withdraw();
        self.wait_for(self.hardware.sim.o.idle, 1.0)
    }

    /// Swaps the banks and reads what was drawn, line by line from the upper left.
    pub fn read_out(&mut self, size: Size, background: [u8; 3]) -> Result<Vec<u64>, Error> {
        self.phase(Report::READ_OUT, |host| {
            if let Some(following) = &mut host.following {
                following.swaps();
            }
            host.hardware.swap()?;
            let clock = host.hardware.clocks();
            if let Some(following) = &mut host.following {
                following.reads(&mut host.hardware.sim, clock);
            }
            host.hardware.show(background)?;
            // Followed hardware may be wrong, and the picture is to be seen all the same.
            let most = host.following.as_ref().map(|_| host.hardware.clocks() + 8 * size.pixels() as u64 + 1000);
            let (pixels, width) = (size.pixels(), size.width() as usize);
            let showing = host.hardware.sim.o.showing;
            let mut words = Vec::with_capacity(pixels);
            // Groups of neighbouring pixels; the last group of a line may extend beyond its end.
            let mut line = 0;
            while host.hardware.is_high(showing) && most.is_none_or(|most| host.hardware.clocks() < most) {
                if let Some(mut group) = host.hardware.words() {
                    group.truncate(width - line);
                    if let Some(following) = &mut host.following {
                        let clock = host.hardware.clocks() + 1;
                        following.group(&mut host.hardware.sim, clock, words.len(), group.len());
                    }
                    line = (line + group.len()) % width;
                    words.append(&mut group);
                }
                host.step(words.len() as f64 / pixels as f64)?;
            }
            if let Some(following) = &mut host.following {
                following.read(host.hardware.clocks());
                words.resize(pixels, 0);
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
            match (&self.recording, &self.following) {
                (_, Some(following)) if following.is_stuck() => {
                    let (unit, clock) = ("the generator".to_owned(), self.hardware.clocks());
                    return Err(Error::Differs { unit, signal: "the end of drawing", clock, seen: 0, expected: 1 });
                }
                (Some(_), _) | (_, Some(_)) => self.step(done)?,
                (None, None) => {
                    self.hardware.run_until(flag, PROGRESS_CLOCKS)?;
                    self.progress(done)?;
                }
            }
        }
        Ok(())
    }

    /// Advances by a clock.
    fn step(&mut self, done: f64) -> Result<(), Error> {
        if let Some(following) = &mut self.following {
            let clock = self.hardware.clocks() + 1;
            following.look(&mut self.hardware.sim, clock);
        }
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

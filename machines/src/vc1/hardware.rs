//! The hardware of a VC-1 in simulation, as its programs see it: accesses at the ports of the local frame buffer units, the
//! controls of the swaps and the merge, and time.

use tilewright_rtl::clocks::{MERGE, PE};
use tilewright_rtl::vc1::{Vc1, Vc1In, Vc1Out};
use tilewright_scenes::frame::blank;
use tilewright_sim::Simulation;

use super::program::Access;
use crate::error::Error;

/// The running hardware.
pub(crate) struct Hardware {
    pub sim: Simulation<Vc1In, Vc1Out>,
    /// By processing element: what stands at its ports.
    at_port: Vec<Option<Access>>,
    /// T_m as the hardware is built for it.
    pub round_clocks: u64,
}

/// A moment: how often each clock has risen, and the simulated time in picoseconds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    pub pe_clocks: u64,
    pub merge_clocks: u64,
    pub time: u64,
}

impl Hardware {
    pub fn new(machine: &Vc1) -> Result<Hardware, Error> {
        let sim = Simulation::of(machine)?;
        Ok(Hardware {
            at_port: vec![None; sim.i.processors.len()],
            round_clocks: machine.gfb().sequencer().merge_clocks(),
            sim,
        })
    }

    /// Resets everything, and gives the colour of a pixel that nothing covers.
    pub fn reset(&mut self, background: [u8; 3]) -> Result<(), Error> {
        self.sim.set(self.sim.i.gfb.background, blank(background));
        Ok(self.sim.try_reset()?)
    }

    /// The number of processing elements.
    pub fn processors(&self) -> usize {
        self.at_port.len()
    }

    /// Puts an access at the ports of a processing element, or none, for the coming clocks.
    pub fn present(&mut self, processor: usize, access: Option<Access>) {
        let before = std::mem::replace(&mut self.at_port[processor], access);
        if before == access {
            return;
        }
        let port = self.sim.i.processors[processor];
        match access {
            Some(Access::Draw(pixel)) => {
                self.sim.set(port.request.x, pixel.x);
                self.sim.set(port.request.y, pixel.y);
                self.sim.set(port.request.word, pixel.word);
            }
            Some(Access::Clear(patch)) => self.sim.set(port.clear.patch, patch),
            None => {}
        }
        self.sim.set(port.request.valid, matches!(access, Some(Access::Draw(_))));
        self.sim.set(port.clear.valid, matches!(access, Some(Access::Clear(_))));
    }

    /// Whether the local frame buffer takes the access at its port at the coming edge.
    pub fn takes(&mut self, processor: usize) -> bool {
        let port = self.sim.i.processors[processor];
        match self.at_port[processor] {
            Some(Access::Draw(_)) => self.flag(port.request.ready),
            Some(Access::Clear(_)) => self.flag(port.clear.ready),
            None => false,
        }
    }

    /// Whether a pixel is held for want of a page.
    pub fn overflow(&mut self, processor: usize) -> bool {
        self.flag(self.sim.o.processors[processor].overflow)
    }

    /// Whether no pixel is under way in any local frame buffer.
    pub fn all_idle(&mut self) -> bool {
        (0..self.processors()).all(|k| self.flag(self.sim.o.processors[k].idle))
    }

    /// Pages taken in the front buffer.
    pub fn pages_used(&mut self, processor: usize) -> u32 {
        self.sim.get_u64(self.sim.o.processors[processor].pages_used) as u32
    }

    /// Exchanges the buffers of every local frame buffer; takes a clock.
    pub fn swap_local_buffers(&mut self) -> Result<(), Error> {
        let swaps: Vec<_> = self.sim.i.processors.iter().map(|port| port.swap).collect();
        swaps.iter().for_each(|&swap| self.sim.set(swap, true));
        self.tick(PE)?;
        swaps.iter().for_each(|&swap| self.sim.set(swap, false));
        Ok(())
    }

    /// Begins a merging round; takes a clock of the merger.
    pub fn start_merging(&mut self) -> Result<(), Error> {
        self.pulse(self.sim.i.gfb.start)
    }

    /// Exchanges the banks of the global frame buffer; takes a clock of the merger.
    pub fn swap_global_buffer(&mut self) -> Result<(), Error> {
        self.pulse(self.sim.i.gfb.swap)
    }

    fn pulse(&mut self, port: tilewright_sim::Port) -> Result<(), Error> {
        self.sim.set(port, true);
        self.tick(MERGE)?;
        self.sim.set(port, false);
        Ok(())
    }

    /// Whether a merging round runs.
    pub fn merging(&mut self) -> bool {
        self.flag(self.sim.o.gfb.busy)
    }

    /// Clocks of the merger in this round so far, or in the last one (VC1-TM).
    pub fn merge_clocks(&mut self) -> u64 {
        self.sim.get_u64(self.sim.o.gfb.clocks)
    }

    /// A word of the displayed bank; takes a clock of the merger.
    pub fn read_displayed(&mut self, address: u64) -> Result<u64, Error> {
        self.sim.set(self.sim.i.gfb.read_address, address);
        self.tick(MERGE)?;
        Ok(self.sim.get_u64(self.sim.o.gfb.read_word))
    }

    /// Goes through the next edge of a clock, and through those of the other before it.
    pub fn tick(&mut self, clock: impl AsRef<str>) -> Result<(), Error> {
        let clock = clock.as_ref();
        let end = self.cycles(clock) + 1;
        while self.cycles(clock) < end {
            self.sim.try_step()?;
        }
        Ok(())
    }

    pub fn now(&self) -> Moment {
        Moment { pe_clocks: self.cycles(PE), merge_clocks: self.cycles(MERGE), time: self.sim.time() }
    }

    fn cycles(&self, clock: impl AsRef<str>) -> u64 {
        self.sim.cycles(clock).expect("the VC-1 has both clocks")
    }

    fn flag(&mut self, port: tilewright_sim::Port) -> bool {
        self.sim.get_u64(port) != 0
    }
}

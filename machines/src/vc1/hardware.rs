//! The hardware of a VC-1 in simulation, as its programs see it: accesses at the ports of the local frame buffer units, what
//! the swap control wants and says, and time.

use tilewright_rtl::clocks::{MERGE, PE};
use tilewright_rtl::swap::SwapState;
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
    /// By processing element: whether it says that its frame is drawn.
    done: Vec<bool>,
    /// T_m in clocks of the merger (VC1-TM).
    pub merge_clocks: u64,
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
            done: vec![false; sim.i.processors.len()],
            merge_clocks: machine.gfb().sequencer().merge_clocks(),
            sim,
        })
    }

    /// Resets everything, and gives the colour of a pixel that nothing covers.
    pub fn reset(&mut self, background: [u8; 3]) -> Result<(), Error> {
        self.sim.set(self.sim.i.host.background, blank(background));
        self.sim.set(self.sim.i.ready, true);
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

    /// What a processing element may do.
    pub fn state(&mut self, processor: usize) -> SwapState {
        SwapState::of_code(self.sim.get_u64(self.sim.o.processors[processor].state))
    }

    /// Says to the swap control whether a processing element has drawn its frame.
    pub fn set_done(&mut self, processor: usize, done: bool) {
        if std::mem::replace(&mut self.done[processor], done) != done {
            self.sim.set(self.sim.i.processors[processor].done, done);
        }
    }

    /// Pages taken in the front buffer.
    pub fn pages_used(&mut self, processor: usize) -> u32 {
        self.sim.get_u64(self.sim.o.processors[processor].pages_used) as u32
    }

    /// Whether the global frame buffer shows the frame that was drawn.
    pub fn shown(&mut self) -> bool {
        self.flag(self.sim.o.shown)
    }

    /// A word of the displayed bank; takes a clock of the merger.
    pub fn read_displayed(&mut self, address: u64) -> Result<u64, Error> {
        self.sim.set(self.sim.i.host.read_address, address);
        self.tick(MERGE)?;
        Ok(self.sim.get_u64(self.sim.o.view.read_word))
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

//! A renderer in simulation, and the frame buffer that takes what it sends.

use std::sync::atomic::AtomicBool;

use tilewright_rtl::pixel_planes::backing_store::BitPlane;
use tilewright_rtl::pixel_planes::frame_buffer::{FrameBuffer, FrameBufferIn, FrameBufferOut};
use tilewright_rtl::pixel_planes::instruction::Instruction;
use tilewright_rtl::pixel_planes::renderer::{Renderer, RendererIn, RendererOut};
use tilewright_rtl::pixel_planes::{PERIOD, fields};
use tilewright_sim::{EngineKind, Simulation};

use crate::error::Error;
use crate::run::Watch;

/// After so many instructions it is looked whether to go on.
const LOOK: u64 = 512;

/// A line of a region, a bit of all its pixels at a time.
pub(super) struct Plane {
    pub region: u64,
    pub line: u64,
    pub plane: u64,
    pub bits: Vec<u64>,
}

/// A running renderer.
pub(super) struct Running {
    pub sim: Simulation<RendererIn, RendererOut>,
    /// Lines of regions that it has sent, and that the frame buffer has not got yet.
    sent: Vec<Plane>,
    /// Clocks since its reset.
    pub clock: u64,
    /// Regions that it was given.
    given: usize,
    /// Planes that it has sent.
    planes: usize,
}

impl Running {
    pub fn new(renderer: &Renderer, engine: EngineKind, side_by_side: bool) -> Result<Running, Error> {
        let mut sim = Simulation::at(renderer, PERIOD)?.on(engine);
        sim.set(sim.i.instructions.valid, false);
        sim.set(sim.i.side_by_side, side_by_side);
        sim.set(sim.o.planes.ready, true);
        sim.try_reset()?;
        Ok(Running { sim, sent: Vec::new(), clock: 0, given: 0, planes: 0 })
    }

    /// Draws a region from a clock on, which has not been yet; gives the clock in which it can be given another one.
    pub fn draw(
        &mut self,
        begun: u64,
        instructions: &[Instruction<u64>],
        cancel: Option<&AtomicBool>,
    ) -> Result<u64, Error> {
        let mut watch = Watch { progress: None, cancel };
        while self.clock < begun {
            self.step()?;
        }
        for (instruction, number) in instructions.iter().zip(1_u64..) {
            self.give(instruction)?;
            if number.is_multiple_of(LOOK) {
                watch.go_on("drawing", 0.0, self.sim.time())?;
            }
        }
        while !self.is_idle() {
            self.step()?;
        }
        self.given += 1;
        Ok(self.clock)
    }

    /// Goes through clocks until the renderer has taken an instruction.
    fn give(&mut self, instruction: &Instruction<u64>) -> Result<(), Error> {
        let port = self.sim.i.instructions.payload;
        self.sim.set(port.operation, instruction.operation);
        self.sim.set(port.skip, instruction.skip);
        self.sim.set(port.length, instruction.length);
        self.sim.set(port.read, instruction.read);
        self.sim.set(port.write, instruction.write);
        self.sim.set(port.coefficients.a, instruction.coefficients.a);
        self.sim.set(port.coefficients.b, instruction.coefficients.b);
        self.sim.set(port.coefficients.c, instruction.coefficients.c);
        self.sim.set(self.sim.i.instructions.valid, true);
        let mut is_taken = false;
        while !is_taken {
            is_taken = self.sim.get_u64(self.sim.i.instructions.ready) != 0;
            self.step()?;
        }
        self.sim.set(self.sim.i.instructions.valid, false);
        Ok(())
    }

    /// Whether it can be given another region.
    fn is_idle(&mut self) -> bool {
        self.sim.get_u64(self.sim.o.idle) != 0
    }

    /// Goes through a clock, and takes what is sent in it.
    fn step(&mut self) -> Result<(), Error> {
        let BitPlane { region, line, plane, bits } = self.sim.o.planes.payload;
        if self.sim.get_u64(self.sim.o.planes.valid) != 0 {
            let [region, line, plane] = [region, line, plane].map(|port| self.sim.get_u64(port));
            self.planes += 1;
            self.sent.push(Plane { region, line, plane, bits: self.sim.lanes(bits) });
        }
        self.sim.try_step()?;
        self.clock += 1;
        Ok(())
    }

    /// Goes through clocks until it has sent all regions, of so many planes each.
    pub fn send_all(&mut self, planes: usize) -> Result<(), Error> {
        while self.planes < self.given * planes {
            self.step()?;
        }
        Ok(())
    }

    /// The planes of lines that it has sent as a whole, each once.
    pub fn whole_lines(&mut self) -> impl Iterator<Item = Plane> {
        let whole = self.sent.len() - self.sent.len() % fields::WORD.bits as usize;
        self.sent.drain(..whole)
    }
}

/// The running frame buffer.
pub(super) struct Frames {
    sim: Simulation<FrameBufferIn, FrameBufferOut>,
}

impl Frames {
    pub fn new(frame_buffer: &FrameBuffer, engine: EngineKind) -> Result<Frames, Error> {
        let mut sim = Simulation::at(frame_buffer, PERIOD)?.on(engine);
        sim.set(sim.i.planes.valid, false);
        sim.set(sim.i.read.enable, false);
        sim.try_reset()?;
        Ok(Frames { sim })
    }

    /// Puts a line's planes to their place; takes a clock each.
    pub fn put(&mut self, plane: Plane) -> Result<(), Error> {
        let port = self.sim.i.planes.payload;
        self.sim.set(port.region, plane.region);
        self.sim.set(port.line, plane.line);
        self.sim.set(port.plane, plane.plane);
        self.sim.set_lanes(port.bits, plane.bits);
        self.sim.set(self.sim.i.planes.valid, true);
        self.sim.try_step()?;
        self.sim.set(self.sim.i.planes.valid, false);
        Ok(())
    }

    /// The words of a line of a region; takes two clocks.
    pub fn line(&mut self, region: usize, line: u32) -> Result<Vec<u64>, Error> {
        self.sim.set(self.sim.i.read.enable, true);
        self.sim.set(self.sim.i.read.region, region as u64);
        self.sim.set(self.sim.i.read.line, line);
        self.sim.try_step()?;
        Ok(self.sim.lanes(self.sim.o.words))
    }
}

/// The planes that a region is sent in.
pub(super) fn planes_of(side: u32) -> usize {
    (side * fields::WORD.bits) as usize
}

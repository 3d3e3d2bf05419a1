//! A simulated renderer, which follows the clocks of the model, and the frame buffer that takes the renderers' planes.

use tilewright_rtl::pixel_planes::backing_store::BitPlane;
use tilewright_rtl::pixel_planes::frame_buffer::{FrameBuffer, FrameBufferIn, FrameBufferOut};
use tilewright_rtl::pixel_planes::instruction::Instruction;
use tilewright_rtl::pixel_planes::renderer::{Renderer, RendererIn, RendererOut};
use tilewright_rtl::pixel_planes::{PERIOD, fields};
use tilewright_sim::{EngineKind, IntoValue, Simulation};

use super::following::{self, Observer, Pictured};
use super::model::RendererTiming;
use crate::error::Error;
use crate::tracer::Tracer;

/// A renderer in simulation, and the model's clocks for it.
pub(super) struct Course<'a> {
    /// Its number.
    pub number: usize,
    pub timing: &'a RendererTiming,
    /// The numbers of its regions in their sequence, and their instructions.
    pub regions: Vec<(usize, &'a [Instruction<u64>])>,
}

/// The progress of a renderer before a clock.
#[derive(Clone, Copy, Default)]
struct Done {
    clock: u64,
    /// Instructions that have arrived, and those that the controller has taken.
    arrived: usize,
    taken: usize,
    /// Planes that were sent.
    planes: usize,
    /// The clock after the last bit of all instructions that were taken.
    ended: u64,
}

impl Course<'_> {
    /// Runs a renderer in the clocks of the model. Returns the bits of the planes that it sends, one after another. From time to time `go_on` gets
    /// the number of handshakes and the clock.
    ///
    /// Clocks in which the renderer is idle are skipped, because nothing in it changes.
    ///
    /// # Errors
    /// [`Error::Differs`]: a handshake is in another clock; [`Error::Simulation`]; an error of `go_on`.
    pub fn run(
        &self,
        renderer: &Renderer,
        (engine, side_by_side): (EngineKind, bool),
        tracer: Option<&Tracer>,
        go_on: &dyn Fn(usize, u64) -> Result<(), Error>,
        mut observer: Option<&mut Observer>,
    ) -> Result<Vec<impl IntoValue + Send + use<>>, Error> {
        const LOOK: usize = 512;
        let mut sim = Simulation::at(renderer, PERIOD)?.on(engine);
        sim.set(sim.i.instructions.valid, false);
        sim.set(sim.i.side_by_side, side_by_side);
        sim.set(sim.o.planes.ready, false);
        sim.try_reset()?;
        if let Some(tracer) = tracer {
            tracer.attach(&following::renderer(self.number), (renderer, PERIOD), &mut sim)?;
        }

        let instructions: Vec<&Instruction<u64>> = self.regions.iter().flat_map(|(_, program)| *program).collect();
        let (mut done, mut looked, mut sent) = (Done::default(), 0, Vec::with_capacity(self.timing.planes.len()));
        while let Some(event) = self.next_event(&done) {
            if done.clock >= done.ended + Renderer::REST {
                done.clock = event;
            }
            let clock = done.clock;
            let mut is_right = self.compare(&mut sim, renderer, &done);
            let is_now = |clocks: &[u64], number: usize| clocks.get(number) == Some(&clock);
            let arrives = is_now(&self.timing.arrived, done.arrived);
            if arrives {
                show(&mut sim, instructions[done.arrived]);
            }
            sim.set(sim.i.instructions.valid, arrives);
            let goes = is_now(&self.timing.planes, done.planes);
            if goes {
                is_right = is_right.and_then(|()| self.compare_plane(&mut sim, renderer, &done));
                sent.push(sim.get(sim.o.planes.payload.bits));
            }
            sim.set(sim.o.planes.ready, goes);
            if let Some(observer) = &mut observer {
                observer.look(&mut sim, clock);
            }
            is_right = is_right.and_then(|()| Ok(sim.try_step()?));
            if let (Err(error), Some(observer)) = (&is_right, &mut observer) {
                observer.fail(clock, error);
            }
            is_right?;

            if is_now(&self.timing.taken, done.taken) {
                done.ended = done.ended.max(self.timing.ended[done.taken] + 1);
                done.taken += 1;
            }
            done.arrived += usize::from(arrives);
            done.planes += usize::from(goes);
            done.clock += 1;
            let handshakes = done.arrived + done.planes;
            if handshakes >= looked + LOOK {
                go_on(handshakes - looked, clock)?;
                looked = handshakes;
            }
        }
        Ok(sent)
    }

    /// The clock of the next handshake; none after the last plane.
    fn next_event(&self, done: &Done) -> Option<u64> {
        let RendererTiming { arrived, taken, planes, .. } = self.timing;
        let next = [arrived.get(done.arrived), taken.get(done.taken), planes.get(done.planes)];
        next.into_iter().flatten().min().copied()
    }

    /// Compares all outputs of the renderer with the model.
    fn compare(
        &self,
        sim: &mut Simulation<RendererIn, RendererOut>,
        renderer: &Renderer,
        done: &Done,
    ) -> Result<(), Error> {
        let RendererTiming { taken, shown, planes, .. } = self.timing;
        let waiting = done.arrived - done.taken;
        let of_region = planes_of(renderer.side);
        let first_clock = match (done.planes == planes.len(), done.planes.is_multiple_of(of_region)) {
            (true, _) => u64::MAX,
            (_, true) => shown[done.planes / of_region],
            _ => planes[done.planes - 1] + 1,
        };
        let takes = taken.get(done.taken) == Some(&done.clock);
        for (signal, port, expected) in [
            ("the queue's handshake", sim.o.takes, takes),
            ("the queue's room", sim.o.room, waiting < renderer.queue as usize),
            ("idleness", sim.o.idle, waiting == 0 && done.clock >= done.ended),
            ("the validity of planes", sim.o.planes.valid, done.clock >= first_clock),
        ] {
            self.same(signal, done.clock, sim.get_u64(port), expected.into())?;
        }
        Ok(())
    }

    /// Compares the region, line and number of a plane with the regions that were drawn.
    fn compare_plane(
        &self,
        sim: &mut Simulation<RendererIn, RendererOut>,
        renderer: &Renderer,
        done: &Done,
    ) -> Result<(), Error> {
        let BitPlane { region, line, plane, .. } = sim.o.planes.payload;
        let (side, word) = (renderer.side as usize, fields::WORD.bits as usize);
        let (number, _) = self.regions[done.planes / planes_of(renderer.side)];
        for (signal, port, expected) in [
            ("a plane's region", region, number),
            ("a plane's line", line, done.planes / word % side),
            ("a plane's number", plane, done.planes % word),
        ] {
            self.same(signal, done.clock, sim.get_u64(port), expected as u64)?;
        }
        Ok(())
    }

    fn same(&self, signal: &'static str, clock: u64, seen: u64, expected: u64) -> Result<(), Error> {
        if seen == expected {
            return Ok(());
        }
        Err(Error::Differs { unit: format!("renderer {}", self.number), signal, clock, seen, expected })
    }
}

/// Puts an instruction at a renderer's port.
pub(super) fn show(sim: &mut Simulation<RendererIn, RendererOut>, instruction: &Instruction<u64>) {
    let port = sim.i.instructions.payload;
    sim.set(port.operation, instruction.operation);
    sim.set(port.skip, instruction.skip);
    sim.set(port.length, instruction.length);
    sim.set(port.read, instruction.read);
    sim.set(port.write, instruction.write);
    sim.set(port.coefficients.a, instruction.coefficients.a);
    sim.set(port.coefficients.b, instruction.coefficients.b);
    sim.set(port.coefficients.c, instruction.coefficients.c);
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

    /// Begins a waveform of it, if it is traced.
    pub fn trace(&mut self, tracer: &Tracer, frame_buffer: &FrameBuffer) -> Result<(), Error> {
        tracer.attach(following::FRAME_BUFFER, (frame_buffer, PERIOD), &mut self.sim)
    }

    /// Writes the planes of a line to their place; each takes a clock. A followed pixel is looked at, with the clock of the last plane.
    pub fn put(
        &mut self,
        (region, line): (usize, usize),
        planes: impl Iterator<Item = impl IntoValue>,
        pictured: Option<(&mut Pictured, u64)>,
    ) -> Result<(), Error> {
        let mut word = 0;
        let followed = pictured.as_ref().map(|(pictured, _)| &**pictured).filter(|it| it.is_here(region, line));
        let port = self.sim.i.planes.payload;
        self.sim.set(port.region, region as u64);
        self.sim.set(port.line, line as u64);
        self.sim.set(self.sim.i.planes.valid, true);
        for (plane, bits) in planes.enumerate() {
            self.sim.set(port.plane, plane as u64);
            self.sim.set(port.bits, bits);
            if let Some(pictured) = followed {
                word |= pictured.bit(&mut self.sim) << plane;
            }
            self.sim.try_step()?;
        }
        self.sim.set(self.sim.i.planes.valid, false);
        let is_followed = followed.is_some();
        if let Some((pictured, clock)) = pictured {
            let came = is_followed.then_some(word);
            pictured.look(&self.sim, clock, came);
        }
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

#[cfg(test)]
mod tests;

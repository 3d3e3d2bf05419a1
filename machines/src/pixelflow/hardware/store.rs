//! The simulated frame buffer, beside the array whose registers it reads.

use tilewright_rtl::pixelflow::ARRAY;
use tilewright_rtl::pixelflow::frame_buffer::{FrameBuffer, FrameBufferIn, FrameBufferOut};
use tilewright_rtl::pixelflow::registers::PortAccess;
use tilewright_sim::{Bundle, EngineKind, Port, Simulation};

use super::observed::Observed;
use crate::error::Error;
use crate::pixelflow::following::{Observer, StoreObserver};
use crate::pixelflow::works::Works;
use crate::tracer::Tracer;

/// A frame buffer.
pub(in crate::pixelflow) struct FrameStore {
    block: FrameBuffer,
    pub unit: Observed<FrameBufferIn, FrameBufferOut, StoreObserver>,
    pixels: usize,
}

impl FrameStore {
    /// An empty frame buffer.
    ///
    /// # Errors
    /// [`Error::Parameter`]: as [`Works::frame_buffer`]; [`Error::Simulation`].
    pub fn new(works: &Works, engine: EngineKind) -> Result<FrameStore, Error> {
        let block = works.frame_buffer()?;
        let mut sim = Simulation::at(&block, ARRAY.period)?.on(engine);
        sim.set(sim.i.start, false);
        sim.set(sim.o.pixels.ready, false);
        sim.try_reset()?;
        Ok(FrameStore { block, unit: Observed::new(sim), pixels: works.size().pixels() })
    }

    /// Begins a waveform of it, if the unit of that name is traced.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn trace(&mut self, tracer: &Tracer, name: &str) -> Result<(), Error> {
        tracer.attach(name, (&self.block, ARRAY.period), &mut self.unit.sim)
    }

    /// Simulates a clock, before that of the array whose registers it reads. Returns whether it has finished.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn clock<I: Bundle, O: Bundle>(
        &mut self,
        array: &mut Simulation<I, O>,
        registers: PortAccess<Port>,
        seen: Port,
        starts: bool,
    ) -> Result<bool, Error> {
        if !starts && !self.unit.is_busy {
            return Ok(false);
        }
        let buffer = &mut self.unit.sim;
        array.set(registers.pixel, buffer.get_u64(buffer.o.port.pixel));
        array.set(registers.address, buffer.get_u64(buffer.o.port.address));
        buffer.set(buffer.i.start, starts);
        buffer.set(buffer.i.seen, array.limbs(seen));
        let is_done = buffer.get_u64(buffer.o.done) == 1;
        self.unit.clock(is_done)?;
        Ok(is_done)
    }

    /// Whether it ends with the next clock.
    pub fn is_ending(&mut self) -> bool {
        self.unit.is_busy && self.unit.sim.get_u64(self.unit.sim.o.done) == 1
    }

    /// The displayed frame, line by line, once it has all regions.
    ///
    /// # Errors
    /// [`Error::Simulation`]; [`Error::Differs`]: there are fewer pixels.
    pub fn scan(&mut self) -> Result<Vec<[u8; 3]>, Error> {
        let (unit, mut shown) = (&mut self.unit, Vec::with_capacity(self.pixels));
        let sim = &mut unit.sim;
        sim.set(sim.i.start, false);
        sim.set(sim.o.pixels.ready, true);
        // The two frames swap, and the first pixel is read.
        for _ in 0..self.pixels + 4 {
            let sim = &mut unit.sim;
            let pixels = sim.o.pixels;
            if sim.get_u64(pixels.valid) == 1 && shown.len() < self.pixels {
                let colour = [pixels.payload.red, pixels.payload.green, pixels.payload.blue];
                let colour = colour.map(|port| sim.get_u64(port) as u8);
                if let Some(observer) = &mut unit.observer {
                    observer.told().at(sim.time() + ARRAY.period.picoseconds());
                    observer.shows(shown.len(), colour);
                }
                shown.push(colour);
            }
            unit.step()?;
        }
        if let Some(observer) = &mut unit.observer {
            observer.ends(shown.len());
        }
        if shown.len() == self.pixels {
            return Ok(shown);
        }
        let (unit, signal) = ("the frame buffer".to_owned(), "the number of pixels in a scan");
        let clock = self.pixels as u64 + 4;
        Err(Error::Differs { unit, signal, clock, seen: shown.len() as u64, expected: self.pixels as u64 })
    }
}

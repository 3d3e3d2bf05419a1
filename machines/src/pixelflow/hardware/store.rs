//! The simulated frame buffer, beside the array whose registers it reads.

use tilewright_rtl::pixelflow::ARRAY;
use tilewright_rtl::pixelflow::frame_buffer::{FrameBufferIn, FrameBufferOut};
use tilewright_rtl::pixelflow::registers::PortAccess;
use tilewright_sim::{Bundle, EngineKind, Port, Simulation};

use crate::error::Error;
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::following::StoreObserver;
use crate::pixelflow::works::Works;
use crate::trail::Trail;

/// A frame buffer.
pub(in crate::pixelflow) struct FrameStore {
    sim: Simulation<FrameBufferIn, FrameBufferOut>,
    is_busy: bool,
    /// The observer of a pixel that is followed.
    observer: Option<Box<StoreObserver>>,
    pixels: usize,
}

impl FrameStore {
    /// An empty frame buffer.
    ///
    /// # Errors
    /// [`Error::Parameter`]: as [`Works::frame_buffer`]; [`Error::Simulation`].
    pub fn new(works: &Works, engine: EngineKind) -> Result<FrameStore, Error> {
        let mut sim = Simulation::at(&works.frame_buffer()?, ARRAY.period)?.on(engine);
        sim.set(sim.i.start, false);
        sim.set(sim.o.pixels.ready, false);
        sim.try_reset()?;
        Ok(FrameStore { sim, is_busy: false, observer: None, pixels: works.size().pixels() })
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
        if !starts && !self.is_busy {
            return Ok(false);
        }
        let buffer = &mut self.sim;
        array.set(registers.pixel, buffer.get_u64(buffer.o.port.pixel));
        array.set(registers.address, buffer.get_u64(buffer.o.port.address));
        buffer.set(buffer.i.start, starts);
        buffer.set(buffer.i.seen, array.limbs(seen));
        let is_done = buffer.get_u64(buffer.o.done) == 1;
        if let Some(observer) = &mut self.observer {
            observer.look(buffer);
        }
        let stepped = buffer.try_step().map_err(Error::from);
        if let (Err(error), Some(observer)) = (&stepped, &mut self.observer) {
            observer.fail(error);
        }
        stepped?;
        self.is_busy = !is_done;
        Ok(is_done)
    }

    /// Follows a pixel.
    pub fn follow(&mut self, observer: StoreObserver) {
        self.observer = Some(Box::new(observer));
    }

    /// Tells the observer the tick.
    pub fn now(&mut self, tick: Ticks) {
        if let Some(observer) = &mut self.observer {
            observer.tick = tick;
        }
    }

    /// The steps of the pixel.
    pub fn trail(&self) -> Option<&Trail> {
        self.observer.as_ref().map(|observer| &observer.trail)
    }

    /// Whether it works.
    pub fn is_busy(&self) -> bool {
        self.is_busy
    }

    /// Whether it ends with the next clock.
    pub fn is_ending(&mut self) -> bool {
        self.is_busy && self.sim.get_u64(self.sim.o.done) == 1
    }

    /// The displayed frame, line by line, once it has all regions.
    ///
    /// # Errors
    /// [`Error::Simulation`]; [`Error::Differs`]: there are fewer pixels.
    pub fn scan(&mut self) -> Result<Vec<[u8; 3]>, Error> {
        let (sim, mut shown) = (&mut self.sim, Vec::with_capacity(self.pixels));
        sim.set(sim.i.start, false);
        sim.set(sim.o.pixels.ready, true);
        // The two frames swap, and the first pixel is read.
        for _ in 0..self.pixels + 4 {
            let pixels = sim.o.pixels;
            if sim.get_u64(pixels.valid) == 1 && shown.len() < self.pixels {
                let colour = [pixels.payload.red, pixels.payload.green, pixels.payload.blue];
                let colour = colour.map(|port| sim.get_u64(port) as u8);
                if let Some(observer) = &mut self.observer {
                    observer.shows(shown.len(), colour);
                }
                shown.push(colour);
            }
            let stepped = sim.try_step().map_err(Error::from);
            if let (Err(error), Some(observer)) = (&stepped, &mut self.observer) {
                observer.fail(error);
            }
            stepped?;
        }
        if let Some(observer) = &mut self.observer {
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

//! The unit at a node's texture port.

use super::node::ArraySimulation;
use super::store::FrameStore;
use super::texture::TextureLookUp;
use crate::error::Error;
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::following::{FRAME_BUFFER, texture_unit_of};
use crate::tracer::Tracer;
use crate::way::Step;

/// The unit at a texture port.
pub(in crate::pixelflow) enum Beside {
    /// Nothing.
    Nobody,
    /// The texture unit.
    Texture(TextureLookUp),
    /// The frame buffer.
    Store(FrameStore),
}

impl Beside {
    /// Whether it works.
    pub fn is_busy(&self) -> bool {
        match self {
            Beside::Nobody => false,
            Beside::Texture(texture) => texture.unit.is_busy,
            Beside::Store(store) => store.unit.is_busy,
        }
    }

    /// Whether it writes registers.
    pub fn is_writing(&self) -> bool {
        matches!(self, Beside::Texture(_)) && self.is_busy()
    }

    /// Whether it ends in this clock, if it only reads.
    pub fn is_ending(&mut self) -> bool {
        match self {
            Beside::Store(store) => store.is_ending(),
            _ => false,
        }
    }

    /// Begins a waveform of it, if that is what is traced.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn trace(&mut self, tracer: &Tracer, of: &str) -> Result<(), Error> {
        match self {
            Beside::Nobody => Ok(()),
            Beside::Texture(texture) => texture.trace(tracer, &texture_unit_of(of)),
            Beside::Store(store) => store.trace(tracer, FRAME_BUFFER),
        }
    }

    /// Tells the observer of a pixel the tick.
    pub fn now(&mut self, tick: Ticks) {
        match self {
            Beside::Nobody => {}
            Beside::Texture(texture) => texture.unit.now(tick),
            Beside::Store(store) => store.unit.now(tick),
        }
    }

    /// Takes the steps of a pixel that is followed.
    pub fn take_steps(&mut self) -> Vec<Step> {
        match self {
            Beside::Nobody => Vec::new(),
            Beside::Texture(texture) => texture.unit.take_steps(),
            Beside::Store(store) => store.unit.take_steps(),
        }
    }

    /// Simulates a clock, before that of the array. The array is told when the unit has finished.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn clock(&mut self, array: &mut ArraySimulation) -> Result<(), Error> {
        let starts = array.get_u64(array.o.given.texture) == 1;
        let (registers, seen) = (array.i.texture, array.o.texture_seen);
        let is_done = match self {
            Beside::Nobody => return Ok(()),
            Beside::Texture(texture) => texture.clock(array, registers, seen, starts)?,
            Beside::Store(store) => store.clock(array, registers, seen, starts)?,
        };
        array.set(array.i.texture_done, is_done);
        Ok(())
    }
}

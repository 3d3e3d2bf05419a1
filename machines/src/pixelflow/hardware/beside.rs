//! The unit at a node's texture port.

use super::node::ArraySimulation;
use super::store::FrameStore;
use super::texture::TextureLookUp;
use crate::error::Error;

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
            Beside::Texture(texture) => texture.is_busy(),
            Beside::Store(store) => store.is_busy(),
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

//! A node with a pixel that is followed.

use tilewright_hdl::DEFAULT_PERIOD;
use tilewright_rtl::pixelflow::array::PixelArray;

use super::{Beside, Node, Ticks};
use crate::error::Error;
use crate::pixelflow::following::{ArrayObserver, Found, StoreObserver, TextureObserver};
use crate::tracer::Tracer;

impl Node {
    /// Follows a pixel. At the limit the node stops.
    pub fn follow(&mut self, observer: ArrayObserver, limit: Ticks) {
        (self.observer, self.limit) = (Some(Box::new(observer)), limit);
    }

    /// Has the frame buffer follow the pixel.
    pub fn follow_store(&mut self, observer: StoreObserver) {
        if let Beside::Store(store) = &mut self.beside {
            store.unit.follow(observer);
        }
    }

    /// Has the texture unit follow the pixel.
    pub fn follow_textures(&mut self, observer: TextureObserver) {
        if let Beside::Texture(texture) = &mut self.beside {
            texture.unit.follow(observer);
        }
    }

    /// Begins a waveform of its array or of the unit beside it, if one of them is traced.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn trace(&mut self, tracer: &Tracer, array: &PixelArray) -> Result<(), Error> {
        tracer.attach(&self.name, (array, DEFAULT_PERIOD), &mut self.sim)?;
        self.beside.trace(tracer, &self.name)
    }

    /// Tells the instructions of the next program, each with the primitive that it is of.
    pub fn tell(&mut self, primitives: Vec<Option<usize>>) {
        if let Some(observer) = &mut self.observer {
            observer.tells(observer.taken(), primitives);
        }
    }

    /// Takes what was found of the pixel.
    pub fn take_found(&mut self, found: &mut Found) {
        if let Some(mut observer) = self.observer.take() {
            found.steps.extend(observer.told.take());
            found.drawn.extend(observer.drawn);
        }
        found.steps.extend(self.beside.take_steps());
    }
}

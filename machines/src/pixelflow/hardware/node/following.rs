//! A node with a pixel that is followed.

use super::{Beside, Node, Ticks};
use crate::pixelflow::following::{ArrayObserver, Found, StoreObserver, TextureObserver};

impl Node {
    /// Follows a pixel. At the limit the node stops.
    pub fn follow(&mut self, observer: ArrayObserver, limit: Ticks) {
        (self.observer, self.limit) = (Some(Box::new(observer)), limit);
    }

    /// Has the frame buffer follow the pixel.
    pub fn follow_store(&mut self, observer: StoreObserver) {
        if let Beside::Store(store) = &mut self.beside {
            store.follow(observer);
        }
    }

    /// Has the texture unit follow the pixel.
    pub fn follow_textures(&mut self, observer: TextureObserver) {
        if let Beside::Texture(texture) = &mut self.beside {
            texture.follow(observer);
        }
    }

    /// Tells the instructions of the next program, each with the primitive that it is of.
    pub fn tell(&mut self, primitives: Vec<Option<usize>>) {
        if let Some(observer) = &mut self.observer {
            observer.tells(observer.taken(), primitives);
        }
    }

    /// Takes what was found of the pixel.
    pub fn take_found(&mut self, found: &mut Found) {
        if let Some(observer) = self.observer.take() {
            found.steps.extend(observer.trail.take());
            found.drawn.extend(observer.drawn);
        }
        found.steps.extend(self.beside.trail().map(|trail| trail.take()).unwrap_or_default());
    }
}

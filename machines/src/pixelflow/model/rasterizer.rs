//! A rasterizer and its front end, primitive by primitive.

use crate::pixelflow::costs::Ticks;
use crate::pixelflow::workload::Binned;

/// A rasterizer.
pub(super) struct Rasterizer {
    /// The primitives of each region.
    bins: Vec<Vec<Binned>>,
    /// The front end's time for a primitive, when it is first needed.
    generates: Ticks,
    /// The time at which the front end has finished its work so far.
    made: Ticks,
    /// The time at which the array has finished its work so far.
    time: Ticks,
    generated: Ticks,
    drawn: Ticks,
}

impl Rasterizer {
    /// A rasterizer whose front end begins to make instructions at that time, if it makes them during rasterization.
    pub fn new(bins: Vec<Vec<Binned>>, generates: Ticks, time: Ticks) -> Rasterizer {
        Rasterizer { bins, generates, made: time, time, generated: 0, drawn: 0 }
    }

    pub fn time(&self) -> Ticks {
        self.time
    }

    pub fn generated(&self) -> Ticks {
        self.generated
    }

    pub fn drawn(&self) -> Ticks {
        self.drawn
    }

    /// Draws a region, once there is a bank for it. Returns the end of drawing.
    pub fn draw(&mut self, region: u16, free: Ticks) -> Ticks {
        self.time = self.time.max(free);
        for primitive in &mut self.bins[usize::from(region)] {
            // Instructions are stored for other samples and other regions.
            if std::mem::take(&mut primitive.is_first) {
                self.made += self.generates;
                self.generated += self.generates;
            }
            self.time = self.time.max(self.made) + primitive.draws;
            self.drawn += primitive.draws;
        }
        self.time
    }
}

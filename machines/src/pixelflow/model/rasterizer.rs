//! A rasterizer and its front end, primitive by primitive.

use crate::pixelflow::costs::Ticks;
use crate::pixelflow::workload::Binned;

/// A rasterizer.
pub(super) struct Rasterizer {
    /// What is in each region.
    bins: Vec<Vec<Binned>>,
    /// The front end's work on a primitive, when it is needed first.
    generates: Ticks,
    /// The front end has done what it did so far.
    made: Ticks,
    /// The array has drawn what it drew so far.
    time: Ticks,
    generated: Ticks,
    drawn: Ticks,
}

impl Rasterizer {
    /// One whose front end goes on to make instructions at that time, where it does.
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

    /// Draws a region, once there is a bank for it; gives the end of that.
    pub fn draw(&mut self, region: u16, free: Ticks) -> Ticks {
        self.time = self.time.max(free);
        for primitive in &mut self.bins[usize::from(region)] {
            // Instructions are kept, for other samples and other regions.
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

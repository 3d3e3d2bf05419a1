//! The latency of a frame, from its beginning to the picture: the paper's formulas.
//!
//! Source: PFL-LAT1 to PFL-600K. All formulas assume perfect balance: the rasterizers have equal numbers of primitives.

use serde::Serialize;

use super::costs::Costs;

mod stereo;

/// The software of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum System {
    /// Primitives are sorted into bins of regions, and a frame is drawn while the next one is transformed (PFL-LAT1).
    Base,
    /// A first pass over all primitives sorts them; the second makes their instructions region by region, while others are drawn
    /// (PFL-PRE).
    PreSort,
    /// All regions are in the pixels' memory at once, so nothing is sorted. There are no textures, and the front end lights vertices
    /// (PFL-NT).
    NonTexturing,
}

/// The roles of a machine's nodes, except the one with the frame buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Nodes {
    /// Nodes that rasterize.
    pub rasterizers: u32,
    /// Nodes that shade.
    pub shaders: u32,
}

impl Nodes {
    /// The paper's machine of 20 nodes, with that number of shaders (PFL-CFG).
    ///
    /// ```
    /// use tilewright_machines::pixelflow::Nodes;
    ///
    /// assert_eq!(Nodes::paper(4).rasterizers, 15);
    /// ```
    ///
    /// # Panics
    /// No rasterizer is left.
    pub fn paper(shaders: u32) -> Nodes {
        assert!(shaders < 19, "{shaders} shaders of 20 nodes leave none to rasterize beside the frame buffer");
        Nodes { rasterizers: 19 - shaders, shaders }
    }
}

/// The samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Samples {
    /// One.
    One,
    /// Eight: four side by side in the array, whose regions then have 64 x 32 pixels, and this number of times one after another. The paper does not
    /// say how often a primitive is rasterized (facts B); twice fits the memory.
    Eight {
        /// The number of times that a primitive is rasterized in a region.
        rasterizations: f64,
    },
}

/// Mean number of regions of a primitive with that width and height in pixels, over all places (PFL-OVERLAP).
///
/// ```
/// use tilewright_machines::pixelflow::overlap;
///
/// assert_eq!(format!("{:.2}", overlap([10.0, 10.0], [128.0, 64.0])), "1.25");
/// assert_eq!(format!("{:.2}", overlap([10.0, 10.0], [64.0, 32.0])), "1.52");
/// ```
pub fn overlap([width, height]: [f64; 2], [region_width, region_height]: [f64; 2]) -> f64 {
    (width + region_width) / region_width * ((height + region_height) / region_height)
}

/// A system on a machine.
///
/// ```
/// use tilewright_machines::pixelflow::{Nodes, Samples, Software, System};
///
/// let software = Software::paper(System::NonTexturing, Nodes::paper(0), Samples::One);
/// assert_eq!(software.primitives_within(30.0) as u64, 607_563); // the paper: over 600,000
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Software {
    /// The system.
    pub system: System,
    /// The machine.
    pub nodes: Nodes,
    /// Samples of a pixel.
    pub samples: Samples,
    /// Mean number of regions of a primitive.
    pub overlap: f64,
    /// Regions that are composed.
    pub composed: f64,
    /// Regions that are shaded.
    pub shaded: f64,
    /// Regions of 128 x 64 pixels of the screen.
    pub regions: f64,
    /// The times of the steps.
    pub costs: Costs,
}

/// The times of a frame's stages, in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Times {
    /// The front end before rasterization; in a system without sorting, at the same time.
    pub front: f64,
    /// The front end during rasterization: the second pass of the pre-sorting system.
    pub generate: f64,
    /// Rasterization.
    pub rasterize: f64,
    /// Composition.
    pub compose: f64,
    /// Shading.
    pub shade: f64,
    /// Loading the frame buffer.
    pub load: f64,
}

impl Software {
    /// Composed bytes of a pixel with all appearance parameters (PFL-BYTES).
    pub const APPEARANCE: u32 = 21;
    /// Composed bytes of a pixel with depth and colour (PFL-MEM, PFL-COL).
    pub const PLAIN: u32 = 7;

    /// The paper's case: 640 x 512 pixels in 40 regions, primitives of 10 x 10 pixels, each region composed and shaded once (PFL-REG).
    pub fn paper(system: System, nodes: Nodes, samples: Samples) -> Software {
        // The non-texturing system takes its samples one after another, each of the whole array.
        let region = match (system, samples) {
            (System::Base | System::PreSort, Samples::Eight { .. }) => [64.0, 32.0],
            _ => [128.0, 64.0],
        };
        let overlap = overlap([10.0, 10.0], region);
        Software {
            system,
            nodes,
            samples,
            overlap,
            composed: 40.0,
            shaded: 40.0,
            regions: 40.0,
            costs: Costs::default(),
        }
    }

    /// The stages of a frame of that number of primitives.
    pub fn times(&self, primitives: f64) -> Times {
        let Software { costs, nodes, .. } = *self;
        let each = primitives / f64::from(nodes.rasterizers);
        let (front, generate) = match self.system {
            System::Base => (costs.transform, 0.0),
            System::PreSort => (costs.sort, costs.generate),
            System::NonTexturing => (costs.transform_plain, 0.0),
        };
        let (rasterize, bytes) = match self.system {
            System::NonTexturing => (costs.rasterize_plain, Software::PLAIN),
            _ => (costs.rasterize * self.rasterizations(), Software::APPEARANCE),
        };
        let shade = match self.system {
            System::NonTexturing => 0.0,
            _ => self.shaded * (costs.addresses + costs.look_up) / f64::from(nodes.shaders),
        };
        let microseconds = Times {
            front: costs.overhead + front * each,
            generate: generate * each,
            rasterize: rasterize * each * self.overlap,
            compose: self.composed * costs.composed_byte * f64::from(bytes),
            shade,
            load: self.regions * costs.load,
        };
        microseconds.in_milliseconds()
    }

    /// Milliseconds of a frame of that number of primitives (PFL-LAT1, PFL-PRE, PFL-NT).
    ///
    /// ```
    /// use tilewright_machines::pixelflow::{Nodes, Samples, Software, System};
    ///
    /// let base = |shaders| Software::paper(System::Base, Nodes::paper(shaders), Samples::One);
    /// // The least latency is that of the shaders: 40 regions of 110.4 us, and 0.1 ms before.
    /// assert_eq!(format!("{:.3}", base(1).latency(0.0)), "4.516");
    /// // With four shaders the frame buffer takes longer.
    /// assert_eq!(format!("{:.3}", base(4).latency(0.0)), "2.180");
    /// ```
    pub fn latency(&self, primitives: f64) -> f64 {
        let Times { front, generate, rasterize, compose, shade, load } = self.times(primitives);
        match (self.system, self.samples) {
            (System::Base | System::PreSort, _) => {
                front + [generate, rasterize, compose, shade, load].into_iter().fold(0.0, f64::max)
            }
            (System::NonTexturing, samples) => {
                let more = if samples == Samples::One { 0.0 } else { 7.0 };
                front.max(rasterize) + more * (rasterize + compose) + compose.max(load)
            }
        }
    }

    /// The most primitives of a frame within that latency in milliseconds; 0 if the least frame takes longer.
    pub fn primitives_within(&self, milliseconds: f64) -> f64 {
        /// More than any machine draws in a second.
        const MOST: f64 = 1e10;
        last_that(MOST, |primitives| self.latency(primitives) <= milliseconds)
    }

    fn rasterizations(&self) -> f64 {
        match self.samples {
            Samples::One => 1.0,
            Samples::Eight { rasterizations } => rasterizations,
        }
    }
}

impl Times {
    fn in_milliseconds(self) -> Times {
        let Times { front, generate, rasterize, compose, shade, load } = self;
        let [front, generate, rasterize, compose, shade, load] =
            [front, generate, rasterize, compose, shade, load].map(|microseconds| microseconds / 1000.0);
        Times { front, generate, rasterize, compose, shade, load }
    }
}

/// The number of primitives from which on the first system is no slower than the second; `None` if it never is, or always. The two have to cross once.
///
/// ```
/// use tilewright_machines::pixelflow::{Nodes, Samples, Software, System, crossover};
///
/// let base = |shaders| Software::paper(System::Base, Nodes::paper(shaders), Samples::One);
/// let primitives = crossover(&base(1), &base(4)).expect("one shader is better for many primitives");
/// assert_eq!(format!("{:.0} thousand, {:.2} ms", primitives / 1000.0, base(1).latency(primitives)), "49 thousand, 9.59 ms");
/// ```
pub fn crossover(first: &Software, second: &Software) -> Option<f64> {
    const MOST: f64 = 1e9;
    let is_slower = |primitives: f64| first.latency(primitives) > second.latency(primitives);
    (is_slower(0.0) && !is_slower(MOST)).then(|| last_that(MOST, is_slower))
}

/// The last number from 0 to `most` for which a condition is true that is true up to some number; 0 if it never is.
fn last_that(most: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, most);
    // Then they are neighbours.
    while (low + high) / 2.0 > low && (low + high) / 2.0 < high {
        let middle = (low + high) / 2.0;
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

#[cfg(test)]
mod tests;

//! The work of the rasterizers: the regions of each primitive, and the time in each.

use super::costs::Ticks;
use crate::random::Random;
use tilewright_rtl::parameter::ParameterError;

/// A primitive in a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The region's number.
    pub region: u16,
    /// The time to draw it there.
    pub draws: Ticks,
}

/// The primitives of a rasterizer, in the sequence of traversal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Share {
    places: Vec<Place>,
    /// For each primitive, the number of its places and those of all before it.
    ends: Vec<u32>,
}

impl Share {
    /// Adds a primitive in these regions.
    pub fn push(&mut self, places: impl IntoIterator<Item = Place>) {
        self.places.extend(places);
        self.ends.push(self.places.len() as u32);
    }

    /// Its primitives.
    pub fn primitives(&self) -> usize {
        self.ends.len()
    }

    /// The time to draw all of them.
    pub fn draws(&self) -> Ticks {
        self.places.iter().map(|place| place.draws).sum()
    }

    /// The places of each primitive.
    pub fn iter(&self) -> impl Iterator<Item = &[Place]> {
        let begins = std::iter::once(0).chain(self.ends.iter().copied());
        begins.zip(&self.ends).map(|(begin, &end)| &self.places[begin as usize..end as usize])
    }

    /// The primitives of each region, in the sequence of traversal.
    pub(super) fn bins(&self, regions: usize) -> Vec<Vec<Binned>> {
        let mut bins = vec![Vec::new(); regions];
        for places in self.iter() {
            let first = places.iter().map(|place| place.region).min();
            for &Place { region, draws } in places {
                bins[usize::from(region)].push(Binned { is_first: Some(region) == first, draws });
            }
        }
        bins
    }
}

/// A primitive in the bin of a region.
#[derive(Clone, Copy)]
pub(super) struct Binned {
    /// Whether this is the first of its regions to be drawn.
    pub is_first: bool,
    pub draws: Ticks,
}

/// The primitives of a frame, assigned to rasterizers.
///
/// ```
/// use tilewright_machines::pixelflow::{Boxes, Workload};
///
/// // The paper's case: 10 x 10 pixels, regions of 128 x 64.
/// let boxes = Boxes { sides: [10, 10], region: [128, 64], regions: [5, 8], seed: 1 };
/// let workload = Workload::of_boxes(boxes, 20_000, 19, 166)?;
/// assert_eq!((workload.shares.len(), workload.primitives()), (19, 20_000));
/// assert!((workload.overlap() - 1.2466).abs() < 0.01);
/// # Ok::<(), tilewright_rtl::parameter::ParameterError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Workload {
    /// Each rasterizer's.
    pub shares: Vec<Share>,
    /// Regions of the screen.
    pub regions: usize,
}

/// Random boxes on a screen whose borders wrap around, so that the mean over all places is that of an infinite screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Boxes {
    /// Width and height of a box in pixels.
    pub sides: [u32; 2],
    /// Width and height of a region in pixels.
    pub region: [u32; 2],
    /// Regions across and down the screen.
    pub regions: [u32; 2],
    /// The seed of the places.
    pub seed: u64,
}

impl Boxes {
    /// Places are whole sixteenths of a pixel.
    const STEPS: u32 = 16;

    /// The regions of box number `index`.
    pub fn regions_of(&self, index: u64) -> impl Iterator<Item = u16> + use<> {
        let mut random = Random::new(self.seed, index);
        let mut spans = [0, 1].map(|axis| {
            let (side, count) = (self.region[axis] * Boxes::STEPS, self.regions[axis]);
            let corner = random.between(0, (side * count - 1) as i32) as u32;
            let (first, last) = (corner / side, (corner + self.sides[axis] * Boxes::STEPS) / side);
            (first, (last - first + 1).min(count), count)
        });
        let (left, across, columns) = spans[0];
        let (upper, down, lines) = std::mem::take(&mut spans[1]);
        let all = (0..down).flat_map(move |y| (0..across).map(move |x| (x, y)));
        all.map(move |(x, y)| ((upper + y) % lines * columns + (left + x) % columns) as u16)
    }
}

impl Workload {
    /// Random boxes, assigned to rasterizers one after another. Each takes the time `draws` in a region.
    ///
    /// # Errors
    /// There are more regions than can be counted, or no rasterizer.
    pub fn of_boxes(
        boxes: Boxes,
        primitives: u64,
        rasterizers: usize,
        draws: Ticks,
    ) -> Result<Workload, ParameterError> {
        let regions = u64::from(boxes.regions[0]) * u64::from(boxes.regions[1]);
        if regions == 0 || regions > u64::from(u16::MAX) || rasterizers == 0 {
            return Err(ParameterError(format!(
                "{primitives} boxes in {regions} regions, by {rasterizers} rasterizers: give 1 to {} regions and at least one rasterizer",
                u16::MAX
            )));
        }
        let mut shares = vec![Share::default(); rasterizers];
        for (index, rasterizer) in (0..primitives).zip((0..rasterizers).cycle()) {
            shares[rasterizer].push(boxes.regions_of(index).map(|region| Place { region, draws }));
        }
        Ok(Workload { shares, regions: regions as usize })
    }

    /// Perfect balance: each rasterizer has the same number of primitives in each region, and each primitive is in one region.
    pub fn balanced(rasterizers: usize, regions: u16, primitives: usize, draws: Ticks) -> Workload {
        let mut share = Share::default();
        (0..regions).for_each(|region| {
            (0..primitives).for_each(|_| share.push([Place { region, draws }]));
        });
        Workload { shares: vec![share; rasterizers], regions: regions.into() }
    }

    /// All primitives.
    pub fn primitives(&self) -> usize {
        self.shares.iter().map(Share::primitives).sum()
    }

    /// Mean number of regions of a primitive (PFL-OVERLAP).
    pub fn overlap(&self) -> f64 {
        self.shares.iter().map(|share| share.places.len()).sum::<usize>() as f64 / self.primitives() as f64
    }
}

#[cfg(test)]
mod tests;

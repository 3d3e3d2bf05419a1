//! The regions of a screen, and their bins of primitives.
//!
//! Source: PP5-ARCH. A renderer works on one region at a time, so a primitive goes into the bin of each region in which it may have a pixel.
//! Regions are numbered line by line from the upper left.

use super::outline::{Binner, Outline};
use serde::Serialize;
use std::ops::RangeInclusive;
use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::{MAX_SIDE, PixelBox, ScreenVertex, Size};

/// A screen in square regions. Regions at its right and lower border may extend beyond it.
///
/// ```
/// use tilewright_machines::pixel_planes::Regions;
/// use tilewright_scenes::{PixelBox, Size};
///
/// let regions = Regions::new(Size::VGA, 128)?;
/// assert_eq!((regions.columns(), regions.rows(), regions.count()), (5, 4, 20));
/// assert_eq!(regions.pixels(19), PixelBox { left: 512, top: 384, right: 639, bottom: 479 });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Regions {
    size: Size,
    side: u32,
}

/// The regions in a report.
impl Serialize for Regions {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        [self.size.width(), self.size.height(), self.side].serialize(serializer)
    }
}

impl Regions {
    /// A screen of `size` pixels in regions of `side` x `side`; the paper has 128 (PP5-ARCH).
    ///
    /// # Errors
    /// The side is 0, or larger than any screen.
    pub fn new(size: Size, side: u32) -> Result<Regions, ParameterError> {
        match (1..=MAX_SIDE).contains(&side) {
            true => Ok(Regions { size, side }),
            false => Err(ParameterError(format!(
                "regions of {side}x{side} pixels: they have to be of 1 to {MAX_SIDE} a side"
            ))),
        }
    }

    /// The paper's screen: 1280x1024 pixels in regions of 128x128 (PP5-ARCH).
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::Regions;
    ///
    /// assert_eq!(Regions::paper().count(), 80);
    /// ```
    pub fn paper() -> Regions {
        Regions { size: Size::new(1280, 1024).expect("in range"), side: 128 }
    }

    /// The screen.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Pixels along a side of a region, S.
    pub fn side(&self) -> u32 {
        self.side
    }

    /// Regions in a row.
    pub fn columns(&self) -> u32 {
        self.size.width().div_ceil(self.side)
    }

    /// Regions in a column.
    pub fn rows(&self) -> u32 {
        self.size.height().div_ceil(self.side)
    }

    /// All regions, R.
    pub fn count(&self) -> usize {
        (self.columns() * self.rows()) as usize
    }

    /// The pixels of region number `region`, below [`Regions::count`], that are on the screen.
    pub fn pixels(&self, region: usize) -> PixelBox {
        let (column, row) = (region as u32 % self.columns(), region as u32 / self.columns());
        let (left, top) = (column * self.side, row * self.side);
        PixelBox {
            left,
            top,
            right: (left + self.side).min(self.size.width()) - 1,
            bottom: (top + self.side).min(self.size.height()) - 1,
        }
    }

    /// The number of the region that contains pixel (x, y) of the screen.
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::Regions;
    /// use tilewright_scenes::Size;
    ///
    /// assert_eq!(Regions::new(Size::VGA, 128)?.of_pixel(639, 127), 4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_pixel(&self, x: u32, y: u32) -> usize {
        (y / self.side * self.columns() + x / self.side) as usize
    }

    /// The numbers of a primitive's regions, ascending: at least all regions in which it has a pixel.
    pub fn of(&self, outline: &Outline, binner: Binner) -> Vec<usize> {
        let (spans, is_transposed) = outline.spans(binner, self.side);
        let (lanes, length) = match is_transposed {
            true => (self.rows(), self.columns()),
            false => (self.columns(), self.rows()),
        };
        let mut regions = Vec::new();
        for (lane, span) in spans {
            if (0..i64::from(lanes)).contains(&lane) {
                regions.extend(within(span, length).map(|place| match is_transposed {
                    true => (lane * i64::from(self.columns()) + place) as usize,
                    false => (place * i64::from(self.columns()) + lane) as usize,
                }));
            }
        }
        regions.sort_unstable();
        regions
    }

    /// The numbers of the regions that a box of pixels on the screen meets, ascending.
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::Regions;
    /// use tilewright_scenes::{PixelBox, Size};
    ///
    /// let regions = Regions::new(Size::VGA, 128)?;
    /// let met = regions.of_box(&PixelBox { left: 127, top: 200, right: 128, bottom: 256 });
    /// assert_eq!(met.collect::<Vec<_>>(), [5, 6, 10, 11]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_box(&self, pixels: &PixelBox) -> impl Iterator<Item = usize> + use<> {
        let (side, across) = (self.side, self.columns());
        let columns = pixels.left / side..=pixels.right / side;
        let rows = pixels.top / side..=pixels.bottom / side;
        rows.flat_map(move |row| columns.clone().map(move |column| (row * across + column) as usize))
    }

    /// The bins of all regions: the numbers of the primitives in each, in the sequence of submission. A primitive is given by its vertices, as
    /// for [`Outline::of`].
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::{Binner, Regions};
    /// use tilewright_scenes::{Scene, project_polygons};
    ///
    /// let scene = Scene::builtin("star").expect("a built-in scene");
    /// let polygons = project_polygons(&scene, scene.size)?;
    /// let regions = Regions::new(scene.size, 128)?;
    /// let bins = regions.bins(&polygons.vertices, Binner::Tight);
    /// assert_eq!(bins.len(), regions.count());
    /// // Each vector is in one region at least.
    /// assert!(bins.iter().map(Vec::len).sum::<usize>() >= 266);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn bins<V: AsRef<[ScreenVertex]>>(&self, primitives: &[V], binner: Binner) -> Vec<Vec<u32>> {
        let mut bins = vec![Vec::new(); self.count()];
        for (number, vertices) in (0..).zip(primitives) {
            for region in self.of(&Outline::of(vertices.as_ref()), binner) {
                bins[region].push(number);
            }
        }
        bins
    }
}

/// The part of a span from 0 to `length`, excluding `length`.
fn within(span: RangeInclusive<i64>, length: u32) -> RangeInclusive<i64> {
    *span.start().max(&0)..=*span.end().min(&(i64::from(length) - 1))
}

#[cfg(test)]
mod tests;

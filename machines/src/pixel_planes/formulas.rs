//! The paper's formulas: regions of a vector, load of a renderer, and time of a frame.
//!
//! Source: PP5-UT to PP5-UTV, as facts A0 restore them. The formula of the bounding box is missing in the paper's text. Only
//! `(1 + L cos t/S)(1 + L sin t/S)` gives its 1.63 for vectors of 50 pixels at 45 degrees, and with it 94 clocks a vector give its 239 ns.

use serde::Serialize;
use tilewright_rtl::pixel_planes::ring::Ring;
use tilewright_scenes::angle;

/// The clock period of a renderer in ns (PP5-UT: 40 MHz).
pub const PERIOD: f64 = 25.0;

/// The clocks of a renderer for a vector: the only whole number that gives the paper's 239 ns (PP5-UTV).
pub const VECTOR_CYCLES: u64 = 94;

/// The length and the direction of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Shape {
    /// Length in pixels, L.
    pub length: f64,
    /// Degrees from the x axis, theta.
    pub angle: f64,
}

impl Shape {
    /// Mean number of regions of `side` x `side` pixels that the vector's bounding box meets, over all places (PP5-HVB).
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::Shape;
    ///
    /// let vector = Shape { length: 50.0, angle: 45.0 };
    /// assert_eq!(format!("{:.2}", vector.by_box(128)), "1.63");
    /// ```
    pub fn by_box(&self, side: u32) -> f64 {
        let (x, y) = self.spans(side);
        (1.0 + x) * (1.0 + y)
    }

    /// Mean number of regions of a vector that is binned by columns, over all places (PP5-HV). In each column that it meets, the vector is
    /// extended to both sides of the column, and binned to all regions that it then passes. Vectors steeper than 45 degrees are binned by rows.
    /// A vector shorter than a column has more regions than its box; a vector of the same length has as many.
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::Shape;
    ///
    /// // The paper gives 1.63 for this, which is the number of the bounding box.
    /// assert_eq!(format!("{:.2}", Shape { length: 50.0, angle: 45.0 }.by_columns(128)), "2.55");
    /// // L cos t = S.
    /// let equal = Shape { length: 160.0, angle: 36.86989764584402 };
    /// assert!((equal.by_columns(128) - equal.by_box(128)).abs() < 1e-12);
    /// ```
    pub fn by_columns(&self, side: u32) -> f64 {
        let (x, y) = self.spans(side);
        let (long, short) = (x.max(y), x.min(y));
        let tangent = if long == 0.0 { 0.0 } else { short / long };
        (1.0 + long) * (1.0 + tangent)
    }

    /// Mean number of regions that the vector itself meets, over all places: one, and one more for each border that it crosses (facts
    /// A0, PP5-HVB).
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::Shape;
    ///
    /// assert_eq!(format!("{:.2}", Shape { length: 50.0, angle: 45.0 }.tight(128)), "1.55");
    /// // Of a level vector all three are 1 + L/S (PP5-HV0).
    /// let level = Shape { length: 64.0, angle: 0.0 };
    /// assert_eq!([level.by_box(128), level.by_columns(128), level.tight(128)], [1.5; 3]);
    /// ```
    pub fn tight(&self, side: u32) -> f64 {
        let (x, y) = self.spans(side);
        1.0 + x + y
    }

    /// Its extents along x and y, in regions.
    fn spans(&self, side: u32) -> (f64, f64) {
        let (sine, cosine) = angle::sin_cos(self.angle);
        let span = |part: f64| self.length * part.abs() / f64::from(side);
        (span(cosine), span(sine))
    }
}

/// The lower bound of the greatest load P_w: each of `primitives` is in one region, and all `renderers` have the same number (PP5-PW).
///
/// If `primitives` counts a vector once for each of its regions, this is the load in perfect balance (PP5-PWV).
///
/// ```
/// use tilewright_machines::pixel_planes::{Shape, least_load};
///
/// let regions = Shape { length: 50.0, angle: 45.0 }.by_box(128);
/// assert_eq!(format!("{:.0}", least_load(regions * 16_000.0, 16)), "1629");
/// ```
pub fn least_load(primitives: f64, renderers: usize) -> f64 {
    primitives / renderers as f64
}

/// The paper's upper bound of P_w: each primitive is in each of `regions`, and each renderer has `regions / renderers` of them (PP5-PW).
///
/// ```
/// use tilewright_machines::pixel_planes::{greatest_load, least_load};
///
/// // The bounds differ by a factor of R, 80 on the paper's screen.
/// assert_eq!(greatest_load(1000.0, 80, 16) / least_load(1000.0, 16), 80.0);
/// ```
pub fn greatest_load(primitives: f64, regions: usize, renderers: usize) -> f64 {
    primitives * regions as f64 / renderers as f64
}

/// The upper bound of P_w if the renderers do not divide the regions: one of them has the next whole number of regions (facts E3).
///
/// ```
/// use tilewright_machines::pixel_planes::greatest_load_of_whole_regions;
///
/// // 640x480 pixels have 20 regions: four of 16 renderers take a second one.
/// assert_eq!(greatest_load_of_whole_regions(1000, 20, 16), 2000);
/// ```
pub fn greatest_load_of_whole_regions(primitives: u64, regions: usize, renderers: usize) -> u64 {
    primitives * regions.div_ceil(renderers) as u64
}

/// The time of a frame, in the unit of `period`. The busiest renderer takes `cycles` clocks for each of its `load` primitives, and never waits
/// for one (PP5-UT).
///
/// ```
/// use tilewright_machines::pixel_planes::{PERIOD, Shape, VECTOR_CYCLES, least_load, update_time};
///
/// // A vector on 16 renderers (PP5-UTV).
/// let load = least_load(Shape { length: 50.0, angle: 45.0 }.by_box(128), 16);
/// assert_eq!(format!("{:.0} ns", update_time(VECTOR_CYCLES, load, PERIOD)), "239 ns");
/// ```
pub fn update_time(cycles: u64, load: f64, period: f64) -> f64 {
    cycles as f64 * load * period
}

/// The first clock in which a renderer could begin its next instruction, but the ring has not brought it. All renderers get a region at the
/// beginning, their instructions take `clocks` one after another, and their queues have space for all of them. Clocks are counted from the
/// one in which the first region is given.
///
/// The clock follows from the rate alone. In clock B all B renderers have a region, and the ring serves them in rotation. It brings the j-th
/// instruction, counted from 0, 154 j / `bits` clocks later. An instruction is needed when those before it are done.
///
/// ```
/// use tilewright_machines::pixel_planes::first_starved;
///
/// // One arrives in 2 clocks. The first takes 20 clocks, the others 1. When the 20th has been taken, the next one has not arrived.
/// let clocks = [vec![20], vec![1; 40]].concat();
/// assert_eq!(first_starved(1, 77, &clocks), Some(41));
/// assert_eq!(first_starved(1, 154, &clocks), None);
/// ```
///
/// # Panics
/// The ring cannot bring an instruction in each clock to all renderers but one: then it is short of bits from the beginning.
pub fn first_starved(renderers: usize, bits: u64, clocks: &[u64]) -> Option<u64> {
    let instruction = u64::from(Ring::INSTRUCTION);
    assert!(bits > (renderers as u64 - 1) * instruction, "the first instructions are late");
    let first = |renderer: usize| {
        // Instructions that came while others had no region yet: one a clock.
        let before = renderers - 1 - renderer;
        let turn = (renderer + renderers - 1) % renderers;
        let brought = |number: usize| {
            let at_best = (renderer + 1 + number) as u64;
            let by_rate = |number: usize| (number * renderers + turn) as u64 * instruction / bits + renderers as u64;
            number.checked_sub(before).map_or(at_best, by_rate).max(at_best)
        };
        let mut wanted = renderer as u64 + 2;
        clocks.iter().enumerate().find_map(|(number, clocks)| {
            let at = wanted;
            wanted += clocks;
            (brought(number) + 1 > at).then_some(at)
        })
    };
    (0..renderers).filter_map(first).min()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shape() -> impl Strategy<Value = Shape> {
        (0.0..2000.0f64, prop_oneof![-400.0..400.0f64, (-8..8).prop_map(|i| 45.0 * f64::from(i))])
            .prop_map(|(length, angle)| Shape { length, angle })
    }

    /// PP5-UTV: "V * 239 ns", with 1.63 as printed and as it is.
    #[test]
    fn only_94_clocks_give_239_ns() {
        for regions in [1.63, Shape { length: 50.0, angle: 45.0 }.by_box(128)] {
            let gives = |cycles: &u64| update_time(*cycles, least_load(regions, 16), PERIOD).round() == 239.0;
            assert_eq!((1..1000).filter(gives).collect::<Vec<u64>>(), [VECTOR_CYCLES]);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// PP5-HV: pessimistic exactly where the long side is shorter than a region; the vector itself has no more than either has.
        #[test]
        fn boxes_and_columns_change_places_at_the_side_of_a_region(shape in shape(), side in 1..300u32) {
            let (by_box, by_columns) = (shape.by_box(side), shape.by_columns(side));
            let (sine, cosine) = shape.angle.to_radians().sin_cos();
            let long = shape.length * sine.abs().max(cosine.abs()) / f64::from(side);
            let noise = 1e-9 * by_box;
            let is_right = if long < 1.0 { by_columns >= by_box - noise } else { by_columns <= by_box + noise };
            prop_assert!(is_right, "{} and {}", by_columns, by_box);
            prop_assert!(shape.tight(side) <= by_box.min(by_columns) + noise);
        }

        /// PP5-HV0, and the swap of axes.
        #[test]
        fn axes_can_be_swapped(shape in shape(), side in 1..300u32) {
            let turned = Shape { angle: 90.0 - shape.angle, ..shape };
            let all = |shape: &Shape| [shape.by_box(side), shape.by_columns(side), shape.tight(side)];
            prop_assert!(all(&shape).iter().zip(all(&turned)).all(|(one, other)| (one - other).abs() < 1e-9 * one));
            let level = 1.0 + shape.length / f64::from(side);
            prop_assert_eq!(all(&Shape { angle: 90.0, ..shape }), [level; 3]);
        }

        /// The two greatest loads are one where renderers divide regions, and the one of whole regions is never less.
        #[test]
        fn whole_regions_are_never_less(primitives in 0..1000u64, renderers in 1..40usize, each in 1..9usize, rest in 0..40usize) {
            let whole = greatest_load_of_whole_regions(primitives, each * renderers, renderers);
            prop_assert_eq!(whole as f64, greatest_load(primitives as f64, each * renderers, renderers));
            let regions = each * renderers + rest;
            let whole = greatest_load_of_whole_regions(primitives, regions, renderers);
            prop_assert!(whole as f64 >= greatest_load(primitives as f64, regions, renderers) - 1e-9);
        }
    }
}

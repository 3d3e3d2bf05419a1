//! The set-up of a video processor: converts a polygon of the whole screen to its own samples (MPG-RP, MPG-SPR).
//!
//! ```text
//! packets ===> an edge and a plane a clock --> x at the place where the --> + --> roots
//!                                              function is greatest
//! ```
//!
//! The samples of video processor (i, j) are the pixels (p X + i, q Y + j). The set-up folds this offset and spacing
//! into the functions. A slope per pixel becomes one per p or q pixels. The values are those for the window of all
//! samples, the root of the quadtree. They are the greatest value of each edge function, how far the window extends
//! past each bound, and the planes at its upper left sample. The aperture widens the window by half its size on each
//! side, and is folded in, too (MPG-WIN).
//!
//! Latency and throughput: a packet takes as many clocks as it has edges, but at least 4, one for each plane. The root
//! is offered in the last of them, and waits for its receiver.

use super::format::{Bounds, Format, Matrix, PLANES, Packet, Polygon, Window, Work};
use super::lanes::{lane_by_lane, numbers};
use super::precision::Precision;
use super::tally::Tally;
use crate::prelude::*;

block! {
    /// Converts a polygon to the root window of one video processor.
    pub struct SetUp {
        /// The generator's format.
        pub format: Format,
    }
    latency = "a polygon takes a clock for each edge, but at least 4";
    source = "sparse-raster quadtree generator, figure 1 (MPG-RP, MPG-SPR, MPG-WIN)";
    in(self) SetUpIn {
        /// The polygons to convert.
        packets: stream(Packet::widths(self.format)),
        /// The outermost pixels of this video processor, widened by half the aperture; constants from [`Format::place_of`].
        place: Bounds = self.format.place(),
    }
    out(self) SetUpOut {
        /// The window of all samples, for each polygon.
        roots: stream(Work::widths(self.format)),
        /// No polygon is under way.
        idle: bit(),
        /// The counters of the set-up.
        tally: Tally,
    }
}

impl SetUp {
    fn build(&self, m: Module, i: SetUpIn) -> SetUpOut {
        let (matrix, place) = (self.format.matrix(), i.place);
        let Precision { slope: slope_bits, plane: plane_bits, .. } = self.format.precision();
        def!(step = m.reg(below(Format::MAX_EDGES)).reset(0));
        let Packet { last_edge, edges, planes, bounds } = i.packets.payload;
        let works = i.packets.valid;
        def!(is_last = step.ge(last_edge) & step.ge(PLANES - 1));

        // An edge: its value at the corner where it is greatest, and its decreases. Edges beyond the last are 0, and so
        // inside everywhere.
        def!(a = edges.a.pick(*step));
        def!(b = edges.b.pick(*step));
        def!(right = !a.is_negative());
        def!(lower = !b.is_negative());
        let bits = self.format.edge_bits();
        let along = |slope: Signal, end: Signal| match slope.times(end) {
            // The sum is what counts, and that is in range.
            product if product.width() > bits => product.trunc(bits),
            product => product.sext(bits),
        };
        let at_x = along(a, mux(right, place.right, place.left));
        let at_y = along(b, mux(lower, place.bottom, place.top));
        def!(value = edges.c.pick(*step).sext(bits) + at_x + at_y);
        def!(is_edge = numbers(last_edge.width(), self.format.edges()).le(last_edge));
        let edge = |name: &str, value: Signal| {
            let row = lane_by_lane(m, name, self.format.edges(), works, *step, value).row;
            mux(is_edge, row, 0)
        };
        let decrease = |slope: Signal, spacing: u32| {
            let size = mux(slope.is_negative(), -slope, slope).bits().trunc(slope_bits - 1);
            times_power_of_two(size.zext(slope_bits - 1 + spacing.trailing_zeros()), spacing)
        };

        // A plane: its value at the first sample, and its increase per sample.
        let offset = |end: Signal| (end + self.format.aperture() / 2).bits().trunc(below(Matrix::MAX_SIDE));
        let (column, line) = (offset(place.left), offset(place.top));
        def!(plane_x = planes.x.pick(*step));
        def!(plane_y = planes.y.pick(*step));
        let times = |plane: Signal, offset: Signal| plane.times(offset).trunc(plane_bits);
        def!(plane = planes.origin.pick(*step) + times(plane_x, column) + times(plane_y, line));
        let plane_row = |name: &str, value: Signal| lane_by_lane(m, name, PLANES, works, *step, value).row;

        let reaches = |end: Signal, bound: Signal| end - bound.zext(end.width()).signed();
        let root = Work {
            polygon: Polygon {
                last_edge,
                step_x: edge("step_x", decrease(a, matrix.columns())),
                step_y: edge("step_y", decrease(b, matrix.rows())),
                right: edge("rights", right),
                lower: edge("lowers", lower),
                plane_x: plane_row("plane_xs", times_power_of_two(plane_x, matrix.columns())),
                plane_y: plane_row("plane_ys", times_power_of_two(plane_y, matrix.rows())),
            },
            window: Window {
                size: lit(up_to(self.format.levels()), self.format.levels()),
                x: lit(self.format.levels(), 0),
                y: lit(self.format.levels(), 0),
                edges: edge("edges", value.bits()).signed(),
                bounds: Bounds {
                    left: reaches(place.right, bounds.left),
                    top: reaches(place.bottom, bounds.top),
                    right: -reaches(place.left, bounds.right),
                    bottom: -reaches(place.top, bounds.bottom),
                },
                planes: plane_row("planes", plane),
            },
        };
        let (roots, sent) = m.offer(works & is_last, root);
        i.packets.take_when(is_last & roots.ready);
        step.when(sent, 0).when(works & !is_last, step + 1);

        def!(waits = works & is_last & !sent);
        let tally =
            m.within("set_up", || Tally::count(m, Tally { busy: works & !waits, stalled: waits, results: sent }));
        SetUpOut { roots, idle: !works, tally }
    }
}

/// The number times a power of two, shifted left by the logarithm.
fn times_power_of_two(value: Signal, power: u32) -> Signal {
    value << power.trailing_zeros()
}

#[cfg(test)]
mod tests;

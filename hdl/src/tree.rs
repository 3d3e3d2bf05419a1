//! Trees: all lanes of a row combined in pairs, with logarithmic depth.

use crate::elaboration;
use crate::fields::Fields;
use crate::module::Module;
use crate::record::from_leaves;
use crate::signal::Signal;
use tilewright_circuit::ir::Shape;
use tilewright_circuit::{Loc, Mistake, Problem};

/// Combines all lanes of a row, or of a record of rows, by an associative function, such as the nearest of two.
/// Neighbours are combined first, with the lower lane on the left. Combinational.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// bundle! { struct Pixel<T> { z: T, rgb: T } }
///
/// let pixels = stack([9, 3, 250, 7, 5].map(|z| Pixel { z: lit(8, z), rgb: lit(24, z << 8) }));
/// let nearest = tree(pixels, |a: Pixel, b: Pixel| mux(a.z.le(b.z), a, b));
/// m.assert(nearest.z.eq(3) & nearest.rgb.eq(0x300), "the nearest with its colour, in three levels");
/// # });
/// ```
#[track_caller]
pub fn tree<B: Fields<Signal, With<Signal> = B> + Clone>(lanes: B, combine: impl Fn(B, B) -> B) -> B {
    let mut level = rows(lanes);
    while lanes_of(&level) > 1 {
        level = paired(&level, &combine);
    }
    first(&level)
}

impl Module {
    /// Like [`tree`], with a register after each level, named by its level: `name1` after the first. The latency in
    /// clocks is the number of levels, which is the width of [`below`](crate::below)`(lanes)`, or 0 for a single
    /// lane.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// let lanes = lit(5, 0b10111).unpack(5).zext(3);
    /// def!(hits = m.tree_of_stages("level", lanes, |a: Signal, b| a + b));
    /// # });
    /// // Three levels: the sum of five lanes appears after three clocks.
    /// assert_eq!(example.values("hits"), [0, 0, 0, 4, 4]);
    /// ```
    #[track_caller]
    pub fn tree_of_stages<B: Fields<Signal, With<Signal> = B> + Clone>(
        self,
        name: &str,
        lanes: B,
        combine: impl Fn(B, B) -> B,
    ) -> B {
        let (mut level, mut depth) = (rows(lanes), 0);
        while lanes_of(&level) > 1 {
            depth += 1;
            level = self.pipe(&format!("{name}{depth}"), paired(&level, &combine));
        }
        first(&level)
    }
}

/// The record, if all its fields are rows with equal numbers of lanes. If not, that is a problem, and rows of one
/// lane stand in.
#[track_caller]
fn rows<B: Fields<Signal, With<Signal> = B>>(lanes: B) -> B {
    let loc = Loc::caller();
    let leaves = lanes.leaves();
    let first = leaves.first().map(|(_, signal)| signal.shape());
    let odd =
        leaves.iter().find(|(_, signal)| !matches!(signal.shape(), Shape::Row(_)) || Some(signal.shape()) != first);
    let Some((_, odd)) = odd else { return lanes };
    let nodes: Vec<_> = leaves.iter().map(|(_, signal)| signal.id_at(loc)).collect();
    elaboration::with(|e| {
        let text = e.draft().describe(odd.node);
        let problem = Problem::new(
            Mistake::NeedsLanes,
            loc,
            format!("a tree needs rows with equal numbers of lanes, but `{text}` has {}", odd.shape()),
        );
        e.report_instead_of(&nodes, problem.help("a grid is combined by `.rows()` and `.columns()`, one after the other, and their `sum()`, `minimum()` and so on"));
    });
    lanes.map(|signal| elaboration::with(|e| Signal::zero_in(e, signal.width, Shape::Row(1), signal.kind, loc)))
}

fn lanes_of<B: Fields<Signal>>(level: &B) -> u32 {
    level.leaves().first().map_or(1, |(_, signal)| signal.shape().lanes())
}

/// Pairs of neighbours combined; the last of an odd number passes unchanged.
#[track_caller]
fn paired<B: Fields<Signal, With<Signal> = B> + Clone>(level: &B, combine: &impl Fn(B, B) -> B) -> B {
    let lanes = lanes_of(level);
    let combined = combine(every_second(level, lanes / 2, 0), every_second(level, lanes / 2, 1));
    if lanes.is_multiple_of(2) {
        return combined;
    }
    let mut lengthened = Vec::new();
    for ((_, combined), (_, before)) in combined.leaves().into_iter().zip(level.leaves()) {
        lengthened.push(combined.take_or(lanes / 2 + 1, |i| i, before.last()));
    }
    from_leaves(&combined, lengthened)
}

#[track_caller]
fn every_second<B: Fields<Signal, With<Signal> = B>>(level: &B, count: u32, from: u32) -> B {
    let mut taken = Vec::new();
    for (_, signal) in level.leaves() {
        taken.push(signal.take(count, |i| 2 * i + from));
    }
    from_leaves(level, taken)
}

#[track_caller]
fn first<B: Fields<Signal, With<Signal> = B>>(level: &B) -> B {
    let mut lanes = Vec::new();
    for (_, signal) in level.leaves() {
        lanes.push(signal.lane(0));
    }
    from_leaves(level, lanes)
}

//! Helpers for the blocks' tests: random polygons, and blocks that divide windows with pauses on both sides.

use std::cell::Cell;

use proptest::prelude::*;
use tilewright_sim::{Pauses, Simulation, monitor};

use super::divider::{DividerIn, DividerOut};
use super::format::{Format, Matrix, Window, Work};
use super::model::{Convex, Raster, Square};
use super::tally::Tally;
use crate::prelude::*;

/// How often both sides pause, in percent of the clocks, and the seed of the pauses.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stalls {
    pub senders: u64,
    pub receivers: u64,
    pub seed: u64,
}

pub(super) const NO_STALLS: Stalls = Stalls { senders: 0, receivers: 0, seed: 1 };

pub(super) fn stalls() -> impl Strategy<Value = Stalls> {
    let percent = || prop_oneof![Just(0), Just(50), 1u64..90];
    (percent(), percent(), any::<u64>()).prop_map(|(senders, receivers, seed)| Stalls { senders, receivers, seed })
}

/// 8x8 pixels on a matrix of 2x2, triangles.
pub(super) fn small() -> Format {
    Format::new(Screen { width: 8, height: 8 }, Matrix::new(2, 2).unwrap(), 3).unwrap()
}

/// The samples of the video processor in the upper left.
pub(super) fn first(format: Format) -> Raster {
    Raster { format, column: 0, row: 0 }
}

/// The pixels with x + y <= 6, of the small format.
pub(super) fn triangle() -> Convex {
    Convex {
        edges: vec![[1, 0, 0], [0, 1, 0], [-1, -1, 6]],
        planes: [[1 << 20, 2 << 20, 100 << 16], [0, 0, 0x80 << 16], [1 << 16, 0, 0], [0, 1 << 16, 0]],
        bounds: [0, 0, 6, 6],
    }
}

/// Arbitrary matrices and apertures, for screens of up to `side` pixels along a side.
pub(super) fn formats(side: u32) -> impl Strategy<Value = Format> {
    let side = move || prop_oneof![3 => 1..side + 1, 1 => Just(side)];
    let matrix = || prop::sample::select(vec![1, 2, 4, 8, 16u32]);
    let aperture = prop::sample::select(vec![0, 0, 2, 4, 8u32]);
    (side(), side(), matrix(), matrix(), 3..9u32, aperture).prop_map(|(width, height, p, q, edges, aperture)| {
        let format = Format::new(Screen { width, height }, Matrix::new(p, q).unwrap(), edges).unwrap();
        format.with_aperture(aperture).unwrap()
    })
}

/// One of the video processors.
pub(super) fn rasters(format: Format) -> impl Strategy<Value = Raster> {
    let matrix = format.matrix();
    (0..matrix.columns(), 0..matrix.rows()).prop_map(move |(column, row)| Raster { format, column, row })
}

/// Polygons with 3 or more edges. Each edge crosses a pixel on the screen or in the guard band around it. Most have one
/// pixel of the screen inside.
pub(super) fn polygons(format: Format) -> impl Strategy<Value = Convex> {
    let Screen { width, height } = format.screen();
    let slope = || prop_oneof![1 => Just(65_535), 1 => Just(-65_535), 2 => -65_535..65_536i64, 2 => -3..4i64];
    let at = |side: u32| {
        let side = i64::from(side);
        prop_oneof![4 => -side / 4..side + side / 4 + 1, 1 => -2048..2049i64, 1 => Just(-2048), 1 => Just(2048)]
    };
    let inside = (0..i64::from(width), 0..i64::from(height));
    let edge = (slope(), slope(), at(width), at(height), prop::bool::weighted(0.95));
    let edges = (inside, prop::collection::vec(edge, 3..format.edges() as usize + 1)).prop_map(|((x, y), edges)| {
        let toward = |(a, b, through_x, through_y, keeps): (i64, i64, i64, i64, bool)| {
            let c = -(a * through_x + b * through_y);
            if keeps && a * x + b * y + c < 0 { [-a, -b, -c] } else { [a, b, c] }
        };
        edges.into_iter().map(toward).collect()
    });
    let bounds = |side: u32| {
        let all = move || prop_oneof![Just(0), Just(side - 1), 0..side];
        prop_oneof![3 => Just((0, side - 1)), 2 => (all(), all())]
    };
    let planes = prop::array::uniform4(prop::array::uniform3(0..1u64 << 40));
    (edges, planes, bounds(width), bounds(height)).prop_map(|(edges, planes, (left, right), (top, bottom))| Convex {
        edges,
        planes,
        bounds: [left, top, right, bottom],
    })
}

/// Sends windows in, and takes the given number of parts; no more may come out. Returns the parts, and the work on each
/// level.
pub(super) fn divide<B: Block<In = DividerIn, Out = DividerOut>>(
    block: &B,
    works: Vec<Work<Bits>>,
    count: usize,
    stalls: Stalls,
) -> (Vec<Work<Bits>>, Vec<Tally<u64>>) {
    // Registers without a reset, and memories, start with any value.
    let mut sim = Simulation::of(block).unwrap().seeded(stalls.seed);
    sim.reset();
    let (i, o) = (sim.i.works, sim.o.clone());
    let t = sim.testbench();
    t.limit(1_000_000);
    let pauses = |percent, seed| Pauses::percent(percent, seed);
    // All windows are in the block, and this many parts have come.
    let (is_sent, received) = (Cell::new(false), Cell::new(0));
    let send = async {
        let mut pauses = pauses(stalls.senders, stalls.seed);
        for work in works {
            t.wait(pauses.next_length().into()).await;
            t.send_bits(i, work).await;
        }
        t.step().await;
        is_sent.set(true);
    };
    let receive = async {
        let mut pauses = pauses(stalls.receivers, stalls.seed.wrapping_add(1));
        let mut parts = Vec::new();
        for _ in 0..count {
            t.wait(pauses.next_length().into()).await;
            parts.push(without_other_edges(t.receive_bits(o.parts).await));
            received.set(parts.len());
        }
        parts
    };
    let busy = async {
        loop {
            t.step().await;
            let holds_some = is_sent.get() && received.get() < count;
            assert!(!(holds_some && t.get(o.idle).bit(0)), "a block that holds windows is not idle");
        }
    };
    let ((), parts, _, ()) = t.run((send, receive, monitor(busy), monitor(t.holds_bits(o.parts))));
    let still = async {
        t.until(o.idle).await;
        t.expect_silence(o.parts, 20).await;
    };
    t.run((still,));
    drop(t);
    let tally = o.tally.iter().map(|unit| unit.map(|port| sim.get_u64(*port))).collect();
    (parts, tally)
}

/// The work with 0 for the edges beyond the last, which have no meaning.
fn without_other_edges(work: Work<Bits>) -> Work<Bits> {
    let edges = &work.window.edges;
    let count = work.polygon.last_edge.to_u64().expect("3 bits") as u32 + 1;
    let lane = edges.width() / work.polygon.right.width();
    let edges = edges.slice(0..lane * count).resize(edges.width());
    Work { window: Window { edges, ..work.window }, ..work }
}

/// The samples of leaves, sorted, each with its polygon's values.
pub(super) fn sorted(mut works: Vec<Work<Bits>>) -> Vec<Work<Bits>> {
    works.sort_by_key(|work| (work.window.y.to_u64(), work.window.x.to_u64()));
    works
}

/// The parts of a window that a polygon may cover, by definition.
pub(super) fn parts(raster: &Raster, polygon: &Convex, window: Square, size: u32) -> Vec<Work<Bits>> {
    raster.divided(polygon, window, size).into_iter().map(|part| raster.work(polygon, part)).collect()
}

//! Random machines of the VC-1's kind, with random frames: each frame has to be golden.
//!
//! `cargo test --release -p tilewright-machines --test all vc1_campaign -- --ignored --nocapture` draws with 500 of them.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config as Settings, RngAlgorithm, TestRng, TestRunner};
use tilewright_machines::vc1::{Assign, Config, CostTable, Machine, Shown};
use tilewright_machines::{Error, Watch};
use tilewright_rtl::gfb::Blanking;
use tilewright_scenes::{Counts, MeshVertex, Projection, ScreenVertex, Size, compare, golden, set_up};

pub const BACKGROUND: [u8; 3] = [24, 28, 44];

/// A machine, and the triangles of each of its frames.
type Case = (Config, Vec<Vec<[ScreenVertex; 3]>>);

fn costs() -> impl Strategy<Value = CostTable> {
    ([0..20u64, 0..40, 0..10, 0..30, 0..40, 0..6], [1..5u64, 1..4, 1..4, 1..4]).prop_map(|(free, ports)| {
        let [vertex, polygon, area, clip, set_up, row] = free;
        let [pixel, clear, send, receive] = ports;
        CostTable { vertex, polygon, area, clip, set_up, row, pixel, clear, send, receive }
    })
}

/// Triangles on a screen of that size and beyond its border.
fn triangles(size: Size, count: usize) -> impl Strategy<Value = Vec<[ScreenVertex; 3]>> {
    let [x, y] = [size.width(), size.height()].map(|side| -80..16 * side as i32 + 80);
    let vertex = (x, y, 1..40_u32, 0..4_u8).prop_map(|(x, y, z, grey)| ScreenVertex { x, y, z, rgb: [grey * 80; 3] });
    prop::collection::vec([vertex.clone(), vertex.clone(), vertex], count)
}

fn cases(width: u32, height: u32) -> impl Strategy<Value = Case> {
    let machine = (1..=9_u32, prop::sample::select(vec![4_u32, 8, 16]), 2..=40_u32, 1..6_u32, 10..70_u32, 1..9_u32);
    let apr = prop_oneof![Just(None), Just(Some(0)), (1..300_u32).prop_map(Some)];
    let assign = prop::sample::select(vec![Assign::Once, Assign::Each, Assign::Count]);
    let display = (0.2..3.0_f64, any::<bool>());
    let screen = (32..=width, 32..=height);
    (machine, apr, assign, display, screen, costs(), 1..=4_usize, 0..24_usize).prop_flat_map(
        |(
            (processors, patch, pages, cluster, queue, word_clocks),
            apr,
            assign,
            display,
            screen,
            costs,
            frames,
            count,
        )| {
            let size = Size::new(screen.0, screen.1).expect("in range");
            let (refreshes, within) = display;
            let t_m = 80e-9 * f64::from((screen.0 + 20) * screen.1 + 4 * processors);
            let blanking = if within { Blanking::Within } else { Blanking::AtStart };
            let config = Config {
                processors,
                patch,
                cluster,
                assign,
                apr,
                costs,
                queue,
                word_clocks,
                blanking,
                refresh: 1.0 / (refreshes * t_m),
                ..Config::new(size)
            };
            let patches = config.patches().expect("the screen has 2x2").count();
            let config = Config { pages: Some(pages.min(patches)), ..config };
            prop::collection::vec(triangles(size, count), frames).prop_map(move |frames| (config, frames))
        },
    )
}

/// The projection of these triangles, each a polygon.
pub fn projection(size: Size, triangles: &[[ScreenVertex; 3]]) -> Projection {
    let mut projection = Projection {
        size,
        triangles: Vec::new(),
        vertices: Vec::new(),
        corners: Vec::new(),
        counts: Counts::default(),
    };
    for (vertices, first) in triangles.iter().zip((0..).step_by(3)) {
        projection.corners.push([0, 1, 2].map(|i| MeshVertex { position: first + i, normal: Some(first) }));
        if let Some(mut packet) = set_up(vertices, size) {
            packet.polygon = projection.counts.polygons;
            projection.triangles.push(packet);
            projection.vertices.push(*vertices);
        }
        projection.counts.polygons += 1;
    }
    projection
}

/// Draws a case; its overflows, and the polygons that were sent to all.
fn draw((config, frames): &Case) -> Result<[u64; 2], Error> {
    let views: Vec<Projection> = frames.iter().map(|triangles| projection(config.size, triangles)).collect();
    let (mut next, mut seen) = (views.iter().cloned(), 0);
    let shown = |it: Shown| {
        let view = &views[it.number as usize];
        let comparison = compare(&it.frame, &golden::render(view.size, &view.triangles, BACKGROUND));
        assert!(comparison.is_equal(), "frame {}: {comparison}", it.number);
        seen += 1;
        true
    };
    let report = Machine::new(*config)?.render_frames(BACKGROUND, &mut Watch::default(), || next.next(), shown)?;
    assert_eq!(seen, frames.len());
    let sum = |of: fn(&tilewright_machines::vc1::FrameReport) -> u64| report.frames.iter().map(of).sum();
    Ok([sum(|frame| frame.overflows()), sum(|frame| frame.broadcast())])
}

/// Draws so many cases on screens of at most that size; all overflows and all polygons that were sent.
fn campaign(count: u32, width: u32, height: u32) -> [u64; 2] {
    let mut runner = TestRunner::new_with_rng(Settings::default(), TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let cases = cases(width, height);
    let mut sums = [0; 2];
    for number in 0..count {
        let case = cases.new_tree(&mut runner).expect("a case").current();
        let counts = draw(&case).unwrap_or_else(|error| panic!("case {number}: {error}\n{case:?}"));
        sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
    }
    sums
}

#[test]
fn forty_machines_draw_golden_frames() {
    let [overflows, broadcast] = campaign(40, 40, 36);
    assert!(overflows > 100 && broadcast > 100, "{overflows} {broadcast}");
}

#[test]
#[ignore = "some minutes"]
fn five_hundred_machines_draw_golden_frames() {
    let [overflows, broadcast] = campaign(500, 80, 60);
    println!("{overflows} overflows, {broadcast} polygons sent to all");
    assert!(overflows >= 2000 && broadcast >= 2000);
}

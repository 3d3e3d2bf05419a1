//! Random machines of the VC-1's kind, with random frames: each frame has to be golden, each refresh what the banks have, and each event the model's.
//!
//! `cargo test --release -p tilewright-machines --test all vc1_campaign -- --ignored --nocapture` draws with 500 of them.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config as Settings, RngAlgorithm, TestRng, TestRunner};
use tilewright_machines::vc1::{Assign, Config, CostTable, Cursor, Machine, Shown};
use tilewright_machines::{Error, Watch};
use tilewright_rtl::gfb::{Blanking, Passes};
use tilewright_scenes::{Projection, ScreenVertex, Size, compare, golden};

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
    let display = (0.2..3.0_f64, any::<bool>(), 1..=40_u32);
    let screen = (32..=width, 32..=height);
    // A picture of several passes, a cursor, or neither.
    let host = (any::<bool>(), 0..8_u32, (0..width, 0..height));
    (machine, (apr, assign, host), display, screen, costs(), 1..=4_usize, 0..24_usize).prop_flat_map(
        |(
            (processors, patch, pages, cluster, queue, word_clocks),
            (apr, assign, (immediate, extra, (x, y))),
            display,
            screen,
            costs,
            frames,
            count,
        )| {
            let size = Size::new(screen.0, screen.1).expect("in range");
            let (refreshes, within, overhead) = display;
            let t_m = 80e-9 * f64::from((screen.0 + overhead) * screen.1 + 4 * processors);
            let least = 330e-9 * f64::from(screen.1 + 45);
            let blanking = if within { Blanking::Within } else { Blanking::AtStart };
            let accumulate = Passes::of_count(extra);
            let frames = if accumulate.is_some() { extra as usize } else { frames };
            let config = Config {
                overhead,
                immediate,
                accumulate,
                cursor: (extra > 5).then_some(Cursor { x: x % screen.0, y: y % screen.1 }),
                processors,
                patch,
                cluster,
                assign,
                apr,
                costs,
                queue,
                word_clocks,
                blanking,
                refresh: 1.0 / (refreshes * t_m).max(least),
                ..Config::new(size)
            };
            let patches = config.patches().expect("the screen has 2x2").count();
            let config = Config { pages: Some(pages.min(patches)), ..config };
            prop::collection::vec(triangles(size, count), frames).prop_map(move |frames| (config, frames))
        },
    )
}

/// What happened in some runs.
#[derive(Debug, Default)]
struct Happened {
    overflows: u64,
    /// Polygons that were sent to all.
    broadcast: u64,
    averages: u64,
    refreshes: u64,
    /// Events, times and counts that are the model's.
    compared: u64,
}

/// Draws a case, and looks at every refresh.
fn draw((config, frames): &Case) -> Result<Happened, Error> {
    let views: Vec<Projection> =
        frames.iter().map(|triangles| Projection::of_triangles(config.size, triangles.iter().copied())).collect();
    let (mut next, mut seen, mut averages) = (views.iter().cloned(), Vec::new(), 0);
    let mut shown = |it: Shown| {
        let view = &views[it.number as usize];
        let mut expected = golden::render(view.size, &view.triangles, BACKGROUND);
        if let Some(cursor) = config.cursor {
            cursor.draw(&mut expected);
        }
        let comparison = compare(&it.frame, &expected);
        assert!(comparison.is_equal(), "frame {}: {comparison}", it.number);
        seen.push(expected);
        if let Some(average) = it.average {
            assert_eq!(average, golden::average(&seen));
            averages += 1;
        }
        true
    };
    let machine = Machine::new(*config)?.judging_every_refresh();
    let report = machine.render_frames(BACKGROUND, &mut Watch::default(), || next.next(), &mut shown)?;
    assert_eq!((seen.len(), averages), (frames.len(), config.accumulate.iter().count() as u64));
    let sum = |of: fn(&tilewright_machines::vc1::FrameReport) -> u64| report.frames.iter().map(of).sum();
    let [overflows, broadcast] = [sum(|frame| frame.overflows()), sum(|frame| frame.broadcast())];
    Ok(Happened { overflows, broadcast, averages, refreshes: report.judged, compared: report.compared })
}

/// Draws so many cases on screens of at most that size.
fn campaign(count: u32, width: u32, height: u32) -> Happened {
    let mut runner = TestRunner::new_with_rng(Settings::default(), TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let cases = cases(width, height);
    let mut sum = Happened::default();
    for number in 0..count {
        let case = cases.new_tree(&mut runner).expect("a case").current();
        let it = draw(&case).unwrap_or_else(|error| panic!("case {number}: {error}\n{case:?}"));
        sum.overflows += it.overflows;
        sum.broadcast += it.broadcast;
        sum.averages += it.averages;
        sum.refreshes += it.refreshes;
        sum.compared += it.compared;
    }
    sum
}

#[test]
fn forty_machines_draw_golden_frames() {
    let it = campaign(40, 40, 36);
    assert!(it.overflows > 100 && it.broadcast > 100 && it.averages > 5 && it.refreshes > 200, "{it:?}");
    assert!(it.compared > 400_000, "{it:?}");
}

#[test]
#[ignore = "some minutes"]
fn five_hundred_machines_draw_golden_frames() {
    let it = campaign(500, 80, 60);
    println!("{it:?}");
    assert!(it.overflows >= 2000 && it.broadcast >= 2000, "{it:?}");
}

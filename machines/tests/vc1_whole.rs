//! Whole frames of the VC-1 over the range of its configurations, and how often each overflows.
//!
//! `cargo test --release -p tilewright-machines --test all vc1_whole -- --ignored --nocapture` draws the large ones.

use std::collections::HashSet;

use tilewright_machines::Watch;
use tilewright_machines::vc1::{Assign, Assignment, Config, CostTable, Machine, Shown};
use tilewright_scenes::{Projection, Size, Triangle, compare, golden};

use crate::vc1::{small, turning};
use crate::vc1_campaign::BACKGROUND;

/// How often a processing element runs out of pages that draws these packets one after the other, row by row: a plain model of
/// VC1-PT and VC1-SW4.
fn overflows<'a>(packets: impl Iterator<Item = &'a Triangle>, config: &Config) -> u64 {
    let pages = config.pages().expect("in range") as usize;
    let (mut taken, mut count) = (HashSet::new(), 0);
    for packet in packets {
        let bounds = packet.bounds;
        for y in bounds.top..=bounds.bottom {
            for x in (bounds.left..=bounds.right).filter(|&x| packet.covers(x, y)) {
                let patch = (x / config.patch, y / config.patch);
                if !taken.contains(&patch) && taken.len() == pages {
                    taken.clear();
                    count += 1;
                }
                taken.insert(patch);
            }
        }
    }
    count
}

/// The overflows of all processing elements in each view, where each packet is drawn by its own.
fn expected(config: &Config, views: &[Projection]) -> Vec<u64> {
    let mut first: Option<Assignment> = None;
    let mut of_view = |view: &Projection| {
        let assignment = config.assignment(view, first.as_ref()).expect("one scene");
        let of = |polygons: &Vec<_>| {
            let packets =
                polygons.iter().flat_map(|it: &tilewright_machines::vc1::Polygon| &view.triangles[it.packets.clone()]);
            overflows(packets, config)
        };
        let sum = assignment.polygons.iter().map(of).sum();
        first.get_or_insert(assignment);
        sum
    };
    views.iter().map(&mut of_view).collect()
}

/// Draws all views, all of which have to be golden; their overflows, which are the model's where each packet is drawn by its own.
fn draw(name: &str, config: Config, views: &[Projection]) -> Vec<u64> {
    let (mut next, mut seen) = (views.iter().cloned(), 0);
    let shown = |it: Shown| {
        let view = &views[it.number as usize];
        let comparison = compare(&it.frame, &golden::render(view.size, &view.triangles, BACKGROUND));
        assert!(comparison.is_equal(), "{name}, frame {}: {comparison}\n{config:?}", it.number);
        seen += 1;
        true
    };
    let machine = Machine::new(config).expect("can be built");
    let report = machine.render_frames(BACKGROUND, &mut Watch::default(), || next.next(), shown).expect("renders");
    assert_eq!(seen, views.len());
    let overflows: Vec<u64> = report.frames.iter().map(|frame| frame.overflows()).collect();
    if config.apr.is_none() {
        assert_eq!(overflows, expected(&config, views), "{name}\n{config:?}");
    }
    overflows
}

/// Pages, patches, clusters and thresholds of all kinds, at that size, by programs of those costs.
fn range(size: Size, scene: &str, processors: &[u32], costs: CostTable) {
    let views = turning(scene, size, 3, 15.0);
    let plain = Config { apr: None, costs, ..small(size) };
    let patches = plain.patches().expect("4x4 fits").count();
    for &processors in processors {
        draw(scene, Config { processors, ..plain }, &views[..1]);
        let shared = Config { processors, apr: Some(100), assign: Assign::Each, ..plain };
        draw(scene, shared, &views);
    }
    for pages in [patches * 10 / 47, patches / 16, patches / 64] {
        let counts = draw(scene, Config { pages: Some(pages), ..plain }, &views[..2]);
        assert!(pages > patches / 64 || counts[0] > 0, "{pages} pages of {patches}: {counts:?}");
        draw(scene, Config { pages: Some(pages), apr: Some(100), ..plain }, &views[..1]);
    }
    for patch in [8, 16] {
        draw(scene, Config { patch, ..plain }, &views[..1]);
    }
    for cluster in [1, 8, 128, 512] {
        draw(scene, Config { cluster, assign: Assign::Count, ..plain }, &views[..1]);
    }
    for apr in [0, 50, 500] {
        draw(scene, Config { apr: Some(apr), ..plain }, &views[..1]);
    }
}

#[test]
fn frames_are_golden_over_the_whole_range() {
    let size = Size::new(64, 48).unwrap();
    let hasty = CostTable { vertex: 1, polygon: 2, set_up: 2, clip: 1, row: 1, ..CostTable::default() };
    range(size, "table", &[2, 64], hasty);
}

/// Four pages at 160x120 are next to nothing: a processing element swaps at nearly every fifth patch.
#[test]
#[ignore = "a minute"]
fn four_pages_are_enough() {
    let size = Size::new(160, 120).unwrap();
    let config = Config { processors: 4, pages: Some(4), apr: None, ..small(size) };
    println!("{:?} overflows", draw("star", config, &turning("star", size, 2, 20.0)));
}

#[test]
#[ignore = "some minutes"]
fn large_frames_are_golden_over_the_whole_range() {
    range(Size::new(320, 240).unwrap(), "table", &[1, 2, 4, 8, 16, 64, 256], CostTable::default());
    range(Size::new(160, 120).unwrap(), "ter1k", &[1, 2, 4, 8, 16, 64, 256], CostTable::default());
    for scene in ["teapot", "table", "teapot16", "ter1k", "ter250"] {
        for (processors, apr) in [(16, Some(500)), (16, None), (256, Some(500))] {
            let config = Config { processors, apr, ..Config::new(Size::VGA) };
            let overflows = draw(scene, config, &turning(scene, Size::VGA, 1, 0.0));
            println!("{scene}, n = {processors}, threshold {apr:?}: {overflows:?} overflows");
        }
    }
}

//! The model against the hardware in simulation, clock for clock.

use super::super::rectangles::Rectangles;
use super::super::windows::{Costs, Windows};
use super::*;
use proptest::prelude::*;
use std::sync::atomic::AtomicBool;
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::quadtree::format;
use tilewright_rtl::quadtree::processor::VideoProcessor;
use tilewright_rtl::quadtree::raster::Part;
use tilewright_scenes::{Polygon, ScreenVertex, Size, set_up_polygon_of_any_size};

/// A small generator, and packets for it.
#[derive(Clone, Debug)]
struct Small {
    generator: QuadtreeGenerator,
    polygons: Vec<Polygon>,
    pauses: Vec<u64>,
    /// The video processor that is looked at in each clock.
    seen: u32,
}

impl Small {
    fn packets(&self) -> Packets<'_> {
        Packets { polygons: &self.polygons, pauses: &self.pauses }
    }
}

/// Parts by kind and wanted levels, again and again until all levels are theirs.
fn form_of(parts: &[(u32, u32)], format: &Format) -> Form {
    let mut left = format.levels();
    let mut form = Vec::new();
    for &(kind, levels) in parts.iter().cycle() {
        if left == 0 {
            break;
        }
        let levels = levels.min(left);
        left -= levels;
        form.push(match kind {
            0 => Part::Stack(levels),
            1 => Part::Pipe(levels),
            _ => Part::Tree(levels),
        });
    }
    Form::new(form, format).expect("all levels are divided")
}

/// An ellipse of so many corners.
fn polygon(size: Size, (x, y): (i32, i32), (width, height): (f64, f64), corners: u32) -> Vec<Polygon> {
    let vertex = |corner: u32| {
        let angle = std::f64::consts::TAU * f64::from(corner) / f64::from(corners) + 0.3;
        let (x, y) = (x + (width * angle.cos()) as i32, y + (height * angle.sin()) as i32);
        ScreenVertex { x, y, z: 9, rgb: [1, 2, 3] }
    };
    set_up_polygon_of_any_size(&(0..corners).map(vertex).collect::<Vec<_>>(), size)
}

/// A generator of serial units.
fn generator(
    (width, height): (u32, u32),
    (p, q): (u32, u32),
    edges: u32,
    aperture: u32,
    form: &str,
    queues: Queues,
) -> QuadtreeGenerator {
    let screen = Screen::new(width, height).expect("in range");
    let matrix = format::Matrix::new(p, q).expect("powers of two");
    let format = Format::new(screen, matrix, edges).expect("3 to 8 edges").with_aperture(aperture).expect("even");
    let form = Form::parse(form, &format).expect("all levels are divided");
    QuadtreeGenerator { video_processor: VideoProcessor { format, form, test: Test::Serial, queues } }
}

fn generators() -> impl Strategy<Value = (QuadtreeGenerator, Size)> {
    let screen = (8..=40_u32, 8..=40_u32, 0..3_u32, 0..3_u32);
    let queues = (1..=4_u32, 1..=4_u32, 1..=4_u32);
    let parts = proptest::collection::vec((0..3_u32, 1..=3_u32), 1..4);
    (screen, queues, parts, 3..=8_u32, 0..2_u32, any::<bool>()).prop_map(
        |((width, height, p, q), (broadcast, packets, windows), parts, edges, aperture, is_serial)| {
            let screen = Screen::new(width, height).expect("in range");
            let matrix = format::Matrix::new(1 << p, 1 << q).expect("powers of two");
            let format = Format::new(screen, matrix, edges).expect("3 to 8 edges");
            let format = format.with_aperture(2 * aperture).expect("even");
            let test = if is_serial { Test::Serial } else { Test::Parallel };
            let queues = Queues { broadcast, packets, windows };
            let form = form_of(&parts, &format);
            let generator = QuadtreeGenerator { video_processor: VideoProcessor { format, form, test, queues } };
            (generator, Size::new(width, height).expect("in range"))
        },
    )
}

fn small() -> impl Strategy<Value = Small> {
    let polygons = |size: Size, edges: u32| {
        let place = (0..16 * size.width() as i32, 0..16 * size.height() as i32);
        let radius = || prop_oneof![4.0..40.0_f64, 30.0..320.0_f64];
        (place, (radius(), radius()), 3..=edges)
            .prop_map(move |(place, radii, corners)| polygon(size, place, radii, corners))
    };
    let pauses = prop_oneof![Just(Vec::new()), proptest::collection::vec(prop_oneof![Just(0), 0..300_u64], 0..20)];
    (generators(), any::<u32>(), pauses).prop_flat_map(move |((generator, size), seen, pauses)| {
        let edges = generator.format().edges();
        let seen = seen % generator.format().matrix().processors();
        proptest::collection::vec(polygons(size, edges), 0..16).prop_map(move |polygons| Small {
            generator: generator.clone(),
            polygons: polygons.into_iter().flatten().filter(|polygon| polygon.edges.len() <= edges as usize).collect(),
            pauses: pauses.clone(),
            seen,
        })
    })
}

/// What the unit's counters are before the edge of a clock: how many clocks it has held a window, and its results.
fn before(visits: &[Visit], unit: u32, clock: u64) -> (u64, u64) {
    let of_unit = || visits.iter().filter(|visit| visit.unit == unit);
    let held = |visit: &Visit| visit.ended.min(clock.saturating_sub(1)).saturating_sub(visit.taken);
    let results = of_unit().flat_map(|visit| &visit.sent).filter(|sent| **sent < clock);
    (of_unit().map(held).sum(), results.count() as u64)
}

/// The clocks of packets, of windows in each unit of a video processor and of the end, and all counters, are those of the hardware.
fn agrees(small: &Small) {
    let mut watch = Watch::default();
    let model = Model::new(&small.generator).expect("a small matrix");
    let (run, visits) = model.visits(small.packets(), &mut watch).expect("not interrupted");
    let mut simulated = Simulated::new(&small.generator).expect("it is sound");
    let mut differs = None;
    let in_hardware = simulated.run_seen(small.packets(), &mut watch, |simulated, clock| {
        let counts = simulated.0.counters_of(small.seen).units.into_iter();
        for (unit, counted) in (0..).zip(counts.map(|counts| (counts.busy + counts.stalled, counts.results))) {
            let expected = before(&visits[small.seen as usize], unit, clock);
            if counted != expected && differs.is_none() {
                differs = Some((clock, unit, counted, expected));
            }
        }
    });
    let in_hardware = in_hardware.expect("its assertions hold");
    assert_eq!(differs, None, "clock, unit, held and sent in hardware, in the model: {small:?}");
    assert_eq!(in_hardware, run, "{small:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(20) })]

    #[test]
    fn the_model_is_the_hardware_clock_for_clock(small in small()) {
        agrees(&small);
    }
}

/// Polygons that fill the screen keep the arbiters of all levels busy, which what comes behind them holds up.
#[test]
fn trees_take_turns_as_the_hardware_does() {
    let size = Size::new(8, 8).expect("in range");
    for (form, windows) in
        [("tree:3", 1), ("tree:3", 3), ("tree:2+stack:1", 1), ("tree:2+pipe:1", 2), ("stack:1+tree:2", 1)]
    {
        let generator = generator((8, 8), (1, 1), 4, 0, form, Queues { broadcast: 1, packets: 2, windows });
        let polygons =
            (0..6).flat_map(|index| polygon(size, (64 + index, 60), (90.0 - f64::from(9 * index), 70.0), 4)).collect();
        agrees(&Small { generator, polygons, pauses: Vec::new(), seen: 0 });
    }
}

/// The paper's screen and aperture, with its smaller matrices.
#[test]
fn rectangles_on_the_papers_screen_take_the_hardwares_clocks() {
    let size = Size::new(1024, 1024).expect("in range");
    for (side, form, area) in [(4, "pipe", 2.0), (4, "stack", 20.0)] {
        let queues = Queues { broadcast: 2, packets: 1, windows: 1 };
        let generator = generator((1024, 1024), (side, side), 4, 2, form, queues);
        let rectangles = Rectangles::new(size, area, 5.0, 3).expect("they fit");
        let polygons: Vec<Polygon> = (0..12).map(|index| rectangles.polygon(index)).collect();
        let (packets, mut watch) = (Packets::at_once(&polygons), Watch::default());
        let run = Model::new(&generator).expect("possible").run(packets, &mut watch).expect("not interrupted");
        let in_hardware =
            Simulated::new(&generator).expect("sound").run(packets, &mut watch).expect("its assertions hold");
        assert_eq!(in_hardware, run);
        assert!(run.broadcast.stalled > run.clocks / 4, "they wait for each other: {run:?}");
    }
}

/// Square rasters of tall and of wide matrices reach beyond the screen, up to 2048x2048 samples of every 16th pixel.
#[test]
fn matrices_that_are_no_squares_take_the_hardwares_clocks() {
    for ((width, height), matrix) in [((640, 480), (1, 4)), ((640, 480), (16, 1)), ((40, 2048), (16, 1))] {
        let generator =
            generator((width, height), matrix, 4, 2, "stack", Queues { broadcast: 1, packets: 1, windows: 1 });
        let size = Size::new(width, height).expect("in range");
        let rectangles = Rectangles::new(size, 100.0, 5.0, 3).expect("they fit");
        let polygons: Vec<Polygon> = (0..6).map(|index| rectangles.polygon(index)).collect();
        let (packets, mut watch) = (Packets::at_once(&polygons), Watch::default());
        let run = Model::new(&generator).expect("possible").run(packets, &mut watch).expect("not interrupted");
        let in_hardware =
            Simulated::new(&generator).expect("sound").run(packets, &mut watch).expect("its assertions hold");
        assert_eq!(in_hardware, run);
        assert!(run.processors.iter().map(|processor| processor.fragments).sum::<u64>() > 500);
    }
}

#[test]
fn a_run_of_the_hardware_can_be_broken_off_and_knows_its_packets() {
    let generator = generator((8, 8), (1, 1), 3, 0, "stack", Queues { broadcast: 1, packets: 1, windows: 1 });
    let mut simulated = Simulated::new(&generator).expect("sound");
    let size = Size::new(8, 8).expect("in range");
    let squares: Vec<Polygon> = polygon(size, (64, 64), (40.0, 40.0), 4);
    let problem = simulated.run(Packets::at_once(&squares), &mut Watch::default()).expect_err("too many edges");
    assert_eq!(problem.to_string(), "a polygon of 4 edges: this generator is built for polygons of up to 3");
    let triangles: Vec<Polygon> = (0..20).flat_map(|_| polygon(size, (64, 64), (90.0, 90.0), 3)).collect();
    let cancel = AtomicBool::new(true);
    let mut watch = Watch { progress: None, cancel: Some(&cancel) };
    let problem = simulated.run(Packets::at_once(&triangles), &mut watch).expect_err("it was broken off");
    assert!(problem.to_string().ends_with("while the machine was simulating"), "{problem}");
    assert_eq!(Model::new(&generator).expect("possible").run(Packets::at_once(&triangles), &mut watch), None);
}

/// Fragments, windows and clocks of work are those of the plain count.
#[test]
fn windows_are_those_of_the_search() {
    let size = Size::new(64, 64).expect("in range");
    let place = |index: i32| ((37 * index) % 1024, (61 * index) % 1024);
    let polygons: Vec<Polygon> =
        (0..40).flat_map(|index| polygon(size, place(index), (f64::from(9 * index), 50.0), 5)).collect();
    for form in ["stack", "pipe", "tree:4+pipe", "pipe:1+tree:2+stack", "stack:2+tree:3"] {
        let generator = generator((64, 64), (2, 2), 5, 2, form, Queues { broadcast: 1, packets: 3, windows: 2 });
        let search = Search::new(rasters_of(&generator.format())).expect("possible");
        let model = Model::new(&generator).expect("possible");
        let run = model.run(Packets::at_once(&polygons), &mut Watch::default()).expect("not interrupted");
        for (place, processor) in search.processors().zip(&run.processors) {
            let (mut windows, mut busy) = (Windows::none(5), [0; 5]);
            for polygon in &polygons {
                let of_polygon = search.windows(polygon, place);
                let costs = Costs::new(Test::Serial, polygon.edges.len() as u64, 4);
                busy.iter_mut().zip(of_polygon.busy(costs)).for_each(|(sum, clocks)| *sum += clocks);
                windows += &of_polygon;
            }
            assert_eq!(processor.fragments, windows.fragments);
            let units = &processor.units;
            assert_eq!(units.iter().map(|unit| unit.results).collect::<Vec<_>>(), windows.passed, "{form}");
            assert_eq!(units[1..].iter().map(|unit| unit.busy).collect::<Vec<_>>(), busy, "MPG-EQ5, {form}");
        }
    }
}

#[test]
fn without_packets_nothing_happens() {
    let generator = generator((8, 8), (1, 1), 3, 0, "pipe", Queues { broadcast: 1, packets: 1, windows: 1 });
    let (packets, mut watch) = (Packets::at_once(&[]), Watch::default());
    let run = Model::new(&generator).expect("possible").run(packets, &mut watch).expect("not interrupted");
    assert_eq!((run.clocks, run.broadcast), (0, Counts::default()));
    assert_eq!(Simulated::new(&generator).expect("sound").run(packets, &mut watch).expect("it ends"), run);
}

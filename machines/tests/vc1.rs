//! Whole frames of the VC-1 against the golden rasterizer.

use std::sync::atomic::{AtomicBool, Ordering};

use proptest::prelude::*;
use tilewright_machines::vc1::{
    Assign, Assignment, Config, CostTable, Demand, FrameReport, Machine, Report, Shown, demand,
};
use tilewright_machines::{Error, Progress, Watch};
use tilewright_scenes::{Comparison, Frame, Projection, Scene, ScreenVertex, Size, compare, golden, project};
use tilewright_sim::Vcd;

use crate::vc1_campaign::BACKGROUND;

/// Programs that compute little, so that the local frame buffers are busy all the time.
const HASTY: CostTable =
    CostTable { vertex: 1, polygon: 2, area: 1, clip: 1, set_up: 2, row: 1, pixel: 1, clear: 1, send: 1, receive: 1 };

/// A built-in scene on a screen of that size.
fn on_screen(scene: &str, width: u32, height: u32) -> Projection {
    let scene = Scene::builtin(scene).expect("a built-in scene");
    project(&scene, Size::new(width, height).expect("in range")).expect("the scene is in sight")
}

/// How a frame compares with the golden one.
fn against_golden(frame: &Frame, projection: &Projection) -> Comparison {
    compare(frame, &golden::render(projection.size, &projection.triangles, BACKGROUND))
}

fn render(config: Config, projection: &Projection) -> Result<(Frame, Report), Error> {
    Machine::new(config)?.render(projection, BACKGROUND, &mut Watch::default())
}

/// Draws a frame of each view; all of them have to be golden.
fn render_all(config: Config, views: &[Projection]) -> Report {
    let (mut next, mut seen) = (views.iter().cloned(), 0);
    let shown = |it: Shown| {
        let comparison = against_golden(&it.frame, &views[it.number as usize]);
        assert!(comparison.is_equal() && it.number == seen, "frame {}: {comparison}", it.number);
        seen += 1;
        true
    };
    let machine = Machine::new(config).expect("can be built");
    let report = machine.render_frames(BACKGROUND, &mut Watch::default(), || next.next(), shown).expect("renders");
    assert_eq!((seen as usize, report.frames.len()), (views.len(), views.len()));
    for frame in &report.frames {
        // From swap to swap a processing element has each clock in one class; all swap within some clocks, if none has an overflow.
        let totals: Vec<u64> = frame.processors.iter().map(|it| it.clocks.total()).collect();
        assert!(frame.overflows() > 0 || totals.iter().all(|total| total.abs_diff(totals[0]) <= 8), "{totals:?}");
    }
    report
}

/// The views of a scene from a camera that turns.
pub fn turning(scene: &str, size: Size, frames: u32, degrees: f64) -> Vec<Projection> {
    let mut scene = Scene::builtin(scene).expect("a built-in scene");
    let camera = scene.camera;
    let view = |number: u32| {
        scene.camera = camera.orbited(degrees * f64::from(number));
        project(&scene, size).expect("the scene is in sight")
    };
    (0..frames).map(view).collect()
}

fn frame_of(report: &Report) -> &FrameReport {
    let [frame] = &report.frames[..] else { panic!("one frame") };
    frame
}

/// The machine for a small screen, with a display as much faster than the paper's as T_m is shorter.
pub fn small(size: Size) -> Config {
    let refresh = 60.0 * 640.0 * 480.0 / size.pixels() as f64;
    Config { refresh, ..Config::new(size) }
}

/// Pixels that triangles cover, each as often as one does.
fn covered(projection: &Projection) -> u64 {
    let of = |t: &tilewright_scenes::Triangle| {
        let b = t.bounds;
        let pixels = (b.top..=b.bottom).flat_map(|y| (b.left..=b.right).map(move |x| (x, y)));
        pixels.filter(|&(x, y)| t.covers(x, y)).count() as u64
    };
    projection.triangles.iter().map(of).sum()
}

/// (M + beta) * N + 4 * n (VC1-TM).
pub fn merge_clocks(config: &Config) -> u64 {
    let (width, height) = (u64::from(config.size.width()), u64::from(config.size.height()));
    (width + u64::from(config.overhead)) * height + 4 * u64::from(config.processors)
}

#[test]
fn every_number_of_processors_and_every_patch_draws_the_golden_frame() {
    for scene in ["teapot", "ter1k", "star"] {
        let projection = on_screen(scene, 80, 60);
        for (processors, patch) in [(1, 8), (2, 16), (3, 4), (4, 4), (8, 8), (16, 16), (64, 4)] {
            let config = Config { processors, patch, costs: HASTY, ..small(projection.size) };
            let (frame, report) = render(config, &projection).expect("there are pages for all patches");
            let comparison = against_golden(&frame, &projection);
            assert!(comparison.is_equal(), "{scene}, {processors} processors, patches of {patch}: {comparison}");
            assert_eq!(report.merge_clocks, merge_clocks(&config));
        }
    }
}

/// With large packets drawn by their own processing element, and by all.
#[test]
fn the_report_counts_what_the_dry_run_expects() {
    let projection = on_screen("teapot", 96, 72);
    for apr in [None, Some(2)] {
        let config = Config { processors: 5, cluster: 20, costs: HASTY, apr, ..small(projection.size) };
        let (_, report) = render(config, &projection).expect("there are pages for all patches");
        let assignment = Assignment::new(&projection, 5, 20, &HASTY);
        let expected = demand(&assignment, &projection.triangles, &config.patches().expect("4x4 fits"), apr);
        let frame = frame_of(&report);
        let drawn: Vec<Demand> =
            frame.processors.iter().map(|it| Demand { pixels: it.pixels, pages: it.pages }).collect();
        assert_eq!(drawn, expected);
        assert_eq!(frame.pixels(), covered(&projection));
        assert_eq!((report.polygons, frame.processors.iter().map(|it| it.polygons).sum::<u32>()), (4096, 4096));
        let large = projection.triangles.iter().filter(|it| apr.is_some_and(|apr| it.area() > f64::from(apr))).count();
        assert_eq!(frame.broadcast(), large as u64);
        assert!(apr.is_none() || large > 50, "{large}");
    }
}

/// The times of a frame follow each other, and the clocks of each processing element are those until its swap.
#[test]
fn every_clock_is_in_one_class() {
    let views = turning("teapot", Size::new(96, 72).unwrap(), 3, 20.0);
    let config = Config { processors: 5, costs: HASTY, ..small(views[0].size) };
    let report = render_all(config, &views);
    let mut clocks = 0;
    for frame in &report.frames {
        let times = frame.times;
        let in_order = [Some(times.command), times.drawn, times.swapped, times.merged, times.shown];
        assert!(in_order.is_sorted() && in_order.iter().all(Option::is_some), "{times:?}");
        clocks += frame.processors.iter().map(|it| it.clocks.total()).max().expect("5");
        // The reset takes a clock of the merger.
        assert!(times.swapped.unwrap().abs_diff(25_000 * clocks) < 200_000, "{times:?} {clocks}");
        assert!(frame.processors.iter().all(|it| it.clocks.clearing == 24 * 18));
    }
}

/// The camera of the table moves: large polygons are drawn by their own processing element through overflows, by all, or each polygon is
/// drawn by all; with 256 of them too.
#[test]
fn frames_of_a_moving_camera_are_golden() {
    let views = turning("table", Size::new(80, 60).unwrap(), 3, 25.0);
    let overflows = |processors, pages, apr, queue| {
        let config = Config { processors, pages: Some(pages), apr, queue, costs: HASTY, ..small(views[0].size) };
        let report = render_all(config, &views);
        let large =
            views.iter().flat_map(|view| &view.triangles).filter(|it| it.area() > apr.map_or(f64::MAX, f64::from));
        assert_eq!(report.frames.iter().map(FrameReport::broadcast).sum::<u64>(), large.count() as u64);
        report.frames.iter().map(FrameReport::overflows).sum::<u64>()
    };
    assert!(overflows(3, 60, None, 64) > 10);
    assert!(overflows(3, 60, Some(20), 10) > 0);
    assert!(overflows(4, 20, Some(0), 10) > 10);
    assert_eq!(overflows(256, 60, Some(20), 64), 0);
}

/// With queues of one polygon and a fast bus: all send at once; all overflow while others send to them; with both, nobody hangs.
#[test]
fn queues_of_one_polygon_do_not_lock() {
    let views = turning("table", Size::new(80, 60).unwrap(), 2, 25.0);
    let processors = |pages, apr, word_clocks| {
        let config = Config {
            processors: 4,
            pages: Some(pages),
            apr: Some(apr),
            queue: 10,
            word_clocks,
            assign: Assign::Each,
            costs: HASTY,
            ..small(views[0].size)
        };
        render_all(config, &views).frames.into_iter().flat_map(|frame| frame.processors).collect::<Vec<_>>()
    };
    let sending = processors(300, 0, 6);
    assert!(sending.iter().all(|it| it.broadcast > 100 && it.clocks.bus > 1000 && it.overflows == 0), "{sending:?}");
    let full = processors(40, 20, 1);
    assert!(full.iter().all(|it| it.overflows > 0 && it.clocks.receiving > 0), "{full:?}");
    let both = processors(30, 0, 1);
    assert!(both.iter().all(|it| it.broadcast > 100 && it.overflows > 0 && it.clocks.bus > 0), "{both:?}");
}

/// The model takes several clocks at once; with costs of nothing, and queues of one polygon and of many, it still goes as the circuit.
#[test]
fn polygons_that_all_draw_may_take_no_time_but_that_of_their_words() {
    let views = turning("star", Size::new(53, 36).unwrap(), 3, 25.0);
    for (set_up, receive, queue, word_clocks) in
        [(0, 3, 16, 3), (0, 1, 61, 1), (1, 2, 11, 2), (500, 1, 64, 6), (2, 7, 10, 1)]
    {
        let costs = CostTable { set_up, receive, row: 0, send: 1, ..HASTY };
        let config =
            Config { processors: 9, cluster: 5, apr: Some(0), queue, word_clocks, costs, ..small(views[0].size) };
        let report = render_all(config, &views);
        assert!(report.compared > 1000, "{}", report.compared);
    }
}

/// While frames are drawn in less than two refreshes of the paper's display, one comes every two (VC1-SW2): T_m is 1.52 of them.
#[test]
fn a_frame_comes_every_two_refreshes() {
    let views = turning("teapot", Size::new(80, 60).unwrap(), 6, 3.0);
    let config = Config { processors: 16, costs: HASTY, ..small(views[0].size) };
    let t_m = 80e-9 * merge_clocks(&config) as f64;
    let report = render_all(Config { refresh: 1.52 / t_m, ..config }, &views);
    let refreshes: Vec<u64> = report.frames.iter().map(|frame| frame.refreshes).collect();
    assert_eq!(refreshes[1..], [2; 5], "{report}");
}

#[test]
fn a_frame_that_is_not_accumulated_has_one_pass() {
    let projection = on_screen("star", 16, 12);
    let config = Config { processors: 1, refresh: 5000.0, ..Config::new(projection.size) };
    assert_eq!(render(config, &projection).expect("it renders").1.machine.passes, 1);
}

#[test]
fn a_report_is_the_same_on_every_run() {
    let projection = on_screen("ter1k", 48, 36);
    let config = Config { processors: 3, ..small(projection.size) };
    let (_, first) = render(config, &projection).expect("renders");
    let (_, second) = render(config, &projection).expect("renders");
    assert_eq!(first, second);
}

/// The paper's machine on the paper's scene: 4096 polygons, T_m of 25.3 ms (VC1-TM).
#[test]
fn the_machine_of_the_paper_draws_the_teapot() {
    let projection = on_screen("teapot", 640, 480);
    let (frame, report) = render(Config::new(projection.size), &projection).expect("4096 pages are enough");
    let comparison = against_golden(&frame, &projection);
    assert!(comparison.is_equal(), "{comparison}");
    assert_eq!(report.merge_clocks, 316_864);
    let frame = frame_of(&report);
    assert!(frame.processors.iter().all(|it| it.clocks.clearing == 3 * 19_200), "clearing the patch table");
    assert_eq!((frame.pixels(), frame.refreshes), (covered(&projection), 3));
    assert!(frame.balance() > 0.95, "{report}");
}

/// Its slab is far larger than an image memory, so that without adaptive parallel rasterization some processing element overflows.
#[test]
fn the_table_needs_more_pages_than_the_machine_of_the_paper_has() {
    let projection = on_screen("table", 640, 480);
    let config = Config::new(projection.size);
    let assignment = Assignment::new(&projection, config.processors, config.cluster, &config.costs);
    let most = |apr| {
        let demand = demand(&assignment, &projection.triangles, &config.patches().expect("4x4 fits"), apr);
        demand.iter().map(|it| it.pages).max().expect("16 processing elements")
    };
    assert_eq!(config.pages().expect("in range"), 4096);
    let (alone, together) = (most(None), most(Some(500)));
    assert!((6800..7300).contains(&alone) && together <= 2400, "{alone} {together}");
}

/// With fewer pages than it touches patches a processing element swaps on the way, and nothing is lost (VC1-SW4).
#[test]
fn overflows_leave_the_golden_frame() {
    let projection = on_screen("teapot", 80, 60);
    let config = Config { processors: 2, costs: HASTY, ..small(projection.size) };
    assert_eq!(config.sufficient_pages([projection.clone()]).expect("4x4 fits"), 120);
    let overflows = |pages| {
        let (frame, report) = render(Config { pages: Some(pages), ..config }, &projection).expect("it swaps");
        let comparison = against_golden(&frame, &projection);
        assert!(comparison.is_equal(), "{pages} pages: {comparison}");
        assert_eq!(frame_of(&report).pixels(), covered(&projection));
        frame_of(&report).processors.iter().map(|it| it.overflows).collect::<Vec<_>>()
    };
    assert_eq!(overflows(120), [0, 0]);
    assert!(overflows(119).iter().sum::<u64>() == 1);
    assert!(overflows(20).iter().all(|count| *count > 4));
}

#[test]
fn a_machine_that_cannot_be_is_refused_in_a_sentence() {
    let config = Config::new(Size::VGA);
    let refused = |config| Machine::new(config).err().expect("cannot be built").to_string();
    let costs = CostTable { pixel: 0, ..config.costs };
    let problems = [
        (Config { processors: 0, ..config }, "a VC-1 of 0 processing elements: it has to have from 1 to 256"),
        (Config { processors: 257, ..config }, "a VC-1 of 257 processing elements: it has to have from 1 to 256"),
        (Config { cluster: 0, ..config }, "clusters of 0 polygons: they have to have at least 1"),
        (Config { patch: 5, ..config }, "patches of 5 x 5 pixels: the edge has to be 4, 8 or 16"),
        (
            Config { costs, ..config },
            "a cost table with accesses in 0 clocks: a pixel, a cleared entry and a word take at least 1 each",
        ),
        (Config { queue: 9, ..config }, "receive queues of 9 words: they need space for a polygon, which has 10"),
    ];
    for (config, problem) in problems {
        assert_eq!(refused(config), problem);
    }
    let error = render(config, &on_screen("teapot", 80, 60)).expect_err("the sizes differ").to_string();
    assert_eq!(error, "a projection of 80x60 pixels on a machine of 640x480: project the scene again");
}

#[test]
fn progress_goes_through_the_phases_and_a_run_can_be_cancelled() {
    let projection = on_screen("teapot", 48, 36);
    let mut seen: Vec<Progress> = Vec::new();
    let mut progress = |it| seen.push(it);
    let machine = Machine::new(small(projection.size)).expect("can be built");
    let mut watch = Watch { progress: Some(&mut progress), cancel: None };
    machine.render(&projection, BACKGROUND, &mut watch).expect("renders");
    let mut phases: Vec<_> = seen.iter().map(|it| it.phase).collect();
    phases.dedup();
    assert_eq!(phases, ["drawing", "merging", "showing"]);
    for pair in seen.windows(2) {
        assert!(pair[0].phase != pair[1].phase || pair[0].fraction <= pair[1].fraction, "{pair:?}");
    }
    assert!(seen.iter().all(|it| (0.0..=1.0).contains(&it.fraction)));
    seen.dedup();
    let fractions = |phase| seen.iter().filter(|it| it.phase == phase).map(|it| it.fraction).collect::<Vec<_>>();
    // Every 1024 clocks: of T_m and of a refresh.
    assert!(fractions("merging").len() >= 7 && fractions("showing").len() >= 2, "{seen:?}");
    let drawing = fractions("drawing");
    assert!(drawing[0] == 0.0 && drawing.len() > 100 && drawing[drawing.len() / 2] > 0.3, "{drawing:?}");

    let machine = Machine::new(small(projection.size)).expect("can be built");
    let cancel = AtomicBool::new(true);
    let error = machine.render(&projection, BACKGROUND, &mut Watch { progress: None, cancel: Some(&cancel) });
    assert!(matches!(error, Err(Error::Cancelled { phase: "drawing", .. })));
}

/// The whole machine's waveform, cut down by name; the run is cancelled in the middle of the merge.
#[test]
fn a_cancelled_run_leaves_a_dump_that_opens() {
    let projection = on_screen("teapot", 48, 36);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("vc1.vcd");
    let config = Config { processors: 2, costs: HASTY, ..small(projection.size) };
    let mut machine = Machine::new(config).expect("can be built");
    machine
        .simulation()
        .trace(Vcd::to(&path).only("u_lfb[1].overflow").only("u_gfb.**.part*"))
        .expect("the signals exist");
    let cancel = AtomicBool::new(false);
    let mut progress = |it: Progress| cancel.store(it.phase == "merging" && it.fraction > 0.4, Ordering::Relaxed);
    let result =
        machine.render(&projection, BACKGROUND, &mut Watch { progress: Some(&mut progress), cancel: Some(&cancel) });
    let Err(Error::Cancelled { phase: "merging", time }) = result else { panic!("it was cancelled in the merge") };

    let text = std::fs::read_to_string(&path).expect("the dump exists");
    let mut parser = vcd::Parser::new(text.as_bytes());
    let header = parser.parse_header().expect("a header");
    let machine = &text[text.find("vc1_").expect("the machine's scope")..];
    let machine = machine.split_whitespace().next().expect("its name");
    assert!(header.find_var(&[machine, "u_lfb[1]", "lane", "overflow"]).is_some());
    let commands: Vec<_> = parser.collect::<Result<_, _>>().expect("a dump that is whole");
    let states = commands.iter().filter_map(|it| match it {
        vcd::Command::ChangeString(_, state) => Some(state.as_str()),
        _ => None,
    });
    assert_eq!(states.take(4).collect::<Vec<_>>(), ["Restart", "Prime", "Line", "Overhead"]);
    let end = commands.iter().rev().find_map(|it| match it {
        vcd::Command::Timestamp(time) => Some(*time),
        _ => None,
    });
    assert!(end >= Some(time), "the dump ends at {end:?}, the run at {time}");
}

/// Triangles anywhere, up to several of the same depth and place.
fn soup() -> impl Strategy<Value = Vec<[ScreenVertex; 3]>> {
    let position = -200..800_i32;
    let vertex = (position.clone(), position, 1..40_u32, 0..4_u8).prop_map(|(x, y, z, grey)| ScreenVertex {
        x,
        y,
        z,
        rgb: [grey * 80; 3],
    });
    prop::collection::vec([vertex.clone(), vertex.clone(), vertex], 0..24)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(48) })]

    #[test]
    fn any_triangles_make_the_golden_frame(
        soup in soup(), processors in 1..=5_u32, cluster in 1..4_u32, patch in prop::sample::select(vec![4_u32, 8, 16]),
    ) {
        let size = Size::new(37, 29).expect("in range");
        let projection = Projection::of_triangles(size, soup.iter().copied());
        let config = Config { processors, cluster, patch, costs: HASTY, ..small(size) };
        let (frame, report) = render(config, &projection).expect("there are pages for all patches");
        let comparison = against_golden(&frame, &projection);
        prop_assert!(comparison.is_equal(), "{}", comparison);
        prop_assert_eq!(frame_of(&report).pixels(), covered(&projection));
    }
}

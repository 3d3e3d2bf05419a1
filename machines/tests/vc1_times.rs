//! When the VC-1 swaps: the times of frames, overflows and pictures on screens much smaller than the paper's, with the paper's ratio of
//! T_m to a refresh (VC1-TM, VC1-33, VC1-SW4, VC1-ACB).

use tilewright_machines::Watch;
use tilewright_machines::vc1::{Assign, Config, CostTable, Cursor, FrameReport, Machine, Report, Shown};
use tilewright_rtl::gfb::Passes;
use tilewright_scenes::{Frame, Projection, Scene, ScreenVertex, Size, compare, golden, project, project_sample};

use crate::vc1::merge_clocks;
use crate::vc1_campaign::BACKGROUND;

/// T_m of the paper in its refreshes: 25.349 ms in 16.667 ms.
const RATIO: f64 = 1.521;

/// Programs that compute next to nothing.
const QUICK: CostTable =
    CostTable { vertex: 0, polygon: 0, area: 0, clip: 0, set_up: 0, row: 0, pixel: 1, clear: 1, send: 1, receive: 1 };

/// Two processing elements, the polygons dealt in turn, and each drawn by its own.
fn two(size: Size) -> Config {
    let config =
        Config { processors: 2, cluster: 1, assign: Assign::Count, apr: None, costs: QUICK, ..Config::new(size) };
    Config { refresh: RATIO / t_m(&config), ..config }
}

/// T_m in seconds.
fn t_m(config: &Config) -> f64 {
    80e-9 * merge_clocks(config) as f64
}

/// A frame for two. Each draws a triangle of a patch, which is clipped at the border if `is_clipped`, and a bar of so many patches and
/// one row.
fn bars(size: Size, is_clipped: bool, patches: [u32; 2]) -> Projection {
    let at = |x: i32, y: i32| ScreenVertex { x: 16 * x + 4, y: 16 * y - 8, z: 5, rgb: [200, 100, 50] };
    let left = if is_clipped { -2 } else { 1 };
    let small = [at(left, 41), at(3, 41), at(3, 43)];
    let bar = |row: i32, patches: u32| {
        let right = 4 * patches as i32;
        [[at(0, row), at(right, row), at(right, row + 1)], [at(0, row), at(right, row + 1), at(0, row + 1)]]
    };
    let [[a, b], [c, d]] = [bar(1, patches[0]), bar(9, patches[1])];
    Projection::of_triangles(size, [small, small, a, c, b, d])
}

/// Draws a frame of each view; all have to be golden.
fn render_all(config: Config, views: &[Projection]) -> (Report, Vec<Frame>) {
    let (mut next, mut frames) = (views.iter().cloned(), Vec::new());
    let seen = |shown: Shown| {
        let view = &views[shown.number as usize];
        let mut expected = golden::render(view.size, &view.triangles, BACKGROUND);
        if let Some(cursor) = config.cursor {
            cursor.draw(&mut expected);
        }
        let comparison = compare(&shown.frame, &expected);
        assert!(comparison.is_equal(), "frame {}: {comparison}", shown.number);
        frames.push(shown.average.unwrap_or(shown.frame));
        true
    };
    let machine = Machine::new(config).expect("can be built").judging_every_refresh();
    let report = machine.render_frames(BACKGROUND, &mut Watch::default(), || next.next(), seen).expect("renders");
    (report, frames)
}

/// The refreshes from frame to frame.
fn refreshes(report: &Report) -> Vec<u64> {
    report.frames.iter().map(|frame| frame.refreshes).collect()
}

/// For how many refreshes a processing element waited for the swap of its only overflow in a frame.
fn idle(frame: &FrameReport, processor: usize, config: &Config) -> f64 {
    let of = &frame.processors[processor];
    assert_eq!(of.overflows, 1, "{frame:?}");
    of.clocks.overflow as f64 * 25e-9 * config.refresh
}

/// A frame comes every 2 refreshes; with an overflow every 4, as 2 T_m is more than 3; with two every 5.
#[test]
fn overflows_take_two_refreshes_more_and_then_one() {
    let size = Size::new(64, 48).unwrap();
    let of = |pages| {
        let (report, _) = render_all(Config { pages: Some(pages), ..two(size) }, &vec![bars(size, false, [8, 1]); 6]);
        let overflows: Vec<u64> = report.frames.iter().map(|frame| frame.overflows()).collect();
        (overflows[0], refreshes(&report).split_off(2))
    };
    for (pages, overflows, expected) in [(9, 0, 2), (5, 1, 4), (3, 2, 5)] {
        assert_eq!(of(pages), (overflows, vec![expected; 4]), "{pages} pages");
    }
}

/// If the frame before was swapped in a blanking, an overflow waits for two refreshes at most: 33.3 ms.
#[test]
fn an_overflow_behind_a_swap_in_a_blanking_waits_for_two_refreshes() {
    let size = Size::new(64, 48).unwrap();
    let config = Config { pages: Some(2), ..two(size) };
    let views = [1, 1, 1, 1, 3].map(|patches| bars(size, false, [patches, 1]));
    let (report, _) = render_all(config, &views);
    let idle = idle(&report.frames[4], 0, &config);
    assert!((1.8..2.0).contains(&idle), "{idle}");
}

/// The longest that the overflow of a processing element waits in the second of these frames, where the first one is drawn at any time
/// of a refresh.
fn longest_idle(views: &[Projection], processor: usize) -> f64 {
    let waits = (0..8500).step_by(500).map(|clip| {
        let config = Config { pages: Some(2), costs: CostTable { clip, ..QUICK }, ..two(views[0].size) };
        let (report, _) = render_all(config, views);
        idle(&report.frames[1], processor, &config)
    });
    waits.fold(0.0, f64::max)
}

/// If all swapped together, an overflow waits for T_m and a refresh at most: 42.0 ms.
#[test]
fn an_overflow_behind_a_common_swap_waits_for_t_m_and_a_refresh() {
    let size = Size::new(64, 48).unwrap();
    let longest = longest_idle(&[bars(size, true, [1, 1]), bars(size, false, [3, 1])], 0);
    let most = RATIO + 1.0;
    assert!((0.9 * most..most).contains(&longest), "{longest} of {most}");
}

/// If another one overflowed late in the frame before, and so holds its own swap back, an overflow waits for 2 T_m and a refresh at
/// most: 67.4 ms (R10).
#[test]
fn an_overflow_behind_a_late_one_waits_for_twice_t_m_and_a_refresh() {
    let size = Size::new(64, 48).unwrap();
    let longest = longest_idle(&[bars(size, true, [3, 1]), bars(size, false, [1, 3])], 1);
    let most = 2.0 * RATIO + 1.0;
    assert!((0.9 * most..most).contains(&longest), "{longest} of {most}");
}

/// A picture of n passes takes 2 n + 1 refreshes, and is the average of its passes (VC1-ACB).
#[test]
fn pictures_of_several_passes_take_twice_as_many_refreshes_and_one() {
    let size = Size::new(64, 48).unwrap();
    let scene = Scene::builtin("teapot").unwrap();
    for passes in [Passes::Two, Passes::Four, Passes::Eight, Passes::Sixteen] {
        let shifts = golden::pass_shifts(passes.count()).unwrap();
        let picture: Vec<Projection> =
            shifts.iter().map(|shift| project_sample(&scene, size, *shift).unwrap()).collect();
        let config = Config { processors: 16, accumulate: Some(passes), assign: Assign::Once, ..two(size) };
        let config = Config { refresh: RATIO / t_m(&config), ..config };
        let (report, frames) = render_all(config, &[picture.clone(), picture.clone(), picture.clone()].concat());
        let n = passes.count() as usize;
        // The first picture waits for the first frame to be drawn.
        let later: Vec<u64> = refreshes(&report)[n..].chunks(n).map(|picture| picture.iter().sum()).collect();
        assert_eq!(later, [2 * n as u64 + 1; 2], "{report}");
        let golden: Vec<Frame> = picture.iter().map(|view| golden::render(size, &view.triangles, BACKGROUND)).collect();
        for average in frames.chunks(n).map(|picture| &picture[n - 1]) {
            assert!(compare(average, &golden::average(&golden)).is_equal());
        }
        assert!(frames[n - 1] != golden[n - 1], "the passes differ");
    }
}

/// The host writes it into each frame on display, and the next one has nothing of it (VC1-HOSTP).
#[test]
fn a_cursor_is_shown_and_gone_in_the_next_frame() {
    let size = Size::new(64, 48).unwrap();
    let views = [[8, 1], [1, 8], [8, 8]].map(|patches| bars(size, false, patches));
    let (report, frames) = render_all(Config { cursor: Some(Cursor { x: 60, y: 20 }), ..two(size) }, &views);
    assert!(report.judged > 3);
    for frame in frames {
        let is_white = |word: &&u64| **word == 0xff_ffff;
        assert_eq!(frame.words.iter().filter(is_white).count(), 4 * 8, "what is on the screen of it");
    }
}

/// In immediate mode the scene goes over the bus before each command, a word in 6 clocks (VC1-IMM, VC1-NET).
#[test]
fn a_scene_can_be_sent_with_each_frame() {
    let scene = Scene::builtin("star").unwrap();
    let size = Size::new(64, 48).unwrap();
    let view = project(&scene, size).unwrap();
    let drawn = |immediate| {
        let (report, _) = render_all(Config { immediate, ..two(size) }, &[view.clone(), view.clone()]);
        let [first, second] = &report.frames[..] else { panic!("two frames") };
        assert_eq!(first.words, second.words);
        let time = |frame: &FrameReport| frame.times.drawn.unwrap() - frame.times.command;
        (report.load_words, first.words, time(first), time(second))
    };
    let (load, once, before, _) = drawn(false);
    assert_eq!(once, 20);
    let (same, words, first, second) = drawn(true);
    assert_eq!((same, words), (load, 20 + load + load.div_ceil(1023)));
    let sending = (words - once) * 6 * 25_000;
    // The tables are cleared in the meantime.
    assert!(first.abs_diff(before + sending) < 10_000_000, "{first} {before} {sending}");
    assert!(second > sending);
}

//! The way of a pixel through a machine: nothing differs on right hardware, and it has what the frame has.

use tilewright_machines::{Follower, Recorder, Step, Watch, Way, pixel_planes, pixelflow, quadtree, vc1};
use tilewright_scenes::deferred::{Samples, project_deferred};
use tilewright_scenes::frame::{blank, depth_of};
use tilewright_scenes::{Frame, Scene, Size, project, project_polygons};

fn size() -> Size {
    Size::new(16, 12).expect("in range")
}

/// Pixels that two primitives cover, one, and none, in a scene of the built-in star.
const PIXELS: [[u32; 2]; 3] = [[8, 6], [5, 4], [0, 0]];

/// No step differs, the primitives are those of the frame, and the last word is the frame's.
fn check(way: &Way, frame: &Frame, [x, y]: [u32; 2], background: [u8; 3]) {
    assert_eq!(way.first_difference(), None);
    assert!(way.steps.is_sorted_by_key(|step| step.time));
    let word = frame.word(x, y);
    let winner = way.primitives.iter().find(|it| it.wins);
    assert_eq!(winner.and_then(|it| it.hardware), Some(word).filter(|it| *it != blank(background)));
    assert!(way.primitives.iter().all(|it| it.golden == it.hardware), "{:?}", way.primitives);
    let shown = way.steps.last().and_then(|step| step.values.last()).expect("the display's step");
    assert!(format!("{word:012x}").ends_with(&shown.hardware), "{word:x} {shown:?}");
}

#[test]
fn a_vc1_tells_it_with_few_pages_and_with_polygons_over_the_bus() {
    let scene = Scene::builtin("star").expect("a built-in scene");
    let projection = project(&scene, size()).expect("it can be set up");
    let usual = vc1::Config { processors: 2, cluster: 1, refresh: 5000.0, ..vc1::Config::new(size()) };
    for (number, config) in [vc1::Config { apr: Some(10), ..usual }, vc1::Config { pages: Some(3), apr: None, ..usual }]
        .into_iter()
        .enumerate()
    {
        let mut overflows = 0;
        for pixel in &PIXELS[..2 - number] {
            let follower = Follower::new(*pixel);
            let machine = vc1::Machine::new(config).expect("in range").following(&follower);
            let (frame, report) =
                machine.render(&projection, scene.background, &mut Watch::default()).expect("it renders");
            check(&follower.take().expect("a way"), &frame, *pixel, scene.background);
            overflows += report.frames[0].processors.iter().map(|it| it.overflows).sum::<u64>();
        }
        assert_eq!(overflows > 0, number == 1);
    }
}

#[test]
fn a_generator_of_each_form_tells_it() {
    let scene = Scene::builtin("star").expect("a built-in scene");
    let packets = project_polygons(&scene, size()).expect("it can be set up").polygons;
    let usual = quadtree::Config { matrix: (2, 2), ..quadtree::Config::for_packets(size(), &packets) };
    let serial = quadtree::Test::Serial;
    for (config, pixel) in [
        (quadtree::Config { form: "stack:1+pipe".to_owned(), ..usual.clone() }, PIXELS[0]),
        (quadtree::Config { form: "tree".to_owned(), aperture: 2, ..usual.clone() }, PIXELS[1]),
        (quadtree::Config { form: "stack".to_owned(), test: serial, strict: true, ..usual.clone() }, PIXELS[0]),
        (usual, PIXELS[2]),
    ] {
        let follower = Follower::new(pixel);
        let mut machine = quadtree::Machine::new(config).expect("in range").following(&follower);
        // A second frame is in the other bank.
        for _ in 0..2 {
            let (frame, _) = machine.render(&packets, scene.background, &mut Watch::default()).expect("it renders");
            let way = follower.take().expect("a way");
            let [x, y] = pixel;
            assert!(way.primitives.iter().all(|it| it.golden.is_some_and(|word| depth_of(word) >= frame.depth(x, y))));
            check(&way, &frame, pixel, scene.background);
        }
    }
}

/// How often units do something.
fn times(way: &Way, does: &str) -> usize {
    way.steps.iter().filter(|step| step.does.starts_with(does)).count()
}

/// The hardware's value of that name in the first step that does so.
fn told<'a>(way: &'a Way, does: &str, what: &str) -> Option<&'a str> {
    let step = way.steps.iter().find(|step| step.does.starts_with(does))?;
    step.values.iter().find(|it| it.what == what).map(|it| it.hardware.as_str())
}

#[test]
fn each_unit_of_a_vc1_tells_its_part_once_a_scan() {
    let scene = Scene::builtin("star").expect("a built-in scene");
    let projection = project(&scene, size()).expect("it can be set up");
    let config = vc1::Config { processors: 3, apr: Some(10), cluster: 1, refresh: 5000.0, ..vc1::Config::new(size()) };
    let follower = Follower::new([8, 6]);
    let machine = vc1::Machine::new(config).expect("in range").following(&follower);
    machine.render(&projection, scene.background, &mut Watch::default()).expect("it renders");
    let way = follower.take().expect("a way");
    assert_eq!(way.first_difference(), None);
    // The scan before the frame, and the frame's.
    let scans = 2;
    assert_eq!(times(&way, "stores the pixel"), scans);
    for number in 0..3 {
        let is_its = |unit: &str| way.steps.iter().filter(|step| step.unit == unit).count();
        assert_eq!(is_its(&format!("merging unit {number}")), scans, "{number}");
        // Before the frame, no patch has a page.
        assert_eq!(
            is_its(&format!("patch table of PE {number}")) > 0,
            is_its(&format!("image memory of PE {number}")) > 0,
            "{number}"
        );
    }
    assert_eq!(times(&way, "sends the pixel and clears it"), times(&way, "finds the page of patch 6 for the scan"));
    assert_eq!(times(&way, "rises when all have drawn"), 1);
    // Wires are told only if they bring something else.
    assert_eq!((times(&way, "passes the"), times(&way, "brings the")), (0, 0));
}

#[test]
fn steps_of_a_generator_have_their_packet_their_sample_and_their_clock() {
    let scene = Scene::builtin("star").expect("a built-in scene");
    let packets = project_polygons(&scene, size()).expect("it can be set up").polygons;
    // More edges than any packet has; and a pixel of an odd column and line.
    let config = quadtree::Config { matrix: (2, 2), edges: 6, ..quadtree::Config::for_packets(size(), &packets) };
    let (follower, recorder) = (Follower::new([7, 5]), Recorder::default());
    let mut machine = quadtree::Machine::new(config).expect("in range").following(&follower).recorded(&recorder);
    machine.render(&packets, scene.background, &mut Watch::default()).expect("it renders");
    let (way, history) = (follower.take().expect("a way"), recorder.take().expect("a frame was rendered"));
    assert_eq!(way.first_difference(), None);
    let of_packets = || way.steps.iter().filter(|step| step.does.starts_with("brings the packet"));
    assert!(of_packets().count() > 1);
    for step in of_packets() {
        assert_eq!(Some(step.values[0].hardware.clone()), step.primitive.map(|it| it.to_string()));
    }
    assert_eq!(told(&way, "asks for the pixel's group", "sample"), Some("3,2"));
    // The video buffer takes the pixel in the clock that the history has.
    let written: Vec<u64> = history.writes.iter().filter(|it| it.pixel == 5 * 16 + 7).map(|it| it.time).collect();
    // A step is told at the end of the buffer's second clock with the fragment.
    let drawn =
        way.steps.iter().filter(|step| step.does.starts_with("draws the fragment")).map(|step| step.time - 20_000);
    assert_eq!(drawn.collect::<Vec<_>>(), written);
}

#[test]
fn a_renderer_tells_the_word_that_it_writes_and_what_an_instruction_changes() {
    let scene = Scene::builtin("star").expect("a built-in scene");
    let size = Size::new(32, 24).expect("in range");
    let polygons = project_polygons(&scene, size).expect("it can be set up");
    let follower = Follower::new([16, 12]);
    let config = pixel_planes::Config { renderers: 2, side: 16, ..pixel_planes::Config::new(size) };
    let machine = pixel_planes::Machine::new(config).expect("in range").following(&follower);
    let (frame, _) = machine.render(&polygons, scene.background, &mut Watch::default()).expect("it renders");
    let way = follower.take().expect("a way");
    let word = format!("{:x}", frame.word(16, 12));
    for does in ["has sent the pixel's planes", "writes the pixel's word", "reads the pixel's word"] {
        assert_eq!(told(&way, does, "word").map(|it| it.trim_start_matches('0')), Some(&*word), "{does}");
    }
    let whats = |does: &str| {
        let step = way.steps.iter().find(|step| step.block == "pixel-processor" && step.does == does);
        step.unwrap_or_else(|| panic!("{does}")).values.iter().map(|it| it.what).collect::<Vec<_>>()
    };
    assert_eq!([whats("does Fill"), whats("does Test")], [["word"], ["enable"]]);
    assert_eq!(whats("does CompareOn"), ["flag", "word"]);
}

/// The way of a pixel through a PixelFlow of four nodes, and the report.
fn through_a_pixelflow(pixel: [u32; 2]) -> (Way, pixelflow::Report) {
    let scene = Scene::builtin("textured").expect("a built-in scene");
    let deferred = project_deferred(&scene, size(), Samples::One).expect("it can be set up");
    let follower = Follower::new(pixel);
    let config = pixelflow::Config { nodes: 4, shaders: 1, array: [8, 8], ..pixelflow::Config::new(size()) };
    let machine = pixelflow::Machine::new(config).expect("in range").following(&follower);
    let (_, report) = machine.render(&deferred, &mut Watch::default()).expect("it renders");
    (follower.take().expect("a way"), report)
}

#[test]
fn a_pixel_of_a_pixelflow_is_inside_of_what_wins_and_is_compared_once() {
    let (way, report) = through_a_pixelflow([8, 6]);
    let winner = way.primitives.iter().find(|it| it.wins).expect("something is there").number;
    let its = || way.steps.iter().filter(|step| step.primitive == Some(winner));
    let mut sides = its().filter(|step| step.does == "evaluates an edge").flat_map(|step| &step.values).peekable();
    assert!(sides.peek().is_some() && sides.all(|it| it.hardware == "inside"));
    let has_flag = |step: &&Step| step.block == "pixelflow-pixel" && step.values.iter().any(|it| it.what == "flag");
    assert_eq!(its().filter(has_flag).count(), 1);
    // Its colour is taken while a region is loaded.
    let takes = way.steps.iter().find(|step| step.does == "takes the pixel's colour").expect("it is taken");
    assert!(report.turns.iter().any(|turn| turn.loaded.contains(&(takes.time / 5000))), "{}", takes.time);
}

#[test]
fn a_pixelflow_displays_a_pixel_a_clock() {
    for (number, pixel) in [(104, [8, 6]), (3, [3, 0]), (191, [15, 11]), (0, [0, 0])] {
        let (way, report) = through_a_pixelflow(pixel);
        let shows = way.steps.iter().find(|step| step.does == "displays the pixel").expect("it is displayed");
        // The scan begins 11 clocks after the last region is loaded.
        assert_eq!(shows.cycle, report.turns.last().expect("regions").loaded.end / 2 + 11 + number, "{pixel:?}");
    }
}

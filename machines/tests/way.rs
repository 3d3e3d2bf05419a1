//! The way of a pixel through a machine: nothing differs on right hardware, and it has what the frame has.

use tilewright_machines::{Follower, Watch, Way, quadtree, vc1};
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

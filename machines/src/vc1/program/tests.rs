use super::*;
use crate::vc1::assignment::{Assign, Assignment, Polygon};
use crate::vc1::clocks::Clocks;
use crate::vc1::config::Config;
use tilewright_scenes::{Counts, Projection, Scene, ScreenVertex, project, set_up};

/// A task from its beginning to its end, with those that it begins and without words from the bus: clocks, class, and what stands at a
/// port.
fn steps(task: Task, settings: &Settings) -> Vec<(u64, Class, Option<Access>)> {
    let (mut tasks, mut steps) = (vec![task], Vec::new());
    let sight = Sight { word: false, may: SwapState::Draw };
    while let Some(task) = tasks.last_mut() {
        match task.next(&sight, settings) {
            Next::Step { clocks: 0, access: None, .. } => {}
            Next::Step { clocks, class, access } => steps.push((clocks, class, access)),
            Next::Begin(task) => tasks.push(task),
            Next::End => drop(tasks.pop()),
            Next::Wait => unreachable!("only the first task waits"),
        }
    }
    steps
}

fn drawing(view: Arc<View>) -> Task {
    Task::Polygons(Polygons { view, polygon: 0, is_transformed: false, rest: 0..0 })
}

fn at(x: i32, y: i32) -> ScreenVertex {
    ScreenVertex { x, y, z: 1, rgb: [0; 3] }
}

/// Three polygons on a screen of 8 x 8: a triangle of 3 pixels, in a box of 3 rows of which the last has none; a polygon without
/// packets; a triangle of 1 pixel. The first has three vertices, the last one more and a packet that crosses the border.
fn view() -> Arc<View> {
    let size = Size::new(8, 8).unwrap();
    let vertices = [[at(0, 0), at(40, 0), at(0, 40)], [at(0, 48), at(20, 48), at(0, 68)]];
    let polygons = [(0, 0..1, 3, 0), (1, 1..1, 0, 0), (2, 1..2, 1, 1)]
        .map(|(number, packets, vertices, clipped)| Polygon { number, packets, vertices, clipped });
    Arc::new(View {
        assignment: Assignment { polygons: vec![polygons.to_vec()], loads: vec![0] },
        projection: Arc::new(Projection {
            size,
            triangles: vertices.iter().map(|vertices| set_up(vertices, size).expect("covers pixels")).collect(),
            vertices: vertices.to_vec(),
            corners: Vec::new(),
            counts: Counts::default(),
        }),
    })
}

const COSTS: CostTable = CostTable {
    vertex: 1_000_000,
    polygon: 20_000_000,
    area: 10_000,
    clip: 500_000,
    set_up: 1000,
    row: 100,
    pixel: 5,
    clear: 3,
    send: 7,
    receive: 9,
};

fn settings() -> Settings {
    let size = Size::new(8, 8).unwrap();
    Settings { number: 0, processors: 1, size, patches: 2, costs: COSTS, apr: None }
}

#[test]
fn every_clock_of_the_cost_table_is_charged_once() {
    use Class::*;
    let clear = |patch| (3, Clearing, Some(Access::Clear(patch)));
    assert_eq!(steps(Task::Clear { patch: 0 }, &settings()), [clear(0), clear(1)]);
    let all = steps(drawing(view()), &settings());
    let shown: Vec<_> = all.iter().map(|(clocks, class, access)| (*clocks, *class, access.is_some())).collect();
    let expected = [
        (23_000_000, Geometry, false),
        (10_000, Rasterization, false),
        (1105, Rasterization, true),
        (5, Rasterization, true),
        (105, Rasterization, true),
        (100, Rasterization, false),
        (20_000_000, Geometry, false),
        (10_000, Rasterization, false),
        (21_000_000, Geometry, false),
        (510_000, Rasterization, false),
        (1105, Rasterization, true),
    ];
    assert_eq!(shown, expected);
}

/// The first packet has 2.9 pixels, the other one 0.5 (VC1-APR). Its words go to all, and each draws its rows.
#[test]
fn a_packet_above_the_threshold_is_sent_and_drawn_in_shares() {
    let settings = Settings { apr: Some(2), processors: 2, ..settings() };
    let sent = steps(drawing(view()), &settings);
    let words: Vec<u32> = sent
        .iter()
        .filter_map(|(clocks, class, access)| match access {
            Some(Access::Send(word)) => {
                assert_eq!((*clocks, *class), (7, Class::Sending));
                Some(word.word)
            }
            _ => None,
        })
        .collect();
    let Some(Message::Polygon { sender: 0, vertices }) = Message::of_words(&words) else { panic!("{words:?}") };
    assert_eq!(vertices, view().projection.vertices[0]);
    let drawn = |steps: &[(u64, Class, Option<Access>)]| {
        let pixels = steps.iter().filter_map(|(.., access)| match access {
            Some(Access::Draw(pixel)) => Some((pixel.x, pixel.y)),
            _ => None,
        });
        pixels.collect::<Vec<_>>()
    };
    assert_eq!(drawn(&sent), [(0, 3)], "the small one it draws by itself");
    let packet = set_up(&vertices, settings.size).expect("covers pixels");
    let share = |number| steps(Task::share(&packet, &Settings { number, ..settings }), &settings);
    assert_eq!([share(0), share(1)].map(|steps| drawn(&steps)), [vec![(0, 0), (1, 0)], vec![(0, 1)]]);
    // Set-up is of all, rows are shared: rows 0 and 2 of the box, and row 1.
    let clocks = |number| share(number).iter().map(|(clocks, ..)| clocks).sum::<u64>();
    assert_eq!([clocks(0), clocks(1)], [1000 + 200 + 10, 1000 + 100 + 5]);
}

/// The views of ter1k that Table 1 averages, 7.5 degrees apart (VC1-T1).
fn views() -> Vec<Projection> {
    let mut scene = Scene::builtin("ter1k").expect("a built-in scene");
    let camera = scene.camera;
    let view = |number: u32| {
        scene.camera = camera.orbited(7.5 * f64::from(number));
        project(&scene, scene.size).expect("the terrain is in sight")
    };
    (0..48).map(view).collect()
}

/// What the program of each processing element takes, cleared tables apart, without packets that all draw.
fn works(config: &Config, first: Option<&Assignment>, view: &Projection) -> Vec<Clocks> {
    let size = config.size;
    let view = Arc::new(View::new(config, Arc::new(view.clone()), first).unwrap());
    let work = |number| {
        let Config { processors, costs, .. } = *config;
        let settings = Settings { number, processors, size, patches: 0, costs, apr: None };
        let mut clocks = Clocks::default();
        steps(drawing(view.clone()), &settings).into_iter().for_each(|(count, class, _)| *clocks.of(class) += count);
        clocks
    };
    (0..config.processors).map(work).collect()
}

/// Milliseconds at 40 MHz for which a processing element waits for the last one, as a mean over all of them and all views.
fn waiting(config: &Config, views: &[Projection], first: usize) -> f64 {
    let first = config.assignment(&views[first], None).expect("the first");
    let clocks = |view: &Projection| {
        let each: Vec<u64> = works(config, Some(&first), view).iter().map(Clocks::total).collect();
        let last = each.iter().max().copied().unwrap_or_default();
        each.iter().map(|clocks| last - clocks).sum::<u64>()
    };
    let all = views.iter().map(clocks).sum::<u64>() as f64;
    all / (views.len() * config.processors as usize) as f64 / 40_000.0
}

#[test]
fn ter1k_takes_the_clocks_of_table_1() {
    let (mut clocks, mut polygons) = (Clocks::default(), 0);
    for view in views() {
        let config = Config::new(view.size);
        for of in works(&config, None, &view) {
            clocks += of;
        }
        polygons += view.counts.polygons;
    }
    let each = [clocks.geometry, clocks.rasterization].map(|clocks| clocks as f64 / f64::from(polygons));
    assert_eq!(each.map(f64::round), [631.0, 754.0], "{each:?}");
}

/// The figures of [`crate::vc1::assignment`].
#[test]
#[ignore = "50 times 48 views of a terrain"]
fn each_way_of_dealing_has_its_waiting_time() {
    let views = views();
    let of = |assign, first| waiting(&Config { assign, ..Config::new(views[0].size) }, &views, first);
    let (each, count) = (of(Assign::Each, 0), of(Assign::Count, 0));
    let mut once: Vec<f64> = (0..views.len()).map(|first| of(Assign::Once, first)).collect();
    print!("each {each:.2} ms, count {count:.2} ms, once {:.2} ms from the first view, ", once[0]);
    once.sort_by(f64::total_cmp);
    let mean = once.iter().sum::<f64>() / once.len() as f64;
    println!("from any view {:.2} to {:.2} ms, {mean:.2} ms as a mean", once[0], once[once.len() - 1]);
    let shown = [each, count, once[0], mean, once[once.len() - 1]].map(|it| format!("{it:.2}"));
    assert_eq!(shown, ["0.62", "1.01", "1.17", "1.68", "2.46"]);
}

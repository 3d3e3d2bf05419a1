//! The judge of ways: for mutants of a machine's hardware that change a frame, whether the first difference on the way of the first wrong pixel
//! is at the mutated block.
//!
//! `cargo run -p tilewright-machines --features mutation --example judge -- MACHINE [COUNT] [SEED]`: the mutants of a module that is chosen at
//! random, until COUNT of them change the frame. Each is rendered in a process of its own, as some never end.

use std::collections::BTreeMap;
use std::io::Read;
use std::process::{Command, ExitCode, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use tilewright_hdl::{Block, Design, elaborate};
use tilewright_machines::{Error, Follower, Watch, pixel_planes, pixelflow, quadtree, vc1};
use tilewright_mutants::{Mutant, VARIABLE, block, mutants};
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::pixelflow::frame_buffer::FrameBuffer;
use tilewright_rtl::pixelflow::network::Network;
use tilewright_rtl::pixelflow::texture_memory::TextureMemory;
use tilewright_rtl::pixelflow::texture_unit::TextureUnit;
use tilewright_scenes::deferred::{Deferred, Samples, project_deferred};
use tilewright_scenes::golden::{Rule, render_deferred, render_polygons};
use tilewright_scenes::{Frame, Scene, Size, project_polygons};

/// The seconds after which a rendering is stopped.
const PATIENCE: u64 = 40;

/// A machine with a small frame: one with the follower that it gets, rendered; the right one; and the designs that it simulates.
struct Subject {
    name: &'static str,
    render: fn(Option<&Follower>) -> Result<Frame, Error>,
    golden: fn() -> Frame,
    designs: fn() -> Vec<Design>,
}

const SUBJECTS: [Subject; 5] = [shared::SUBJECT, tree::SUBJECT, planes::SUBJECT, spheres::SUBJECT, flow::SUBJECT];

/// Types of blocks whose names in the catalogue are others, with their machine.
const NAMES: [(&str, &str, &str); 11] = [
    ("vc1", "SwapControl", "vc1-swap"),
    ("vc1", "Arbiter", "round-robin-arbiter"),
    ("quadtree", "SetUp", "quadtree-set-up"),
    ("quadtree", "Stack", "quadtree-stack"),
    ("quadtree", "Pipe", "quadtree-pipe"),
    ("quadtree", "Tree", "quadtree-tree"),
    ("quadtree", "PixelProcessor", "quadtree-pixel"),
    ("quadtree", "Arbiter", "round-robin-arbiter"),
    ("pixelflow", "PixelProcessor", "pixelflow-pixel"),
    ("pixelflow", "FrameBuffer", "pixelflow-frame-buffer"),
    ("pixel-planes-5-spheres", "Renderer", "quadratic-renderer"),
];

fn design<B: Block>(block: &B) -> Design {
    elaborate(block).expect("the machine's blocks can be built")
}

mod shared {
    use super::*;
    use tilewright_scenes::{golden, project};

    pub const SUBJECT: Subject = Subject { name: "vc1", render, golden, designs };

    fn scene() -> (Scene, vc1::Config) {
        let (scene, size) = (Scene::builtin("star").expect("a built-in scene"), Size::new(32, 24).expect("in range"));
        let config =
            vc1::Config { processors: 3, apr: Some(20), cluster: 2, refresh: 5000.0, ..vc1::Config::new(size) };
        (scene, config)
    }

    fn render(follower: Option<&Follower>) -> Result<Frame, Error> {
        let (scene, config) = scene();
        let projection = project(&scene, config.size).expect("in front");
        let machine = vc1::Machine::new(config)?;
        let machine = match follower {
            Some(follower) => machine.following(follower),
            None => machine,
        };
        machine.render(&projection, scene.background, &mut Watch::default()).map(|(frame, _)| frame)
    }

    fn golden() -> Frame {
        let (scene, config) = scene();
        let projection = project(&scene, config.size).expect("in front");
        golden::render(config.size, &projection.triangles, scene.background)
    }

    fn designs() -> Vec<Design> {
        vec![design(&scene().1.hardware().expect("a machine"))]
    }
}

mod tree {
    use super::*;
    use tilewright_scenes::{Polygon, golden};

    pub const SUBJECT: Subject = Subject { name: "quadtree", render, golden, designs };

    fn scene() -> (Scene, Vec<Polygon>, quadtree::Config) {
        let (scene, size) = (Scene::builtin("star").expect("a built-in scene"), Size::new(32, 24).expect("in range"));
        let packets = project_polygons(&scene, size).expect("in front").polygons;
        let usual = quadtree::Config::for_packets(size, &packets);
        let config = quadtree::Config { matrix: (2, 2), form: "stack:1+pipe:2+tree:1".to_owned(), ..usual };
        (scene, packets, config)
    }

    fn render(follower: Option<&Follower>) -> Result<Frame, Error> {
        let (scene, packets, config) = scene();
        let machine = quadtree::Machine::new(config)?;
        let mut machine = match follower {
            Some(follower) => machine.following(follower),
            None => machine,
        };
        machine.render(&packets, scene.background, &mut Watch::default()).map(|(frame, _)| frame)
    }

    fn golden() -> Frame {
        let (scene, packets, config) = scene();
        golden::render(config.size, &packets, scene.background)
    }

    fn designs() -> Vec<Design> {
        vec![design(&scene().2.generator().expect("a generator"))]
    }
}

mod planes {
    use super::*;

    pub const SUBJECT: Subject = Subject { name: "pixel-planes-5", render, golden, designs };
    const SCENE: &str = "star";

    fn scene() -> (Scene, Size, pixel_planes::Config) {
        let (scene, size) = (Scene::builtin(SCENE).expect("a built-in scene"), Size::new(32, 24).expect("in range"));
        let config = pixel_planes::Config { renderers: 2, side: 16, ..pixel_planes::Config::new(size) };
        (scene, size, config)
    }

    fn render(follower: Option<&Follower>) -> Result<Frame, Error> {
        let (scene, size, config) = scene();
        let polygons = project_polygons(&scene, size).expect("in front");
        let machine = pixel_planes::Machine::new(config)?;
        let machine = match follower {
            Some(follower) => machine.following(follower),
            None => machine,
        };
        machine.render(&polygons, scene.background, &mut Watch::default()).map(|(frame, _)| frame)
    }

    fn golden() -> Frame {
        let (scene, size, _) = scene();
        render_polygons(&project_polygons(&scene, size).expect("in front"), Rule::Least, scene.background)
    }

    fn designs() -> Vec<Design> {
        let (_, _, config) = scene();
        vec![design(&config.renderer().expect("a renderer")), design(&config.frame_buffer().expect("a frame buffer"))]
    }
}

mod spheres {
    use super::*;
    use tilewright_scenes::sphere::Sphere;
    use tilewright_scenes::{Mesh, Polygons};

    pub const SUBJECT: Subject = Subject { name: "pixel-planes-5-spheres", render, golden, designs };

    fn scene() -> (Polygons, pixel_planes::Config) {
        let size = Size::new(32, 24).expect("in range");
        let molecule = Scene::builtin("molecule").expect("a built-in scene");
        let spheres: Vec<Sphere> = molecule.spheres.iter().step_by(60).cloned().collect();
        let scene = Scene { mesh: Mesh::none(), spheres, ..molecule };
        let config =
            pixel_planes::Config { renderers: 2, side: 16, quadratic: true, ..pixel_planes::Config::new(size) };
        (project_polygons(&scene, size).expect("in front"), config)
    }

    fn render(follower: Option<&Follower>) -> Result<Frame, Error> {
        let (polygons, config) = scene();
        let machine = pixel_planes::Machine::new(config)?;
        let machine = match follower {
            Some(follower) => machine.following(follower),
            None => machine,
        };
        machine.render(&polygons, [9; 3], &mut Watch::default()).map(|(frame, _)| frame)
    }

    fn golden() -> Frame {
        render_polygons(&scene().0, Rule::Least, [9; 3])
    }

    fn designs() -> Vec<Design> {
        let (_, config) = scene();
        vec![design(&config.renderer().expect("a renderer")), design(&config.frame_buffer().expect("a frame buffer"))]
    }
}

mod flow {
    use super::*;

    pub const SUBJECT: Subject = Subject { name: "pixelflow", render, golden, designs };

    fn scene() -> (Deferred, pixelflow::Config) {
        let (scene, size) =
            (Scene::builtin("textured").expect("a built-in scene"), Size::new(16, 12).expect("in range"));
        let deferred = project_deferred(&scene, size, Samples::One).expect("in front");
        (deferred, pixelflow::Config { nodes: 4, shaders: 1, array: [8, 8], ..pixelflow::Config::new(size) })
    }

    fn render(follower: Option<&Follower>) -> Result<Frame, Error> {
        let (deferred, config) = scene();
        let machine = pixelflow::Machine::new(config)?;
        let machine = match follower {
            Some(follower) => machine.following(follower),
            None => machine,
        };
        machine.render(&deferred, &mut Watch::default()).map(|(frame, _)| frame)
    }

    fn golden() -> Frame {
        render_deferred(&scene().0)
    }

    fn designs() -> Vec<Design> {
        let (_, config) = scene();
        let array = config.pixels().expect("an array");
        let screen = Screen::new(config.size.width(), config.size.height()).expect("a screen");
        let [columns, rows] = config.array;
        let memory = TextureMemory { texels: 64, textures: 2 };
        vec![
            design(&array),
            design(&Network { nodes: config.nodes, port: array.network_port() }),
            design(&TextureUnit { chips: array.chips(), pixels: array.pixels(), memory }),
            design(&FrameBuffer { columns, rows, samples: 1, screen }),
        ]
    }
}

/// What a process says of the frame that it rendered.
enum Frames {
    Same,
    Wrong([u32; 2]),
    /// The run fails, or does not end.
    None,
}

/// What the first difference on a way is at.
struct Named {
    block: String,
    sentence: String,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let find = |name: &str| SUBJECTS.into_iter().find(|subject| subject.name == name);
    let Some(subject) = words.first().and_then(|name| find(name)) else {
        eprintln!("usage: judge MACHINE [COUNT] [SEED]; MACHINE is one of:");
        SUBJECTS.iter().for_each(|subject| eprintln!("  {}", subject.name));
        return ExitCode::from(2);
    };
    match words[1..] {
        ["frame"] => say_frame(&subject),
        ["way", x, y] => say_way(&subject, [x, y].map(|place| place.parse().expect("a number"))),
        _ => judge(&subject, number(&words, 1, 25), number(&words, 2, 1) as u64),
    }
    ExitCode::SUCCESS
}

fn number(words: &[&str], place: usize, otherwise: usize) -> usize {
    words.get(place).map_or(otherwise, |word| word.parse().expect("a number"))
}

fn say_frame(subject: &Subject) {
    let golden = (subject.golden)();
    match (subject.render)(None) {
        Err(error) => println!("failed {error}"),
        Ok(frame) => match (0..).zip(golden.words.iter().zip(&frame.words)).find(|(_, (a, b))| a != b) {
            Some((place, _)) => println!("wrong {} {}", place % golden.size().width(), place / golden.size().width()),
            None => println!("same"),
        },
    }
}

fn say_way(subject: &Subject, pixel: [u32; 2]) {
    let follower = Follower::new(pixel);
    let _ = (subject.render)(Some(&follower));
    let Some(way) = follower.take() else { return println!("none\tthere is no way") };
    match way.first_difference() {
        None => println!("none\tno step of {} differs", way.steps.len()),
        Some(step) => {
            let values = step.values.iter().filter(|value| value.differs());
            let values =
                values.map(|it| format!("{} {} not {}", it.what, it.hardware, it.golden.as_deref().unwrap_or("")));
            let values: Vec<String> = values.collect();
            println!(
                "{}\t{} {} in {} {}: {}",
                step.block,
                step.unit,
                step.does,
                step.clock,
                step.cycle,
                values.join(", ")
            );
        }
    }
}

/// The output of this program with those arguments and a mutant; `None` if it breaks, or does not end in time.
fn asked(arguments: &[&str], mutant: &str) -> Option<String> {
    let mut command = Command::new(std::env::current_exe().expect("it has a path"));
    command.args(arguments).env(VARIABLE, mutant).stdout(Stdio::piped()).stderr(Stdio::null());
    let (mut child, begin) = (command.spawn().expect("it can be run"), Instant::now());
    while child.try_wait().expect("it is a child").is_none() {
        if begin.elapsed() > Duration::from_secs(PATIENCE) {
            child.kill().expect("it runs");
            child.wait().expect("it is a child");
            return None;
        }
        sleep(Duration::from_millis(5));
    }
    let mut said = String::new();
    child.stdout.take()?.read_to_string(&mut said).ok()?;
    Some(said.trim().to_owned()).filter(|said| !said.is_empty())
}

fn frames(subject: &Subject, mutant: &str) -> Frames {
    let said = asked(&[subject.name, "frame"], mutant);
    let words: Vec<&str> = said.as_deref().unwrap_or_default().split(' ').collect();
    match words[..] {
        ["same"] => Frames::Same,
        ["wrong", x, y] => Frames::Wrong([x, y].map(|place| place.parse().expect("a number"))),
        _ => Frames::None,
    }
}

fn named(subject: &Subject, mutant: &str, [x, y]: [u32; 2]) -> Named {
    let said = asked(&[subject.name, "way", &x.to_string(), &y.to_string()], mutant);
    let said = said.unwrap_or_else(|| "none\tthe run breaks, or does not end".to_owned());
    let (block, sentence) = said.split_once('\t').unwrap_or(("none", &said));
    Named { block: block.to_owned(), sentence: sentence.to_owned() }
}

/// The name of a type of block in the catalogue.
fn catalogued(machine: &str, of: &str) -> String {
    if let Some((_, _, name)) = NAMES.iter().find(|(there, block, _)| (*there, *block) == (machine, of)) {
        return (*name).to_owned();
    }
    let mut name = String::new();
    for letter in of.chars() {
        if letter.is_uppercase() && !name.is_empty() {
            name.push('-');
        }
        name.extend(letter.to_lowercase());
    }
    name
}

/// The names of the blocks that have an instance of each block.
fn parents(machine: &str, designs: &[Design]) -> BTreeMap<String, Vec<String>> {
    let mut parents: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (design, module) in designs.iter().flat_map(|design| design.modules().iter().map(move |it| (design, it))) {
        for instance in &module.instances {
            let of = catalogued(machine, block(&design.modules()[instance.module.0 as usize]));
            parents.entry(of).or_default().push(catalogued(machine, block(module)));
        }
    }
    parents
}

/// A number below `most`, and the next state: SplitMix64.
fn random(state: &mut u64, most: usize) -> usize {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) % most as u64) as usize
}

/// The ends of runs that differ from the right one.
const KINDS: [&str; 2] = ["a wrong frame", "no frame"];

/// Mutants, those whose block the first difference names, and those of which it names the enclosing unit.
#[derive(Clone, Copy, Default)]
struct Counts {
    all: usize,
    named: usize,
    enclosing: usize,
}

fn judge(subject: &Subject, count: usize, seed: u64) {
    let (designs, golden) = ((subject.designs)(), (subject.golden)());
    let mut modules: Vec<Vec<Mutant>> =
        designs.iter().flat_map(|design| design.modules()).map(mutants).filter(|it| !it.is_empty()).collect();
    let parents = parents(subject.name, &designs);
    // For a run without a frame: the first pixel that something covers.
    let covered = golden.words.iter().position(|word| word >> 24 != 0xff_ffff).unwrap_or(0) as u32;
    let covered = [covered % golden.size().width(), covered / golden.size().width()];
    let (mut state, mut tried) = (seed, 0);
    // Of wrong frames, and of runs without a frame.
    let mut counts = [Counts::default(); 2];
    let mut misses = Vec::new();
    while counts[0].all < count && !modules.is_empty() {
        let module = random(&mut state, modules.len());
        let of_module = &mut modules[module];
        let mutant = of_module.swap_remove(random(&mut state, of_module.len()));
        if of_module.is_empty() {
            modules.remove(module);
        }
        tried += 1;
        let sentence = mutant.to_string();
        let (pixel, kind) = match frames(subject, &sentence) {
            Frames::Same => continue,
            Frames::Wrong(pixel) => (pixel, 0),
            Frames::None => (covered, 1),
        };
        let counts = &mut counts[kind];
        counts.all += 1;
        let found = named(subject, &sentence, pixel);
        let right = catalogued(subject.name, &mutant.block);
        let is_parent = parents.get(&right).is_some_and(|parents| parents.contains(&found.block));
        counts.named += usize::from(found.block == right);
        counts.enclosing += usize::from(found.block != right && is_parent);
        match found.block == right {
            true => eprintln!("named: {sentence}"),
            false => {
                let is_parent = if is_parent { " (the enclosing unit)" } else { "" };
                misses.push(format!("{sentence}\n    {}: {}{is_parent}: {}", KINDS[kind], found.block, found.sentence));
                eprintln!("miss: {}", misses[misses.len() - 1]);
            }
        }
    }
    println!("{tried} mutants\n\n| machine | the run ends with | mutants | named | the enclosing unit | missed |");
    println!("|---|---|---|---|---|---|");
    for (kind, Counts { all, named, enclosing }) in KINDS.into_iter().zip(counts) {
        println!("| {} | {kind} | {all} | {named} | {enclosing} | {} |", subject.name, all - named - enclosing);
    }
    misses.iter().for_each(|miss| println!("{miss}"));
}

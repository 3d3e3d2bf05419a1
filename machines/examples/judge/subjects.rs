//! The machines that are judged, each with a small frame.

use tilewright_hdl::{Block, Design, elaborate};
use tilewright_machines::{Error, Follower, Watch, pixel_planes, pixelflow, quadtree, vc1};
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::pixelflow::frame_buffer::FrameBuffer;
use tilewright_rtl::pixelflow::network::Network;
use tilewright_rtl::pixelflow::texture_memory::TextureMemory;
use tilewright_rtl::pixelflow::texture_unit::TextureUnit;
use tilewright_scenes::deferred::{Deferred, Samples, project_deferred};
use tilewright_scenes::golden::{Rule, render_deferred, render_polygons};
use tilewright_scenes::{Frame, Scene, Size, project_polygons};

/// A machine with a small frame: one with the follower that it gets, rendered; the right one; and the designs that it simulates.
pub struct Subject {
    pub name: &'static str,
    pub render: fn(Option<&Follower>) -> Result<Frame, Error>,
    pub golden: fn() -> Frame,
    pub designs: fn() -> Vec<Design>,
}

pub const SUBJECTS: [Subject; 5] = [shared::SUBJECT, tree::SUBJECT, planes::SUBJECT, spheres::SUBJECT, flow::SUBJECT];

/// Types of blocks whose names in the catalogue are others, with their machine.
pub const NAMES: [(&str, &str, &str); 11] = [
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

/// The machine, with the follower if there is one.
macro_rules! followed {
    ($machine:expr, $follower:expr) => {
        match $follower {
            Some(follower) => $machine.following(follower),
            None => $machine,
        }
    };
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
        let machine = followed!(machine, follower);
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
        let mut machine = followed!(machine, follower);
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
        let machine = followed!(machine, follower);
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
        let machine = followed!(machine, follower);
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
        let machine = followed!(machine, follower);
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

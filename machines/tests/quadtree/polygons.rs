//! What the tests draw: random convex polygons, and scenes.

use tilewright_machines::Watch;
use tilewright_machines::quadtree::{Config, Machine, Report, Test};
use tilewright_scenes::{
    Frame, Polygon, Scene, ScreenVertex, Size, angle, project_polygons, set_up_polygon_of_any_size,
};

/// Both ways to test edges.
pub const BOTH: [Test; 2] = [Test::Serial, Test::Parallel];

pub const BACKGROUND: [u8; 3] = [24, 28, 44];

pub fn size(width: u32, height: u32) -> Size {
    Size::new(width, height).expect("in range")
}

/// Numbers from Knuth's linear congruential generator.
pub struct Random(pub u64);

impl Random {
    /// A number of 0 to `count`, that excluded.
    pub fn below(&mut self, count: u32) -> i32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (((self.0 >> 32) * u64::from(count)) >> 32) as i32
    }

    /// The packets of a convex polygon of 3 to 8 corners on an ellipse whose half axes are below `radius` pixels; planar in depth, as
    /// good as planar in colour. Half of them are at one depth.
    pub fn polygon(&mut self, size: Size, radius: u32) -> Vec<Polygon> {
        let [x, y] = [size.width(), size.height()].map(|side| self.below(16 * (side + 8)) - 64);
        let [a, b] = [0; 2].map(|_| 4 + self.below(16 * radius));
        let (corners, turn) = (3 + self.below(6), self.below(360));
        let is_flat = self.below(2) == 0;
        let base = if is_flat { 4_000_000 } else { 4_000_000 + self.below(2_000_000) };
        let slope = [0; 2].map(|_| if is_flat { 0 } else { self.below(401) - 200 });
        let shade = self.below(200);
        let vertices: Vec<ScreenVertex> = (0..corners)
            .map(|k| {
                let (sin, cos) = angle::sin_cos(f64::from(turn + 360 * k / corners));
                let [dx, dy] = [f64::from(a) * cos, f64::from(b) * sin].map(|offset| offset.round() as i32);
                let z = base + slope[0] * dx + slope[1] * dy;
                let red = (shade + (x + dx) / 64).clamp(0, 255) as u8;
                ScreenVertex { x: x + dx, y: y + dy, z: z as u32, rgb: [red, shade as u8, 255 - shade as u8] }
            })
            .collect();
        set_up_polygon_of_any_size(&vertices, size)
    }
}

/// Packets of that many random polygons.
pub fn random(seed: u64, count: usize, size: Size, radius: u32) -> Vec<Polygon> {
    let mut random = Random(seed);
    (0..count).flat_map(|_| random.polygon(size, radius)).collect()
}

/// The packets of a built-in scene.
pub fn scene(name: &str, size: Size) -> Vec<Polygon> {
    let scene = Scene::builtin(name).expect("a built-in scene");
    project_polygons(&scene, size).expect("the scene is in sight").polygons
}

pub fn machine(config: &Config) -> Machine {
    Machine::new(config.clone()).unwrap_or_else(|error| panic!("{error}: {config:?}"))
}

pub fn render(config: &Config, packets: &[Polygon]) -> (Frame, Report) {
    machine(config).render(packets, BACKGROUND, &mut Watch::default()).expect("renders")
}

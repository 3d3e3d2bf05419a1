//! The stored scene: a star of twelve five-sided points that turns, as packets for the processors.

use super::format::{self, TooLarge};
use glam::{DVec3, dvec3};
use std::collections::BTreeSet;
use std::fmt;
use std::sync::Arc;
use tilewright_rtl::lfb::Patches;
use tilewright_scenes::angle::sin_cos;
use tilewright_scenes::{
    Camera, Frame, Lighting, Mesh, MeshTriangle, Scene, SceneError, Size, Triangle, golden, signed_area2,
};

/// The colour behind the star: red, green and blue.
pub const BACKGROUND: [u8; 3] = [0x10, 0x10, 0x30];
/// The degrees after which the star looks the same again.
const PERIOD: f64 = 72.0;
/// The distance of an inner corner from the middle; that of a tip is 1.
const INNER: f64 = 0.5627;

/// A turning object: for each step, the packets of the triangles that face the eye, each with its processor.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Turning {
    size: [u32; 2],
    processors: u32,
    steps: Arc<Vec<Vec<(Triangle, u32)>>>,
    words: Arc<Vec<u32>>,
}

/// The size and the number of words alone: the text names modules.
impl fmt::Debug for Turning {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [width, height] = self.size;
        write!(f, "Turning({width}x{height}, {} steps, {} words)", self.steps.len(), self.words.len())
    }
}

/// Why there is no stored scene.
#[derive(Debug)]
pub enum NoScene {
    /// The scene cannot be projected.
    Scene(SceneError),
    /// A triangle does not fit into the format.
    Format(TooLarge),
}

impl fmt::Display for NoScene {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            NoScene::Scene(error) => write!(f, "{error}"),
            NoScene::Format(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for NoScene {}

impl Turning {
    /// The star in steps of a fifth of a turn: after them it looks as at the beginning. Its diameter is about
    /// `diameter` of the screen's height.
    ///
    /// # Errors
    ///
    /// The screen is not between 1 and 2048 pixels wide and high, or a triangle is too large for the format.
    pub fn star([width, height]: [u32; 2], steps: u32, processors: u32, diameter: f64) -> Result<Turning, NoScene> {
        let size = Size::new(width, height).map_err(NoScene::Scene)?;
        let (mesh, points) = star().map_err(NoScene::Scene)?;
        let fov = 20.0;
        let camera = Camera {
            eye: dvec3(0.0, -1.0, 0.35) * (2.2 / diameter / 2.0 / tilewright_scenes::angle::tan(fov / 2.0)),
            target: DVec3::ZERO,
            up: DVec3::Z,
            fov,
        };
        let step = |step: u32| {
            let scene = Scene {
                name: "star".to_owned(),
                mesh: mesh.clone(),
                spheres: Vec::new(),
                camera: camera.orbited(-PERIOD * f64::from(step) / f64::from(steps)),
                lighting: Lighting { ambient: 1.0, lights: Vec::new() },
                background: BACKGROUND,
                size,
                files: Vec::new(),
                warnings: Vec::new(),
            };
            let projection = scene.project()?;
            let drawn = projection.triangles.into_iter().zip(projection.vertices);
            // Corners run counter-clockwise round a triangle that faces the eye; on the screen y points down.
            let faces = drawn.filter(|(packet, vertices)| signed_area2(vertices) < 0 && covers_a_pixel(packet));
            // Of two opposite points one faces the eye: a processor has both.
            let given = faces.map(|(packet, _)| {
                let processor = points[packet.polygon as usize] % processors;
                (packet, processor)
            });
            Ok(given.collect::<Vec<_>>())
        };
        let steps: Vec<_> = (0..steps).map(step).collect::<Result<_, SceneError>>().map_err(NoScene::Scene)?;
        let words = words(&steps).map_err(NoScene::Format)?;
        Ok(Turning { size: [width, height], processors, steps: Arc::new(steps), words: Arc::new(words) })
    }

    /// The number of steps.
    pub fn steps(&self) -> usize {
        self.steps.len()
    }

    /// The triangles of a step, each with its processor.
    pub fn triangles(&self, step: usize) -> &[(Triangle, u32)] {
        &self.steps[step]
    }

    /// The words of all packets, step by step.
    pub fn words(&self) -> &[u32] {
        &self.words
    }

    /// What the golden rasterizer draws of a step.
    pub fn golden(&self, step: usize) -> Frame {
        let [width, height] = self.size;
        let packets: Vec<Triangle> = self.steps[step].iter().map(|(packet, _)| packet.clone()).collect();
        golden::render(Size::new(width, height).expect("it was projected"), &packets, BACKGROUND)
    }

    /// The most pages that a processor needs in a step.
    pub fn pages(&self, patches: &Patches) -> usize {
        let pages = |step: &Vec<(Triangle, u32)>| {
            let of = |processor: u32| {
                let own = step.iter().filter(|(_, given)| *given == processor);
                let pixels = own.flat_map(|(packet, _)| covered(packet));
                pixels.map(|(x, y)| patches.place(x, y).patch).collect::<BTreeSet<_>>().len()
            };
            (0..self.processors).map(of).max().unwrap_or(0)
        };
        self.steps.iter().map(pages).max().unwrap_or(0)
    }
}

/// The pixels that a triangle covers.
fn covered(packet: &Triangle) -> impl Iterator<Item = (u32, u32)> {
    let bounds = packet.bounds;
    let pixels = (bounds.top..=bounds.bottom).flat_map(move |y| (bounds.left..=bounds.right).map(move |x| (x, y)));
    pixels.filter(|(x, y)| packet.covers(*x, *y))
}

/// A sliver may cover none. Its planes have steps that no other triangle has.
fn covers_a_pixel(packet: &Triangle) -> bool {
    covered(packet).next().is_some()
}

fn words(steps: &[Vec<(Triangle, u32)>]) -> Result<Vec<u32>, TooLarge> {
    let mut words = Vec::new();
    for step in steps {
        for (place, (packet, processor)) in step.iter().enumerate() {
            words.extend(format::words(packet, *processor, place + 1 == step.len())?);
        }
    }
    Ok(words)
}

/// The mesh, and for each triangle the number of its point. Two opposite points have the same number.
fn star() -> Result<(Mesh, Vec<u32>), SceneError> {
    let (tips, faces) = icosahedron();
    let inner: Vec<DVec3> =
        faces.iter().map(|face| face.iter().map(|tip| tips[*tip]).sum::<DVec3>().normalize() * INNER).collect();
    let opposite = |tip: usize| tips.iter().position(|other| (*other + tips[tip]).length() < 1e-9).unwrap_or(tip);
    let mut axes: Vec<usize> = (0..tips.len()).map(|tip| tip.min(opposite(tip))).collect();
    let mut known = axes.clone();
    known.sort_unstable();
    known.dedup();
    axes.iter_mut().for_each(|axis| *axis = known.iter().position(|it| it == axis).unwrap_or(0));

    let (mut positions, mut triangles, mut colours, mut points) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (a, first) in faces.iter().enumerate() {
        for (b, second) in faces.iter().enumerate().skip(a + 1) {
            // Two faces of the icosahedron with a common edge: a triangle for the point at each of its ends.
            let ends: Vec<usize> = first.iter().copied().filter(|tip| second.contains(tip)).collect();
            for tip in ends.iter().copied().filter(|_| ends.len() == 2) {
                let mut corners = [tips[tip], inner[a], inner[b]];
                let normal =
                    |corners: &[DVec3; 3]| (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
                if normal(&corners).dot(corners.iter().sum::<DVec3>()) < 0.0 {
                    corners.swap(1, 2);
                }
                let at = positions.len() as u32;
                positions.extend(corners);
                triangles.push(MeshTriangle { positions: [at, at + 1, at + 2], normals: [0; 3], diffuse: [1.0; 3] });
                colours.push(colours_of(tips[tip].z, normal(&corners).z));
                points.push(axes[tip] as u32);
            }
        }
    }
    Ok((Mesh::new(positions, vec![DVec3::Z], triangles)?.with_corner_colours(colours)?, points))
}

/// The colours of a triangle's tip and inner corners, by the heights of its tip and of its normal: so each point looks
/// like the next one a fifth of a turn later.
fn colours_of(tip: f64, normal: f64) -> [[f64; 3]; 3] {
    let hue = match tip {
        _ if tip > 0.9 => [1.0, 0.95, 0.6],
        _ if tip > 0.0 => [1.0, 0.6, 0.15],
        _ if tip > -0.9 => [0.25, 0.6, 1.0],
        _ => [0.5, 0.3, 0.9],
    };
    let light = 0.62 + 0.38 * normal;
    let shade = |brightness: f64| hue.map(|part| (part * brightness * light).clamp(0.0, 1.0));
    [shade(1.0), shade(0.45), shade(0.45)]
}

/// The corners of an icosahedron at distance 1 from its middle, one of them above it, and its faces.
fn icosahedron() -> (Vec<DVec3>, Vec<[usize; 3]>) {
    let (height, radius) = (1.0 / 5f64.sqrt(), 2.0 / 5f64.sqrt());
    let ring = |shift: f64, z: f64| {
        (0..5).map(move |corner| {
            let (s, c) = sin_cos(72.0 * f64::from(corner) + shift);
            dvec3(radius * c, radius * s, z)
        })
    };
    let corners = [DVec3::Z].into_iter().chain(ring(0.0, height)).chain(ring(36.0, -height)).chain([-DVec3::Z]);
    let faces = (0..5).flat_map(|corner| {
        let next = (corner + 1) % 5;
        let [up, up_next, low, low_next] = [1 + corner, 1 + next, 6 + corner, 6 + next];
        [[0, up, up_next], [up, low, up_next], [low, low_next, up_next], [11, low_next, low]]
    });
    (corners.collect(), faces.collect())
}

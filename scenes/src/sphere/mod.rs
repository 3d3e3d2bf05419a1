#![doc = include_str!("../../docs/spheres.md")]

mod image;
mod packet;
mod setup;

pub use packet::{Quadratic, SpherePacket};
pub use setup::VALUE_BITS;

pub(crate) use image::Shade;
pub(crate) use setup::{Seen, Unseen, set_up};

use crate::error::SceneError;
use crate::mesh::representable;
use crate::quote::number;
use crate::scene::Scene;
use glam::DVec3;

/// A ball in a scene.
///
/// ```
/// use glam::DVec3;
/// use tilewright_scenes::{Scene, Size, golden, project_polygons, sphere::Sphere};
///
/// let mut scene = Scene::builtin("teapot").expect("a built-in scene");
/// scene.spheres.push(Sphere { centre: DVec3::new(-2.0, -2.5, 0.8), radius: 0.8, colour: [200, 40, 30] });
/// let polygons = project_polygons(&scene, Size::new(64, 48)?)?;
/// let frame = golden::render_polygons(&polygons, golden::Rule::Least, scene.background);
/// assert_eq!((polygons.spheres.len(), polygons.counts.spheres), (1, 1));
/// # assert!(frame.words.iter().any(|word| word >> 16 & 0xff > 2 * (word & 0xff)));
/// # Ok::<(), tilewright_scenes::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Its middle, in the mesh's unit.
    pub centre: DVec3,
    /// Its radius, in the mesh's unit; above 0.
    pub radius: f64,
    /// Diffuse red, green and blue.
    pub colour: [u8; 3],
}

impl Sphere {
    /// Checks the numbers of a scene's sphere number `i`, counted from 0.
    pub(crate) fn check(&self, i: usize) -> Result<(), SceneError> {
        if !representable(self.centre) {
            return Err(SceneError::invalid(
                format!("the centre of sphere {} is {}", i + 1, self.centre),
                "give three finite numbers below 1e100",
            ));
        }
        // As with positions: products of a few of them stay in the range of f64.
        if !(1e-100..1e100).contains(&self.radius) {
            return Err(SceneError::invalid(
                format!("the radius of sphere {} is {}", i + 1, number(self.radius)),
                "give a number above 0, from 1e-100 to less than 1e100",
            ));
        }
        Ok(())
    }
}

impl Scene {
    /// An error if there are spheres, for renderers that draw only triangles.
    pub(crate) fn without_spheres(&self) -> Result<(), SceneError> {
        match self.spheres.len() {
            0 => Ok(()),
            count => Err(SceneError::invalid(
                format!("the scene has spheres, {count} of them, and no sphere is made of triangles"),
                "remove them, or project polygons",
            )),
        }
    }
}

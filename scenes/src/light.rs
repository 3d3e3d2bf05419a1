//! Lighting: ambient light and directional lights, diffuse, one colour per corner (Gouraud), the same on both sides of
//! a triangle.
//!
//! Facts D: the teapot must be drawn two-sided, since the gap round its lid shows insides. So each corner's normal is
//! flipped to the side of its triangle that the eye is on.

use crate::error::SceneError;
use crate::mesh::{representable, unit_or_z};
use crate::quote::number;
use glam::DVec3;

/// A light far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// From the scene towards the light; any length but zero.
    pub toward: DVec3,
    /// Brightness: 1 lights a surface that faces it in its full diffuse colour.
    pub intensity: f64,
}

/// All light of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Lighting {
    /// Light from everywhere, 0 to 1.
    pub ambient: f64,
    /// Directional lights.
    pub lights: Vec<Light>,
}

impl Lighting {
    /// Checks the lights.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if a number is not finite or negative, or a direction is zero.
    pub fn check(&self) -> Result<(), SceneError> {
        let bright = |v: f64| (0.0..1e6).contains(&v);
        if !bright(self.ambient) {
            return Err(SceneError::invalid(
                format!("the ambient light is {}", number(self.ambient)),
                "give a number from 0 to 1",
            ));
        }
        for (i, light) in self.lights.iter().enumerate() {
            if !bright(light.intensity) {
                return Err(SceneError::invalid(
                    format!("the intensity of light {} is {}", i + 1, number(light.intensity)),
                    "give a number from 0 to less than 1e6",
                ));
            }
            if light.toward == DVec3::ZERO || !representable(light.toward) {
                return Err(SceneError::invalid(
                    format!("the direction of light {} is {}", i + 1, light.toward),
                    "give the direction towards the light, not all zero",
                ));
            }
        }
        Ok(())
    }

    /// The lights with directions of length 1, ready for [`Lighting::at`].
    pub(crate) fn normalized(&self) -> Lighting {
        let unit = |light: &Light| Light { toward: unit_or_z(light.toward), intensity: light.intensity };
        Lighting { ambient: self.ambient, lights: self.lights.iter().map(unit).collect() }
    }

    /// How much light a corner reflects, 0 to 1; `normal` has length 1 and points to the lit side.
    pub(crate) fn at(&self, normal: DVec3) -> f64 {
        let sum = self
            .lights
            .iter()
            .fold(self.ambient, |sum, light| sum + light.intensity * normal.dot(light.toward).max(0.0));
        sum.min(1.0)
    }
}

/// Flips a corner's normal to the side of its triangle that faces the eye.
///
/// `face` is the triangle's own normal (any length), `to_eye` goes from the triangle to the eye. Deciding per triangle, not per
/// corner, keeps a triangle on the silhouette from being lit on both sides at once.
pub(crate) fn facing(normal: DVec3, face: DVec3, to_eye: DVec3) -> DVec3 {
    let side = face.dot(to_eye) >= 0.0;
    let agrees = normal.dot(face) >= 0.0;
    if side == agrees { normal } else { -normal }
}

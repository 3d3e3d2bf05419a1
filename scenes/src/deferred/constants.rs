//! A scene's light and materials as the constants of a shader.

use super::arithmetic::MOST_SQUARINGS;
use super::shader::{MOST_LIGHTS, Shader, ShaderLight, ShaderMaterial};
use crate::camera::View;
use crate::error::SceneError;
use crate::light::Light;
use crate::material::{Material, Materials};
use crate::mesh::unit_or_z;
use crate::scene::Scene;
use glam::DVec3;

/// Towards the eye: the line of sight is taken to be the same for all pixels.
const TO_EYE: DVec3 = DVec3::NEG_Z;

/// The shader of a scene. Its last material is that of lines.
///
/// # Errors
/// A texture could not be read, or there are more than [`MOST_LIGHTS`] lights.
pub(crate) fn shader(scene: &Scene, materials: &Materials, view: View) -> Result<Shader, SceneError> {
    let lights = &scene.lighting.lights;
    if lights.len() > MOST_LIGHTS {
        return Err(SceneError::invalid(
            format!("the scene has {} lights", lights.len()),
            format!("give at most {MOST_LIGHTS} for deferred shading"),
        ));
    }
    let lines = ShaderMaterial { is_lit: false, ..ShaderMaterial::default() };
    Ok(Shader {
        background: scene.background,
        ambient: eight_bits(scene.lighting.ambient),
        lights: lights.iter().map(|light| seen(light, view)).collect(),
        materials: materials.materials.iter().map(material).chain([lines]).collect(),
        textures: materials.textures.iter().cloned().collect::<Result<_, _>>()?,
    })
}

fn seen(light: &Light, view: View) -> ShaderLight {
    let direction = view.of_direction(unit_or_z(light.toward));
    let between = direction + TO_EYE;
    let half = if between.dot(between) > 1e-12 { unit_or_z(between) } else { DVec3::ZERO };
    ShaderLight { direction: nine_bits(direction), half: nine_bits(half), brightness: eight_bits(light.intensity) }
}

fn material(material: &Material) -> ShaderMaterial {
    ShaderMaterial {
        is_lit: true,
        texture: material.texture,
        specular: eight_bits(material.specular),
        squarings: (material.shininess.ilog2() as u8).min(MOST_SQUARINGS),
    }
}

/// 255 for 1, and for anything above it.
fn eight_bits(part: f64) -> u8 {
    (part.min(1.0) * 255.0 + 0.5).floor() as u8
}

/// 2^8 times a unit vector, each number limited to 255.
fn nine_bits(unit: DVec3) -> [i16; 3] {
    unit.to_array().map(|part| (part * 256.0 + 0.5).floor().clamp(-255.0, 255.0) as i16)
}

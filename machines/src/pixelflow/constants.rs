//! A shader's constants for the programs of a node.

use tilewright_rtl::pixelflow::programs::{Light, Material, Shader, Texture};
use tilewright_scenes::deferred;

/// The constants of a node's programs, with the numbers and finest levels of textures.
///
/// ```
/// use tilewright_machines::pixelflow::constants;
/// use tilewright_scenes::deferred::{Samples, project_deferred};
/// use tilewright_scenes::{Scene, Size};
///
/// let scene = Scene::builtin("teapot").expect("a built-in scene");
/// let deferred = project_deferred(&scene, Size::new(64, 48)?, Samples::One)?;
/// // One material of the scene, and that of lines.
/// assert_eq!(constants(&deferred.shader).materials.len(), 2);
/// # Ok::<(), tilewright_scenes::SceneError>(())
/// ```
///
/// # Panics
/// If there are more than 255 textures, more than scenes have.
pub fn constants(shader: &deferred::Shader) -> Shader {
    let light = |&deferred::ShaderLight { direction, half, brightness }: &_| Light { direction, half, brightness };
    let texture = |index: u32| Texture {
        number: u8::try_from(index).ok().filter(|number| *number < u8::MAX).expect("at most 255 textures"),
        finest: shader.textures[index as usize].level() as u8,
    };
    let material = |material: &deferred::ShaderMaterial| Material {
        is_lit: material.is_lit,
        texture: material.texture.map(texture),
        specular: material.specular,
        squarings: material.squarings,
    };
    Shader {
        background: shader.background,
        ambient: shader.ambient,
        lights: shader.lights.iter().map(light).collect(),
        materials: shader.materials.iter().map(material).collect(),
    }
}

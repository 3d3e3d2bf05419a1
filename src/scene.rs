//! The scene that a command is given, and the size of the frame.

use crate::shell::{Exit, Failure, progress, terminal};
use clap::Args;
use std::ffi::{OsStr, OsString};
use std::sync::{Mutex, PoisonError};
use tilewright_scenes::deferred::{Deferred, Samples, project_deferred};
use tilewright_scenes::{Polygons, Projection, Scene, Size, project_polygons, project_sample, project_samples};

/// A scene on a screen.
#[derive(Args)]
pub struct SceneArguments {
    /// A built-in scene's name, or the path of a .toml, .obj, .gltf, .glb, .ply or .stl file
    #[arg(value_name = "SCENE")]
    scene: OsString,
    /// Size of the frame in pixels [default: what the scene asks for]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,
}

impl SceneArguments {
    /// Loads the scene.
    ///
    /// # Errors
    /// The scene's, naming file and line.
    pub fn load(&self) -> Result<Scene, Failure> {
        load(&self.scene, self.size)
    }
}

/// Loads a scene of that name, for a frame of that size or of the size that it asks for.
///
/// # Errors
/// The scene's, naming file and line.
pub fn load(name: &OsStr, size: Option<Size>) -> Result<Scene, Failure> {
    progress::phase("reading");
    let scene = Scene::load_sized(name, size)?;
    progress::phase("setting up");
    Ok(scene)
}

/// Sets up the triangles of a scene. Warns of oddities in its files, and if nothing is visible.
///
/// # Errors
/// The scene's camera or lights are invalid, nothing is in front of the camera, or there are spheres.
pub fn triangles(scene: &Scene) -> Result<Projection, Failure> {
    moved_triangles(scene, [0, 0])
}

/// As [`triangles`], with every vertex shifted; the unit is 1/16 pixel.
///
/// # Errors
/// As [`triangles`].
pub fn moved_triangles(scene: &Scene, shift: [i32; 2]) -> Result<Projection, Failure> {
    without_spheres(scene)?;
    let projection = project_sample(scene, scene.size, shift)?;
    warn_without_textures(scene, projection.warning());
    Ok(projection)
}

/// Sets up the faces of a scene, as [`triangles`] does for triangles.
///
/// # Errors
/// As [`triangles`].
pub fn polygons(scene: &Scene) -> Result<Polygons, Failure> {
    without_spheres(scene)?;
    polygons_and_spheres(scene)
}

/// Sets up the faces and the spheres of a scene.
///
/// # Errors
/// As [`triangles`], except that spheres are allowed; or a sphere is too near, too large or too slender.
pub fn polygons_and_spheres(scene: &Scene) -> Result<Polygons, Failure> {
    let polygons = project_polygons(scene, scene.size)?;
    warn_without_textures(scene, polygons.warning());
    Ok(polygons)
}

/// Sets up the triangles of a scene, as [`triangles`] does, for each pass of these samples.
///
/// # Errors
/// As [`triangles`]; or the frame is too large for these samples.
pub fn samples(scene: &Scene, samples: Samples) -> Result<Vec<Projection>, Failure> {
    without_spheres(scene)?;
    let passes = project_samples(scene, scene.size, samples)?;
    warn_without_textures(scene, passes[0].warning());
    Ok(passes)
}

/// Sets up the triangles of a scene for deferred shading, as [`triangles`] does for colours.
///
/// # Errors
/// As [`triangles`]; or a texture cannot be read, or the frame is too large for these samples.
pub fn deferred(scene: &Scene, samples: Samples) -> Result<Deferred, Failure> {
    without_spheres(scene)?;
    let deferred = project_deferred(scene, scene.size, samples)?;
    warn(scene, deferred.warning());
    Ok(deferred)
}

/// Checks that a scene has no spheres, for machines that cannot draw them.
fn without_spheres(scene: &Scene) -> Result<(), Failure> {
    if scene.spheres.is_empty() {
        return Ok(());
    }
    let sentence =
        "the scene has spheres, which only pixel-planes-5 draws: use `tilewright render` with --machine pixel-planes-5";
    Err(Failure::new(Exit::BadInput, sentence))
}

/// As [`warn`], for machines that light vertices only.
fn warn_without_textures(scene: &Scene, warning: Option<String>) {
    let left_out = scene.mesh.materials().filter(|materials| materials.are_textured()).map(|_| {
        let name = &scene.name;
        format!("the textures of {name} are left out: pixelflow's base system draws them, and so does `tilewright golden` with --deferred")
    });
    warn(scene, left_out.into_iter().chain(warning));
}

fn warn(scene: &Scene, warnings: impl IntoIterator<Item = String>) {
    // A command that sets up a scene for several machines warns once.
    static SAID: Mutex<Vec<String>> = Mutex::new(Vec::new());
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    for warning in scene.warnings.iter().cloned().chain(warnings) {
        if !said.contains(&warning) {
            terminal::warn(&warning);
            said.push(warning);
        }
    }
}

/// Reads the size of a frame.
///
/// # Errors
/// A sentence that says what to give.
pub fn size(text: &str) -> Result<Size, String> {
    let sides = text.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    let (width, height) = sides.ok_or("give width and height in pixels, such as 640x480")?;
    Size::new(width, height).map_err(|error| error.to_string())
}

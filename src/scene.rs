//! The scene that a command is given, and the size of the frame.

use crate::shell::{Failure, terminal};
use clap::Args;
use std::ffi::OsString;
use tilewright_scenes::{Projection, Scene, Size};

/// A scene on a screen.
#[derive(Args)]
pub struct SceneArguments {
    /// A built-in scene's name, or the path of an .obj or a .toml file
    #[arg(value_name = "SCENE")]
    scene: OsString,
    /// Pixels of the frame [default: what the scene asks for]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,
}

impl SceneArguments {
    /// Loads the scene and sets its triangles up; passes on what was odd about its files.
    ///
    /// # Errors
    /// The scene's, naming file and line.
    pub fn load(&self) -> Result<(Scene, Projection), Failure> {
        let scene = Scene::load_sized(&self.scene, self.size)?;
        let projection = scene.project()?;
        let warnings = scene.warnings.iter().cloned().chain(projection.warning());
        warnings.for_each(|warning| terminal::warn(&warning));
        Ok((scene, projection))
    }
}

fn size(text: &str) -> Result<Size, String> {
    let sides = text.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    let (width, height) = sides.ok_or("give width and height in pixels, such as 640x480")?;
    Size::new(width, height).map_err(|error| error.to_string())
}

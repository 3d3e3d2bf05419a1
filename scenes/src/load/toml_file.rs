//! Scene files in TOML: a mesh, spheres, and whatever differs from the defaults. The keys are in the crate's README.
//! Every mistake is reported with its line and column; unknown keys are mistakes.

use super::framing::{FRAMING_FOV, bounding_box, framing_camera};
use super::mesh_file::{self, ENDINGS, Loaded};
use super::names::{nearest, stem};
use super::toml_values::{Keys, Table, Vector, tables};
use crate::builtin::{self, default_lighting, with_defaults};
use crate::camera::Part;
use crate::error::SceneError;
use crate::input::{self, read_lines};
use crate::light::Light;
use crate::material::{Material, Materials};
use crate::mesh::representable;
use crate::quote::{brief, quote, shown};
use crate::scene::Scene;
use crate::screen::nothing_in_front;
use crate::size::Size;
use crate::sphere::Sphere;
use crate::texture::{GENERATED, Texture, file};
use glam::DVec3;
use serde::Deserialize;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneTable {
    mesh: Option<Spanned<String>>,
    #[serde(default)]
    wireframe: bool,
    size: Option<Spanned<Vector<i64, 2>>>,
    background: Option<Spanned<Vector<i64, 3>>>,
    ambient: Option<Spanned<f64>>,
    #[serde(default)]
    camera: Table<CameraTable>,
    #[serde(default)]
    surface: Table<SurfaceTable>,
    #[serde(default, deserialize_with = "tables")]
    light: Option<Vec<Table<LightTable>>>,
    #[serde(default, deserialize_with = "tables")]
    sphere: Option<Vec<Table<SphereTable>>>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct CameraTable {
    eye: Option<Spanned<Vector<f64, 3>>>,
    target: Option<Spanned<Vector<f64, 3>>>,
    up: Option<Spanned<Vector<f64, 3>>>,
    fov: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LightTable {
    toward: Spanned<Vector<f64, 3>>,
    intensity: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SphereTable {
    centre: Spanned<Vector<f64, 3>>,
    radius: Spanned<f64>,
    colour: Spanned<Vector<i64, 3>>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct SurfaceTable {
    texture: Option<Spanned<String>>,
    specular: Option<Spanned<f64>>,
    shininess: Option<Spanned<u32>>,
}

impl Keys for SurfaceTable {
    const NAME: &str = "surface";
    const IS_LISTED: bool = false;
}

impl Keys for CameraTable {
    const NAME: &str = "camera";
    const IS_LISTED: bool = false;
}

impl CameraTable {
    /// The position of each part of the camera in the file.
    fn place_of(&self, part: Part) -> Option<Range<usize>> {
        match part {
            Part::Eye => self.eye.as_ref().map(Spanned::span),
            Part::Target => self.target.as_ref().map(Spanned::span),
            Part::Up => self.up.as_ref().map(Spanned::span),
            Part::Fov => self.fov.as_ref().map(Spanned::span),
        }
    }

    /// The position for a camera error: that part, or if it is not given, the first of the others that is.
    fn blame(&self, part: Part) -> Option<Range<usize>> {
        [part, Part::Eye, Part::Target, Part::Up, Part::Fov].into_iter().find_map(|part| self.place_of(part))
    }
}

impl Keys for SphereTable {
    const NAME: &str = "sphere";
    const IS_LISTED: bool = true;
}

impl Keys for LightTable {
    const NAME: &str = "light";
    const IS_LISTED: bool = true;
}

/// The most characters of a message of the TOML library: it may quote the whole file.
const MESSAGE: usize = 200;

/// The file, to convert byte ranges to positions.
struct Source<'a> {
    path: &'a Path,
    text: &'a str,
}

pub(super) fn load(path: &Path, size: Option<Size>) -> Result<Scene, SceneError> {
    let bytes = read_lines(path, &input::SCENE)?;
    let text = String::from_utf8(bytes).map_err(|error| SceneError::File {
        path: path.to_owned(),
        problem: format!("is not UTF-8 text from byte {} on", error.utf8_error().valid_up_to()),
        remedy: "save it as UTF-8".to_owned(),
    })?;
    let source = Source { path, text: &text };
    let table: SceneTable = toml::from_str(&text).map_err(|error| source.not_toml(&error))?;
    source.scene(&table, size)
}

impl Source<'_> {
    fn scene(&self, table: &SceneTable, size: Option<Size>) -> Result<Scene, SceneError> {
        let mut scene = self.base(table, size)?;
        scene.name = stem(self.path);
        scene.files.insert(0, self.path.to_owned());
        self.set_camera(&table.camera.0, &mut scene)?;
        self.set_surface(&table.surface.0, &mut scene)?;
        if let Some(background) = &table.background {
            scene.background = self.colour("background", background)?;
        }
        if let Some(ambient) = &table.ambient {
            scene.lighting.ambient = *ambient.as_ref();
            self.place(ambient.span(), scene.lighting.check())?;
        }
        if let Some(lights) = &table.light {
            scene.lighting.lights.clear();
            for Table(light) in lights {
                self.vector(&light.toward)?;
                scene.lighting.lights.push(Light {
                    toward: DVec3::from_array(light.toward.as_ref().0),
                    intensity: *light.intensity.as_ref(),
                });
                let wrong_length = light.toward.as_ref().0 == [0.0; 3];
                let culprit = if wrong_length { light.toward.span() } else { light.intensity.span() };
                self.place(culprit, scene.lighting.check())?;
            }
        }
        if let Some(error) = nothing_in_front(&scene)? {
            let place = table.camera.0.blame(Part::Eye);
            let place = place.or(table.mesh.as_ref().map(Spanned::span));
            self.place(place.unwrap_or(0..0), Err(error))?;
        }
        Ok(scene)
    }

    /// Mesh and size, and the camera and light that come with them; `asked` takes precedence over the file's own size.
    fn base(&self, table: &SceneTable, asked: Option<Size>) -> Result<Scene, SceneError> {
        let own = table.size.as_ref().map(|size| self.size(size)).transpose()?;
        let size = asked.or(own);
        let spheres = self.spheres(table)?;
        let name = table.mesh.as_ref().map_or("", |mesh| mesh.as_ref());
        let mut scene = match builtin::scene(name) {
            Some(scene) if table.wireframe => Scene { mesh: scene.mesh.wireframe(), ..scene },
            Some(scene) => scene,
            None => {
                let Loaded { mesh, up, files, warnings } = match &table.mesh {
                    Some(mesh) => self.mesh(mesh, table)?,
                    None => Loaded::nothing(),
                };
                let camera = &table.camera.0;
                // Their values are checked with the rest of the camera.
                let up = camera.up.as_ref().map_or(up, |up| DVec3::from_array(up.as_ref().0));
                let fov = camera.fov.as_ref().map_or(FRAMING_FOV, |fov| *fov.as_ref());
                let framing = framing_camera(bounding_box(&mesh, &spheres), up, fov, size.unwrap_or(Size::VGA));
                let mut scene = with_defaults(name, mesh, framing);
                (scene.files, scene.warnings) = (files, warnings);
                scene
            }
        };
        scene.size = size.unwrap_or(scene.size);
        scene.spheres.extend(spheres);
        Ok(scene)
    }

    fn spheres(&self, table: &SceneTable) -> Result<Vec<Sphere>, SceneError> {
        let tables = table.sphere.as_deref().unwrap_or_default();
        if table.mesh.is_none() && tables.is_empty() {
            return Err(self.error(0..0, "missing key `mesh`, and no `[[sphere]]`", "add one of them"));
        }
        let sphere = |(i, Table(table)): (usize, &Table<SphereTable>)| {
            self.vector(&table.centre)?;
            let sphere = Sphere {
                centre: DVec3::from_array(table.centre.as_ref().0),
                radius: *table.radius.as_ref(),
                colour: self.colour("colour", &table.colour)?,
            };
            self.place(table.radius.span(), sphere.check(i))?;
            Ok(sphere)
        };
        tables.iter().enumerate().map(sphere).collect()
    }

    /// The colour under that key.
    fn colour(&self, key: &str, given: &Spanned<Vector<i64, 3>>) -> Result<[u8; 3], SceneError> {
        let [Ok(r), Ok(g), Ok(b)] = given.as_ref().0.map(u8::try_from) else {
            return Err(self.error(
                given.span(),
                format!("the {key} is {:?}", given.as_ref().0),
                "give red, green and blue from 0 to 255",
            ));
        };
        Ok([r, g, b])
    }

    fn mesh(&self, name: &Spanned<String>, table: &SceneTable) -> Result<Loaded, SceneError> {
        let file = Path::new(name.as_ref());
        let loader = match table.surface.0.texture {
            Some(_) => mesh_file::loader_for_texture(file),
            None => mesh_file::loader(file),
        };
        let Some(load) = loader else {
            let all = builtin::NAMES.join(", ");
            return Err(self.error(
                name.span(),
                format!("the mesh {} is neither a mesh file nor a built-in scene", quote(name.as_ref())),
                match nearest(name.as_ref()) {
                    Some(known) => format!("did you mean `{known}`? Name an {ENDINGS} file, or one of {all}"),
                    None => format!("name an {ENDINGS} file, or one of {all}"),
                },
            ));
        };
        let path = self.path.parent().unwrap_or(Path::new("")).join(file);
        if !path.exists() {
            return Err(self.error(
                name.span(),
                format!("there is no mesh {}", shown(&path)),
                "the path is relative to the scene file's folder; correct it",
            ));
        }
        load(&path, table.wireframe)
    }

    fn size(&self, size: &Spanned<Vector<i64, 2>>) -> Result<Size, SceneError> {
        let [width, height] = size.as_ref().0;
        let sides = u32::try_from(width).ok().zip(u32::try_from(height).ok());
        let made = match sides {
            Some((w, h)) => Size::new(w, h),
            None => Err(SceneError::Size { width, height }),
        };
        self.place(size.span(), made)
    }

    fn set_camera(&self, table: &CameraTable, scene: &mut Scene) -> Result<(), SceneError> {
        let camera = &mut scene.camera;
        let vectors = [(&table.eye, &mut camera.eye), (&table.target, &mut camera.target), (&table.up, &mut camera.up)];
        for (given, kept) in vectors {
            if let Some(given) = given {
                self.vector(given)?;
                *kept = DVec3::from_array(given.as_ref().0);
            }
        }
        camera.fov = table.fov.as_ref().map_or(camera.fov, |fov| *fov.as_ref());
        if let Err((part, error)) = camera.examined() {
            self.place(table.blame(part).unwrap_or(0..0), Err(error))?;
        }
        scene.lighting = default_lighting(camera);
        Ok(())
    }

    /// The settings that deferred shading uses for all faces instead of their own materials.
    fn set_surface(&self, table: &SurfaceTable, scene: &mut Scene) -> Result<(), SceneError> {
        let SurfaceTable { texture, specular, shininess } = table;
        if texture.is_none() && specular.is_none() && shininess.is_none() {
            return Ok(());
        }
        let plain = || Materials::plain(Material::default(), scene.mesh.triangles().len());
        let mut materials = scene.mesh.materials().cloned().unwrap_or_else(plain);
        for material in &mut materials.materials {
            if let Some(specular) = specular {
                material.specular = *specular.as_ref();
                self.place(specular.span(), material.check())?;
            }
            if let Some(shininess) = shininess {
                material.shininess = *shininess.as_ref();
                self.place(shininess.span(), material.check())?;
            }
        }
        if let Some(name) = texture {
            if !materials.has_coordinates() {
                return Err(self.error(
                    name.span(),
                    "the mesh has no texture coordinates",
                    "remove the key, or name a mesh that has them, as `vt` makes them in an .obj file",
                ));
            }
            materials.textures = vec![Ok(self.texture(name, scene)?)];
            materials.materials.iter_mut().for_each(|material| material.texture = Some(0));
        }
        scene.mesh = scene.mesh.clone().with_materials(materials)?;
        Ok(())
    }

    /// A generated texture or a file's; adds its path and problems to the scene.
    fn texture(&self, name: &Spanned<String>, scene: &mut Scene) -> Result<Arc<Texture>, SceneError> {
        let text = name.as_ref();
        if let Some(texture) = Texture::generated(text) {
            return Ok(Arc::new(texture));
        }
        let wrong = |problem: String, remedy: String| self.error(name.span(), problem, remedy);
        if Path::new(text).extension().is_none() {
            return Err(wrong(
                format!("the texture {} is neither a .png or .jpg file nor a generated one", quote(text)),
                format!("name such a file, or one of {}", GENERATED.join(", ")),
            ));
        }
        let path = self.path.parent().unwrap_or(Path::new("")).join(text);
        let found = file::read(&path).map_err(|(problem, remedy)| wrong(problem, remedy))?;
        let [line, column] = self.place_of(name.span());
        scene.warnings.extend(found.notes.iter().map(|note| format!("{}:{line}:{column}: {note}", shown(self.path))));
        scene.files.push(path);
        Ok(found.texture)
    }

    fn vector(&self, given: &Spanned<Vector<f64, 3>>) -> Result<(), SceneError> {
        if representable(DVec3::from_array(given.as_ref().0)) {
            return Ok(());
        }
        Err(self.error(
            given.span(),
            format!("{:?} is not a point or a direction", given.as_ref().0),
            "give three finite numbers below 1e100",
        ))
    }

    /// Gives an error without a position the position of `span`.
    fn place<T>(&self, span: Range<usize>, result: Result<T, SceneError>) -> Result<T, SceneError> {
        result.map_err(|error| {
            let sentence = error.to_string();
            let (problem, remedy) = sentence.rsplit_once(": ").unwrap_or((&sentence, ""));
            self.error(span, problem, remedy)
        })
    }

    fn error(&self, span: Range<usize>, problem: impl Into<String>, remedy: impl Into<String>) -> SceneError {
        let [line, column] = self.place_of(span);
        SceneError::Place { path: self.path.to_owned(), line, column, problem: problem.into(), remedy: remedy.into() }
    }

    /// Line and column of its beginning, counted from 1.
    fn place_of(&self, span: Range<usize>) -> [usize; 2] {
        let before = self.text.get(..span.start).unwrap_or(self.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        [before.matches('\n').count() + 1, before[line_start..].chars().count() + 1]
    }

    fn not_toml(&self, error: &toml::de::Error) -> SceneError {
        let message = error.message().trim();
        let span = error.span().unwrap_or(0..0);
        // The library's messages name the remedy after "expected".
        let (problem, remedy) = match message.rsplit_once(", expected ") {
            Some((problem, "i64")) => (problem, "write a whole number".to_owned()),
            Some((problem, "f64")) => (problem, "write a number".to_owned()),
            Some((problem, "a boolean")) => (problem, "write true or false".to_owned()),
            Some((problem, expected)) => (problem, format!("write {}", brief(expected, MESSAGE))),
            None if message.starts_with("missing field") => (message, "add it".to_owned()),
            None => (message, "correct the TOML".to_owned()),
        };
        // The library's word for a key; anything quoted after it stays unchanged.
        let problem = brief(problem, MESSAGE).replacen("field", "key", 1);
        self.error(span, problem, remedy)
    }
}

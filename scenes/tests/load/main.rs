//! Scenes from files: good ones, and every bad one with its whole sentence.

mod camera;
mod faces;
mod limits;
mod lines;
mod mesh_file;
mod scene_file;
mod text;
mod textures;

use std::fs;
use std::path::{Path, PathBuf};
use tilewright_scenes::{Scene, builtin};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A folder for one test, with the given files in it.
fn folder(test: &str, files: &[(&str, &str)]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("load_{test}"));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    for (name, text) in files {
        fs::write(path.join(name), text).unwrap();
    }
    path
}

fn load(path: &Path) -> Result<Scene, String> {
    Scene::load(path.to_str().unwrap()).map_err(|error| error.to_string())
}

/// The sentence that a mesh file of this text ends in, without the folder.
fn obj_error(test: &str, text: &str) -> String {
    let folder = folder(test, &[("mesh.obj", text)]);
    let sentence = load(&folder.join("mesh.obj")).unwrap_err();
    sentence.replace(&format!("{}/", folder.display()), "")
}

/// The sentence that a scene file of this text ends in; `mesh.obj` is beside it.
fn toml_error(test: &str, text: &str) -> String {
    let folder = folder(test, &[("scene.toml", text), ("mesh.obj", TRIANGLE)]);
    let sentence = load(&folder.join("scene.toml")).unwrap_err();
    sentence.replace(&format!("{}/", folder.display()), "")
}

#[test]
fn built_in_scenes_load_by_name() {
    for name in builtin::NAMES {
        assert_eq!(Scene::load(name).unwrap().name, name);
    }
}

#[test]
fn an_unknown_name_is_answered_with_the_nearest() {
    let error = |name: &str| Scene::load(name).unwrap_err().to_string();
    assert_eq!(
        error("teepot"),
        "there is no scene `teepot`: did you mean `teapot`? The built-in scenes are teapot, ter1k, ter250, wireframe, star, textured, molecule; or name an .obj or a .toml file"
    );
    assert!(error("Ter1K").contains("did you mean `ter1k`?"));
    assert!(error("").starts_with("there is no scene ``: the built-in scenes are "));
    assert_eq!(
        error("dragon"),
        "there is no scene `dragon`: the built-in scenes are teapot, ter1k, ter250, wireframe, star, textured, molecule; or name an .obj or a .toml file"
    );
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let folder = folder("unreadable", &[("mesh.gltf", "{}")]);
    fs::create_dir(folder.join("dir.obj")).unwrap();
    let error = |name: &str| {
        let sentence = load(&folder.join(name)).unwrap_err();
        sentence.replace(&format!("{}/", folder.display()), "")
    };
    let remedy = "name an .obj or a .toml file that you may read, or a built-in scene";
    for missing in ["none.obj", "none.toml"] {
        assert_eq!(error(missing), format!("{missing}: cannot be read (no such file or directory): {remedy}"));
    }
    assert_eq!(error("dir.obj"), format!("dir.obj: cannot be read (is a directory): {remedy}"));
    assert_eq!(
        error("mesh.gltf"),
        "mesh.gltf: is neither a scene file nor a mesh, going by its name: name a .toml or an .obj file"
    );
    let sentence = load(&folder).unwrap_err();
    assert!(sentence.contains("cannot be read (is a directory)"), "{sentence}");
}

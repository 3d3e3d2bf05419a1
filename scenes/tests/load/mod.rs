//! Scenes from files: good ones, and every bad one with its whole sentence.

mod camera;
mod faces;
mod gltf;
mod gltf_errors;
mod limits;
mod lines;
mod mesh_file;
mod names;
mod pictures;
mod ply;
mod real;
mod real_cases;
mod scene_file;
mod stl;
mod text;
mod textures;

use glam::{DVec3, dvec3};
use std::fs;
use std::path::{Path, PathBuf};
use tilewright_scenes::deferred::{Samples, project_deferred};
use tilewright_scenes::{Camera, Frame, Scene, Size, builtin, compare, golden, project};

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

/// The VC-1's and deferred shading's pictures of a mesh file, from the front.
fn pictures(path: &Path) -> [Frame; 2] {
    let scene = load(path).unwrap();
    let camera = Camera { eye: dvec3(0.3, 0.2, 5.0), target: DVec3::ZERO, up: DVec3::Y, fov: 40.0 };
    let lighting = Scene::builtin("textured").unwrap().lighting;
    let (scene, size) = (Scene { camera, lighting, ..scene }, Size::new(48, 40).unwrap());
    let projection = project(&scene, size).unwrap();
    let deferred = project_deferred(&scene, size, Samples::One).unwrap();
    [golden::render(size, &projection.triangles, scene.background), golden::render_deferred(&deferred)]
}

/// Checks that a mesh file gives the pictures of this OBJ file, none of them blank, and these warnings.
fn same_pictures(path: &Path, obj: &str, warnings: &[&str]) {
    let folder = path.parent().unwrap();
    let plain = folder.join("plain.obj");
    fs::write(&plain, obj).unwrap();
    let expected = pictures(&plain);
    assert!(expected.iter().all(|frame| frame.words.iter().any(|word| *word != frame.words[0])));
    assert_eq!(warned(&load(path).unwrap(), folder), warnings);
    let found = pictures(path);
    for (found, expected) in found.iter().zip(&expected) {
        let comparison = compare(expected, found);
        assert_eq!(comparison.differing, 0, "{}: {comparison}", path.display());
    }
}

/// A scene's warnings, without the folder.
fn warned(scene: &Scene, folder: &Path) -> Vec<String> {
    let folder = format!("{}/", folder.display());
    scene.warnings.iter().map(|warning| warning.replace(&folder, "")).collect()
}

/// The error message for a file with these bytes, without the folder.
fn bytes_error(folder: &Path, name: &str, bytes: &[u8]) -> String {
    fs::write(folder.join(name), bytes).unwrap();
    load(&folder.join(name)).unwrap_err().replace(&format!("{}/", folder.display()), "")
}

/// The error message for a mesh file with this text, without the folder.
fn obj_error(test: &str, text: &str) -> String {
    let folder = folder(test, &[("mesh.obj", text)]);
    let sentence = load(&folder.join("mesh.obj")).unwrap_err();
    sentence.replace(&format!("{}/", folder.display()), "")
}

/// The error message for a scene file with this text; `mesh.obj` is in the same folder.
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
        "there is no scene `teepot`: did you mean `teapot`? The built-in scenes are teapot, teapot16, table, ter1k, ter250, wireframe, star, textured, molecule; or name a .toml, .obj, .gltf, .glb, .ply or .stl file"
    );
    assert!(error("Ter1K").contains("did you mean `ter1k`?"));
    assert!(error("").starts_with("there is no scene ``: the built-in scenes are "));
    assert_eq!(
        error("dragon"),
        "there is no scene `dragon`: the built-in scenes are teapot, teapot16, table, ter1k, ter250, wireframe, star, textured, molecule; or name a .toml, .obj, .gltf, .glb, .ply or .stl file"
    );
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let folder = folder("unreadable", &[("mesh.fbx", "{}")]);
    fs::create_dir(folder.join("dir.obj")).unwrap();
    let error = |name: &str| {
        let sentence = load(&folder.join(name)).unwrap_err();
        sentence.replace(&format!("{}/", folder.display()), "")
    };
    let remedy = "name a .toml, .obj, .gltf, .glb, .ply or .stl file that you may read, or a built-in scene";
    for missing in ["none.obj", "none.toml"] {
        assert_eq!(error(missing), format!("{missing}: cannot be read (no such file or directory): {remedy}"));
    }
    assert_eq!(error("dir.obj"), format!("dir.obj: cannot be read (is a directory): {remedy}"));
    assert_eq!(
        error("mesh.fbx"),
        "mesh.fbx: is neither a scene file nor a mesh, going by its name: name a .toml, .obj, .gltf, .glb, .ply or .stl file"
    );
    let sentence = load(&folder).unwrap_err();
    assert!(sentence.contains("cannot be read (is a directory)"), "{sentence}");
}

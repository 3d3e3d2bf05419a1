//! Scenes from files: good ones, and every bad one with its whole sentence.

use glam::{DVec3, dvec3};
use std::fs;
use std::path::{Path, PathBuf};
use tilewright_scenes::{Scene, builtin, golden};

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
        "there is no scene `teepot`: did you mean `teapot`? The built-in scenes are teapot, ter1k, ter250; or name an .obj or a .toml file"
    );
    assert!(error("Ter1K").contains("did you mean `ter1k`?"));
    assert!(error("").starts_with("there is no scene ``: the built-in scenes are "));
    assert_eq!(
        error("dragon"),
        "there is no scene `dragon`: the built-in scenes are teapot, ter1k, ter250; or name an .obj or a .toml file"
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

#[test]
fn an_obj_file_keeps_order_colours_and_normals() {
    let folder = folder(
        "good",
        &[
            (
                "mesh.obj",
                "\u{feff}# a quad, a triangle, a line, a point\r\n\
                 mtllib my colours.mtl\r\n\
                 o thing\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.1 0.2 0.3\nv 0 1 \\\n 0\n\
                 vt 0 0\nvn 0 0 2\ns off\n\
                 usemtl dark red\nf 1/1/1 2/1/1 3//1 -1//-1\n\
                 l 1 2 3 4\np 1\n\
                 g two\nusemtl plain\nf 1//1 2//1 4//1 # the last\n",
            ),
            ("my colours.mtl", "# two\nnewmtl dark red\nKa 1\nKd 0.5 0 0\nnewmtl plain\nKd 2\nillum 2\n"),
        ],
    );
    let scene = load(&folder.join("mesh.obj")).unwrap();
    assert_eq!(scene.warnings, [""; 0]);
    assert_eq!(scene.name, "mesh");
    let triangles = scene.mesh.triangles();
    let places: Vec<_> = triangles.iter().map(|t| t.positions).collect();
    assert_eq!(places, [[0, 1, 2], [0, 2, 3], [0, 1, 3]]);
    let colours: Vec<_> = triangles.iter().map(|t| t.diffuse).collect();
    assert_eq!(colours, [[0.5, 0.0, 0.0], [0.5, 0.0, 0.0], [1.0, 1.0, 1.0]]);
    assert!(triangles.iter().flat_map(|t| t.normals).all(|n| scene.mesh.normals()[n as usize] == dvec3(0.0, 0.0, 2.0)));
    assert_eq!(scene.mesh.positions()[3], DVec3::Y);
}

#[test]
fn a_framed_mesh_is_wholly_on_the_screen() {
    for (name, up) in [("y up", "[0, 1, 0]"), ("z up", "[0, 0, 1]"), ("x up", "[1, 0, 0]")] {
        for size in ["[640, 480]", "[100, 400]"] {
            let text = format!("mesh = 'mesh.obj'\nsize = {size}\ncamera.up = {up}\n");
            let box_obj = "v 3 0 0\nv 9 0 0\nv 9 5 0\nv 3 5 0\nv 3 0 7\nv 9 0 7\nv 9 5 7\nv 3 5 7\n\
                           f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
            let folder = folder("framed", &[("mesh.obj", box_obj), ("scene.toml", &text)]);
            let scene = load(&folder.join("scene.toml")).unwrap();
            let p = scene.project().unwrap();
            assert_eq!((p.counts.polygons, p.counts.drawn), (12, 12), "{name}");
            let (width, height) = (scene.size.width() as i32 * 16, scene.size.height() as i32 * 16);
            let inside = |x: i32, side: i32| x >= 0 && x <= side;
            assert!(p.vertices.iter().flatten().all(|v| inside(v.x, width) && inside(v.y, height)), "{name}");
            let ties = golden::ties(p.size, &p.triangles);
            assert!(ties.covered * 12 > p.size.pixels() as u64, "{name}: the mesh is tiny");
        }
    }
}

#[test]
fn normals_are_computed_where_they_lack() {
    let folder = folder(
        "normals",
        &[("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nvn 1 0 0\nf 1 2 3\nf 1//1 3//1 4//1\n")],
    );
    let scene = load(&folder.join("mesh.obj")).unwrap();
    assert_eq!(scene.mesh.normals()[1], DVec3::Z);
    assert_eq!(scene.mesh.normals()[3], DVec3::NEG_X);
    assert_eq!(
        scene.warnings,
        [format!(
            "{}:6: this face has no normals and others have, so all normals are computed: export all or none",
            folder.join("mesh.obj").display()
        )]
    );
}

#[test]
fn a_missing_material_is_a_warning() {
    let folder = folder("no_mtl", &[("mesh.obj", &format!("mtllib lost.mtl\nusemtl red\n{TRIANGLE}"))]);
    let scene = load(&folder.join("mesh.obj")).unwrap();
    assert_eq!(scene.mesh.triangles()[0].diffuse, [0.8; 3]);
    assert_eq!(
        scene.warnings,
        [format!(
            "{0}:1: the material file {1} is missing, so its materials are grey: put it beside the mesh",
            folder.join("mesh.obj").display(),
            folder.join("lost.mtl").display()
        )]
    );
    fs::write(folder.join("lost.mtl"), "newmtl blue\nKd 0 0 1\n").unwrap();
    let scene = load(&folder.join("mesh.obj")).unwrap();
    assert_eq!(
        scene.warnings,
        [format!(
            "{}:2: no MTL file defines the material `red`, so it is grey: define it, or name its file with mtllib",
            folder.join("mesh.obj").display()
        )]
    );
    fs::write(folder.join("lost.mtl"), "newmtl red\nKd 0 1\n").unwrap();
    let error = load(&folder.join("mesh.obj")).unwrap_err();
    assert!(error.ends_with("lost.mtl:2: `Kd` with 2 numbers: give 1 or 3"), "{error}");
}

#[test]
fn malformed_meshes_are_refused_with_their_line() {
    let cases = [
        ("number", "v 0 0 0\nv 1 x 0\n", "mesh.obj:2: `x` after `v` is not a number: write it as in 1.5 or -2e-3"),
        ("nan", "v 0 NaN 0\n", "mesh.obj:1: `v` with the number `NaN`: give finite numbers below 1e100"),
        ("inf", "# c\nvn 0 1e999 0\n", "mesh.obj:2: `vn` with the number `1e999`: give finite numbers below 1e100"),
        ("count", "v 0 0\n", "mesh.obj:1: `v` with 2 numbers: give 3 or 4 or 6 or 7"),
        ("weight", "v 0 0 0 2\n", "mesh.obj:1: `v` with the weight 2: remove it: weights belong to free-form surfaces"),
        ("few", "v 0 0 0\nf 1 1\n", "mesh.obj:2: a face with 2 corners: give at least three"),
        (
            "range",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 4\n",
            "mesh.obj:5: the corner `4` names vertex 4, but 3 are defined above: correct the index, or move the definition above the face",
        ),
        (
            "back",
            "v 0 0 0\nf -1 -2 -1\n",
            "mesh.obj:2: the corner `-2` names vertex -2, but 1 are defined above: correct the index, or move the definition above the face",
        ),
        (
            "zero",
            "v 0 0 0\nf 0 1 1\n",
            "mesh.obj:2: the corner `0` names vertex 0, but 1 are defined above, and counting begins at 1: correct the index, or move the definition above the face",
        ),
        (
            "normal",
            "v 0 0 0\nf 1//1 1//1 1//1\n",
            "mesh.obj:2: the corner `1//1` names normal 1, but 0 are defined above: correct the index, or move the definition above the face",
        ),
        (
            "corner",
            "v 0 0 0\nf 1 1 1.5\n",
            "mesh.obj:2: the corner `1.5` of a face is malformed: write v, v/vt, v//vn or v/vt/vn with whole numbers",
        ),
        (
            "unknown",
            "v 0 0 0\nface 1 2 3\n",
            "mesh.obj:2: unknown statement `face`: an OBJ file of polygons has v, vn, vt, f, o, g, s, usemtl and mtllib; remove the line or export polygons",
        ),
        ("usemtl", "usemtl\n", "mesh.obj:1: `usemtl` without a name: give the name after it"),
        (
            "empty",
            "v 0 0 0\n",
            "mesh.obj: holds no face: export the mesh with its polygons (lines that begin with `f`)",
        ),
        ("nothing", "", "mesh.obj: holds no face: export the mesh with its polygons (lines that begin with `f`)"),
    ];
    for (name, text, sentence) in cases {
        assert_eq!(obj_error(name, text), sentence, "{name}");
    }
}

#[test]
fn a_mesh_without_any_area_is_refused() {
    let flat = "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n";
    assert_eq!(
        obj_error("flat", flat),
        "mesh.obj: holds no face with an area, so nothing would be drawn: give at least one face three corners that are not in a line"
    );
    let mixed = folder("mixed_area", &[("mesh.obj", &format!("{flat}v 0 1 0\nf 1 2 4\n"))]);
    assert_eq!(load(&mixed.join("mesh.obj")).unwrap().mesh.triangles().len(), 3);
}

#[test]
fn a_scene_file_says_what_differs() {
    let folder = folder(
        "scene",
        &[
            ("mesh.obj", TRIANGLE),
            (
                "scene.toml",
                "mesh = 'mesh.obj'\nsize = [320, 200]\nbackground = [1, 2, 3]\nambient = 0.5\n\
                 [camera]\neye = [0, 0, 5]\ntarget = [0.5, 0.5, 0]\nfov = 60\n\
                 [[light]]\ntoward = [0, 0, 1]\nintensity = 0.25\n",
            ),
            ("turned.toml", "mesh = 'teapot'\n[camera]\neye = [9, 0, 3]\n"),
        ],
    );
    let scene = load(&folder.join("scene.toml")).unwrap();
    assert_eq!((scene.size.width(), scene.size.height()), (320, 200));
    assert_eq!((scene.background, scene.lighting.ambient), ([1, 2, 3], 0.5));
    assert_eq!((scene.camera.eye, scene.camera.fov), (dvec3(0.0, 0.0, 5.0), 60.0));
    assert_eq!((scene.lighting.lights.len(), scene.lighting.lights[0].intensity), (1, 0.25));
    assert_eq!(scene.name, "scene");
    let turned = load(&folder.join("turned.toml")).unwrap();
    let teapot = Scene::builtin("teapot").unwrap();
    assert_eq!(turned.camera.eye, dvec3(9.0, 0.0, 3.0));
    assert_eq!((turned.camera.target, turned.mesh), (teapot.camera.target, teapot.mesh));
}

#[test]
fn bad_scene_files_are_refused_with_their_place() {
    let mesh = |rest: &str| format!("mesh = 'mesh.obj'\n{rest}");
    let camera = |rest: &str| mesh(&format!("[camera]\n{rest}"));
    let light = |rest: &str| mesh(&format!("[[light]]\n{rest}"));
    let cases = [
        ("syntax", mesh("size = [640,\n"), "scene.toml:2:13: unclosed array: write `]`"),
        (
            "key",
            camera("eyes = [0, 0, 1]"),
            "scene.toml:3:1: unknown key `eyes`: write one of `eye`, `target`, `up`, `fov`",
        ),
        ("type", mesh("size = 'large'"), "scene.toml:2:8: invalid type: string \"large\": write an array of length 2"),
        ("no_mesh", "size = [6, 4]".into(), "scene.toml:1:1: missing key `mesh`: add it"),
        (
            "zero",
            mesh("size = [0, 480]"),
            "scene.toml:2:8: an image of 0x480 pixels cannot be rendered: give a width and a height between 1 and 2048",
        ),
        (
            "large",
            mesh("size = [640, 2049]"),
            "scene.toml:2:8: an image of 640x2049 pixels cannot be rendered: give a width and a height between 1 and 2048",
        ),
        (
            "negative",
            mesh("size = [640, -480]"),
            "scene.toml:2:8: an image of 640x-480 pixels cannot be rendered: give a width and a height between 1 and 2048",
        ),
        (
            "fov",
            camera("fov = -30"),
            "scene.toml:3:7: the camera's field of view is -30 degrees: give an angle above 0 and below 180",
        ),
        (
            "fov_nan",
            camera("fov = nan"),
            "scene.toml:3:7: the camera's field of view is NaN degrees: give an angle above 0 and below 180",
        ),
        (
            "eye",
            camera("eye = [1, 2, 3]\ntarget = [1, 2, 3]"),
            "scene.toml:3:7: the camera's eye and target are the same point, [1, 2, 3]: move one of them",
        ),
        (
            "up",
            camera("up = [0, 0, 1]\neye = [0, 0, 9]\ntarget = [0, 0, 0]"),
            "scene.toml:4:7: the camera's up, [0, 0, 1], is zero or parallel to its line of sight: choose another up",
        ),
        (
            "nan",
            camera("eye = [0, nan, 1]"),
            "scene.toml:3:7: [0.0, NaN, 1.0] is not a point or a direction: give three finite numbers below 1e100",
        ),
        (
            "behind",
            camera("eye = [0, 0, -5]\ntarget = [0, 0, -9]"),
            "scene.toml:3:7: nothing of the mesh is in front of the camera at [0, 0, -5] looking towards [0, 0, -9]: move the eye or the target",
        ),
        (
            "background",
            mesh("background = [0, 0, 256]"),
            "scene.toml:2:14: the background is [0, 0, 256]: give red, green and blue from 0 to 255",
        ),
        ("ambient", mesh("ambient = -1"), "scene.toml:2:11: the ambient light is -1: give a number from 0 to 1"),
        (
            "light",
            light("toward = [0, 0, 0]\nintensity = 1"),
            "scene.toml:3:10: the direction of light 1 is [0, 0, 0]: give the direction towards the light, not all zero",
        ),
        (
            "dark",
            light("toward = [0, 0, 1]\nintensity = -1"),
            "scene.toml:4:13: the intensity of light 1 is -1: give a number from 0 to less than 1e6",
        ),
        (
            "glaring",
            light("toward = [0, 0, 1]\nintensity = 1e308"),
            "scene.toml:4:13: the intensity of light 1 is 1e308: give a number from 0 to less than 1e6",
        ),
        ("long_size", mesh("size = [6, 4, 2]"), "scene.toml:2:8: invalid length 3: write an array of length 2"),
        (
            "long_background",
            mesh("background = [1, 2, 3, 4]"),
            "scene.toml:2:14: invalid length 4: write an array of length 3",
        ),
        ("long_eye", camera("eye = [0, 0, 5, 7]"), "scene.toml:3:7: invalid length 4: write an array of length 3"),
        ("short_eye", camera("eye = [0, 5]"), "scene.toml:3:7: invalid length 2: write an array of length 3"),
        (
            "long_light",
            light("toward = [0, 0, 1, 0]\nintensity = 1"),
            "scene.toml:3:10: invalid length 4: write an array of length 3",
        ),
        (
            "one_light",
            mesh("[light]\ntoward = [0, 0, 1]\nintensity = 1"),
            "scene.toml:2:1: `light` is one table: write `[[light]]` above each light",
        ),
        (
            "light_number",
            mesh("light = 1"),
            "scene.toml:2:9: invalid type: integer `1`: write `[[light]]` above each light",
        ),
        (
            "lost",
            "mesh = 'lost.obj'".into(),
            "scene.toml:1:8: there is no mesh lost.obj: the path is relative to the scene file's folder; correct it",
        ),
        (
            "kind",
            "\nmesh = 'teepot'".into(),
            "scene.toml:2:8: the mesh `teepot` is neither an .obj file nor a built-in scene: did you mean `teapot`? Name an .obj file, or one of teapot, ter1k, ter250",
        ),
        (
            "other",
            "mesh = 'dragon'".into(),
            "scene.toml:1:8: the mesh `dragon` is neither an .obj file nor a built-in scene: name an .obj file, or one of teapot, ter1k, ter250",
        ),
    ];
    for (name, text, sentence) in cases {
        assert_eq!(toml_error(name, &text), sentence, "{name}");
    }
}

#[test]
fn a_bad_mesh_of_a_scene_file_is_named_itself() {
    let folder = folder("inner", &[("scene.toml", "mesh = 'mesh.obj'"), ("mesh.obj", "v 0 0 0\nf 1 2 3\n")]);
    let error = load(&folder.join("scene.toml")).unwrap_err();
    assert!(error.contains("mesh.obj:2: the corner `2` names vertex 2"), "{error}");
}

//! Scene files in TOML: a good one, and every bad one with its whole sentence.

use crate::load::{TRIANGLE, folder, load, toml_error};
use glam::dvec3;
use tilewright_scenes::sphere::Sphere;
use tilewright_scenes::{Mesh, Scene, project_polygons};

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
    assert_eq!(scene.files, ["scene.toml", "mesh.obj"].map(|name| folder.join(name)));
    let turned = load(&folder.join("turned.toml")).unwrap();
    let teapot = Scene::builtin("teapot").unwrap();
    assert_eq!(turned.camera.eye, dvec3(9.0, 0.0, 3.0));
    assert_eq!((turned.camera.target, turned.mesh), (teapot.camera.target, teapot.mesh));
}

#[test]
fn spheres_need_no_mesh_and_are_framed() {
    let sphere = "[[sphere]]\ncentre = [5, 6, 7]\nradius = 2\ncolour = [10, 20, 255]\n";
    let both = format!("mesh = 'mesh.obj'\n{sphere}{sphere}");
    let folder = folder("spheres", &[("mesh.obj", TRIANGLE), ("alone.toml", sphere), ("both.toml", &both)]);
    let alone = load(&folder.join("alone.toml")).unwrap();
    assert_eq!(alone.spheres, [Sphere { centre: dvec3(5.0, 6.0, 7.0), radius: 2.0, colour: [10, 20, 255] }]);
    assert_eq!((alone.camera.target, &alone.mesh), (dvec3(5.0, 6.0, 7.0), &Mesh::none()));
    let both = load(&folder.join("both.toml")).unwrap();
    assert_eq!((both.spheres.len(), both.mesh.triangles().len()), (2, 1));
    assert_eq!(both.camera.target, dvec3(3.5, 4.0, 4.5));
    for scene in [alone, both] {
        let polygons = project_polygons(&scene, scene.size).unwrap();
        assert_eq!((polygons.spheres.len(), polygons.warning()), (scene.spheres.len(), None));
    }
}

#[test]
fn bad_scene_files_are_refused_with_their_place() {
    let mesh = |rest: &str| format!("mesh = 'mesh.obj'\n{rest}");
    let camera = |rest: &str| mesh(&format!("[camera]\n{rest}"));
    let light = |rest: &str| mesh(&format!("[[light]]\n{rest}"));
    let sphere = |rest: &str| mesh(&format!("[[sphere]]\n{rest}"));
    let cases = [
        ("syntax", mesh("size = [640,\n"), "scene.toml:2:13: unclosed array: write `]`"),
        (
            "key",
            camera("eyes = [0, 0, 1]"),
            "scene.toml:3:1: unknown key `eyes`: write one of `eye`, `target`, `up`, `fov`",
        ),
        ("type", mesh("size = 'large'"), "scene.toml:2:8: invalid type: string \"large\": write an array of length 2"),
        ("twice", mesh("size = [6, 4]\nsize = [6, 4]"), "scene.toml:3:1: duplicate key: correct the TOML"),
        ("no_mesh", "size = [6, 4]".into(), "scene.toml:1:1: missing key `mesh`, and no `[[sphere]]`: add one of them"),
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
            "scene.toml:3:7: the camera's field of view is -30 degrees: give an angle from 1e-6 to less than 180",
        ),
        (
            "narrow",
            camera("fov = 1e-20"),
            "scene.toml:3:7: the camera's field of view is 1e-20 degrees: give an angle from 1e-6 to less than 180",
        ),
        (
            "fov_nan",
            camera("fov = nan"),
            "scene.toml:3:7: the camera's field of view is NaN degrees: give an angle from 1e-6 to less than 180",
        ),
        (
            "eye",
            camera("eye = [1, 2, 3]\ntarget = [1, 2, 3]"),
            "scene.toml:3:7: the camera's eye and target are the same point, [1, 2, 3]: move one of them",
        ),
        (
            "up",
            camera("up = [0, 0, 1]\neye = [0, 0, 9]\ntarget = [0, 0, 0]"),
            "scene.toml:3:6: the camera's up, [0, 0, 1], is zero or parallel to its line of sight: choose another up",
        ),
        (
            "zero_up",
            camera("eye = [0, 0, 9]\nup = [0, 0, 0]"),
            "scene.toml:4:6: the camera's up, [0, 0, 0], is zero or parallel to its line of sight: choose another up",
        ),
        (
            "up_of_target",
            camera("fov = 40\neye = [0, 9, 0]\ntarget = [0, 0, 0]"),
            "scene.toml:4:7: the camera's up, [0, 1, 0], is zero or parallel to its line of sight: choose another up",
        ),
        (
            "camera_number",
            mesh("camera = 1"),
            "scene.toml:2:10: invalid type: integer `1`: write `[camera]` above its keys",
        ),
        (
            "cameras",
            mesh("[[camera]]\nfov = 40"),
            "scene.toml:2:1: invalid type: sequence: write `[camera]` above its keys",
        ),
        (
            "camera_list",
            mesh("camera = [[0, 0, 5]]"),
            "scene.toml:2:10: invalid type: sequence: write `[camera]` above its keys",
        ),
        (
            "light_list",
            mesh("light = [[[0, 0, 1], 1]]"),
            "scene.toml:2:10: invalid type: sequence: write `[[light]]` above each light",
        ),
        (
            "light_numbers",
            mesh("light = [1]"),
            "scene.toml:2:10: invalid type: integer `1`: write `[[light]]` above each light",
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
            "sphere_number",
            mesh("sphere = 1"),
            "scene.toml:2:10: invalid type: integer `1`: write `[[sphere]]` above each sphere",
        ),
        (
            "one_sphere",
            "[sphere]\ncentre = [0, 0, 1]\nradius = 1\ncolour = [1, 2, 3]".into(),
            "scene.toml:1:1: `sphere` is one table: write `[[sphere]]` above each sphere",
        ),
        ("no_radius", sphere("centre = [0, 0, 1]"), "scene.toml:2:1: missing key `radius`: add it"),
        (
            "weight",
            sphere("weight = 3"),
            "scene.toml:3:1: unknown key `weight`: write one of `centre`, `radius`, `colour`",
        ),
        (
            "small",
            sphere("centre = [0, 0, 1]\nradius = 0\ncolour = [1, 2, 3]"),
            "scene.toml:4:10: the radius of sphere 1 is 0: give a number above 0, from 1e-100 to less than 1e100",
        ),
        (
            "second",
            sphere("centre = [0, 0, 1]\nradius = 1\ncolour = [1, 2, 3]\n[[sphere]]\ncentre = [0, 1, 1]\nradius = nan\ncolour = [1, 2, 3]"),
            "scene.toml:8:10: the radius of sphere 2 is NaN: give a number above 0, from 1e-100 to less than 1e100",
        ),
        (
            "centre",
            sphere("centre = [0, inf, 1]\nradius = 1\ncolour = [1, 2, 3]"),
            "scene.toml:3:10: [0.0, inf, 1.0] is not a point or a direction: give three finite numbers below 1e100",
        ),
        (
            "colour",
            sphere("centre = [0, 0, 1]\nradius = 1\ncolour = [1, 2, -3]"),
            "scene.toml:5:10: the colour is [1, 2, -3]: give red, green and blue from 0 to 255",
        ),
        (
            "hidden",
            "camera.eye = [0, 0, 9]\ncamera.target = [0, 0, 20]\n[[sphere]]\ncentre = [0, 0, 1]\nradius = 1\ncolour = [1, 2, 3]".into(),
            "scene.toml:1:14: nothing of the scene is in front of the camera at [0, 0, 9] looking towards [0, 0, 20]: move the eye or the target",
        ),
        (
            "lost",
            "mesh = 'lost.obj'".into(),
            "scene.toml:1:8: there is no mesh lost.obj: the path is relative to the scene file's folder; correct it",
        ),
        (
            "kind",
            "\nmesh = 'teepot'".into(),
            "scene.toml:2:8: the mesh `teepot` is neither a mesh file nor a built-in scene: did you mean `teapot`? Name an .obj, .gltf, .glb, .ply or .stl file, or one of teapot, teapot16, table, ter1k, ter250, wireframe, star, textured, molecule",
        ),
        (
            "other",
            "mesh = 'dragon'".into(),
            "scene.toml:1:8: the mesh `dragon` is neither a mesh file nor a built-in scene: name an .obj, .gltf, .glb, .ply or .stl file, or one of teapot, teapot16, table, ter1k, ter250, wireframe, star, textured, molecule",
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

//! Whatever a file holds, loading it ends in a scene or in a sentence, never in a panic.

use proptest::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use tilewright_scenes::{Frame, Scene, Size, golden, project, project_polygons};

fn path(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("no_panic");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

/// Loads the file and, if that works, renders a small frame of it.
fn try_out(path: &Path) -> Result<(), TestCaseError> {
    match Scene::load(path.to_str().unwrap()) {
        Ok(scene) => {
            let size = Size::new(16, 12).unwrap();
            if let Ok(p) = project(&scene, size) {
                golden::render(size, &p.triangles, scene.background);
            }
            if let Ok(p) = project_polygons(&scene, size) {
                golden::render_polygons(&p, golden::Rule::Least, scene.background);
            }
        }
        Err(error) => {
            let sentence = error.to_string();
            prop_assert!(!sentence.contains('\n'), "{}", sentence);
            prop_assert!(sentence.contains(path.file_name().unwrap().to_str().unwrap()), "{}", sentence);
        }
    }
    Ok(())
}

fn word() -> impl Strategy<Value = String> {
    prop_oneof![
        3 => (-9i64..9).prop_map(|i| i.to_string()),
        2 => any::<f64>().prop_map(|x| x.to_string()),
        1 => "[0-9/ .eE+-]{0,6}",
        1 => "(mtllib|usemtl|nan|inf|1e308|\\\\|#|é|\t)",
    ]
}

fn obj_line() -> impl Strategy<Value = String> {
    let keyword = prop_oneof![4 => Just("v"), 3 => Just("f"), 1 => Just("vn"), 1 => Just("vt"), 1 => Just("l"), 1 => Just("usemtl"), 1 => Just("mtllib")];
    let free = (keyword, proptest::collection::vec(word(), 0..6))
        .prop_map(|(keyword, words)| format!("{keyword} {}\n", words.join(" ")));
    let sound = prop_oneof![
        (-9.0..9.0f64, -9.0..9.0f64, -9.0..9.0f64).prop_map(|(x, y, z)| format!("v {x} {y} {z}\n")),
        Just("f -1 -2 -3\n".to_owned()),
        Just("f -3 -1 -2 -4 -5\n".to_owned()),
        Just("l -3 -1 -2/1 -3\n".to_owned()),
        Just("l -2 -1 -4 -4\n".to_owned()),
    ];
    prop_oneof![1 => free, 30 => sound]
}

fn toml_line() -> impl Strategy<Value = String> {
    let key = "(mesh|wireframe|size|background|ambient|camera|light|surface|surface.texture|surface.specular|surface.shininess|camera.eye|camera.fov|camera.up|camera.target|\\[camera\\]|\\[\\[light\\]\\]|\\[\\[sphere\\]\\]|sphere|centre|radius|colour|toward|intensity|[a-z]{1,3})";
    let number = prop_oneof![
        (-9i64..3000).prop_map(|i| i.to_string()),
        any::<f64>().prop_map(|x| format!("{x:?}")),
        Just("nan".to_owned())
    ];
    let value = prop_oneof![
        number.clone(),
        proptest::collection::vec(number, 2..4).prop_map(|list| format!("[{}]", list.join(", "))),
        "'[ -~é]{0,5}'",
        Just("true".to_owned()),
        Just("{ eye = [1, 2, 3], fov = 1e-300 }".to_owned()),
        Just("[{ toward = [1, 0, 0], intensity = 1 }]".to_owned()),
        (any::<f64>(), any::<f64>())
            .prop_map(|(x, r)| format!("[{{ centre = [{x:?}, 0, 0], radius = {r:?}, colour = [9, 9, 9] }}]")),
        (-3.0..3.0f64, 1e-9..9.0f64)
            .prop_map(|(x, r)| format!("[{{ centre = [{x:?}, 0, 0], radius = {r:?}, colour = [9, 9, 9] }}]")),
    ];
    (key, value).prop_map(
        |(key, value)| {
            if key.starts_with('[') { format!("{key}\n") } else { format!("{key} = {value}\n") }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(600) })]

    #[test]
    fn an_obj_file(lines in proptest::collection::vec(obj_line(), 0..24)) {
        let path = path("random.obj");
        let begin = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nf 1 2 3\n";
        fs::write(&path, format!("{begin}{}", lines.concat())).unwrap();
        try_out(&path)?;
    }

    #[test]
    fn a_material_file(lines in proptest::collection::vec(("(newmtl|Kd|Ks|Ns|Ka|illum|map_Kd|#)", word(), word(), word()), 0..8)) {
        let path = path("coloured.obj");
        fs::write(&path, "mtllib random.mtl\nusemtl 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
        let text: String = lines.iter().map(|(k, a, b, c)| format!("{k} {a} {b} {c}\n")).collect();
        fs::write(path.with_file_name("random.mtl"), text).unwrap();
        if let Err(error) = Scene::load(path.to_str().unwrap()) {
            prop_assert!(error.to_string().contains("random.mtl:"), "{}", error);
        }
    }

    #[test]
    fn a_scene_file(lines in proptest::collection::vec(toml_line(), 0..6), named in any::<bool>()) {
        let path = path("random.toml");
        let mesh = if named { "mesh = 'teapot'\n" } else { "mesh = 'sound.obj'\n" };
        fs::write(path.with_file_name("sound.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
        fs::write(&path, format!("{mesh}{}", lines.concat())).unwrap();
        try_out(&path)?;
    }

    #[test]
    fn bytes_of_any_kind(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        for name in ["bytes.obj", "bytes.toml"] {
            fs::write(path(name), &bytes).unwrap();
            try_out(&path(name))?;
        }
        fs::write(path("bytes.png"), &bytes).unwrap();
        prop_assert!(Frame::read_png(path("bytes.png")).is_err());
    }
}

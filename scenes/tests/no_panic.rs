//! Whatever a file contains, loading it gives a scene or an error message, never a panic.

use proptest::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use tilewright_scenes::deferred::{Samples, project_deferred};
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
            if let Ok(deferred) = project_deferred(&scene, size, Samples::One) {
                golden::render_deferred(&deferred);
            }
            if let Ok(p) = project_polygons(&scene, size) {
                golden::render_polygons(&p, golden::Rule::Least, scene.background);
            }
            if let Ok(deferred) = project_deferred(&scene, size, Samples::One) {
                golden::render_deferred(&deferred);
            }
            for warning in &scene.warnings {
                prop_assert!(!warning.contains(char::is_control), "{:?}", warning);
            }
        }
        Err(error) => {
            let sentence = error.to_string();
            prop_assert!(!sentence.contains('\n'), "{}", sentence);
            // The file, or that of its materials.
            let named =
                [path, &path.with_extension("mtl")].map(|path| path.file_name().unwrap().to_str().unwrap().to_owned());
            prop_assert!(named.iter().any(|name| sentence.contains(name)), "{}", sentence);
        }
    }
    Ok(())
}

fn word() -> impl Strategy<Value = String> {
    prop_oneof![
        3 => (-9i64..9).prop_map(|i| i.to_string()),
        2 => any::<f64>().prop_map(|x| x.to_string()),
        1 => "[0-9/ .eE+-]{0,6}",
        1 => "(mtllib|usemtl|nan|inf|1e308|-nan\\(ind\\)|1.#QNAN|255|\\\\|#|é|\t|\"|off|random.mtl|.\\\\random.mtl)",
    ]
}

fn obj_line() -> impl Strategy<Value = String> {
    let keyword = prop_oneof![
        4 => Just("v"), 3 => Just("f"), 1 => Just("vn"), 1 => Just("vt"), 1 => Just("l"), 1 => Just("usemtl"), 1 => Just("mtllib"),
        1 => Just("s"), 1 => Just("p"), 1 => Just("g"), 1 => Just("V")
    ];
    let free = (keyword, proptest::collection::vec(word(), 0..6))
        .prop_map(|(keyword, words)| format!("{keyword} {}\n", words.join(" ")));
    let sound = prop_oneof![
        (-9.0..9.0f64, -9.0..9.0f64, -9.0..9.0f64).prop_map(|(x, y, z)| format!("v {x} {y} {z}\n")),
        Just("f -1 -2 -3\n".to_owned()),
        Just("f -3 -1 -2 -4 -5\n".to_owned()),
        Just("l -3 -1 -2/1 -3\n".to_owned()),
        Just("l -2 -1 -4 -4\n".to_owned()),
        (-9.0..9.0f64, 0.0..1.5f64).prop_map(|(x, c)| format!("v {x} 1 2 {c} 0 1\n")),
        (-9.0..9.0f64, -1e3..1e3f64).prop_map(|(u, v)| format!("vt {u} {v}\n")),
        Just("vn nan 0 1\nvn 0 0 0\n".to_owned()),
        Just("vt 0 0\nvn 0 0 1\nf -1/-1/-1 -2/-1 -3//-1\n".to_owned()),
        "s (off|0|1|2|)\n",
        "usemtl (1|2|one #2|1 #x)\n",
        "f -1 -2 \\\\\n -3\n",
    ];
    prop_oneof![1 => free, 30 => sound]
}

/// Operands of `map_Kd`: valid options and odd ones, before a name and after it.
fn map_line() -> impl Strategy<Value = String> {
    let number = prop_oneof![4 => (-9.0..9.0f64).prop_map(|x| x.to_string()), 1 => word()];
    let option = prop_oneof![
        ("-[sotSOT]", proptest::collection::vec(number, 0..4)).prop_map(|(o, n)| format!("{o} {}", n.join(" "))),
        "-clamp (on|off|)",
        "-(blendu|blendv|cc|mm|texres|bm|boost|imfchan|type|x) (on|off|1|0 1|)",
    ];
    let options = || proptest::collection::vec(option.clone(), 0..4).prop_map(|options| options.join(" "));
    (options(), "(t.png|T.PNG|\"t.png\"|a/t.png|.\\\\t.png|C:\\\\t.png|lost.png|)", options())
        .prop_map(|(before, name, behind)| format!("map_Kd {before} {name} {behind}\n"))
}

/// Bytes but those that end a line, or that no text has.
fn name_bytes() -> impl Strategy<Value = Vec<u8>> {
    let byte = prop_oneof![2 => any::<u8>(), 2 => prop::sample::select(&b" \t#\\/-\"'.:"[..]), 1 => Just(b'a')];
    proptest::collection::vec(byte.prop_filter("a text", |byte| !matches!(byte, 0 | b'\n' | b'\r')), 0..24)
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

/// A binary STL file of two facets.
fn stl() -> Vec<u8> {
    let facet = [0.0_f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.5];
    let facet: Vec<u8> = facet.iter().flat_map(|number| number.to_le_bytes()).chain([0, 0x80]).collect();
    [&[0; 80][..], &2_u32.to_le_bytes(), &facet, &facet].concat()
}

const STL: &str =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n\
                   property uchar green\nproperty uchar blue\nproperty float s\nproperty float t\nelement face 1\n\
                   property list uchar int vertex_indices\nelement tristrips 1\nproperty list int int vertex_indices\nelement edge 1\n\
                   property int vertex1\nproperty int vertex2\nend_header\n0 0 0 255 0 0 0 0\n1 0 0 0 255 0 1 0\n1 1 0 0 0 255 1 1\n\
                   0 1 0.5 9 9 9 0 1\n4 0 1 2 3\n4 0 1 2 -1\n0 3\n";

/// The same in binary, but for strips and edges.
fn binary_ply() -> Vec<u8> {
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                  element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let numbers = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let mut bytes = header.as_bytes().to_vec();
    bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    bytes.push(3);
    bytes.extend([0_i32, 1, 2].iter().flat_map(|number| number.to_le_bytes()));
    bytes
}

const GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1],"rotation":[0,0,0,1]},
{"mesh":0,"scale":[1,2,1],"translation":[0,0,1]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":0},
"indices":2,"material":0,"mode":4}]}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[1,0.5,0,1]}}],
"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071}],"images":[{"bufferView":1,"mimeType":"image/png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"},
{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR","sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},
"values":{"bufferView":1}}}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}],
"buffers":[{"byteLength":39"#;

/// A binary glTF file of one triangle.
fn glb() -> Vec<u8> {
    let json = format!("{GLTF}}}]}}");
    let numbers = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes);
    let blob = [numbers.as_flattened(), &[0, 1, 2]].concat();
    let part = |kind: &[u8], bytes: &[u8]| [&(bytes.len() as u32).to_le_bytes(), kind, bytes].concat();
    let body = [part(b"JSON", json.as_bytes()), part(b"BIN\0", &blob)].concat();
    [b"glTF\x02\0\0\0", &(12 + body.len() as u32).to_le_bytes()[..], &body].concat()
}

/// A valid file with some changed bytes, a missing piece, or replaced numbers.
fn changed(sound: Vec<u8>) -> impl Strategy<Value = Vec<u8>> {
    let length = sound.len();
    let bytes = proptest::collection::vec((0..length, any::<u8>()), 0..6);
    let numbers = "(-1|0|1|7|255|65536|4294967295|4294967296|1e39|-9e99|nan|18446744073709551615|\"x\"|\\[\\]|null)";
    let digits: Vec<usize> = (0..length).filter(|&i| sound[i].is_ascii_digit()).collect();
    let place = prop_oneof![9 => proptest::sample::select([digits, vec![0]].concat()), 1 => 0..length];
    let number = (place, numbers);
    (bytes, proptest::collection::vec(number, 0..3), 0..length, 0..8_usize, 0..4_u32).prop_map(
        move |(bytes, numbers, cut, gone, what)| {
            let mut all = sound.clone();
            match what {
                0 => bytes.iter().for_each(|&(i, byte)| all[i] = byte),
                1 => drop(all.drain(cut..(cut + gone).min(length))),
                2 => all.truncate(cut),
                // From behind, so that the places before stay.
                _ => {
                    let mut numbers = numbers.clone();
                    numbers.sort_by_key(|(i, _)| std::cmp::Reverse(*i));
                    numbers.iter().for_each(|(i, number)| drop(all.splice(i..=i, number.bytes())));
                }
            }
            all
        },
    )
}

/// Valid files of each kind; the tests below need them to be valid.
#[test]
fn the_files_that_are_changed_are_sound() {
    for (name, bytes) in sound() {
        fs::write(path(name), bytes).unwrap();
        Scene::load(path(name)).unwrap();
    }
}

fn sound() -> [(&'static str, Vec<u8>); 5] {
    [("a.stl", stl()), ("b.stl", STL.into()), ("a.ply", PLY.into()), ("b.ply", binary_ply()), ("a.glb", glb())]
}

/// A mesh file of a kind, changed.
fn changed_file() -> impl Strategy<Value = (&'static str, Vec<u8>)> {
    let each = sound().map(|(name, bytes)| changed(bytes).prop_map(move |bytes| (name, bytes)).boxed());
    proptest::strategy::Union::new(each)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(4000) })]

    #[test]
    fn a_mesh_file_that_was_changed((name, bytes) in changed_file()) {
        let path = path(&format!("changed_{name}"));
        fs::write(&path, bytes).unwrap();
        try_out(&path)?;
    }

}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    /// Every changed picture gives a texture or an error message.
    #[test]
    fn a_picture_that_was_changed(kind in 0..4_usize, places in proptest::collection::vec((0..600_usize, any::<u8>()), 1..5)) {
        let name = ["baseline.jpg", "progressive.jpg", "cmyk.jpg", "turned.jpg"][kind];
        let mut bytes = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("data/pictures").join(name)).unwrap();
        let length = bytes.len();
        places.iter().for_each(|&(i, byte)| bytes[i % length] = byte);
        fs::write(path("changed.jpg"), bytes).unwrap();
        fs::write(path("pictured.obj"), "mtllib pictured.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
        fs::write(path("pictured.mtl"), "newmtl a\nmap_Kd changed.jpg\n").unwrap();
        let scene = Scene::load(path("pictured.obj")).unwrap();
        if let Err(error) = &scene.mesh.materials().unwrap().textures[0] {
            prop_assert!(error.to_string().contains("changed.jpg"), "{}", error);
        }
    }
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
    fn a_material_file(
        lines in proptest::collection::vec(("(newmtl|Kd|Ks|Ns|Ka|d|Tr|Ke|illum|map_Kd|map_Ka|bump|x|#)", word(), word(), word()), 0..8),
        maps in proptest::collection::vec(map_line(), 0..3),
    ) {
        let path = path("coloured.obj");
        let mesh = "mtllib random.mtl\nusemtl 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt -3 0.5\nvt 2 9\nf 1/1 2/2 3/1\n";
        fs::write(&path, mesh).unwrap();
        Frame::blank(Size::new(4, 4).unwrap(), [9; 3]).write_png(path.with_file_name("t.png")).unwrap();
        let text: String = lines.iter().map(|(k, a, b, c)| format!("{k} {a} {b} {c}\n")).collect();
        fs::write(path.with_file_name("random.mtl"), format!("newmtl 1\n{}{text}", maps.concat())).unwrap();
        match Scene::load(path.to_str().unwrap()) {
            Err(error) => prop_assert!(error.to_string().contains("random.mtl:"), "{}", error),
            Ok(scene) => {
                if let Ok(deferred) = project_deferred(&scene, Size::new(16, 12).unwrap(), Samples::One) {
                    golden::render_deferred(&deferred);
                }
            }
        }
    }

    /// Bytes of any kind in names and between them.
    #[test]
    fn names_of_any_bytes(
        library in name_bytes(), material in name_bytes(), texture in name_bytes(), operand in name_bytes(),
    ) {
        let path = path("named.obj");
        let mesh = [b"mtllib named.mtl ", &library[..], b"\nusemtl ", &material, b"\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng ", &operand, b"\n"];
        fs::write(&path, mesh.concat()).unwrap();
        let materials = [b"newmtl ", &material[..], b"\nmap_Kd ", &texture, b"\nmap_Kd -s 2 ", &operand, b"\n"];
        fs::write(path.with_file_name("named.mtl"), materials.concat()).unwrap();
        try_out(&path)?;
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
        for name in ["bytes.obj", "bytes.toml", "bytes.gltf", "bytes.glb", "bytes.ply", "bytes.stl"] {
            fs::write(path(name), &bytes).unwrap();
            try_out(&path(name))?;
        }
        fs::write(path("bytes.png"), &bytes).unwrap();
        prop_assert!(Frame::read_png(path("bytes.png")).is_err());
    }
}

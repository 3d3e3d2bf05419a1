//! Meshes as programs write them, each with its picture and all its warnings.
//!
//! The files are in `tests/data/real`, a folder for each. A picture is a grid of letters, rows from the top; each stands for the colour in the middle of its
//! part of the frame. Light comes from everywhere, so colours are those of the files.

use crate::load::folder;
use crate::load::real_cases::{CASES, Case};
use std::fs;
use std::path::{Path, PathBuf};
use tilewright_scenes::deferred::{Samples, project_deferred};
use tilewright_scenes::{Camera, Frame, Lighting, Scene, Size, golden};

/// Pixels a side of a frame, which shows -1 to 1.
const SIDE: u32 = 32;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data/real").join(name)
}

/// The scene of a file, seen from the front.
fn seen(path: &Path) -> Scene {
    let scene = Scene::load(path).unwrap_or_else(|error| panic!("{error}"));
    let eye = glam::dvec3(0.0, 0.0, 5.0);
    // Half of it is an angle whose tangent is 1/5.
    let fov = 0.2_f64.atan().to_degrees() * 2.0;
    let camera = Camera { eye, target: glam::DVec3::ZERO, up: glam::DVec3::Y, fov };
    Scene { camera, size: Size::new(SIDE, SIDE).unwrap(), background: [255, 0, 255], ..scene }
}

/// The same, with light from everywhere.
fn bright(path: &Path) -> Scene {
    Scene { lighting: Lighting { ambient: 1.0, lights: Vec::new() }, ..seen(path) }
}

/// The picture of machines that draw only colours, and that of deferred shading.
fn frames(scene: &Scene) -> [Frame; 2] {
    let projection = scene.project().unwrap();
    let plain = golden::render(projection.size, &projection.triangles, scene.background);
    let deferred = project_deferred(scene, scene.size, Samples::One).unwrap_or_else(|error| panic!("{error}"));
    [plain, golden::render_deferred(&deferred)]
}

fn letter(rgb: [u8; 3]) -> char {
    let known = [
        ('R', [255, 0, 0]),
        ('G', [0, 255, 0]),
        ('B', [0, 0, 255]),
        ('W', [255; 3]),
        ('K', [0; 3]),
        ('g', [204; 3]),
        ('.', [255, 0, 255]),
    ];
    let is_near = |other: &[u8; 3]| rgb.iter().zip(other).all(|(a, b)| a.abs_diff(*b) <= 3);
    known.iter().find(|(_, other)| is_near(other)).map_or('?', |&(letter, _)| letter)
}

/// The colours in the middle of a grid's parts.
fn grid(frame: &Frame, parts: usize) -> String {
    let middle = |i: usize| (SIDE as usize * (2 * i + 1) / (2 * parts)) as u32;
    let row = |j: usize| (0..parts).map(|i| letter(frame.rgb(middle(i), middle(j)))).collect::<String>();
    (0..parts).map(row).collect::<Vec<_>>().join("/")
}

fn without_folder(warnings: &[String], folder: &Path) -> Vec<String> {
    warnings.iter().map(|warning| warning.replace(&format!("{}/", folder.display()), "")).collect()
}

/// The differences between a file's results and the expected ones.
fn faults(path: &Path, case: &Case) -> Vec<String> {
    let scene = bright(path);
    let warnings = without_folder(&scene.warnings, path.parent().unwrap());
    let mut faults: Vec<String> = Vec::new();
    if warnings != case.warnings {
        faults.push(format!("{}: {warnings:#?}", case.file));
    }
    for (frame, expected) in frames(&scene).iter().zip([case.plain, case.deferred]) {
        let seen = grid(frame, expected.split('/').count());
        if seen != expected {
            faults.push(format!("{}: {seen} in place of {expected}", case.file));
        }
    }
    faults
}

fn check(path: &Path, case: &Case) {
    assert_eq!(faults(path, case), [""; 0]);
}

#[test]
fn each_file_has_its_picture_and_its_warnings() {
    let faults: Vec<String> = CASES.iter().flat_map(|case| faults(&data(case.file), case)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Every mesh in the folder is in the table, or in a test below.
#[test]
fn no_file_is_left_out() {
    let others = ["vertex_colours_between", "smooth", "flat"];
    for entry in fs::read_dir(data("")).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir()) {
        let name = entry.file_name().unwrap().to_str().unwrap();
        let meshes = fs::read_dir(&entry).unwrap().map(|file| file.unwrap().path());
        for mesh in meshes.filter(|file| file.extension().is_some_and(|extension| extension == "obj")) {
            let file = format!("{name}/{}", mesh.file_name().unwrap().to_str().unwrap());
            assert!(others.contains(&name) || CASES.iter().any(|case| case.file == file), "{file}");
        }
    }
}

#[test]
fn colours_of_vertices_go_from_one_to_the_next() {
    for frame in frames(&bright(&data("vertex_colours_between/m.obj"))) {
        for x in 0..SIDE {
            let blue = (255.0 * (f64::from(x) + 0.5) / f64::from(SIDE)).round() as u8;
            let [r, g, b] = frame.rgb(x, 13);
            assert!(r.abs_diff(255 - blue) <= 2 && g == 0 && b.abs_diff(blue) <= 2, "{x}: {:?}", [r, g, b]);
        }
    }
}

/// A roof: smooth, its ridge is as bright as what lies level; flat, each side has one brightness.
#[test]
fn smoothing_groups_are_followed_where_normals_lack() {
    let of = |file: &str| {
        let scene = seen(&data(file));
        (frames(&scene), without_folder(&scene.warnings, &data(file.split('/').next().unwrap())))
    };
    let [smooth, flat] = ["smooth/m.obj", "flat/m.obj"].map(of);
    assert_eq!((&smooth.1[..], &flat.1[..]), (&[][..], &[][..]));
    for file in ["smooth/one_group.obj", "smooth/no_number.obj"] {
        assert_eq!(of(file), smooth, "{file}");
    }
    for file in ["flat/off.obj", "flat/zero.obj", "flat/two_groups.obj"] {
        assert_eq!(of(file), flat, "{file}");
    }
    let in_part = of("flat/in_part.obj");
    assert_eq!(in_part.0, flat.0);
    assert_eq!(
        in_part.1,
        ["in_part.obj:9: this face has no normals and others have, so its normals are computed: export all or none"]
    );
    for (smooth, flat) in smooth.0.iter().zip(&flat.0) {
        let row = |frame: &Frame, from: u32| (from..from + 12).map(|x| frame.rgb(x, 16)).collect::<Vec<_>>();
        assert!(row(flat, 2).windows(2).all(|pair| pair[0] == pair[1]), "a flat face is of one colour");
        assert!(row(smooth, 2).windows(2).any(|pair| pair[0] != pair[1]), "a smooth face is not");
    }
}

/// Names that a version control system might not keep.
#[test]
#[cfg(unix)]
fn files_of_other_encodings_are_found_by_their_bytes() {
    use std::os::unix::ffi::OsStrExt;
    let folder = folder("real_bytes", &[]);
    let path = |name: &'static [u8]| folder.join(std::ffi::OsStr::from_bytes(name));
    let quarters = fs::read(data("windows/textures/quarters.png")).unwrap();
    fs::create_dir(path(b"bilder f\xfcr")).unwrap();
    fs::write(path(b"bilder f\xfcr/gr\xfcn.png"), quarters).unwrap();
    fs::write(path(b"bilder f\xfcr/gr\xf6n.png"), "another").unwrap();
    fs::write(
        path(b"k\xf6ln.mtl"),
        b"newmtl gr\xfcn\nmap_Kd -s 1 1 1 bilder f\xfcr\\gr\xfcn.png\nnewmtl gr\xf6n\nKd 0 0 1\n",
    )
    .unwrap();
    let mesh = fs::read(data("windows/m.obj")).unwrap();
    let mesh: Vec<u8> = mesh.into_iter().filter(|&byte| byte != b'\r').collect();
    let from = mesh.iter().position(|&byte| byte == b'v').unwrap();
    fs::write(path(b"k\xf6ln.obj"), [b"mtllib k\xf6ln.mtl\nusemtl gr\xfcn\n", &mesh[from..]].concat()).unwrap();
    check(&path(b"k\xf6ln.obj"), &Case { file: "Latin-1", plain: "W", deferred: "RG/BW", warnings: &[] });
    fs::write(path(b"k\xf6ln.obj"), [b"mtllib k\xf6ln.mtl\nusemtl gr\xf7n\n", &mesh[from..]].concat()).unwrap();
    let warnings = &[
        "k\u{fffd}ln.obj:2: no MTL file defines the material `gr\\xf7n`, so it is grey: define it, or name its file with mtllib",
    ];
    check(&path(b"k\xf6ln.obj"), &Case { file: "no such byte", plain: "g", deferred: "g", warnings });
}

//! Oversized input is refused in a sentence that states the limit, before it fills the memory.

use crate::load::{TRIANGLE, folder, load, obj_error};
use std::fs::File;
use std::path::Path;

fn without_folder(sentence: String, folder: &Path) -> String {
    sentence.replace(&format!("{}/", folder.display()), "")
}

/// A file of that length that takes no room on the disk.
fn sparse(path: &Path, length: u64) {
    File::create(path).unwrap().set_len(length).unwrap();
}

#[test]
fn files_that_are_too_large_are_not_read() {
    let folder = folder("too_large", &[("mesh.obj", &format!("mtllib colours.mtl\n{TRIANGLE}"))]);
    let error = |name: &str| without_folder(load(&folder.join(name)).unwrap_err(), &folder);
    sparse(&folder.join("film.mp4"), 3 << 30);
    sparse(&folder.join("large.obj"), (256 << 20) + 1);
    sparse(&folder.join("large.toml"), (1 << 20) + 1);
    sparse(&folder.join("colours.mtl"), (16 << 20) + 1);
    let cases = [
        (
            "film.mp4",
            "film.mp4: is neither a scene file nor a mesh, going by its name: name a .toml, .obj, .gltf, .glb, .ply or .stl file",
        ),
        ("large.obj", "large.obj: is larger than 256 MiB, the most that is read: simplify the mesh, or cut it"),
        ("large.toml", "large.toml: is larger than 1 MiB, the most that is read: name a scene file"),
        ("mesh.obj", "colours.mtl: is larger than 16 MiB, the most that is read: remove what the mesh does not use"),
    ];
    for (name, sentence) in cases {
        assert_eq!(error(name), sentence);
    }
}

#[test]
fn a_file_of_just_the_limit_is_read() {
    let scene = "mesh = 'teapot'\nsize = [20, 10]\n";
    let padding = "#".repeat((1 << 20) - scene.len());
    let folder = folder("just_fits", &[("scene.toml", &format!("{scene}{padding}"))]);
    assert_eq!(load(&folder.join("scene.toml")).unwrap().size.width(), 20);
}

/// A device reports a length of 0, and never ends.
#[test]
#[cfg(unix)]
fn devices_are_read_no_further_than_files() {
    let folder = folder("endless", &[("mesh.obj", &format!("mtllib /dev/zero\n{TRIANGLE}"))]);
    for name in ["zero.toml", "zero.obj"] {
        std::os::unix::fs::symlink("/dev/zero", folder.join(name)).unwrap();
    }
    let error = |name: &str| without_folder(load(&folder.join(name)).unwrap_err(), &folder);
    assert_eq!(error("zero.toml"), "zero.toml: is larger than 1 MiB, the most that is read: name a scene file");
    assert_eq!(
        error("zero.obj"),
        "zero.obj: is larger than 256 MiB, the most that is read: simplify the mesh, or cut it"
    );
    assert_eq!(
        error("mesh.obj"),
        "/dev/zero: is larger than 16 MiB, the most that is read: remove what the mesh does not use"
    );
    assert_eq!(
        load("/dev/zero".as_ref()).unwrap_err(),
        "/dev/zero: is neither a scene file nor a mesh, going by its name: name a .toml, .obj, .gltf, .glb, .ply or .stl file"
    );
}

#[test]
fn numbers_out_of_reach_are_refused_at_their_line() {
    let sentence = |line: usize, what: &str, number: &str| {
        format!("mesh.obj:{line}: `{what}` with the number `{number}`: give finite numbers below 1e30")
    };
    assert_eq!(obj_error("reach_vast", &format!("{TRIANGLE}v 0 9e99 0\n")), sentence(5, "v", "9e99"));
    assert_eq!(obj_error("reach_negative", &format!("{TRIANGLE}v 0 -1e30 0\n")), sentence(5, "v", "-1e30"));
    assert_eq!(obj_error("reach_normal", &format!("vn 1e31 0 0\n{TRIANGLE}")), sentence(1, "vn", "1e31"));
    // Input just within the limit can be framed and drawn.
    let folder = folder("huge", &[("mesh.obj", "v 0 0 0\nv 9.9e29 0 0\nv 0 -9.9e29 0\nf 1 2 3\n")]);
    let projection = load(&folder.join("mesh.obj")).unwrap().project().unwrap();
    assert_eq!(projection.counts.drawn, 1);
}

#[test]
fn a_face_has_a_limited_number_of_corners() {
    let text = format!("{TRIANGLE}f{}\n", " 1 2 3".repeat(5462));
    assert_eq!(obj_error("many_corners", &text), "mesh.obj:5: a face with more than 16384 corners: cut it");
    let folder = folder("most_corners", &[("mesh.obj", &format!("{TRIANGLE}f{} 1\n", " 1 2 3".repeat(5461)))]);
    load(&folder.join("mesh.obj")).unwrap();
}

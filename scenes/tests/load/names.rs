//! Names in OBJ and MTL files: bytes up to the end of the line, and files that are matched by what exists.

use crate::load::{TRIANGLE, folder, load, obj_error};
use std::fs;
use tilewright_scenes::Scene;

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const BLUE: [f64; 3] = [0.0, 0.0, 1.0];
const GREY: [f64; 3] = [0.8; 3];

/// The colours of all triangles.
fn colours(scene: &Scene) -> Vec<[f64; 3]> {
    scene.mesh.triangles().iter().map(|t| t.diffuse).collect()
}

/// A mesh of two triangles of these materials, and its materials, red and blue.
fn two(first: &[u8], second: &[u8]) -> (Vec<u8>, Vec<u8>) {
    let corners = b"v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let mesh =
        [b"mtllib m.mtl\n", &corners[..], b"usemtl ", first, b"\nf 1 2 3\nusemtl ", second, b"\nf 3 2 1\n"].concat();
    let materials = [b"newmtl ", first, b"\nKd 1 0 0\nnewmtl ", second, b"\nKd 0 0 1\n"].concat();
    (mesh, materials)
}

#[test]
fn every_byte_of_a_name_counts() {
    let pairs: [(&[u8], &[u8]); 9] = [
        (b"Rough Grey #1", b"Rough Grey #2"),
        (b"#1", b"#2"),
        (b"a\\", b"b\\"),
        (b"\\", b"\\\\"),
        (b"gr\xe9", b"gr\xe8"),
        (b"a  b", b"a b"),
        (b"a\tb", b"a b"),
        (b"BMCD\\Solid_\\Matte", b"BMCD\\Solid_\\Shiny"),
        (b"Minecraft:dirt/49", b"Minecraft:dirt/50"),
    ];
    for (i, (first, second)) in pairs.into_iter().enumerate() {
        let folder = folder(&format!("bytes_{i}"), &[]);
        let (mesh, materials) = two(first, second);
        fs::write(folder.join("m.obj"), mesh).unwrap();
        fs::write(folder.join("m.mtl"), materials).unwrap();
        let scene = load(&folder.join("m.obj")).unwrap();
        assert_eq!(colours(&scene), [RED, BLUE], "{}", first.escape_ascii());
        assert_eq!(scene.warnings, [""; 0]);
    }
}

/// On Unix a name of a file is bytes, too.
#[test]
#[cfg(unix)]
fn a_file_is_found_by_its_bytes() {
    use std::os::unix::ffi::OsStrExt;
    let folder = folder("file_bytes", &[]);
    let name = |name: &'static [u8]| folder.join(std::ffi::OsStr::from_bytes(name));
    fs::write(folder.join("m.obj"), [b"mtllib k\xf6ln.mtl\nusemtl a\n", TRIANGLE.as_bytes()].concat()).unwrap();
    fs::write(name(b"k\xf6ln.mtl"), "newmtl a\nKd 1 0 0\n").unwrap();
    fs::write(name(b"k\xf7ln.mtl"), "newmtl a\nKd 0 0 1\n").unwrap();
    let scene = load(&folder.join("m.obj")).unwrap();
    assert_eq!((colours(&scene), &scene.warnings[..]), (vec![RED], &[][..]));
    assert_eq!(scene.files, [folder.join("m.obj"), name(b"k\xf6ln.mtl")]);
}

#[test]
fn either_slash_divides_folders_where_the_name_is_no_file() {
    for name in [".\\m.mtl", "sub\\..\\m.mtl", "./m.mtl", "sub//../m.mtl"] {
        let text = format!("mtllib {name}\nusemtl a\n{TRIANGLE}");
        let folder = folder("slashes", &[("m.obj", &text), ("m.mtl", "newmtl a\nKd 1 0 0\n")]);
        fs::create_dir(folder.join("sub")).unwrap();
        let scene = load(&folder.join("m.obj")).unwrap();
        assert_eq!((colours(&scene), &scene.warnings[..]), (vec![RED], &[][..]), "{name}");
    }
}

#[test]
fn of_a_list_of_files_the_longest_name_that_exists_is_meant() {
    let folder = folder("longest", &[("a b.mtl", "newmtl a\nKd 1 0 0\n"), ("b.mtl", "newmtl b\nKd 0 0 1\n")]);
    let path = folder.join("m.obj");
    for list in ["a b.mtl b.mtl", "b.mtl a b.mtl", "  a b.mtl\t b.mtl  "] {
        fs::write(&path, format!("mtllib {list}\n{}usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n", TRIANGLE)).unwrap();
        let scene = load(&path).unwrap();
        assert_eq!((colours(&scene), &scene.warnings[..]), (vec![GREY, RED, BLUE], &[][..]), "{list}");
    }
}

#[test]
fn seven_numbers_are_a_place_and_a_colour_with_alpha() {
    let text = "v 0 0 0 0.5 0.25 1 1\nv 1 0 0 0.5 0.25 1 1\nv 0 1 0 0.5 0.25 1 1\nf 1 2 3\n";
    let folder = folder("alpha", &[("m.obj", text)]);
    let scene = load(&folder.join("m.obj")).unwrap();
    assert_eq!(scene.warnings, [""; 0]);
}

/// The warnings for a mesh with this text, in a folder with files of these names; without the folder.
fn warnings(test: &str, text: &str, files: &[(&str, &str)]) -> Vec<String> {
    let folder = folder(test, &[&[("m.obj", text)], files].concat());
    let scene = load(&folder.join("m.obj")).unwrap();
    scene.warnings.iter().map(|warning| warning.replace(&format!("{}/", folder.display()), "")).collect()
}

#[test]
fn missing_files_are_named_once() {
    let text = format!("mtllib a b.mtl c.mtl\nmtllib d.mtl # the last\nusemtl x\n{TRIANGLE}usemtl y\n");
    let said = "m.obj:1: the material files a b.mtl and 2 more are missing, so their materials are grey: put them beside the mesh";
    assert_eq!(warnings("missing", &text, &[]), [said]);
    // A malformed file that nothing names is not read.
    assert_eq!(warnings("malformed_own", &text, &[("m.mtl", "newmtl\n")]), [said]);
}

#[test]
fn a_name_that_nothing_has_may_be_nearly_another() {
    let materials = "newmtl \"Dark  Red\" # of wood\nKd 1 0 0\nnewmtl a\nnewmtl A\n";
    let of = |name: &str| {
        let text = format!("mtllib x.mtl\nusemtl {name}\n{TRIANGLE}");
        warnings("nearly", &text, &[("x.mtl", materials)])
    };
    let drawn = |name: &str| {
        format!(
            "m.obj:2: no MTL file defines the material `{name}`, so `\"Dark  Red\" # of wood` is drawn: write both alike"
        )
    };
    for name in ["dark red", "\"Dark Red\"", "DARK\tRED # as that"] {
        assert_eq!(of(name), [drawn(&name.replace('\t', "\\t"))], "{name}");
    }
    assert_eq!(of("\"Dark  Red\""), [""; 0], "a comment alone makes no other name");
    let grey = "m.obj:2: no MTL file defines the material `á`, so it is grey: define it, or name its file with mtllib";
    assert_eq!(of("á"), [grey]);
    assert_eq!(of("a #1"), [""; 0]);
}

#[test]
fn numbers_of_another_land_are_refused_with_their_line() {
    let sentence = |line: &str| obj_error("numbers", &format!("{TRIANGLE}{line}\n"));
    let remedy = "write it as in 1.5 or -2e-3";
    assert_eq!(sentence("v 1,5 0 0"), format!("mesh.obj:5: `1,5` after `v` is not a number: {remedy}"));
    assert_eq!(sentence("v 1.#IND 0 0"), format!("mesh.obj:5: `1.#IND` after `v` is not a number: {remedy}"));
    assert_eq!(sentence("v -nan 0 0"), "mesh.obj:5: `v` with the number `-nan`: give finite numbers below 1e30");
    assert_eq!(sentence("vn 1 0"), "mesh.obj:5: `vn` with 2 numbers: give 3");
    assert_eq!(sentence("v 0 0 0 1 0"), "mesh.obj:5: `v` with 5 numbers: give 3 or 4 or 6 or 7");
    assert_eq!(
        sentence("v\u{a0}0 0 0"),
        "mesh.obj:5: unknown statement `v\u{a0}0`: an OBJ file of polygons and lines has v, vn, vt, f, l, o, g, s, usemtl and mtllib; remove the line or export polygons"
    );
}

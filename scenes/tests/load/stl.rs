//! STL files: the pictures of good ones, and every bad one with its whole sentence.

use crate::load::{bytes_error, folder, load, pictures, same_pictures, warned};
use glam::{DVec3, dvec3};
use std::fs;

/// The facets of a roof: corners, and the normal that the file states.
const FACETS: [([[f32; 3]; 3], [f32; 3]); 2] = [
    ([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.5]], [0.0, 0.0, 0.0]),
    ([[-1.0, -1.0, 0.0], [1.0, 1.0, 0.5], [-1.0, 1.0, -1.0]], [-0.75, 0.5, 1.0]),
];

/// The same in an OBJ file, flat; with colours if there are.
fn obj(colours: [&str; 2]) -> String {
    let mut text = "mtllib plain.mtl\n".to_owned();
    for (i, (corners, _)) in FACETS.iter().enumerate() {
        let [p, q, r] = corners.map(|corner| DVec3::from_array(corner.map(f64::from)));
        let n = (q - p).cross(r - p);
        for DVec3 { x, y, z } in [p, q, r] {
            text += &format!("v {x} {y} {z}\n");
        }
        text += &format!("vn {} {} {}\nusemtl {}\nf -3//{i} -2//{i} -1//{i}\n", n.x, n.y, n.z, colours[i], i = i + 1);
    }
    text
}

const MTL: &str = "newmtl grey\nKd 0.8\nnewmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";

fn ascii() -> String {
    let mut text = "solid two words\n".to_owned();
    for (corners, [x, y, z]) in FACETS {
        text += &format!("  facet normal {x} {y} {z:e}\n    outer loop\n");
        corners.iter().for_each(|[x, y, z]| text += &format!("      vertex {x} {y} {z}\n"));
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid two words\n"
}

fn binary(header: &[u8], attributes: [u16; 2]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend(2_u32.to_le_bytes());
    for ((corners, normal), attribute) in FACETS.iter().zip(attributes) {
        let numbers = normal.iter().chain(corners.as_flattened());
        bytes.extend(numbers.flat_map(|number| number.to_le_bytes()));
        bytes.extend(attribute.to_le_bytes());
    }
    bytes
}

#[test]
fn text_and_binary_files_are_flat_facets() {
    let folder = folder("stl", &[("plain.mtl", MTL), ("text.stl", &ascii())]);
    fs::write(folder.join("binary.STL"), binary(b"made by a test", [0, 3])).unwrap();
    // Many programs begin binary files as those of text.
    fs::write(folder.join("solid.stl"), binary(b"solid made by a test", [0; 2])).unwrap();
    fs::write(folder.join("upper.stl"), ascii().to_uppercase().replace('\n', "\r\n")).unwrap();
    for name in ["text.stl", "binary.STL", "solid.stl", "upper.stl"] {
        same_pictures(&folder.join(name), &obj(["grey", "grey"]), &[]);
    }
    assert_eq!(load(&folder.join("text.stl")).unwrap().camera.up, DVec3::Z);
}

#[test]
fn facets_have_the_colours_of_both_programs() {
    let folder = folder("stl_colours", &[("plain.mtl", MTL)]);
    let cases: [(&[u8], [u16; 2], [&str; 2]); 4] = [
        (b"VisCAM", [0x8000 | 31 << 10, 0x8000 | 31], ["red", "blue"]),
        (b"VisCAM", [31 << 10, 0x8000 | 31], ["grey", "blue"]),
        (b"Magics COLOR=\xff\0\0\xff,", [0x8000, 31 << 10], ["red", "blue"]),
        (b"Magics COLOR=\0\0\xff\xff,", [31, 0x8000], ["red", "blue"]),
    ];
    for (header, attributes, colours) in cases {
        fs::write(folder.join("a.stl"), binary(header, attributes)).unwrap();
        same_pictures(&folder.join("a.stl"), &obj(colours), &[]);
    }
}

#[test]
fn a_normal_that_contradicts_its_facet_is_a_warning() {
    let folder = folder("stl_normals", &[("plain.mtl", MTL)]);
    fs::write(folder.join("a.stl"), ascii().replace("normal 0 0 0e0", "normal 1 0 0")).unwrap();
    let warning =
        "a.stl: facet 1 states a normal that its corners do not have, and the corners' own is drawn: export it again";
    same_pictures(&folder.join("a.stl"), &obj(["grey", "grey"]), &[warning]);
    let both = ascii().replace("normal 0 0 0e0", "normal 1 0 0").replace("normal -0.75 0.5 1e0", "normal 0 5 0");
    fs::write(folder.join("a.stl"), both).unwrap();
    let warnings = warned(&load(&folder.join("a.stl")).unwrap(), &folder);
    assert!(warnings[0].starts_with("a.stl: facet 1 and 1 more state a normal that"), "{warnings:?}");
}

#[test]
fn a_scene_file_takes_it_as_a_wireframe() {
    let scene = "mesh = 'a.stl'\nwireframe = true\n";
    let folder = folder("stl_wireframe", &[("a.stl", &ascii()), ("scene.toml", scene)]);
    let scene = load(&folder.join("scene.toml")).unwrap();
    assert_eq!((scene.mesh.triangles().len(), scene.mesh.lines().len()), (0, 5));
    assert_eq!(scene.mesh.lines()[0].colour, [0.8; 3]);
    assert_eq!(scene.camera.up, dvec3(0.0, 0.0, 1.0));
    let _ = pictures(&folder.join("a.stl"));
}

#[test]
fn bad_files_are_refused() {
    let folder = folder("stl_bad", &[]);
    let whole = binary(b"", [0; 2]);
    let mut far = whole.clone();
    far[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let mut many = whole.clone();
    many[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let again = "export it again: it is damaged, or no STL file";
    let cases: [(&[u8], String); 5] = [
        (&whole[..150], format!("a.stl: says that it has 2 facets, and holds 66 bytes for 1 of them: {again}")),
        (&many, format!("a.stl: says that it has 4294967295 facets, and holds 100 bytes for 2 of them: {again}")),
        (&far, "a.stl: facet 1 has a corner at [[NaN, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.5]]: give finite numbers below 1e30".to_owned()),
        (b"facets", "a.stl: is no STL file: it does not begin with `solid` and has no header: export it again".to_owned()),
        (&binary(b"solid", [0; 2])[..130], format!("a.stl: says that it has 2 facets, and holds 46 bytes for 0 of them: {again}")),
    ];
    for (bytes, sentence) in cases {
        assert_eq!(bytes_error(&folder, "a.stl", bytes), sentence);
    }
    let form = "a facet is `facet normal`, `outer loop`, three times `vertex`, `endloop` and `endfacet`";
    let facet = "solid\nfacet normal 0 0 1\nouter loop\n";
    let corners = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
    let cases = [
        ("solid\nvertex 0 0 0\n".to_owned(), format!("a.stl:2: `vertex 0 0 0` does not belong here: {form}")),
        (format!("{facet}vertex 0 x 0\n"), "a.stl:4: `x` after `vertex` is not a number: write it as in 1.5 or -2e-3".to_owned()),
        (format!("{facet}vertex 0 0\n"), "a.stl:4: `vertex` with 2 numbers: give 3".to_owned()),
        (format!("{facet}vertex 0 0 0\nendloop\nendfacet\n"), "a.stl:6: `endfacet` after 1 of three corners: give three lines with `vertex`".to_owned()),
        (format!("{facet}{corners}vertex 1 1 1\n"), "a.stl:7: a facet with a fourth `vertex`: cut it into triangles".to_owned()),
        (format!("{facet}{corners}"), "a.stl:6: the file ends within a facet: export it again".to_owned()),
        ("solid\nfacet normal 0 0\n".to_owned(), "a.stl:2: `facet normal` with 2 numbers: give 3".to_owned()),
        ("solid\nendsolid\n".to_owned(), "a.stl: holds no face with an area and no line with a length, so nothing would be drawn: give a face three corners that are not in a line, or a polyline two that differ".to_owned()),
    ];
    for (text, sentence) in cases {
        assert_eq!(bytes_error(&folder, "a.stl", text.as_bytes()), sentence);
    }
}

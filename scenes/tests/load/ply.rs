//! PLY files: the pictures of good ones, and every bad one with its whole sentence.

use crate::load::{bytes_error, folder, load, pictures, same_pictures, warned};
use glam::{DVec3, dvec2};
use std::fs;
use tilewright_scenes::{Frame, Size};

const HEADER: &str = "ply\nformat ascii 1.0\ncomment made by a test\nobj_info of two faces\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
                      element face 2\nproperty list uchar int vertex_indices\nend_header\n";
const VERTICES: [[f32; 3]; 5] =
    [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.5], [-1.0, 1.0, -1.0], [0.0, 1.5, 0.25]];
const FACES: [&[u8]; 2] = [&[0, 1, 2, 3], &[3, 2, 4]];
const OBJ: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0.5\nv -1 1 -1\nv 0 1.5 0.25\nf 1 2 3 4\nf 4 3 5\n";

fn text() -> String {
    let vertices: String = VERTICES.iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
    format!("{HEADER}{vertices}4 0 1 2 3\n3 3 2 4\n")
}

/// The same in binary, with various types and elements that are not drawn.
fn binary(is_big: bool) -> Vec<u8> {
    let order = if is_big { "big" } else { "little" };
    let header = format!(
        "ply\r\nformat binary_{order}_endian 1.0\r\nelement camera 1\r\nproperty list uint16 float64 view\r\nproperty short id\r\n\
         element vertex 5\r\nproperty uchar quality\r\nproperty double x\r\nproperty float32 y\r\nproperty float z\r\n\
         element face 2\r\nproperty int8 flags\r\nproperty list uint8 uint vertex_index\r\nelement nothing 99999999999\r\nend_header\r\n"
    );
    let mut bytes = header.into_bytes();
    let mut number = |le: &[u8]| match is_big {
        true => bytes.extend(le.iter().rev()),
        false => bytes.extend(le),
    };
    number(&2_u16.to_le_bytes());
    number(&1.5_f64.to_le_bytes());
    number(&2.5_f64.to_le_bytes());
    number(&(-7_i16).to_le_bytes());
    for [x, y, z] in VERTICES {
        number(&[9]);
        number(&f64::from(x).to_le_bytes());
        number(&y.to_le_bytes());
        number(&z.to_le_bytes());
    }
    for face in FACES {
        number(&[255]);
        number(&[face.len() as u8]);
        face.iter().for_each(|&i| number(&u32::from(i).to_le_bytes()));
    }
    bytes
}

#[test]
fn all_forms_make_one_picture() {
    let folder = folder("ply", &[("text.ply", &text()), ("crlf.ply", &text().replace('\n', "\r\n"))]);
    fs::write(folder.join("little.ply"), binary(false)).unwrap();
    fs::write(folder.join("big.PLY"), binary(true)).unwrap();
    for name in ["text.ply", "crlf.ply", "little.ply", "big.PLY"] {
        same_pictures(&folder.join(name), OBJ, &[]);
    }
}

#[test]
fn normals_and_strips_and_edges_are_drawn() {
    let vertices = "-1 -1 0 0 0 2\n1 -1 0 1 0 1\n1 1 0 0 1 1\n-1 1 0 0 0 1\n";
    let header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n";
    let strip = format!(
        "{header}element tristrips 1\nproperty list int int vertex_indices\nend_header\n{vertices}9 0 1 3 2 -1 0 1 2 -1\n"
    );
    let edges = format!(
        "{header}element edge 2\nproperty int vertex1\nproperty int vertex2\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n{vertices}0 1 255 0 0\n1 2 0 0 255\n"
    );
    let folder = folder(
        "ply_kinds",
        &[("strip.ply", &strip), ("edges.ply", &edges), ("plain.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n")],
    );
    let obj = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0 0 2\nvn 1 0 1\nvn 0 1 1\nvn 0 0 1\nf 1//1 2//2 4//4\nf 4//4 2//2 3//3\nf 1//1 2//2 3//3\n";
    same_pictures(&folder.join("strip.ply"), obj, &[]);
    let obj = "mtllib plain.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nusemtl red\nl 1 2\nusemtl blue\nl 2 3\n";
    same_pictures(&folder.join("edges.ply"), obj, &[]);
}

fn coloured(kinds: &str, colours: [&str; 4], face: &str) -> String {
    let at = ["-1 -1 0", "1 -1 0", "1 1 0", "-1 1 0"];
    let vertices: String = at.iter().zip(colours).map(|(at, colour)| format!("{at} {colour}\n")).collect();
    format!(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n{kinds}element face 1\nproperty list uchar int vertex_indices\n{face}\nend_header\n{vertices}"
    )
}

#[test]
fn colours_of_vertices_go_over_the_face() {
    let kinds = "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
    let text =
        coloured(kinds, ["255 0 0 255", "255 0 0 255", "0 0 255 255", "0 0 255 255"], "comment none") + "4 0 1 2 3\n";
    let folder = folder(
        "ply_colours",
        &[
            ("a.ply", &text),
            ("scene.toml", "mesh = 'a.ply'\nlight = []\nambient = 1\n"),
            ("lines.toml", "mesh = 'a.ply'\nwireframe = true\n"),
        ],
    );
    let [plain, deferred] = pictures(&folder.join("a.ply"));
    let scene = load(&folder.join("scene.toml")).unwrap();
    assert_eq!(scene.warnings, [""; 0]);
    assert_eq!(scene.mesh.corner_colours(1), [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
    for frame in [&plain, &deferred] {
        // From red below to blue above, under any light.
        let ratio = |y| {
            let [r, _, b] = frame.rgb(24, y).map(f64::from);
            b / (r + b)
        };
        assert!(ratio(30) < 0.2 && (ratio(20) - 0.5).abs() < 0.2 && ratio(10) > 0.8, "{:?}", [30, 20, 10].map(ratio));
    }
    let lines = load(&folder.join("lines.toml")).unwrap();
    assert_eq!(lines.mesh.lines()[0].colour, [0.5, 0.0, 0.5]);
    // Floats and 16 bits are the same, and transparency is not drawn.
    let floats = coloured(
        "property float r\nproperty float g\nproperty float b\n",
        ["1 0 0", "1 0 0", "0 0 1", "0 0 1"],
        "comment none",
    );
    fs::write(folder.join("floats.ply"), floats + "4 0 1 2 3\n").unwrap();
    assert_eq!(pictures(&folder.join("floats.ply")), [plain.clone(), deferred.clone()]);
    fs::write(folder.join("clear.ply"), text.replace("255 0 0 255", "255 0 0 254")).unwrap();
    assert_eq!(pictures(&folder.join("clear.ply")), [plain, deferred]);
    let sentence = "clear.ply: its colours are transparent in places, and drawn as opaque: make them opaque";
    assert_eq!(warned(&load(&folder.join("clear.ply")).unwrap(), &folder), [sentence]);
}

#[test]
fn a_face_may_have_a_colour_of_its_own() {
    let face = "property uchar red\nproperty uchar green\nproperty uchar blue";
    let text = coloured("", [""; 4], face) + "4 0 1 2 3 255 0 51\n";
    let folder = folder("ply_face_colour", &[("a.ply", &text), ("plain.mtl", "newmtl a\nKd 1 0 0.2\n")]);
    let obj = "mtllib plain.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
    same_pictures(&folder.join("a.ply"), obj, &[]);
}

#[test]
fn textures_lie_by_vertices_or_by_corners() {
    let obj = "mtllib plain.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    let by_vertex = coloured(
        "property float s\nproperty float t\n",
        ["0 0", "1 0", "1 1", "0 1"],
        "comment TextureFile my tiles.png",
    ) + "4 0 1 2 3\n";
    let by_corner = coloured(
        "",
        [""; 4],
        "property list uchar float texcoord\nproperty int texnumber\ncomment TextureFile lost.png\ncomment TextureFile my tiles.png",
    ) + "4 0 1 2 3 8 0 0 1 0 1 1 0 1 1\n";
    let folder = folder(
        "ply_textures",
        &[
            ("vertex.ply", &by_vertex),
            ("corner.ply", &by_corner),
            ("plain.mtl", "newmtl a\nKd 1\nmap_Kd my tiles.png\n"),
        ],
    );
    let mut tiles = Frame::blank(Size::new(2, 2).unwrap(), [250; 3]);
    tiles.words[1] = tilewright_scenes::frame::blank([9, 200, 30]);
    tiles.words[2] = tilewright_scenes::frame::blank([9, 20, 230]);
    tiles.write_png(folder.join("my tiles.png")).unwrap();
    same_pictures(&folder.join("vertex.ply"), obj, &[]);
    // Colours next to a texture repeat those of the texture.
    let kinds = "property float s\nproperty float t\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
    let both = ["0 0 9 9 9", "1 0 9 9 9", "1 1 9 9 9", "0 1 9 9 9"];
    let both = coloured(kinds, both, "comment TextureFile my tiles.png") + "4 0 1 2 3\n";
    fs::write(folder.join("both.ply"), both).unwrap();
    let warning = "both.ply: its colours are not drawn, as its textures are: remove those that are not to be";
    same_pictures(&folder.join("both.ply"), obj, &[warning]);
    assert_eq!(
        load(&folder.join("vertex.ply")).unwrap().files,
        ["vertex.ply", "my tiles.png"].map(|name| folder.join(name))
    );
    let corner = load(&folder.join("corner.ply")).unwrap();
    let materials = corner.mesh.materials().unwrap();
    let of_first = materials.mappings[0];
    assert_eq!(materials.materials[of_first.material as usize].texture, Some(1));
    assert_eq!(
        of_first.coordinates.map(|i| materials.coordinates[i as usize]),
        [dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(1.0, 1.0)]
    );
    // A missing texture is an error only for deferred shading, as with OBJ files.
    let lost = materials.textures[0].clone().unwrap_err().to_string().replace(&format!("{}/", folder.display()), "");
    assert_eq!(
        lost,
        "corner.ply:11: there is no texture lost.png: correct the path, which is relative to this file's folder"
    );
    fs::write(folder.join("corner.ply"), by_corner.replace("lost.png", "my tiles.png")).unwrap();
    same_pictures(&folder.join("corner.ply"), obj, &[]);
    // Coordinates serve a scene file's own texture, too.
    fs::write(folder.join("bare.ply"), by_vertex.replace("TextureFile", "no TextureFile")).unwrap();
    fs::write(folder.join("scene.toml"), "mesh = 'bare.ply'\n[surface]\ntexture = 'marble'\n").unwrap();
    assert!(load(&folder.join("scene.toml")).unwrap().mesh.materials().is_some());
}

#[test]
fn a_face_of_many_corners_is_cut_as_that_of_an_obj_file() {
    let l = "0 0 0\n3 0 0\n3 1 0\n1 1 0\n1 3 0\n0 3 0\n0 0 1\n";
    let header = "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
    let folder = folder("ply_cut", &[("a.ply", &format!("{header}{l}6 0 1 2 3 4 5\n4 0 2 1 5\n"))]);
    let scene = load(&folder.join("a.ply")).unwrap();
    assert_eq!(
        warned(&scene, &folder),
        ["a.ply: face 2 crosses itself, so it is drawn roughly: cut it where its edges meet"]
    );
    assert_eq!((scene.mesh.triangles()[0].positions.len(), scene.camera.up), (3, DVec3::Y));
}

#[test]
fn bad_files_are_refused() {
    let folder = folder("ply_bad", &[]);
    let body = |from: &str, to: &str| text().replace(from, to);
    let cases = [
        ("plyx\n".to_owned(), "a.ply:1: is no PLY file: it does not begin with `ply`: export it again"),
        (
            "ply\nformat ascii 1.0\n".to_owned(),
            "a.ply: ends before its header does: export it again, or add the line `end_header`",
        ),
        (String::new(), "a.ply: ends before its header does: export it again, or add the line `end_header`"),
        ("ply\nend_header\n".to_owned(), "a.ply:2: a header without `format`: add `format ascii 1.0`"),
        (
            body("ascii", "utf8"),
            "a.ply:2: unknown format `utf8`: write ascii, binary_little_endian or binary_big_endian",
        ),
        (
            body("float y", "real y"),
            "a.ply:7: unknown type `real`: write char, uchar, short, ushort, int, uint, float or double",
        ),
        (body("list uchar", "list float"), "a.ply:10: a list whose length is a float: write uchar, or int"),
        (
            body("element vertex 5", "element vertex -5"),
            "a.ply:5: `-5` is not the number of an element: write a whole number",
        ),
        (
            body("comment", "remark"),
            "a.ply:3: unknown statement `remark made by a test` in the header: a header has format, comment, obj_info, element, property and end_header",
        ),
        (
            body("property float x", "property x"),
            "a.ply:6: a malformed `property`: write `property TYPE NAME` or `property list TYPE TYPE NAME`",
        ),
        (body("element vertex 5", "comment"), "a.ply:6: `property` before any `element`: name the element first"),
        (body("1 1 0.5", "1 one 0.5"), "a.ply:14: vertex has `one` for a number: correct it, or export the file again"),
        (body("1 1 0.5", "1 inf 0.5"), "a.ply:14: vertex has inf for `y`: give finite numbers below 1e30"),
        (
            body("3 3 2 4", "3 3 2 4.5"),
            "a.ply:18: face has `4.5` for a whole number: correct it, or export the file again",
        ),
        (body("3 3 2 4", "3 3 2 5"), "a.ply: face 2 names vertex 5, and there are 5, counted from 0: export it again"),
        (
            body("3 3 2 4", "3 3 2 -1"),
            "a.ply: face 2 names vertex -1, and there are 5, counted from 0: export it again",
        ),
        (body("3 3 2 4", "2 3 2"), "a.ply:18: face has fewer than three corners: remove it, or write it as an edge"),
        (body("3 3 2 4", "-1"), "a.ply:18: face has fewer than three corners: remove it, or write it as an edge"),
        (body("3 3 2 4", "16385 0"), "a.ply:18: face has more than 16384 corners: cut it"),
        (body("3 3 2 4", "3 3 2"), "a.ply: ends within face 2 of 2: export it again"),
        (
            body("element face 2", "element mace 2"),
            "a.ply: holds no face and no edge, and points are not drawn: export it as a mesh",
        ),
    ];
    for (text, sentence) in cases {
        assert_eq!(bytes_error(&folder, "a.ply", text.as_bytes()), sentence);
    }
    let whole = binary(false);
    let sentence = "a.ply: ends within face 2 of 2: export it again";
    assert_eq!(bytes_error(&folder, "a.ply", &whole[..whole.len() - 1]), sentence);
    let texcoord = coloured("", [""; 4], "property list uchar float texcoord") + "4 0 1 2 3 6 0 0 1 0 1 1\n";
    let sentence = "a.ply:15: face has 6 numbers for `texcoord`: give two to each corner";
    assert_eq!(bytes_error(&folder, "a.ply", texcoord.as_bytes()), sentence);
    let number = coloured("", [""; 4], "property int texnumber\ncomment TextureFile a.png") + "4 0 1 2 3 1\n";
    let sentence = "a.ply:16: face names a texture that the header does not: correct `texnumber`";
    assert_eq!(bytes_error(&folder, "a.ply", number.as_bytes()), sentence);
}

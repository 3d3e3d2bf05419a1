//! OBJ files and their materials: good ones, and every bad one with its whole sentence.

use crate::load::{TRIANGLE, folder, load, obj_error};
use glam::{DVec3, dvec3};
use std::fs;

#[test]
fn an_obj_file_keeps_order_colours_and_normals() {
    let folder = folder(
        "good",
        &[
            (
                "mesh.obj",
                "\u{feff}# a quad, a triangle, a line\r\n\
                 mtllib my colours.mtl\r\n\
                 o thing\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.1 0.2 0.3\nv 0 1 \\\n 0\n\
                 vt 0 0\nvn 0 0 2\ns off\n\
                 usemtl dark red\nf 1/1/1 2/1/1 3//1 -1//-1\n\
                 l 1 2 3 4\n\
                 g two\nusemtl plain\nf 1//1 2//1 4//1 # the last\n",
            ),
            ("my colours.mtl", "# two\nnewmtl dark red\nKa 1\nKd 0.5 0 0\nnewmtl plain\nKd 1\nillum 2\n"),
        ],
    );
    let scene = load(&folder.join("mesh.obj")).unwrap();
    assert_eq!(scene.warnings, [""; 0]);
    assert_eq!(scene.name, "mesh");
    assert_eq!(scene.files, ["mesh.obj", "my colours.mtl"].map(|name| folder.join(name)));
    let triangles = scene.mesh.triangles();
    let places: Vec<_> = triangles.iter().map(|t| t.positions).collect();
    assert_eq!(places, [[0, 1, 2], [0, 2, 3], [0, 1, 3]]);
    let colours: Vec<_> = triangles.iter().map(|t| t.diffuse).collect();
    assert_eq!(colours, [[0.5, 0.0, 0.0], [0.5, 0.0, 0.0], [1.0, 1.0, 1.0]]);
    assert!(triangles.iter().flat_map(|t| t.normals).all(|n| scene.mesh.normals()[n as usize] == dvec3(0.0, 0.0, 2.0)));
    assert_eq!(scene.mesh.positions()[3], DVec3::Y);
}

#[test]
fn normals_are_computed_where_they_lack() {
    let folder = folder(
        "normals",
        &[("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nvn 1 0 0\nf 1 2 3\nf 1//1 3//1 4//1\n")],
    );
    let scene = load(&folder.join("mesh.obj")).unwrap();
    let normals = |triangle: usize| scene.mesh.triangles()[triangle].normals.map(|i| scene.mesh.normals()[i as usize]);
    assert_eq!([normals(0), normals(1)], [[DVec3::Z; 3], [DVec3::X; 3]]);
    assert_eq!(
        scene.warnings,
        [format!(
            "{}:6: this face has no normals and others have, so its normals are computed: export all or none",
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
fn a_material_file_may_have_blanks_in_its_name() {
    let two = format!("mtllib a.mtl b.mtl\n{TRIANGLE}");
    let folder = folder("blanks", &[("mesh.obj", &two), ("a.mtl", ""), ("b.mtl", "")]);
    let mesh = folder.join("mesh.obj");
    assert_eq!(load(&mesh).unwrap().files, ["mesh.obj", "a.mtl", "b.mtl"].map(|name| folder.join(name)));
    fs::write(folder.join("a.mtl b.mtl"), "").unwrap();
    assert_eq!(load(&mesh).unwrap().files, ["mesh.obj", "a.mtl b.mtl"].map(|name| folder.join(name)));
    fs::write(&mesh, format!("mtllib lost colours.mtl\n{TRIANGLE}")).unwrap();
    let warnings = load(&mesh).unwrap().warnings;
    let missing = format!("the material file {} is missing", folder.join("lost colours.mtl").display());
    assert!(warnings.len() == 1 && warnings[0].contains(&missing), "{warnings:?}");
}

#[test]
fn malformed_meshes_are_refused_with_their_line() {
    let cases = [
        ("number", "v 0 0 0\nv 1 x 0\n", "mesh.obj:2: `x` after `v` is not a number: write it as in 1.5 or -2e-3"),
        ("nan", "v 0 NaN 0\n", "mesh.obj:1: `v` with the number `NaN`: give finite numbers below 1e30"),
        ("inf", "# c\nvn 0 1e999 0\n", "mesh.obj:2: `vn` with the number `1e999`: give finite numbers below 1e30"),
        ("count", "v 0 0\n", "mesh.obj:1: `v` with 2 numbers: give 3 or 4 or 6 or 7"),
        ("weight", "v 0 0 0 2\n", "mesh.obj:1: `v` with the weight 2: remove it: weights belong to free-form surfaces"),
        ("few", "v 0 0 0\nf 1 1\n", "mesh.obj:2: a face with 2 corners is not drawn: give at least three"),
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
            "v 0 0 0\nvn 0 0 1\nf 1//2 1//1 1//1\n",
            "mesh.obj:3: the corner `1//2` names normal 2, but 1 are defined above: correct the index, or move the definition above the face",
        ),
        (
            "corner",
            "v 0 0 0\nf 1 1 1.5\n",
            "mesh.obj:2: the corner `1.5` of a face is malformed: write v, v/vt, v//vn or v/vt/vn with whole numbers",
        ),
        (
            "unknown",
            "v 0 0 0\nface 1 2 3\n",
            "mesh.obj:2: unknown statement `face`: an OBJ file of polygons and lines has v, vn, vt, f, l, o, g, s, usemtl and mtllib; remove the line or export polygons",
        ),
        (
            "empty",
            "v 0 0 0\n",
            "mesh.obj: holds no face and no polyline: export the mesh with its polygons (lines that begin with `f`) or polylines (with `l`)",
        ),
        (
            "nothing",
            "",
            "mesh.obj: holds no face and no polyline: export the mesh with its polygons (lines that begin with `f`) or polylines (with `l`)",
        ),
    ];
    for (name, text, sentence) in cases {
        assert_eq!(obj_error(name, text), sentence, "{name}");
    }
}

#[test]
fn a_mesh_without_any_area_is_refused() {
    let flat = "v 0 1 0\nv 1 2 0\nv 2 3 0\nf 1 2 3\nf 1 1 2\n";
    assert_eq!(
        obj_error("flat", flat),
        "mesh.obj: holds no face with an area and no line with a length, so nothing would be drawn: give a face three corners that are not in a line, or a polyline two that differ"
    );
    let mixed = folder("mixed_area", &[("mesh.obj", &format!("{flat}v 0 0 0\nf 1 2 4\n"))]);
    assert_eq!(load(&mixed.join("mesh.obj")).unwrap().mesh.triangles().len(), 3);
}

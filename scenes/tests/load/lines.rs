//! Polylines of OBJ files, and wireframes.

use crate::load::{TRIANGLE, folder, load, obj_error, toml_error};
use tilewright_scenes::{Counts, Scene};

const SQUARE: &str = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n";

/// The ends of all lines, by index, and the red of each.
fn lines(scene: &Scene) -> Vec<([u32; 2], f64)> {
    scene.mesh.lines().iter().map(|line| (line.positions, line.colour[0])).collect()
}

#[test]
fn polylines_keep_their_order_and_the_colours_of_their_materials() {
    let text = format!("mtllib m.mtl\n{SQUARE}vt 0 0\nl 1 2/1 3/ 1\nusemtl red\nl -1 -2\nf 1 2 3\nl 4 4\n");
    let folder = folder("polylines", &[("mesh.obj", &text), ("m.mtl", "newmtl red\nKd 1 0 0\n")]);
    let scene = load(&folder.join("mesh.obj")).unwrap();
    assert_eq!(scene.warnings, [""; 0]);
    let position = |i: u32| scene.mesh.positions()[i as usize].to_array();
    let ends: Vec<_> =
        scene.mesh.lines().iter().map(|line| line.positions.map(|i| [position(i)[0], position(i)[1]])).collect();
    let [a, b, c, d] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    assert_eq!(ends, [[a, b], [b, c], [c, a], [d, c], [d, d]]);
    assert_eq!(
        scene.mesh.lines().iter().map(|line| line.colour).collect::<Vec<_>>()[2..4],
        [[0.8; 3], [1.0, 0.0, 0.0]]
    );
    let counts = scene.project().unwrap().counts;
    assert_eq!(counts, Counts { polygons: 6, lines: 5, drawn: 5, degenerate: 1, ..Counts::default() });
}

#[test]
fn a_mesh_of_lines_alone_is_framed_and_drawn() {
    let folder = folder("lines_alone", &[("mesh.obj", "v 0 0 0\nv 3 4 0\nl 1 2\n")]);
    let scene = load(&folder.join("mesh.obj")).unwrap();
    assert_eq!(scene.mesh.triangles(), []);
    let projection = scene.project().unwrap();
    assert_eq!((projection.counts.drawn, projection.warning()), (1, None));
    assert!(projection.vertices.iter().flatten().all(|v| (0..640 * 16).contains(&v.x) && (0..480 * 16).contains(&v.y)));
}

#[test]
fn a_wireframe_has_each_side_of_a_face_once() {
    // Two squares side by side, and on the first a face with a notch, which no fan is right for.
    let text = format!("{SQUARE}v 4 0 0\nv 4 2 0\nf 1 2 3 4\nf 2 5 6 3\nv 1 0.5 0\nf 1 7 2 3 4\nl 1 6\n");
    let scene = "mesh = 'mesh.obj'\nwireframe = true\n";
    let plain = "mesh = 'mesh.obj'\nwireframe = false\n";
    let folder = folder("wireframe", &[("mesh.obj", &text), ("scene.toml", scene), ("plain.toml", plain)]);
    let wireframe = load(&folder.join("scene.toml")).unwrap();
    assert_eq!(wireframe.warnings, [""; 0]);
    assert_eq!(wireframe.mesh.triangles(), []);
    let grey = |ends: [u32; 2]| (ends, 0.8);
    let squares = [[0, 1], [1, 2], [2, 3], [3, 0], [1, 4], [4, 5], [5, 2]];
    let notch = [[0, 6], [6, 1]];
    let expected: Vec<_> = squares.into_iter().chain(notch).chain([[0, 5]]).map(grey).collect();
    assert_eq!(lines(&wireframe), expected);
    let plain = load(&folder.join("plain.toml")).unwrap();
    assert_eq!((plain.mesh.triangles().len(), lines(&plain)), (2 + 2 + 3, vec![grey([0, 5])]));
    assert_eq!(plain.mesh, load(&folder.join("mesh.obj")).unwrap().mesh);
}

#[test]
fn a_built_in_scene_may_be_a_wireframe() {
    let folder = folder("built_in_wireframe", &[("scene.toml", "mesh = 'teapot'\nwireframe = true\n")]);
    let (scene, teapot) = (load(&folder.join("scene.toml")).unwrap(), Scene::builtin("teapot").unwrap());
    assert_eq!((scene.mesh, scene.camera), (teapot.mesh.wireframe(), teapot.camera));
}

#[test]
fn malformed_polylines_are_refused_with_their_line() {
    let many = format!("v 0 0 0\nl{}\n", " 1".repeat(16_385));
    let cases = [
        ("one", "v 0 0 0\nl 1\n", "mesh.obj:2: a polyline with 1 corner is not drawn: give at least two"),
        ("none", "v 0 0 0\nl\n", "mesh.obj:2: a polyline with 0 corners is not drawn: give at least two"),
        ("many", &many, "mesh.obj:2: a polyline with more than 16384 corners: cut it"),
        (
            "range",
            "v 0 0 0\nl 1 2\n",
            "mesh.obj:2: the corner `2` names vertex 2, but 1 are defined above: correct the index, or move the definition above the polyline",
        ),
        (
            "normal",
            "v 0 0 0\nvn 0 0 1\nl 1 1//1\n",
            "mesh.obj:3: the corner `1//1` of a polyline is malformed: write v or v/vt with whole numbers",
        ),
        (
            "texture",
            "v 0 0 0\nl 1 1/1/1\n",
            "mesh.obj:2: the corner `1/1/1` of a polyline is malformed: write v or v/vt with whole numbers",
        ),
        (
            "point",
            "v 0 0 0\nv 0 -0 0\nl 1 2 1\n",
            "mesh.obj: holds no face with an area and no line with a length, so nothing would be drawn: give a face three corners that are not in a line, or a polyline two that differ",
        ),
    ];
    for (name, text, sentence) in cases {
        assert_eq!(obj_error(&format!("line_{name}"), text), sentence, "{name}");
    }
}

#[test]
fn wireframe_is_true_or_false() {
    let sentence = toml_error("wireframe_number", "mesh = 'mesh.obj'\nwireframe = 1\n");
    assert_eq!(sentence, "scene.toml:2:13: invalid type: integer `1`: write true or false");
    // Without an area it has sides to draw all the same.
    let flat = format!("{TRIANGLE}v 2 0 0\nf 1 2 4\n").replace("f 1 2 3\n", "");
    let folder =
        folder("flat_wireframe", &[("mesh.obj", &flat), ("scene.toml", "mesh = 'mesh.obj'\nwireframe = true\n")]);
    assert!(load(&folder.join("mesh.obj")).unwrap_err().contains("no face with an area"));
    assert_eq!(load(&folder.join("scene.toml")).unwrap().mesh.lines().len(), 3);
}

//! Scenes of lines: every machine draws them, and `list` and `golden` count them.

use crate::cli::harness::Folder;

/// A square in wireframe, and a polyline before it; a face and a line.
const FILES: &[(&str, &str)] = &[
    ("square.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 2 1\nf 1 2 3 4\nl 1 5 3\n"),
    ("wireframe.toml", "mesh = \"square.obj\"\nwireframe = true\nsize = [40, 30]\n"),
    ("mixed.toml", "mesh = \"square.obj\"\nsize = [40, 30]\n"),
];

#[test]
fn every_machine_draws_lines() {
    let folder = Folder::with(FILES);
    for (scene, polygons) in [("wireframe.toml", 6), ("mixed.toml", 4)] {
        for machine in ["vc1 --processors 2", "quadtree --matrix 2x2 --form stack", "quadtree --matrix 2x1 --strict"] {
            let report = folder.json(&format!("render {scene} --machine {machine} --json"));
            assert_eq!(report["golden"]["identical"], true, "{scene} on {machine}: {report}");
            if machine.starts_with("vc1") {
                assert_eq!(report["report"]["polygons"], polygons);
                let packets = if polygons == 6 { 12 } else { 6 };
                assert_eq!(report["report"]["frames"][0]["packets"], packets, "{report}");
            }
        }
    }
}

#[test]
fn lines_are_counted() {
    let folder = Folder::with(FILES);
    let said = |scene: &str| folder.stdout(&format!("golden {scene} -o x.png"));
    assert!(said("wireframe.toml").starts_with("wireframe: 6 lines, 12 packets, 40x30 pixels"));
    assert!(said("mixed.toml").starts_with("mixed: 2 polygons and 2 lines, 6 packets, 40x30 pixels"));
    let report = folder.json("golden mixed.toml -o x.png --json");
    assert_eq!([&report["polygons"], &report["lines"]], [4, 2]);
    let list = folder.stdout("list");
    for line in ["1040 lines, 640x480 pixels", "266 lines, 640x480 pixels", "4096 polygons, 640x480 pixels"] {
        assert!(list.contains(line), "{list}");
    }
}

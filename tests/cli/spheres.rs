//! Scenes of spheres: pixel-planes-5 draws them, and everything else says that it does not.

use crate::cli::harness::Folder;
use serde_json::json;

/// Two balls that cut each other and a face; and balls alone.
const FILES: &[(&str, &str)] = &[
    ("face.obj", "v -2 -1 0\nv 2 -1 0\nv 0 2 0\nf 1 2 3\n"),
    (
        "mixed.toml",
        "mesh = \"face.obj\"\nsize = [40, 30]\n\
         [[sphere]]\ncentre = [0, 0, 0]\nradius = 0.8\ncolour = [250, 60, 40]\n\
         [[sphere]]\ncentre = [0.7, 0, 0.2]\nradius = 0.5\ncolour = [250, 250, 240]\n",
    ),
    ("ball.toml", "size = [40, 30]\n[[sphere]]\ncentre = [0, 0, 0]\nradius = 1\ncolour = [9, 99, 255]\n"),
];

#[test]
fn pixel_planes_5_draws_them() {
    let folder = Folder::with(FILES);
    for (scene, primitives) in [("mixed.toml", 3), ("ball.toml", 1)] {
        for options in ["", "--strict --renderers 2 --region 16", "--region 8 --one-at-a-time"] {
            let report = folder.json(&format!("render {scene} --machine pixel-planes-5 --json {options}"));
            assert_eq!(report["golden"]["identical"], true, "{scene} {options}: {report}");
            let report = &report["report"];
            assert_eq!((&report["primitives"], &report["machine"]["quadratic"]), (&json!(primitives), &json!(true)));
            let last = report["programs"].as_array().unwrap().last().unwrap();
            assert_eq!(last["program"], if options.contains("strict") { "sphere_strict" } else { "sphere_least" });
        }
    }
    let text = folder.stdout("render ball.toml --machine pixel-planes-5 --renderers 1 --region 64");
    assert!(text.contains("1 renderers of 64x64 pixels with quadratic trees: 40x30 pixels,\n"), "{text}");
}

#[test]
fn spheres_are_counted() {
    let folder = Folder::with(FILES);
    let said = |scene: &str| folder.stdout(&format!("golden {scene} -o x.png"));
    assert!(said("mixed.toml").starts_with("mixed: 1 polygon and 2 spheres, 3 packets, 40x30 pixels, "));
    assert!(said("ball.toml").starts_with("ball: 1 sphere, 1 packets, 40x30 pixels, "));
    let report = folder.json("golden mixed.toml -o x.png --json");
    assert_eq!([&report["polygons"], &report["lines"], &report["spheres"]], [3, 0, 2]);
    let list = folder.stdout("list");
    assert!(list.contains("  1200 polygons and 24 spheres, 640x480 pixels"), "{list}");
}

#[test]
fn what_draws_none_says_so() {
    let folder = Folder::with(FILES);
    let none =
        "the scene has spheres, which only pixel-planes-5 draws: use `tilewright render` with --machine pixel-planes-5";
    let plain = "the scene has spheres, which are drawn without deferred shading and with one sample per pixel: leave out --deferred and --samples";
    for (arguments, sentence) in [
        ("render ball.toml --machine vc1", none),
        ("render ball.toml --machine quadtree", none),
        ("render ball.toml --machine pixelflow", none),
        ("render ball.toml --machine pixelflow --system non-texturing", none),
        ("render ball.toml --machine pixelflow --system non-texturing --samples 8", none),
        ("render ball.toml --machine pixelflow --stereo halved", none),
        ("compare ball.toml", none),
        ("compare molecule --machine pixel-planes-5", none),
        ("golden ball.toml -o x.png --deferred", plain),
        ("golden ball.toml -o x.png --samples 8", plain),
    ] {
        let run = folder.run(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{arguments}: {run:?}");
        assert_eq!(run.stderr.trim_end(), format!("error: {sentence}"), "{arguments}");
    }
}

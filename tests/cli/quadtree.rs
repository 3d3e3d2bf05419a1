//! `render --machine quadtree`, and what `list` says of it.

use crate::cli::harness::{Folder, PYRAMID, Waveform};
use serde_json::{Value, json};

const SMALL: &str = "render pyramid.obj --machine quadtree --size 32x24 --matrix 2x2 --form stack";

/// A square that faces the camera, and a triangle before it at one corner.
const SQUARE: &[(&str, &str)] = &[
    ("square.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv -1 -1 1\nv 0 -1 1\nv -1 0 1\nf 1 2 3 4\nf 5 6 7\n"),
    ("square.toml", "mesh = \"square.obj\"\nsize = [24, 18]\n[camera]\neye = [0, 0, 6]\ntarget = [0, 0, 0]\n"),
];

#[test]
fn the_report_counts_windows_and_clocks() {
    let folder = Folder::with_pyramid();
    let report = folder.json(&format!("{SMALL} -o frame.png --json"));
    assert_eq!((&report["format"], &report["machine"]), (&json!(1), &json!("quadtree")));
    assert_eq!(report["golden"], json!({"identical": true, "differing": 0, "first": null}));
    let report = &report["report"];
    let machine = &report["machine"];
    assert_eq!([&machine["p"], &machine["q"], &machine["levels"], &machine["edges"]], [2, 2, 4, 3]);
    assert_eq!([&machine["form"], &machine["test"]], ["stack:4", "parallel"]);
    let packets = report["packets"].as_u64().unwrap();
    assert_eq!(report["stages"].as_array().unwrap().len(), 5);
    assert_eq!(report["stages"][0]["windows"]["all"], 4 * packets);
    assert_eq!(report["stages"][1]["tests"]["all"], 16 * packets);
    let fragments: u64 =
        report["processors"].as_array().unwrap().iter().map(|it| it["fragments"].as_u64().unwrap()).sum();
    assert!(fragments > 20 && report["fragments"] == fragments, "{report}");

    let text = folder.stdout(SMALL);
    let clocks = report["phases"][0]["clocks"].to_string();
    for part in [
        "pyramid: quadtree generator, 2x2 video processors of stack:4: 32x24 pixels,\n",
        &format!("{packets} packets, {fragments} fragments\n"),
        &format!("drawing {clocks:>18}"),
        "clocks of drawing; the broadcast waited for ",
        "stage             tests    windows    least     most\n",
        "load    most\n",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(text.ends_with("\nidentical to the golden image\n"), "{text}");
}

#[test]
fn faces_of_four_corners_are_packets_of_four_edges() {
    let folder = Folder::with(SQUARE);
    let line = "render square.toml --machine quadtree --matrix 2x1 --form stack --json";
    let report = folder.json(line);
    assert_eq!(report["golden"]["identical"], true, "{report}");
    assert_eq!([&report["report"]["packets"], &report["report"]["machine"]["edges"]], [2, 4]);
    let triangles = folder.json("render square.toml --processors 1 --json");
    assert_eq!(triangles["report"]["frames"][0]["packets"], 3);
}

#[test]
fn all_its_parameters_can_be_chosen() {
    let folder = Folder::with(SQUARE);
    let line = "render square.toml --machine quadtree --matrix 1x2 --form pipe:2+tree:1+stack --test serial --strict \
                --broadcast-queue 3 --packet-queue 5 --window-queue 1 --aperture 2 --json";
    let report = folder.json(line);
    assert_eq!(report["golden"]["identical"], true, "{report}");
    let expected = json!({
        "width": 24, "height": 18, "p": 1, "q": 2, "levels": 5, "form": "pipe:2+tree:1+stack:2", "test": "serial", "edges": 4,
        "aperture": 2, "strict": true, "broadcast_queue": 3, "packet_queue": 5, "window_queue": 1,
    });
    assert_eq!(report["report"]["machine"], expected);
}

#[test]
fn the_golden_image_of_a_strict_machine_is_strict() {
    // The same triangle twice, in two colours: the first drawn is the brighter one.
    let material = "newmtl bright\nKd 1 1 1\nnewmtl dark\nKd 0.2 0.2 0.2\n";
    let mesh = "mtllib c.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nusemtl bright\nf 1 2 3\nusemtl dark\nf 1 2 3\n";
    let folder = Folder::with(&[("twice.obj", mesh), ("c.mtl", material)]);
    let line = "render twice.obj --machine quadtree --size 16x12 --matrix 1x1 --form stack";
    for (option, picture) in [("--strict", "strict.png"), ("", "least.png")] {
        assert!(folder.stdout(&format!("{line} {option} -o {picture}")).ends_with("\nidentical to the golden image\n"));
    }
    assert_ne!(std::fs::read(folder.path("strict.png")).unwrap(), std::fs::read(folder.path("least.png")).unwrap());
    // Golden's own picture is the one of the least word.
    folder.stdout("golden twice.obj --size 16x12 -o golden.png");
    assert_eq!(folder.run(&format!("{line} --golden golden.png")).code, Some(0));
    assert_eq!(folder.run(&format!("{line} --strict --golden golden.png")).code, Some(1));
}

#[test]
fn a_waveform_of_the_run_can_be_filtered() {
    let folder = Folder::with_pyramid();
    folder
        .stdout(&format!("{SMALL} --vcd run.vcd --scope u_processor[2].u_raster.** --scope idle --from 1us --to 2us"));
    let waveform = Waveform::read(&folder.path("run.vcd"));
    assert!(waveform.names.iter().any(|name| name.contains("u_raster")), "{:?}", waveform.names);
    assert!(!waveform.names.iter().any(|name| name.contains("u_controller")), "{:?}", waveform.names);
    assert_eq!((waveform.times.first(), waveform.times.last()), (Some(&1_000_000), Some(&2_000_000)));
}

#[test]
fn the_help_has_the_options_of_each_machine_under_a_heading() {
    let help = Folder::new().stdout("help render");
    let mut headings: Vec<(&str, &str)> = Vec::new();
    for line in help.lines() {
        match line.strip_prefix("      --").map(|rest| rest.split(' ').next().unwrap_or(rest)) {
            Some(option) if headings.last().is_some_and(|(_, first)| first.is_empty()) => {
                headings.last_mut().unwrap().1 = option;
            }
            None if line.ends_with(':') && !line.starts_with(' ') => headings.push((line, "")),
            _ => {}
        }
    }
    let expected = [
        ("Options:", "size"),
        ("Waveform:", "vcd"),
        ("Pictures of the run:", "owners"),
        ("Options of --machine vc1:", "processors"),
        ("Options of --machine quadtree:", "matrix"),
        ("Options of --machine pixel-planes-5:", "renderers"),
        ("Options of --machine quadtree and --machine pixel-planes-5:", "strict"),
        ("Options of --machine pixelflow:", "nodes"),
    ];
    let headings = headings.iter().filter(|(heading, _)| !["Arguments:", "Examples:"].contains(heading));
    assert_eq!(headings.copied().collect::<Vec<_>>(), expected, "{help}");
}

#[test]
fn the_list_and_the_help_name_the_options_of_each_machine() {
    let folder = Folder::with(&[("pyramid.obj", PYRAMID)]);
    let list = folder.json("list --json");
    let machines = list["machines"].as_array().unwrap();
    let names: Vec<&Value> = machines.iter().map(|it| &it["name"]).collect();
    assert_eq!(names, ["vc1", "quadtree", "pixel-planes-5", "pixelflow"]);
    let (text, help) = (folder.stdout("list all"), folder.stdout("render --help"));
    for machine in machines {
        // Its own options, and those that it has in common with others.
        let name = format!("--machine {}", machine["name"].as_str().unwrap());
        let sections = help.split("\nOptions of ").skip(1);
        let section: String = sections.filter(|it| it.lines().next().unwrap_or_default().contains(&name)).collect();
        let options = machine["options"].as_array().unwrap();
        assert!(options.len() >= 3, "{machine}");
        for option in options {
            let [name, meaning] = ["option", "meaning"].map(|key| option[key].as_str().unwrap());
            let first = name.split(' ').next().unwrap();
            assert!(section.contains(first) && text.contains(name) && text.contains(meaning), "{name}: {help} {text}");
        }
    }
    assert!(text.contains("--matrix PxQ ") && text.contains("--strict "), "{text}");
}

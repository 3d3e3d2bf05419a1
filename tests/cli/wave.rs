//! `wave`.

use crate::cli::harness::{Folder, Waveform};

#[test]
fn a_scenario_becomes_a_waveform_that_opens_with_its_signals() {
    let folder = Folder::new();
    let lines = folder.stdout("wave merging-unit -o mu.vcd");
    assert_eq!(lines, "gtkwave mu.vcd mu.gtkw\nsurfer -c mu.sucl mu.vcd\n");
    let waveform = Waveform::read(&folder.path("mu.vcd"));
    assert!(waveform.names.contains(&"merging_unit.left[47:0]".to_owned()), "{:?}", waveform.names);
    // The reset and 11 rows of 80 ns, to the next edge.
    assert_eq!(waveform.times.last(), Some(&(13 * 80_000)));
    let save = folder.read("mu.gtkw");
    let shown: Vec<&str> = save.lines().filter(|line| line.starts_with("merging_unit.")).collect();
    assert!(shown.contains(&"merging_unit.clk") && shown.contains(&"merging_unit.nearer[47:0]"), "{save}");
    assert!(shown.iter().all(|name| waveform.names.contains(&(*name).to_owned())), "{save}");
}

#[test]
fn codes_have_mapping_files_for_surfer() {
    let folder = Folder::new();
    folder.stdout("wave patch-table -o table.vcd");
    let text = folder.read(".surfer/mappings/Stage1");
    assert!(text.starts_with("# Tilewright\nName = Stage1\nBits = 3\n0 Idle\n1 Read\n2 Examine\n"), "{text}");
    let report = folder.json("wave patch-table -o table.vcd --json");
    assert!(report["files"].as_array().unwrap().contains(&".surfer/mappings/Stage1".into()), "{report}");
    // That of somebody else stays.
    std::fs::write(folder.path(".surfer/mappings/Stage1"), "Name = Mine\n0 Nought\n").unwrap();
    let run = folder.run("wave patch-table -o table.vcd");
    let warning = "warning: .surfer/mappings/Stage1 was not written by tilewright and is kept";
    assert!(run.code == Some(0) && run.stderr.contains(warning), "{run:?}");
    assert_eq!(folder.read(".surfer/mappings/Stage1"), "Name = Mine\n0 Nought\n");
}

#[test]
fn words_that_are_records_have_a_decoder_for_surfer() {
    let folder = Folder::new();
    let report = folder.json("wave patch-table -o table.vcd --memory entries --json");
    let file = ".surfer/decoders/Entry/fields.toml";
    assert!(report["files"].as_array().unwrap().contains(&file.into()), "{report}");
    let text = folder.read(file);
    assert!(text.starts_with("# Tilewright\nset = \"fields\"\nwidth = 3\n"), "{text}");
    assert!(text.contains("repr = { default = \"resident %resident%, page %page%\" }"), "{text}");
    // Its word is as wide as the decoder says.
    let waveform = Waveform::read(&folder.path("table.vcd"));
    assert!(waveform.names.iter().any(|name| name.ends_with(".entries[0][2:0]")), "{:?}", waveform.names);
}

#[test]
fn filters_choose_signals_and_times() {
    let folder = Folder::new();
    folder.stdout("wave image-merger -o some.vcd --scope u_merging_unit[1].** --from 0.4us --to 800ns");
    let waveform = Waveform::read(&folder.path("some.vcd"));
    let inside = |name: &String| name.contains(".u_merging_unit[1].");
    assert!(waveform.names.iter().any(inside), "{:?}", waveform.names);
    assert!(waveform.names.iter().all(|name| inside(name) || name.ends_with(".clk")), "{:?}", waveform.names);
    assert_eq!((waveform.times.first(), waveform.times.last()), (Some(&400_000), Some(&800_000)));
    assert!(folder.read("some.gtkw").contains(".u_merging_unit[1].lane.left1[47:0]\n"));
}

#[test]
fn text_shows_the_ports() {
    let text = Folder::new().stdout("wave page-id-generator --ascii");
    let rows: Vec<&str> = text.lines().filter_map(|line| line.split_once('|')).map(|(name, _)| name.trim()).collect();
    assert_eq!(rows[0], "clk", "{text}");
    assert!(rows.len() > 3 && text.contains("/~"), "{text}");
}

#[test]
fn without_a_file_the_wave_is_text() {
    let folder = Folder::new();
    let text = folder.stdout("wave merging_unit");
    assert!(text.starts_with("clk    |__"), "{text}");
    assert_eq!(text, folder.stdout("wave merging-unit --ascii"));
    let lines = "gtkwave mu.vcd mu.gtkw\nsurfer -c mu.sucl mu.vcd\n";
    assert_eq!(folder.stdout("wave merging-unit -o mu.vcd --ascii"), text + lines);
    assert_eq!(folder.names(), ["mu.gtkw", "mu.sucl", "mu.vcd"]);
}

#[test]
fn text_has_the_radix_that_is_asked_for() {
    let folder = Folder::new();
    let row = |options: &str, name: &str| {
        let text = folder.stdout(&format!("wave merging-unit {options}"));
        text.lines().find(|line| line.starts_with(name)).unwrap().to_owned()
    };
    assert_eq!(row("", "right "), row("--radix hex", "right "));
    assert!(row("", "right ").contains("| 63 | 3  | 62 |"));
    assert!(row("--radix decimal", "right ").contains("| 99 | 3  | 98 |"));
    assert!(row("--radix binary", "right ").contains("| 1100011 | 11      | 1100010 |"));
}

#[test]
fn every_block_that_is_listed_can_be_run() {
    let folder = Folder::new();
    let lists = folder.json("list --json");
    for block in lists["blocks"].as_array().unwrap() {
        let name = block["name"].as_str().unwrap();
        let report = folder.json(&format!("wave {name} -o {name}.vcd --json"));
        assert_eq!(report["scenario"], block["scenario"], "{name}");
        assert!(report["picoseconds"].as_u64() > Some(0), "{name}");
        assert_eq!(report["commands"][0], format!("gtkwave {name}.vcd {name}.gtkw"), "{name}");
        Waveform::read(&folder.path(format!("{name}.vcd")));
    }
}

#[test]
fn a_pattern_may_be_a_path_of_the_waveform_or_the_verilog() {
    let folder = Folder::new();
    let names = |scope: &str| {
        folder.stdout(&format!("wave image-merger --set units=4 -o some.vcd --scope {scope}"));
        Waveform::read(&folder.path("some.vcd")).names
    };
    let short = names("u_merging_unit[1].left1");
    assert!(short.contains(&"image_merger_units4.u_merging_unit[1].lane.left1[47:0]".to_owned()), "{short:?}");
    for scope in [
        "u_merging_unit[1].lane.left1",
        "image_merger_units4.u_merging_unit[1].left1",
        "image_merger_units4.u_merging_unit[1].lane.left1[47:0]",
    ] {
        assert_eq!(names(scope), short, "{scope}");
    }
    assert_eq!(names("image_merger_units4.u_merging_unit[*].lane.*"), names("u_merging_unit[*].*"));
    let run = folder.run("wave image-merger --set units=4 -o some.vcd --scope no_such_scope.at_all.*");
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.ends_with(": there are `**`, `u_merging_unit[*].**`\n"), "{run:?}");
}

#[test]
fn a_pattern_of_many_stars_is_no_riddle() {
    let folder = Folder::new();
    let run = folder.shell(&format!("timeout 20 tilewright wave vc1 -o x.vcd --scope '{}z'", "**".repeat(30)));
    assert!(run.code == Some(2) && run.stderr.contains("no signal that matches"), "{run:?}");
}

#[test]
fn the_run_ends_with_the_waveform() {
    let folder = Folder::new();
    let line = "wave gfb-unit --set width=64 --set height=64 -o x.vcd";
    let whole = folder.json(&format!("{line} --json"))["picoseconds"].as_u64().unwrap();
    let report = folder.json(&format!("{line} --to 1us --json"));
    assert!(report["picoseconds"].as_u64().unwrap() < 20_000_000 && whole > 100_000_000, "{whole}: {report}");
    assert_eq!(Waveform::read(&folder.path("x.vcd")).times.last(), Some(&1_000_000));
    // Text shows the whole scenario.
    let text = |more: &str| folder.stdout(&format!("wave gfb-unit --ascii {more}"));
    let whole = text("");
    assert!(text("-o x.vcd --to 100ns").starts_with(&whole));
}

#[test]
fn a_port_of_lanes_is_shown_lane_by_lane() {
    let text = Folder::new().stdout("wave coverage-test --ascii");
    for name in ["works_valid ", "works_polygon_right[0] ", "works_polygon_right[2] ", "parts_window_planes[3] "] {
        assert!(text.lines().any(|line| line.starts_with(name)), "{name}: {text}");
    }
    assert!(!text.contains("works_polygon_right "), "{text}");
}

#[test]
fn a_picture_has_the_rows_of_the_text() {
    let folder = Folder::new();
    assert_eq!(folder.stdout("wave merging-unit -o mu.svg"), "");
    // The picture of the documentation: `tilewright wave merging-unit -o docs/merging-unit.svg` makes it.
    assert_eq!(folder.read("mu.svg"), include_str!("../../docs/merging-unit.svg"));
    assert_eq!(folder.names(), ["mu.svg"]);
    let values = |options: &str| {
        folder.stdout(&format!("wave merging-unit -o some.svg {options}"));
        folder.read("some.svg").matches("<g><title>").count()
    };
    assert!(values("--radix decimal") > values("--from 0.4us --to 0.8us"));
    let drawn = folder.json("wave page-id-generator -o page.svg --json");
    assert_eq!((&drawn["files"][0], &drawn["commands"]), (&"page.svg".into(), &serde_json::json!([])));

    for (line, sentence) in [
        ("wave merging-unit -o mu.svg --scope **", "leave out --scope and --memory"),
        ("wave merging-unit -o mu.vcd --radix hex", "--radix is for text and pictures"),
        ("wave gfb-unit -o gfb.svg --set width=64 --set height=64", "pass --from and --to"),
    ] {
        let run = folder.run(line);
        assert!(run.code == Some(2) && run.stderr.contains(sentence), "{line}: {run:?}");
    }
}

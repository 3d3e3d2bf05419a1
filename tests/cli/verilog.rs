//! `verilog`.

use crate::cli::harness::Folder;
use tilewright_gen::tools::skipped_without;

fn has_icarus() -> bool {
    skipped_without(&["iverilog", "vvp"]).is_none()
}

#[test]
fn the_printed_line_proves_every_block_in_icarus() {
    let folder = Folder::new();
    let lists = folder.json("list --json");
    for block in lists["blocks"].as_array().unwrap() {
        let name = block["name"].as_str().unwrap();
        let lines = folder.stdout(&format!("verilog {name} -o {name} --testbench"));
        let line = lines.lines().next().unwrap();
        assert!(line.contains("iverilog"), "{lines}");
        if has_icarus() {
            let run = folder.shell(line);
            // What is covered is said before.
            let result = run.stdout.lines().last().unwrap_or_default();
            assert!(result.starts_with("PASS: ") && !result.starts_with("PASS: 0 "), "{name}: {run:?}");
        }
    }
}

#[test]
fn the_printed_lines_follow_one_another_and_fail_with_the_bench() {
    let folder = Folder::new();
    let lines = folder.stdout("verilog merging-unit -o out/ --testbench");
    assert_eq!(lines.lines().count(), 2, "{lines}");
    assert!(lines.lines().all(|line| line.starts_with("(cd out/ && ") && line.ends_with(')')), "{lines}");
    let report = folder.json("verilog merging-unit -o out/ --testbench --json");
    assert_eq!(report["commands"], serde_json::json!(lines.lines().collect::<Vec<_>>()));
    let icarus = lines.lines().next().unwrap();
    if has_icarus() {
        let twice = folder.shell(&format!("{icarus}\n{icarus}"));
        assert_eq!((twice.code, twice.stdout.matches("PASS: ").count()), (Some(0), 2), "{twice:?}");
        let name = "out/merging_unit_tb.v";
        let bench = folder.read(name);
        let wrong = bench.replacen("48'h000000000003", "~48'h000000000003", 1);
        assert_ne!(bench, wrong);
        std::fs::write(folder.path(name), wrong).unwrap();
        let failed = folder.shell(icarus);
        assert!(failed.code == Some(1) && failed.stdout.contains("FAIL: 1 mismatches"), "{failed:?}");
    }
}

#[test]
fn the_report_lists_the_files() {
    let folder = Folder::new();
    let report = folder.json("verilog image-merger --set units=3 -o out/deep --testbench --json");
    assert_eq!(report["parameters"]["units"], 3);
    let files: Vec<&str> = report["files"].as_array().unwrap().iter().map(|it| it.as_str().unwrap()).collect();
    assert_eq!(
        files,
        ["out/deep/merging_unit.v", "out/deep/image_merger_units3.v", "out/deep/image_merger_units3_tb.v"]
    );
    assert!(folder.read("out/deep/image_merger_units3.v").contains("module image_merger_units3"));
    let bench = folder.read("out/deep/image_merger_units3_tb.v");
    assert!(bench.contains("module image_merger_units3_tb"));
    assert!(report["cycles"].as_u64() > Some(12), "{report}");
}

#[test]
fn without_a_testbench_there_is_none() {
    let folder = Folder::new();
    assert_eq!(folder.stdout("verilog merging-unit -o out"), "");
    assert!(!folder.path("out/merging_unit_tb.v").exists());
    assert!(folder.path("out/merging_unit.v").exists());
}

#[test]
fn constraints_are_beside_the_verilog() {
    let folder = Folder::new();
    let report = folder.json("verilog merging-unit -o out --constraints lpf --testbench --json");
    let files = serde_json::json!(["out/merging_unit.v", "out/merging_unit.lpf", "out/merging_unit_tb.v"]);
    assert_eq!(report["files"], files);
    assert!(folder.read("out/merging_unit.lpf").contains("\nFREQUENCY PORT \"clk\" 12.5 MHZ;\n"));
    std::fs::write(folder.path("board.pins"), "clk P1 LVCMOS33\nagain P2\nreset P3\n").unwrap();
    folder.stdout("verilog power-on-reset -o out --constraints xdc --pins board.pins");
    let text = folder.read("out/power_on_reset_clocks3.xdc");
    assert!(text.contains("set_property -dict {PACKAGE_PIN P1 IOSTANDARD LVCMOS33} [get_ports {clk}]"), "{text}");
    assert_eq!(text.matches("set_property").count(), 3, "{text}");
}

#[test]
fn wrong_pins_leave_no_folder() {
    let folder = Folder::new();
    std::fs::write(folder.path("board.pins"), "\nclk 1\nled 2\ntx\n").unwrap();
    let run = folder.run("verilog merging-unit -o out --constraints lpf --pins board.pins");
    assert_eq!(run.code, Some(2), "{run:?}");
    assert_eq!(run.stderr, "error: board.pins:4: `tx` has no pin: write the pin behind the port, as in `tx G2`\n");
    std::fs::write(folder.path("board.pins"), "clk 1\nled 2\ntx 3\n").unwrap();
    let run = folder.run("verilog merging-unit -o out --constraints lpf --pins board.pins");
    assert_eq!(run.code, Some(2), "{run:?}");
    let wrong = [
        "error: board.pins:2: the chip has no port `led`: did you mean `left`?\n",
        "error: board.pins:3: the chip has no port `tx`: its ports are `clk`, `enable`, `left`, `nearer`, `right`\n",
    ];
    assert_eq!(run.stderr, wrong.concat());
    assert!(!folder.path("out").exists());
}

#[test]
fn each_kind_of_reset_goes_into_one_folder() {
    let folder = Folder::new();
    for (kind, top, edge) in [
        ("sync", "counter_limit5", "always @(posedge clk) begin"),
        ("sync-low", "counter_limit5_synchronous_low", "if (!rst_n)"),
        ("async", "counter_limit5_asynchronous", "always @(posedge clk or posedge rst) begin"),
        ("async-low", "counter_limit5_asynchronous_low", "always @(posedge clk or negedge rst_n) begin"),
        ("power-on", "counter_limit5_power_on", "initial count"),
    ] {
        let report = folder.json(&format!("verilog counter --reset {kind} -o out --testbench --json"));
        assert_eq!(report["top"], top);
        assert!(folder.read(format!("out/{top}.v")).contains(edge), "{kind}");
    }
    // No file of one kind was overwritten by another.
    assert_eq!(std::fs::read_dir(folder.path("out")).unwrap().count(), 10);
    let refused = folder.run("verilog multiplier --reset async -o none");
    assert_eq!(refused.code, Some(2), "{refused:?}");
    let sentence = "multiplier has no reset on a clock of its own, which --reset is for: leave it out";
    assert!(refused.stderr.contains(sentence) && !folder.path("none").exists(), "{refused:?}");
}

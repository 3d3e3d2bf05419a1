//! Every command line that the help texts, the README and the page of commands show runs as it stands.

use crate::cli::bench;
use crate::cli::debug::on_the_page;
use crate::cli::harness::{Folder, Run};
use crate::cli::interruption::{send, start_command};
use crate::cli::reproduce::made::made;
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader};
use tilewright_gen::tools::{skipped, skipped_without};

/// The subcommands, from the program's own list.
fn subcommands(folder: &Folder) -> Vec<String> {
    let help = folder.stdout("--help");
    let list = help.split("Commands:\n").nth(1).and_then(|rest| rest.split("\n\n").next()).unwrap();
    let names = list.lines().filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(str::to_owned).collect()
}

/// Runs a command, which has to succeed; outside of CI it may ask for a program that is not installed.
fn assert_runs(folder: &Folder, arguments: &str) {
    if let Some(options) = arguments.strip_prefix("reproduce ") {
        assert_eq!(made(options).run.code, Some(0));
        return;
    }
    if arguments.starts_with("view ") && !arguments.contains("--export") {
        assert_serves(folder, arguments);
        return;
    }
    if let Some(arguments) = arguments.strip_prefix("debug ") {
        let code = on_the_page(folder, arguments, "q").map(|run| run.code);
        assert!(code.is_none_or(|code| code == Some(0)), "{arguments}: {code:?}");
        return;
    }
    let run = bench::example(arguments).unwrap_or_else(|| folder.shell(&format!("tilewright {arguments}")));
    if run.code == Some(4) {
        let _ = skipped(&format!("{arguments}: {}", run.stderr.trim_end()));
        return;
    }
    assert_eq!(run.code, Some(0), "{arguments}: {run:?}");
}

/// Runs a command that goes on until it is stopped, and prints an address before.
fn assert_serves(folder: &Folder, arguments: &str) {
    // A port that the page names may be in use here.
    let free: Vec<&str> = arguments.split(" --port ").take(1).collect();
    let mut child = start_command(&mut folder.command(free[0]));
    let mut line = String::new();
    BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
    send(&child, "INT");
    let run = Run::of(child.wait_with_output().unwrap());
    assert!(line.starts_with("http://127.0.0.1:") && run.code == Some(0), "{arguments}: {line}{run:?}");
}

/// The arguments of a command line without its comment.
fn arguments<'a>(line: &'a str, program: &str) -> Option<&'a str> {
    line.strip_prefix(program).map(|rest| rest.split(" #").next().unwrap_or(rest).trim())
}

#[test]
fn the_commands_of_the_help_texts_and_pages_run() {
    let hand = include_str!("../../docs/guide/hand/counter.v").replace("module counter", "module hand_counter");
    let folder = Folder::with(&[("hand.v", &hand)]);
    let mut lines = BTreeSet::new();
    for name in subcommands(&folder) {
        let help = folder.stdout(&format!("{name} --help"));
        let before = lines.len();
        lines.extend(help.lines().filter_map(|line| arguments(line, "  tilewright ").map(str::to_owned)));
        assert!(lines.len() > before, "`tilewright {name} --help` has no example");
    }
    for page in [include_str!("../../README.md"), include_str!("../../docs/cli.md")] {
        let before = lines.len();
        let blocks = page.split("```sh\n").skip(1);
        for line in blocks.flat_map(|rest| rest.split("```").next()).flat_map(str::lines) {
            let arguments = arguments(line, "cargo run --release -- ").or(arguments(line, "tilewright "));
            lines.extend(arguments.map(str::to_owned));
        }
        assert!(lines.len() > before, "the page shows no command of its own:\n{page}");
    }
    for line in lines {
        assert_runs(&folder, &line);
    }
}

/// The block of the README that has Icarus and Yosys read what is printed.
#[test]
fn the_readmes_commands_of_other_tools_run() {
    if skipped_without(&["iverilog", "vvp", "yosys"]).is_some() {
        return;
    }
    let blocks = include_str!("../../README.md").split("```sh\n").skip(1);
    let mut blocks = blocks.filter_map(|rest| rest.split("```").next());
    let block = blocks.find(|block| block.contains("iverilog")).expect("the README has such a block");
    let folder = Folder::new();
    let run = folder.shell(&format!("set -e\n{block}"));
    assert!(run.code == Some(0) && run.stdout.contains("PASS"), "{run:?}");
    assert!(folder.read("out/cells.txt").contains("TRELLIS_FF"));
}

#[test]
fn the_page_of_commands_has_the_exit_codes_of_the_help() {
    let help = Folder::new().stdout("--help");
    let codes = help.split("Exit codes:\n").nth(1).and_then(|rest| rest.split("\n\n").next()).unwrap();
    assert_eq!(codes.lines().count(), 11, "{codes}");
    for line in codes.lines() {
        let (code, meaning) = line.trim().split_once(' ').unwrap();
        let row = format!("| {code} | {} |", meaning.trim());
        assert!(include_str!("../../docs/cli.md").contains(&row), "docs/cli.md lacks `{row}`");
    }
}

#[test]
fn completions_know_commands_and_blocks() {
    let folder = Folder::new();
    // The others' scripts complete commands and options alone.
    for shell in ["bash", "zsh"] {
        let script = folder.stdout(&format!("completions {shell}"));
        assert!(script.contains("render") && script.contains("merging-unit"), "{shell}");
    }
    for shell in ["elvish", "fish", "powershell"] {
        assert!(folder.stdout(&format!("completions {shell}")).contains("render"), "{shell}");
    }
}

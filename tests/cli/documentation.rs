//! Every command line that the help texts and the README show runs as it stands.

use crate::harness::Folder;

/// The subcommands, from the program's own list.
fn subcommands(folder: &Folder) -> Vec<String> {
    let help = folder.stdout("--help");
    let list = help.split("Commands:\n").nth(1).and_then(|rest| rest.split("\n\n").next()).unwrap();
    let names = list.lines().filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(str::to_owned).collect()
}

/// Runs a command, which has to succeed; outside of CI it may ask for a program that is not installed.
fn assert_runs(folder: &Folder, arguments: &str) {
    let run = folder.shell(&format!("tilewright {arguments}"));
    if run.code == Some(4) && std::env::var_os("CI").is_none() {
        println!("skipped: {}", run.stderr);
        return;
    }
    assert_eq!(run.code, Some(0), "{arguments}: {run:?}");
}

#[test]
fn the_examples_of_every_subcommand_run() {
    let folder = Folder::new();
    for name in subcommands(&folder) {
        let help = folder.stdout(&format!("{name} --help"));
        let examples: Vec<&str> = help.lines().filter_map(|line| line.strip_prefix("  tilewright ")).collect();
        assert!(!examples.is_empty(), "`tilewright {name} --help` has no example");
        for example in examples {
            assert_runs(&folder, example);
        }
    }
}

#[test]
fn the_commands_of_the_readme_run() {
    let folder = Folder::new();
    let readme = include_str!("../../README.md");
    let mut count = 0;
    for line in readme.split("```sh\n").skip(1).flat_map(|rest| rest.split("```").next()).flat_map(str::lines) {
        let Some(arguments) = line.strip_prefix("cargo run --release -- ").or(line.strip_prefix("tilewright ")) else {
            continue;
        };
        assert_runs(&folder, arguments);
        count += 1;
    }
    assert!(count > 0, "the README shows no command");
}

#[test]
fn the_readme_has_the_exit_codes_of_the_help() {
    let help = Folder::new().stdout("--help");
    let codes = help.split("Exit codes:\n").nth(1).and_then(|rest| rest.split("\n\n").next()).unwrap();
    assert_eq!(codes.lines().count(), 10, "{codes}");
    for line in codes.lines() {
        let (code, meaning) = line.trim().split_once(' ').unwrap();
        let row = format!("| {code} | {} |", meaning.trim());
        assert!(include_str!("../../README.md").contains(&row), "the README lacks `{row}`");
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

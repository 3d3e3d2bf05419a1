//! The commands of the guide print what it shows.

use crate::cli::harness::Folder;
use tilewright_gen::tools::skipped_without;
use tilewright_guide::book::{Fence, commands, fences, stands_in};

#[test]
fn the_commands_of_the_guide_print_what_it_shows() {
    // One folder, as later commands may read what earlier ones write.
    let folder = Folder::with(&[("counter.v", include_str!("../docs/guide/hand/counter.v"))]);
    let mut count = 0;
    for Fence { place, text, .. } in fences().into_iter().filter(|fence| fence.text.contains("$ tilewright ")) {
        for (command, shown) in commands(&text) {
            let needed: &[&str] = match () {
                () if command.starts_with("tilewright prove ") => &["yosys", "z3"],
                () if command.contains(" --against icarus") => &["iverilog", "vvp"],
                () if command.contains(" --equal-to ") => &["yosys", "yosys-abc"],
                () => &[],
            };
            if skipped_without(needed).is_some() {
                continue;
            }
            let run = folder.shell(&command);
            let printed = run.stdout + &run.stderr;
            assert!(run.code.is_some_and(|code| code < 2), "{place}: {command}: {printed}");
            let is_as_shown = shown.trim().is_empty() || stands_in(&shown, &printed);
            assert!(is_as_shown, "{place}: {command}\nprints\n{printed}");
            count += 1;
        }
    }
    assert!(count > 3, "only {count} are found");
}

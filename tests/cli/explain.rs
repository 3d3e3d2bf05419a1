//! `explain`.

use crate::cli::harness::Folder;

#[test]
fn a_pass_is_shown_with_the_users_names_and_source_lines() {
    let text = Folder::new().stdout("explain scan-counter --pass fold");
    assert!(
        text.starts_with("# fold: Constants are computed, and operations without effect are removed.\n\n"),
        "{text}"
    );
    let line = text.lines().find(|line| line.starts_with("line_end ")).unwrap();
    assert!(line.contains("= scan_enable & %") && line.contains("   rtl/src/lfb/scan_counter.rs:"), "{line}");
    assert!(text.contains("\nat clk:\n  pixel_x <- %"), "{text}");
    assert_eq!(text.matches("# ").count(), 1, "only that pass is shown: {text}");
}

#[test]
fn every_pass_of_every_block_is_explained_the_same_each_time() {
    let folder = Folder::new();
    for block in folder.json("list --json")["blocks"].as_array().unwrap() {
        let arguments = format!("explain {} --json", block["name"].as_str().unwrap());
        let report = folder.json(&arguments);
        let passes = report["passes"].as_array().unwrap();
        assert_eq!(passes.len(), 16, "{arguments}");
        for pass in passes {
            assert!(!pass["text"].as_str().unwrap().is_empty(), "{arguments}: {pass}");
        }
        assert_eq!(report, folder.json(&arguments));
    }
}

#[test]
fn the_instructions_of_a_bench_are_shown_with_the_names_of_what_they_access() {
    let text = Folder::new().stdout("explain core1 --pass strips");
    assert!(text.lines().any(|line| line.starts_with("v0: i64 = load [state")), "{text}");
    assert!(text.lines().any(|line| line.contains("store i") && line.ends_with("; u_processor.pc")), "{text}");
    let run = Folder::new().run("explain core1 --set width=3");
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("core1 has no parameters but the numbers of its name"), "{}", run.stderr);
}

#[test]
fn a_pass_that_there_is_not_is_refused_with_those_that_there_are() {
    let run = Folder::new().run("explain scan-counter --pass optimise");
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("optimise") && run.stderr.contains("flatten, siblings, share, fold"), "{}", run.stderr);
}

//! `docs/glossary.md` is sorted, and leads to files that exist.

use std::path::Path;

const PAGE: &str = include_str!("../docs/glossary.md");

#[test]
fn words_are_sorted_and_lead_to_files() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let (mut words, mut before) = (0, "");
    for line in PAGE.lines() {
        let Some((cell, _)) = line.strip_prefix("| ").and_then(|row| row.split_once(" | ")) else {
            before = "";
            continue;
        };
        if cell == "Word" {
            continue;
        }
        let link = cell.strip_prefix('[').and_then(|cell| cell.strip_suffix(')')?.split_once("]("));
        let (word, file) = link.unwrap_or_else(|| panic!("`{cell}` is no link"));
        let sorted = before.to_lowercase() < word.to_lowercase();
        assert!(sorted, "`{word}` stands behind `{before}`");
        let file = file.split('#').next().unwrap();
        assert!(docs.join(file).exists(), "`{word}` leads to {file}, which does not exist");
        (words, before) = (words + 1, word);
    }
    assert!(words > 60, "only {words} words were found");
}

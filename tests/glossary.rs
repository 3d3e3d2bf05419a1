//! `docs/glossary.md` is sorted, and leads to files that exist.

use std::path::Path;

const PAGE: &str = include_str!("../docs/glossary.md");

#[test]
fn words_are_sorted_and_lead_to_files() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let (mut words, mut before) = (0, "");
    for line in PAGE.lines() {
        let Some((word, rest)) = line.strip_prefix("| ").and_then(|row| row.split_once(" | ")) else {
            before = "";
            continue;
        };
        if word == "Word" {
            continue;
        }
        let sorted = before.to_lowercase() < word.to_lowercase();
        assert!(sorted, "`{word}` stands behind `{before}`");
        let file = rest.rsplit_once("](").and_then(|(_, file)| file.strip_suffix(") |"));
        let file = file.unwrap_or_else(|| panic!("`{word}` does not end with a link")).split('#').next().unwrap();
        assert!(docs.join(file).exists(), "`{word}` leads to {file}, which does not exist");
        (words, before) = (words + 1, word);
    }
    assert!(words > 60, "only {words} words were found");
}

//! The pages are listed, linked, and of one form.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use tilewright_guide::book::{Page, folder, pages};

/// The targets of the links of a page.
fn links(text: &str) -> Vec<&str> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets.filter(|target| !target.starts_with("http")).collect()
}

#[test]
fn links_lead_to_files() {
    let mut count = 0;
    for page in pages() {
        for link in links(&page.text) {
            let file = link.split('#').next().unwrap();
            let file: PathBuf = folder().join(if file.is_empty() { &page.name } else { file });
            assert!(file.exists(), "{}: {link} leads nowhere", page.name);
            count += 1;
        }
    }
    assert!(count > 10, "only {count} links are found");
}

#[test]
fn every_page_is_in_the_table_of_contents_once() {
    let summary = fs::read_to_string(folder().join("SUMMARY.md")).unwrap();
    let listed = links(&summary);
    let unique: BTreeSet<&str> = listed.iter().copied().collect();
    assert_eq!(listed.len(), unique.len(), "a page is listed twice");
    let pages = pages();
    let others: BTreeSet<&str> = pages.iter().map(|page| &*page.name).filter(|name| *name != "SUMMARY.md").collect();
    assert_eq!(others, unique);
}

#[test]
fn every_chapter_says_what_it_is_good_for_and_what_comes_next() {
    for Page { name, text } in pages() {
        if name.starts_with(|first: char| first.is_ascii_digit()) {
            assert!(text.contains("\nAfter this chapter you can "), "{name} does not say what the reader can do then");
            assert!(text.contains("\n## Exercise"), "{name} has no exercise");
            assert!(text.contains("\nNext: ["), "{name} does not say what to read next");
        }
    }
}

//! The pages of the book, and what stands in them.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the guide.
pub fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

pub struct Page {
    pub name: String,
    pub text: String,
}

/// All pages, in order of their names.
pub fn pages() -> Vec<Page> {
    let files = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let names: BTreeSet<String> = files.filter(|name| name.ends_with(".md")).collect();
    let page = |name: String| Page { text: fs::read_to_string(folder().join(&name)).unwrap(), name };
    names.into_iter().map(page).collect()
}

/// A fenced block. Its first line is "```LANGUAGE SOURCE"; the source says where its text comes from.
pub struct Fence {
    pub place: String,
    pub language: String,
    pub source: String,
    pub text: String,
}

/// The fenced blocks of all pages.
pub fn fences() -> Vec<Fence> {
    pages().iter().flat_map(fences_of).collect()
}

fn fences_of(page: &Page) -> Vec<Fence> {
    let mut fences: Vec<Fence> = Vec::new();
    let mut is_open = false;
    for (number, line) in page.text.lines().enumerate() {
        match (line.trim_start().strip_prefix("```"), is_open) {
            (Some(_), true) => is_open = false,
            (Some(opening), false) => {
                let (language, source) = opening.split_once(' ').unwrap_or((opening, ""));
                let (language, source) = (language.to_owned(), source.to_owned());
                fences.push(Fence {
                    place: format!("{}:{}", page.name, number + 1),
                    language,
                    source,
                    text: String::new(),
                });
                is_open = true;
            }
            (None, true) => fences.last_mut().unwrap().text += &format!("{line}\n"),
            (None, false) => {}
        }
    }
    assert!(!is_open, "{}: a block does not end", page.name);
    fences
}

/// Whether `shown` stands in `whole`: each of its parts, which lines of `..` separate, in order, but for what all of its lines are indented by.
pub fn stands_in(shown: &str, whole: &str) -> bool {
    let lines = |text: &str| text.lines().map(|line| line.trim().to_owned()).collect::<Vec<_>>();
    let (shown, whole) = (lines(shown), lines(whole));
    let mut from = 0;
    shown.iter().any(|line| line.len() > 2)
        && shown.split(|line| line == ".." || line == "// ..").filter(|part| !part.is_empty()).all(|part| {
            let found = whole[from..].windows(part.len()).position(|window| window == part);
            from += found.map_or(0, |at| at + part.len());
            found.is_some()
        })
}

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

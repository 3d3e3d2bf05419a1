//! `docs/papers.md` defines what the repository cites: codes of the papers' statements, and sections as "facts" with a letter.

use crate::tree::files;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

const PAGE: &str = include_str!("../docs/papers.md");

/// What cites: all text but scene files and data.
const EXTENSIONS: [&str; 7] = ["csv", "html", "json", "md", "rs", "toml", "v"];

/// Page and test name codes without citing them.
const LEFT_OUT: [&str; 2] = ["docs/papers.md", "tests/papers.rs"];

/// The beginnings of codes.
const PREFIXES: [&str; 5] = ["DES-", "MPG-", "PFL-", "PP5-", "VC1-"];

#[test]
fn every_citation_leads_somewhere_and_every_definition_is_cited() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (defined, mut cited, mut nowhere) = (definitions(PAGE), BTreeSet::new(), Vec::new());
    for file in files(root, &EXTENSIONS) {
        let path = file.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/");
        if LEFT_OUT.contains(&path.as_str()) {
            continue;
        }
        for (line, code) in citations(&fs::read_to_string(&file).unwrap()) {
            if !defined.contains(&code) {
                nowhere.push(format!("{path}:{line}: {code}"));
            }
            cited.insert(code);
        }
    }
    assert!(cited.len() > 90, "only {} codes were found", cited.len());
    assert!(nowhere.is_empty(), "not defined in docs/papers.md:\n{}", nowhere.join("\n"));
    let unused: Vec<_> = defined.difference(&cited).collect();
    assert!(unused.is_empty(), "defined in docs/papers.md and cited nowhere: {unused:?}");
}

#[test]
fn citations_are_found_where_text_is_wrapped() {
    let text = "/// As (facts\n/// E0, A3; VC1-SW1 to SW4), facts B and E2 (of a test), D.\n// PFL C1. artefacts A1, XVC1-A, facts follow; Facts C: MPG-EQ1.";
    let expected =
        [(1, "E0"), (1, "A3"), (2, "VC1-SW1"), (2, "B"), (2, "E2"), (2, "D"), (3, "PFL-C1"), (3, "C"), (3, "MPG-EQ1")];
    let mut found = citations(text);
    found.sort_by_key(|(line, code)| expected.iter().position(|it| *it == (*line, code.as_str())));
    assert_eq!(found.iter().map(|(line, code)| (*line, code.as_str())).collect::<Vec<_>>(), expected);
}

/// Codes by their anchors, which name them again, and sections by their headings.
fn definitions(page: &str) -> BTreeSet<String> {
    let mut defined = BTreeSet::new();
    for line in page.lines() {
        let code = match line.strip_prefix("| <a id=\"") {
            Some(row) => {
                let (anchor, rest) = row.split_once("\"></a>").expect("an anchor ends");
                let name = rest.split(" | ").next().unwrap();
                assert_eq!(anchor, name.replace(' ', "-"), "the anchor is the code");
                anchor
            }
            None => match line.strip_prefix("## ").and_then(|heading| heading.split_once(": ")) {
                Some((section, _)) => section,
                None => continue,
            },
        };
        assert!(defined.insert(code.to_owned()), "{code} is defined twice");
    }
    defined
}

/// What a text cites, with the numbers of the lines.
fn citations(text: &str) -> Vec<(usize, String)> {
    if !PREFIXES.iter().chain(&["PFL ", "acts"]).any(|part| text.contains(part)) {
        return Vec::new();
    }
    let mut flat = String::with_capacity(text.len());
    let mut starts = Vec::new();
    for line in text.lines() {
        starts.push(flat.len());
        flat += line.trim_start().trim_start_matches(['/', '!', '#', '*']).trim();
        flat.push(' ');
    }
    let line = |at: usize| starts.partition_point(|start| *start <= at);
    let mut found = Vec::new();
    for prefix in PREFIXES {
        for (at, _) in flat.match_indices(prefix).filter(|(at, _)| begins_word(&flat, *at)) {
            let rest = &flat[at + prefix.len()..];
            let tail = rest.split(|c: char| !c.is_ascii_uppercase() && !c.is_ascii_digit()).next().unwrap();
            found.push((line(at), format!("{prefix}{tail}")));
        }
    }
    for (at, name) in flat.match_indices("PFL ") {
        if let Some(figure) = section(&flat[at + name.len()..]).filter(|it| it.starts_with(['C', 'D']) && it.len() == 2)
        {
            found.push((line(at), format!("PFL-{figure}")));
        }
    }
    for (at, word) in flat.match_indices("acts ") {
        if flat[..at].ends_with(['f', 'F']) && begins_word(&flat, at - 1) {
            let sections = sections(&flat[at + word.len()..]);
            found.extend(sections.into_iter().map(|section| (line(at), section.to_owned())));
        }
    }
    found
}

fn begins_word(text: &str, at: usize) -> bool {
    !text[..at].ends_with(|c: char| c.is_alphanumeric())
}

/// The sections of a list such as `E0, A3 (why) and B`, from its beginning on.
fn sections(mut text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    while let Some(name) = section(text) {
        found.push(name);
        text = &text[name.len()..];
        if let Some(rest) = text.strip_prefix(" (") {
            text = rest.split_once(')').map_or("", |(_, rest)| rest);
        }
        text = match [", and ", ", ", " and ", " to "].iter().find_map(|between| text.strip_prefix(between)) {
            Some(rest) => rest,
            None => break,
        };
    }
    found
}

/// A letter from A to H, or one with a digit, that is a word.
fn section(text: &str) -> Option<&str> {
    let word = text.split(|c: char| !c.is_alphanumeric() && c != '-').next()?;
    let is_section = match word.as_bytes() {
        [b'A'..=b'H'] => true,
        [b'A'..=b'H', digit] => digit.is_ascii_digit(),
        _ => false,
    };
    is_section.then_some(word)
}

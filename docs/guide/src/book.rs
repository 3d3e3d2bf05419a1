//! The pages of the book and what stands in them, for the tests that compare it with what is.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The folder of the guide.
pub fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A page.
pub struct Page {
    /// The name of its file.
    pub name: String,
    /// Its Markdown.
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
    /// Its page and line.
    pub place: String,
    /// What it is written in.
    pub language: String,
    /// Where its text comes from.
    pub source: String,
    /// The text.
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

/// Each command of a block, which may have several lines, with what is shown behind it.
pub fn commands(text: &str) -> Vec<(String, String)> {
    let mut commands: Vec<(String, String)> = Vec::new();
    for line in text.lines() {
        match (line.strip_prefix("$ "), commands.last_mut()) {
            (Some(command), _) => commands.push((command.to_owned(), String::new())),
            (None, Some((command, _))) if command.ends_with('\\') || command.matches('\'').count() % 2 == 1 => {
                *command += &format!("\n{line}");
            }
            (None, Some((_, shown))) => *shown += &format!("{line}\n"),
            (None, None) => panic!("`{line}` stands before the first command"),
        }
    }
    commands
}

//! The folders of the engine use one another as its page says.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

const PAGE: &str = include_str!("../../docs/engine.md");

/// The rows of folders of the page: each uses those to its left, and none to its right.
fn rows() -> Vec<Vec<Vec<&'static str>>> {
    let rows = PAGE.lines().filter(|line| line.contains('◄'));
    let names = |row: &'static str| row.split("   ").next().unwrap_or(row).split('◄');
    rows.map(|row| names(row).map(|place| place.split(',').map(str::trim).collect()).collect()).collect()
}

/// The folders that the files of a folder use, but for their tests.
fn used_by(folder: &Path) -> BTreeSet<String> {
    let mut used = BTreeSet::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let is_test = ["tests", "tests.rs", "mutants.rs"].iter().any(|name| path.ends_with(name));
        if path.is_dir() && !is_test {
            used.extend(used_by(&path));
        } else if !is_test {
            let text = fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]\nmod tests").next().unwrap();
            used.extend(code.split("engine::").skip(1).flat_map(first_names));
        }
    }
    used
}

/// The names that a path begins with: one, or those in braces.
fn first_names(path: &str) -> Vec<String> {
    let end =
        if path.starts_with('{') { path.find('}') } else { path.find(|it: char| !it.is_alphanumeric() && it != '_') };
    let names = path[..end.unwrap_or(path.len())].trim_start_matches('{').split(',');
    names.map(|name| name.trim().split("::").next().unwrap().to_owned()).collect()
}

#[test]
fn each_folder_uses_those_to_its_left_alone() {
    let engine = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src/engine");
    let rows = rows();
    assert_eq!(rows.len(), 3, "{rows:?}");
    let mut uses = 0;
    for row in &rows {
        for (at, place) in row.iter().enumerate() {
            for &folder in place {
                let used = used_by(&engine.join(folder));
                let is_used = |other: &&str| used.contains(*other);
                let wrong: Vec<_> = row[at + 1..].iter().flatten().filter(|it| is_used(it)).collect();
                assert!(wrong.is_empty(), "{folder} uses {wrong:?}, which the page has to its right");
                uses += row[..at].iter().flatten().filter(|it| is_used(it)).count();
            }
        }
    }
    assert!(uses >= 8, "only {uses} uses are found");
}

//! Every public item of the crates that anybody may use has an example.
//!
//! `rustdoc` counts examples for nightly compilers only, and not those of methods. This reads the sources as lines: what is public is
//! what a `pub use` of the crate names, with its methods.

use crate::tree::files;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

struct Crate {
    root: &'static str,
    /// The files whose `pub use` counts: those of the root, and of public modules.
    uses: &'static [&'static str],
    /// Public modules, whose items are public by themselves.
    open: &'static [&'static str],
    /// What is left out.
    closed: &'static [&'static str],
}

const CRATES: [Crate; 7] = [
    Crate { root: "circuit/src", uses: &["lib.rs", "ir/mod.rs"], open: &["ir/", "recording.rs"], closed: &[] },
    Crate { root: "hdl/src", uses: &["lib.rs"], open: &["catalog/", "scenario.rs"], closed: &[] },
    Crate { root: "blocks/src", uses: &["lib.rs"], open: &[], closed: &[] },
    Crate { root: "report/src", uses: &["lib.rs"], open: &["browser.rs"], closed: &[] },
    Crate { root: "view/src", uses: &["lib.rs"], open: &["export.rs"], closed: &["for_examples.rs"] },
    // The printer's parts have names that the tools have too.
    Crate { root: "gen/src", uses: &["lib.rs", "tools/mod.rs"], open: &[], closed: &["verilog/"] },
    // What a circuit is compiled to is explained in `sim/docs/engine.md`.
    Crate { root: "sim/src", uses: &["lib.rs"], open: &[], closed: &["engine/program/"] },
];

#[test]
fn every_public_item_has_an_example() {
    let (mut count, mut missing) = (0, Vec::new());
    for Crate { root, uses, open, closed } in CRATES {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(root);
        let read = |file: &Path| fs::read_to_string(file).unwrap();
        let exported = uses.iter().flat_map(|file| exported(&read(&folder.join(file)))).collect();
        for file in files(&folder, &["rs"]) {
            let path = file.strip_prefix(&folder).unwrap().to_str().unwrap();
            let is_in = |modules: &[&str]| modules.iter().any(|module| path.starts_with(module));
            if is_in(closed) {
                continue;
            }
            for Item { line, name, has_example } in items(&read(&file), &exported, is_in(open)) {
                count += 1;
                if !has_example {
                    missing.push(format!("{root}/{path}:{line}: {name}"));
                }
            }
        }
    }
    assert!(count > 400, "only {count} public items were found");
    assert!(missing.is_empty(), "without an example:\n{}", missing.join("\n"));
}

/// The names in `pub use` statements that documentation shows.
fn exported(text: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let (mut hidden, mut rest) = (false, text.lines());
    while let Some(line) = rest.next() {
        if let Some(first) = line.strip_prefix("pub use ") {
            let mut statement = first.to_owned();
            while !statement.contains(';') {
                statement += rest.next().expect("a statement ends");
            }
            if !hidden {
                names.extend(statement.split(|c: char| !c.is_alphanumeric() && c != '_').map(str::to_owned));
            }
        }
        hidden = line == "#[doc(hidden)]";
    }
    names
}

struct Item {
    line: usize,
    name: String,
    has_example: bool,
}

/// The public items of a file: those that are exported, or all if it is open; methods of those types; what such a trait has.
fn items(text: &str, exported: &BTreeSet<String>, is_open: bool) -> Vec<Item> {
    let is_public = |name: &str| is_open || exported.contains(name);
    let (mut items, mut documentation) = (Vec::new(), Vec::new());
    let (mut in_attribute, mut hidden, mut is_exported) = (false, false, false);
    // Whether methods of what is around are public, and whether it is a trait, or a macro with items in it.
    let (mut around, mut in_trait, mut in_macro) = (false, false, false);
    for (number, line) in text.lines().enumerate().take_while(|(_, line)| !line.starts_with("#[cfg(test)]")) {
        let code = line.trim_start();
        if code.starts_with("///") {
            documentation.push(code);
            continue;
        }
        if code.starts_with("#[") || in_attribute {
            in_attribute = !code.ends_with(']');
            hidden |= code.contains("doc(hidden)");
            is_exported |= code == "#[macro_export]";
            continue;
        }
        if !line.starts_with(' ') {
            in_macro =
                ["block! {", "bundle! {", "codes! {", "record! {"].contains(&line) || (in_macro && line.is_empty());
        }
        if line.starts_with("impl") {
            around = implemented(line).is_some_and(is_public);
            in_trait = false;
        }
        if let Some(name) = declared(code, in_trait && line.starts_with("    fn ")) {
            let is_inner = line.starts_with(' ') && !in_macro;
            let shown = if is_inner { around } else { is_exported || is_public(name) };
            if shown && !hidden && !documentation.is_empty() {
                let has_example = has_example(&documentation);
                items.push(Item { line: number + 1, name: name.to_owned(), has_example });
            }
        }
        if let Some(of) = line.strip_prefix("pub trait ") {
            around = is_public(word(of)) && !hidden;
            in_trait = true;
        }
        documentation.clear();
        (hidden, is_exported) = (false, false);
    }
    items
}

/// The type of `impl<B: Bundle> Reg<B> {`; none of what implements a trait.
fn implemented(line: &str) -> Option<&str> {
    let mut depth = 0;
    let end = line.char_indices().find(|(_, c)| {
        depth += i32::from(*c == '<') - i32::from(*c == '>');
        depth == 0 && *c == ' '
    })?;
    let of = line[end.0..].trim_start();
    let is_trait = line.contains(" for ");
    (!is_trait).then(|| word(of))
}

/// The name that a line declares for all to see.
fn declared(code: &str, in_trait: bool) -> Option<&str> {
    // A function that is `const` before other constants.
    let functions = ["pub fn ", "pub const fn ", "macro_rules! "];
    let others = ["pub struct ", "pub enum ", "pub trait ", "pub type ", "pub const ", "pub static "];
    let kind = functions.into_iter().chain(others).find(|kind| code.starts_with(kind)).or(in_trait.then_some("fn "))?;
    Some(word(&code[kind.len()..]))
}

fn word(text: &str) -> &str {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or(text)
}

/// Whether one of the fenced parts is Rust, as a figure is not.
fn has_example(documentation: &[&str]) -> bool {
    let mut fences = documentation.iter().filter_map(|line| line.strip_prefix("/// ```"));
    let mut opening = Vec::new();
    while let Some(fence) = fences.next() {
        opening.push(fence);
        fences.next();
    }
    opening.iter().any(|fence| ["", "no_run"].contains(fence))
}

/// What a crate of the workspace needs of another one is found in a registry, too, by its version. What only its tests need may be
/// of no version, as two crates may need each other so, of which one has to be the first there.
#[test]
fn every_crate_can_be_packaged() {
    let cargo = std::env::var("CARGO").unwrap_or("cargo".to_owned());
    let run =
        Command::new(cargo).args(["metadata", "--no-deps", "--offline", "--format-version", "1"]).output().unwrap();
    let workspace: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    let packages = workspace["packages"].as_array().unwrap();
    let is_published = |package: &serde_json::Value| package["publish"].as_array().is_none_or(|to| !to.is_empty());
    let mut count = 0;
    for package in packages.iter().filter(|package| is_published(package)) {
        let said = |key: &str| package[key].as_str().is_some_and(|text| !text.is_empty());
        assert!(["description", "license", "version", "rust_version"].into_iter().all(said), "{}", package["name"]);
        // Both licences want their text beside the sources.
        let folder = Path::new(package["manifest_path"].as_str().unwrap()).parent().unwrap();
        assert!(folder.join("LICENSE-MIT").is_file() && folder.join("LICENSE-APACHE").is_file(), "{folder:?}");
        let dependencies = package["dependencies"].as_array().unwrap().iter();
        for needed in dependencies.filter(|it| it["path"].is_string() && it["kind"] != "dev") {
            let (name, of) = (&needed["name"], &package["name"]);
            assert_ne!(needed["req"], "*", "{of} needs {name}, of no version");
            let target = packages.iter().find(|package| package["name"] == *name).unwrap();
            assert!(is_published(target), "{of} needs {name}, which is never published");
            count += 1;
        }
    }
    assert!(count > 10, "only {count} are found");
}

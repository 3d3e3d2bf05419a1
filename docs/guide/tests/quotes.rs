//! The code of the chapters is the crate's, to the letter.

use std::collections::BTreeSet;
use std::fs;
use tilewright_guide::book::{Fence, fences, folder, stands_in};
use tilewright_hdl::Mistake;

#[test]
fn quoted_code_stands_in_its_file() {
    let mut count = 0;
    for Fence { place, language, source, text } in fences() {
        // What has a path for a name is a file of the guide.
        if language == "rust" || source.contains('/') {
            let file = fs::read_to_string(folder().join(&source));
            let file = file.unwrap_or_else(|error| panic!("{place}: `{source}` cannot be read: {error}"));
            assert!(stands_in(&text, &file), "{place}: {source} does not have\n{text}");
            count += 1;
        }
    }
    assert!(count > 3, "only {count} are found");
}

/// What `Cargo.toml` needs, beside a clone called `tilewright`.
#[test]
fn dependencies_are_crates_of_the_clone() {
    let mut count = 0;
    for Fence { place, text, .. } in fences().into_iter().filter(|fence| fence.language == "toml") {
        for line in text.lines().filter(|line| *line != "[dependencies]") {
            let (name, path) =
                line.split_once(" = { path = \"../tilewright/").unwrap_or_else(|| panic!("{place}: {line}"));
            let manifest = folder().join("../..").join(path.trim_end_matches("\" }")).join("Cargo.toml");
            let manifest = fs::read_to_string(&manifest).unwrap_or_else(|error| panic!("{place}: {name}: {error}"));
            assert!(manifest.contains(&format!("name = \"{name}\"")), "{place}: {line}");
            count += 1;
        }
    }
    assert!(count > 2, "only {count} are found");
}

#[test]
fn every_block_is_of_a_kind_that_is_checked() {
    // `text` and `verilog` are compared with what code prints, `console` with what commands do, `sh` is for the reader's own folder.
    for Fence { place, language, .. } in fences() {
        let kinds = ["rust", "toml", "text", "verilog", "console", "sh", "ebnf"];
        assert!(kinds.contains(&&*language), "{place}: nothing checks a block of `{language}`");
    }
}

/// The words of the grammar are those of the macro.
#[test]
fn the_grammar_has_the_words_of_the_macro() {
    let declare = folder().join("../../hdl/src/declare");
    let source = ["mod.rs", "ports.rs"].map(|name| fs::read_to_string(declare.join(name)).unwrap()).concat();
    let grammar = fences().into_iter().find(|fence| fence.language == "ebnf").expect("there is a grammar").text;
    let mut words: BTreeSet<&str> = grammar.split('"').skip(1).step_by(2).collect();
    words.retain(|word| word.starts_with(char::is_alphabetic) && *word != "pub");
    let is_letter = |c: char| c.is_lowercase() || c == '_';
    for word in &words {
        let is_there = source.lines().any(|line| line.split(|c| !is_letter(c)).any(|it| it == *word));
        assert!(is_there, "the macro knows no `{word}`");
    }
    // Each clause is taken from the front of what is left, in an arm of its own.
    let arms =
        source.lines().filter(|line| line.trim_start().starts_with("(@clauses ") && line.contains(" $latency:tt "));
    let clauses = arms.filter_map(|line| {
        line.split(['=', '$', '{']).flat_map(str::split_whitespace).find(|word| word.chars().all(is_letter))
    });
    for clause in clauses {
        assert!(words.contains(clause), "the grammar knows no `{clause}`");
    }
}

/// The index has every number of the language, with messages that the tests of the language print with that number.
#[test]
fn the_index_has_every_number_with_tested_messages() {
    let folders = ["hdl/tests/messages", "hdl/tests/validate"].map(|name| folder().join("../..").join(name));
    let tests = folders.iter().flat_map(|tests| fs::read_dir(tests).unwrap()).map(|entry| entry.unwrap().path());
    let files = tests.chain([folder().join("../../hdl/tests/latency.rs")]);
    let tests: String = files.map(|file| fs::read_to_string(file).unwrap()).collect();
    let index = fs::read_to_string(folder().join("c-messages.md")).unwrap();
    let rows = index.lines().filter(|line| line.starts_with("| T"));
    let mut numbers = Vec::new();
    for row in rows {
        let [number, message, _, _] = row.trim_matches(['|', ' ']).split(" | ").collect::<Vec<_>>()[..] else {
            panic!("a row has a number, a message, its cause and its mend: {row}")
        };
        assert!(tests.contains(&format!("{message} [{number}]")), "no test prints\n{message} [{number}]");
        numbers.push(number.to_owned());
    }
    assert!(numbers.is_sorted(), "a reader looks for a number from top to bottom");
    numbers.dedup();
    assert_eq!(numbers, Mistake::ALL.iter().map(Mistake::to_string).collect::<Vec<_>>());
}

/// What rustc says is in the tests that compare it.
#[test]
fn the_index_has_messages_of_rustc_that_are_tested() {
    let tests = fs::read_to_string(folder().join("../../hdl/tests/rustc_words.rs")).unwrap();
    let index = fs::read_to_string(folder().join("c-messages.md")).unwrap();
    let rows: Vec<_> = index.lines().filter(|line| line.starts_with("| E")).collect();
    for row in &rows {
        let [_, message, _, _] = row.trim_matches(['|', ' ']).split(" | ").collect::<Vec<_>>()[..] else {
            panic!("a row has a number, a message, its cause and its mend: {row}")
        };
        assert!(tests.contains(message), "no test compares\n{message}");
    }
    assert!(rows.len() > 5, "only {} are found", rows.len());
}

/// The last column of the translations is code that is built.
#[test]
fn translations_are_code_that_is_built() {
    let source = fs::read_to_string(folder().join("src/translations.rs")).unwrap();
    let table = fs::read_to_string(folder().join("b-translations.md")).unwrap();
    let rows = table.lines().filter(|line| line.starts_with('|')).skip(2);
    let last = rows.filter_map(|line| line.trim_end_matches(" |").rsplit_once(" | ").map(|(_, last)| last));
    let codes: Vec<&str> = last.flat_map(|cell| cell.split('`').skip(1).step_by(2)).collect();
    for code in &codes {
        assert!(source.contains(code), "src/translations.rs does not have {code}");
    }
    assert!(codes.len() > 20, "only {} are found", codes.len());
}

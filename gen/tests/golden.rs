//! The printed Verilog, whole, for four small blocks; and every linter finds nothing to say about it.
//!
//! `UPDATE_GOLDEN=1 cargo test -p tilewright-gen` writes the files anew.

mod blocks;

use blocks::{Counter, LineBuffer, Pump, Row};
use std::fmt::Write;
use std::path::PathBuf;
use tilewright_gen::{VerilogFile, tools, verilog};
use tilewright_hdl::{Block, elaborate};

fn check<B: Block>(block: &B) {
    let files = verilog(&elaborate(block).expect("the block is sound"));
    assert_eq!(files, verilog(&elaborate(block).expect("the block is sound")), "the same design prints differently");
    files.iter().filter(|file| file.name.ends_with(".v")).for_each(compare);
    tools::lint(&files).unwrap();
}

fn compare(file: &VerilogFile) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(&file.name);
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(&path, &file.text).expect("the golden file can be written");
        return;
    }
    let golden = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(golden == file.text, "{}", difference(&file.name, &golden, &file.text));
}

/// The first differing lines.
fn difference(name: &str, golden: &str, printed: &str) -> String {
    let mut text = format!("{name} is not printed as in gen/tests/golden; set UPDATE_GOLDEN=1 to accept the change\n");
    let (mut old, mut new) = (golden.lines(), printed.lines());
    let lines = std::iter::from_fn(|| match (old.next(), new.next()) {
        (None, None) => None,
        pair => Some(pair),
    });
    for (number, (old, new)) in lines.enumerate().filter(|(_, (old, new))| old != new).take(8) {
        let _ = writeln!(text, "line {}\n  - {}\n  + {}", number + 1, old.unwrap_or(""), new.unwrap_or(""));
    }
    text
}

#[test]
fn a_counter() {
    check(&Counter { width: 8, limit: 10 });
}

#[test]
fn a_state_machine() {
    check(&Pump);
}

#[test]
fn memories() {
    check(&LineBuffer);
}

#[test]
fn an_array() {
    check(&Row { lanes: 5 });
}

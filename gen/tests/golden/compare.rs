//! Compares printed files with those in `tests/golden` of the package.

use std::fmt::Write;
use std::path::PathBuf;
use tilewright_gen::VerilogFile;

pub fn compare(file: &VerilogFile) {
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
    let package = env!("CARGO_PKG_NAME");
    let mut text =
        format!("{name} is not printed as in tests/golden of {package}; set UPDATE_GOLDEN=1 to accept the change\n");
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

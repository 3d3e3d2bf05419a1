//! `manual`.

use crate::cli::harness::Folder;

#[test]
fn every_command_has_a_page_of_the_manual() {
    let folder = Folder::new();
    let text = folder.stdout("manual -o man/man1");
    assert_eq!(text, "");
    let whole = folder.read("man/man1/tilewright.1");
    let commands: Vec<&str> =
        whole.lines().filter_map(|line| line.strip_prefix("tilewright\\-")?.strip_suffix("(1)")).collect();
    assert!(commands.len() > 10, "{commands:?}");
    assert!(whole.contains("\nExit codes:\n") && !commands.contains(&"help"), "{whole}");
    let (footer, mut count) = (concat!("\"tilewright ", env!("CARGO_PKG_VERSION"), "\" Tilewright"), 1);
    for name in commands {
        let page = folder.read(format!("man/man1/tilewright-{name}.1"));
        assert!(page.contains(&format!("\n  tilewright {name}")), "no example in {page}");
        assert!(page.contains("\\-\\-quiet") && page.contains(footer), "{page}");
        count += 1;
    }
    // Each file is one of these.
    assert_eq!(std::fs::read_dir(folder.path("man/man1")).unwrap().count(), count);
}

//! The page of all machines, and those of the papers in folders beside it.

use super::made::made;
use crate::cli::harness::Folder;
use tilewright_report::browser;

#[test]
fn the_pages_are_those_of_the_papers_and_one_of_all_machines() {
    let all = made("all -o report/ --polygons 20");
    assert_eq!(all.told(), all.files().map(|(name, _)| name).collect::<Vec<_>>());

    // Each is what the command of its paper writes, byte for byte, in another process.
    let page = all.read("index.html");
    for (paper, option) in [
        ("quadtree", "--polygons 20"),
        ("pixel-planes-5", "--vectors 20"),
        ("pixelflow", "--primitives 20000"),
        ("vc1", "--views 2"),
    ] {
        let alone = made(&format!("{paper} -o report/ {option}"));
        let names = |(name, _): (&str, _)| name.strip_prefix(&format!("{paper}/")).map(str::to_owned);
        let within: Vec<String> = all.files().filter_map(names).collect();
        assert_eq!(within, alone.files().map(|(name, _)| name).collect::<Vec<_>>());
        for (name, bytes) in alone.files() {
            let (_, same) = all.files().find(|(it, _)| *it == format!("{paper}/{name}")).unwrap();
            assert!(same == bytes, "{name} of {paper} differs between two runs");
        }
        assert!(page.contains(&format!("<a href=\"{paper}/index.html\">")), "no way to {paper}");
    }
    if let Some(complaints) = browser::complaints(page.as_bytes()) {
        assert_eq!(complaints, [""; 0]);
    }

    // The table is that of compare.
    let table = Folder::new().json("compare star --size 64x48 --json");
    let rows: Vec<_> = all.lines("star-machines.csv").collect();
    assert_eq!(rows.len(), 4);
    for (cells, row) in rows.iter().zip(table["machines"].as_array().unwrap()) {
        assert_eq!((&cells[0], &cells[2]), (&row["machine"].as_str().unwrap().to_owned(), &row["clocks"].to_string()));
        assert_eq!(cells[6], row["drawn"].to_string());
    }
    let checks = all.read("checks.csv");
    assert_eq!(checks.lines().count(), 1 + 4 * 4 + 4, "{checks}");
    assert!(checks.lines().skip(1).all(|line| line.ends_with(",holds")), "{checks}");
}

//! The page of all machines, and those of the papers in folders beside it.

use super::lines;
use crate::harness::Folder;
use tilewright_report::browser;

#[test]
fn the_pages_are_those_of_the_papers_and_one_of_all_machines() {
    let folder = Folder::new();
    let report = folder.json("reproduce all -o report --polygons 2 --json");
    let files: Vec<&str> = report["files"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    assert!(files.iter().all(|name| folder.path(name).is_file()), "{files:?}");

    // Each as the command of its paper writes it.
    for (paper, option) in
        [("quadtree", "--polygons 2"), ("pixel-planes-5", "--vectors 2"), ("pixelflow", "--primitives 2000")]
    {
        folder.stdout(&format!("reproduce {paper} -o alone-{paper} {option}"));
        let name = |folder: &str| format!("{folder}/index.html");
        assert_eq!(folder.read(name(&format!("report/{paper}"))), folder.read(name(&format!("alone-{paper}"))));
    }
    let page = folder.read("report/index.html");
    for paper in ["quadtree", "pixel-planes-5", "pixelflow"] {
        assert!(page.contains(&format!("<a href=\"{paper}/index.html\">")), "no way to {paper}");
    }
    if let Some(complaints) = browser::complaints(page.as_bytes()) {
        assert_eq!(complaints, [""; 0]);
    }

    // The table is that of compare.
    let table = folder.json("compare star --size 64x48 --json");
    let rows: Vec<_> = lines(&folder, "report/star-machines.csv").collect();
    assert_eq!(rows.len(), 4);
    for (cells, row) in rows.iter().zip(table["machines"].as_array().unwrap()) {
        assert_eq!((&cells[0], &cells[2]), (&row["machine"].as_str().unwrap().to_owned(), &row["clocks"].to_string()));
        assert_eq!(cells[6], row["drawn"].to_string());
    }
    let checks = folder.read("report/checks.csv");
    assert_eq!(checks.lines().count(), 1 + 4 * 4 + 4, "{checks}");
    assert!(checks.lines().skip(1).all(|line| line.ends_with(",holds")), "{checks}");
}

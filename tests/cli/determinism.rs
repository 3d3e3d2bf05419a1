//! The same command gives the same bytes, wherever it runs. Of the pages of `reproduce` that is seen where all of them are made.

use crate::cli::harness::Folder;

const LINES: [&str; 11] = [
    "render pyramid.obj --size 32x24 --processors 2 -o frame.png --vcd run.vcd --json",
    "render pyramid.obj --machine quadtree --size 16x12 --matrix 2x2 --form stack -o quadtree.png --vcd quadtree.vcd --json",
    "golden ter1k --size 64x48 -o golden.png",
    "golden textured --size 64x48 --deferred --samples 8 -o textured.png",
    "wave gfb-unit -o gfb.vcd --ascii",
    "why gfb-unit --signal pixel_rgb --json",
    "why pyramid.obj --machine quadtree --size 16x12 --matrix 2x2 --pixel 8,6 -o pixel.vcd --json",
    "verilog gfb-unit -o . --testbench",
    "diagram gfb-unit --depth 2 -o gfb.svg --ascii",
    "list --json",
    "manual -o .",
];

#[test]
fn two_runs_give_the_same_bytes_and_no_file_names_its_place() {
    let folders = [Folder::with_pyramid(), Folder::with_pyramid()];
    for line in LINES {
        let [one, two] = [0, 1].map(|i| folders[i].run(line));
        assert_eq!((one.code, &one.stdout, &one.stderr), (Some(0), &two.stdout, &two.stderr), "{line}");
    }
    let names = folders[0].names();
    assert_eq!(names, folders[1].names());
    assert_eq!(names.len(), 38, "{names:?}");
    let workspace = env!("CARGO_MANIFEST_DIR");
    for name in &names {
        let [one, two] = [0, 1].map(|i| std::fs::read(folders[i].path(name)).unwrap());
        assert!(one == two, "{name} differs between two runs");
        let text = String::from_utf8_lossy(&one);
        assert!(!text.contains(workspace), "{name} names the folder of the sources");
        assert!(!text.contains(folders[0].path("").to_str().unwrap()), "{name} names its own folder");
    }
}

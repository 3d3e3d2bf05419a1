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
    let [files, others] = [0, 1].map(|i| folders[i].files("."));
    assert!(files.keys().eq(others.keys()), "{:?}", others.keys());
    assert_eq!(files.len(), 39, "{:?}", files.keys());
    let workspace = env!("CARGO_MANIFEST_DIR");
    for (name, bytes) in &files {
        assert!(*bytes == others[name], "{name} differs between two runs");
        let text = String::from_utf8_lossy(bytes);
        assert!(!text.contains(workspace), "{name} names the folder of the sources");
        assert!(!text.contains(folders[0].path("").to_str().unwrap()), "{name} names its own folder");
    }
}

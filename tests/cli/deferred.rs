//! Golden images of deferred shading, and of eight samples.

use crate::cli::harness::Folder;
use serde_json::json;
use tilewright_scenes::Frame;

#[test]
fn a_golden_image_may_be_shaded_pixel_by_pixel() {
    let folder = Folder::new();
    let report = folder.json("golden textured --size 64x48 --deferred -o d.png --json");
    assert_eq!(
        [&report["deferred"], &report["samples"], &report["shaded_once"]],
        [&json!(true), &json!(1), &json!(false)]
    );
    let text = folder.stdout("golden textured --size 64x48 --deferred -o again.png");
    let (packets, checksum) = (&report["packets"], report["checksum"].as_str().unwrap());
    assert_eq!(
        text,
        format!("textured: 6018 polygons, {packets} packets, 64x48 pixels, deferred shading, checksum {checksum}\n")
    );
    assert_eq!(Frame::read_png(folder.path("d.png")).unwrap(), Frame::read_png(folder.path("again.png")).unwrap());
    // Corners are lit without textures.
    let plain = folder.json("golden textured --size 64x48 -o plain.png --json");
    assert!(plain.get("deferred").is_none() && plain.get("samples").is_none(), "{plain}");
    assert_ne!(plain["checksum"], report["checksum"]);
}

#[test]
fn textures_that_are_not_drawn_are_told_of() {
    let folder = Folder::new();
    let said = |arguments: &str| folder.run(arguments).stderr.contains("the textures of textured are left out: ");
    for left_out in [
        "golden textured --size 64x48 -o x.png",
        "golden textured --size 64x48 --samples 8 -o x.png",
        "render textured --machine quadtree --size 24x16",
        "render textured --machine pixelflow --system non-texturing --size 24x16 --array 8x8",
    ] {
        assert!(said(left_out), "{left_out}");
    }
    for drawn in [
        "golden textured --size 64x48 --deferred -o x.png",
        "render textured --machine pixelflow --size 24x16 --array 8x8",
        "golden teapot --size 64x48 -o x.png",
    ] {
        assert!(!said(drawn), "{drawn}");
    }
}

#[test]
fn a_pixel_may_have_eight_samples() {
    let folder = Folder::with_pyramid();
    let said =
        |options: &str| folder.stdout(&format!("golden pyramid.obj --size 32x24 --samples 8 {options} -o x.png"));
    let styles = [
        ("", " of 8 samples, checksum"),
        ("--deferred", " of 8 samples, deferred shading, checksum"),
        ("--deferred --shade-once", " of 8 samples, deferred shading once per pixel, checksum"),
    ];
    let mut checksums: Vec<String> = Vec::new();
    for (options, style) in styles {
        let text = said(options);
        assert!(text.starts_with(&format!("pyramid: 4 polygons, 4 packets, 32x24 pixels{style} ")), "{text}");
        checksums.extend(text.split_whitespace().last().map(str::to_owned));
        let frame = Frame::read_png(folder.path("x.png")).unwrap();
        assert_eq!(frame.size().to_string(), "32x24");
    }
    checksums.sort();
    checksums.dedup();
    assert_eq!(checksums.len(), 3);
}

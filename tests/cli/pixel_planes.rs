//! `render --machine pixel-planes-5`, and what `list` says of it.

use crate::harness::Folder;
use serde_json::json;

const SMALL: &str = "render pyramid.obj --machine pixel-planes-5 --size 32x24 --renderers 2 --region 16";

#[test]
fn the_report_counts_primitives_regions_and_clocks() {
    let folder = Folder::with_pyramid();
    let report = folder.json(&format!("{SMALL} -o frame.png --json"));
    assert_eq!((&report["format"], &report["machine"]), (&json!(1), &json!("pixel-planes-5")));
    assert_eq!(report["golden"], json!({"identical": true, "differing": 0, "first": null}));
    let report = &report["report"];
    let expected = json!({
        "width": 32, "height": 24, "renderers": 2, "side": 16, "queue": 64, "strict": false, "side_by_side": true,
        "edges": "least",
    });
    assert_eq!(report["machine"], expected);
    let regions = report["regions"].as_array().unwrap();
    assert_eq!((regions.len(), report["renderers"].as_array().unwrap().len()), (4, 2));
    let sum = |of: &str| regions.iter().map(|region| region[of].as_u64().unwrap()).sum::<u64>();
    let primitives = report["primitives"].as_u64().unwrap();
    assert!(sum("primitives") >= primitives && sum("drawn") >= primitives, "{report}");
    let busy: u64 = report["renderers"].as_array().unwrap().iter().map(|it| it["busy"].as_u64().unwrap()).sum();
    assert_eq!(busy, sum("clocks"));

    let programs = report["programs"].as_array().unwrap();
    assert_eq!(programs.iter().map(|it| it["primitives"].as_u64().unwrap()).sum::<u64>(), sum("drawn"));
    let [program] = &programs[..] else { panic!("all faces are shaded: {report}") };
    let [clocks, most] = ["clocks", "most"].map(|of| program[of].as_u64().unwrap());
    assert_eq!(program["program"], "smooth_least");
    assert!(most <= clocks && clocks <= most * sum("drawn") && clocks <= busy, "{program}");

    let text = folder.stdout(SMALL);
    let mean = clocks as f64 / sum("drawn") as f64;
    for part in [
        &format!("smooth_least  {:>8} {mean:>7.1} {most:>7}\n", sum("drawn")),
        "pyramid: pixel-planes-5, 2 renderers of 16x16 pixels: 32x24 pixels,\n",
        &format!("{primitives} primitives, {} in the bins of 4 regions\n", sum("primitives")),
        &format!("All is drawn after {} clocks, ", report["drawn"]),
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(text.ends_with("\nidentical to the golden image\n"), "{text}");
}

#[test]
fn what_is_side_by_side_is_faster_and_draws_the_same() {
    let folder = Folder::with_pyramid();
    let clocks = |line: &str| {
        let report = folder.json(&format!("{line} --json"));
        assert_eq!(report["golden"]["identical"], true, "{report}");
        report["report"]["drawn"].as_u64().unwrap()
    };
    let (both, one) = (clocks(SMALL), clocks(&format!("{SMALL} --one-at-a-time")));
    assert!(both < one, "{both}, {one}");
    clocks(&format!("{SMALL} --strict"));
    let forms = ["least", "own", "fixed"].map(|form| clocks(&format!("{SMALL} --edges {form}")));
    assert!(forms[0] == both && forms.is_sorted() && forms[0] < forms[2], "{forms:?}");
}

#[test]
fn a_form_of_edges_that_there_is_not_is_bad_usage() {
    let run = Folder::with_pyramid().run(&format!("{SMALL} --edges short"));
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("invalid value 'short' for '--edges <FORM>'"), "{}", run.stderr);
    assert!(run.stderr.contains("fixed, own, least"), "{}", run.stderr);
}

#[test]
fn there_is_no_waveform_of_a_frame() {
    let folder = Folder::with_pyramid();
    let run = folder.run(&format!("{SMALL} --vcd run.vcd"));
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("leave out --vcd, and see `tilewright wave renderer`"), "{}", run.stderr);
    assert!(!folder.names().contains(&"run.vcd".to_owned()), "nothing is left");
}

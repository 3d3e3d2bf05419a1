//! `render --machine pixel-planes-5`, and what `list` says of it.

use crate::cli::harness::Folder;
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
        "width": 32, "height": 24, "renderers": 2, "side": 16, "queue": 64, "ring": 5000,
        "strict": false, "side_by_side": true, "edges": "least", "quadratic": false, "geometry": 32,
        "costs": {"transform": 631, "set_up": 500, "bin": 30, "instruction": 12},
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
fn the_slower_of_geometry_and_renderers_gives_the_rate_of_frames() {
    let folder = Folder::with_pyramid();
    for (processors, limit) in [(1, "geometry"), (200, "frame buffer")] {
        let line = format!("{SMALL} --geometry {processors}");
        let report = folder.json(&format!("{line} --json"))["report"].clone();
        assert_eq!(report["machine"]["geometry"], processors);
        let [clocks, sent] = [&report["geometry"]["clocks"], &report["sent"]].map(|it| it.as_u64().unwrap());
        assert_eq!(clocks > sent, limit == "geometry", "{report}");
        let text = folder.stdout(&line);
        let ms = |clocks: u64| clocks as f64 * 25e-6;
        let rate = format!("a frame is sent every {:.3} ms, {:.3} ms after", ms(clocks.max(sent)), ms(clocks + sent));
        let busy = format!("The {limit} limits the rate of frames: busy clocks are geometry {clocks}, ");
        assert!(text.contains(&rate) && text.contains(&busy), "{rate}; {busy}: {text}");
    }
    for count in ["0", "257"] {
        assert_eq!(folder.run(&format!("{SMALL} --geometry {count}")).code, Some(2));
    }
}

#[test]
fn a_form_of_edges_that_there_is_not_is_bad_usage() {
    let run = Folder::with_pyramid().run(&format!("{SMALL} --edges short"));
    assert_eq!(run.code, Some(2));
    assert_eq!(run.stderr, "error: there is no form of edges `short`: give one of fixed, own, least\n");
}

#[test]
fn a_slow_ring_is_told_by_who_waited_for_it() {
    let folder = Folder::with_pyramid();
    let report = |ring: u32| {
        let report = folder.json(&format!("{SMALL} --ring {ring} --json"));
        assert_eq!(report["golden"]["identical"], true, "{report}");
        report["report"].clone()
    };
    let (slow, ample) = (report(400), report(320_000));
    assert_eq!((&slow["machine"]["ring"], &ample["first_starved"]), (&json!(400), &json!(null)));
    assert!(slow["first_starved"]["clock"].as_u64().unwrap() > 0, "{slow}");
    assert!(
        slow["drawn"].as_u64() > ample["drawn"].as_u64()
            && slow["ring"]["load"].as_f64() > ample["ring"]["load"].as_f64()
    );
    assert_eq!(slow["ring"]["bits"], ample["ring"]["bits"]);
    let text = folder.stdout(&format!("{SMALL} --ring 400"));
    let first = &slow["first_starved"];
    let sentence = format!(
        "Renderer {} was the first to wait for an instruction, in clock {}.\n",
        first["renderer"], first["clock"]
    );
    assert!(text.contains(", a ring of 400 Mbit/s, ") && text.contains(&sentence), "{text}");
}

#[test]
fn a_ring_that_no_machine_has_is_refused() {
    let folder = Folder::with_pyramid();
    let refused = |ring: &str| {
        let run = folder.run(&format!("{SMALL} --ring {ring}"));
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        run.stderr
    };
    let sentence = "a ring of 5001 Mbit/s: it carries a whole number of bits in each clock of 25 ns, \
                    so it has to be a multiple of 40 from 40 to 327680";
    assert!(refused("5001").contains(sentence), "{}", refused("5001"));
    refused("0");
    refused("327720");
    refused("fast");
}

#[test]
fn there_is_no_waveform_of_a_frame() {
    let folder = Folder::with_pyramid();
    let run = folder.run(&format!("{SMALL} --vcd run.vcd"));
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("leave out --vcd, or use `tilewright wave pixel-planes-5` for a small machine"),
        "{}",
        run.stderr
    );
    assert!(!folder.names().contains(&"run.vcd".to_owned()), "nothing is left");
}

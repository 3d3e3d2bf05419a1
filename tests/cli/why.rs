//! `why`.

use crate::cli::harness::Folder;
use serde_json::Value;

/// All causes of a report, as `when NAME` or `from NAME`, each before its own.
fn names(cause: &Value) -> Vec<String> {
    let name = format!("{} {}", cause["role"].as_str().unwrap(), cause["label"].as_str().unwrap());
    let causes = cause["causes"].as_array().unwrap().iter().flat_map(names);
    std::iter::once(name).chain(causes).collect()
}

/// The scan counter's column counts up to the end of a line.
#[test]
fn a_register_leads_back_to_its_last_writes() {
    let folder = Folder::new();
    let report = folder.json("why scan-counter --signal pixel_x --at 7 --depth 2 --json");
    let cause = &report["cause"];
    assert_eq!(
        (&report["format"], &report["block"], &report["complete"]),
        (&1.into(), &"scan-counter".into(), &false.into())
    );
    assert_eq!(
        (&cause["name"], &cause["picoseconds"]),
        (&"pixel_x".into(), &(cause["cycle"].as_u64().unwrap() * 80_000).into())
    );
    let source = cause["source"].as_str().unwrap();
    assert!(source.starts_with("rtl/src/lfb/scan_counter.rs:"), "{source}");
    // The line ends at column 15, and the next one begins.
    let expected = ["from pixel_x", "when scan_restart", "when line_end", "from scan_enable", "from x"];
    assert_eq!(names(cause), expected);

    let text = folder.stdout("why scan-counter --signal pixel_x --at 7 --depth 2");
    let [first, second, .., last] = text.lines().collect::<Vec<_>>()[..] else { panic!("{text}") };
    assert!(first.starts_with("pixel_x = ") && second.starts_with("  when scan_restart = 0"), "{text}");
    assert_eq!(last, "causes are left out: a greater --depth or --most tells more");
    assert_eq!(text.lines().count(), expected.len() + 1);
}

#[test]
fn inputs_end_the_search_and_a_tree_is_whole() {
    let folder = Folder::new();
    let report = folder.json("why decoder --signal one_hot --at 2 --json");
    assert_eq!(report["complete"], true);
    assert_eq!(names(&report["cause"]), ["from one_hot", "from index"]);
    assert_eq!(report["cause"]["causes"][0]["end"], "input");
    // A block of several clocks: the cycles are those of the clock that is named.
    let of = |clock: &str| {
        folder.json(&format!("why patch-table --signal page --at 3 --clock {clock} --json"))["cause"]["picoseconds"]
            .clone()
    };
    assert_ne!(of("pe"), of("merge"));
}

#[test]
fn what_there_is_not_is_said_with_a_remedy() {
    let folder = Folder::new();
    for (arguments, sentence) in [
        ("fifo --signal usde", "error: there is no signal `usde`: did you mean `used`?\n"),
        ("scan-counter --signal pixel_x --at 100000", "of `clk`: give --at a number up to "),
        ("patch-table --signal page --clock pee --at 3", "error: there is no clock `pee`: "),
        ("decoder --signal one_hot --depth 2000", "give a whole number from 0 to 1000"),
    ] {
        let run = folder.run(&format!("why {arguments}"));
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{arguments}: {run:?}");
        assert!(run.stderr.contains(sentence), "{arguments}: {run:?}");
    }
}

/// The values of a step of a way, by name.
fn value<'a>(way: &'a Value, does: &str, what: &str) -> Vec<&'a str> {
    let steps = way["steps"].as_array().unwrap().iter().filter(|it| it["does"].as_str().unwrap().starts_with(does));
    let values = steps.flat_map(|it| it["values"].as_array().unwrap()).filter(|it| it["what"] == what);
    values.map(|it| it["hardware"].as_str().unwrap()).collect()
}

#[test]
fn a_pixel_is_followed_from_its_primitives_to_the_display() {
    let folder = Folder::with_pyramid();
    let way = folder.json("why pyramid.obj --size 32x24 --processors 2 --refresh 5000 --pixel 16,12 --json");
    assert_eq!(
        (&way["format"], &way["machine"], &way["pixel"]),
        (&1.into(), &"vc1".into(), &serde_json::json!([16, 12]))
    );
    assert_eq!((&way["identical"], &way["first_difference"]), (&true.into(), &Value::Null));
    let visible: Vec<&Value> =
        way["primitives"].as_array().unwrap().iter().filter(|it| it["visible"] == true).collect();
    assert_eq!(visible.len(), 1, "{way}");
    let word = way["golden"].as_str().unwrap();
    assert_eq!((&visible[0]["hardware"], &way["shown"]), (&word.into(), &word.into()));
    assert!(value(&way, "draws the pixel", "word").contains(&word), "{way}");
    assert!(value(&way, "draws at address", "word that stays").contains(&word), "{way}");
    assert!(value(&way, "compares two pixels", "nearer").contains(&word), "{way}");
    assert_eq!(value(&way, "stores the pixel", "new word").last(), Some(&word));
    assert_eq!(value(&way, "shows the pixel", "colour"), [&word[6..]]);
    assert!(way["steps"].as_array().unwrap().is_sorted_by_key(|it| it["picoseconds"].as_u64()));

    let text =
        folder.stdout("why pyramid.obj --size 32x24 --machine quadtree --matrix 2x2 --form pipe:1+stack --pixel 16,12");
    let [first, second, shown, golden, ..] = text.lines().collect::<Vec<_>>()[..] else { panic!("{text}") };
    assert_eq!(first, "pixel 16,12 of pyramid on quadtree, 32x24 pixels: as in the golden image");
    assert_eq!(second, "no step differs from its model");
    let colour = |line: &str| line.split_once("colour ").map(|(_, it)| it.to_owned());
    assert_eq!((colour(shown).is_some(), colour(shown)), (true, colour(golden)));
    for unit in
        ["set-up makes", "coverage test of level 1 tests", "coverage test of levels 2 to ", "pixel processor makes"]
    {
        assert!(text.contains(unit), "{unit}: {text}");
    }
}

#[test]
fn the_wave_has_40_clocks_around_the_last_step_of_the_visible_primitive() {
    let folder = Folder::with_pyramid();
    let run =
        folder.run("why pyramid.obj --size 16x12 --machine quadtree --matrix 2x2 --pixel 8,6 -o pixel.vcd --json");
    assert_eq!(run.code, Some(0), "{run:?}");
    let way: Value = serde_json::from_str(&run.stdout).unwrap();
    let winner = &way["primitives"].as_array().unwrap().iter().find(|it| it["visible"] == true).unwrap()["number"];
    let step = way["steps"].as_array().unwrap().iter().rfind(|it| it["primitive"] == *winner).unwrap();
    let [time, cycle] = ["picoseconds", "cycle"].map(|it| step[it].as_u64().unwrap());
    let around = 20 * (time / cycle);
    let wave = std::fs::read_to_string(folder.path("pixel.vcd")).unwrap();
    let times: Vec<u64> = wave.lines().filter_map(|line| line.strip_prefix('#')?.parse().ok()).collect();
    assert!(times.contains(&time), "{time}: {times:?}");
    assert!(times.iter().all(|it| (time - around..=time + around).contains(it)), "{time} {around}: {times:?}");
    let unit = step["net"].as_str().unwrap().rsplit('.').nth(1).unwrap();
    assert!(wave.contains(unit), "{unit}");
    assert_eq!(way["commands"], serde_json::json!(["gtkwave pixel.vcd pixel.gtkw", "surfer -c pixel.sucl pixel.vcd"]));
    let save = std::fs::read_to_string(folder.path("pixel.gtkw")).unwrap();
    assert!(save.contains(&format!("[timestart] {}", time - around)), "{save}");
}

/// The times at which a net of a waveform changes.
fn changes(wave: &str, net: &str) -> Vec<u64> {
    let line = wave.lines().find(|line| line.starts_with("$var") && line.contains(&format!(" {net} ")));
    let id = line.unwrap_or_else(|| panic!("no {net}")).split(' ').nth(3).unwrap();
    let (mut time, mut times) = (0, Vec::new());
    for line in wave.lines() {
        match line.strip_prefix('#') {
            Some(now) => time = now.parse().unwrap(),
            None if line.strip_suffix(id).is_some_and(|value| value.starts_with('b') && value.ends_with(' ')) => {
                times.push(time);
            }
            None => {}
        }
    }
    times
}

/// The wave is that of the unit by itself, around the step in the unit's own time.
#[test]
fn a_unit_that_is_simulated_by_itself_has_a_wave_around_the_step() {
    let folder = Folder::with_pyramid();
    for machine in ["pixel-planes-5", "pixelflow"] {
        let line = format!("why pyramid.obj --size 32x24 --machine {machine} --pixel 16,12 -o {machine}.vcd");
        let way = folder.json(&format!("{line} --json"));
        let winner = &way["primitives"].as_array().unwrap().iter().find(|it| it["visible"] == true).unwrap()["number"];
        let steps = way["steps"].as_array().unwrap();
        let step = steps.iter().rfind(|it| it["primitive"] == *winner && !it["simulation"].is_null()).unwrap();
        let time = step["simulation"]["picoseconds"].as_u64().unwrap();
        let around = 20 * (step["picoseconds"].as_u64().unwrap() / step["cycle"].as_u64().unwrap());
        let wave = folder.read(format!("{machine}.vcd"));
        let times: Vec<u64> = wave.lines().filter_map(|line| line.strip_prefix('#')?.parse().ok()).collect();
        assert!(times.len() > 20 && times.contains(&time), "{machine}: {time} {times:?}");
        assert!(times.iter().all(|it| (time - around..=time + around).contains(it)), "{machine}: {time} {times:?}");
        assert!(folder.read(format!("{machine}.gtkw")).contains(&format!("[timestart] {}", time - around)));
        let text = folder.run(&line).stderr;
        let unit = step["simulation"]["unit"].as_str().unwrap();
        assert!(
            text.contains(&format!("the waveform is of {unit} by itself, and has the step at {time} ps")),
            "{text}"
        );
        // The pixel wrote the word's last part at the edge before.
        let period = around / 20;
        assert!(changes(&wave, "control_mask").contains(&(time - period)), "{machine}: {step}");
    }
}

/// The last step of each machine is the word that the golden image has, and no step before it differs.
#[test]
fn machines_whose_units_are_simulated_separately_tell_the_way_too() {
    let folder = Folder::with_pyramid();
    for machine in ["pixel-planes-5", "pixelflow"] {
        let way = folder.json(&format!("why pyramid.obj --size 32x24 --machine {machine} --pixel 16,12 --json"));
        let steps = way["steps"].as_array().unwrap();
        let (end, differs) = (steps.last().unwrap(), |step: &Value| step["differs"] == true);
        assert!(way["primitives"].as_array().unwrap().iter().any(|it| it["visible"] == true), "{machine}: {way}");
        assert!(steps.len() > 10 && !steps.iter().any(differs), "{machine}: {way}");
        assert_eq!((&end["unit"], &end["does"]), (&"picture".into(), &"has the pixel".into()), "{machine}");
    }
}

/// Each of several pixels has the answer that it has alone.
#[test]
fn several_pixels_are_told_one_after_another() {
    let folder = Folder::with_pyramid();
    let line = "why pyramid.obj --size 32x24 --machine quadtree --matrix 2x2";
    let pixels = ["16,12", "0,0"];
    let alone = pixels.map(|pixel| folder.json(&format!("{line} --pixel {pixel} --json")));
    assert_ne!(alone[0]["steps"], alone[1]["steps"]);
    let both = folder.json(&format!("{line} --pixel 16,12 --pixel 0,0 --json"));
    assert_eq!((&both["format"], &both["pixels"]), (&1.into(), &Value::from(alone.to_vec())));
    let texts = pixels.map(|pixel| folder.stdout(&format!("{line} --pixel {pixel}")));
    assert_eq!(folder.stdout(&format!("{line} --pixel 16,12 --pixel 0,0")), texts.join("\n"));
}

#[test]
fn a_question_about_a_pixel_that_has_no_answer_is_refused_in_a_sentence() {
    let folder = Folder::with_pyramid();
    for (arguments, sentence) in [
        (
            "pyramid.obj --size 32x24 --pixel 32,5",
            "pixel 32,5 is outside of a picture of 32x24: give one from 0,0 to 31,23",
        ),
        ("pyramid.obj --pixel 5", "give two whole numbers of pixels, from the left and from the top, such as 396,189"),
        ("pyramid.obj --size 32x24 --pixel 5,5 --accumulate 2", "a pixel is followed in one: leave it out"),
        ("pyramid.obj --size 32x24 --pixel 5,5 --pixel 32,5", "pixel 32,5 is outside of a picture of 32x24"),
        (
            "pyramid.obj --size 32x24 --pixel 5,5 --pixel 6,5 -o pixel.vcd",
            "-o writes the waveform around a step of one pixel, and there are several",
        ),
        ("pyramid.obj --size 32x24 --pixel 5,5 --matrix 2x2", "--matrix is an option of quadtree"),
        ("fifo", "give --signal NET for a block, or --pixel X,Y for a scene"),
        ("fifo --signal used --matrix 2x2", "--matrix is an option for a scene, and --signal asks about a block"),
        ("fifo --signal used --pixel 1,1", "cannot be used with"),
        ("pyramid.obj --size 32x24 --pixel 1,1 --at 3", "cannot be used with"),
    ] {
        let run = folder.run(&format!("why {arguments}"));
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{arguments}: {run:?}");
        assert!(run.stderr.contains(sentence), "{arguments}: {run:?}");
    }
}

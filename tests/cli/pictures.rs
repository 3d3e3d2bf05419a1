//! Pictures of a run: the unit that drew each pixel, the activity of each unit over time, and the frame as it is drawn.

use crate::cli::harness::Folder;
use std::collections::BTreeSet;
use tilewright_scenes::Frame;

/// Each machine, small, with the names of some of its units.
const MACHINES: [(&str, &[&str]); 4] = [
    ("vc1 --processors 3 --cluster 1 --refresh 5000", &["PE 0", "PE 2", "merger"]),
    ("quadtree --matrix 2x2", &["broadcast", "set-up", "controller"]),
    ("pixel-planes-5 --renderers 2 --region 16", &["renderer 0", "renderer 1", "ring", "frame buffer"]),
    ("pixelflow --nodes 4 --shaders 1 --array 32x16", &["front end", "rasterizer 2", "shader 1", "network, back"]),
];

/// Where nothing was drawn.
const NOBODY: [u8; 3] = [38, 40, 44];

fn picture(folder: &Folder, name: &str) -> Frame {
    Frame::read_png(folder.path(name)).unwrap()
}

fn colours(frame: &Frame) -> Vec<[u8; 3]> {
    frame.rgb_bytes().chunks(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect()
}

#[test]
fn each_machine_shows_who_drew_what_and_when() {
    let folder = Folder::with_pyramid();
    for (machine, units) in MACHINES {
        let line = format!("render pyramid.obj --size 48x36 --machine {machine} -o frame.png");
        folder.stdout(&format!("{line} --owners owners.png --timeline time.svg --animate drawn.png"));
        let [frame, owners] = ["frame.png", "owners.png"].map(|name| picture(&folder, name));
        let background = frame.rgb(0, 0);
        for (shown, owned) in colours(&frame).into_iter().zip(colours(&owners)) {
            assert_eq!(shown == background, owned == NOBODY, "{machine}: {shown:?} {owned:?}");
        }
        assert!(colours(&owners).into_iter().collect::<BTreeSet<_>>().len() > 2, "{machine}");
        // A viewer without animations shows the last image.
        assert_eq!(picture(&folder, "drawn.png"), owners, "{machine}");
        let chart = folder.read("time.svg");
        assert!(chart.contains(">time, ms</text>") && chart.contains("pyramid on "), "{machine}");
        // Units that draw have their colours, but for the video processors, whose stages are shown.
        assert_eq!(chart.contains("width=\"10\" height=\"10\""), !machine.starts_with("quadtree"), "{machine}");
        for unit in units {
            assert!(chart.contains(&format!(">{unit}</text>")), "{machine}: {unit}");
        }
    }
}

#[test]
fn pictures_are_the_same_each_time_and_change_nothing_else() {
    let folder = Folder::with_pyramid();
    let line = "render pyramid.obj --size 48x36 --machine quadtree --matrix 2x2";
    let plain = folder.stdout(&format!("{line} -o frame.png"));
    let files =
        |number: u32| [format!("owners{number}.png"), format!("time{number}.svg"), format!("drawn{number}.png")];
    for number in 1..=2 {
        let [owners, time, drawn] = files(number);
        assert_eq!(folder.stdout(&format!("{line} --owners {owners} --timeline {time} --animate {drawn}")), plain);
    }
    for (one, other) in files(1).iter().zip(&files(2)) {
        assert_eq!(std::fs::read(folder.path(one)).unwrap(), std::fs::read(folder.path(other)).unwrap(), "{one}");
    }
    // Without --owners an animation has the colours of the frame.
    folder.stdout(&format!("{line} --animate frames.png"));
    assert_eq!(picture(&folder, "frames.png"), picture(&folder, "frame.png"));
    let run = folder.run(&format!("{line} --timeline -"));
    assert_eq!((run.code, run.stdout), (Some(0), folder.read("time1.svg")));
}

#[test]
fn machines_are_side_by_side() {
    let folder = Folder::with_pyramid();
    let line = "compare pyramid.obj --size 48x36 --machine quadtree --machine pixel-planes-5";
    folder.stdout(&format!("{line} --owners all.png --animate drawn.png"));
    let all = picture(&folder, "all.png");
    assert_eq!([all.size().width(), all.size().height()], [2 * 48 + 3 * 8, 36 + 12 + 2 * 8]);
    assert_eq!(picture(&folder, "drawn.png"), all);
    folder.stdout("render pyramid.obj --size 48x36 --machine quadtree --owners one.png");
    let one = picture(&folder, "one.png");
    for (x, y) in (0..36).flat_map(|y| (0..48).map(move |x| (x, y))) {
        assert_eq!(all.rgb(8 + x, 20 + y), one.rgb(x, y), "({x}, {y})");
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_before_the_run() {
    let folder = Folder::with_pyramid();
    let refused = [
        ("render pyramid.obj --animate frame.gif", "frame.gif: animations are written as animated PNG"),
        ("compare pyramid.obj --animate frame.gif", "name the file .png"),
        (
            "render pyramid.obj --frames 3 -o turn.png --owners owners.png",
            "--owners shows one frame, and --frames makes several",
        ),
        ("render pyramid.obj --accumulate 2 --timeline time.svg", "--timeline shows one frame, and --accumulate"),
        (
            "render pyramid.obj --machine pixelflow --stereo halved --animate a.png",
            "--animate shows one frame, and --stereo",
        ),
        ("render pyramid.obj -o same.png --owners same.png", "would be written over same.png, another output"),
        ("render pyramid.obj -o - --owners -", "standard output: would be written over"),
        ("compare pyramid.obj --size 1280x1024 --owners all.png", "too large for one: pass a smaller --size"),
    ];
    for (line, sentence) in refused {
        let run = folder.run(line);
        assert_eq!(run.code, Some(2), "{line}: {run:?}");
        assert!(run.stderr.contains(sentence), "{line}: {run:?}");
    }
    let run = folder.run("render pyramid.obj --owners no/such/folder.png");
    assert_eq!(run.code, Some(3), "{run:?}");
    assert_eq!(folder.names(), ["pyramid.obj"]);
}

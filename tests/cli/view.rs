//! `view`: the server as a browser meets it, and the page as files. The page itself is played in the tests of its crate.
#![cfg(unix)]

use crate::cli::harness::{Folder, Run};
use crate::cli::interruption::{send, start_command};
use crate::tree::files;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::PathBuf;
use std::process::Child;
use std::time::{Duration, Instant};

/// A running server, and its address. It ends with its test, also if that panics.
struct Served {
    /// Until it was stopped.
    child: Option<Child>,
    /// The host with its port, and the path with the token.
    host: String,
    path: String,
}

impl Served {
    fn start(folder: &Folder, arguments: &str) -> Served {
        let mut child = start_command(&mut folder.command(&format!("view {arguments}")));
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let address = line.trim_end().strip_prefix("http://").unwrap_or_else(|| panic!("{line}"));
        let (host, path) = address.split_at(address.find('/').unwrap());
        Served { host: host.to_owned(), path: path.to_owned(), child: Some(child) }
    }

    /// The status and the text of the answer to a request.
    fn ask(&self, method: &str, path: &str, host: &str) -> (u16, String) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        write!(stream, "{method} {path} HTTP/1.1\r\nHost: {host}\r\n\r\n").unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let (head, body) = text.split_once("\r\n\r\n").unwrap();
        (head.split(' ').nth(1).unwrap().parse().unwrap(), body.to_owned())
    }

    fn get(&self, name: &str) -> (u16, String) {
        self.ask("GET", &format!("{}{name}", self.path), &self.host)
    }

    /// The data of a name, which the server may still be making.
    fn data(&self, name: &str) -> (u16, serde_json::Value) {
        let begin = Instant::now();
        loop {
            let (status, text) = self.get(&format!("data/{name}"));
            if status != 202 {
                return (status, serde_json::from_str(&text).unwrap_or_default());
            }
            assert!(begin.elapsed() < Duration::from_secs(120), "{name}: {text}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    fn stop(mut self, signal: &str) -> Run {
        let child = self.child.take().unwrap();
        send(&child, signal);
        Run::of(child.wait_with_output().unwrap())
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        if let Some(child) = &mut self.child {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

#[test]
fn a_scene_is_served_until_ctrl_c() {
    let served = Served::start(&Folder::with_pyramid(), "pyramid.obj --size 32x24 --machine quadtree");
    assert!(served.host.starts_with("127.0.0.1:") && served.path.len() == 34, "{}{}", served.host, served.path);
    let (status, page) = served.get("");
    assert!(status == 200 && page.contains("<script src=\"frame.js\">"), "{page}");
    let about = served.get("about.js").1;
    assert!(about.contains(r#""first":"quadtree""#) && about.contains(r#""title":"pyramid, 32x24 pixels""#), "{about}");
    for (machine, clock) in [("vc1", 25_000), ("quadtree", 10_000), ("pixel-planes-5", 25_000), ("pixelflow", 5000)] {
        let (status, frame) = served.data(&format!("frame/{machine}?turn=0"));
        assert_eq!((status, &frame["machine"]), (200, &machine.into()));
        assert_eq!(frame["verdict"], "identical to the golden image", "{machine}");
        assert_eq!((&frame["size"], &frame["clock"]["picoseconds"]), (&[32, 24].into(), &clock.into()), "{machine}");
    }
    // The camera turns, and another frame is drawn.
    let [one, other] = [0, 90].map(|turn| served.data(&format!("frame/quadtree?turn={turn}")).1["writes"].clone());
    assert_ne!(one, other);
    for name in ["frame/vc1?turn=181", "frame/vc1", "frame/riva128?turn=0", "golden"] {
        assert_eq!(served.get(&format!("data/{name}")).0, 404, "{name}");
    }
    let path = served.path.clone();
    assert_eq!(served.ask("POST", &path, &served.host).0, 405);
    assert_eq!(served.ask("GET", &path, "tilewright.invalid").0, 403);
    assert_eq!(served.ask("GET", "/", &served.host).0, 404);
    let host = served.host.clone();
    let run = served.stop("INT");
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (Some(0), "", "Ctrl-C ends the server\n"));
    assert!(TcpStream::connect(host).is_err());
}

/// The pairs of numbers of a merging unit come out four clocks later.
#[test]
fn a_block_is_served() {
    let served = Served::start(&Folder::new(), "merging-unit");
    assert!(served.get("").1.contains("<script src=\"block.js\">"));
    let (status, data) = served.data("unit/0");
    assert_eq!((status, &data["times"][1]), (200, &80_000.into()));
    let net = |name: &str| data["nets"].as_array().unwrap().iter().find(|net| net["name"] == name).unwrap();
    assert_eq!(net("left")["changes"][1], serde_json::json!([1, "5"]));
    assert_eq!(net("nearer")["changes"][1], serde_json::json!([5, "5"]));
    let source = net("decided1")["source"].as_str().unwrap();
    assert!(source.starts_with("rtl/src/merger/") && source.contains(".rs:"), "{source}");
    assert!(["diagram", "narrow"].iter().all(|it| data[*it].as_str().unwrap().starts_with("<svg ")));
    let ports =
        data["nets"].as_array().unwrap().iter().filter(|net| net["port"] == true).map(|net| net["name"].clone());
    assert_eq!(ports.collect::<Vec<_>>(), ["left", "right", "enable", "nearer"]);
    assert_eq!((served.data("unit/1").0, served.data("unit/-1").0, served.data("block").0), (404, 404, 404));
    assert_eq!(served.stop("INT").code, Some(0));

    // One with several clocks, of which none is called `clk`.
    let served = Served::start(&Folder::new(), "gfb-unit");
    let times = served.data("unit/0").1["times"].as_array().unwrap().len();
    assert!(times > 100, "{times}");
    assert_eq!(served.stop("INT").code, Some(0));
}

/// A chain of merging units is an array, each lane of which is a unit with values of its own.
#[test]
fn units_inside_of_a_block_are_served() {
    let served = Served::start(&Folder::new(), "image-merger");
    let top = served.data("unit/0").1;
    let links = |of: &serde_json::Value, list: &str| {
        let links = of[list].as_array().unwrap().iter();
        links.map(|it| (it["name"].as_str().unwrap().to_owned(), it["number"].as_u64().unwrap())).collect::<Vec<_>>()
    };
    let units = links(&top, "units");
    assert!(units.len() > 1 && units[0].0 == "u_merging_unit[0]", "{units:?}");
    let [first, second] = [0, 1].map(|number: usize| served.data(&format!("unit/{}", units[number].1)).1);
    assert_eq!((links(&first, "siblings"), links(&second, "outer").len()), (units, 1));
    assert_ne!(first["nets"], second["nets"]);
    assert_eq!(first["diagram"], second["diagram"]);
    // The first unit's result is what the second one compares.
    let changes = |of: &serde_json::Value, name: &str| {
        let nets = of["nets"].as_array().unwrap();
        nets.iter().find(|net| net["name"] == name).unwrap()["changes"].clone()
    };
    assert_eq!(changes(&first, "nearer"), changes(&second, "left"));
    assert_eq!(served.stop("INT").code, Some(0));
}

/// The way is that of `why`, and a step of it has its unit in a wave around the step, in the unit's own time where units are simulated one by one.
#[test]
fn a_pixel_and_its_steps_are_served() {
    let folder = Folder::with_pyramid();
    let served = Served::start(&folder, "pyramid.obj --size 32x24 --machine quadtree --quiet");
    let pixel = "turn=0&x=16&y=12";
    for machine in ["vc1", "quadtree", "pixel-planes-5", "pixelflow"] {
        let (status, way) = served.data(&format!("way/{machine}?{pixel}"));
        let told = folder.json(&format!("why pyramid.obj --size 32x24 --machine {machine} --pixel 16,12 --json"));
        assert_eq!((status, &way["identical"], &way["failed"]), (200, &true.into(), &serde_json::Value::Null));
        assert_eq!((&way["steps"], &way["primitives"]), (&told["steps"], &told["primitives"]), "{machine}");
        let steps = way["steps"].as_array().unwrap();
        let number = steps.iter().rposition(|step| !step["primitive"].is_null() && !step["net"].is_null()).unwrap();
        // A unit of an array without a number, and a lane of a net.
        for block in ["compositor", "linear-evaluator"].iter().filter(|_| machine == "pixelflow") {
            let number = steps.iter().position(|step| step["block"] == *block).unwrap();
            let moment = served.data(&format!("moment/{machine}?{pixel}&step={number}&unit=0")).1;
            let nets = moment["unit"]["nets"].as_array().unwrap();
            assert!(nets.iter().any(|net| net["asked"] == true), "{block}: {}", steps[number]);
        }
        let step = &steps[number];
        let (status, moment) = served.data(&format!("moment/{machine}?{pixel}&step={number}&unit=0"));
        let unit = &moment["unit"];
        let asked: Vec<_> = unit["nets"].as_array().unwrap().iter().filter(|net| net["asked"] == true).collect();
        let (path, name) = step["net"].as_str().unwrap().rsplit_once('.').unwrap();
        assert_eq!((status, asked.len(), &asked[0]["name"]), (200, 1, &name.into()), "{machine}");
        assert!(asked[0]["source"].as_str().unwrap().starts_with("rtl/src/"), "{moment}");
        let (times, place) = (unit["times"].as_array().unwrap(), unit["step"].as_u64().unwrap() as usize);
        let (edge, apart) = (&step["picoseconds"], &step["simulation"]);
        let edge = if apart.is_null() { edge } else { &apart["picoseconds"] };
        // The cursor stands where the unit has what it sees at the edge of the step.
        assert_eq!((&moment["path"], &times[place + 1]), (&path.into(), edge), "{machine}");
        if let Some(simulated) = apart["unit"].as_str() {
            let note = format!(
                "{simulated} is simulated by itself: these clocks are of its own time, which has the step at {edge} ps"
            );
            assert_eq!(moment["note"], note);
            let own = unit["first"].as_u64().unwrap() + place as u64 + 1;
            let period = times[place + 1].as_u64().unwrap() - times[place].as_u64().unwrap();
            assert_eq!(own * period, edge.as_u64().unwrap(), "{machine}");
            assert!(unit["diagram"].as_str().unwrap().starts_with("<svg"), "{machine}");
            // A step that no unit does has none.
            let last = steps.len() - 1;
            let (_, none) = served.data(&format!("moment/{machine}?{pixel}&step={last}&unit=0"));
            assert_eq!(none["note"], "no unit is simulated for this step, so there is no wave of it", "{machine}");
        }
        if machine == "vc1" {
            // The image memory has the old word still.
            let changes = asked[0]["changes"].as_array().unwrap();
            let now = changes.iter().rfind(|change| change[0].as_u64().unwrap() <= place as u64).unwrap();
            assert_eq!((&step["values"][0]["what"], &step["values"][0]["hardware"]), (&"old word".into(), &now[1]));
        }
        assert!((20..200).contains(&times.len()), "{}", times.len());
        let beyond = steps.len();
        assert_eq!(served.data(&format!("moment/{machine}?{pixel}&step={beyond}&unit=0")).0, 422);
    }
    let (status, answer) = served.data("way/quadtree?turn=0&x=32&y=0");
    assert_eq!(
        (status, &answer["sentence"]),
        (422, &"pixel 32,0 is outside of a picture of 32x24: give one from 0,0 to 31,23".into())
    );
    for name in ["way/vc1?turn=0&x=1", "way/vc1?turn=0&x=-1&y=0", "moment/vc1?turn=0&x=1&y=1", "areas/pixelflow?turn=0"]
    {
        assert_eq!(served.get(&format!("data/{name}")).0, 404, "{name}");
    }
    let (status, areas) = served.data("areas/quadtree?turn=0");
    // A processor has 8 x 6 pixels here: windows of 8, 4 and 2 pixels are divided.
    assert!(status == 200 && areas["count"].as_u64().unwrap() > 100 && areas["levels"] == 2, "{}", areas["levels"]);
    assert_eq!(served.stop("INT").code, Some(0));
}

/// A pixel that is asked about replaces the one before, whose page is told.
#[test]
fn another_pixel_replaces_the_one_before() {
    let served = Served::start(&Folder::new(), "teapot --size 320x240 --quiet");
    let ask = |name: &str| served.get(&format!("data/{name}")).0;
    assert_eq!(served.data("frame/vc1?turn=0").0, 200);
    let [one, other] = [100, 101].map(|x| format!("way/vc1?turn=0&x={x}&y=100"));
    assert_eq!((ask(&one), ask(&other)), (202, 202));
    let (status, answer) = served.data(&one);
    assert_eq!((status, &answer["sentence"]), (422, &"something else was asked for meanwhile: ask again".into()));
    // Nobody waits for it any more.
    assert_eq!(ask(&format!("{other}&stop")), 200);
    assert_eq!((ask(&one), served.data(&one).0), (202, 200));
    assert_eq!(served.stop("INT").code, Some(0));
}

#[test]
fn a_machine_that_cannot_draw_says_why() {
    let served = Served::start(&Folder::new(), "molecule --size 16x12 --quiet");
    let (status, answer) = served.data("frame/vc1?turn=0");
    let sentence = answer["sentence"].as_str().unwrap_or_default();
    assert!(status == 422 && sentence.contains("spheres, which only pixel-planes-5 draws"), "{answer}");
    let run = served.stop("TERM");
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
}

/// Also while a frame is being drawn.
#[test]
fn the_server_ends_soon() {
    let served = Served::start(&Folder::new(), "ter250 --size 1024x768");
    let begin = Instant::now();
    assert_eq!(served.stop("INT").code, Some(0));
    assert!(begin.elapsed() < Duration::from_secs(30), "{:?}", begin.elapsed());
}

#[test]
fn the_browser_is_opened_on_request() {
    let folder =
        Folder::with(&[("xdg-open", "#!/bin/sh\necho \"$1\" >opened.part; mv opened.part opened\n"), ("star", "")]);
    let line = format!(
        "chmod +x xdg-open; PATH=$PWD:$PATH exec {} view wireframe --size 8x8 --open",
        crate::cli::harness::PROGRAM
    );
    let mut shell = std::process::Command::new("sh");
    let mut child = start_command(shell.args(["-c", &line]).current_dir(folder.path(".")));
    let mut address = String::new();
    BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut address).unwrap();
    let begin = Instant::now();
    // On other systems another program opens it.
    while cfg!(target_os = "linux") && !folder.path("opened").exists() {
        assert!(begin.elapsed() < Duration::from_secs(30), "nothing was opened");
        std::thread::sleep(Duration::from_millis(10));
    }
    if cfg!(target_os = "linux") {
        assert_eq!(folder.read("opened"), address);
    }
    send(&child, "INT");
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(0));
}

#[test]
fn wrong_use_ends_in_a_sentence() {
    let taken = TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let port = taken.local_addr().unwrap().port();
    let folder = Folder::new();
    let cases = [
        (format!("star --port {port}"), format!("port {port} is in use: leave out --port, or give another one")),
        ("star --port 0".to_owned(), "give a whole number from 1 to 65535".to_owned()),
        ("stat".to_owned(), "there is no scene and no block `stat`: did you mean `star`?".to_owned()),
        ("fifo --machine vc1".to_owned(), "--machine is an option for a scene, and fifo is a block".to_owned()),
        ("star --set depth=8".to_owned(), "--set is an option for a block, and star is a scene".to_owned()),
        ("fifo --set dept=8".to_owned(), "fifo has no parameter `dept`: did you mean `depth`?".to_owned()),
        (
            "star --machine vc1 --machine quadtree".to_owned(),
            "--machine quadtree is a second machine, and the page has all of them".to_owned(),
        ),
        ("star --machine vc1 --machine vc1 --export x".to_owned(), "--machine vc1 is given twice".to_owned()),
        ("star --export -".to_owned(), "standard output takes one file".to_owned()),
        ("star --export x --open".to_owned(), "cannot be used with".to_owned()),
        ("molecule --export x".to_owned(), "vc1: the scene has spheres".to_owned()),
    ];
    for (arguments, sentence) in cases {
        let run = folder.run(&format!("view {arguments}"));
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{arguments}: {run:?}");
        assert!(run.stderr.contains(&sentence), "{arguments}: {run:?}");
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

/// No name means a scene and a block.
#[test]
fn scenes_and_blocks_have_different_names() {
    let list = Folder::new().json("list --json");
    let names = |of: &str| list[of].as_array().unwrap().iter().map(|it| it["name"].clone()).collect::<Vec<_>>();
    let (scenes, blocks) = (names("scenes"), names("blocks"));
    assert!(scenes.len() > 5 && blocks.len() > 50 && scenes.iter().all(|scene| !blocks.contains(scene)));
}

/// All files below a folder.
fn content(folder: &Folder) -> BTreeMap<PathBuf, Vec<u8>> {
    let root = folder.path("page");
    let found = files(&root, &["html", "css", "js"]);
    found.iter().map(|path| (path.strip_prefix(&root).unwrap().to_owned(), std::fs::read(path).unwrap())).collect()
}

#[test]
fn two_exports_have_the_same_bytes() {
    let folders = [Folder::with_pyramid(), Folder::with_pyramid()];
    for folder in &folders {
        let run = folder.run("view pyramid.obj --size 32x24 --machine pixelflow --machine vc1 --export page");
        assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""), "{run:?}");
        assert!(run.stderr.ends_with("open page/index.html in a browser\n"), "{run:?}");
    }
    let [one, other] = folders.each_ref().map(content);
    assert!(one == other);
    let names: Vec<&str> = one.keys().filter_map(|name| name.to_str()).collect();
    assert!(
        ["index.html", "about.js", "data/frame/vc1.js", "data/frame/pixelflow.js", "data/areas/vc1.js"]
            .iter()
            .all(|it| names.contains(it)),
        "{names:?}"
    );
    let place = folders[0].path("").to_str().unwrap().to_owned();
    for (name, bytes) in &one {
        let text = String::from_utf8_lossy(bytes);
        assert!(!text.contains(&place) && !text.contains(env!("CARGO_MANIFEST_DIR")), "{name:?}");
    }
}

//! A small frame on two machines.

use serde_json::{Value, json};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use tilewright_view::{Answer, Area, Areas, Clock, Grid, Kind, Lane, Page, Part, Picture, Server, Site, Unit, Write};

/// Columns and rows of the frame.
pub const SIZE: [u32; 2] = [32, 24];

/// Two units draw columns in turn, each pixel at a clock of its own; the first eight pixels change once more at the end.
pub fn picture(machine: &str, turn: i32) -> Picture {
    let pixels = SIZE[0] * SIZE[1];
    let write = |clock: u32, pixel: u32, depth, blue| Write {
        clock,
        pixel,
        unit: pixel % 2,
        depth,
        colour: [(pixel % SIZE[0] * 8) as u8, ((turn + 180) / 2) as u8, blue],
    };
    let first = (0..pixels).map(|pixel| write(10 + pixel, pixel, 1000 + pixel, 60));
    let second = (0..8).map(|pixel| write(1000 + pixel, pixel, 5, 250));
    let unit = |number, colour| Unit { name: format!("PE {number}"), colour };
    let lane = |number: u64| Lane {
        name: format!("PE {number}"),
        parts: vec![Part(0, 10, vec![(0, 1.0)]), Part(10, 800, vec![(1, 0.5), (2, 0.5)])],
    };
    let kind = |name: &str, waits| Kind { name: name.to_owned(), waits };
    Picture {
        machine: machine.to_owned(),
        title: "columns".to_owned(),
        size: SIZE,
        background: [20, 24, 40],
        clock: Clock { name: "40 MHz".to_owned(), picoseconds: if machine == "one" { 25_000 } else { 10_000 } },
        end: 1200,
        units: vec![unit(0, [200, 70, 40]), unit(1, [40, 120, 200])],
        grids: vec![Grid { name: "regions of 8x8".to_owned(), size: [8, 8] }],
        kinds: vec![kind("clearing", false), kind("drawing", false), kind("stalled", true)],
        lanes: vec![lane(0), lane(1)],
        identical: true,
        verdict: "identical to the golden image".to_owned(),
        writes: first.chain(second).collect(),
    }
}

/// Two patches that have a page until the end, and one until clock 500.
pub fn areas() -> Areas {
    let area = |from, to, unit, place| Area { from, to, unit, level: 0, place, size: [8, 8] };
    let list = vec![area(10, u32::MAX, 0, [0, 0]), area(11, 500, 1, [8, 0]), area(600, u32::MAX, 1, [24, 16])];
    Areas { name: "pages".to_owned(), levels: 0, list }
}

/// The data of a unit: a pair, which has two nets in two boxes and an array of two halves, or one of the halves.
pub fn unit(number: usize) -> Value {
    let square = |x: u32, net: &str| {
        format!(
            r#"<g><title>{net}</title><rect class="box" x="{x}" width="60" height="40" fill="gray" stroke="black"/><text class="name" x="{x}" y="20">{net}</text></g>"#
        )
    };
    let svg =
        |inner: String| format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="330" height="50">{inner}</svg>"#);
    let diagram = match number {
        0 => svg(square(5, "sum") + &square(105, "carry") + &square(205, "u_half")),
        _ => svg(square(5, "word")),
    };
    let link = |number: usize, name: &str| json!({ "number": number, "name": name });
    let halves = json!([link(1, "u_half[0]"), link(2, "u_half[1]")]);
    let mut data = json!({
        "name": "pair", "summary": "Adds.", "source": "src/pair.rs:3", "diagram": diagram, "narrow": diagram, "first": 0, "step": null,
        "times": [0, 10_000, 20_000, 30_000, 40_000],
        "nets": [
            { "name": "sum", "width": 8, "port": true, "asked": false, "source": "src/pair.rs:12", "changes": [[0, "0"], [2, "1f"], [3, "20"]] },
            { "name": "carry", "width": 1, "port": false, "asked": false, "source": null, "changes": [[0, "0"], [3, "1"]] },
            { "name": "late", "width": 1, "port": false, "asked": false, "source": null, "changes": [[0, "0"]] },
        ],
        "units": halves, "outer": [], "siblings": [],
    });
    if number > 0 {
        data["name"] = format!("u_half[{}]", number - 1).into();
        data["times"] = json!([0, 20_000, 40_000]);
        data["nets"] = json!([{ "name": "word", "width": 4, "port": true, "asked": false, "source": "src/half.rs:2", "changes": [[0, "1"], [1, "2"]] }]);
        data["units"] = json!([]);
        data["outer"] = json!([link(0, "pair")]);
        data["siblings"] = halves;
    }
    data
}

/// The way of a pixel, whose second step is the first that differs.
pub fn way(pixel: [u32; 2]) -> Value {
    let step = |unit: &str, does: &str, picoseconds: u64, values: Value, differs: bool| {
        json!({
            "primitive": 4, "unit": unit, "block": "pair", "does": does, "clock": "pe", "cycle": picoseconds / 25_000,
            "picoseconds": picoseconds, "net": "u_pair.sum", "values": values, "differs": differs,
        })
    };
    let value = |what: &str, hardware: &str, model: Option<&str>| json!({ "what": what, "hardware": hardware, "model": model, "differs": model.is_some_and(|it| it != hardware) });
    json!({
        "pixel": pixel, "shown": "000005185afa", "golden": "000005185afa", "identical": true, "failed": null,
        "primitives": [
            { "number": 4, "name": "triangle 4", "golden": "000005185afa", "hardware": "000005185afa", "visible": true },
            { "number": 7, "name": "triangle 7", "golden": "000009000000", "hardware": null, "visible": false },
        ],
        "steps": [
            step("PE 1", "draws the pixel", 325_000, json!([value("word", "000005185afa", Some("000005185afa"))]), false),
            step("merging unit 0", "passes the nearer pixel", 25_075_000, json!([value("left", "5", None), value("nearer", "9", Some("5"))]), true),
            step("frame buffer", "stores the pixel", 25_100_000, json!([value("word", "9", Some("5"))]), true),
        ],
        "first_difference": { "step": 1, "block": "pair", "source": "rtl/src/pair.rs" },
    })
}

/// The frame as a site. The machine `broken` cannot draw it.
///
/// It tells the way of a pixel when it has been asked some times. That of column 30 never comes, and that of column 29 is refused.
#[derive(Default)]
pub struct Columns {
    /// All questions, each as its name and its query.
    pub asked: Arc<Mutex<Vec<String>>>,
}

impl Columns {
    fn way(&self, question: &str, pixel: [u32; 2]) -> Answer {
        let count = self.asked.lock().unwrap().iter().filter(|it| *it == question).count();
        match pixel[0] {
            29 => Answer::Refused("the run was interrupted".to_owned()),
            30 => Answer::Working { what: "drawing".to_owned(), done: Some(0.5) },
            _ if count < 10 => Answer::Working { what: "building".to_owned(), done: None },
            _ => Answer::Whole(way(pixel).to_string().into_bytes()),
        }
    }

    /// The block of a step: the first one has a wave around clock 1003, and the second is told alone.
    fn moment(step: u32, number: usize) -> Answer {
        let mut unit = unit(number);
        let value = match step {
            1 => {
                unit["nets"][0]["asked"] = true.into();
                (unit["first"], unit["step"]) = (1000.into(), 3.into());
                json!({ "note": null, "path": "u_pair", "unit": unit })
            }
            0 => {
                (unit["times"], unit["units"], unit["first"], unit["step"]) =
                    (json!([325_000]), json!([]), 13.into(), 0.into());
                unit["nets"] = json!([{ "name": "sum", "width": 8, "port": true, "asked": true, "source": "src/pair.rs:12", "changes": [[0, "5"]] }]);
                json!({ "note": "no unit is simulated for this step, so there is no wave of it", "unit": unit })
            }
            _ => return Answer::Refused("there is no such unit".to_owned()),
        };
        Answer::Whole(value.to_string().into_bytes())
    }
}

impl Site for Columns {
    fn page(&self) -> Page {
        Page::Frame
    }

    fn about(&self) -> String {
        let machine = |name: &str| {
            let areas = if name == "one" { r#""pages""# } else { "null" };
            format!(r#"{{"name": "{name}", "summary": "Machine {name}", "areas": {areas}}}"#)
        };
        let machines = ["one", "two", "broken"].map(machine).join(", ");
        format!(
            r#"{{"title": "columns, 32x24", "summary": "All", "machines": [{machines}], "first": "one", "orbits": true}}"#
        )
    }

    fn data(&self, name: &str, query: &str) -> Answer {
        let question = format!("{name}?{query}");
        self.asked.lock().unwrap().push(question.clone());
        let number = |name: &str| {
            query.split('&').find_map(|part| part.strip_prefix(name)?.strip_prefix('=')?.parse::<i32>().ok())
        };
        let turn = number("turn").unwrap_or(0);
        let pixel = ["x", "y"].map(|name| number(name).unwrap_or(0) as u32);
        match name.split_once('/') {
            _ if query.ends_with("&stop") => Answer::Whole(b"null".to_vec()),
            Some(("frame", "broken")) => Answer::Refused("there are spheres".to_owned()),
            Some(("frame", machine @ ("one" | "two"))) => Answer::Whole(picture(machine, turn).json()),
            Some(("areas", "one")) => Answer::Whole(areas().json()),
            Some(("way", "one" | "two")) => self.way(&question, pixel),
            Some(("moment", _)) => {
                Columns::moment(number("step").unwrap_or(0) as u32, number("unit").unwrap_or(0) as usize)
            }
            _ => Answer::Unknown,
        }
    }
}

/// A server of the sample, which ends when dropped.
pub struct Served {
    pub address: String,
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Served {
    pub fn new(site: impl Site + 'static) -> Served {
        let server = Server::bind(None).unwrap();
        let (address, is_over) = (server.address(), Arc::new(AtomicBool::new(false)));
        let over = is_over.clone();
        let site: Arc<dyn Site> = Arc::new(site);
        let thread = thread::spawn(move || server.serve(&site, || over.load(Relaxed)));
        Served { address, is_over, thread: Some(thread) }
    }

    /// The host with its port, and the path with the token.
    pub fn parts(&self) -> (&str, &str) {
        let rest = self.address.strip_prefix("http://").unwrap();
        rest.split_at(rest.find('/').unwrap())
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.is_over.store(true, Relaxed);
        self.thread.take().unwrap().join().unwrap();
    }
}

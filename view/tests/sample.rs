//! A small frame on two machines.

use std::sync::Arc;
use std::thread::{self, JoinHandle};

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use tilewright_view::{Answer, Clock, Grid, Kind, Lane, Page, Part, Picture, Server, Site, Unit, Write};

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

/// The frame as a site. The machine `broken` cannot draw it.
pub struct Columns;

impl Site for Columns {
    fn page(&self) -> Page {
        Page::Frame
    }

    fn about(&self) -> String {
        let machine = |name: &str| format!(r#"{{"name": "{name}", "summary": "Machine {name}"}}"#);
        let machines = ["one", "two", "broken"].map(machine).join(", ");
        format!(
            r#"{{"title": "columns, 32x24", "summary": "All", "machines": [{machines}], "first": "one", "orbits": true}}"#
        )
    }

    fn data(&self, name: &str, query: &str) -> Answer {
        let turn = query.strip_prefix("turn=").and_then(|turn| turn.parse().ok()).unwrap_or(0);
        match name.strip_prefix("frame/") {
            Some("broken") => Answer::Refused("there are spheres".to_owned()),
            Some(machine @ ("one" | "two")) => Answer::Whole(picture(machine, turn).json()),
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

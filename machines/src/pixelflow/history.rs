//! What the nodes did in the time of a frame, and the node of each least word.

use std::ops::Range;

use tilewright_rtl::pixelflow::fields::{appearance, gouraud};
use tilewright_scenes::Frame as Picture;

use super::costs::Ticks;
use super::hardware::Words;
use super::model::Done;
use super::report::Report;
use super::works::Works;
use crate::history::{History, Lane, Painting, Write};

/// Picoseconds of a tick.
const TICK: u64 = 5000;

/// The nodes of the least words so far.
pub(super) struct Recording {
    /// By pixel of the frame: the number of the rasterizer of each covered sample, counted from 1; then zeros.
    samples: Vec<u16>,
    of_pixel: usize,
}

/// The ticks in which nodes had an instruction.
pub(super) struct Worked {
    pub rasterizers: Vec<Vec<Range<Ticks>>>,
    pub shaders: Vec<Vec<Range<Ticks>>>,
    pub holder: Vec<Range<Ticks>>,
}

impl Recording {
    /// The history of a frame before its first region.
    pub fn new(works: &Works) -> Recording {
        let of_pixel = works.samples() as usize;
        Recording { samples: vec![0; works.size().pixels() * of_pixel], of_pixel }
    }

    /// Notes a composed turn: for each pixel, chip by chip, the word and its node.
    pub fn see(&mut self, works: &Works, turn: usize, words: &Words, winners: impl Iterator<Item = u16>) {
        for (at, winner) in winners.enumerate() {
            let (chip, pixel) = works.place_in_chip(at);
            if is_covered(works, words, chip, pixel)
                && let Some(place) = works.pixel(works.region(turn), chip, pixel)
            {
                let of_pixel = &mut self.samples[place * self.of_pixel..][..self.of_pixel];
                of_pixel.iter_mut().find(|it| **it == 0).into_iter().for_each(|free| *free = winner + 1);
            }
        }
    }

    /// The history of a frame with that picture.
    pub fn into_history(
        self,
        works: &Works,
        report: &Report,
        (picture, background): (&Picture, [u8; 3]),
        nodes: Worked,
    ) -> History {
        let mut painting = Painting::new(picture.size(), background);
        for turn in (0..works.turns()).filter(|turn| works.ends(*turn)) {
            self.paint(&mut painting, works, turn, report, picture);
        }
        let names = (1..=works.shares()).map(|number| format!("rasterizer {number}")).collect();
        painting.into_history(names, lanes(report, nodes))
    }

    /// The rasterizer with most samples of a pixel, the first of several; `None` if nothing covers the pixel.
    fn owner(&self, pixel: usize) -> Option<u32> {
        let samples = &self.samples[pixel * self.of_pixel..][..self.of_pixel];
        let count = |number: u16| samples.iter().filter(|it| **it == number).count();
        let most = samples.iter().filter(|it| **it > 0).max_by_key(|it| (count(**it), std::cmp::Reverse(**it)));
        most.map(|number| u32::from(*number) - 1)
    }

    /// The pixels of a region in the sequence in which the frame buffer takes them: one of each chip at a time.
    fn paint(&self, painting: &mut Painting, works: &Works, turn: usize, report: &Report, picture: &Picture) {
        let loaded = &report.turns[turn].loaded;
        let of_chip = works.pixels_of_chip();
        for at in 0..works.pixels_of_array() {
            let (chip, pixel) = works.place_in_chip(at);
            let Some(place) = works.pixel(works.region(turn), chip, pixel) else { continue };
            let Some(painter) = self.owner(place) else { continue };
            let ticks = (loaded.end - loaded.start) * (pixel as u64 + 1) / of_chip as u64;
            let time = (report.delay() + loaded.start + ticks) * TICK;
            painting.draw(Write { time, pixel: place as u32, painter, word: picture.words[place] }, |_, _| true);
        }
    }
}

/// Whether a primitive covers a pixel with that word.
fn is_covered(works: &Works, words: &Words, chip: u32, pixel: usize) -> bool {
    let byte = |address: u64| {
        let sent = (works.bytes() - 1 - address) as usize;
        words.byte(sent * works.pixels_of_chip() + pixel, chip)
    };
    match works.is_shaded() {
        true => byte(appearance::ZERO.address) == 0,
        false => (0..gouraud::DEPTH.bytes).any(|number| byte(gouraud::DEPTH.byte(number)) != 0xff),
    }
}

/// The activities of all units.
fn lanes(report: &Report, nodes: Worked) -> Vec<Lane> {
    let delay = report.delay();
    let mut front = Lane::of_clocks("front end", TICK, 1);
    front.add("geometry", 0, report.front * TICK, report.front);
    front.add("second pass", report.front * TICK, (report.front + report.second) * TICK, report.second);
    // The array has one clock for two ticks.
    let node = |name: String, what, worked: Vec<Range<Ticks>>| {
        let mut lane = Lane::of_clocks(name, 2 * TICK, 1);
        for ticks in worked {
            lane.add(what, (delay + ticks.start) * TICK, (delay + ticks.end) * TICK, (ticks.end - ticks.start) / 2);
        }
        lane
    };
    let stage = |name: &str, what, of: fn(&Done) -> &Range<Ticks>| {
        let mut lane = Lane::of_clocks(name, TICK, 1);
        for ticks in report.turns.iter().map(of) {
            lane.add(what, (delay + ticks.start) * TICK, (delay + ticks.end) * TICK, ticks.end - ticks.start);
        }
        lane
    };
    let mut lanes = vec![front];
    let numbered = |kind: &'static str, worked: Vec<Vec<Range<Ticks>>>| {
        (1..).zip(worked).map(move |(number, worked): (u32, _)| (format!("{kind} {number}"), worked))
    };
    lanes.extend(numbered("rasterizer", nodes.rasterizers).map(|(name, it)| node(name, "rasterizing", it)));
    lanes.push(stage("network", "composing", |it| &it.composed));
    if !nodes.shaders.is_empty() {
        lanes.extend(numbered("shader", nodes.shaders).map(|(name, it)| node(name, "shading", it)));
        lanes.push(stage("network, back", "sending colours", |it| &it.sent));
    }
    lanes.push(node("frame's holder".to_owned(), "storing", nodes.holder));
    lanes.push(stage("frame buffer", "loading", |it| &it.loaded));
    lanes
}

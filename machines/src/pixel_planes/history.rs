//! What a machine did in the time of a frame, from the clocks of the model, which are the circuit's, and from the pixels of its instructions.

use std::collections::BTreeMap;

use tilewright_rtl::pixel_planes::PERIOD;
use tilewright_rtl::pixel_planes::ring::Ring;
use tilewright_scenes::frame::depth_of;
use tilewright_scenes::golden::visit_fragments;
use tilewright_scenes::{PixelBox, Polygons};

use super::bin::Work;
use super::config::Config;
use super::model::{RendererTiming, Timing};
use super::regions::Regions;
use crate::history::{History, Lane, Painting, Write};

/// Clocks of a span of the ring and of the frame buffer, which work in single clocks.
const SPAN: u64 = 64;

/// The primitives, and the instructions that draw them.
pub(super) struct Scene<'a> {
    pub config: &'a Config,
    pub regions: &'a Regions,
    pub polygons: &'a Polygons,
    pub background: [u8; 3],
}

impl Scene<'_> {
    /// The history of a frame; `geometry` is the clocks of the next frame's geometry.
    pub fn history(&self, works: &[Work], timing: &Timing, geometry: u64) -> History {
        let mut painting = Painting::new(self.regions.size(), self.background);
        for (number, renderer) in (0..).zip(&timing.renderers) {
            self.paint(&mut painting, number, renderer, works);
        }
        let names: Vec<String> = (0..timing.renderers.len()).map(|number| format!("renderer {number}")).collect();
        let lanes = names.iter().zip(&timing.renderers).map(|(name, timing)| renderer(name, timing));
        let mut next = Lane::of_clocks("geometry", PERIOD.picoseconds(), 1);
        next.add("geometry of the next frame", 0, picoseconds(geometry), geometry);
        let lanes = lanes.chain([self.ring(timing), frame_buffer(timing), next]).collect();
        let region = Some([self.regions.side(); 2]);
        History { region, ..painting.into_history(names, lanes) }
    }

    /// The changes by a renderer. A primitive is visible when its last instruction has ended and has passed the pixels' pipeline.
    fn paint(&self, painting: &mut Painting, painter: u32, timing: &RendererTiming, works: &[Work]) {
        let (strict, mut ended) = (self.config.strict, timing.ended.iter());
        for work in timing.regions.iter().map(|place| &works[*place]) {
            let pixels = self.regions.pixels(work.region);
            let of_primitives: usize = work.made.iter().map(|(_, count)| *count as usize).sum();
            // A region begins with its clearing and ends with its save.
            let begin = work.instructions.len() - 1 - of_primitives;
            ended.by_ref().take(begin).for_each(drop);
            for &(primitive, instructions) in &work.made {
                if let Some(clock) = ended.by_ref().take(instructions as usize).last() {
                    let time = picoseconds(clock + 1);
                    self.primitive(primitive, &pixels, |pixel, word| {
                        let write = Write { time, pixel, painter, word };
                        let is_nearer = |new, kept| if strict { depth_of(new) < depth_of(kept) } else { new < kept };
                        painting.draw(write, is_nearer);
                    });
                }
            }
            ended.next();
        }
    }

    fn primitive(&self, number: u32, pixels: &PixelBox, visit: impl FnMut(u32, u64)) {
        visit_fragments(self.polygons, number as usize, pixels, visit);
    }

    /// Bits of instructions and of planes.
    fn ring(&self, timing: &Timing) -> Lane {
        let plane = self.config.ring().map_or(0, |ring| ring.side);
        let rate = timing.ring.rate as f64 / PERIOD.picoseconds() as f64;
        let mut lane = Lane { name: "ring".to_owned(), of: "bits", rate, spans: Vec::new() };
        let arrived = |it: &RendererTiming| it.arrived.clone();
        let messages = [
            ("instructions", arrived as fn(&RendererTiming) -> _, Ring::INSTRUCTION),
            ("planes", |it| it.planes.clone(), plane),
        ];
        for (what, of, bits) in messages {
            now_and_then(&mut lane, what, timing.renderers.iter().flat_map(of), bits.into());
        }
        lane.spans.sort_by_key(|span| span.from);
        lane
    }
}

/// A plane a clock.
fn frame_buffer(timing: &Timing) -> Lane {
    let mut lane = Lane::of_clocks("frame buffer", PERIOD.picoseconds(), 1);
    now_and_then(&mut lane, "planes", timing.renderers.iter().flat_map(|it| it.planes.clone()), 1);
    lane
}

/// Adds an amount for each of those clocks, which are not sorted.
fn now_and_then(lane: &mut Lane, what: &'static str, clocks: impl Iterator<Item = u64>, amount: u64) {
    let mut sums: BTreeMap<u64, u64> = BTreeMap::new();
    clocks.for_each(|clock| *sums.entry(clock / SPAN).or_default() += amount);
    for (number, amount) in sums {
        lane.add(what, picoseconds(number * SPAN), picoseconds((number + 1) * SPAN), amount);
    }
}

/// The clocks in which it had a region, and those of them in which it waited.
fn renderer(name: &str, timing: &RendererTiming) -> Lane {
    let mut lane = Lane::of_clocks(name, PERIOD.picoseconds(), 1);
    let [starved, stored] = timing.waited();
    let starved = starved.iter().map(|clocks| (clocks.clone(), "waiting for instructions"));
    let stored = stored.iter().map(|clocks| (clocks.clone(), "waiting for the store"));
    let mut waits: Vec<_> = starved.chain(stored).collect();
    waits.sort_by_key(|(clocks, _)| clocks.start);
    let mut waits = waits.into_iter().peekable();
    let mut add = |what, from: u64, to: u64| lane.add(what, picoseconds(from), picoseconds(to), to - from);
    for (&given, &free) in timing.given.iter().zip(&timing.free) {
        let mut clock = given;
        while let Some((wait, what)) = waits.next_if(|(wait, _)| wait.start < free) {
            add("drawing", clock, wait.start.max(clock));
            add(what, wait.start, wait.end);
            clock = wait.end;
        }
        add("drawing", clock, free);
    }
    lane
}

fn picoseconds(clocks: u64) -> u64 {
    clocks * PERIOD.picoseconds()
}

//! What a generator did in the time of a frame. Fragments are observed in each clock of drawing, and counters from time to time.

use super::config::Config;
use super::counters::Counters;
use super::hardware::Hardware;
use super::report::{Report, Stage};
use super::visits::Visits;
use crate::error::Error;
use crate::history::{History, Lane, Painting, Write};
use tilewright_scenes::frame::depth_of;

/// The most observations of the counters in a frame; there are at least half as many.
const LOOKS: usize = 512;

/// The history of a frame in progress.
pub(super) struct Recording {
    painting: Painting,
    matrix: (u32, u32),
    width: u32,
    strict: bool,
    /// For each video processor, the signals of a fragment: its validity, its place and its word.
    fragments: Vec<[String; 4]>,
    /// The clocks between two observations of the counters, those until the next one, and all observations with their times.
    every: u64,
    left: u64,
    looks: Vec<(u64, Counters)>,
    /// Picoseconds of a clock.
    period: u64,
    /// The windows that units divide, if they are recorded.
    visits: Option<Visits>,
}

impl Recording {
    /// The history of a machine with these counters.
    pub fn new(config: &Config, background: [u8; 3], counters: Counters, time: u64, period: u64) -> Recording {
        let (p, q) = config.matrix;
        let of =
            |number: u32| ["valid", "x", "y", "word"].map(|it| format!("u_processor[{number}].u_pixel.fragment_{it}"));
        Recording {
            painting: Painting::new(config.size, background),
            matrix: config.matrix,
            width: config.size.width(),
            strict: config.strict,
            fragments: (0..p * q).map(of).collect(),
            every: 1,
            left: 1,
            looks: vec![(time, counters)],
            period,
            visits: None,
        }
    }

    /// The same with the windows that units divide.
    ///
    /// # Errors
    /// A parameter is out of range.
    pub fn with_visits(self, config: &Config) -> Result<Recording, Error> {
        Ok(Recording { visits: Some(Visits::new(config)?), ..self })
    }

    /// Observes an edge.
    pub fn see(&mut self, hardware: &mut Hardware) {
        for number in 0..self.fragments.len() {
            self.see_fragment(number as u32, hardware);
        }
        if let Some(visits) = &mut self.visits {
            let coming = hardware.sim.time() + self.period;
            visits.see(hardware, coming);
        }
        self.left -= 1;
        if self.left == 0 {
            self.looks.push((hardware.sim.time(), hardware.counters()));
            if self.looks.len() > LOOKS {
                let mut number = 0;
                self.looks.retain(|_| {
                    number += 1;
                    number % 2 == 1
                });
                self.every *= 2;
            }
            self.left = self.every;
        }
    }

    /// A fragment is in the video buffer a clock after the pixel processor has it.
    fn see_fragment(&mut self, number: u32, hardware: &mut Hardware) {
        let [valid, place @ .., word] = &self.fragments[number as usize];
        let mut peek = |name: &String| {
            hardware.sim.peek(name).ok().and_then(|it| it.to_u64()).expect("pixel processors have that register")
        };
        if peek(valid) == 0 {
            return;
        }
        let ([x, y], (p, q)) = (place.each_ref().map(&mut peek), self.matrix);
        let (column, line) = (x as u32 * p + number % p, y as u32 * q + number / p);
        let write = Write {
            pixel: line * self.width + column,
            painter: number,
            word: peek(word),
            time: hardware.sim.time() + self.period,
        };
        let strict = self.strict;
        self.painting.draw(write, |new, kept| if strict { depth_of(new) < depth_of(kept) } else { new < kept });
    }

    /// The history of the frame, whose drawing ended at that time with those counters.
    pub fn into_history(mut self, report: &Report, counters: &Counters, drawn: u64, end: u64) -> History {
        self.looks.retain(|(time, _)| *time < drawn);
        self.looks.push((drawn, counters.clone()));
        let (p, q) = self.matrix;
        let names = (0..p * q).map(|number| format!("processor ({}, {})", number % p, number / p)).collect();
        let mut lanes = vec![self.broadcast()];
        lanes.extend(report.stages.iter().map(|stage| self.stage(stage)));
        let mut reader = Lane::of_clocks("controller", self.period, 1);
        reader.add("reading out", drawn, end, (end - drawn) / self.period);
        lanes.push(reader);
        let areas = self.visits.map_or_else(Vec::new, Visits::into_areas);
        History { areas, ..self.painting.into_history(names, lanes) }
    }

    /// The clocks in which a packet of the broadcast waited.
    fn broadcast(&self) -> Lane {
        let mut lane = Lane::of_clocks("broadcast", self.period, 1);
        for [(from, before), (to, now)] in self.looks.array_windows() {
            lane.add("stalled", *from, *to, now.broadcast_stalls_since(before));
        }
        lane
    }

    /// The clocks of a stage in all video processors.
    fn stage(&self, stage: &Stage) -> Lane {
        let (p, q) = self.matrix;
        let mut lane = Lane::of_clocks(stage.name(), self.period, p * q * stage.units);
        for [(from, before), (to, now)] in self.looks.array_windows() {
            let each = now.each_since(before);
            let of_stage = || each.iter().map(|it| it.units[stage.level as usize]);
            lane.add("busy", *from, *to, of_stage().map(|unit| unit.busy).sum());
            lane.add("stalled", *from, *to, of_stage().map(|unit| unit.stalled).sum());
        }
        lane
    }
}

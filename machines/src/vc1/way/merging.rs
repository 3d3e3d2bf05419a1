//! The merger: the scan, the rounds in which the pixel passes the chain, and the swap of the global frame buffer.

use tilewright_rtl::lfb::{Patches, ScanCounter};
use tilewright_rtl::merger::STAGES;
use tilewright_rtl::vc1::Vc1;

use super::drawing::Drawing;
use super::round::Round;
use super::sequencer::{Scan, Sequencer};
use super::{Followed, Sim, merge};
use crate::looks::Looks;
use crate::told::{At, Edge, Told, compared, yes};

/// The models of the merger's units.
pub(super) struct Merging {
    followed: Followed,
    background: u64,
    processors: u32,
    patches: Patches,
    sequencer: Sequencer,
    banks: Banks,
    looks: Looks,
    /// By local frame buffer, its scan counter and the wires of the scan.
    scans: Vec<Scanned>,
    /// The rounds in which the pixel is under way, the oldest first.
    rounds: Vec<Round>,
    /// Clocks with `enable` since the last restart; the first one comes with the reset.
    scanned: u64,
    /// The scan in the clock before.
    scan: Option<Scan>,
    /// By local frame buffer, the clock of the last swap.
    swapped: Vec<u64>,
    clock: u64,
    /// Frames that are commanded and not on display yet.
    frames: u32,
}

/// The places of a scan's wires among what is looked at, and of where its pixel is.
const WIRES: usize = 3;
const LOCATED: usize = WIRES + 12;

/// The nets of the scan in a local frame buffer.
struct Scanned {
    /// Those of the counter, and wires with their blocks.
    counter: [String; 3],
    wires: [(&'static str, String); 12],
    /// The patch of the counter's pixel, and the place of the pixel before.
    located: [String; 2],
    looks: Looks,
}

impl Scanned {
    fn new(number: u32) -> Scanned {
        let unit = |path: &str| format!("u_lfb[{number}].{path}");
        let wires = [
            ("vc1", unit("scan_restart")),
            ("vc1", unit("scan_enable")),
            ("vc1", unit("preset_x")),
            ("vc1", unit("preset_y")),
            ("lfb-unit", unit("u_scan_counter.scan_restart")),
            ("lfb-unit", unit("u_scan_counter.scan_enable")),
            ("lfb-unit", unit("u_scan_counter.preset_x")),
            ("lfb-unit", unit("u_scan_counter.preset_y")),
            ("lfb-unit", unit("u_image_memory.send_enable")),
            ("lfb-unit", unit("u_patch_table.scan_enable")),
            ("vc1", "u_merger.enable".to_owned()),
            ("image-merger", format!("u_merger.u_merging_unit[{number}].enable")),
        ];
        let counter = ["pixel_x", "pixel_y", "armed"].map(|it| unit(&format!("u_scan_counter.{it}")));
        let mut looks = Looks::default();
        let located = [unit("u_patch_table.scan_patch"), unit("u_image_memory.send_offset")];
        let names = counter.iter().chain(wires.iter().map(|(_, name)| name)).chain(&located);
        looks.add("", names.map(String::as_str));
        Scanned { counter, wires, located, looks }
    }
}

/// The swap of the global frame buffer's banks.
struct Banks {
    merge_clocks: u64,
    way: u32,
    processors: usize,
    /// The bank being filled, which changes with `shown`.
    filled: u32,
    /// The first local frame buffer that has not ended the frame.
    next: usize,
    since: u64,
    way_left: u32,
}

impl Merging {
    pub fn new(machine: &Vc1, followed: Followed, background: u64) -> Merging {
        let swap = machine.gfb_swap();
        let mut sequencer = Sequencer::new(machine);
        // The first edge after the reset comes before the first look.
        sequencer.edge(false);
        let mut looks = Looks::default();
        looks.add("u_gfb.u_sequencer.", ["restart"].into_iter().chain(Scan::NETS));
        looks.add("", ["u_gfb.blanking", "u_swap.u_gfb_swap.swap"]);
        for number in 0..machine.processors {
            looks.add(&format!("u_swap.u_lfb_swap[{number}]."), ["frame"]);
        }
        Merging {
            followed,
            background,
            processors: machine.processors,
            patches: machine.lfb.patches,
            sequencer,
            banks: Banks {
                merge_clocks: swap.merge_clocks,
                way: swap.way,
                processors: machine.processors as usize,
                filled: 0,
                next: 0,
                since: 0,
                way_left: swap.way,
            },
            looks,
            scans: (0..machine.processors).map(Scanned::new).collect(),
            rounds: Vec::new(),
            scanned: 0,
            scan: None,
            swapped: vec![0; machine.processors as usize],
            clock: 0,
            frames: 0,
        }
    }

    /// The host commands a frame.
    pub fn command(&mut self) {
        self.frames += 1;
    }

    /// A local frame buffer exchanged its buffers. The merger notices within a few clocks.
    pub fn swaps(&mut self, number: u32) {
        self.swapped[number as usize] = self.clock;
    }

    /// Looks at the units before the edge after `clock`.
    pub fn look(&mut self, sim: &mut Sim, clock: u64, (drawing, told): (&mut [Drawing], &mut Told)) {
        self.clock = clock + 1;
        let edge = merge(clock + 1);
        self.looks.look(sim);
        let restart = self.looks.at(0) == 1;
        let (seen, expected) = (Scan::seen(self.looks.from(1)), self.sequencer.scan(restart));
        if seen != expected {
            told.check("sequencer", 0, false, || {
                let pairs = seen.values().into_iter().zip(expected.values());
                let values = pairs.map(|((name, seen), (_, expected))| compared(name, seen, expected)).collect();
                let at = At { unit: "sequencer of the global frame buffer".to_owned(), block: "gfb-sequencer", edge };
                at.step("scans the screen", values).on("u_gfb.u_sequencer.feed")
            });
        }
        self.sequencer.edge(restart);
        self.wires(sim, edge, seen, told);
        let before = self.scan.replace(seen);
        if let Some(it) = before {
            self.scanned = if it.restart { 0 } else { self.scanned + u64::from(it.enable) };
        }
        self.counts(sim, edge, told);
        if before.is_some_and(|it| it.enable && !it.restart) {
            for round in &mut self.rounds {
                round.advance();
                round.look(sim, edge, (drawing, &self.swapped));
            }
        }
        if seen.enable && before.is_some_and(|it| !it.enable) {
            // The scan was paused.
            self.rounds.iter_mut().for_each(|round| round.goes_on(sim, edge));
        }
        if before.is_some_and(|it| it.restart) {
            // What is in the chain at a restart is not stored.
            self.rounds.drain(..).for_each(|round| round.tell(true, told));
        }
        let is_over = |round: &mut Round| round.is_over();
        self.rounds.extract_if(.., is_over).for_each(|round| round.tell(false, told));
        let is_fed = seen.enable && !seen.restart && seen.feed == self.followed.number;
        if is_fed && self.frames > 0 {
            let background = seen.blank.then_some(self.background);
            let mut round = Round::new(self.followed, self.processors, (self.banks.filled, background));
            round.look(sim, edge, (drawing, &self.swapped));
            self.rounds.push(round);
        }
        if self.banks.look(&self.looks, edge, (seen.enable, restart), told) {
            self.frames = self.frames.saturating_sub(1);
        }
    }

    /// Looks at one of the scan counters, in each clock at another one.
    fn counts(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) {
        self.count(sim, edge, edge.number % u64::from(self.processors), told);
    }

    /// Looks at all scan counters where the run failed, unless it was before their first clock.
    pub fn fails(&mut self, sim: &mut Sim, told: &mut Told) {
        let processors = if self.scan.is_some() { self.processors } else { 0 };
        (0..processors).for_each(|number| self.count(sim, merge(self.clock), number.into(), told));
    }

    fn count(&mut self, sim: &mut Sim, edge: Edge, number: u64, told: &mut Told) {
        let scanned = self.scanned;
        let screen = self.patches.screen();
        let [width, pixels] = [screen.width, screen.pixels()].map(u64::from);
        let behind = u64::from(STAGES) * number;
        let pixel = (scanned + pixels - behind % pixels) % pixels;
        let Scanned { counter: names, located, looks, .. } = &mut self.scans[number as usize];
        looks.look(sim);
        let values = looks.from(0);
        let expected = [pixel % width, pixel / width, u64::from(scanned >= behind)];
        if values != expected {
            told.check("scan counter", 0, false, || {
                let shown = |[x, y, armed]: [u64; 3]| format!("{x},{y}{}", if armed == 1 { "" } else { ", not sent" });
                let at = At { unit: format!("scan counter of PE {number}"), block: "scan-counter", edge };
                at.step("shows the pixel to send", vec![compared("pixel", shown(values), shown(expected))])
                    .on(&names[0])
            });
            return;
        }
        let place = |pixel: u64| self.patches.place((pixel % width) as u32, (pixel / width) as u32);
        let before = (scanned > 0).then(|| place((pixel + pixels - 1) % pixels).offset);
        let expected = [("patch", Some(place(pixel).patch)), ("place in the page", before)];
        for (at, (what, expected)) in expected.into_iter().enumerate() {
            let (seen, name) = (looks.at(LOCATED + at), &located[at]);
            if let Some(expected) = expected.filter(|expected| *expected != seen) {
                told.check("locate", 0, false, || {
                    let at = At { unit: format!("local frame buffer of PE {number}"), block: "lfb-unit", edge };
                    at.step("locates the pixel to send", vec![compared(what, seen, expected)]).on(name)
                });
            }
        }
    }

    /// Looks at the control of the scan in one of the units, in each clock in another one.
    fn wires(&mut self, sim: &mut Sim, edge: Edge, scan: Scan, told: &mut Told) {
        let number = (edge.number % u64::from(self.processors)) as u32;
        let screen = self.patches.screen();
        let preset = ScanCounter::preset(screen, number);
        let [restart, enable] = [scan.restart, scan.enable].map(u64::from);
        let [x, y] = [preset.x, preset.y];
        let expected = [restart, enable, x, y, restart, enable, x, y, enable, enable, enable, enable];
        let Scanned { wires, looks, .. } = &mut self.scans[number as usize];
        looks.look(sim);
        for (((block, name), value), expected) in wires.iter().zip(&looks.values()[WIRES..]).zip(expected) {
            let value = *value;
            if value != expected {
                told.check("scan wire", 0, false, || {
                    let at = At { unit: format!("wire to `{name}`"), block, edge };
                    at.step("brings the control of the scan", vec![compared("value", value, expected)]).on(name)
                });
                return;
            }
        }
    }
}

impl Banks {
    /// Returns whether a frame goes on display.
    fn look(&mut self, nets: &Looks, edge: Edge, (enable, restart): (bool, bool), told: &mut Told) -> bool {
        let [blanking, swap] = nets.from(7).map(|bit| bit == 1);
        while self.next < self.processors && nets.at(9 + self.next) != u64::from(self.filled) {
            self.next += 1;
        }
        let all = self.next == self.processors;
        let is_merged = all && self.since >= self.merge_clocks && self.way_left == 0;
        let expected = is_merged && blanking;
        if swap || swap != expected {
            told.check("banks", 0, swap, || {
                let values = vec![compared("swap", yes(swap), yes(expected))];
                let at = At { unit: "swap control of the global frame buffer".to_owned(), block: "gfb-swap", edge };
                at.step("puts the merged bank on display", values).on("u_swap.u_gfb_swap.swap")
            });
        }
        if swap != restart {
            told.check("banks wire", 0, false, || {
                let values = vec![compared("swap", yes(restart), yes(swap))];
                let at = At { unit: "swap wire of the global frame buffer".to_owned(), block: "vc1", edge };
                at.step("restarts the scan", values).on("u_gfb.u_sequencer.restart")
            });
        }
        if !all || swap {
            (self.since, self.way_left) = (0, self.way);
        } else {
            self.since += 1;
            self.way_left -= u32::from(enable && self.way_left > 0);
        }
        if swap {
            (self.filled, self.next) = (self.filled ^ 1, 0);
        }
        swap
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vc1::Config;
    use crate::way::Step;
    use tilewright_rtl::clocks::MERGE;
    use tilewright_scenes::Size;
    use tilewright_sim::Simulation;

    /// What differs in a machine with patches of 4x4 pixels from the model of one with patches of that edge.
    fn differing(edge: u32) -> Vec<Step> {
        let config = Config { processors: 2, ..Config::new(Size::new(16, 12).unwrap()) };
        let mut sim = Simulation::of(&config.hardware().unwrap()).unwrap();
        let model = Config { patch: edge, ..config }.hardware().unwrap();
        let followed = Followed { x: 0, y: 0, number: 0, patch: 0, offset: 0 };
        let (mut merging, mut told) = (Merging::new(&model, followed, 0), Told::default());
        sim.reset();
        for clock in 1..100 {
            sim.step_clock(MERGE.name, 1);
            merging.look(&mut sim, clock, (&mut [], &mut told));
        }
        told.take()
    }

    #[test]
    fn where_a_local_frame_buffer_seeks_a_pixel_is_compared() {
        assert_eq!(differing(4), []);
        let steps = differing(8);
        let step = steps.first().expect("patches of other sizes have other numbers");
        assert_eq!((step.block, step.does.as_str()), ("lfb-unit", "locates the pixel to send"));
    }
}

//! A round of the scan in which the pixel passes the chain of merging units, from the local frame buffers to the global one.
//!
//! The chain takes a pixel in each clock with `enable`. The round counts these clocks from the one in which the pixel is fed.

use tilewright_rtl::gfb::SCAN_LATENCY;
use tilewright_rtl::merger::STAGES;

use super::drawing::Drawing;
use super::image::EMPTY;
use super::{Followed, Sim, net, word};
use crate::told::{At, Edge, Told, compared, hex, value};
use crate::way::Step;

/// Merger clocks within which a local frame buffer's scan follows a swap.
const FOLLOWS: u64 = 6;

/// The way of the pixel through the chain.
pub(super) struct Round {
    followed: Followed,
    processors: u32,
    /// The bank that it comes from and is stored in.
    bank: u32,
    /// What enters the chain instead of the bank's word.
    background: Option<u64>,
    /// The word that was in the bank.
    before: Option<u64>,
    clocks: u32,
    /// The buffer that a local frame buffer scans, and the page that it found.
    scans: u32,
    page: Option<u64>,
    /// The word that the last merging unit should put out, and its inputs.
    inputs: [u64; 2],
    /// The word that a local frame buffer sends.
    sent: u64,
    steps: Vec<Step>,
    /// A local frame buffer sent a word.
    is_sent: bool,
    is_changed: bool,
}

impl Round {
    /// One that begins now.
    pub fn new(followed: Followed, processors: u32, (bank, background): (u32, Option<u64>)) -> Round {
        Round {
            followed,
            processors,
            bank,
            background,
            before: None,
            clocks: 0,
            scans: 0,
            page: None,
            inputs: [0; 2],
            sent: EMPTY,
            steps: Vec::new(),
            is_sent: false,
            is_changed: false,
        }
    }

    /// A clock with `enable` has passed.
    pub fn advance(&mut self) {
        self.clocks += 1;
    }

    fn stored(&self) -> u32 {
        SCAN_LATENCY + STAGES * self.processors + 1
    }

    /// Whether the pixel has been stored.
    pub fn is_over(&self) -> bool {
        self.clocks >= self.stored()
    }

    /// Tells it, unless nothing happened to the pixel, or it does not matter because the round was given up.
    pub fn tell(self, is_given_up: bool, told: &mut Told) {
        if self.steps.iter().any(Step::differs) || !is_given_up && (self.is_sent || self.is_changed) {
            self.steps.into_iter().for_each(|step| told.tell(step));
        }
    }

    /// Looks at the units that have the pixel in this clock.
    pub fn look(&mut self, sim: &mut Sim, edge: Edge, (drawing, swapped): (&mut [Drawing], &[u64])) {
        let (clocks, processors) = (self.clocks, self.processors);
        let number = clocks / STAGES;
        if clocks == 0 {
            self.before = Some(word(sim, &format!("u_gfb.banks[{}]", self.bank), self.followed.number));
        }
        if clocks.is_multiple_of(STAGES) && number < processors {
            let is_new = edge.number - swapped[number as usize] < FOLLOWS;
            self.scan(sim, edge, number, (&drawing[number as usize], is_new));
        }
        if clocks % STAGES == 1 && number < processors {
            self.finds(sim, edge, number, &drawing[number as usize]);
        }
        if clocks % STAGES == SCAN_LATENCY {
            if number > 0 {
                self.merges(sim, edge, number - 1);
            }
            if number < processors {
                self.sends(sim, edge, number, &mut drawing[number as usize]);
            } else {
                self.leaves(sim, edge);
            }
        }
        if clocks == self.stored() {
            self.stores(sim, edge);
        }
    }

    fn add(&mut self, step: Step) {
        self.steps.push(step);
    }

    /// The scan counter shows the pixel.
    fn scan(&mut self, sim: &mut Sim, edge: Edge, number: u32, (drawing, is_new): (&Drawing, bool)) {
        let back = net(sim, &format!("u_lfb[{number}].back")) as u32;
        let expected = if is_new { back } else { drawing.front() ^ 1 };
        let names = ["x", "y"].map(|it| format!("u_lfb[{number}].u_scan_counter.pixel_{it}"));
        let [x, y] = [0, 1].map(|i| net(sim, &names[i]));
        let Followed { x: column, y: line, .. } = self.followed;
        if (x, y) != (column.into(), line.into()) {
            let values = vec![compared("pixel", format!("{x},{y}"), format!("{column},{line}"))];
            let at = At { unit: format!("scan counter of PE {number}"), block: "scan-counter", edge };
            self.add(at.step("shows the pixel to send", values).on(&names[0]));
        }
        if back != expected {
            let values = vec![compared("back buffer", back, expected)];
            let at = At { unit: format!("local frame buffer of PE {number}"), block: "lfb-unit", edge };
            self.add(at.step("scans the back buffer", values).on(format!("u_lfb[{number}].back")));
        }
        self.scans = expected;
    }

    /// The patch table has looked the patch up.
    fn finds(&mut self, sim: &mut Sim, edge: Edge, number: u32, drawing: &Drawing) {
        let names = ["scan_entry_resident", "scan_entry_page"].map(|it| format!("u_lfb[{number}].u_patch_table.{it}"));
        let [resident, page] = [0, 1].map(|i| net(sim, &names[i]));
        let seen = (resident == 1).then_some(page);
        let expected = drawing.page(self.scans).map(u64::from);
        let shown = |page: Option<u64>| page.map_or("no page".to_owned(), |page| format!("page {page}"));
        if seen != expected || seen.is_some() {
            let values = vec![compared("entry", shown(seen), shown(expected))];
            let at = At { unit: format!("patch table of PE {number}"), block: "patch-table", edge };
            let does = format!("finds the page of patch {} for the scan", self.followed.patch);
            self.add(at.step(does, values).on(&names[1]));
        }
        let image = |name: &str| format!("u_lfb[{number}].u_image_memory.send_{name}");
        let [sends, from, offset, buffer] = ["resident", "page", "offset", "buffer"].map(|it| net(sim, &image(it)));
        let asked = (sends == 1).then(|| format!("page {from}, place {offset}, buffer {buffer}"));
        // A pixel that was looked up before the buffers were exchanged is not sent.
        let back = net(sim, &format!("u_lfb[{number}].back")) as u32;
        let is_sent = seen.filter(|_| back == self.scans);
        let golden = is_sent.map(|page| format!("page {page}, place {}, buffer {}", self.followed.offset, self.scans));
        if asked != golden {
            let [asked, golden] = [asked, golden].map(|it| it.unwrap_or("nothing".to_owned()));
            let at = At { unit: format!("local frame buffer of PE {number}"), block: "lfb-unit", edge };
            let step = at.step("asks the image memory for the pixel", vec![compared("word", asked, golden)]);
            self.add(step.on(image("page")));
        }
        self.page = is_sent;
    }

    /// The local frame buffer sends the word to its merging unit.
    fn sends(&mut self, sim: &mut Sim, edge: Edge, number: u32, drawing: &mut Drawing) {
        let expected = self.page.map_or(EMPTY, |page| {
            let address = drawing.image.address(page as u32, self.followed.offset, self.scans);
            drawing.image.sends(address)
        });
        let name = format!("u_lfb[{number}].word");
        let sent = net(sim, &name);
        if self.page.is_some() || sent != expected {
            let at = At { unit: format!("image memory of PE {number}"), block: "image-memory", edge };
            self.add(
                at.step("sends the pixel and clears it", vec![compared("word", hex(sent), hex(expected))]).on(name),
            );
            self.is_sent |= sent != EMPTY;
        }
        self.sent = sent;
        let [left, right] = ["left", "right"].map(|it| format!("u_merger.u_merging_unit[{number}].{it}"));
        let before = self.inputs[0].min(self.inputs[1]);
        self.inputs = [net(sim, &left), net(sim, &right)];
        if number == 0 {
            self.enters(sim, edge);
        } else if self.inputs[0] != before {
            let values = vec![compared("word", hex(self.inputs[0]), hex(before))];
            let at = At { unit: "image merger".to_owned(), block: "image-merger", edge };
            self.add(at.step(format!("passes the pixel on to merging unit {number}"), values).on(left));
        }
        let sample = format!("u_merger.samples_{number}");
        let came = net(sim, &sample);
        if came != sent {
            let values = vec![compared("word", hex(came), hex(sent))];
            let at = At { unit: format!("wire to merging unit {number}"), block: "vc1", edge };
            self.add(at.step("brings the pixel", values).on(sample));
        }
        if self.inputs[1] != came {
            let values = vec![compared("word", hex(self.inputs[1]), hex(came))];
            let at = At { unit: "image merger".to_owned(), block: "image-merger", edge };
            self.add(at.step(format!("passes the sample on to merging unit {number}"), values).on(right));
        }
    }

    /// The scan goes on after a pause, in which what is sent has to stay.
    pub fn goes_on(&mut self, sim: &mut Sim, edge: Edge) {
        let number = self.clocks / STAGES;
        if self.clocks % STAGES != SCAN_LATENCY || number >= self.processors {
            return;
        }
        let (name, sent) = (format!("u_lfb[{number}].word"), self.sent);
        let held = net(sim, &name);
        if held != sent {
            let at = At { unit: format!("image memory of PE {number}"), block: "image-memory", edge };
            let values = vec![compared("word", hex(held), hex(sent))];
            self.add(at.step("holds the pixel until it is taken", values).on(name));
            self.inputs[1] = net(sim, &format!("u_merger.u_merging_unit[{number}].right"));
        }
    }

    /// The global frame buffer puts the pixel into the chain.
    fn enters(&mut self, sim: &mut Sim, edge: Edge) {
        let left = net(sim, "u_gfb.left");
        let expected = self.background.or(self.before).unwrap_or_default();
        let does = match self.background {
            Some(_) => "puts the background into the chain",
            None => "puts the stored word into the chain",
        };
        let at = At { unit: "global frame buffer".to_owned(), block: "gfb-unit", edge };
        self.add(at.step(does, vec![compared("word", hex(left), hex(expected))]).on("u_gfb.left"));
        if self.inputs[0] != left {
            let at = At { unit: "wire to merging unit 0".to_owned(), block: "vc1", edge };
            let values = vec![compared("word", hex(self.inputs[0]), hex(left))];
            self.add(at.step("brings the pixel", values).on("u_merger.u_merging_unit[0].left"));
        }
    }

    /// A merging unit puts out the nearer word.
    fn merges(&mut self, sim: &mut Sim, edge: Edge, number: u32) {
        let name = format!("u_merger.u_merging_unit[{number}].nearer");
        let nearer = net(sim, &name);
        let [left, right] = self.inputs;
        let input = |what, word| value(what, hex(word));
        let values =
            vec![input("left", left), input("right", right), compared("nearer", hex(nearer), hex(left.min(right)))];
        let at = At { unit: format!("merging unit {number}"), block: "merging-unit", edge };
        self.add(at.step("compares two pixels and passes the nearer one", values).on(name));
        self.inputs = [nearer; 2];
    }

    /// The pixel leaves the chain.
    fn leaves(&mut self, sim: &mut Sim, edge: Edge) {
        let merged = net(sim, "u_gfb.merged");
        let nearer = self.inputs[0];
        if merged != nearer {
            let values = vec![compared("word", hex(merged), hex(nearer))];
            let at = At { unit: "image merger".to_owned(), block: "image-merger", edge };
            self.add(at.step("passes the pixel on to the global frame buffer", values).on("u_gfb.merged"));
        }
        self.inputs = [merged; 2];
    }

    /// The pixel is in the bank.
    fn stores(&mut self, sim: &mut Sim, edge: Edge) {
        let (name, pixel) = (format!("u_gfb.banks[{}]", self.bank), self.followed.number);
        let stored = word(sim, &name, pixel);
        let old = self.before.unwrap_or_default();
        self.is_changed = stored != old;
        let values = vec![value("old word", hex(old)), compared("new word", hex(stored), hex(self.inputs[0]))];
        let at = At { unit: "global frame buffer".to_owned(), block: "gfb-unit", edge };
        self.add(at.step(format!("stores the pixel in bank {}", self.bank), values).on(format!("{name}[{pixel}]")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vc1::Config;
    use tilewright_scenes::Size;
    use tilewright_sim::Simulation;

    #[test]
    fn a_word_that_changes_in_a_pause_is_the_image_memorys() {
        let config = Config { processors: 2, ..Config::new(Size::new(16, 12).unwrap()) };
        let mut sim = Simulation::of(&config.hardware().unwrap()).unwrap();
        sim.reset();
        let followed = Followed { x: 0, y: 0, number: 0, patch: 0, offset: 0 };
        // The frame buffers send nothing.
        for (sent, clocks, blocks) in [(EMPTY, 2, &[][..]), (5, 2, &["image-memory"]), (5, 3, &[])] {
            let mut round = Round { sent, clocks, ..Round::new(followed, 2, (0, None)) };
            round.goes_on(&mut sim, super::super::merge(10));
            assert_eq!(round.steps.iter().map(|step| step.block).collect::<Vec<_>>(), blocks, "{sent} at {clocks}");
        }
    }
}

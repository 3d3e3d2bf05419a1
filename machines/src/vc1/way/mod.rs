//! The way of a pixel through the machine: each unit's values, observed while it works, beside those of a plain model with the same inputs.
//!
//! A model watches all that a unit does, not the followed pixel alone: a page that is given away twice loses a pixel of another patch.
//! What concerns the followed pixel is told in any case. Everything else is told when it differs for the first time.

mod bus;
mod drawing;
mod image;
mod merging;
mod round;
mod sequencer;
mod showing;
mod swaps;
mod wires;

use std::sync::Arc;

use tilewright_rtl::clocks::{CRT, MERGE, PE};
use tilewright_rtl::swap::SwapState;
use tilewright_rtl::vc1::{Vc1, Vc1In, Vc1Out};
use tilewright_scenes::frame::blank;
use tilewright_sim::Simulation;

use super::job::View;
use super::notes::Handshakes;
use super::program::Access;
use crate::error::Error;
use crate::told::{At, Edge, Told, compared, hex};
use crate::way::{Follower, Primitive, Way};
use bus::Bus;
use drawing::Drawing;
use merging::Merging;
use showing::Showing;
use swaps::Swaps;
use wires::Wires;

/// The simulation that is observed.
type Sim = Simulation<Vc1In, Vc1Out>;

/// The followed pixel.
#[derive(Clone, Copy)]
struct Followed {
    x: u32,
    y: u32,
    /// Its number in raster order.
    number: u32,
    /// Its patch, and its place in the patch.
    patch: u32,
    offset: u32,
}

/// The observer of a pixel. It leaves the way when it goes, also after an error.
pub(crate) struct Following {
    follower: Follower,
    followed: Followed,
    background: u64,
    primitives: Vec<Primitive>,
    /// The view whose primitives are known.
    view: Option<Arc<View>>,
    told: Told,
    drawing: Vec<Drawing>,
    bus: Bus,
    swaps: Swaps,
    merging: Merging,
    wires: Wires,
    showing: Showing,
}

impl Following {
    /// One for a machine of these blocks, before its reset.
    pub fn new(follower: &Follower, machine: &Vc1, background: [u8; 3]) -> Following {
        let patches = machine.lfb.patches;
        let [x, y] = follower.pixel;
        let place = patches.place(x, y);
        let number = y * patches.screen().width + x;
        let followed = Followed { x, y, number, patch: place.patch as u32, offset: place.offset as u32 };
        let drawing = |processor| Drawing::new(processor, machine, followed);
        Following {
            follower: follower.clone(),
            followed,
            background: blank(background),
            primitives: Vec::new(),
            view: None,
            told: Told::default(),
            drawing: (0..machine.processors).map(drawing).collect(),
            bus: Bus::new(machine.processors),
            swaps: Swaps::new(machine),
            merging: Merging::new(machine, followed, blank(background)),
            wires: Wires::new(machine),
            showing: Showing::new(machine, followed),
        }
    }

    /// Whether a unit that belongs to the processing elements is under way, so that no clock may be left out.
    pub fn is_busy(&self) -> bool {
        self.drawing.iter().any(Drawing::is_busy)
    }

    /// Notes a frame that the host commands.
    pub fn command(&mut self, view: &Arc<View>) {
        let Followed { x, y, .. } = self.followed;
        let of = |(number, packet): (usize, &tilewright_scenes::Triangle)| {
            let covers = packet.bounds.contains(x, y) && packet.covers(x, y);
            covers.then(|| Primitive {
                number,
                name: format!("triangle {}", packet.polygon),
                golden: Some(packet.word(x, y)),
                hardware: None,
                wins: false,
            })
        };
        self.primitives = view.projection.triangles.iter().enumerate().filter_map(of).collect();
        let least = self.primitives.iter().filter_map(|it| it.golden).min().filter(|word| *word < self.background);
        if let Some(winner) = self.primitives.iter_mut().find(|it| it.golden.is_some() && it.golden == least) {
            winner.wins = true;
        }
        self.bus.command(view);
        self.merging.command();
        self.view = Some(view.clone());
    }

    /// Looks at the units of the processing elements before an edge of their clock. `taken` has the accesses that local frame buffers take at it.
    pub fn before(&mut self, sim: &mut Sim, clock: u64, is_done: bool, taken: impl Iterator<Item = (usize, Access)>) {
        for drawing in self.drawing.iter_mut().filter(|it| it.is_busy()) {
            drawing.look(sim, clock, &mut self.told);
        }
        for (processor, access) in taken {
            let drawing = &mut self.drawing[processor];
            match access {
                Access::Draw(pixel) => {
                    let is_followed = (pixel.x, pixel.y) == (self.followed.x, self.followed.y);
                    let primitive = is_followed.then(|| draws(&mut self.primitives, pixel.word)).flatten();
                    drawing.takes(sim, clock, (pixel, is_followed, primitive), &mut self.told);
                }
                Access::Clear(patch) => {
                    drawing.clears(patch);
                    self.swaps.clears(processor);
                }
                _ => {}
            }
        }
        self.wires.look(sim, clock, &mut self.told);
        let is_done = is_done && self.bus.is_empty();
        self.swaps.before(sim, clock, is_done, &mut self.told);
    }

    /// Notes what a processing element saw at an edge of its clock.
    pub fn processor(&mut self, sim: &mut Sim, clock: u64, number: u32, at: &Handshakes) {
        if let Some(word) = at.sent {
            self.bus.carries(clock, number, word, &mut self.told);
        }
        if let Some(word) = at.received {
            self.bus.receives(sim, clock, (number, word), (&self.primitives, &mut self.told));
        }
        let drawing = &mut self.drawing[number as usize];
        let has_page = drawing.has_page();
        if self.swaps.sees(clock, (number, has_page), at.may, &mut self.told) {
            drawing.swaps(sim, clock, at.may[0] == SwapState::Due, &mut self.told);
            self.merging.swaps(number);
        }
    }

    /// Notes a word of the host that the bus took.
    pub fn host(&mut self, clock: u64, word: super::words::Word) {
        self.bus.carries(clock, self.drawing.len() as u32, word, &mut self.told);
    }

    /// Notes that all have drawn the frame.
    pub fn drawn(&mut self, clock: u64) {
        let missing = self.primitives.iter().filter(|it| it.hardware.is_none());
        missing.for_each(|it| {
            let at = At { unit: "processing elements".to_owned(), block: "vc1", edge: pe(clock) };
            let values = vec![compared("word", "nothing", hex(it.golden.unwrap_or_default()))];
            self.told.tell(at.step("draw the pixel", values).of(Some(it.number)));
        });
    }

    /// Looks at the merger after an edge of its clock.
    pub fn merger(&mut self, sim: &mut Sim, clock: u64) {
        self.merging.look(sim, clock, (&mut self.drawing, &mut self.told));
    }

    /// Notes what ended the run.
    pub fn fails(&mut self, sim: &mut Sim, error: &Error) {
        self.merging.fails(sim, &mut self.told);
        if let Error::Differs { unit, signal, clock, seen, expected } = error
            && !self.told.differs()
        {
            self.is_late(unit, signal, *clock, [*seen, *expected]);
        }
        self.told.fails(error, &[PE.name, MERGE.name, CRT.name], |instance| match instance {
            "u_lfb" => "lfb-unit",
            "u_patch_table" => "patch-table",
            "u_page_id_generator" => "page-id-generator",
            "u_image_memory" => "image-memory",
            "u_scan_counter" => "scan-counter",
            "u_merger" => "image-merger",
            "u_merging_unit" => "merging-unit",
            "u_gfb" => "gfb-unit",
            "u_sequencer" => "gfb-sequencer",
            "u_crt" => "crt-read-out",
            "u_multipass" => "multipass-control",
            "u_accumulation" => "accumulation",
            "u_swap" => "vc1-swap",
            "u_lfb_swap" => "lfb-swap",
            "u_gfb_swap" => "gfb-swap",
            "u_sync_line" => "sync-line",
            "u_bus" => "broadcast-bus",
            "u_queue" => "fifo",
            _ => "vc1",
        });
    }

    /// Tells an event that the model of the machine's clocks expects at another time, where all values were right.
    fn is_late(&mut self, unit: &str, signal: &'static str, clock: u64, [seen, expected]: [u64; 2]) {
        let block = match (unit, signal) {
            ("the bus", _) | (_, "the number of words received" | "the word received") => "broadcast-bus",
            ("the merger", "the number of scan restarts") => "gfb-sequencer",
            ("the merger", _) => "gfb-swap",
            (_, "the number of sync lines seen") => "sync-line",
            (_, "the number of swaps" | "the number of resumptions") => "lfb-swap",
            _ => "patch-table",
        };
        let edge = if unit == "the merger" { merge(clock) } else { pe(clock) };
        let at = At { unit: unit.to_owned(), block, edge };
        self.told.tell(at.step("does what the model of its clocks does", vec![compared(signal, seen, expected)]));
    }

    /// The reset ends after that edge of the display's clock.
    pub fn begins(&mut self, clock: u64) {
        self.showing.begins(clock);
    }

    /// Looks at the display after an edge of its clock.
    pub fn display(&mut self, sim: &mut Sim, clock: u64) {
        self.showing.look(sim, clock, &mut self.told);
    }
}

/// Notes that a word of the pixel was drawn. Returns the number of its primitive.
fn draws(primitives: &mut [Primitive], word: u64) -> Option<usize> {
    let is_it = |it: &&mut Primitive| it.golden == Some(word);
    let (drawn, left): (Vec<_>, Vec<_>) =
        primitives.iter_mut().filter(|it| is_it(it)).partition(|it| it.hardware.is_some());
    let primitive = left.into_iter().chain(drawn).next()?;
    primitive.hardware = Some(word);
    Some(primitive.number)
}

impl Drop for Following {
    fn drop(&mut self) {
        let steps = self.told.take();
        self.follower.put(Way { primitives: std::mem::take(&mut self.primitives), steps });
    }
}

/// An edge of the processing elements' clock, counted from 1 at power-on.
fn pe(number: u64) -> Edge {
    Edge { clock: PE.name, number, time: number * PE.period.picoseconds() }
}

/// An edge of the merger's clock.
fn merge(number: u64) -> Edge {
    Edge { clock: MERGE.name, number, time: number * MERGE.period.picoseconds() }
}

/// The settled value of a net.
fn net(sim: &mut Sim, name: &str) -> u64 {
    let value = sim.peek(name).unwrap_or_else(|unknown| panic!("{unknown}"));
    value.to_u64().expect("it has at most 64 bits")
}

/// A word of a memory.
fn word(sim: &Sim, memory: &str, address: u32) -> u64 {
    let value = sim.peek_memory(memory, address).unwrap_or_else(|unknown| panic!("{unknown}"));
    value.to_u64().expect("it has at most 64 bits")
}

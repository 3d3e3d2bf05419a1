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
mod told;

use std::sync::Arc;

use tilewright_rtl::swap::SwapState;
use tilewright_rtl::vc1::{Vc1, Vc1In, Vc1Out};
use tilewright_scenes::frame::blank;
use tilewright_sim::Simulation;

use super::job::View;
use super::notes::Handshakes;
use super::program::Access;
use crate::way::{Compared, Follower, Primitive, Way};
use bus::Bus;
use drawing::Drawing;
use merging::Merging;
use showing::Showing;
use swaps::Swaps;
use told::Told;

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
        let is_done = is_done && self.bus.is_empty();
        self.swaps.before(sim, clock, is_done, &mut self.told);
    }

    /// Notes what a processing element saw at an edge of its clock.
    pub fn processor(&mut self, sim: &mut Sim, clock: u64, number: u32, at: &Handshakes) {
        if let Some(word) = at.sent {
            self.bus.carries(clock, number, word, &mut self.told);
        }
        if let Some(word) = at.received {
            self.bus.receives(clock, number, word, (&self.primitives, &mut self.told));
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
        missing.for_each(|it| self.told.never_drawn(clock, it));
    }

    /// Looks at the merger after an edge of its clock.
    pub fn merger(&mut self, sim: &mut Sim, clock: u64) {
        self.merging.look(sim, clock, (&mut self.drawing, &mut self.told));
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
        let mut steps = self.told.take();
        // Stable: what happens at the same time keeps its sequence.
        steps.sort_by_key(|step| step.time);
        self.follower.put(Way { primitives: std::mem::take(&mut self.primitives), steps });
    }
}

/// A value in the hardware beside the model's.
fn compared(what: &'static str, hardware: impl ToString, golden: impl ToString) -> Compared {
    Compared { what, hardware: hardware.to_string(), golden: Some(golden.to_string()) }
}

/// A word of a pixel as it is shown.
fn hex(word: u64) -> String {
    format!("{word:012x}")
}

/// `yes` or `no`.
fn yes(holds: bool) -> &'static str {
    if holds { "yes" } else { "no" }
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

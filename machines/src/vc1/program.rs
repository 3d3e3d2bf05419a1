//! The rendering program of a processing element, in tasks that begin one another. Each step is a computation before an access to the local
//! frame buffer or to the bus.
//!
//! Source: section 4, VC1-SW1 and VC1-APR of the paper. After a swap the program clears its patch table, entry by entry (VC1-CLR2), and waits
//! for the host's command. Then it takes its polygons in the sequence of submission: geometry, area, clipping, and for each packet set-up and
//! scan conversion. It sends a packet with an area above a threshold to all processing elements, including itself, and each draws its own rows
//! of it (Figure 12). Between polygons it checks its queue. The program has no notion of time: [`super::processor`] runs it.

use std::sync::Arc;

use tilewright_rtl::swap::SwapState;
use tilewright_scenes::{Size, Triangle};

use super::clocks::Class;
use super::config::Config;
use super::cost::CostTable;
use super::job::View;
use super::scan_conversion::{Pixel, Pixels, Rows};
use super::words::{COMMAND_WORDS, Message, Word};

/// The constants of a processing element for all frames.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings {
    /// Its number.
    pub number: u32,
    /// The number of processing elements.
    pub processors: u32,
    pub size: Size,
    /// Entries of its patch table.
    pub patches: u32,
    pub costs: CostTable,
    /// The area in pixels above which packets are sent to all (VC1-APR).
    pub apr: Option<u32>,
}

impl Settings {
    /// The constants of a machine with that number of entries in a patch table.
    pub fn of(config: &Config, number: u32, patches: u32) -> Settings {
        let Config { size, processors, costs, apr, .. } = *config;
        Settings { number, processors, size, patches, costs, apr }
    }

    /// Whether all processing elements draw a packet.
    pub fn is_large(apr: Option<u32>, packet: &Triangle) -> bool {
        apr.is_some_and(|threshold| packet.area() > f64::from(threshold))
    }

    /// Its rows of a packet that all draw (Figure 12).
    pub fn rows(&self) -> Rows {
        Rows { first: self.number, every: self.processors }
    }
}

/// An access at one of its ports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Access {
    /// Clears the patch-table entry of a patch.
    Clear(u32),
    /// Draws a pixel.
    Draw(Pixel),
    /// Puts a word into the port to the bus.
    Send(Word),
    /// Takes a word from its queue.
    Receive,
}

/// The next step of a task.
pub(crate) enum Next {
    /// Computes for this number of clocks, including that of the access if it is taken at once.
    Step { clocks: u64, class: Class, access: Option<Access> },
    /// Runs another task before it resumes.
    Begin(Task),
    /// Does nothing for a clock.
    Wait,
    /// The task is over.
    End,
}

/// The inputs of the program when a task resumes.
pub(crate) struct Sight {
    /// Whether a word waits in the queue.
    pub word: bool,
    /// The swap control's signals.
    pub may: SwapState,
}

/// A part of the program.
pub(crate) enum Task {
    /// From swap to swap; never over.
    Frames(Phase),
    /// Clears the patch table, from that entry on.
    Clear { patch: u32 },
    /// The polygons of a frame.
    Polygons(Polygons),
    /// Draws a packet.
    Scan(Box<Scan>),
    /// Sets up a packet without rows for this processing element, for this number of clocks.
    SetUp { clocks: u64 },
    /// Sends a packet.
    Send { words: Vec<Word>, at: usize },
    /// Receives a packet, of which these words have arrived.
    Receive { words: Vec<u32> },
}

/// The state of a program in its frame.
pub(crate) enum Phase {
    /// Its table has to be cleared.
    Swapped,
    /// The command has to come.
    Cleared,
    /// The command has arrived.
    Commanded(Arc<View>),
    /// All its own polygons are drawn or sent.
    Drawn,
}

/// The polygons of a frame.
pub(crate) struct Polygons {
    view: Arc<View>,
    /// The next polygon, by index.
    polygon: usize,
    /// The geometry of that polygon is over.
    is_transformed: bool,
    /// The remaining packets of the polygon before.
    rest: std::ops::Range<usize>,
}

/// A packet being drawn.
pub(crate) struct Scan {
    pixels: Pixels,
    /// The next one.
    pixel: Option<Pixel>,
    rows: Rows,
    /// The first row whose cost has not been counted.
    row: u32,
    bottom: u32,
    /// Remaining clocks of set-up.
    set_up: u64,
}

impl Task {
    /// Draws a packet in those rows.
    fn scan(packet: &Triangle, rows: Rows, costs: &CostTable) -> Task {
        let mut pixels = Pixels::of(packet, rows);
        Task::Scan(Box::new(Scan {
            pixel: pixels.next(),
            pixels,
            rows,
            row: packet.bounds.top,
            bottom: packet.bounds.bottom,
            set_up: costs.set_up,
        }))
    }

    /// Draws its rows of a polygon that all draw. Most processing elements have no row of a small polygon.
    pub fn share(packet: &Triangle, settings: &Settings) -> Task {
        let rows = settings.rows();
        match rows.count(packet.bounds.top, packet.bounds.bottom) {
            0 => Task::SetUp { clocks: settings.costs.set_up },
            _ => Task::scan(packet, rows, &settings.costs),
        }
    }

    /// Receives a packet.
    pub fn receive() -> Task {
        Task::Receive { words: Vec::with_capacity(COMMAND_WORDS) }
    }

    /// The next step.
    pub fn next(&mut self, sight: &Sight, settings: &Settings) -> Next {
        let costs = &settings.costs;
        match self {
            Task::Frames(phase) => phase.next(sight),
            Task::Clear { patch } if *patch == settings.patches => Next::End,
            Task::Clear { patch } => {
                *patch += 1;
                let access = Some(Access::Clear(*patch - 1));
                Next::Step { clocks: costs.clear, class: Class::Clearing, access }
            }
            Task::Polygons(polygons) => polygons.next(sight, settings),
            Task::Scan(scan) => scan.next(costs),
            Task::SetUp { clocks: 0 } => Next::End,
            Task::SetUp { clocks } => {
                Next::Step { clocks: std::mem::take(clocks), class: Class::Rasterization, access: None }
            }
            Task::Send { words, at } => match words.get(*at) {
                Some(word) => {
                    *at += 1;
                    Next::Step { clocks: costs.send, class: Class::Sending, access: Some(Access::Send(*word)) }
                }
                None => Next::End,
            },
            Task::Receive { .. } => {
                Next::Step { clocks: costs.receive, class: Class::Receiving, access: Some(Access::Receive) }
            }
        }
    }
}

impl Phase {
    fn next(&mut self, sight: &Sight) -> Next {
        match self {
            Phase::Swapped if sight.may == SwapState::Clear => {
                *self = Phase::Cleared;
                Next::Begin(Task::Clear { patch: 0 })
            }
            Phase::Cleared | Phase::Drawn if sight.word => Next::Begin(Task::receive()),
            Phase::Commanded(view) => {
                let view = view.clone();
                *self = Phase::Drawn;
                Next::Begin(Task::Polygons(Polygons { view, polygon: 0, is_transformed: false, rest: 0..0 }))
            }
            _ => Next::Wait,
        }
    }
}

impl Polygons {
    /// The number of polygons that are not begun.
    pub fn left(&self, number: u32) -> usize {
        self.view.polygons(number).len() - self.polygon
    }

    fn next(&mut self, sight: &Sight, settings: &Settings) -> Next {
        if let Some(index) = self.rest.next() {
            let packet = &self.view.projection.triangles[index];
            if Settings::is_large(settings.apr, packet) {
                let vertices = self.view.projection.vertices[index];
                let words = Message::Polygon { sender: settings.number, vertices }.words();
                return Next::Begin(Task::Send { words, at: 0 });
            }
            return Next::Begin(Task::scan(packet, Rows::ALL, &settings.costs));
        }
        if sight.word && !self.is_transformed {
            return Next::Begin(Task::receive());
        }
        let Some(polygon) = self.view.polygons(settings.number).get(self.polygon) else { return Next::End };
        let (clocks, class) = match self.is_transformed {
            false => (settings.costs.geometry(polygon), Class::Geometry),
            true => {
                self.polygon += 1;
                self.rest = polygon.packets.clone();
                (settings.costs.preparation(polygon), Class::Rasterization)
            }
        };
        self.is_transformed = !self.is_transformed;
        Next::Step { clocks, class, access: None }
    }
}

impl Scan {
    /// Whether a pixel is left.
    pub fn has_pixel(&self) -> bool {
        self.pixel.is_some()
    }

    fn next(&mut self, costs: &CostTable) -> Next {
        let set_up = std::mem::take(&mut self.set_up);
        let pixel = self.pixel;
        self.pixel = pixel.and_then(|_| self.pixels.next());
        if pixel.is_none() && self.row > self.bottom && set_up == 0 {
            return Next::End;
        }
        let end = pixel.map_or(self.bottom, |pixel| pixel.y);
        // Most pixels are in the same row as the one before.
        let rows = if self.row > end { 0 } else { self.rows.count(self.row, end) };
        self.row = self.row.max(end + 1);
        let clocks = set_up + u64::from(rows) * costs.row + if pixel.is_some() { costs.pixel } else { 0 };
        Next::Step { clocks, class: Class::Rasterization, access: pixel.map(Access::Draw) }
    }
}

#[cfg(test)]
mod tests;

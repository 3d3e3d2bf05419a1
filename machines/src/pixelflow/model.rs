//! The transaction model: the times of all nodes' work for one frame, without a circuit.
//!
//! ```text
//! front end    |--- transform ---|
//! rasterizers                    |--- region 0 ---|--- region 1 ---|--- region 2 ---|
//! network, one way                                |- 0 -|          |- 1 -|          |- 2 -|
//! shaders                                               |--- 0 ---|      |--- 1 ---|      |--- 2 ---|
//! network, the other way                                          |0|              |1|              |2|
//! frame buffer                                                      |- 0 -|          |- 1 -|          |- 2 -|
//! ```
//!
//! Every node has two banks of registers for the network, so it works on a region while the one before is sent. It waits when both are in use. A
//! rasterizer waits for the composition of the region before the last, and the network for a shader that has not yet read its last region.
//!
//! The times of arrays and banks follow from the paper's costs ([`Frame`]), or from the instructions of a frame on the hardware (`programs`). The
//! delays that circuits add are in `delays`; the paper's systems have none.
//!
//! A system without sorting has all regions in the pixels' memory: [`Resident`].

use serde::Serialize;
use std::ops::Range;

use super::costs::Ticks;
use super::workload::{Share, Workload};
use delays::Delays;
use rasterizer::Rasterizer;
use run::{Run, Shaded, Stored};

mod delays;
mod direction;
mod programs;
mod rasterizer;
mod resident;
mod run;

pub(super) use programs::{Built, Timing};
pub use resident::{Pass, Resident};

/// The stages of a region behind the rasterizers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Turn {
    /// The region.
    pub region: u16,
    /// Appearance words on the network, with their set-up.
    pub composes: Ticks,
    /// A shader's work on them; `None` if they go directly to the frame buffer.
    pub shades: Option<Shading>,
    /// Loading the frame buffer's memory; 0 if another turn of the same pixels follows.
    pub loads: Ticks,
}

/// A shader's work on a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shading {
    /// The shader.
    pub shader: usize,
    /// The time of its work.
    pub takes: Ticks,
    /// Colours on the network; 0 if it keeps them until the next samples of the same pixels.
    pub sends: Ticks,
}

/// When the front end has the instructions of the rasterizers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrontEnd {
    /// The whole frame before rasterization; each primitive takes this time.
    Before(Ticks),
    /// After a first pass, primitive by primitive in the sequence of rasterization.
    TwoPasses {
        /// The time of a primitive in the first pass.
        sorts: Ticks,
        /// The time in the second pass.
        generates: Ticks,
    },
}

/// A frame of a system that works region by region.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// The primitives.
    pub workload: &'a Workload,
    /// The time before a node's first primitive.
    pub overhead: Ticks,
    /// When primitives are available.
    pub front_end: FrontEnd,
    /// All turns, in the sequence of the network. A region that occurs twice is rasterized twice.
    pub turns: Vec<Turn>,
    /// The number of shaders.
    pub shaders: usize,
    /// Whether colours share the wires of the appearance words, instead of going the other way in parallel.
    pub one_way: bool,
}

/// The times of a turn.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Done {
    /// The last rasterizer.
    pub rasterized: Ticks,
    /// On the network.
    pub composed: Range<Ticks>,
    /// In a shader.
    pub shaded: Range<Ticks>,
    /// On the network, to the frame buffer.
    pub sent: Range<Ticks>,
    /// In its memory.
    pub loaded: Range<Ticks>,
}

/// A frame in time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Timeline {
    /// The end of each rasterizer's first pass, or of its only one.
    pub front: Vec<Ticks>,
    /// The time of each rasterizer's front end during rasterization.
    pub generated: Vec<Ticks>,
    /// The time of each rasterizer's drawing, without waiting.
    pub drawn: Vec<Ticks>,
    /// The times of each turn.
    pub turns: Vec<Done>,
}

impl Timeline {
    /// The time from the frame's beginning to its last pixel in the frame buffer.
    pub fn latency(&self) -> Ticks {
        self.turns.last().map_or(0, |last| last.loaded.end)
    }
}

impl Frame<'_> {
    /// Runs the frame.
    ///
    /// ```
    /// use tilewright_machines::pixelflow::{Frame, FrontEnd, Shading, Turn, Workload};
    ///
    /// // Two regions, 3 primitives of 10 ticks in each, on one rasterizer.
    /// let workload = Workload::balanced(1, 2, 3, 10);
    /// let turn = |region| {
    ///     let shading = Shading { shader: 0, takes: 100, sends: 5 };
    ///     Turn { region, composes: 20, shades: Some(shading), loads: 8 }
    /// };
    /// let turns = vec![turn(0), turn(1)];
    /// let frame = Frame { workload: &workload, overhead: 7, front_end: FrontEnd::Before(2), turns, shaders: 1, one_way: false };
    /// let time = frame.run();
    /// assert_eq!(time.front, [7 + 6 * 2]);
    /// assert_eq!((time.turns[0].rasterized, time.turns[0].composed.clone()), (49, 49..69));
    /// // The shader is the slowest.
    /// assert_eq!((time.turns[0].shaded.clone(), time.turns[1].shaded.clone()), (69..169, 169..269));
    /// assert_eq!(time.latency(), 269 + 5 + 8);
    /// ```
    pub fn run(&self) -> Timeline {
        let costs = ByCosts { rasterizers: self.rasterizers(), shaders: vec![0; self.shaders], written: 0 };
        let front = costs.rasterizers.iter().map(Rasterizer::time).collect();
        let run = Run::new(costs, Delays::default(), &self.turns, self.one_way).run();
        let of = |of: fn(&Rasterizer) -> Ticks| run.arrays.rasterizers.iter().map(of).collect();
        Timeline { front, generated: of(Rasterizer::generated), drawn: of(Rasterizer::drawn), turns: run.done }
    }

    /// The rasterizers, at the times at which their front ends let them begin.
    fn rasterizers(&self) -> Vec<Rasterizer> {
        let (first, second) = match self.front_end {
            FrontEnd::Before(transforms) => (transforms, 0),
            FrontEnd::TwoPasses { sorts, generates } => (sorts, generates),
        };
        let pass = |share: &Share| self.overhead + first * share.primitives() as Ticks;
        let fronts = || self.workload.shares.iter().map(pass);
        // All nodes take the next frame of a pipe together.
        let together = matches!(self.front_end, FrontEnd::Before(_)).then(|| fronts().max().unwrap_or(0));
        let regions = self.workload.regions;
        let begin =
            |share: &Share| Rasterizer::new(share.bins(regions), second, together.unwrap_or_else(|| pass(share)));
        self.workload.shares.iter().map(begin).collect()
    }
}

/// The use of banks by nodes.
trait Arrays {
    /// The numbers of rasterizers and of shaders.
    fn counts(&self) -> [usize; 2];
    /// The time at which each shader first gives its bank for words.
    fn first_words(&mut self) -> Vec<Ticks>;
    /// The times at which the node of the frame buffer first gives each of its banks.
    fn first_stores(&mut self) -> [Ticks; 2];
    /// All rasterizers draw a turn, each when its bank is free. Returns the times at which they give it to the network.
    fn draw(&mut self, number: usize, turn: &Turn, free: &[Ticks]) -> Vec<Ticks>;
    /// A shader works on the words of a turn, which have arrived at that time. Its earlier colours were sent by `sent`.
    fn shade(&mut self, number: usize, shading: &Shading, arrived: Ticks, sent: Ticks) -> Shaded;
    /// Words that have arrived at that time go into the frame buffer's memory.
    fn load(&mut self, number: usize, turn: &Turn, arrived: Ticks) -> Stored;
}

/// Nodes with the paper's times.
struct ByCosts {
    rasterizers: Vec<Rasterizer>,
    /// The time until which each shader works.
    shaders: Vec<Ticks>,
    /// The time until which the frame buffer's memory is written.
    written: Ticks,
}

impl Arrays for ByCosts {
    fn counts(&self) -> [usize; 2] {
        [self.rasterizers.len(), self.shaders.len()]
    }

    fn first_words(&mut self) -> Vec<Ticks> {
        vec![0; self.shaders.len()]
    }

    fn first_stores(&mut self) -> [Ticks; 2] {
        [0; 2]
    }

    fn draw(&mut self, _: usize, turn: &Turn, free: &[Ticks]) -> Vec<Ticks> {
        self.rasterizers.iter_mut().zip(free).map(|(it, free)| it.draw(turn.region, *free)).collect()
    }

    fn shade(&mut self, _: usize, &Shading { shader, takes, .. }: &Shading, arrived: Ticks, _: Ticks) -> Shaded {
        let at = after([arrived, self.shaders[shader]], takes);
        self.shaders[shader] = at.end;
        // Its bank for new words is not the one on which it works.
        Shaded { next_word: at.start, at }
    }

    fn load(&mut self, _: usize, turn: &Turn, arrived: Ticks) -> Stored {
        let at = after([arrived, self.written], turn.loads);
        if turn.loads > 0 {
            self.written = at.end;
        }
        Stored { given: at.end, at }
    }
}

/// A stage that begins when all of these have ended.
fn after<const N: usize>(ends: [Ticks; N], takes: Ticks) -> Range<Ticks> {
    let begin = ends.into_iter().max().unwrap_or(0);
    begin..begin + takes
}

#[cfg(test)]
mod tests;

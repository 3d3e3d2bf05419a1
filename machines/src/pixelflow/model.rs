//! The transaction model: when each node has done what, for one frame, without a circuit.
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
//! Every node has two banks of registers for the network, so it works on a region while the one before is sent, and waits when both are
//! taken: a rasterizer for the composition of the region before the last, the network for the shader that has not yet looked at its last one.
//!
//! How long arrays work, and when they have done with a bank, is of two kinds: by the paper's costs ([`Frame`]), or by the instructions of a frame as the
//! hardware takes them (`programs`). What circuits add to that is in `delays`, and the paper's systems have none of it.
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
    /// Appearance words on the network, with what is set up for them.
    pub composes: Ticks,
    /// A shader's work on them; none if they go to the frame buffer as they are.
    pub shades: Option<Shading>,
    /// Into the frame buffer's memory; 0 if another turn of the same pixels is to come.
    pub loads: Ticks,
}

/// What a shader does with a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shading {
    /// Which shader.
    pub shader: usize,
    /// Its work.
    pub takes: Ticks,
    /// Colours on the network; 0 if it keeps them until the next samples of the same pixels.
    pub sends: Ticks,
}

/// When the front end has what rasterizers need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrontEnd {
    /// All of the frame, before any of it is rasterized: each primitive takes so long.
    Before(Ticks),
    /// After a first pass, primitive by primitive, in the order in which they are rasterized.
    TwoPasses {
        /// The first pass over a primitive.
        sorts: Ticks,
        /// The second.
        generates: Ticks,
    },
}

/// A frame of a system that works region by region.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// What is drawn.
    pub workload: &'a Workload,
    /// Before a node's first primitive.
    pub overhead: Ticks,
    /// When primitives are there.
    pub front_end: FrontEnd,
    /// All stages, in the order of the network. A region that comes twice is rasterized twice.
    pub turns: Vec<Turn>,
    /// Shaders.
    pub shaders: usize,
    /// Colours share the wires of the appearance words, in place of going the other way beside them.
    pub one_way: bool,
}

/// When what of a turn was done.
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
    /// Into its memory.
    pub loaded: Range<Ticks>,
}

/// A frame in time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Timeline {
    /// The end of each rasterizer's first pass, or of its only one.
    pub front: Vec<Ticks>,
    /// What each rasterizer's front end did while it rasterized.
    pub generated: Vec<Ticks>,
    /// What each rasterizer drew, without waiting.
    pub drawn: Vec<Ticks>,
    /// Each turn.
    pub turns: Vec<Done>,
}

impl Timeline {
    /// From the frame's beginning to its last pixel in the frame buffer.
    pub fn latency(&self) -> Ticks {
        self.turns.last().map_or(0, |last| last.loaded.end)
    }
}

impl Frame<'_> {
    /// Lets the frame run.
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

    /// The rasterizers when their front ends let them begin.
    fn rasterizers(&self) -> Vec<Rasterizer> {
        let (first, second) = match self.front_end {
            FrontEnd::Before(transforms) => (transforms, 0),
            FrontEnd::TwoPasses { sorts, generates } => (sorts, generates),
        };
        let pass = |share: &Share| self.overhead + first * share.primitives() as Ticks;
        let fronts = || self.workload.shares.iter().map(pass);
        // Of frames in a pipe all nodes take the next one together.
        let together = matches!(self.front_end, FrontEnd::Before(_)).then(|| fronts().max().unwrap_or(0));
        let regions = self.workload.regions;
        let begin =
            |share: &Share| Rasterizer::new(share.bins(regions), second, together.unwrap_or_else(|| pass(share)));
        self.workload.shares.iter().map(begin).collect()
    }
}

/// What nodes do with their banks.
trait Arrays {
    /// Rasterizers, and shaders.
    fn counts(&self) -> [usize; 2];
    /// When each shader gives its bank for words first.
    fn first_words(&mut self) -> Vec<Ticks>;
    /// When the holder of the frame gives each of its banks first.
    fn first_stores(&mut self) -> [Ticks; 2];
    /// All rasterizers draw a turn, each when its bank is free; when they give it to the network.
    fn draw(&mut self, number: usize, turn: &Turn, free: &[Ticks]) -> Vec<Ticks>;
    /// A shader works on what has arrived of a turn by then. Its colours of before were sent by that time.
    fn shade(&mut self, number: usize, shading: &Shading, arrived: Ticks, sent: Ticks) -> Shaded;
    /// What has arrived by then goes into the frame buffer's memory.
    fn load(&mut self, number: usize, turn: &Turn, arrived: Ticks) -> Stored;
}

/// Nodes that take as long as the paper says.
struct ByCosts {
    rasterizers: Vec<Rasterizer>,
    /// Until when each shader works.
    shaders: Vec<Ticks>,
    /// Until when the frame buffer's memory is written.
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
        // It has another bank for words than for those that it works on.
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

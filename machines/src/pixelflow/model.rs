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
//! A system without sorting has all regions in the pixels' memory: [`Resident`].

use serde::Serialize;
use std::collections::VecDeque;
use std::ops::Range;

use super::costs::Ticks;
use super::workload::{Share, Workload};
use rasterizer::Rasterizer;

mod rasterizer;
mod resident;

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

/// Who is busy until when.
#[derive(Clone, Default)]
struct Banks {
    /// The ends of the last two uses of what follows: a bank is free again when the one before the last has ended.
    ends: [Ticks; 2],
}

impl Banks {
    /// When there is one.
    fn free(&self) -> Ticks {
        self.ends[0]
    }

    fn used_until(&mut self, end: Ticks) {
        self.ends = [self.ends[1], end];
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
        let mut run = Run {
            frame: self,
            rasterizers: self.rasterizers(),
            shaders: vec![(0, Banks::default()); self.shaders],
            network: 0,
            back: 0,
            store: Banks::default(),
            written: 0,
            turns: Vec::with_capacity(self.turns.len()),
            waiting: VecDeque::new(),
        };
        let front = run.rasterizers.iter().map(Rasterizer::time).collect();
        self.turns.iter().for_each(|turn| run.turn(turn));
        while run.send_first(None) {}
        let [generated, drawn] =
            [Rasterizer::generated, Rasterizer::drawn].map(|of| run.rasterizers.iter().map(of).collect());
        Timeline { front, generated, drawn, turns: run.turns }
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

/// A frame that runs.
struct Run<'a> {
    frame: &'a Frame<'a>,
    rasterizers: Vec<Rasterizer>,
    /// Until when each has work, and its banks.
    shaders: Vec<(Ticks, Banks)>,
    /// Until when the network is taken, and until when the other way.
    network: Ticks,
    back: Ticks,
    /// Those of the frame buffer, and until when it writes its memory.
    store: Banks,
    written: Ticks,
    turns: Vec<Done>,
    /// Turns whose colours are not yet sent.
    waiting: VecDeque<usize>,
}

impl Run<'_> {
    fn turn(&mut self, turn: &Turn) {
        let rasterized = self.rasterizers.iter_mut().map(|it| it.draw(turn.region)).max().unwrap_or(0);
        let taken = match turn.shades {
            Some(shading) => self.shaders[shading.shader].1.free(),
            None => self.store.free(),
        };
        // Colours that are there go first.
        while self.send_first(Some(rasterized.max(taken).max(self.network))) {}
        let composed = after([rasterized, self.network, taken], turn.composes);
        self.network = composed.end;
        self.rasterizers.iter_mut().for_each(|it| it.composed_until(composed.end));

        let shaded = match turn.shades {
            None => composed.end..composed.end,
            Some(Shading { shader, takes, .. }) => {
                let (busy, banks) = &mut self.shaders[shader];
                let shaded = after([composed.end, *busy], takes);
                *busy = shaded.end;
                banks.used_until(shaded.end);
                shaded
            }
        };
        let nothing = shaded.end..shaded.end;
        self.waiting.push_back(self.turns.len());
        self.turns.push(Done { rasterized, composed, shaded, sent: nothing.clone(), loaded: nothing });
        if !self.frame.one_way {
            self.send_first(None);
        }
    }

    /// Sends the colours that wait first, if they are there by that time; tells whether they were.
    fn send_first(&mut self, by: Option<Ticks>) -> bool {
        let is_there = |&number: &usize| by.is_none_or(|by| self.turns[number].shaded.end <= by);
        let Some(number) = self.waiting.front().copied().filter(is_there) else { return false };
        self.waiting.pop_front();
        let (turn, done) = (&self.frame.turns[number], &mut self.turns[number]);
        let sends = turn.shades.map_or(0, |shading| shading.sends);
        if sends > 0 {
            let wires = if self.frame.one_way { &mut self.network } else { &mut self.back };
            done.sent = after([done.shaded.end, *wires, self.store.free()], sends);
            *wires = done.sent.end;
        }
        done.loaded = after([done.sent.end, self.written], turn.loads);
        if turn.loads > 0 {
            self.written = done.loaded.end;
            self.store.used_until(done.loaded.end);
        }
        true
    }
}

/// A stage that begins when all of these have ended.
fn after<const N: usize>(ends: [Ticks; N], takes: Ticks) -> Range<Ticks> {
    let begin = ends.into_iter().max().unwrap_or(0);
    begin..begin + takes
}

#[cfg(test)]
mod tests;

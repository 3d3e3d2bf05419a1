//! A frame for each eye: both at once, each on half of the nodes, or one after another on all nodes (section 3 of the paper).
//!
//! ```text
//! halved       left   |front end|-- drawn --|          sequential   |front end| front end |
//!              right  |front end|-- drawn --|                       ,---------|-- left --|-- right --|
//! ```
//!
//! A half is a separate machine: its nodes, the network between them, and a node with its frame buffer. One after another, the front end continues
//! with the right eye while the left eye's frame is drawn. Each unit does so as soon as it has finished the left frame. So the second frame runs as it
//! would alone, only later. A front end that works in parallel with the rasterizers waits with them.

use serde::Serialize;
use std::fmt;
use std::ops::Range;

use tilewright_rtl::parameter::ParameterError;

use super::config::Config;
use super::costs::{Ticks, milliseconds};
use super::latency::Nodes;
use super::model::Done;
use super::report::Report;

/// The way in which the frames of two eyes share a machine.
///
/// ```
/// use tilewright_machines::pixelflow::{Config, Nodes, Stereo};
/// use tilewright_scenes::Size;
///
/// let half = Stereo::Halved.eye(&Config::new(Size::VGA))?;
/// assert_eq!((half.nodes, half.roles()?), (10, Nodes { rasterizers: 7, shaders: 2 }));
/// assert_eq!(Stereo::Sequential.eye(&Config::new(Size::VGA))?.nodes, 20);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stereo {
    /// Both at once, each on half of the nodes.
    Halved,
    /// The left one, then the right one, on all nodes.
    Sequential,
}

impl Stereo {
    /// The machine for the frame of an eye. Half of a machine has half of its shaders, rounded up.
    ///
    /// # Errors
    /// The number of nodes is odd for halves, or too small.
    pub fn eye(self, config: &Config) -> Result<Config, ParameterError> {
        if self == Stereo::Sequential {
            return Ok(config.clone());
        }
        let nodes = config.nodes;
        if !nodes.is_multiple_of(2) {
            return Err(ParameterError(format!("{nodes} nodes have no halves for two eyes: give an even number")));
        }
        let half = Config { nodes: nodes / 2, shaders: config.shaders.div_ceil(2), ..config.clone() };
        half.roles().map_err(|ParameterError(problem)| ParameterError(format!("in each half, {problem}")))?;
        Ok(half)
    }

    /// The roles in one half, or in the whole machine.
    ///
    /// # Panics
    /// A half has none to rasterize.
    pub(super) fn nodes(self, Nodes { rasterizers, shaders }: Nodes) -> Nodes {
        if self == Stereo::Sequential {
            return Nodes { rasterizers, shaders };
        }
        let (half, shaders) = ((rasterizers + shaders).div_ceil(2), shaders.div_ceil(2));
        assert!(half > shaders + 1, "half of {rasterizers} rasterizers and {shaders} shaders leaves none to rasterize");
        Nodes { rasterizers: half - 1 - shaders, shaders }
    }
}

/// The report of the frames of two eyes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StereoReport {
    /// The way in which they shared the machine.
    pub stereo: Stereo,
    /// The distance between the eyes, in the scene's unit.
    pub eye_distance: f64,
    /// For the left and the right eye's frame, the time at which it was in the frame buffer, in ticks of 5 ns from the beginning of the first front end.
    pub ends: [Ticks; 2],
    /// The report of the left eye's frame, counted from its own beginning.
    pub left: Report,
    /// Likewise.
    pub right: Report,
}

impl StereoReport {
    /// The report of the left and the right eye's frame, each of which was drawn alone.
    pub fn new(stereo: Stereo, eye_distance: f64, [left, right]: [Report; 2]) -> StereoReport {
        let second = match stereo {
            Stereo::Halved => right.latency(),
            Stereo::Sequential => {
                let front_end = left.front + left.second;
                let drawn = (left.delay() + follows(&left, &right)).max(front_end + right.delay());
                drawn + right.back()
            }
        };
        StereoReport { stereo, eye_distance, ends: [left.latency(), second], left, right }
    }

    /// Ticks from the beginning to both frames in the frame buffers.
    pub fn latency(&self) -> Ticks {
        self.ends[0].max(self.ends[1])
    }

    /// Simulated picoseconds of both, after their front ends.
    pub fn picoseconds(&self) -> u64 {
        self.left.picoseconds() + self.right.picoseconds()
    }
}

/// The ticks by which a frame has to begin after another one on the same nodes, so that no unit works on both. Both are counted after their front ends.
fn follows(first: &Report, second: &Report) -> Ticks {
    let (network, works, buffer) = (|it: &Done| it.composed.clone(), |it: &Done| it.shaded.clone(), colours(second));
    let units = [
        // Rasterizers, until the network has their last words.
        (end(first, network), 0),
        // Shaders, or the array of the frame buffer's node.
        (end(first, works), start(second, network)),
        // The frame buffer: banks for colours, and memory.
        (end(first, |it| it.loaded.clone()), start(second, buffer)),
    ];
    units.into_iter().map(|(end, start)| end.saturating_sub(start)).max().unwrap_or(0)
}

/// The time at which colours arrive at the frame buffer.
fn colours(report: &Report) -> fn(&Done) -> Range<Ticks> {
    if report.shaders.is_empty() { |it| it.composed.clone() } else { |it| it.sent.clone() }
}

/// The time at which a unit has finished a frame.
fn end(report: &Report, of: impl Fn(&Done) -> Range<Ticks>) -> Ticks {
    report.turns.iter().map(|turn| of(turn).end).max().unwrap_or(0)
}

/// The time at which a unit begins with a frame. It does not work in all turns.
fn start(report: &Report, of: impl Fn(&Done) -> Range<Ticks>) -> Ticks {
    report.turns.iter().map(of).find(|range| !range.is_empty()).map_or(0, |range| range.start)
}

/// A number with about four significant digits.
fn four_digits(number: f64) -> String {
    let places = if number > 0.0 { 3.0 - number.log10().floor() } else { 0.0 };
    format!("{number:.*}", places.clamp(0.0, 12.0) as usize)
}

impl fmt::Display for StereoReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let how = match self.stereo {
            Stereo::Halved => "both at once, each on half of the nodes",
            Stereo::Sequential => "one after another on all nodes",
        };
        writeln!(f, "two eyes, {} apart, {how}\n", four_digits(self.eye_distance))?;
        writeln!(f, "left eye: {}\n\nright eye: {}\n", self.left, self.right)?;
        let [left, right] = self.ends.map(milliseconds);
        write!(
            f,
            "The left frame is ready after {left:.3} ms, the right one after {right:.3} ms: {:.3} ms for both.",
            left.max(right)
        )
    }
}

#[cfg(test)]
mod tests;

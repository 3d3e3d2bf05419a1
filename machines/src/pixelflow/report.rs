//! The report of a frame.

use serde::Serialize;
use std::fmt;
use std::ops::Range;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::frame_buffer::FrameBuffer;
use tilewright_scenes::Field;

use super::config::Config;
use super::costs::{Ticks, milliseconds, ticks};
use super::latency::System;
use super::model::Done;
use super::works::Works;

/// The report of a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The software.
    pub system: System,
    /// Columns and rows of pixels.
    pub size: [u32; 2],
    /// `even` or `odd`, if only these lines of the picture were drawn; `size` is that of the field.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field: Option<&'static str>,
    /// Samples of a pixel.
    pub samples: u32,
    /// Whether a pixel is shaded once, not each sample.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub shaded_once: bool,
    /// Nodes, including that of the frame buffer.
    pub nodes: u32,
    /// Pixels of an array along x and y.
    pub array: [u32; 2],
    /// Each node that rasterized.
    pub rasterizers: Vec<NodeReport>,
    /// Each node that shaded.
    pub shaders: Vec<NodeReport>,
    /// The circuit of the frame buffer.
    #[serde(skip)]
    pub frame_buffer: FrameBuffer,
    /// Clocks of 10 ns in which the array of the frame buffer's node had an instruction, or waited for the frame buffer.
    pub holder: u64,
    /// Primitives.
    pub primitives: usize,
    /// Primitives in all regions; a primitive counts once for each of its regions.
    pub drawn: usize,
    /// The front end's time for the rasterizer with most primitives, by the paper's costs, in ticks of 5 ns.
    pub front: Ticks,
    /// The time from its end to that of the last rasterizer's second pass, if primitives are sorted in a first pass.
    pub second: Ticks,
    /// The times of each region, or of each sample of one, in ticks from the first instruction on. If the front end works in parallel, they are counted from
    /// its beginning.
    pub turns: Vec<Done>,
}

/// The name of a field.
fn field_name(field: Field) -> &'static str {
    match field {
        Field::Even => "even",
        Field::Odd => "odd",
    }
}

/// The numbers of a node.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NodeReport {
    /// Primitives that were assigned to it.
    pub primitives: usize,
    /// Clocks of 10 ns in which its array had an instruction.
    pub busy: u64,
}

/// A stage of a frame: its work, its begin and its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stage {
    /// Its name.
    pub name: &'static str,
    /// Ticks of its busiest unit.
    pub busy: Ticks,
    /// Its first tick, counted from the first instruction.
    pub from: Ticks,
    /// The tick after its last one, counted likewise.
    pub to: Ticks,
}

impl Report {
    pub(super) fn new(
        config: &Config,
        works: &Works,
        turns: Vec<Done>,
        busy: [Vec<u64>; 2],
        holder: u64,
    ) -> Result<Report, ParameterError> {
        let costs = &config.costs;
        let (transforms, system) = match (works.is_shaded(), config.pre_sort) {
            (true, false) => (costs.transform, System::Base),
            (true, true) => (costs.sort, System::PreSort),
            (false, _) => (costs.transform_plain, System::NonTexturing),
        };
        let most = works.primitives.iter().copied().max().unwrap_or(0) as Ticks;
        let front = ticks(costs.overhead) + ticks(transforms) * most;
        let [rasterizers, shaders] = busy;
        let rasterizer = |(&primitives, busy)| NodeReport { primitives, busy };
        Ok(Report {
            system,
            size: [works.size().width(), works.size().height()],
            field: config.field.map(field_name),
            samples: works.samples(),
            shaded_once: works.shades_once(),
            nodes: config.nodes,
            array: config.array,
            rasterizers: works.primitives.iter().zip(rasterizers).map(rasterizer).collect(),
            shaders: shaders.into_iter().map(|busy| NodeReport { primitives: 0, busy }).collect(),
            frame_buffer: works.frame_buffer()?,
            holder,
            primitives: works.primitives.iter().sum(),
            drawn: works.drawn,
            front,
            // No instructions are made for primitives outside of all regions.
            second: if system == System::PreSort { works.made.saturating_sub(front) } else { 0 },
            turns,
        })
    }

    /// Ticks from the first instruction to the last region in the frame buffer.
    pub fn back(&self) -> Ticks {
        self.turns.last().map_or(0, |last| last.loaded.end)
    }

    /// Ticks by which the simulated stages begin later because of the front end. If the front end works in parallel, its times are part of the others.
    pub fn delay(&self) -> Ticks {
        if self.system == System::Base { self.front } else { 0 }
    }

    /// Ticks of a frame from its beginning to its last region in the frame buffer.
    pub fn latency(&self) -> Ticks {
        self.delay() + self.back()
    }

    /// Simulated picoseconds after the front end.
    pub fn picoseconds(&self) -> u64 {
        self.back() * 5000
    }

    /// The stages after the front end, in their sequence.
    pub fn stages(&self) -> Vec<Stage> {
        let longest = |nodes: &[NodeReport]| 2 * nodes.iter().map(|node| node.busy).max().unwrap_or(0);
        let Some(last) = self.turns.last() else { return Vec::new() };
        let stage = |name, busy, of: fn(&Done) -> &Range<Ticks>| {
            // Not all turns have all stages.
            let from = self.turns.iter().map(of).find(|range| !range.is_empty()).map_or(0, |range| range.start);
            Stage { name, busy, from, to: of(last).end }
        };
        let in_turn = |name, of: fn(&Done) -> &Range<Ticks>| {
            stage(name, self.turns.iter().map(|turn| of(turn).end - of(turn).start).sum(), of)
        };
        let rasterizing = Stage { name: "rasterizing", busy: longest(&self.rasterizers), from: 0, to: last.rasterized };
        let mut stages = vec![rasterizing, in_turn("composing", |it| &it.composed)];
        if !self.shaders.is_empty() {
            stages.push(stage("shading", longest(&self.shaders), |it| &it.shaded));
            stages.push(in_turn("sending colours", |it| &it.sent));
        }
        stages.push(in_turn("frame buffer", |it| &it.loaded));
        stages
    }

    /// The front end, and its second pass over the sorted primitives, which only one system has.
    fn before(&self) -> [Stage; 2] {
        let end = self.front + self.second;
        [
            Stage { name: "front end", busy: self.front, from: 0, to: self.front },
            Stage { name: "second pass", busy: self.second, from: self.front, to: end },
        ]
    }

    /// The busiest stage, including the front end.
    pub fn limit(&self) -> Stage {
        self.stages().into_iter().chain(self.before()).max_by_key(|stage| stage.busy).expect("there is the front end")
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([width, height], [across, down]) = (self.size, self.array);
        let (rasterize, shade) = (self.rasterizers.len(), self.shaders.len());
        let system = match self.system {
            System::NonTexturing => "non-texturing system",
            System::Base => "base system, deferred shading",
            System::PreSort => "pre-sorting system, deferred shading",
        };
        let field = self.field.map_or_else(String::new, |field| format!(" of the {field} field"));
        let samples = if self.samples > 1 { format!(" of {} samples", self.samples) } else { String::new() };
        let once = if self.shaded_once { " shaded once" } else { "" };
        let shading = if shade > 0 { format!(", {shade} shade") } else { String::new() };
        let regions = self.turns.len();
        writeln!(
            f,
            "PixelFlow, {system}: {width}x{height} pixels{field}{samples}{once} in {regions} regions of {across}x{down},"
        )?;
        writeln!(f, "{} nodes: {rasterize} rasterize{shading}, one has the frame buffer", self.nodes)?;
        writeln!(f, "{} primitives, {} in regions", self.primitives, self.drawn)?;
        writeln!(f, "\n{:<16}{:>10}{:>10}{:>10}", "stage", "busy us", "from us", "to us")?;
        let us = |ticks: Ticks| ticks as f64 / 200.0;
        let later = |it: Stage| Stage { from: self.delay() + it.from, to: self.delay() + it.to, ..it };
        let before = self.before().into_iter().take(if self.second > 0 { 2 } else { 1 });
        for Stage { name, busy, from, to } in before.chain(self.stages().into_iter().map(later)) {
            writeln!(f, "{name:<16}{:>10.2}{:>10.2}{:>10.2}", us(busy), us(from), us(to))?;
        }
        writeln!(
            f,
            "Of several nodes, the busiest one counts. The front end is not simulated; it takes the paper's time."
        )?;
        writeln!(f, "\n{:<16}{:>10}{:>12}{:>8}", "node", "primitives", "busy clocks", "busy")?;
        let names = (1..=rasterize).map(|number| format!("rasterizer {number}")).zip(&self.rasterizers);
        let names = names.chain((1..=shade).map(|number| format!("shader {number}")).zip(&self.shaders));
        for (name, NodeReport { primitives, busy }) in names {
            let primitives = if name.starts_with('s') { String::new() } else { primitives.to_string() };
            let part = 200.0 * *busy as f64 / self.back().max(1) as f64;
            writeln!(f, "{name:<16}{primitives:>10}{busy:>12}{part:>6.1} %")?;
        }
        let (busy, part) = (self.holder, 200.0 * self.holder as f64 / self.back().max(1) as f64);
        writeln!(f, "{:<16}{:>10}{busy:>12}{part:>6.1} %", "frame's holder", "")?;
        write!(f, "The frame takes {:.3} ms.", milliseconds(self.latency()))
    }
}

//! The machine: arrays that rasterize and shade, and a network that composes what they drew, all in simulation (PFL-NODE, PFL-NET).
//!
//! ```text
//!                    words, least of all: forth -->
//! frame buffer ===== rasterizer 1 ===== rasterizer 2 ===== .. ===== shader 1 ===== shader 2
//!                    <-- back: colours
//! ```
//!
//! Region by region: all rasterizers draw; when the last one has, the network composes, and a shader takes what comes. Nodes wait for each other
//! at their banks of registers alone, so each array is a simulation of its own, which is told when the network has done with a bank. The times are
//! those of the simulations. Two things take other time than in a whole [`Node`](tilewright_rtl::pixelflow::node::Node): a region's instructions
//! come when the one before is given, some ten clocks late; and the network is set for its next word at once.

mod holder;

use std::ops::Range;

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_scenes::deferred::{Deferred, Samples, Shading};
use tilewright_scenes::golden::average_eight;
use tilewright_scenes::{Frame as Picture, Polygons, Projection, Size};
use tilewright_sim::EngineKind;

use super::config::Config;
use super::costs::{Ticks, ticks};
use super::hardware::{Access, Node, TextureLookUp, Way, Words};
use super::model::Done;
use super::report::Report;
use super::works::{Drawing, Works};
use crate::error::Error;
use crate::run::Watch;
use crate::threads::each_mut;
use holder::Holder;

/// What progress and errors call a frame.
const PHASE: &str = "drawing";
/// Picoseconds of a tick.
const TICK: u64 = 5000;

/// A machine, which may draw several frames.
///
/// ```
/// use tilewright_machines::{Watch, pixelflow::{Config, Machine}};
/// use tilewright_scenes::deferred::{Samples, project_deferred};
/// use tilewright_scenes::{Scene, Size, compare, golden};
///
/// let scene = Scene::builtin("star").expect("a built-in scene");
/// let deferred = project_deferred(&scene, Size::new(32, 24)?, Samples::One)?;
/// let config = Config { nodes: 4, shaders: 1, array: [16, 8], ..Config::new(deferred.size) };
/// let (frame, report) = Machine::new(config)?.render(&deferred, &mut Watch::default())?;
/// assert_eq!(compare(&frame, &golden::render_deferred(&deferred)).differing, 0);
/// assert_eq!(report.turns.len(), 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Machine {
    pub(super) config: Config,
    engine: EngineKind,
}

impl Machine {
    /// A machine.
    ///
    /// # Errors
    /// [`Error::Parameter`]: there is no such machine.
    pub fn new(config: Config) -> Result<Machine, Error> {
        config.roles()?;
        config.pixels()?;
        Ok(Machine { config, engine: EngineKind::Compiled })
    }

    /// The same on another engine.
    pub fn on(self, engine: EngineKind) -> Machine {
        Machine { engine, ..self }
    }

    /// Renders a frame with deferred shading, by the base system: the picture as the frame buffer has it, and the report.
    ///
    /// Eight samples are two renderings at twice the width and height, one after another, in which every sample is shaded; who holds the frame
    /// averages them, which takes no time here. Where they are shaded once, the eight words of a pixel come to the same shader one after another.
    ///
    /// # Errors
    /// [`Error::Parameter`] if the scene is for another screen, or takes what the machine has not; [`Error::Cancelled`]; [`Error::Simulation`].
    pub fn render(&self, deferred: &Deferred, watch: &mut Watch) -> Result<(Picture, Report), Error> {
        if deferred.samples == Samples::Eight(Shading::OncePerPixel) {
            self.check(deferred.size)?;
            return self.run(&Works::deferred_once(&self.config, &deferred.passes, &deferred.shader)?, watch);
        }
        if deferred.samples != Samples::One && self.config.field.is_some() {
            let problem = "eight samples of a field: where each of them is shaded, this machine draws whole frames";
            return Err(ParameterError(problem.to_owned()).into());
        }
        self.check(deferred.size)?;
        let mut drawn = Vec::new();
        for pass in &deferred.passes {
            let config = Config { size: pass.size, ..self.config.clone() };
            let works = Works::deferred(&config, pass, &deferred.shader)?;
            drawn.push(self.run(&works, watch)?);
        }
        let (pictures, reports): (Vec<_>, Vec<_>) = drawn.into_iter().unzip();
        let report = reports.into_iter().reduce(Report::and_then).expect("there is a pass");
        match <[Picture; 2]>::try_from(pictures) {
            Ok(both) => {
                let size = [deferred.size.width(), deferred.size.height()];
                Ok((average_eight(&both), Report { size, samples: 8, ..report }))
            }
            Err(mut one) => Ok((one.remove(0), report)),
        }
    }

    /// Renders a frame by the non-texturing system: all regions are in the pixels' memory, and colours are those of the vertices.
    ///
    /// # Errors
    /// As [`Machine::render`]; [`Error::Parameter`] also if the screen has more regions than fit.
    pub fn render_resident(
        &self,
        polygons: &Polygons,
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Picture, Report), Error> {
        self.check(polygons.size)?;
        let works = Works::resident(&self.config, &[Drawing::of(&self.config, &polygons.polygons)], background)?;
        self.run(&works, watch)
    }

    /// The same with eight samples of a pixel, one after another: the two passes of [`project_samples`](tilewright_scenes::project_samples). The node
    /// that holds the frame adds them up.
    ///
    /// # Errors
    /// As [`Machine::render_resident`]; [`Error::Parameter`] also if there are not two passes.
    pub fn render_resident_samples(
        &self,
        passes: &[Projection],
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Picture, Report), Error> {
        let sizes: Vec<_> = passes.iter().map(|pass| [pass.size.width(), pass.size.height()]).collect();
        let doubled = [2 * self.config.size.width(), 2 * self.config.size.height()];
        if sizes != [doubled; 2] {
            let problem = format!("eight samples are two passes of {}x{} pixels each", doubled[0], doubled[1]);
            return Err(ParameterError(problem).into());
        }
        let works = Works::resident(&self.config, &Drawing::eight(&self.config, passes), background)?;
        self.run(&works, watch)
    }

    fn check(&self, size: Size) -> Result<(), Error> {
        if size == self.config.size {
            return Ok(());
        }
        let problem = format!("a scene for {size} pixels, on a machine of {}: set it up for that", self.config.size);
        Err(ParameterError(problem).into())
    }

    fn run(&self, works: &Works, watch: &mut Watch) -> Result<(Picture, Report), Error> {
        let mut run = Run::new(self, works)?;
        for turn in 0..works.turns() {
            run.turn(turn)?;
            let time = run.network * TICK;
            watch.go_on(PHASE, (turn + 1) as f64 / works.turns() as f64, time)?;
        }
        run.finish()?;
        let picture = works.picture(&run.colours);
        let shaders = run.shaders.iter().map(|shader| shader.node.busy()).collect();
        let busy = [run.rasterizers.iter().map(Node::busy).collect(), shaders];
        let holder = run.holder.as_ref().map(Holder::busy);
        Ok((picture, Report { holder, ..Report::new(&self.config, works, run.done, busy) }))
    }
}

/// A shader, and what it has to do.
struct Shader {
    node: Node,
    /// Where it is on the network.
    place: usize,
}

/// A frame on its way.
struct Run<'a> {
    config: &'a Config,
    works: &'a Works,
    rasterizers: Vec<Node>,
    shaders: Vec<Shader>,
    /// Who holds the frame, if its array has something to do.
    holder: Option<Holder>,
    forth: Way,
    back: Way,
    /// The number of nodes, and the pixels of a chip.
    nodes: usize,
    pixels: u64,
    /// Until when the network is taken, the other way, and the frame buffer's memory.
    network: Ticks,
    returns: Ticks,
    written: Ticks,
    /// When each turn was where, and when each region's colours were in the frame buffer's memory.
    done: Vec<Done>,
    loaded: Vec<Ticks>,
    /// What the frame buffer got.
    colours: Vec<Words>,
}

impl<'a> Run<'a> {
    fn new(machine: &'a Machine, works: &'a Works) -> Result<Run<'a>, Error> {
        let (config, engine) = (&machine.config, machine.engine);
        let (array, roles) = (config.pixels()?, config.roles()?);
        let shaders = if works.is_shaded() { roles.shaders } else { 0 };
        let mut nodes = build(&array, engine, config.side_by_side, works.shares() + shaders as usize)?;
        let rest = nodes.split_off(works.shares());
        let shader = |(number, mut node): (u32, Node)| {
            if !works.textures.is_empty() {
                let textures = works.textures.iter().map(AsRef::as_ref);
                node = node.with_textures(TextureLookUp::new(&array, textures, engine)?);
            }
            node.run(&Works::first(0))?;
            Ok::<Shader, Error>(Shader { node, place: (1 + roles.rasterizers + number) as usize })
        };
        let holder = works.adds().then(|| Holder::new(&array, engine, config.side_by_side)).transpose()?;
        Ok(Run {
            config,
            works,
            rasterizers: nodes,
            shaders: (0..shaders).zip(rest).map(shader).collect::<Result<_, _>>()?,
            holder,
            forth: Way::new(&array, config.nodes as usize, engine)?,
            back: Way::new(&array, config.nodes as usize, engine)?,
            nodes: config.nodes as usize,
            pixels: array.pixels().into(),
            network: 0,
            returns: 0,
            written: 0,
            done: Vec::new(),
            loaded: Vec::new(),
            colours: Vec::new(),
        })
    }

    /// The next turn: it is drawn; then the one before is composed and shaded, and the network is told when it has this one.
    fn turn(&mut self, turn: usize) -> Result<(), Error> {
        each_mut(&mut self.rasterizers, |number, node| {
            node.run(self.works.program(number, turn))?;
            node.finish()
        })?;
        if turn > 0 {
            self.compose(turn - 1)?;
        }
        let bank = turn % 2;
        let rasterized = self.rasterizers.iter().map(|node| node.given(bank)).max().unwrap_or(0);
        let taken = match (self.shader_of(turn), &mut self.holder) {
            (Some(shader), _) => self.shaders[shader].node.given(0),
            (None, Some(holder)) => holder.awaits(self.works, turn)?,
            (None, None) => self.stored(),
        };
        let bytes = self.works.bytes();
        let begin = rasterized.max(self.network).max(taken) + self.config.set_up;
        let end = begin + bytes * self.pixels;
        let first = self.first();
        for (number, node) in self.rasterizers.iter_mut().enumerate() {
            // A tick from node to node.
            let from = begin + first.abs_diff(1 + number) as Ticks;
            node.access(Access { from, bank, bytes, comes: None });
        }
        self.network = end;
        let nothing = end..end;
        self.done.push(Done {
            rasterized,
            composed: begin..end,
            shaded: nothing.clone(),
            sent: nothing.clone(),
            loaded: nothing,
        });
        Ok(())
    }

    /// The place of the rasterizer that sends first: colours go the other way.
    fn first(&self) -> usize {
        if self.works.is_shaded() { 1 } else { self.rasterizers.len() }
    }

    fn shader_of(&self, turn: usize) -> Option<usize> {
        self.works.shader_of(turn, self.shaders.len())
    }

    /// When the frame buffer has a bank for the colours that are sent next: it has two.
    fn stored(&self) -> Ticks {
        self.loaded.len().checked_sub(2).map_or(0, |before| self.loaded[before])
    }

    /// Composes a region whose words have all gone, and shades it, or adds it to other samples.
    fn compose(&mut self, turn: usize) -> Result<(), Error> {
        let gone: Vec<Words> =
            self.rasterizers.iter_mut().map(|node| node.sent(turn % 2).expect("its words have gone")).collect();
        match self.shader_of(turn) {
            None => {
                let last = self.nodes - 1;
                let mut own: Vec<_> =
                    gone.iter().enumerate().map(|(number, words)| (last - 1 - number, words)).collect();
                own.reverse();
                let came = self.back.send(&own, last)?;
                self.hold(turn, came)?;
            }
            Some(number) => {
                let own: Vec<_> = gone.iter().enumerate().map(|(number, words)| (1 + number, words)).collect();
                let shader = &mut self.shaders[number];
                let came = self.forth.send(&own, shader.place)?;
                let arrives = self.done[turn].composed.clone();
                let [from, to] = [arrives.start, arrives.end].map(|time| time + (shader.place - 1) as Ticks);
                shader.node.access(Access { from, bank: 0, bytes: self.works.bytes(), comes: Some(came) });
                let shaded = shader.node.run(self.works.shading(turn))?;
                self.worked(turn, to..shaded);
                if self.works.ends(turn) {
                    self.send(turn, number, shaded);
                }
            }
        }
        Ok(())
    }

    /// Words come to the node that holds the frame.
    fn hold(&mut self, turn: usize, came: Words) -> Result<(), Error> {
        let Range { start, end } = self.done[turn].composed;
        let Some(holder) = &mut self.holder else {
            self.colours.push(came);
            self.load(turn, end);
            return Ok(());
        };
        let way = self.rasterizers.len() as Ticks;
        let added = holder.add(self.works, turn, start + way, came)?;
        self.worked(turn, end + way..added);
        if self.works.ends(turn) {
            let loaded = self.load(turn, added);
            if let Some(holder) = &mut self.holder {
                holder.take(turn, added, loaded);
            }
        }
        Ok(())
    }

    /// A shader, or the frame's holder, had the words of a turn, and has worked on them; so far nothing goes on from there.
    fn worked(&mut self, turn: usize, shaded: Range<Ticks>) {
        let nothing = shaded.end..shaded.end;
        let done = &mut self.done[turn];
        (done.shaded, done.sent, done.loaded) = (shaded, nothing.clone(), nothing);
    }

    /// Lets a shader's colours go to the frame buffer, once the network is free.
    fn send(&mut self, turn: usize, shader: usize, shaded: Ticks) {
        let begin = shaded.max(self.returns).max(self.stored()) + self.config.set_up;
        let bytes = Works::COLOUR;
        let end = begin + bytes * self.pixels;
        self.returns = end;
        self.shaders[shader].node.access(Access { from: begin, bank: 1, bytes, comes: None });
        self.done[turn].sent = begin..end;
        self.load(turn, end);
    }

    /// Colours that the frame buffer has go to its memory; gives the tick by which they are there.
    fn load(&mut self, turn: usize, sent: Ticks) -> Ticks {
        let begin = sent.max(self.written);
        self.written = begin + ticks(self.config.costs.load * self.works.part_of_whole_array());
        self.done[turn].loaded = begin..self.written;
        self.loaded.push(self.written);
        self.written
    }

    /// The last turn's way, and all colours to the frame buffer.
    fn finish(&mut self) -> Result<(), Error> {
        each_mut(&mut self.rasterizers, |_, node| node.finish())?;
        let turns = self.works.turns();
        self.compose(turns - 1)?;
        self.shaders.iter_mut().try_for_each(|shader| shader.node.finish())?;
        if let Some(holder) = &mut self.holder {
            self.colours = holder.taken(self.works)?;
        }
        for turn in (0..turns).filter(|turn| self.works.ends(*turn)) {
            let Some(number) = self.shader_of(turn) else { break };
            let shader = &mut self.shaders[number];
            let sent = shader.node.sent(1).expect("its colours have gone");
            let place = self.nodes - 1 - shader.place;
            self.colours.push(self.back.send(&[(place, &sent)], self.nodes - 1)?);
        }
        Ok(())
    }
}

/// So many nodes, built on all processors of the computer.
fn build(array: &PixelArray, engine: EngineKind, side_by_side: bool, count: usize) -> Result<Vec<Node>, Error> {
    let mut nodes: Vec<Option<Node>> = (0..count).map(|_| None).collect();
    each_mut(&mut nodes, |_, node| {
        *node = Some(Node::new(array, engine, side_by_side)?);
        Ok::<(), Error>(())
    })?;
    Ok(nodes.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests;

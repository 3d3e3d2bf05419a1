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

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_scenes::deferred::{Deferred, Samples, Shading};
use tilewright_scenes::golden::average_eight;
use tilewright_scenes::{Frame as Picture, Polygons, Size};
use tilewright_sim::EngineKind;

use super::config::Config;
use super::costs::{Ticks, ticks};
use super::hardware::{Access, Node, TextureLookUp, Way, Words};
use super::model::Done;
use super::report::Report;
use super::works::Works;
use crate::error::Error;
use crate::run::Watch;
use crate::threads::each_mut;

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
    /// averages them, which takes no time here.
    ///
    /// # Errors
    /// [`Error::Parameter`] if the scene is for another screen, or takes what the machine has not; [`Error::Cancelled`]; [`Error::Simulation`].
    pub fn render(&self, deferred: &Deferred, watch: &mut Watch) -> Result<(Picture, Report), Error> {
        if deferred.samples == Samples::Eight(Shading::OncePerPixel) {
            let problem = "eight samples that are shaded once: the hardware of this machine shades each of them";
            return Err(ParameterError(problem.to_owned()).into());
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
        let works = Works::resident(&self.config, polygons, background)?;
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
        for region in 0..works.regions() {
            run.region(region)?;
            let time = run.network * TICK;
            watch.go_on(PHASE, (region + 1) as f64 / works.regions() as f64, time)?;
        }
        run.finish()?;
        let picture = works.picture(&run.colours);
        let shaders = run.shaders.iter().map(|shader| shader.node.busy()).collect();
        let busy = [run.rasterizers.iter().map(Node::busy).collect(), shaders];
        Ok((picture, Report::new(&self.config, works, run.done, busy)))
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
    forth: Way,
    back: Way,
    /// The number of nodes, and the pixels of a chip.
    nodes: usize,
    pixels: u64,
    /// Until when the network is taken, the other way, and the frame buffer's memory.
    network: Ticks,
    returns: Ticks,
    written: Ticks,
    /// When each region was where.
    done: Vec<Done>,
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
            node.run(&works.first_of_shader())?;
            Ok::<Shader, Error>(Shader { node, place: (1 + roles.rasterizers + number) as usize })
        };
        Ok(Run {
            config,
            works,
            rasterizers: nodes,
            shaders: (0..shaders).zip(rest).map(shader).collect::<Result<_, _>>()?,
            forth: Way::new(&array, config.nodes as usize, engine)?,
            back: Way::new(&array, config.nodes as usize, engine)?,
            nodes: config.nodes as usize,
            pixels: array.pixels().into(),
            network: 0,
            returns: 0,
            written: 0,
            done: Vec::new(),
            colours: Vec::new(),
        })
    }

    /// The next region: it is drawn; then the one before is composed and shaded, and the network is told when it has this one.
    fn region(&mut self, region: usize) -> Result<(), Error> {
        each_mut(&mut self.rasterizers, |number, node| {
            node.run(self.works.program(number, region))?;
            node.finish()
        })?;
        if region > 0 {
            self.compose(region - 1)?;
        }
        let bank = region % 2;
        let rasterized = self.rasterizers.iter().map(|node| node.given(bank)).max().unwrap_or(0);
        let taken = match self.shader_of(region) {
            Some(shader) => self.shaders[shader].node.given(0),
            None => self.stored(region),
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

    fn shader_of(&self, region: usize) -> Option<usize> {
        region.checked_rem(self.shaders.len())
    }

    /// When the frame buffer has a bank for what is sent next: it has two.
    fn stored(&self, region: usize) -> Ticks {
        region.checked_sub(2).map_or(0, |before| self.done[before].loaded.end)
    }

    /// Composes a region whose words have all gone, and shades it.
    fn compose(&mut self, region: usize) -> Result<(), Error> {
        let gone: Vec<Words> =
            self.rasterizers.iter_mut().map(|node| node.sent(region % 2).expect("its words have gone")).collect();
        match self.shader_of(region) {
            None => {
                let last = self.nodes - 1;
                let mut own: Vec<_> =
                    gone.iter().enumerate().map(|(number, words)| (last - 1 - number, words)).collect();
                own.reverse();
                let came = self.back.send(&own, last)?;
                self.colours.push(came);
                let end = self.done[region].composed.end;
                self.load(region, end);
            }
            Some(number) => {
                let own: Vec<_> = gone.iter().enumerate().map(|(number, words)| (1 + number, words)).collect();
                let shader = &mut self.shaders[number];
                let came = self.forth.send(&own, shader.place)?;
                let from = self.done[region].composed.start + (shader.place - 1) as Ticks;
                shader.node.access(Access { from, bank: 0, bytes: self.works.bytes(), comes: Some(came) });
                let shaded = shader.node.run(self.works.shading())?;
                self.send(region, number, shaded);
            }
        }
        Ok(())
    }

    /// Lets a shader's colours go to the frame buffer, once the network is free.
    fn send(&mut self, region: usize, shader: usize, shaded: Ticks) {
        let begin = shaded.max(self.returns).max(self.stored(region)) + self.config.set_up;
        let bytes = Works::COLOUR;
        let end = begin + bytes * self.pixels;
        self.returns = end;
        self.shaders[shader].node.access(Access { from: begin, bank: 1, bytes, comes: None });
        let done = &mut self.done[region];
        let arrived = done.composed.end + (self.shaders[shader].place - 1) as Ticks;
        (done.shaded, done.sent) = (arrived..shaded, begin..end);
        self.load(region, end);
    }

    fn load(&mut self, region: usize, sent: Ticks) {
        let begin = sent.max(self.written);
        self.written = begin + ticks(self.config.costs.load * self.works.part_of_whole_array());
        self.done[region].loaded = begin..self.written;
    }

    /// The last region's way, and all colours to the frame buffer.
    fn finish(&mut self) -> Result<(), Error> {
        each_mut(&mut self.rasterizers, |_, node| node.finish())?;
        let regions = self.works.regions();
        self.compose(regions - 1)?;
        self.shaders.iter_mut().try_for_each(|shader| shader.node.finish())?;
        if self.shaders.is_empty() {
            return Ok(());
        }
        for region in 0..regions {
            let number = region % self.shaders.len();
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

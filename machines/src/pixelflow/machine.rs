//! The simulated machine: arrays that rasterize and shade, and a network that composes their regions (PFL-NODE, PFL-NET).
//!
//! ```text
//!                    words, least of all: forth -->
//! frame buffer ===== rasterizer 1 ===== rasterizer 2 ===== .. ===== shader 1 ===== shader 2
//!                    <-- back: colours
//! ```
//!
//! Nodes wait for each other only at their banks of registers. So the [transaction model](super::model) first predicts the tick in which each bank is given and
//! each word is sent. Then each array is simulated separately. The network reads and writes its banks in these ticks, and the array has to give them in the
//! predicted ticks. The model is also tested on machines that are one circuit ([`PixelFlow`](tilewright_rtl::pixelflow::machine::PixelFlow)).

mod jobs;
mod run;

use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::deferred::{Appearance, Deferred, Samples, Shading};
use tilewright_scenes::{Frame as Picture, Polygons, Projection, Size};
use tilewright_sim::EngineKind;

use super::config::Config;
use super::following::{self, Light, Pixel, Words};
use super::hardware::Spare;
use super::report::Report;
use super::works::{Drawing, Works};
use crate::error::Error;
use crate::history::{History, Recorder};
use crate::run::Watch;
use crate::tracer::Tracer;
use crate::way::Follower;
use run::Run;

/// The name of a frame in progress and errors.
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
    recorder: Option<Recorder>,
    spare: Spare,
    follower: Option<Follower>,
    tracer: Option<Tracer>,
}

impl Machine {
    /// A machine.
    ///
    /// # Errors
    /// [`Error::Parameter`]: a parameter is out of range.
    pub fn new(config: Config) -> Result<Machine, Error> {
        config.roles()?;
        config.pixels()?;
        Ok(Machine {
            config,
            engine: EngineKind::Compiled,
            recorder: None,
            spare: Spare::default(),
            follower: None,
            tracer: None,
        })
    }

    /// The same on another engine.
    pub fn on(self, engine: EngineKind) -> Machine {
        let spare = if engine == self.engine { self.spare.clone() } else { Spare::default() };
        Machine { engine, spare, ..self }
    }

    /// The same machine with a recorder. Times are counted from the beginning of the front end. A pixel belongs to the rasterizer with the least word in most of
    /// its samples. It is written when the frame buffer takes it.
    pub fn recorded(self, recorder: &Recorder) -> Machine {
        Machine { recorder: Some(recorder.clone()), ..self }
    }

    /// The same machine with a follower of a pixel: all nodes, both directions of the network, the texture units and the frame buffer. Of eight samples it
    /// follows the first. Times are counted from the beginning of the first instruction.
    ///
    /// ```
    /// use tilewright_machines::{Follower, Watch, pixelflow::{Config, Machine}};
    /// use tilewright_scenes::deferred::{Samples, project_deferred};
    /// use tilewright_scenes::{Scene, Size};
    ///
    /// let scene = Scene::builtin("star").expect("a built-in scene");
    /// let deferred = project_deferred(&scene, Size::new(16, 12)?, Samples::One)?;
    /// let config = Config { nodes: 4, shaders: 1, array: [8, 8], ..Config::new(deferred.size) };
    /// let follower = Follower::new([8, 6]);
    /// Machine::new(config)?.following(&follower).render(&deferred, &mut Watch::default())?;
    /// let way = follower.take().expect("a frame was rendered");
    /// assert!(way.first_difference().is_none() && way.steps.iter().any(|step| step.block == "compositor"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn following(mut self, follower: &Follower) -> Machine {
        self.follower = Some(follower.clone());
        self
    }

    /// The same machine with a tracer of a unit, as a [`Step`](crate::Step) of a followed pixel names it. With a follower
    /// of the same pixel, a frame that does not end is given up as it was then; the way itself is not found again.
    pub fn traced(self, tracer: &Tracer) -> Machine {
        // The time of a new simulation begins at 0.
        Machine { tracer: Some(tracer.clone()), spare: Spare::default(), ..self }
    }

    /// Another machine on the same engine. If its arrays have the same size, it reuses the simulated arrays of this one, which is faster than making new ones.
    ///
    /// # Errors
    /// As [`Machine::new`].
    pub fn another(&self, config: Config) -> Result<Machine, Error> {
        let spare = if config.array == self.config.array { self.spare.clone() } else { Spare::default() };
        Ok(Machine { engine: self.engine, spare, ..Machine::new(config)? })
    }

    /// Renders a frame with deferred shading, by the base system. Returns the picture in the frame buffer, and the report.
    ///
    /// Eight samples are two renderings at twice the width and height, drawn alternately region by region. Every sample is shaded, and the frame buffer averages the
    /// samples of a pixel. If a pixel is shaded once, its eight words go to the same shader one after another.
    ///
    /// # Errors
    /// [`Error::Parameter`] if the scene is for another screen, or exceeds the machine; [`Error::Cancelled`]; [`Error::Simulation`];
    /// [`Error::Differs`].
    pub fn render(&self, deferred: &Deferred, watch: &mut Watch) -> Result<(Picture, Report), Error> {
        self.check(deferred.size)?;
        let Deferred { passes, shader, .. } = deferred;
        if deferred.samples == Samples::Eight(Shading::EachSample) && self.config.field.is_some() {
            let problem = "eight samples of a field: if each sample is shaded, this machine draws whole frames only";
            return Err(ParameterError(problem.to_owned()).into());
        }
        let works = match deferred.samples {
            Samples::Eight(Shading::OncePerPixel) => Works::deferred_once(&self.config, passes, shader)?,
            _ => Works::deferred(&self.config, passes, shader)?,
        };
        let word = |number: usize, [x, y]: [u32; 2]| {
            let packet = &passes[0].packets[number];
            let covers = packet.triangle.covers(x, y);
            covers.then(|| {
                let word = packet.word(x, y);
                let it = word.parameters();
                let [red, green, blue] = it.rgb.map(u64::from);
                (u64::from(it.z) << 24 | red << 16 | green << 8 | blue, word.bytes().to_vec())
            })
        };
        let light = |bytes| {
            let word = Appearance::from_bytes(bytes);
            let is_known = usize::from(word.parameters().material) < shader.materials.len();
            (is_known || word.is_empty()).then(|| shader.shade(word))
        };
        let light = (!works.shades_once()).then_some(&light as &dyn Fn([u8; 21]) -> Option<[u8; 3]>);
        self.run(&works, shader.background, ((passes[0].packets.len(), &word), light), watch)
    }

    /// Renders a frame by the non-texturing system. All regions are in the pixels' memory, and colours are those of the vertices.
    ///
    /// # Errors
    /// As [`Machine::render`]; [`Error::Parameter`] also if the screen has more regions than fit, or there are spheres.
    pub fn render_resident(
        &self,
        polygons: &Polygons,
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Picture, Report), Error> {
        self.check(polygons.size)?;
        if !polygons.spheres.is_empty() {
            return Err(ParameterError("spheres: this machine cannot evaluate quadratics".to_owned()).into());
        }
        let works = Works::resident(&self.config, &[Drawing::of(&self.config, &polygons.polygons)], background)?;
        let word = |number: usize, [x, y]: [u32; 2]| {
            let packet = &polygons.polygons[number];
            packet.covers(x, y).then(|| (packet.word(x, y), packet.word(x, y).to_be_bytes().to_vec()))
        };
        self.run(&works, background, ((polygons.polygons.len(), &word), None), watch)
    }

    /// The same with eight samples of a pixel, one after another: the two passes of [`project_samples`](tilewright_scenes::project_samples). The node
    /// of the frame buffer adds them up.
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
        let word = |number: usize, [x, y]: [u32; 2]| {
            let packet = &passes[0].triangles[number];
            packet.covers(x, y).then(|| (packet.word(x, y), packet.word(x, y).to_be_bytes().to_vec()))
        };
        self.run(&works, background, ((passes[0].triangles.len(), &word), None), watch)
    }

    fn check(&self, size: Size) -> Result<(), Error> {
        if size == self.config.size {
            return Ok(());
        }
        let problem = format!("a scene for {size} pixels, on a machine of {}: set it up for that", self.config.size);
        Err(ParameterError(problem).into())
    }

    fn run(
        &self,
        works: &Works,
        background: [u8; 3],
        (words, light): (Words, Light),
        watch: &mut Watch,
    ) -> Result<(Picture, Report), Error> {
        let pixel = self.follower.as_ref().and_then(|follower| Pixel::new(works, follower.pixel));
        let mut run = Run::new(&self.config, self.engine, &self.spare, works, self.recorder.is_some(), pixel)?;
        if let Some(tracer) = &self.tracer {
            run.trace(tracer)?;
            // The way is known, so no observer has to look again.
            drop(run.found());
        }
        let ended = draw(&mut run, background, watch);
        if let (Some(follower), Some(pixel), None) = (&self.follower, pixel, &self.tracer) {
            let shown = ended.as_ref().ok().map(|(picture, ..)| picture.words[pixel.number]);
            follower.put(following::way(run.found(), words, light, pixel.sample(works), shown));
        }
        let (picture, report, history) = ended?;
        run.keep();
        if let (Some(recorder), Some(history)) = (&self.recorder, history) {
            recorder.put(history);
        }
        Ok((picture, report))
    }
}

fn draw(run: &mut Run, background: [u8; 3], watch: &mut Watch) -> Result<(Picture, Report, Option<History>), Error> {
    run.begin()?;
    while let Some(done) = run.go_on()? {
        watch.go_on(PHASE, done, run.time() * TICK)?;
    }
    run.end(background)
}

#[cfg(test)]
mod tests;

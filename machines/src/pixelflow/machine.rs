//! The machine: arrays that rasterize and shade, and a network that composes what they drew, all in simulation (PFL-NODE, PFL-NET).
//!
//! ```text
//!                    words, least of all: forth -->
//! frame buffer ===== rasterizer 1 ===== rasterizer 2 ===== .. ===== shader 1 ===== shader 2
//!                    <-- back: colours
//! ```
//!
//! Nodes wait for each other at their banks of registers alone. So the [transaction model](super::model) first says in which tick each bank is given and each word
//! goes; then each array is a simulation of its own, whose banks the network reads and writes in these ticks, and which has to give them in the model's. That
//! the model is right is also tested on machines that are one circuit ([`PixelFlow`](tilewright_rtl::pixelflow::machine::PixelFlow)).

mod jobs;
mod run;

use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::deferred::{Deferred, Samples, Shading};
use tilewright_scenes::{Frame as Picture, Polygons, Projection, Size};
use tilewright_sim::EngineKind;

use super::config::Config;
use super::hardware::Spare;
use super::report::Report;
use super::works::{Drawing, Works};
use crate::error::Error;
use crate::history::Recorder;
use crate::run::Watch;
use run::Run;

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
    recorder: Option<Recorder>,
    spare: Spare,
}

impl Machine {
    /// A machine.
    ///
    /// # Errors
    /// [`Error::Parameter`]: there is no such machine.
    pub fn new(config: Config) -> Result<Machine, Error> {
        config.roles()?;
        config.pixels()?;
        Ok(Machine { config, engine: EngineKind::Compiled, recorder: None, spare: Spare::default() })
    }

    /// The same on another engine.
    pub fn on(self, engine: EngineKind) -> Machine {
        let spare = if engine == self.engine { self.spare.clone() } else { Spare::default() };
        Machine { engine, spare, ..self }
    }

    /// The same machine, which leaves there what it did. Times are counted from the beginning of the front end. A pixel is of the rasterizer whose word was the least
    /// in most of its samples, and is written when the frame buffer takes it.
    pub fn recorded(self, recorder: &Recorder) -> Machine {
        Machine { recorder: Some(recorder.clone()), ..self }
    }

    /// Another machine on the same engine. If its arrays are as large, it simulates those that have drawn a frame of this one, which takes less time than new ones.
    ///
    /// # Errors
    /// As [`Machine::new`].
    pub fn another(&self, config: Config) -> Result<Machine, Error> {
        let spare = if config.array == self.config.array { self.spare.clone() } else { Spare::default() };
        Ok(Machine { engine: self.engine, spare, ..Machine::new(config)? })
    }

    /// Renders a frame with deferred shading, by the base system: the picture as the frame buffer has it, and the report.
    ///
    /// Eight samples are two renderings at twice the width and height, of which each region is drawn after that of the other one. Every sample is shaded, and the
    /// frame buffer averages those of a pixel. Where they are shaded once, the eight words of a pixel come to the same shader one after another.
    ///
    /// # Errors
    /// [`Error::Parameter`] if the scene is for another screen, or takes what the machine has not; [`Error::Cancelled`]; [`Error::Simulation`];
    /// [`Error::Differs`].
    pub fn render(&self, deferred: &Deferred, watch: &mut Watch) -> Result<(Picture, Report), Error> {
        self.check(deferred.size)?;
        let Deferred { passes, shader, .. } = deferred;
        if deferred.samples == Samples::Eight(Shading::EachSample) && self.config.field.is_some() {
            let problem = "eight samples of a field: where each of them is shaded, this machine draws whole frames";
            return Err(ParameterError(problem.to_owned()).into());
        }
        let works = match deferred.samples {
            Samples::Eight(Shading::OncePerPixel) => Works::deferred_once(&self.config, passes, shader)?,
            _ => Works::deferred(&self.config, passes, shader)?,
        };
        self.run(&works, shader.background, watch)
    }

    /// Renders a frame by the non-texturing system: all regions are in the pixels' memory, and colours are those of the vertices.
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
            return Err(ParameterError("spheres: this machine evaluates no quadratics".to_owned()).into());
        }
        let works = Works::resident(&self.config, &[Drawing::of(&self.config, &polygons.polygons)], background)?;
        self.run(&works, background, watch)
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
        self.run(&works, background, watch)
    }

    fn check(&self, size: Size) -> Result<(), Error> {
        if size == self.config.size {
            return Ok(());
        }
        let problem = format!("a scene for {size} pixels, on a machine of {}: set it up for that", self.config.size);
        Err(ParameterError(problem).into())
    }

    fn run(&self, works: &Works, background: [u8; 3], watch: &mut Watch) -> Result<(Picture, Report), Error> {
        let mut run = Run::new(&self.config, self.engine, &self.spare, works, self.recorder.is_some())?;
        while let Some(done) = run.go_on()? {
            watch.go_on(PHASE, done, run.time() * TICK)?;
        }
        let (picture, report, history) = run.end(background)?;
        if let (Some(recorder), Some(history)) = (&self.recorder, history) {
            recorder.put(history);
        }
        Ok((picture, report))
    }
}

#[cfg(test)]
mod tests;

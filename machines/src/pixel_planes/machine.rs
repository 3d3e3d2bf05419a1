//! The machine: bins of regions, renderers that take one after another, and the frame that they make (PP5-ARCH).
//!
//! Renderers wait for the ring, and the ring waits for renderers. The transaction-level model knows these clocks before. So each renderer is
//! simulated separately, on all processors of the computer. It gets its instructions and gives its planes in the clocks of the model, and all its
//! outputs are compared with the model's. Then the frame buffer gets the lines in the sequence in which the ring brings them.

use std::sync::{Mutex, PoisonError};

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixel_planes::{PERIOD, fields};
use tilewright_scenes::golden::Rule;
use tilewright_scenes::{Frame, PixelBox, Polygons};
use tilewright_sim::{EngineKind, IntoValue};

use super::bin::{Bin, Work, bins};
use super::config::Config;
use super::following::{self, Followed, Observer, Pictured};
use super::geometry::GeometryReport;
use super::hardware::{Course, Frames};
use super::history;
use super::model::{Model, RendererTiming, Step, Timing};
use super::regions::Regions;
use super::report::Report;
use crate::error::Error;
use crate::history::Recorder;
use crate::run::Watch;
use crate::threads::{Heard, all_threads, on_threads_heard};
use crate::tracer::Tracer;
use crate::way::Follower;

/// The name of a frame in progress and errors.
const PHASE: &str = "drawing";

/// A machine of renderers, which may draw several frames.
///
/// ```
/// use tilewright_machines::{Watch, pixel_planes::{Config, Machine}};
/// use tilewright_scenes::{Scene, Size, compare, golden, project_polygons};
///
/// let scene = Scene::builtin("star").expect("a built-in scene");
/// let polygons = project_polygons(&scene, Size::new(48, 32)?)?;
/// let config = Config { renderers: 2, side: 16, ..Config::new(polygons.size) };
/// let (frame, report) = Machine::new(config)?.render(&polygons, scene.background, &mut Watch::default())?;
/// let golden = golden::render(polygons.size, &polygons.polygons, scene.background);
/// assert_eq!(compare(&frame, &golden).differing, 0);
/// assert_eq!(report.regions.len(), 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Machine {
    pub(super) config: Config,
    engine: EngineKind,
    recorder: Option<Recorder>,
    follower: Option<Follower>,
    tracer: Option<Tracer>,
}

impl Machine {
    /// A machine.
    ///
    /// # Errors
    /// [`Error::Parameter`]: a parameter is out of range.
    pub fn new(config: Config) -> Result<Machine, Error> {
        config.renderer()?;
        config.ring()?;
        config.frame_buffer()?;
        config.check_geometry()?;
        Ok(Machine { config, engine: EngineKind::Compiled, recorder: None, follower: None, tracer: None })
    }

    /// The same on another engine.
    pub fn on(self, engine: EngineKind) -> Machine {
        Machine { engine, ..self }
    }

    /// The same machine with a recorder. Times are counted from the clock in which the first region is given. A pixel changes when the last
    /// instruction of its primitive has ended.
    pub fn recorded(self, recorder: &Recorder) -> Machine {
        Machine { recorder: Some(recorder.clone()), ..self }
    }

    /// The same machine with a follower of a pixel. Times are counted as those of a recorder. The steps are those of the pixel's renderer, of the
    /// ring and of the frame buffer.
    ///
    /// ```
    /// use tilewright_machines::{Follower, Watch, pixel_planes::{Config, Machine}};
    /// use tilewright_scenes::{Scene, Size, project_polygons};
    ///
    /// let scene = Scene::builtin("star").expect("a built-in scene");
    /// let polygons = project_polygons(&scene, Size::new(48, 32)?)?;
    /// let follower = Follower::new([24, 16]);
    /// let machine = Machine::new(Config { renderers: 2, side: 16, ..Config::new(polygons.size) })?.following(&follower);
    /// machine.render(&polygons, scene.background, &mut Watch::default())?;
    /// let way = follower.take().expect("a frame was rendered");
    /// assert!(way.first_difference().is_none() && way.steps.iter().any(|step| step.block == "backing-store"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn following(mut self, follower: &Follower) -> Machine {
        self.follower = Some(follower.clone());
        self
    }

    /// The same machine with a tracer of a unit, as a [`Step`](crate::Step) of a followed pixel names it.
    pub fn traced(self, tracer: &Tracer) -> Machine {
        Machine { tracer: Some(tracer.clone()), ..self }
    }

    /// Renders a frame. Returns the picture in the frame buffer, and the report.
    ///
    /// # Errors
    /// [`Error::Parameter`] if the polygons are of another screen, or there are spheres and the renderers are not [quadratic](Config::quadratic); [`Error::Cancelled`]; [`Error::Simulation`]; [`Error::Differs`].
    pub fn render(
        &self,
        polygons: &Polygons,
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Frame, Report), Error> {
        let regions = self.config.regions()?;
        let works = self.works(&regions, polygons, background)?;
        let timing = self.timing_of(&works)?;
        let mut followed = self.followed(&regions, &works, &timing)?;
        let frame = self.draw(&regions, &works, &timing, followed.as_mut(), watch);
        if let (Some(follower), Some(followed)) = (&self.follower, followed) {
            let rule = if self.config.strict { Rule::Strict } else { Rule::Least };
            let scene = following::Scene { polygons, rule, background, pixel: follower.pixel };
            follower.put(followed.into_way(scene, frame.as_ref().ok()));
        }
        let frame = frame?;
        watch.report(PHASE, 1.0);
        let Config { geometry, costs, .. } = &self.config;
        let geometry = GeometryReport::new(*geometry, costs, polygons, &works);
        if let Some(recorder) = &self.recorder {
            let scene = history::Scene { config: &self.config, regions: &regions, polygons, background };
            recorder.put(scene.history(&works, &timing, geometry.clocks));
        }
        let primitives = polygons.polygons.len() + polygons.spheres.len();
        Ok((frame, Report::new(self.config.built(), primitives, geometry, &works, &timing)))
    }

    /// The clocks of a frame by the transaction-level model alone, which are those of [`Machine::render`]. Regions are in the sequence in
    /// which they are given, by decreasing number of primitives.
    ///
    /// ```
    /// use tilewright_machines::{Watch, pixel_planes::{Config, Machine}};
    /// use tilewright_scenes::{Scene, Size, project_polygons};
    ///
    /// let scene = Scene::builtin("star").expect("a built-in scene");
    /// let polygons = project_polygons(&scene, Size::new(48, 32)?)?;
    /// let machine = Machine::new(Config { renderers: 2, side: 16, ..Config::new(polygons.size) })?;
    /// let timing = machine.timing(&polygons)?;
    /// let (_, report) = machine.render(&polygons, scene.background, &mut Watch::default())?;
    /// assert_eq!((timing.drawn, timing.sent), (report.drawn, report.sent));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Parameter`] if the polygons are of another screen.
    pub fn timing(&self, polygons: &Polygons) -> Result<Timing, Error> {
        self.timing_of(&self.works(&self.config.regions()?, polygons, [0; 3])?)
    }

    /// The work for each region; those with most primitives come first.
    pub(super) fn works(
        &self,
        regions: &Regions,
        polygons: &Polygons,
        background: [u8; 3],
    ) -> Result<Vec<Work>, Error> {
        let Config { size, .. } = self.config;
        if polygons.size != size {
            let problem = format!("polygons of {} pixels, on a machine of {size}: set them up for that", polygons.size);
            return Err(ParameterError(problem).into());
        }
        if !polygons.spheres.is_empty() && !self.config.quadratic {
            let problem = "spheres on a machine whose renderers cannot evaluate quadratics: build one that can";
            return Err(ParameterError(problem.to_owned()).into());
        }
        let bins = bins(regions, polygons);
        let mut order: Vec<usize> = (0..bins.len()).collect();
        // Stable: between equals the lower number is first.
        order.sort_by_key(|&region| std::cmp::Reverse(bins[region].len()));
        let work = |region: usize| {
            let bin = Bin::new(region, regions, &self.config);
            Work::new(&bin, &bins[region], polygons, background)
        };
        Ok(order.into_iter().map(work).collect())
    }

    fn timing_of(&self, works: &[Work]) -> Result<Timing, Error> {
        let steps: Vec<Vec<Step>> = works.iter().map(|work| Step::of(&work.instructions)).collect();
        Ok(Model::new(&self.config)?.run(&steps))
    }

    /// What is found of the pixel that is followed.
    fn followed<'a>(
        &self,
        regions: &Regions,
        works: &'a [Work],
        timing: &Timing,
    ) -> Result<Option<Followed<'a>>, Error> {
        let size = self.config.size;
        let is_there = |[x, y]: [u32; 2]| x < size.width() && y < size.height();
        let Some(pixel) = self.follower.as_ref().map(|follower| follower.pixel).filter(|pixel| is_there(*pixel)) else {
            return Ok(None);
        };
        Ok(Followed::new(&self.config, self.config.renderer()?, regions, works, timing, pixel))
    }

    fn draw(
        &self,
        regions: &Regions,
        works: &[Work],
        timing: &Timing,
        followed: Option<&mut Followed>,
        watch: &mut Watch,
    ) -> Result<Frame, Error> {
        let (observed, pictured) = match followed {
            Some(Followed { number, observer, pictured, .. }) => (Some((*number, observer)), Some(pictured)),
            None => (None, None),
        };
        let sent = self.simulate(works, timing, observed, watch)?;
        self.frame(regions, works, timing, sent, pictured)
    }

    /// The planes of each renderer that has a region.
    fn simulate(
        &self,
        works: &[Work],
        timing: &Timing,
        observed: Option<(usize, &mut Observer)>,
        watch: &mut Watch,
    ) -> Result<Vec<Vec<impl IntoValue + use<>>>, Error> {
        let renderer = self.config.renderer()?;
        let renderers = timing.renderers.iter().enumerate();
        let mut courses: Vec<Course> = renderers.map(|(number, it)| course(number, it, works)).collect();
        // The busiest come first, so that no processor of the computer begins one of them at the end.
        courses.sort_by_key(|it| std::cmp::Reverse(it.timing.busy));
        let mut results: Vec<_> = timing.renderers.iter().map(|_| None).collect();
        let all = timing.ring.instructions + timing.ring.planes;
        let (mut seen, mut last) = (0, 0);
        let Watch { progress, cancel } = watch;
        let cancel = *cancel;
        let observed = observed.map(|(number, observer)| (number, Mutex::new(observer)));
        let choices = (self.engine, self.config.side_by_side);
        let work = |course: &Course, say: &dyn Fn((u64, u64))| {
            let go_on = |handshakes: usize, clock: u64| {
                say((handshakes as u64, clock));
                let time = clock * PERIOD.picoseconds();
                Watch { progress: None, cancel }.go_on(PHASE, 0.0, time)
            };
            let observed = observed.as_ref().filter(|(number, _)| *number == course.number);
            let mut observer = observed.map(|(_, it)| it.lock().unwrap_or_else(PoisonError::into_inner));
            let observer = observer.as_mut().map(|it| &mut ***it);
            (course.number, course.run(&renderer, choices, self.tracer.as_ref(), &go_on, observer))
        };
        on_threads_heard(all_threads(), &courses, cancel, work, |heard| match heard {
            Heard::Said((handshakes, clock)) => {
                (seen, last) = (seen + handshakes, clock.max(last));
                let mut progress = Watch { progress: progress.as_deref_mut().map(|it| it as _), cancel: None };
                progress.report(PHASE, seen as f64 / all as f64);
            }
            Heard::Done(_, (number, result)) => results[number] = Some(result),
        });
        let time = last * PERIOD.picoseconds();
        results.into_iter().map(|result| result.unwrap_or(Err(Error::Cancelled { phase: PHASE, time }))).collect()
    }

    /// Brings the renderers' planes to the frame buffer, line by line like the ring, and reads the picture.
    fn frame(
        &self,
        regions: &Regions,
        works: &[Work],
        timing: &Timing,
        sent: Vec<Vec<impl IntoValue>>,
        mut pictured: Option<&mut Pictured>,
    ) -> Result<Frame, Error> {
        let (side, word) = (self.config.side as usize, fields::WORD.bits as usize);
        let mut lines = Vec::new();
        for (number, it) in timing.renderers.iter().enumerate() {
            let clocks = it.planes.iter().step_by(word).enumerate();
            lines.extend(
                clocks.map(|(line, &clock)| (clock, number, works[it.regions[line / side]].region, line % side)),
            );
        }
        lines.sort_unstable();
        let mut sent: Vec<_> = sent.into_iter().map(Vec::into_iter).collect();
        let frame_buffer = self.config.frame_buffer()?;
        let mut frames = Frames::new(&frame_buffer, self.engine)?;
        if let Some(tracer) = &self.tracer {
            frames.trace(tracer, &frame_buffer)?;
        }
        for (clock, number, region, line) in lines {
            let last = clock + word as u64 - 1;
            let pictured = pictured.as_deref_mut();
            failing(pictured, last, |it| frames.put((region, line), sent[number].by_ref().take(word), it))?;
        }
        let size = self.config.size;
        let mut words = vec![0; size.pixels()];
        for region in 0..regions.count() {
            let PixelBox { left, top, right, bottom } = regions.pixels(region);
            for y in top..=bottom {
                let first = (y * size.width() + left) as usize;
                let line = &mut words[first..=first + (right - left) as usize];
                let clock = timing.sent + u64::from(y) + 1;
                let read = failing(pictured.as_deref_mut(), clock, |_| frames.line(region, y - top))?;
                line.copy_from_slice(&read[..line.len()]);
                if let Some(pictured) = pictured.as_deref_mut().filter(|it| it.is_here(region, (y - top) as usize)) {
                    pictured.read(clock, &read);
                }
            }
        }
        Ok(Frame::from_words(size, words).expect("a word of 48 bits was read for each pixel"))
    }
}

/// What a work with the frame buffer gives. If it fails, the follower of a pixel gets that.
fn failing<T>(
    mut pictured: Option<&mut Pictured>,
    clock: u64,
    work: impl FnOnce(Option<(&mut Pictured, u64)>) -> Result<T, Error>,
) -> Result<T, Error> {
    let result = work(pictured.as_deref_mut().map(|it| (it, clock)));
    if let (Err(error), Some(pictured)) = (&result, pictured) {
        pictured.fail(clock, error);
    }
    result
}

/// The work of a renderer.
fn course<'a>(number: usize, timing: &'a RendererTiming, works: &'a [Work]) -> Course<'a> {
    let region = |place: &usize| (works[*place].region, works[*place].instructions.as_slice());
    Course { number, timing, regions: timing.regions.iter().map(region).collect() }
}

#[cfg(test)]
mod tests;

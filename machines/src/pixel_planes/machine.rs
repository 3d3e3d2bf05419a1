//! The machine: bins of regions, renderers that take one after another, and the frame that they make (PP5-ARCH).
//!
//! Renderers do not wait for each other: they have instructions as fast as they take them, and what they send is taken at once. Each is a
//! simulation of its own, on all processors of the computer. The next region goes to the renderer that is free first, as the region
//! allocator gives it: so regions are drawn side by side as long as none of those that draw can be done before they are given.

use std::collections::VecDeque;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

use tilewright_scenes::{Frame, PixelBox, Polygons};
use tilewright_sim::EngineKind;

use super::bin::{Bin, Work};
use super::config::Config;
use super::hardware::{Frames, Running, planes_of};
use super::outline::Binner;
use super::regions::Regions;
use super::report::{RegionReport, Report};
use crate::error::Error;
use crate::run::Watch;
use crate::threads::{all_threads, on_threads};

/// What progress and errors call a frame.
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
    config: Config,
    engine: EngineKind,
}

impl Machine {
    /// A machine.
    ///
    /// # Errors
    /// [`Error::Parameter`]: there is no such machine.
    pub fn new(config: Config) -> Result<Machine, Error> {
        config.renderer()?;
        config.frame_buffer()?;
        Ok(Machine { config, engine: EngineKind::Compiled })
    }

    /// The same on another engine.
    pub fn on(self, engine: EngineKind) -> Machine {
        Machine { engine, ..self }
    }

    /// Renders a frame: the picture as the frame buffer has it, and the report.
    ///
    /// # Errors
    /// [`Error::Parameter`] if the polygons are of another screen; [`Error::Cancelled`]; [`Error::Simulation`].
    pub fn render(
        &self,
        polygons: &Polygons,
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Frame, Report), Error> {
        let Config { size, .. } = self.config;
        if polygons.size != size {
            let problem = format!("polygons of {} pixels, on a machine of {size}: set them up for that", polygons.size);
            return Err(tilewright_rtl::parameter::ParameterError(problem).into());
        }
        let regions = self.config.regions()?;
        let bins = regions.bins(&polygons.vertices, Binner::Tight);
        let mut order: Vec<usize> = (0..bins.len()).collect();
        // Stable: of equal ones the lower number is first.
        order.sort_by_key(|&region| std::cmp::Reverse(bins[region].len()));

        let mut host = Host::new(self, &regions)?;
        let work =
            |&region: &usize| Work::new(&Bin::new(region, &regions, &self.config), &bins[region], polygons, background);
        let mut open: VecDeque<Work> = order.iter().map(work).collect();
        let mut drawn = Vec::with_capacity(bins.len());
        while !open.is_empty() {
            let done = drawn.len() as f64 / bins.len() as f64;
            watch.go_on(PHASE, done, host.time())?;
            drawn.extend(host.draw(&mut open, watch.cancel)?);
        }
        let frame = host.frame()?;
        watch.report(PHASE, 1.0);
        let report = Report::new(self.config.built(), polygons.polygons.len(), drawn, host.sent_at());
        Ok((frame, report))
    }
}

/// The host during a frame.
struct Host<'a> {
    config: &'a Config,
    regions: &'a Regions,
    renderers: Vec<Mutex<Running>>,
    frames: Frames,
    /// The clock at which the allocator can give the next region: one a clock.
    next: u64,
}

/// A region that a renderer gets at a clock.
struct Given {
    renderer: usize,
    begun: u64,
    work: Work,
}

impl<'a> Host<'a> {
    fn new(machine: &'a Machine, regions: &'a Regions) -> Result<Host<'a>, Error> {
        let config = &machine.config;
        let renderer = config.renderer()?;
        let used = config.renderers.min(regions.count() as u32);
        let running = |_| Running::new(&renderer, machine.engine, config.side_by_side).map(Mutex::new);
        let renderers = (0..used).map(running).collect::<Result<_, _>>()?;
        let frames = Frames::new(&config.frame_buffer()?, machine.engine)?;
        Ok(Host { config, regions, renderers, frames, next: 0 })
    }

    /// All renderers, at rest.
    fn running(&mut self) -> impl Iterator<Item = &mut Running> {
        self.renderers.iter_mut().map(|it| it.get_mut().expect("no thread has failed"))
    }

    /// Simulated picoseconds of the renderer that is farthest.
    fn time(&mut self) -> u64 {
        self.running().map(|it| it.sim.time()).max().unwrap_or(0)
    }

    /// Gives regions to the renderers that are free first, as many as are sure to go to these, and has them drawn side by side.
    fn draw(&mut self, open: &mut VecDeque<Work>, cancel: Option<&AtomicBool>) -> Result<Vec<RegionReport>, Error> {
        let round = self.give(open);
        let time = self.time();
        let renderers = &self.renderers;
        let mut results: Vec<Option<Result<u64, Error>>> = round.iter().map(|_| None).collect();
        let draw = |given: &Given| {
            let mut running = renderers[given.renderer].lock().expect("no thread has failed");
            running.draw(given.begun, &given.work.instructions, cancel)
        };
        on_threads(all_threads(), &round, cancel, draw, |number, result| results[number] = Some(result));
        let mut drawn = Vec::with_capacity(round.len());
        for (given, result) in round.iter().zip(results) {
            let clock = result.unwrap_or(Err(Error::Cancelled { phase: PHASE, time }))?;
            drawn.push(given.work.report(given.renderer, given.begun, clock - given.begun));
        }
        for running in &mut self.renderers {
            for plane in running.get_mut().expect("no thread has failed").whole_lines() {
                self.frames.put(plane)?;
            }
        }
        Ok(drawn)
    }

    /// The next regions, up to one for which a renderer might be free first that has just got one.
    fn give(&mut self, open: &mut VecDeque<Work>) -> Vec<Given> {
        let mut free: Vec<(u64, usize)> = self.running().map(|it| it.clock).zip(0..).collect();
        let (mut round, mut again) = (Vec::new(), u64::MAX);
        free.sort_unstable();
        for (clock, renderer) in free {
            let begun = clock.max(self.next);
            if begun >= again {
                break;
            }
            let Some(work) = open.pop_front() else { break };
            self.next = begun + 1;
            again = again.min(begun + 1); // for now
            round.push(Given { renderer, begun, work });
        }
        round
    }

    /// Waits for all that is sent, and reads the picture.
    fn frame(&mut self) -> Result<Frame, Error> {
        for running in &mut self.renderers {
            let running = running.get_mut().expect("no thread has failed");
            running.send_all(planes_of(self.config.side))?;
            for plane in running.whole_lines() {
                self.frames.put(plane)?;
            }
        }
        let size = self.config.size;
        let mut words = vec![0; size.pixels()];
        for region in 0..self.regions.count() {
            let PixelBox { left, top, right, bottom } = self.regions.pixels(region);
            for y in top..=bottom {
                let first = (y * size.width() + left) as usize;
                let line = &mut words[first..=first + (right - left) as usize];
                line.copy_from_slice(&self.frames.line(region, y - top)?[..line.len()]);
            }
        }
        Ok(Frame::from_words(size, words).expect("a word of 48 bits was read for each pixel"))
    }

    /// The clock in which the last region was sent.
    fn sent_at(&mut self) -> u64 {
        self.running().map(|it| it.clock).max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests;

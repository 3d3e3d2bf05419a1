//! The machine: bins of regions, renderers that take one after another, and the frame that they make (PP5-ARCH).
//!
//! Renderers do not wait for each other: they have instructions as fast as they take them, and what they send is taken at once. Each is a
//! simulation of its own, and they go on in the order of their clocks, so that the next region goes to the one that is free first, as the
//! region allocator gives it.

use tilewright_scenes::{Frame, PixelBox, Polygons};
use tilewright_sim::EngineKind;

use super::bin::Bin;
use super::config::Config;
use super::hardware::{Frames, Running, planes_of};
use super::outline::Binner;
use super::regions::Regions;
use super::report::{RegionReport, Report};
use crate::error::Error;
use crate::run::Watch;

/// What progress and errors call a frame.
const PHASE: &str = "drawing";
/// After so many primitives the caller is asked whether to go on.
const LOOK: u64 = 64;

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

        let mut host = Host::new(self, &regions, background)?;
        let mut drawn = Vec::with_capacity(bins.len());
        for (number, &region) in order.iter().enumerate() {
            host.done = number as f64 / order.len() as f64;
            watch.go_on(PHASE, host.done, host.time())?;
            drawn.push(host.draw(region, &bins[region], polygons, watch)?);
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
    background: [u8; 3],
    renderers: Vec<Running>,
    frames: Frames,
    /// The clock at which the allocator can give the next region: one a clock.
    next: u64,
    /// How much of the regions is drawn, from 0 to 1.
    done: f64,
}

impl<'a> Host<'a> {
    fn new(machine: &'a Machine, regions: &'a Regions, background: [u8; 3]) -> Result<Host<'a>, Error> {
        let config = &machine.config;
        let renderer = config.renderer()?;
        let used = config.renderers.min(regions.count() as u32);
        let renderers = (0..used)
            .map(|_| Running::new(&renderer, machine.engine, config.side_by_side))
            .collect::<Result<_, _>>()?;
        let frames = Frames::new(&config.frame_buffer()?, machine.engine)?;
        Ok(Host { config, regions, background, renderers, frames, next: 0, done: 0.0 })
    }

    /// Simulated picoseconds of the renderer that is farthest.
    fn time(&self) -> u64 {
        self.renderers.iter().map(|it| it.sim.time()).max().unwrap_or(0)
    }

    /// Has the renderer that is free first draw a region.
    fn draw(
        &mut self,
        region: usize,
        bin: &[u32],
        polygons: &Polygons,
        watch: &mut Watch,
    ) -> Result<RegionReport, Error> {
        let PixelBox { left, top, .. } = self.regions.pixels(region);
        let place = Bin { region, place: (left, top), side: self.config.side, strict: self.config.strict };
        let free = |(_, running): &(usize, &mut Running)| running.clock;
        let (renderer, running) = self.renderers.iter_mut().enumerate().min_by_key(free).expect("there is a renderer");
        while running.clock < self.next {
            running.step()?;
        }
        let begun = running.clock;
        self.next = begun + 1;
        let mut drawn = 0;
        place.begin(self.background).iter().try_for_each(|instruction| running.give(instruction))?;
        for (polygon, number) in bin.iter().zip(1..) {
            let instructions = place.draw(&polygons.polygons[*polygon as usize]);
            drawn += u64::from(!instructions.is_empty());
            instructions.iter().try_for_each(|instruction| running.give(instruction))?;
            if number % LOOK == 0 {
                watch.go_on(PHASE, self.done, running.sim.time())?;
            }
        }
        place.end().iter().try_for_each(|instruction| running.give(instruction))?;
        while !running.is_idle() {
            running.step()?;
        }
        running.given += 1;
        for plane in running.whole_lines() {
            self.frames.put(plane)?;
        }
        Ok(RegionReport { region, renderer, primitives: bin.len() as u64, drawn, begun, clocks: running.clock - begun })
    }

    /// Waits for all that is sent, and reads the picture.
    fn frame(&mut self) -> Result<Frame, Error> {
        for running in &mut self.renderers {
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
    fn sent_at(&self) -> u64 {
        self.renderers.iter().map(|it| it.clock).max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests;

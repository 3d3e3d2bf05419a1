//! The transaction-level model of the machine: its clocks without its circuit, for runs that take too long on the circuit.
//!
//! ```text
//! programs of regions -- Allocator --> a renderer each
//!      |                                   ^ free
//!      v                                   |
//!   [ Ring ] -- instructions --> [queue] Controller --save--> [Store]
//!      ^                                                         |
//!      '--------------------------- planes ----------------------'---> frame buffer
//! ```
//!
//! The model does not step through clocks: an instruction or a plane is a few comparisons. All clocks are those of the hardware
//! ([`PixelPlanes5`](tilewright_rtl::pixel_planes::machine::PixelPlanes5)). The tests compare each handshake, and so does
//! [`Machine::render`](super::Machine::render) on every frame.
//!
//! | file | content |
//! |---|---|
//! | `renderer` | queue, controller and backing store of a renderer |
//! | `ring` | which message goes next, and the credit of bits |
//! | `allocator` | which renderer gets the next region |
//! | `timing` | the result in clocks |

mod allocator;
mod renderer;
mod ring;
mod timing;

use tilewright_rtl::parameter::ParameterError;

use self::allocator::Allocator;
use self::renderer::Renderer;
use self::ring::Ring;
use super::config::Config;

pub use tilewright_rtl::pixel_planes::schedule::Step;
pub use timing::{RegionTiming, RendererTiming, RingTiming, Starved, Timing};

/// The model of a machine.
///
/// ```
/// use tilewright_machines::pixel_planes::{Config, model::{Model, Step}};
/// use tilewright_rtl::pixel_planes::programs::{clear, save};
/// use tilewright_scenes::Size;
///
/// // Regions of 1000 primitives that need the tree for 94 clocks each, in two instructions.
/// let steps = |primitives: usize| {
///     let (begin, end) = (Step::of(&clear(0)), Step::of(&save(0)));
///     [begin, vec![Step::on_tree(47); 2 * primitives], end].concat()
/// };
/// let config = Config { renderers: 2, ring: Config::AMPLE_RING, ..Config::new(Size::VGA) };
/// let timing = Model::new(&config)?.run(&[steps(1000), steps(1000), steps(10)]);
/// // The third region goes to the renderer that is free first.
/// assert_eq!(timing.renderers[0].regions, [0, 2]);
/// assert_eq!(timing.first_starved, None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Model {
    config: Config,
    ring: tilewright_rtl::pixel_planes::ring::Ring,
    /// Clocks from the controller of a renderer to its pixels.
    lag: u32,
}

impl Model {
    /// The clocks of a region beside those of its primitives, if instructions follow one another. Clearing and saving take 48 each. One goes from the
    /// allocator to the ring, one from there to the queue, and one to the controller. The last clock is the one in which the last bit is sent; in the
    /// next one the renderer gets another region. If instructions run side by side, some of these clocks overlap with edges of primitives:
    /// [`Model::clocks_of`].
    pub const REGION_OVERHEAD: u64 = 48 + 48 + 3;

    /// The model of the machine of that configuration; its screen does not matter.
    ///
    /// # Errors
    /// A parameter is out of range.
    pub fn new(config: &Config) -> Result<Model, ParameterError> {
        let lag = config.renderer()?.lag();
        Ok(Model { config: config.clone(), ring: config.ring()?, lag })
    }

    /// N, the clocks of a primitive with these instructions among others of its kind, and the clocks of a region beside its primitives, without
    /// waits. The update time is N for each primitive of the busiest renderer, and the second number for each of its regions (PP5-UT).
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::{Config, model::{Model, Step}};
    /// use tilewright_scenes::Size;
    ///
    /// let config = Config { side_by_side: false, ..Config::new(Size::VGA) };
    /// let (n, overhead) = Model::new(&config)?.clocks_of(&[Step::on_tree(47); 2]);
    /// assert_eq!((n, overhead), (94, Model::REGION_OVERHEAD));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn clocks_of(&self, primitive: &[Step]) -> (u64, u64) {
        // By then all primitives take the same clocks. A single region waits for no other, and ring and queue are ample.
        const MANY: u64 = 8;
        let fill = Step { on_tree: false, on_memory: true, saves: false, skip: 0, length: 24 };
        let save = Step { saves: true, length: 48, ..fill };
        let config = Config { renderers: 1, ring: Config::AMPLE_RING, queue: 64, ..self.config.clone() };
        let alone = Model::new(&config).expect("it differs in what any machine can have");
        let clocks = |count: u64| {
            let primitives = (0..count).flat_map(|_| primitive.iter().copied());
            let steps: Vec<Step> = [fill; 2].into_iter().chain(primitives).chain([save]).collect();
            alone.run(&[steps]).drawn
        };
        let n = clocks(MANY + 1) - clocks(MANY);
        (n, clocks(MANY) - MANY * n)
    }

    /// The clocks of the machine for regions, in the sequence in which renderers get them. A region is its instructions; the last one, and no other,
    /// saves it. The first region is given in clock 0.
    ///
    /// # Panics
    /// A region does not end with its save.
    pub fn run<P: AsRef<[Step]>>(&self, regions: &[P]) -> Timing {
        let mut run = Run::new(self, regions);
        while run.clock() {}
        Timing::new(regions, run.renderers, run.ring)
    }
}

/// A run in progress.
struct Run<'a, P> {
    regions: &'a [P],
    allocator: Allocator,
    renderers: Vec<Renderer<'a>>,
    ring: Ring,
}

impl<'a, P: AsRef<[Step]>> Run<'a, P> {
    fn new(model: &Model, regions: &'a [P]) -> Run<'a, P> {
        let Config { renderers, side, queue, side_by_side, .. } = model.config;
        for region in regions {
            let saves = region.as_ref().iter().position(|step| step.saves);
            assert_eq!(saves.map(|at| at + 1), Some(region.as_ref().len()), "a region ends with its save");
        }
        Run {
            regions,
            allocator: Allocator::new(renderers as usize, regions.len()),
            renderers: (0..renderers).map(|_| Renderer::new(side, queue, model.lag, side_by_side)).collect(),
            ring: Ring::new(&model.ring, renderers as usize),
        }
    }

    /// Advances to the next clock in which something happens; false if there is none.
    fn clock(&mut self) -> bool {
        let Some(now) = self.allocator.next().into_iter().chain(self.ring.next()).min() else { return false };
        if self.allocator.next() == Some(now) {
            let (region, number) = self.allocator.give(now);
            self.renderers[number].begin(region, self.regions[region].as_ref(), now);
            self.ring.ask(self.ring.instructions_of(number), now + 1);
        }
        self.ring.begin(now);
        while let Some(station) = self.ring.grant() {
            match self.ring.planes_of(station) {
                None => self.instruction(station, now),
                Some(number) => self.plane(number, now),
            }
        }
        true
    }

    /// An instruction comes to a renderer.
    fn instruction(&mut self, number: usize, now: u64) {
        let renderer = &mut self.renderers[number];
        renderer.receive(now);
        if let Some(room) = renderer.room() {
            self.ring.ask(self.ring.instructions_of(number), room);
        }
        self.look_at_save(number);
    }

    /// A plane of a renderer goes to the frame buffer.
    fn plane(&mut self, number: usize, now: u64) {
        let renderer = &mut self.renderers[number];
        match renderer.send(now) {
            false => self.ring.ask_on(number, now + 1),
            true => {
                self.ring.end_line();
                match renderer.is_sending() {
                    true => self.ring.ask(self.ring.station_of_planes(number), now + 1),
                    false => self.look_at_save(number),
                }
            }
        }
    }

    /// If a region has just been saved, schedules its planes, and frees its renderer.
    fn look_at_save(&mut self, number: usize) {
        if let Some((first_plane, free)) = self.renderers[number].save() {
            self.ring.ask(self.ring.station_of_planes(number), first_plane);
            self.allocator.free(number, free);
        }
    }
}

#[cfg(test)]
mod tests;

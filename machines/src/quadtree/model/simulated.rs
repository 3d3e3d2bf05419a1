//! The simulated hardware, with the same record as the model.

use super::record::{Packets, Run};
use crate::error::Error;
use crate::quadtree::counters::Counters;
use crate::quadtree::hardware::Hardware;
use crate::run::{PROGRESS_CLOCKS, Watch};
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::generator::QuadtreeGenerator;

/// The name of the run in progress and errors.
const PHASE: &str = "simulating";

/// A generator in simulation.
///
/// ```
/// use tilewright_machines::{Watch, quadtree::{Rectangles, model::{Model, Packets, Simulated}}};
/// use tilewright_rtl::parameter::Screen;
/// use tilewright_rtl::quadtree::{coverage_test::Test, format::{Format, Matrix}};
/// use tilewright_rtl::quadtree::{generator::QuadtreeGenerator, processor::{Queues, VideoProcessor}, raster::Form};
/// use tilewright_scenes::Size;
///
/// let format = Format::new(Screen::new(32, 32)?, Matrix::new(2, 1)?, 4)?;
/// let queues = Queues { broadcast: 1, packets: 2, windows: 2 };
/// let form = Form::parse("pipe", &format)?;
/// let generator = QuadtreeGenerator { video_processor: VideoProcessor { format, form, test: Test::Serial, queues } };
///
/// let rectangles = Rectangles::new(Size::new(32, 32)?, 30.0, 5.0, 1)?;
/// let polygons: Vec<_> = (0..10).map(|index| rectangles.polygon(index)).collect();
/// let (packets, mut watch) = (Packets::at_once(&polygons), Watch::default());
/// let simulated = Simulated::new(&generator)?.run(packets, &mut watch)?;
/// assert_eq!(Some(simulated), Model::new(&generator)?.run(packets, &mut watch));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Simulated(pub(super) Hardware);

impl Simulated {
    /// The simulation of a generator.
    ///
    /// # Errors
    /// The generator cannot be simulated.
    pub fn new(generator: &QuadtreeGenerator) -> Result<Simulated, Error> {
        Hardware::new(generator).map(Simulated)
    }

    /// The generator's run on packets, from its reset until it is idle.
    ///
    /// # Errors
    /// A packet has too many edges for the generator, the run was interrupted, or an assertion of the hardware failed.
    pub fn run(&mut self, packets: Packets, watch: &mut Watch) -> Result<Run, Error> {
        self.run_seen(packets, watch, |_, _| {})
    }

    /// The same; `see` gets the number of the clock before each edge.
    pub(super) fn run_seen(
        &mut self,
        packets: Packets,
        watch: &mut Watch,
        mut see: impl FnMut(&mut Simulated, u64),
    ) -> Result<Run, Error> {
        self.check(packets)?;
        self.0.reset(false)?;
        let (ready, idle) = (self.0.sim.i.packets.ready, self.0.sim.o.idle);
        let mut taken = Vec::with_capacity(packets.polygons.len());
        let mut clock = 0;
        let mut step = |this: &mut Simulated, done: usize| {
            see(this, clock);
            this.0.step()?;
            clock += 1;
            if clock.is_multiple_of(PROGRESS_CLOCKS) {
                watch.go_on(PHASE, done as f64 / packets.polygons.len().max(1) as f64, this.0.sim.time())?;
            }
            Ok::<u64, Error>(clock)
        };
        for (number, polygon) in packets.polygons.iter().enumerate() {
            for _ in 0..packets.pause(number) {
                step(self, number)?;
            }
            self.0.present(polygon);
            let mut is_ready = false;
            while !is_ready {
                is_ready = self.0.is_high(ready);
                let next = step(self, number)?;
                if is_ready {
                    taken.push(next - 1);
                }
            }
            self.0.withdraw();
        }
        while !self.0.is_high(idle) {
            step(self, packets.polygons.len())?;
        }
        let Counters { processors, broadcast } = self.0.counters();
        Ok(Run { taken, clocks: clock, broadcast, processors })
    }

    fn check(&self, packets: Packets) -> Result<(), ParameterError> {
        match packets.polygons.iter().map(|polygon| polygon.edges.len()).max() {
            Some(edges) if edges > self.0.edges => Err(ParameterError(format!(
                "a polygon of {edges} edges: this generator is built for polygons of up to {}",
                self.0.edges
            ))),
            _ => Ok(()),
        }
    }
}

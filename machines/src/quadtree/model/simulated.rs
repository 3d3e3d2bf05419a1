//! The hardware in simulation, for the same record as the model's.

use super::record::{Counts, Packets, Processor, Run};
use crate::error::Error;
use crate::run::Watch;
use std::sync::atomic::Ordering;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::generator::{QuadtreeGenerator, QuadtreeGeneratorIn, QuadtreeGeneratorOut};
use tilewright_scenes::{Edge, Plane, Polygon};
use tilewright_sim::Simulation;

/// Clocks between two looks at the flag that breaks a run off, and two reports of progress.
const CLOCKS_AT_ONCE: u64 = 1024;
/// What progress and errors call the run.
const PHASE: &str = "simulating";

/// A generator in simulation.
///
/// ```
/// use tilewright_machines::{Watch, quadtree::{Rectangles, model::{Model, Packets, Simulated}}};
/// use tilewright_rtl::parameter::Screen;
/// use tilewright_rtl::quadtree::{coverage_test::Test, format::{Format, Matrix}};
/// use tilewright_rtl::quadtree::{generator::QuadtreeGenerator, processor::Queues, raster::Form};
/// use tilewright_scenes::Size;
///
/// let format = Format::new(Screen::new(32, 32)?, Matrix::new(2, 1)?, 4)?;
/// let queues = Queues { broadcast: 1, packets: 2, windows: 2 };
/// let pipe = Form::parse("pipe", &format)?;
/// let generator = QuadtreeGenerator::new(format, pipe, Test::Serial, queues)?;
///
/// let rectangles = Rectangles::new(Size::new(32, 32)?, 30.0, 5.0, 1)?;
/// let polygons: Vec<_> = (0..10).map(|index| rectangles.polygon(index)).collect();
/// let (packets, mut watch) = (Packets::at_once(&polygons), Watch::default());
/// let simulated = Simulated::new(&generator)?.run(packets, &mut watch)?;
/// assert_eq!(Some(simulated), Model::new(&generator)?.run(packets, &mut watch));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Simulated {
    sim: Simulation<QuadtreeGeneratorIn, QuadtreeGeneratorOut>,
    edges: usize,
    processors: u32,
    levels: u32,
}

impl Simulated {
    /// The simulation of a generator.
    ///
    /// # Errors
    /// It could not be made.
    pub fn new(generator: &QuadtreeGenerator) -> Result<Simulated, Error> {
        let format = generator.format();
        let (edges, processors, levels) = (format.edges() as usize, format.matrix().processors(), format.levels());
        Ok(Simulated { sim: Simulation::of(generator)?, edges, processors, levels })
    }

    /// What the generator does with packets, from its reset until it is idle.
    ///
    /// # Errors
    /// A packet has more edges than the generator is built for, the run was broken off, or an assertion of the hardware does not hold.
    pub fn run(&mut self, packets: Packets, watch: &mut Watch) -> Result<Run, Error> {
        self.run_seen(packets, watch, |_, _| {})
    }

    /// The same; `see` is called before each edge with the number of its clock.
    pub(super) fn run_seen(
        &mut self,
        packets: Packets,
        watch: &mut Watch,
        mut see: impl FnMut(&mut Simulated, u64),
    ) -> Result<Run, Error> {
        self.check(packets)?;
        self.sim.set(self.sim.i.packets.valid, false);
        self.sim.try_reset()?;
        let mut taken = Vec::with_capacity(packets.polygons.len());
        let mut clock = 0;
        let mut step = |this: &mut Simulated, done: usize| {
            see(this, clock);
            this.sim.try_step()?;
            clock += 1;
            this.go_on(clock, done as f64 / packets.polygons.len().max(1) as f64, watch)?;
            Ok::<u64, Error>(clock)
        };
        for (number, polygon) in packets.polygons.iter().enumerate() {
            for _ in 0..packets.pause(number) {
                step(self, number)?;
            }
            self.offer(polygon);
            let mut is_ready = false;
            while !is_ready {
                is_ready = self.sim.get_u64(self.sim.i.packets.ready) == 1;
                let next = step(self, number)?;
                if is_ready {
                    taken.push(next - 1);
                }
            }
            self.sim.set(self.sim.i.packets.valid, false);
        }
        while self.sim.get_u64(self.sim.o.idle) == 0 {
            step(self, packets.polygons.len())?;
        }
        Ok(self.record(taken, clock))
    }

    fn check(&self, packets: Packets) -> Result<(), ParameterError> {
        match packets.polygons.iter().map(|polygon| polygon.edges.len()).max() {
            Some(edges) if edges > self.edges => Err(ParameterError(format!(
                "a polygon of {edges} edges: this generator is built for polygons of up to {}",
                self.edges
            ))),
            _ => Ok(()),
        }
    }

    fn go_on(&self, clock: u64, done: f64, watch: &mut Watch) -> Result<(), Error> {
        if clock.is_multiple_of(CLOCKS_AT_ONCE) {
            watch.report(PHASE, done);
            if watch.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                return Err(Error::Cancelled { phase: PHASE, time: self.sim.time() });
            }
        }
        Ok(())
    }

    /// Puts a packet at the port.
    fn offer(&mut self, polygon: &Polygon) {
        let port = self.sim.i.packets;
        let packet = port.payload;
        // Those beyond the last mean nothing.
        let lanes = |of: fn(&Edge) -> i32| polygon.edges.iter().map(of).chain(std::iter::repeat(0)).take(self.edges);
        for (row, values) in [
            (packet.edges.a, lanes(|edge| edge.a)),
            (packet.edges.b, lanes(|edge| edge.b)),
            (packet.edges.c, lanes(|edge| edge.c)),
        ] {
            self.sim.set_lanes(row, values);
        }
        self.sim.set(packet.last_edge, polygon.edges.len() - 1);
        let [red, green, blue] = &polygon.rgb;
        let planes = |of: fn(&Plane) -> u64| [&polygon.z, red, green, blue].map(of);
        self.sim.set_lanes(packet.planes.x, planes(|plane| plane.x));
        self.sim.set_lanes(packet.planes.y, planes(|plane| plane.y));
        self.sim.set_lanes(packet.planes.origin, planes(|plane| plane.origin));
        self.sim.set(packet.bounds.left, polygon.bounds.left);
        self.sim.set(packet.bounds.top, polygon.bounds.top);
        self.sim.set(packet.bounds.right, polygon.bounds.right);
        self.sim.set(packet.bounds.bottom, polygon.bounds.bottom);
        self.sim.set(port.valid, true);
    }

    fn record(&mut self, taken: Vec<u64>, clocks: u64) -> Run {
        let broadcast = self.sim.o.broadcast;
        let [busy, stalled, results] =
            [broadcast.busy, broadcast.stalled, broadcast.results].map(|p| self.sim.get_u64(p));
        let processors = (0..self.processors).map(|processor| Processor {
            units: self.counts(processor),
            fragments: self.sim.get_u64(self.sim.o.fragments),
        });
        let processors = processors.collect();
        Run { taken, clocks, broadcast: Counts { busy, stalled, results }, processors }
    }

    /// What the set-up and the levels of a video processor have counted so far.
    pub(super) fn counts(&mut self, processor: u32) -> Vec<Counts> {
        self.sim.set(self.sim.i.probe.processor, processor);
        let tally = self.sim.o.tally;
        let units = (0..=self.levels).map(|unit| {
            self.sim.set(self.sim.i.probe.unit, unit);
            let [busy, stalled, results] =
                [tally.busy, tally.stalled, tally.results].map(|port| self.sim.get_u64(port));
            Counts { busy, stalled, results }
        });
        units.collect()
    }
}

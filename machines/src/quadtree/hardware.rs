//! The simulated hardware of a generator from its host's side: packets at the port, the picture, the counters.

use tilewright_rtl::quadtree::generator::{QuadtreeGenerator, QuadtreeGeneratorIn, QuadtreeGeneratorOut};
use tilewright_rtl::quadtree::tally::Tally;
use tilewright_scenes::{Edge, Plane, Polygon};
use tilewright_sim::{Port, Simulation};

use super::counters::Counters;
use super::model::{Counts, Processor};
use crate::error::Error;

/// The running hardware.
pub(crate) struct Hardware {
    pub sim: Simulation<QuadtreeGeneratorIn, QuadtreeGeneratorOut>,
    /// The most edges of a packet.
    pub edges: usize,
    processors: u32,
    levels: u32,
}

impl Hardware {
    pub fn new(generator: &QuadtreeGenerator) -> Result<Hardware, Error> {
        let format = generator.format();
        let sim = Simulation::of(generator)?;
        let (edges, processors, levels) = (format.edges() as usize, format.matrix().processors(), format.levels());
        Ok(Hardware { sim, edges, processors, levels })
    }

    /// Resets everything but the pictures.
    pub fn reset(&mut self, strict: bool) -> Result<(), Error> {
        self.withdraw();
        self.sim.set(self.sim.i.swap, false);
        self.sim.set(self.sim.i.show.start, false);
        self.sim.set(self.sim.i.strict, strict);
        self.sim.set(self.sim.o.pixels.ready, true);
        Ok(self.sim.try_reset()?)
    }

    /// Puts a packet at the port.
    pub fn present(&mut self, packet: &Polygon) {
        let port = self.sim.i.packets.payload;
        // Fields beyond the last edge have no meaning.
        let room = self.edges;
        let edges = |of: fn(&Edge) -> i32| packet.edges.iter().map(of).chain(std::iter::repeat(0)).take(room);
        self.sim.set_lanes(port.edges.a, edges(|edge| edge.a));
        self.sim.set_lanes(port.edges.b, edges(|edge| edge.b));
        self.sim.set_lanes(port.edges.c, edges(|edge| edge.c));
        self.sim.set(port.last_edge, packet.edges.len() - 1);
        let [red, green, blue] = &packet.rgb;
        let planes = |of: fn(&Plane) -> u64| [&packet.z, red, green, blue].map(of);
        self.sim.set_lanes(port.planes.x, planes(|plane| plane.x));
        self.sim.set_lanes(port.planes.y, planes(|plane| plane.y));
        self.sim.set_lanes(port.planes.origin, planes(|plane| plane.origin));
        let bounds = packet.bounds;
        self.sim.set(port.bounds.left, bounds.left);
        self.sim.set(port.bounds.top, bounds.top);
        self.sim.set(port.bounds.right, bounds.right);
        self.sim.set(port.bounds.bottom, bounds.bottom);
        self.sim.set(self.sim.i.packets.valid, true);
    }

    /// Takes the packet from the port.
    pub fn withdraw(&mut self) {
        self.sim.set(self.sim.i.packets.valid, false);
    }

    /// Swaps the banks; takes a clock.
    pub fn swap(&mut self) -> Result<(), Error> {
        self.pulse(self.sim.i.swap)
    }

    /// Begins to read the picture, and to empty its bank for the next one; takes a clock.
    pub fn show(&mut self, [red, green, blue]: [u8; 3]) -> Result<(), Error> {
        self.sim.set(self.sim.i.show.background, u32::from_be_bytes([0, red, green, blue]));
        self.sim.set(self.sim.i.show.clear, true);
        self.pulse(self.sim.i.show.start)
    }

    fn pulse(&mut self, port: Port) -> Result<(), Error> {
        self.sim.set(port, true);
        self.step()?;
        self.sim.set(port, false);
        Ok(())
    }

    /// The neighbouring words that arrive at the next edge, if there are any.
    pub fn words(&mut self) -> Option<Vec<u64>> {
        self.is_high(self.sim.o.pixels.valid).then(|| self.sim.lanes(self.sim.o.pixels.payload))
    }

    pub fn is_high(&mut self, port: Port) -> bool {
        self.sim.get_u64(port) != 0
    }

    /// Advances to the next edge.
    pub fn step(&mut self) -> Result<(), Error> {
        Ok(self.sim.try_step()?)
    }

    /// Advances until the flag is high, but at most by that number of edges.
    pub fn run_until(&mut self, flag: Port, limit: u64) -> Result<(), Error> {
        self.sim.try_run_until(flag, limit)?;
        Ok(())
    }

    /// Clocks since the simulation began.
    pub fn clocks(&self) -> u64 {
        self.sim.cycles("clk").expect("a block of one clock has this one")
    }

    /// The counts of all units since the reset, modulo 2^32.
    pub fn counters(&mut self) -> Counters {
        let processors = (0..self.processors).map(|processor| self.counters_of(processor)).collect();
        Counters { processors, broadcast: self.counts(self.sim.o.broadcast) }
    }

    /// The counts of one video processor.
    pub fn counters_of(&mut self, processor: u32) -> Processor {
        self.sim.set(self.sim.i.probe.processor, processor);
        let units = (0..=self.levels).map(|unit| {
            self.sim.set(self.sim.i.probe.unit, unit);
            self.counts(self.sim.o.tally)
        });
        Processor { units: units.collect(), fragments: self.sim.get_u64(self.sim.o.fragments) }
    }

    fn counts(&mut self, tally: Tally<Port>) -> Counts {
        let [busy, stalled, results] = [tally.busy, tally.stalled, tally.results].map(|port| self.sim.get_u64(port));
        Counts { busy, stalled, results }
    }
}

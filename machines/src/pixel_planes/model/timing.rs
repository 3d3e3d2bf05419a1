//! The clocks of a run of the model.

use std::ops::Range;

use super::renderer::Renderer;
use super::ring::Ring;
use tilewright_rtl::pixel_planes::schedule::{Step, Times};

/// The clocks of a run, counted from that in which the first region is given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timing {
    /// By region, in the sequence in which they were given.
    pub regions: Vec<RegionTiming>,
    /// By renderer.
    pub renderers: Vec<RendererTiming>,
    /// The traffic on the ring.
    pub ring: RingTiming,
    /// The first clock in which all renderers had drawn their last region.
    pub drawn: u64,
    /// The first clock in which all planes had been sent.
    pub sent: u64,
    /// The first clock in which a renderer had to wait for an instruction.
    pub first_starved: Option<Starved>,
}

/// Clocks of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RegionTiming {
    /// The renderer that drew it.
    pub renderer: usize,
    /// The clock in which the renderer got it.
    pub given: u64,
    /// The first clock in which the renderer could get another one.
    pub free: u64,
    /// Clocks in which the renderer had to wait for its instructions.
    pub starved: u64,
    /// Clocks in which its save had to wait until the region before was sent.
    pub waited_for_store: u64,
}

/// Clocks of a renderer. Those of its instructions and planes are listed one after another, over all of its regions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RendererTiming {
    /// Its regions, by their place in the sequence in which they are given.
    pub regions: Vec<usize>,
    /// The clock in which it got each of them.
    pub given: Vec<u64>,
    /// The first clock in which it could get another one.
    pub free: Vec<u64>,
    /// The clock in which its queue took each instruction from the ring.
    pub arrived: Vec<u64>,
    /// The clock in which its controller took each instruction from the queue.
    pub taken: Vec<u64>,
    /// The clock of the first bit of each instruction.
    pub begun: Vec<u64>,
    /// The clock of the last bit of each instruction.
    pub ended: Vec<u64>,
    /// The first clock in which the first plane of each region could be sent.
    pub shown: Vec<u64>,
    /// The clock in which the ring took each plane.
    pub planes: Vec<u64>,
    /// Clocks in which it had a region.
    pub busy: u64,
    /// Clocks in which it could have taken the next instruction of its region, and its queue had none.
    pub starved: u64,
    /// The first of them.
    pub first_starved: Option<u64>,
    /// Clocks in which its queue had the save of its region, and waited only for the backing store.
    pub waited_for_store: u64,
    /// Clocks of both kinds by region.
    waits: Vec<[u64; 2]>,
    /// These clocks: those of the first kind, and those of the second.
    waited: [Vec<Range<u64>>; 2],
}

/// The traffic on the ring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RingTiming {
    /// Bits that it can bring in a clock.
    pub rate: u64,
    /// Instructions that it brought.
    pub instructions: u64,
    /// Planes that it brought.
    pub planes: u64,
    /// The bits of both.
    pub bits: u64,
    /// The clock of the last message.
    pub last: u64,
}

/// The place and clock at which a renderer had to wait for the ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Starved {
    /// The renderer; the lowest number of several.
    pub renderer: usize,
    /// The clock.
    pub clock: u64,
}

impl RingTiming {
    /// The bits that it brought, over those of its rate until the last one; the initial credit comes on top.
    pub fn load(&self) -> f64 {
        self.bits as f64 / (self.rate * (self.last + 1)) as f64
    }
}

impl RendererTiming {
    /// The clocks in which it had to wait for an instruction, and those in which it had to wait for the backing store.
    pub(in crate::pixel_planes) fn waited(&self) -> &[Vec<Range<u64>>; 2] {
        &self.waited
    }

    pub(super) fn begin(&mut self, region: usize, now: u64) {
        self.regions.push(region);
        self.given.push(now);
        self.waits.push([0, 0]);
    }

    /// An instruction arrives, which its controller could have taken at `ready`.
    pub(super) fn arrive(&mut self, now: u64, ready: u64) {
        self.arrived.push(now);
        let starved = (now + 1).saturating_sub(ready);
        if starved > 0 {
            self.first_starved.get_or_insert(ready);
            self.starved += starved;
            self.waits.last_mut().expect("it has a region")[0] += starved;
            self.waited[0].push(ready..now + 1);
        }
    }

    pub(super) fn take(&mut self, Times { taken, begins, ends }: Times) {
        self.taken.push(taken);
        self.begun.push(begins);
        self.ended.push(ends - 1);
    }

    /// Its region has been saved, after clocks in which the store was not free.
    pub(super) fn end(&mut self, waited: u64, shown: u64, free: u64) {
        self.waited_for_store += waited;
        self.waits.last_mut().expect("it has a region")[1] = waited;
        let save = *self.taken.last().expect("it took a save");
        self.waited[1].push(save - waited..save);
        self.shown.push(shown);
        self.free.push(free);
        self.busy += free - self.given.last().expect("it has a region");
    }
}

impl Timing {
    pub(super) fn new<P: AsRef<[Step]>>(regions: &[P], renderers: Vec<Renderer>, ring: Ring) -> Timing {
        let renderers: Vec<RendererTiming> = renderers.into_iter().map(|it| it.timing).collect();
        let none = RegionTiming { renderer: 0, given: 0, free: 0, starved: 0, waited_for_store: 0 };
        let mut by_region = vec![none; regions.len()];
        for (renderer, it) in renderers.iter().enumerate() {
            let clocks = it.given.iter().zip(&it.free).zip(&it.waits);
            for (region, ((&given, &free), &[starved, waited_for_store])) in it.regions.iter().zip(clocks) {
                by_region[*region] = RegionTiming { renderer, given, free, starved, waited_for_store };
            }
        }
        let starved = renderers.iter().zip(0..).filter_map(|(it, renderer)| Some((it.first_starved?, renderer)));
        let first_starved = starved.min().map(|(clock, renderer)| Starved { renderer, clock });
        Timing {
            drawn: by_region.iter().map(|it| it.free).max().unwrap_or(0),
            sent: renderers.iter().filter_map(|it| it.planes.last()).max().map_or(0, |last| last + 1),
            regions: by_region,
            renderers,
            ring: ring.timing,
            first_starved,
        }
    }
}

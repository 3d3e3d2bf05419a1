//! The classes of a processing element's clocks: each clock is in one class.

use serde::Serialize;

/// The activity of a processing element in a clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    Clearing,
    Geometry,
    Rasterization,
    Sending,
    Receiving,
    Stalled,
    Bus,
    Overflow,
    Sync,
    Swap,
}

/// Clocks of a processing element by class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Clocks {
    /// It cleared its patch table.
    pub clearing: u64,
    /// It transformed, lit and classified.
    pub geometry: u64,
    /// It took areas, clipped, set up, and drew rows and pixels (VC1-CLIP).
    pub rasterization: u64,
    /// It sent polygons over the bus.
    pub sending: u64,
    /// It received words.
    pub receiving: u64,
    /// A pixel or an entry waited for its local frame buffer.
    pub stalled: u64,
    /// A word waited for the bus, or it waited for the rest of a packet.
    pub bus: u64,
    /// It waited for the swap of an overflow.
    pub overflow: u64,
    /// It waited for the sync line, or for the next command.
    pub sync: u64,
    /// The line was high, and it waited for its swap.
    pub swap: u64,
}

impl Class {
    /// Its name in a report.
    pub fn name(self) -> &'static str {
        Clocks::NAMES[self as usize]
    }
}

impl Clocks {
    /// The names of a report, in its sequence.
    pub const NAMES: [&'static str; 10] =
        ["clearing", "geometry", "raster", "sending", "receiving", "stalled", "bus", "overflow", "sync", "swap"];

    /// All classes, in the sequence of the names.
    pub fn all(&self) -> [u64; 10] {
        let Clocks { clearing, geometry, rasterization, sending, receiving, stalled, bus, overflow, sync, swap } =
            *self;
        [clearing, geometry, rasterization, sending, receiving, stalled, bus, overflow, sync, swap]
    }

    /// The sum.
    pub fn total(&self) -> u64 {
        self.all().iter().sum()
    }

    /// Clocks in which its program worked.
    pub fn work(&self) -> u64 {
        self.all()[..5].iter().sum()
    }

    /// Clocks in which it does not wait for others. The fourth clock of an access, which takes a page, belongs to the access.
    pub fn busy(&self) -> u64 {
        self.work() + self.stalled
    }

    /// The clocks of that class.
    pub(crate) fn of(&mut self, class: Class) -> &mut u64 {
        match class {
            Class::Clearing => &mut self.clearing,
            Class::Geometry => &mut self.geometry,
            Class::Rasterization => &mut self.rasterization,
            Class::Sending => &mut self.sending,
            Class::Receiving => &mut self.receiving,
            Class::Stalled => &mut self.stalled,
            Class::Bus => &mut self.bus,
            Class::Overflow => &mut self.overflow,
            Class::Sync => &mut self.sync,
            Class::Swap => &mut self.swap,
        }
    }
}

impl std::ops::AddAssign for Clocks {
    fn add_assign(&mut self, other: Clocks) {
        let Clocks { clearing, geometry, rasterization, sending, receiving, stalled, bus, overflow, sync, swap } =
            other;
        self.clearing += clearing;
        self.geometry += geometry;
        self.rasterization += rasterization;
        self.sending += sending;
        self.receiving += receiving;
        self.stalled += stalled;
        self.bus += bus;
        self.overflow += overflow;
        self.sync += sync;
        self.swap += swap;
    }
}

//! How a module's own clock acts.

use tilewright_circuit::{Clock, DefaultClock, Edge, Reset};

/// How a module's own clock acts. A block has a module for each way in which it is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct OwnClock {
    pub reset: Reset,
    pub edge: Edge,
}

impl From<Clock> for OwnClock {
    fn from(Clock { reset, edge, .. }: Clock) -> OwnClock {
        OwnClock { reset, edge }
    }
}

impl From<DefaultClock> for OwnClock {
    fn from(DefaultClock { reset, edge, .. }: DefaultClock) -> OwnClock {
        OwnClock { reset, edge }
    }
}

//! The paper's estimate beyond 16 processing elements (VC1-EST): each alone, first without broadcast polygons, then with all of them.

use super::{Dealt, Model};

/// What the paper's two passes give for a view.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Estimate {
    /// By processing element: the clocks of its own polygons, with clearing, those that it sends among them.
    pub own: Vec<u64>,
    /// By processing element: those clocks with its rows of all broadcast polygons.
    pub with_broadcast: Vec<u64>,
}

impl Estimate {
    /// Clocks of the slowest.
    pub fn clocks(&self) -> u64 {
        self.with_broadcast.iter().copied().max().unwrap_or_default()
    }
}

impl Model {
    /// The paper's estimate for a view.
    pub fn estimate(&self, _view: &Dealt) -> Estimate {
        todo!("under way")
    }
}

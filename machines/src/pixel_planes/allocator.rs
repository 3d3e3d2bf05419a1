//! The region allocator as a plain model: it assigns regions to renderers.
//!
//! Source: PP5-ARCH (regions are assigned dynamically, so that the counts of primitives balance), facts E3. Regions are sorted by decreasing
//! bin size, and the next one goes to the first free renderer. The caller gives the time of a region.

/// The regions of each renderer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Allocation {
    /// By renderer.
    pub renderers: Vec<Renderer>,
}

/// The work of a renderer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Renderer {
    /// The numbers of its regions, in the sequence in which it takes them.
    pub regions: Vec<usize>,
    /// The primitives in their bins.
    pub primitives: u64,
    /// The time at which it has drawn the last one: the sum of their costs.
    pub busy: u64,
}

/// Assigns all regions to `renderers` renderers, at least one. Regions are sorted by decreasing size of their bins, and each goes to the
/// renderer that is free first. Between equals the lower number comes first. `cost` gives the time of a bin of that size. Empty bins are
/// assigned, too, because their regions have to be cleared and shown.
///
/// ```
/// use tilewright_machines::pixel_planes::{Renderer, allocate};
///
/// let allocation = allocate(&[10, 70, 0, 40, 20], 2, |size| 5 + 94 * size);
/// assert_eq!(allocation.renderers[0], Renderer { regions: vec![1, 2], primitives: 70, busy: 2 * 5 + 94 * 70 });
/// assert_eq!(allocation.renderers[1].regions, [3, 4, 0]);
/// assert_eq!((allocation.worst_load(), allocation.time()), (70, 3 * 5 + 94 * 70));
/// ```
///
/// # Panics
/// There is no renderer.
pub fn allocate(bins: &[u64], renderers: usize, cost: impl Fn(u64) -> u64) -> Allocation {
    let mut order: Vec<usize> = (0..bins.len()).collect();
    // Stable: equal bins keep their sequence.
    order.sort_by_key(|&region| std::cmp::Reverse(bins[region]));
    let mut renderers = vec![Renderer::default(); renderers];
    for region in order {
        let first = renderers.iter_mut().min_by_key(|renderer| renderer.busy).expect("at least one renderer");
        first.regions.push(region);
        first.primitives += bins[region];
        first.busy += cost(bins[region]);
    }
    Allocation { renderers }
}

impl Allocation {
    /// The primitives of the busiest renderer, P_w (PP5-UT). A primitive counts in each of its bins.
    pub fn worst_load(&self) -> u64 {
        self.renderers.iter().map(|renderer| renderer.primitives).max().unwrap_or_default()
    }

    /// The worst load over the mean load: 1 in perfect balance, and without primitives.
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::allocate;
    ///
    /// assert_eq!(allocate(&[30, 20, 10], 2, |size| size).imbalance(), 1.0);
    /// assert_eq!(allocate(&[30, 20, 20, 10], 3, |size| size).imbalance(), 1.125);
    /// ```
    pub fn imbalance(&self) -> f64 {
        let all: u64 = self.renderers.iter().map(|renderer| renderer.primitives).sum();
        match all {
            0 => 1.0,
            all => self.worst_load() as f64 * self.renderers.len() as f64 / all as f64,
        }
    }

    /// The time at which the last renderer is done.
    pub fn time(&self) -> u64 {
        self.renderers.iter().map(|renderer| renderer.busy).max().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests;

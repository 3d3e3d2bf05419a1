//! Table 1: times of ter1k as means over the views.

use super::found::Found;
use super::run::Timed;

/// A column of the table, in milliseconds.
pub struct Column {
    pub time: f64,
    pub geometry: f64,
    pub rasterization: f64,
    pub synchronization: f64,
}

impl Column {
    /// The virtual local frame buffer's.
    pub fn vlfb(found: &Found) -> Option<Column> {
        let views: Vec<&Timed> = found.plan.views().filter_map(|view| found.of(found.plan.vlfb(view))).collect();
        let mean = |of: &dyn Fn(&Timed) -> f64| views.iter().map(|it| of(it)).sum::<f64>() / views.len() as f64;
        (!views.is_empty()).then(|| Column {
            time: mean(&|it| it.time),
            geometry: mean(&|it| it.class("geometry")),
            rasterization: mean(&|it| it.class("raster")),
            synchronization: mean(&|it| it.class("sync")),
        })
    }
}

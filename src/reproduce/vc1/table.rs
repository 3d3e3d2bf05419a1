//! Table 1: times of ter1k as means over the views.

use super::found::Found;
use super::run::Timed;
use tilewright_report::{Section, Table};

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

/// What Table 1 prints of the virtual local frame buffer, in milliseconds.
const PRINTED: Column = Column { time: 33.4, geometry: 12.3, rasterization: 14.7, synchronization: 1.4 };

/// The section of the table.
pub fn section(found: &Found) -> Section {
    let columns = ["ms", "VLFB, paper", "VLFB, model"];
    let table = Table::new("table-1", "Table 1: ter1k with 16 processing elements", columns).note(
        "Geometry and rasterization are fitted: the costs of the programs are chosen so that these two are the paper’s, over its 48 views.",
    );
    let Some(vlfb) = Column::vlfb(found) else { return Section::new("Table 1") };
    let rows: [(&str, fn(&Column) -> f64); 4] = [
        ("rendering time", |it| it.time),
        ("geometry", |it| it.geometry),
        ("rasterization", |it| it.rasterization),
        ("global synchronization", |it| it.synchronization),
    ];
    let table = rows
        .into_iter()
        .fold(table, |table, (name, of)| table.row([name.into(), of(&PRINTED).into(), of(&vlfb).into()]));
    Section::new("Table 1: beside regions")
        .paragraph(
            "Times of ter1k as means over views 7.5 degrees apart, 48 of them in a full turn. Clusters are dealt once, in the first view. Each view stands still for 15 frames.",
        )
        .part(table)
}

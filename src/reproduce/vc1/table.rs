//! Table 1: times of ter1k as means over the views.

use super::found::Found;
use super::regions::Means;
use super::run::Timed;
use tilewright_report::{Cell, Section, Table};

/// The times of Table 1 in milliseconds: the virtual local frame buffer; 2x2 regions; 4x4 with 2 buffers and with 4.
pub const PRINTED: [Means; 4] = [
    Means { time: 33.4, geometry: 12.3, rasterization: 14.7, synchronization: 1.4 },
    Means { time: 51.0, geometry: 14.1, rasterization: 29.1, synchronization: 7.3 },
    Means { time: 73.5, geometry: 14.1, rasterization: 41.5, synchronization: 17.3 },
    Means { time: 66.9, geometry: 14.1, rasterization: 41.5, synchronization: 10.7 },
];
pub const NAMES: [&str; 4] = ["VLFB", "RB 2x2", "RB 4x4, 2 buffers", "RB 4x4, 4 buffers"];

/// The virtual local frame buffer's column, if its views were run.
pub fn vlfb(found: &Found) -> Option<Means> {
    let views: Vec<&Timed> = found.plan.views().filter_map(|view| found.of(found.plan.vlfb(view))).collect();
    let mean = |of: &dyn Fn(&Timed) -> f64| views.iter().map(|it| of(it)).sum::<f64>() / views.len() as f64;
    (!views.is_empty()).then(|| Means {
        time: mean(&|it| it.time),
        geometry: mean(&|it| it.class("geometry")),
        rasterization: mean(&|it| it.class("raster")),
        synchronization: mean(&|it| it.class("sync")),
    })
}

/// The section of the table.
pub fn section(found: &Found) -> Section {
    let section = Section::new("Table 1: beside regions").paragraph(
        "These are times of ter1k with 16 processing elements, as means over still views 7.5 degrees apart, 48 of them in a full circle. Clusters are assigned once, in the first view. The other \
             machine divides the screen into regions. A processing element does its geometry, then draws region after region, each into one of its buffers. It may begin a region when the one that \
             was in its buffer is merged, and a region is merged when all have drawn it. A processing element that has drawn its last region begins the geometry of the next frame. The paper \
             simulated that machine on its own, and so does the model here; there is no circuit of it.",
    );
    let regional = &found.regional;
    let section = section.part(table(found)).paragraph(format!(
        "Geometry and rasterization are fitted, and have no verdict. The classification of a polygon takes {} clocks. The clipping of a packet takes {:.0} clocks for each of its \
         regions, and {:.0} more for each beyond its first. The column of 2x2 regions alone would not tell one from the other, as many packets are in one region and few in several. No clipping needs so many \
         clocks.",
        super::regions::CLASSIFY, regional.region, regional.further
    ));
    section.part(unclipped(found))
}

type Row = (&'static str, fn(&Means) -> f64);
const ROWS: [Row; 4] = [
    ("rendering time", |it| it.time),
    ("geometry, fitted", |it| it.geometry),
    ("rasterization, fitted", |it| it.rasterization),
    ("global synchronization", |it| it.synchronization),
];

fn table(found: &Found) -> Table {
    let columns = NAMES.iter().flat_map(|name| [format!("{name}: paper"), format!("{name}: model")]);
    let table = Table::new("table-1", "Table 1", ["ms".to_owned()].into_iter().chain(columns));
    let model: Vec<Means> = vlfb(found).into_iter().chain(found.regional.machines).collect();
    ROWS.into_iter().fold(table, |table, (name, of)| {
        let cells = PRINTED.iter().zip(&model).flat_map(|(paper, model)| [of(paper), of(model)]);
        table.row([Cell::from(name)].into_iter().chain(cells.map(Cell::Number)))
    })
}

fn unclipped(found: &Found) -> Table {
    let table = Table::new("table-1-unclipped", "The same with free clipping", ["ms"].into_iter().chain(NAMES));
    let model: Vec<Means> = vlfb(found).into_iter().chain(found.regional.unclipped).collect();
    ROWS.into_iter().fold(table, |table, (name, of)| {
        let name = name.trim_end_matches(", fitted");
        table.row([Cell::from(name)].into_iter().chain(model.iter().map(|it| Cell::Number(of(it)))))
    })
}

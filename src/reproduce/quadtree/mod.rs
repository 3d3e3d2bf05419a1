//! The page of the sparse-raster quadtree generator: figures 3 to 6 of its paper, and its statements (facts A2, A3, B).

mod checks;
mod coupling;
mod curves;
mod found;
mod frames;
mod plan;
mod reasons;
mod statements;

use super::effort::Effort;
use crate::shell::Failure;
use found::Found;
use tilewright_machines::Watch;
use tilewright_machines::quadtree::{Figures, Rasters, Shape};
use tilewright_report::{Page, Provenance, Section};

/// The k of each matrix of more than one processor in the paper's figures.
const SIZES: [u32; 4] = [1, 2, 3, 4];
/// The areas, as printed in the paper, at which a processor of the matrix has one window of the last level: for k = 2, 3 and 4.
const TURNING: [f64; 3] = [1.8, 23.3, 157.0];

/// Measures and makes the page; `None` if interrupted.
pub fn page(effort: Effort, watch: &mut Watch) -> Result<Option<Page>, Failure> {
    let Some(found) = Found::all(effort, watch)? else { return Ok(None) };
    let provenance = Provenance::new("tilewright", env!("CARGO_PKG_VERSION"), effort.command("quadtree", "--polygons"))
        .seeds([effort.seed])
        .parameter("screen", "1024x1024", "m = 10, as in the paper")
        .parameter("matrices", "2ᵏ x 2ᵏ processors, k = 0 to 4", "as in the paper")
        .parameter("aperture", "2x2 pixels", "as in the paper")
        .parameter("polygons", "rectangles of 5:1 at random angles and places", "L = 1.514, as in the paper")
        .parameter("coverage test", "an edge a clock: t_e = 4 clocks, k_p/k_e = 1", "as in the paper");
    let page = Page::new("A sparse-raster quadtree generator", provenance)
        .paragraph(
            "A matrix of p x q video processors draws a screen together. Each processor has every p-th pixel of every q-th line. It finds the pixels that a polygon covers by dividing windows of its \
             sparse raster into quarters. From the mean number of windows the paper estimates how fast such a matrix is, and how well its processors are used.",
        )
        .paragraph(
            "This page compares the estimates with three programs that run on random rectangles. A plain count goes through the windows of many polygons; its only time is the cost of a test. The \
             transaction model has the clocks of a running matrix without its circuit. RTL is the circuit itself, simulated clock by clock, with the transaction model’s rectangles. The formulas are \
             the paper’s, restored where the print is damaged.",
        )
        .section(curves::windows(&found))
        .section(curves::window_sizes(&found))
        .section(curves::stacks(&found))
        .section(curves::pipelines(&found))
        .section(coupling::section(&found))
        .section(frames::section(&found.frames))
        .section(
            Section::new("Statements")
                .paragraph(
                    "The plain count, which has the most rectangles, decides on statements about windows and busy clocks. The checks \
                     below show that the circuit’s counters are the same.",
                )
                .part(statements::verdicts(&found).note(effort.note())),
        )
        .section(checks::section(&found));
    Ok(Some(page))
}

/// The matrix of 2^k x 2^k of the paper.
fn matrix(k: u32) -> Rasters {
    Rasters::square(k, 10)
}

/// The paper's rectangle of that area.
fn shape(area: f64) -> Shape {
    Shape::paper(area)
}

/// Areas for the curves of formulas, from 1 to 10^5 pixels, evenly on a logarithmic axis.
fn areas() -> impl Iterator<Item = f64> {
    (0..=60).map(|step| 10_f64.powf(f64::from(step) / 12.0))
}

/// The values of the paper's formulas for a matrix and an area, with k_p/k_e = 1.
fn by_formula(k: u32, area: f64) -> Figures {
    let stages = |matrix: Rasters| matrix.stages_of(shape(area), 1.0);
    Figures::of(&matrix(k), &stages(matrix(k)), &stages(matrix(0)))
}

//! The page of the sparse-raster quadtree generator: figures 3 to 6 of its paper, and what it states (facts A2, A3, B).

mod curves;
mod statements;

use super::Effort;
use crate::shell::Failure;
use tilewright_machines::quadtree::{Figures, Point, Rasters, Sample, Shape, Study};
use tilewright_machines::{Error, Watch};
use tilewright_report::{Page, Provenance, Section};

/// The matrices of more than one processor that the paper draws: each k.
const SIZES: [u32; 4] = [1, 2, 3, 4];
/// The areas at which a processor of the matrix of k = 2, 3 and 4 has one window of the last level, as the paper prints them.
const TURNING: [f64; 3] = [1.8, 23.3, 157.0];

/// Measures and makes the page; `None` if it was interrupted.
pub fn page(effort: Effort, watch: &mut Watch) -> Result<Option<Page>, Failure> {
    let (seed, study) = (effort.seed, study(effort));
    let Some(points) = study.run(watch).map_err(Error::from)? else { return Ok(None) };
    let counted = Counted { points, seed };

    let provenance = Provenance::new("tilewright", env!("CARGO_PKG_VERSION"), command(effort))
        .seeds([seed])
        .parameter("screen", "1024x1024", "m = 10, as in the paper")
        .parameter("matrices", "2ᵏ x 2ᵏ processors, k = 0 to 4", "as in the paper")
        .parameter("aperture", "2x2 pixels", "as in the paper")
        .parameter("polygons", "rectangles of 5:1 at random angles and places", "L = 1.514, as in the paper")
        .parameter("coverage test", "an edge a clock: t_e = 4 clocks, k_p/k_e = 1", "as in the paper");
    let page = Page::new("A sparse-raster quadtree generator", provenance)
        .paragraph(
            "A matrix of p x q video processors draws a screen together: each has every p-th pixel of every q-th line, and finds those that a \
             polygon covers by dividing windows of its sparse raster into quarters. The paper estimates from the mean number of windows \
             how fast such a matrix is, and how well its processors are used.",
        )
        .paragraph(
            "Here the estimates stand beside counts. The formulas are those of the paper, restored where the print is damaged. The \
             transaction model counts the windows and clocks of random rectangles.",
        )
        .section(Section::new("Statements").part(statements::verdicts(&counted)))
        .section(curves::windows(&counted))
        .section(curves::window_sizes())
        .section(curves::stacks(&counted))
        .section(curves::pipelines(&counted));
    Ok(Some(page))
}

/// What makes the same page.
fn command(Effort { seed, polygons }: Effort) -> String {
    let polygons = polygons.map_or(String::new(), |most| format!(" --polygons {most}"));
    format!("tilewright reproduce quadtree -o report/ --seed {seed}{polygons}")
}

/// The paper's study, with the areas at which it says that something turns.
fn study(Effort { seed, polygons }: Effort) -> Study {
    let mut study = Study::paper(seed);
    let turning = TURNING.map(|area| Sample { area, polygons: 8_000 });
    study.samples.extend(turning);
    study.samples.sort_by(|a, b| a.area.total_cmp(&b.area));
    let most = polygons.unwrap_or(u64::MAX);
    study.samples.iter_mut().for_each(|sample| sample.polygons = sample.polygons.min(most));
    study
}

/// What was counted, and from which seed.
struct Counted {
    points: Vec<Point>,
    seed: u64,
}

impl Counted {
    /// The points of the matrix of 2^k x 2^k, by area.
    fn of(&self, k: u32) -> impl Iterator<Item = &Point> {
        self.points.iter().filter(move |point| point.matrix.p == 1 << k)
    }

    /// The point of a matrix and an area.
    fn at(&self, k: u32, area: f64) -> &Point {
        self.of(k).find(|point| point.sample.area == area).expect("the study has that area")
    }
}

/// The matrix of 2^k x 2^k of the paper.
fn matrix(k: u32) -> Rasters {
    Rasters::square(k, 10)
}

/// The width of the windows of a level as the coverage tests have them, in parts of their spacing.
fn built_size(k: u32, level: u32) -> f64 {
    f64::from(matrix(k).window(level).0) / f64::from(matrix(k).spacing(level).0)
}

/// The paper's rectangle of that area.
fn shape(area: f64) -> Shape {
    Shape::paper(area)
}

/// Areas for the curves of formulas, from 1 to 10^5 pixels, evenly on a logarithmic axis.
fn areas() -> impl Iterator<Item = f64> {
    (0..=60).map(|step| 10_f64.powf(f64::from(step) / 12.0))
}

/// What the paper's formulas say of a matrix and an area, with k_p/k_e = 1.
fn by_formula(k: u32, area: f64) -> Figures {
    let stages = |matrix: Rasters| matrix.stages_of(shape(area), 1.0);
    Figures::of(&matrix(k), &stages(matrix(k)), &stages(matrix(0)))
}

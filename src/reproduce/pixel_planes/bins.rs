//! Regions of a vector, H_v: the paper's two formulas and counts, by length, angle and side of regions.

use super::plan::{ANGLE, LENGTH, Plan, SIDE, SIDES};
use crate::reproduce::words::short;
use crate::shell::Failure;
use tilewright_machines::pixel_planes::{Binner, Bins, Outline, Point, Regions, Shape, Study, Vectors};
use tilewright_machines::{Error, Watch};
use tilewright_report::{Axis, Chart, Origin, Section, Series};
use tilewright_scenes::{ScreenVertex, angle};

/// The counts, by the side of regions.
pub struct Counted {
    points: Vec<(u32, Point)>,
    /// The most regions of one column, or of one row for a steep vector, to which a long vector was binned by columns.
    pub most_in_a_column: usize,
    seed: u64,
}

/// Each binner's name, and its number.
type Named<T> = [(&'static str, T); 3];

/// By the bounding box, by whole columns, and by the vector itself.
pub fn named<T>(Bins { by_box, by_columns, tight }: Bins<T>) -> Named<T> {
    [("box", by_box), ("columns", by_columns), ("itself", tight)]
}

impl Counted {
    /// Counts; `None` if interrupted.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Option<Counted>, Failure> {
        let (studies, cancel) = (plan.studies(), watch.cancel);
        let count = |study: &Study| study.run(&mut Watch { progress: None, cancel });
        let Some(all) = watch.each("counting regions", &studies, count) else { return Ok(None) };
        let mut points = Vec::new();
        for (study, counted) in studies.iter().zip(all) {
            let Some(counted) = counted.map_err(Error::from)? else { return Ok(None) };
            points.extend(counted.into_iter().map(|point| (study.regions.side(), point)));
        }
        let long = Vectors::new(Regions::paper(), LONGEST, None, plan.effort.seed).map_err(Error::from)?;
        let all = (0..plan.effort.at_most(20_000)).map(|number| most_in_a_column(&long.ends(number)));
        Ok(Some(Counted { points, most_in_a_column: all.max().unwrap_or_default(), seed: plan.effort.seed }))
    }

    pub fn origin(&self) -> Origin {
        Origin::count([self.seed])
    }

    /// Points with the paper's regions.
    pub fn points(&self) -> impl Iterator<Item = &Point> {
        self.points.iter().filter(|(side, _)| *side == SIDE).map(|(_, point)| point)
    }

    /// The point of the paper's vectors with regions of that side.
    pub fn example(&self, of: u32) -> &Point {
        let is_it = |(side, point): &&(u32, Point)| *side == of && point.shape == EXAMPLE;
        &self.points.iter().find(is_it).expect("the paper's vectors are counted for all sides").1
    }

    /// Counted means along `x`, of some points.
    fn curve(&self, wanted: impl Fn(&Shape) -> bool, x: impl Fn(&Shape) -> f64) -> Named<Vec<(f64, f64)>> {
        let of = |mean: fn(&Point) -> f64| {
            let points = self.points().filter(|point| wanted(&point.shape));
            points.map(|point| (x(&point.shape), mean(point))).collect()
        };
        named(Bins {
            by_box: of(|it| it.counted.by_box.mean),
            by_columns: of(|it| it.counted.by_columns.mean),
            tight: of(|it| it.counted.tight.mean),
        })
    }
}

/// The length of the longest vectors, in pixels.
const LONGEST: f64 = 400.0;

/// The most regions of one column to which a vector is binned by columns, or of one row if it is steeper than 45 degrees.
fn most_in_a_column(ends: &[ScreenVertex; 2]) -> usize {
    let (regions, [from, to]) = (Regions::paper(), ends);
    let is_steep = from.x.abs_diff(to.x) < from.y.abs_diff(to.y);
    let columns = regions.columns() as usize;
    let lane = |region: usize| if is_steep { region / columns } else { region % columns };
    let mut lanes: Vec<usize> = regions.of(&Outline::of(ends), Binner::Columns).into_iter().map(lane).collect();
    lanes.sort_unstable();
    lanes.chunk_by(|one, other| one == other).map(<[usize]>::len).max().unwrap_or_default()
}

/// The paper's vectors.
pub const EXAMPLE: Shape = Shape { length: LENGTH, angle: ANGLE };

/// The length of a vector along its longer axis over a region's side: L cos t/S.
pub fn long_side(Shape { length, angle }: Shape) -> f64 {
    let (sine, cosine) = angle::sin_cos(angle);
    length * sine.abs().max(cosine.abs()) / f64::from(SIDE)
}

/// The formulas' values for a shape.
fn by_formula(shape: Shape, side: u32) -> Named<f64> {
    named(Bins { by_box: shape.by_box(side), by_columns: shape.by_columns(side), tight: shape.tight(side) })
}

/// The section of the curves.
pub fn section(counted: &Counted) -> Section {
    Section::new("Regions of a vector, H_v")
        .paragraph(
            "A primitive is processed once for each region to which it is binned, so the work grows with the regions of a vector. There are three ways to bin a vector. By its bounding box, it goes to \
             all regions that the box meets. By columns, it goes to at most two regions of each column, or of each row if it is steeper than 45 degrees. By itself, it goes only to the regions that \
             it meets.",
        )
        .paragraph(
            "Lines are formulas. The one for columns is the paper’s. The one for boxes is missing in its text and is restored from the numbers that it prints. The one for the vector itself, 1 + \
             L (cos θ + sin θ)/S, is exact. Plus signs are bins of random vectors on a 1280x1024 screen, at least a region away from its border. The cross is the 1.63 that the paper prints for its \
             example.",
        )
        .figure(claim(counted, LENGTH, ANGLE), by_length(counted, ANGLE))
        .figure(claim(counted, LONGEST, 15.0), by_length(counted, 15.0))
        .figure(claim(counted, LENGTH, 30.0), by_angle(counted, LENGTH))
        .figure(claim(counted, LONGEST, ANGLE), by_angle(counted, LONGEST))
        .figure(by_half_the_side(counted), by_side(counted))
}

/// The claim of the figure by length.
fn claim(counted: &Counted, length: f64, angle: f64) -> String {
    let is_it = |point: &&Point| point.shape == Shape { length, angle };
    let bins = counted.points().find(is_it).expect("it is counted").counted;
    let [by_box, by_columns, tight] = named(bins).map(|(_, mean)| short(mean.mean));
    format!(
        "A vector of {length} pixels at {angle} degrees goes to {by_box} regions by its box, {by_columns} by columns, and {tight} by itself."
    )
}

fn by_half_the_side(counted: &Counted) -> String {
    let [half, whole] = [SIDE / 2, SIDE].map(|side| short(counted.example(side).counted.by_box.mean));
    format!(
        "With regions of {} pixels a side a vector’s box meets {half} of them; with {SIDE} pixels it meets {whole}.",
        SIDE / 2
    )
}

const LENGTH_AXIS: &str = "length L, pixels";
const REGIONS: &str = "regions a vector, H_v";

fn by_length(counted: &Counted, angle: f64) -> Chart {
    let chart = Chart::new(
        format!("regions-{angle}-degrees"),
        format!("Regions of a vector by its length, at {angle} degrees"),
        Axis::linear(LENGTH_AXIS),
        Axis::linear(REGIONS),
    );
    let points = counted.curve(|shape| shape.angle == angle, |shape| shape.length);
    let lengths = (0..=50).map(|step| (8.0 * f64::from(step)).max(1.0));
    let chart = curves(chart, counted, lengths, points, |length| by_formula(Shape { length, angle }, SIDE));
    if angle == ANGLE { chart.series(printed(LENGTH)) } else { chart }
}

fn by_angle(counted: &Counted, length: f64) -> Chart {
    let chart = Chart::new(
        format!("regions-{length}-pixels"),
        format!("Regions of a vector of {length} pixels by its angle"),
        Axis::linear("angle θ, degrees"),
        Axis::linear(REGIONS),
    );
    let points = counted.curve(|shape| shape.length == length, |shape| shape.angle);
    let angles = (0..=45).map(|step| 2.0 * f64::from(step));
    let chart = curves(chart, counted, angles, points, |angle| by_formula(Shape { length, angle }, SIDE));
    if length == LENGTH { chart.series(printed(ANGLE)) } else { chart }
}

fn by_side(counted: &Counted) -> Chart {
    let chart = Chart::new(
        "regions-by-side",
        format!("Regions of a vector of {LENGTH} pixels at {ANGLE} degrees by the side of regions"),
        Axis::linear("side of a region S, pixels"),
        Axis::linear(REGIONS),
    );
    let sides = (4..=32).map(|step| 8.0 * f64::from(step));
    let point = |side: u32| {
        let counted = &counted.example(side).counted;
        named(*counted).map(|(name, mean)| (name, (f64::from(side), mean.mean)))
    };
    let all = SIDES.map(point);
    let points = [0, 1, 2].map(|binner: usize| (all[0][binner].0, all.iter().map(|it| it[binner].1).collect()));
    curves(chart, counted, sides, points, |side| by_formula(EXAMPLE, side as u32)).series(printed(f64::from(SIDE)))
}

/// The formulas' curves, also at the places of all points, and the points.
fn curves(
    chart: Chart,
    counted: &Counted,
    places: impl Iterator<Item = f64>,
    points: Named<Vec<(f64, f64)>>,
    formula: impl Fn(f64) -> Named<f64>,
) -> Chart {
    let mut places: Vec<f64> = places.chain(points[0].1.iter().map(|point| point.0)).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    points.into_iter().enumerate().fold(chart, |chart, (binner, (name, points))| {
        let curve = places.iter().map(|&place| (place, formula(place)[binner].1));
        chart.series(Series::new(name, Origin::Formula, curve)).series(Series::new(name, counted.origin(), points))
    })
}

/// The paper's number.
fn printed(x: f64) -> Series {
    Series::new("box", Origin::Paper, [(x, super::PRINTED)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::effort::Effort;

    #[test]
    fn another_seed_counts_other_vectors() {
        let counted = |seed| {
            let plan = Plan { effort: Effort { seed, most: Some(20) } };
            let counted = Counted::all(&plan, &mut Watch::default()).ok().flatten().expect("nothing stops it");
            named(counted.example(SIDE).counted).map(|(_, mean)| mean.mean)
        };
        assert_eq!(counted(1), counted(1));
        assert_ne!(counted(1), counted(2));
    }
}

//! Table 1's other machine: the screen in regions, on the model (VC1-T1).

use super::plan::{Case, Plan};
use super::run::CLOCK;
use tilewright_machines::vc1::Clocks;
use tilewright_machines::vc1::model::{Model, RegionFrame, Regions};
use tilewright_machines::{Error, Watch};

/// Columns and rows of regions, and buffers, in the order of Table 1.
const MACHINES: [(u32, u32); 3] = [(2, 2), (4, 2), (4, 4)];
/// Clocks to classify a polygon, fitted: 14.1 ms of geometry instead of 12.3.
pub const CLASSIFY: u64 = 92;
/// Rasterization of 2x2 and of 4x4 regions in ms, to which the clocks of clipping are fitted.
pub const RASTERIZATION: [f64; 2] = [29.1, 41.5];
/// Clocks of clipping for trial runs.
const TRIED: u64 = 1000;

/// Means over the views, in ms.
#[derive(Clone, Copy, Debug, Default)]
pub struct Means {
    pub time: f64,
    pub geometry: f64,
    pub rasterization: f64,
    pub synchronization: f64,
}

/// The results for each machine of Table 1.
#[derive(Default)]
pub struct Regional {
    /// Clocks for each region of a packet, and for each region beyond its first.
    pub region: f64,
    pub further: f64,
    pub machines: [Means; 3],
    /// With free clipping.
    pub unclipped: [Means; 3],
}

/// Clocks of clipping.
#[derive(Clone, Copy)]
struct Clipping {
    region: u64,
    further: u64,
}

const NOTHING: Clipping = Clipping { region: 0, further: 0 };

impl Regional {
    /// Runs all; `None` if interrupted.
    pub fn found(plan: &Plan, watch: &mut Watch) -> Option<Result<Regional, Error>> {
        let [region, further] = [Clipping { region: TRIED, ..NOTHING }, Clipping { further: TRIED, ..NOTHING }];
        let mut means = |clipping| means(plan, clipping, watch);
        let tried = (means(NOTHING)?, means(region)?, means(further)?);
        let (unclipped, by_region, by_further) = match tried {
            (Ok(unclipped), Ok(by_region), Ok(by_further)) => (unclipped, by_region, by_further),
            (Err(error), ..) | (_, Err(error), _) | (.., Err(error)) => return Some(Err(error)),
        };
        // Rasterization is a sum, and so it is linear in both.
        let of = |all: &[Means; 3]| [all[0].rasterization, all[1].rasterization];
        let base = of(&unclipped);
        let slope = |all: &[Means; 3]| [0, 1].map(|at| (of(all)[at] - base[at]) / TRIED as f64);
        let wanted = [0, 1].map(|at| RASTERIZATION[at] - base[at]);
        let [region, further] = solved(slope(&by_region), slope(&by_further), wanted);
        let clipping = Clipping { region: region.round().max(0.0) as u64, further: further.round().max(0.0) as u64 };
        let machines = match means(clipping)? {
            Ok(machines) => machines,
            Err(error) => return Some(Err(error)),
        };
        let hurry = plan.hurry(16);
        Some(Ok(Regional { region: region * hurry, further: further * hurry, machines, unclipped }))
    }
}

/// Solves one x + other y = wanted for x and y.
fn solved(one: [f64; 2], other: [f64; 2], wanted: [f64; 2]) -> [f64; 2] {
    let determinant = one[0] * other[1] - one[1] * other[0];
    let x = (wanted[0] * other[1] - wanted[1] * other[0]) / determinant;
    let y = (one[0] * wanted[1] - one[1] * wanted[0]) / determinant;
    [x, y]
}

/// The means over all views for each machine, with that clipping.
fn means(plan: &Plan, clipping: Clipping, watch: &mut Watch) -> Option<Result<[Means; 3], Error>> {
    let views: Vec<u32> = plan.views().collect();
    let all = watch.each("drawing regions", &views, |view| of_view(plan, clipping, *view))?;
    let count = views.len() as f64;
    let sum = all.into_iter().try_fold([Means::default(); 3], |sums, of_view| {
        let of_view = of_view?;
        Ok(std::array::from_fn(|at| sums[at].and(&of_view[at])))
    });
    Some(sum.map(|sums: [Means; 3]| sums.map(|sum| sum.part(count))))
}

fn of_view(plan: &Plan, Clipping { region, further }: Clipping, view: u32) -> Result<[Means; 3], Error> {
    let case = Case { apr: None, ..plan.vlfb(view) };
    let (model, hurry) = (Model::new(case.config(plan))?, plan.hurry(16));
    let first = model.deal(&case.view(plan, 0)?, None)?;
    let dealt = model.deal(&case.view(plan, view)?, Some(&first))?;
    let classify = (CLASSIFY as f64 / hurry).round() as u64;
    Ok(MACHINES.map(|(side, buffers)| {
        let machine = Regions { columns: side, rows: side, buffers, classify, region, further };
        Means::of(&model.by_regions(&machine, &dealt), hurry)
    }))
}

impl Means {
    fn of(frame: &RegionFrame, hurry: f64) -> Means {
        let mean = |of: fn(&Clocks) -> u64| {
            frame.processors.iter().map(of).sum::<u64>() as f64 / frame.processors.len() as f64 * CLOCK * hurry
        };
        Means {
            time: frame.interval as f64 / 1e9 * hurry,
            geometry: mean(|it| it.geometry),
            rasterization: mean(|it| it.rasterization),
            synchronization: mean(|it| it.sync),
        }
    }

    fn and(&self, other: &Means) -> Means {
        Means {
            time: self.time + other.time,
            geometry: self.geometry + other.geometry,
            rasterization: self.rasterization + other.rasterization,
            synchronization: self.synchronization + other.synchronization,
        }
    }

    fn part(&self, count: f64) -> Means {
        Means {
            time: self.time / count,
            geometry: self.geometry / count,
            rasterization: self.rasterization / count,
            synchronization: self.synchronization / count,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_equations_have_their_solution() {
        assert_eq!(solved([2.0, 1.0], [1.0, 3.0], [5.0, 10.0]), [1.0, 3.0]);
    }
}

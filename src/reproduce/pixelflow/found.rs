//! What was found in the model: latencies of so many primitives, and primitives of so much latency.

use super::plan::{Case, EIGHT, LATENCIES, Plan};
use crate::shell::Failure;
use tilewright_machines::pixelflow::{Costs, Samples, Shades, Simulated, Software, System};
use tilewright_machines::{Error, Watch};
use tilewright_report::Origin;
use tilewright_rtl::parameter::ParameterError;

/// Boxes that are binned to count their regions.
const COUNTED: u64 = 300_000;

/// All that the page is made of.
pub struct Found {
    pub curves: Vec<Curve>,
    /// What pre-sorting gains, by the time of a primitive.
    pub gains: Vec<Gain>,
    /// Regions that a box is in, with one sample and with eight.
    overlaps: [f64; 2],
    seed: u64,
}

/// A system's latency.
pub struct Curve {
    pub case: Case,
    pub points: Vec<Point>,
    /// The primitives of a frame of each of [`LATENCIES`]; none if it takes more than are tried, or the least frame takes longer.
    pub within: Vec<Option<u64>>,
}

/// A frame.
pub struct Point {
    pub primitives: u64,
    pub found: Simulated,
}

/// Primitives within 35 ms, with pre-sorting in parts of those without.
pub struct Gain {
    /// What a primitive takes in a region, in microseconds.
    pub rasterizes: f64,
    pub samples: Samples,
    pub formula: f64,
    pub model: Option<f64>,
}

impl Found {
    /// Lets all of it run; `None` if it was interrupted.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Option<Found>, Failure> {
        let cases: Vec<Case> = Plan::all_cases().collect();
        let seed = plan.effort.seed;
        let Some(curves) = watch.each("timing", &cases, |case| Curve::of(case, plan)) else { return Ok(None) };
        let curves = curves.into_iter().collect::<Result<Vec<_>, _>>().map_err(Error::from)?;
        let specs = Gain::specs();
        let Some(gains) = watch.each("comparing", &specs, |spec| Gain::of(*spec, plan)) else { return Ok(None) };
        let gains = gains.into_iter().collect::<Result<Vec<_>, _>>().map_err(Error::from)?;
        let [one, eight] = [Samples::One, EIGHT].map(|samples| overlap(samples, plan));
        Ok(Some(Found { curves, gains, overlaps: [one.map_err(Error::from)?, eight.map_err(Error::from)?], seed }))
    }

    /// Regions that a box is in, counted.
    pub fn overlap(&self, samples: Samples) -> f64 {
        self.overlaps[usize::from(samples != Samples::One)]
    }

    pub fn counted(&self) -> Origin {
        Origin::count([self.seed])
    }

    pub fn origin(&self) -> Origin {
        Origin::model([self.seed])
    }

    /// The curve of a case.
    pub fn curve(&self, case: Case) -> &Curve {
        self.curves.iter().find(|curve| curve.case == case).expect("there is one of each")
    }
}

fn overlap(samples: Samples, plan: &Plan) -> Result<f64, ParameterError> {
    let software = Plan::case(System::Base, 1, samples, Shades::EverySample).formula();
    Ok(software.paper_boxes(plan.effort.at_most(COUNTED), plan.effort.seed)?.overlap())
}

impl Curve {
    fn of(case: &Case, plan: &Plan) -> Result<Curve, ParameterError> {
        let (software, seed) = (case.formula(), plan.effort.seed);
        let point = |primitives| Ok(Point { primitives, found: case.simulate(&software, primitives, seed)? });
        let points = plan.primitives().into_iter().map(point).collect::<Result<_, ParameterError>>()?;
        let within =
            LATENCIES.iter().map(|latency| within(case, &software, *latency, plan)).collect::<Result<_, _>>()?;
        Ok(Curve { case: *case, points, within })
    }

    /// The primitives within that latency.
    pub fn within(&self, latency: f64) -> Option<u64> {
        let index = LATENCIES.iter().position(|it| *it == latency)?;
        self.within[index]
    }

    /// The least frame.
    pub fn least(&self) -> f64 {
        self.points[0].found.latency
    }
}

/// The most primitives of a frame that takes no longer, to 1 in 500; none if it takes more than are tried, or the least frame takes longer.
fn within(case: &Case, software: &Software, latency: f64, plan: &Plan) -> Result<Option<u64>, ParameterError> {
    let is_within = |primitives| Ok(case.simulate(software, primitives, plan.effort.seed)?.latency <= latency);
    if !is_within(0)? || is_within(plan.most())? {
        return Ok(None);
    }
    let (mut low, mut high) = (0, plan.most());
    // The formula is near.
    let guess = case.formula_of_all().primitives_within(latency) as u64;
    for probe in [guess * 9 / 10, guess * 11 / 10] {
        if low < probe && probe < high {
            if is_within(probe)? { low = probe } else { high = probe }
        }
    }
    while high - low > (low / 500).max(1) {
        let middle = (low + high) / 2;
        if is_within(middle)? { low = middle } else { high = middle }
    }
    Ok(Some(low))
}

impl Gain {
    const LATENCY: f64 = 35.0;

    /// Samples, and what a primitive takes: about as in the paper, and what our own programs do.
    fn specs() -> Vec<(Samples, f64)> {
        let samples = [Samples::One, EIGHT];
        samples
            .into_iter()
            .flat_map(|samples| [0.4, 0.5, 0.6, 0.7, 0.83, 1.0, 1.2, 1.6].map(|us| (samples, us)))
            .collect()
    }

    fn of((samples, rasterizes): (Samples, f64), plan: &Plan) -> Result<Gain, ParameterError> {
        let case = |system| Plan::case(system, 1, samples, Shades::OncePerPixel);
        let [sorted, base] = [System::PreSort, System::Base].map(case);
        let software = |case: &Case| {
            let software = case.formula_of_all();
            Software { costs: Costs { rasterize: rasterizes, ..software.costs }, ..software }
        };
        let by_formula = |case: &Case| software(case).primitives_within(Gain::LATENCY);
        let by_model = |case: &Case| within(case, &software(case), Gain::LATENCY, plan);
        let model = match (by_model(&sorted)?, by_model(&base)?) {
            (Some(sorted), Some(base)) if base > 0 => Some(sorted as f64 / base as f64),
            _ => None,
        };
        Ok(Gain { rasterizes, samples, formula: by_formula(&sorted) / by_formula(&base), model })
    }
}

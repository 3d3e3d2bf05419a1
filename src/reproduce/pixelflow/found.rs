//! Results of the model: latency by primitives, and primitives by latency.

use super::frames::{Drawn, measured};
use super::plan::{Case, EIGHT, GOAL, LATENCIES, Plan};
use crate::shell::Failure;
use tilewright_machines::pixelflow::{
    Choices, Costs, Samples, Shades, Simulated, Software, System, Ticks, composition_time, ticks,
};
use tilewright_machines::{Error, Watch};
use tilewright_report::Origin;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::array::PixelArray;

/// Boxes that are binned to count their regions.
const COUNTED: u64 = 300_000;

/// All results of the page.
pub struct Found {
    pub curves: Vec<Curve>,
    /// The gain of pre-sorting by the time of a primitive, and with its time in the circuit.
    pub gains: Vec<Gain>,
    pub gains_of_circuit: Vec<Gain>,
    /// Regions of a box, with one sample and with eight.
    overlaps: [f64; 2],
    /// The times of the circuit's network.
    pub composed: Vec<Composed>,
    /// The frames of the circuit.
    pub frames: Vec<Drawn>,
    seed: u64,
}

/// The words of each pixel of a region, one after another, on a network of 20 nodes.
pub struct Composed {
    pub words: u32,
    pub bytes: u32,
    /// In ticks of 5 ns.
    pub ticks: Ticks,
}

/// A system's latency.
pub struct Curve {
    pub case: Case,
    pub points: Vec<Point>,
    /// The primitives of a frame for each of [`LATENCIES`]; `None` if more would be needed than are tried, or the least frame takes longer.
    pub within: Vec<Option<u64>>,
}

/// A frame.
pub struct Point {
    pub primitives: u64,
    pub found: Simulated,
}

/// The case for which the gain of pre-sorting is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    pub samples: Samples,
    /// The time of a primitive in a region, in microseconds.
    pub rasterizes: f64,
    /// The latency in milliseconds.
    pub latency: f64,
    /// The set-up before a composition, in microseconds.
    pub set_up: f64,
}

/// Primitives within a latency, with pre-sorting over those without.
pub struct Gain {
    pub of: Question,
    /// Without set-up.
    pub formula: f64,
    pub model: Option<f64>,
}

impl Found {
    /// Runs everything; `None` if interrupted.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Option<Found>, Failure> {
        let composed = Composed::ALL.map(Composed::of).into_iter().collect::<Result<_, _>>()?;
        let frames = Drawn::all(plan, watch)?;
        let cases: Vec<Case> = Plan::all_cases().collect();
        let seed = plan.effort.seed;
        let Some(curves) = watch.each("timing", &cases, |case| Curve::of(case, plan)) else { return Ok(None) };
        let curves = curves.into_iter().collect::<Result<Vec<_>, _>>().map_err(Error::from)?;
        let mut ask = |questions: Vec<Question>| {
            let gains = watch.each("comparing", &questions, |question| Gain::of(*question, plan));
            gains.map(|gains| gains.into_iter().collect::<Result<Vec<_>, _>>().map_err(Error::from)).transpose()
        };
        let Some(gains) = ask(Question::by_time())? else { return Ok(None) };
        let Some(gains_of_circuit) = ask(Question::of_circuit(measured(&frames, System::Base)))? else {
            return Ok(None);
        };
        let [one, eight] = [Samples::One, EIGHT].map(|samples| overlap(samples, plan).map_err(Error::from));
        Ok(Some(Found { curves, gains, gains_of_circuit, composed, overlaps: [one?, eight?], frames, seed }))
    }

    /// Counted regions of a box.
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

impl Composed {
    /// A byte, the word of a region, and z and colour of 40 regions.
    pub const ALL: [[u32; 2]; 3] = [[1, 1], [1, Software::APPEARANCE], [40, Software::PLAIN]];

    fn of([words, bytes]: [u32; 2]) -> Result<Composed, Failure> {
        let port = PixelArray { width: 128, height: 64 }.network_port();
        let ticks = composition_time(20, port, words.into(), bytes.into())?;
        Ok(Composed { words, bytes, ticks })
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

/// The most primitives of a frame within that latency, to 1 in 500. It is `None` if more would be needed than are tried, or if the least frame takes longer.
fn within(case: &Case, software: &Software, latency: f64, plan: &Plan) -> Result<Option<u64>, ParameterError> {
    let is_within = |primitives| {
        case.simulate(software, primitives, plan.effort.seed).map(|simulated| simulated.latency <= latency)
    };
    if !is_within(0)? || is_within(plan.most())? {
        return Ok(None);
    }
    let (mut low, mut high) = (0, plan.most());
    // The formula is a good first guess.
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

/// The two kinds of frames.
const SAMPLES: [Samples; 2] = [Samples::One, EIGHT];

impl Question {
    /// At 35 ms, by the time of a primitive.
    fn by_time() -> Vec<Question> {
        let times = [0.4, 0.5, 0.6, 0.7, 0.83, 1.0, 1.2, 1.6];
        let of = |samples| times.map(|rasterizes| Question { samples, rasterizes, latency: 35.0, set_up: 0.0 });
        SAMPLES.into_iter().flat_map(of).collect()
    }

    /// At the goal's latencies, with the time of a primitive in the circuit, if that was measured. The paper leaves out the set-up.
    fn of_circuit(rasterizes: Option<f64>) -> Vec<Question> {
        let Some(rasterizes) = rasterizes else { return Vec::new() };
        let set_ups = [0.0, 1.0, 10.0].into_iter();
        let of = |samples| {
            let at = move |set_up| GOAL.map(move |latency| Question { samples, rasterizes, latency, set_up });
            set_ups.clone().flat_map(at)
        };
        SAMPLES.into_iter().flat_map(of).collect()
    }
}

impl Gain {
    fn of(of: Question, plan: &Plan) -> Result<Gain, ParameterError> {
        let case = |system| {
            let case = Plan::case(system, 1, of.samples, Shades::OncePerPixel);
            Case { choices: Choices { set_up: ticks(of.set_up), ..case.choices }, ..case }
        };
        let [sorted, base] = [System::PreSort, System::Base].map(case);
        let software = |case: &Case| {
            let software = case.formula_of_all();
            Software { costs: Costs { rasterize: of.rasterizes, ..software.costs }, ..software }
        };
        let by_formula = |case: &Case| software(case).primitives_within(of.latency);
        let by_model = |case: &Case| within(case, &software(case), of.latency, plan);
        let model = match (by_model(&sorted)?, by_model(&base)?) {
            (Some(sorted), Some(base)) if base > 0 => Some(sorted as f64 / base as f64),
            _ => None,
        };
        Ok(Gain { of, formula: by_formula(&sorted) / by_formula(&base), model })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::effort::Effort;

    #[test]
    fn another_seed_finds_other_latencies() {
        let found = |seed| {
            let plan = Plan { effort: Effort { seed, most: Some(3000) } };
            let case = Plan::case(System::Base, 4, Samples::One, Shades::EverySample);
            let curve = Curve::of(&case, &plan).expect("it can be simulated");
            let latencies: Vec<_> = curve.points.iter().map(|point| point.found.latency).collect();
            (latencies, overlap(Samples::One, &plan).expect("there are boxes"))
        };
        let [one, same, other] = [1, 1, 2].map(found);
        assert_eq!(one, same);
        assert!(one.0 != other.0 && one.1 != other.1, "{one:?}, {other:?}");
    }
}

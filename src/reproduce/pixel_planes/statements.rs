//! The paper's statements about its renderers, each with its rule.

use super::bins::{self, Counted, EXAMPLE, named};
use super::found::Found;
use super::frames::Drawn;
use super::loads::{Load, Loads, renderers};
use super::plan::{RENDERERS, SIDE};
use super::reasons::{FALLEN_OUT, FULLEST, LARGE, LINES, RING, SENDING, WHOLE};
use super::time_charts::ring_in_words;
use super::times::{Run, Times, Took};
use super::{PRINTED, UPDATE_TIME};
use tilewright_machines::pixel_planes::{
    Config, PERIOD, Point, Regions, Shape, VECTOR_CYCLES, greatest_load, greatest_load_of_whole_regions, least_load,
    update_time,
};
use tilewright_report::{Origin, Rule, Statement, Verdicts};

/// All statements, in the paper's sequence.
pub fn verdicts(found: &Found) -> Verdicts {
    let Found { counted, loads, frames, times, .. } = found;
    let statements = [
        regions(loads, frames),
        bounds(loads, frames),
        extremes(frames),
        of_vectors(counted),
        of_example(counted),
        in_balance(counted, loads),
        update_times(times),
    ];
    Verdicts::new("statements", "Statements of the paper, each with its rule").states(statements.into_iter().flatten())
}

const WITHIN: Rule = Rule::Within { percent: 0.5 };

/// The scenes that were not made for their load.
fn natural<'a>(frames: &'a [Drawn], loads: &'a Loads) -> impl Iterator<Item = &'a Drawn> {
    frames.iter().filter(|drawn| loads.of(drawn.load.name).is_some())
}

fn surfaces(loads: &Loads) -> impl Iterator<Item = &Load> {
    ["teapot", "ter1k", "ter250"].into_iter().filter_map(|name| loads.of(name))
}

/// PP5-ARCH.
fn regions(loads: &Loads, frames: &[Drawn]) -> Vec<Statement> {
    let of_surfaces = |of: fn(&Load) -> f64| surfaces(loads).map(move |load| (load.name, of(load)));
    vec![
        Statement::new("PP5-ARCH", "A screen of 1280x1024 pixels has 80 regions of 128x128.", Rule::Equals)
            .unit("regions")
            .paper([80.0])
            .found(Origin::count([]), [Regions::paper().count() as f64]),
        Statement::new("PP5-ARCH", "Most polygons of complex scenes are within a region.", Rule::AtLeast)
            .unit("of the polygons")
            .paper([0.5])
            .found(Origin::count([]), of_surfaces(|load| load.in_one as f64 / load.primitives as f64)),
        Statement::new(
            "PP5-ARCH",
            "Renderers have hardly more work than a processor for each pixel of the screen, which processes each polygon once.",
            Rule::Within { percent: 25.0 },
        )
        .unit("times each polygon")
        .paper([1.0])
        .found(Origin::count([]), of_surfaces(Load::regions))
        .because(LARGE),
        Statement::new(
            "PP5-ARCH",
            format!("Regions are assigned so that renderers process nearly equal numbers of primitives: {RENDERERS} renderers that never wait."),
            Rule::Within { percent: 10.0 },
        )
        .unit("worst load over the mean")
        .paper([1.0])
        .found(loads.origin(), loads.scenes.iter().map(|load| (load.name, load.imbalance(RENDERERS))))
        .because(FULLEST),
        Statement::new(
            "PP5-ARCH",
            format!("Renderers process nearly equal numbers of primitives: frames of the circuit, with a ring of {}.", ring_in_words()),
            Rule::Within { percent: 10.0 },
        )
        .unit("worst load over the mean")
        .paper([1.0])
        .found(Origin::rtl(seeds(frames)), natural(frames, loads).map(|drawn| (drawn.load.name, drawn.imbalance())))
        .because(SENDING),
    ]
}

fn seeds(frames: &[Drawn]) -> Vec<u64> {
    let mut seeds: Vec<u64> = frames.iter().flat_map(|drawn| drawn.load.seeds.clone()).collect();
    seeds.dedup();
    seeds
}

/// PP5-PW, for all scenes and all numbers of renderers.
fn bounds(loads: &Loads, frames: &[Drawn]) -> Vec<Statement> {
    let regions = loads.regions.count();
    let everywhere = |of: &dyn Fn(&Load, u32) -> f64| {
        let of_load =
            |load: &Load| renderers().map(|b| (format!("{}, B = {b}", load.name), of(load, b))).collect::<Vec<_>>();
        loads.scenes.iter().flat_map(of_load).collect::<Vec<_>>()
    };
    let drawn = |of: &dyn Fn(&Drawn) -> f64| frames.iter().map(|it| (it.load.name, of(it))).collect::<Vec<_>>();
    let worst = |it: &Drawn| it.report.worst_load() as f64;
    let counted = everywhere(&|load, b| load.worst(b) as f64);
    vec![
        Statement::new("PP5-PW", "P_w is at least P/B: all scenes, all numbers of renderers.", Rule::AtLeast)
            .unit("primitives")
            .formula(everywhere(&|load, b| load.least(b)))
            .found(loads.origin(), counted.clone()),
        Statement::new("PP5-PW", "P_w is at most P R/B: all scenes, all numbers of renderers.", Rule::AtMost)
            .unit("primitives")
            .formula(everywhere(&|load, b| greatest_load(load.primitives as f64, regions, b as usize)))
            .found(loads.origin(), counted),
        Statement::new(
            "PP5-PW",
            format!("P_w is at least P/B: frames of the circuit, B = {RENDERERS}."),
            Rule::AtLeast,
        )
        .unit("primitives")
        .formula(drawn(&|it| it.load.least(RENDERERS)))
        .found(Origin::rtl(seeds(frames)), drawn(&worst)),
        Statement::new(
            "PP5-PW",
            format!("P_w is at most P R/B: frames of the circuit, B = {RENDERERS}."),
            Rule::AtMost,
        )
        .unit("primitives")
        .formula(drawn(&|it| greatest_load(it.load.primitives as f64, regions, RENDERERS as usize)))
        .found(Origin::rtl(seeds(frames)), drawn(&worst)),
    ]
}

/// PP5-PW: its limits are reached, and which of them is true if B does not divide R.
fn extremes(frames: &[Drawn]) -> Vec<Statement> {
    let of = |name: &'static str| frames.iter().find(move |drawn| drawn.load.name == name);
    let (Some(least), Some(greatest)) = (of("one-each"), of("whole-screen")) else { return vec![] };
    let regions = greatest.load.bins.len();
    let reached = |text: &str, drawn: &Drawn, limit: f64| {
        Statement::new("PP5-PW", text, Rule::Equals)
            .unit("primitives")
            .formula([limit])
            .found(drawn.origin(), [drawn.report.worst_load() as f64])
    };
    let all_cover = |b: u32| (format!("B = {b}"), greatest.load.worst(b) as f64);
    let undivided = || renderers().filter(|b| !(regions as u32).is_multiple_of(*b));
    let primitives = greatest.load.primitives;
    let by_formula =
        |of: &dyn Fn(usize) -> f64| undivided().map(|b| (format!("B = {b}"), of(b as usize))).collect::<Vec<_>>();
    vec![
        reached(
            "The lower limit is reached if each primitive is within one region and the load is balanced perfectly.",
            least,
            least.load.least(RENDERERS),
        ),
        reached(
            "The upper limit is reached if all primitives are in all regions.",
            greatest,
            greatest_load(primitives as f64, regions, RENDERERS as usize),
        ),
        Statement::new("PP5-PW", "The limits differ by a factor of R, which is 80.", Rule::Equals)
            .unit("times as many, of as many primitives")
            .paper([80.0])
            .found(Origin::rtl([]), [greatest.report.worst_load() as f64 / least.report.worst_load() as f64]),
        Statement::new(
            "PP5-PW",
            "P_w is at most P R/B also where B does not divide R: all primitives in all regions.",
            Rule::AtMost,
        )
        .unit("primitives")
        .formula(by_formula(&|b| greatest_load(primitives as f64, regions, b)))
        .found(Origin::count([]), undivided().map(all_cover))
        .because(WHOLE),
        Statement::new(
            "PP5-PW",
            "P_w is at most P ⌈R/B⌉ where B does not divide R, as regions are whole.",
            Rule::AtMost,
        )
        .unit("primitives")
        .formula(by_formula(&|b| greatest_load_of_whole_regions(primitives, regions, b) as f64))
        .found(Origin::count([]), undivided().map(all_cover)),
    ]
}

fn at(Shape { length, angle }: Shape) -> String {
    format!("L = {}, {angle}°", (10.0 * length).round() / 10.0)
}

/// PP5-HVB, PP5-HV and PP5-HV0.
fn of_vectors(counted: &Counted) -> Vec<Statement> {
    let all = |wanted: &dyn Fn(&Shape) -> bool, of: &dyn Fn(&Point) -> f64| {
        let points = counted.points().filter(|point| wanted(&point.shape));
        points.map(|point| (at(point.shape), of(point))).collect::<Vec<_>>()
    };
    let any = |_: &Shape| true;
    let is_along_an_axis = |shape: &Shape| shape.angle % 90.0 == 0.0;
    let by_box = |point: &Point| point.counted.by_box.mean;
    let by_columns = |point: &Point| point.counted.by_columns.mean;
    let of_formula = |number: usize, text: &str, fact: &str| {
        Statement::new(fact, text, WITHIN)
            .unit("regions a vector")
            .formula(all(&any, &|point| named(point.by_formula)[number].1))
            .found(counted.origin(), all(&any, &|point| named(point.counted)[number].1.mean))
    };
    let in_parts = |point: &Point| bins::long_side(point.shape);
    let is_short = |shape: &Shape| bins::long_side(*shape) < 1.0 - 1e-9;
    let is_long = |shape: &Shape| bins::long_side(*shape) > 1.0 + 1e-9 && !is_along_an_axis(shape);
    let meets = |shape: &Shape| (bins::long_side(*shape) - 1.0).abs() < 1e-9;
    vec![
        of_formula(0, "A vector’s bounding box meets (1 + L cos θ/S)(1 + L sin θ/S) regions, restored from the numbers printed.", "PP5-HVB"),
        Statement::new(
            "PP5-HV",
            "With bounding boxes many regions process a long vector unnecessarily, and more regions a longer one: 45 degrees.",
            Rule::Increases { with: "L".to_owned() },
        )
        .unit("times the regions that they meet")
        .found(
            counted.origin(),
            all(&|shape| shape.angle == EXAMPLE.angle && shape.length > f64::from(SIDE), &|point| by_box(point) / point.counted.tight.mean),
        ),
        Statement::new("PP5-HV", "With cleverer binning a vector is in at most two regions of any column.", Rule::AtMost)
            .unit("regions of a column")
            .paper([2.0])
            .found(counted.origin(), [counted.most_in_a_column as f64]),
        of_formula(1, "Binned by columns, a vector is in (1 + L cos θ/S)(1 + tan θ) regions; axes are swapped beyond 45 degrees.", "PP5-HV"),
        Statement::new("PP5-HV", "Columns make fewer regions than bounding boxes for long vectors, L cos θ > S.", Rule::AtMost)
            .unit("times those of the box")
            .paper([1.0])
            .found(counted.origin(), all(&is_long, &|point| by_columns(point) / by_box(point))),
        Statement::new(
            "PP5-HV",
            "The formula is pessimistic for short vectors, where L sin θ/S < tan θ: their boxes meet fewer regions.",
            Rule::AtLeast,
        )
        .unit("times those of the box")
        .paper([1.0])
        .found(counted.origin(), all(&|shape| is_short(shape) && !is_along_an_axis(shape), &|point| point.by_formula.by_columns / by_box(point))),
        Statement::new("PP5-HV", "Both are the same where L cos θ = S.", WITHIN)
            .unit("regions a vector by columns, beside those of the box")
            .formula(all(&meets, &|point| point.by_formula.by_box))
            .found(counted.origin(), all(&meets, &by_columns)),
        Statement::new("PP5-HV0", "Of horizontal and vertical vectors both formulas are 1 + L/S: by bounding boxes.", WITHIN)
            .unit("regions a vector")
            .formula(all(&is_along_an_axis, &|point| 1.0 + in_parts(point)))
            .found(counted.origin(), all(&is_along_an_axis, &by_box)),
        Statement::new("PP5-HV0", "Of horizontal and vertical vectors both formulas are 1 + L/S: by columns.", WITHIN)
            .unit("regions a vector")
            .formula(all(&is_along_an_axis, &|point| 1.0 + in_parts(point)))
            .found(counted.origin(), all(&is_along_an_axis, &by_columns)),
        Statement::new(
            "PP5-HV",
            "Binned by itself, a vector is in no more regions than by its box or by columns.",
            Rule::AtMost,
        )
        .unit("times the less of both")
        .paper([1.0])
        .found(counted.origin(), all(&any, &|point| point.counted.tight.mean / by_box(point).min(by_columns(point)))),
    ]
}

/// The paper's example.
fn of_example(counted: &Counted) -> Vec<Statement> {
    let example = "H_v is 1.63 for vectors of 50 pixels at 45 degrees and regions of 128x128";
    let state = |which: &str, origin: Origin, value: f64| {
        Statement::new("PP5-HVB", format!("{example}: {which}."), WITHIN)
            .unit("regions a vector")
            .paper([PRINTED])
            .found(origin, [value])
    };
    let mean = counted.example(SIDE).counted;
    vec![
        state("by the formula that is printed", Origin::Formula, EXAMPLE.by_columns(SIDE)).because(FALLEN_OUT),
        state("by that of the bounding box", Origin::Formula, EXAMPLE.by_box(SIDE)),
        state("counted by bounding boxes", counted.origin(), mean.by_box.mean),
    ]
}

/// PP5-PWV.
fn in_balance(counted: &Counted, loads: &Loads) -> Vec<Statement> {
    let mean = counted.example(SIDE).counted.by_box.mean;
    let crowd = loads.crowds.last();
    let worst = |crowd: &super::loads::Crowd| crowd.worst.by_box as f64 * f64::from(RENDERERS) / crowd.vectors as f64;
    vec![
        Statement::new(
            "PP5-PWV",
            format!("In perfect balance P_w is 1.63 V/B: the mean load of {RENDERERS} renderers."),
            WITHIN,
        )
        .unit("V/B")
        .paper([PRINTED])
        .found(counted.origin(), [mean]),
        Statement::new(
            "PP5-PWV",
            "P_w is 1.63 V/B for random vectors, whose balance is not perfect: the worst load.",
            Rule::Within { percent: 10.0 },
        )
        .unit("V/B")
        .found(loads.origin(), crowd.map(|crowd| (format!("V = {}", crowd.vectors), worst(crowd))))
        .paper(crowd.map(|crowd| (format!("V = {}", crowd.vectors), PRINTED))),
    ]
}

/// PP5-UT and PP5-UTV.
fn update_times(times: &Times) -> Vec<Statement> {
    let load = least_load(EXAMPLE.by_box(SIDE), RENDERERS as usize);
    let usual = times.usual(Config::AMPLE_RING);
    let example = format!("With {RENDERERS} renderers of 25 ns a clock the update time is V times 239 ns");
    let ample = || times.by_renderers(Config::AMPLE_RING);
    let milliseconds = |clocks: f64| clocks * PERIOD / 1e6;
    let is_explained = |runs: &[&Run], origin: Origin, of: &dyn Fn(&Run) -> Option<Took>, by: &str| {
        let at = |run: &Run| format!("B = {}", run.spec.renderers);
        let found =
            runs.iter().filter_map(|run| Some((at(run), milliseconds(of(run)?.drawn as f64)))).collect::<Vec<_>>();
        let formula = runs.iter().filter(|run| of(run).is_some());
        let formula = formula.map(|run| (at(run), milliseconds(run.cycles * run.worst as f64))).collect::<Vec<_>>();
        let text = format!("The update time is N P_w T, if renderers never wait: random vectors, by {by}.");
        let statement = Statement::new("PP5-UT", text, Rule::Within { percent: 5.0 });
        statement.unit("ms").formula(formula).found(origin, found).because(LINES)
    };
    vec![
        is_explained(&ample(), times.model(), &|run| Some(run.model), "the model"),
        is_explained(&ample(), times.rtl(), &|run| run.hardware, "the circuit"),
        Statement::new(
            "PP5-UT",
            format!("Renderers never have to wait for primitives: with a ring of {}.", ring_in_words()),
            Rule::Zero,
        )
        .unit("of their clocks")
        .found(
            times.model(),
            times
                .by_renderers(Config::RING)
                .iter()
                .rev()
                .map(|run| (format!("B = {}", run.spec.renderers), run.model.starved)),
        )
        .because(RING),
        Statement::new("PP5-UTV", format!("{example}: by the formula, with N = {VECTOR_CYCLES}."), WITHIN)
            .unit("ns a vector")
            .paper([UPDATE_TIME])
            .found(Origin::Formula, [update_time(VECTOR_CYCLES, load, PERIOD)]),
        Statement::new("PP5-UTV", format!("{example}: here, with N = {:.1} and an ample ring.", usual.cycles), WITHIN)
            .unit("ns a vector")
            .paper([UPDATE_TIME])
            .found(times.model(), [usual.per_vector(&usual.model)])
            .cannot_be_compared("the text does not say how many bits the words of its vectors have"),
    ]
}

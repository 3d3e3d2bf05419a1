//! The paper's statements, each by the formula and by the model.

use super::found::{Composed, Curve, Found};
use super::frames;
use super::plan::{Case, EIGHT, GOAL, LATENCIES, Plan};
use super::reasons::{self, SECOND_PASS, SEVEN};
use super::stereo;
use tilewright_machines::pixelflow::{Costs, Nodes, Samples, Shades, Software, System, Workload, crossover, overlap};
use tilewright_report::{Origin, Rule, Statement, Verdicts};

/// All statements, in the paper's sequence.
pub fn verdicts(found: &Found, plan: &Plan) -> Verdicts {
    let stereo = stereo::statements(&found.frames, plan);
    let statements =
        [constants(found), overlaps(found), memory(), stereo, conclusions(found), without_samples(found), crossovers()];
    Verdicts::new("statements", "Statements of the paper, each with its rule").states(statements.into_iter().flatten())
}

const WITHIN: Rule = Rule::Within { percent: 0.5 };

/// PFL-TCB to PFL-LOAD.
fn constants(found: &Found) -> Vec<Statement> {
    let costs = Costs::default();
    let state = |fact: &str, text: &str, unit: &str, paper: f64, formula: f64| {
        Statement::new(fact, format!("{text}: formula."), WITHIN)
            .unit(unit)
            .paper([paper])
            .found(Origin::Formula, [formula])
    };
    // Measured on the simulated network of 20 nodes, too.
    let composed = |fact: &str, text: &str, paper: f64, [words, bytes]: [u32; 2]| {
        let ticks =
            found.composed.iter().find(|it| (it.words, it.bytes) == (words, bytes)).map(|it| it.ticks as f64 / 200.0);
        let circuit = Statement::new(fact, format!("{text}: circuit."), WITHIN);
        [
            state(fact, text, "µs", paper, f64::from(words * bytes) * costs.composed_byte),
            circuit.unit("µs").paper([paper]).found(Origin::rtl([]), ticks),
        ]
    };
    let [byte, region, frame] = Composed::ALL;
    let mut statements = Vec::new();
    statements.extend(composed(
        "PFL-TCB",
        "A byte of each pixel of a region is composed in 1.28 µs: 8192 pixels over 256 wires at 200 MHz",
        1.28,
        byte,
    ));
    statements.extend(composed(
        "PFL-BYTES",
        "A region’s 21 bytes of appearance parameters take 26.88 µs",
        26.88,
        region,
    ));
    statements.push(state(
        "PFL-LOAD",
        "Loading colours to the frame buffer takes 2.08 ms",
        "ms",
        2.08,
        40.0 * costs.load / 1000.0,
    ));
    statements.extend(composed(
        "PFL-COL",
        "Composing colour alone takes 360 µs: z and colour, 7 bytes of 40 regions",
        360.0,
        frame,
    ));
    let alone = 120.0 * costs.composed_byte;
    statements.push(
        state("PFL-COL", "Composing colour alone takes 360 µs: 3 bytes of 40 regions", "µs", 360.0, alone)
            .because(SEVEN),
    );
    statements
}

/// PFL-OVERLAP.
fn overlaps(found: &Found) -> Vec<Statement> {
    let state = |text: &str, paper: f64, samples: Samples, sides: [f64; 2], region: [f64; 2]| {
        let counted = found.overlap(samples);
        [
            Statement::new("PFL-OVERLAP", format!("{text}: by the formula."), WITHIN)
                .unit("regions a primitive")
                .paper([paper])
                .found(Origin::Formula, [overlap(sides, region)]),
            Statement::new("PFL-OVERLAP", format!("{text}: bins of random boxes."), Rule::Within { percent: 1.0 })
                .unit("regions a primitive")
                .formula([overlap(sides, region)])
                .found(found.counted(), [counted]),
        ]
    };
    let one = state("A box of 10x10 pixels is in 1.25 regions of 128x64", 1.25, Samples::One, [10.0; 2], [128.0, 64.0]);
    let eight = state(
        "With eight samples it is in 1.52, of regions of 64x32: four samples are side by side",
        1.52,
        EIGHT,
        [10.0; 2],
        [64.0, 32.0],
    );
    one.into_iter().chain(eight).collect()
}

/// PFL-MEM.
fn memory() -> Vec<Statement> {
    let bytes = 40.0 * f64::from(Software::PLAIN);
    let processor = f64::from(tilewright_rtl::pixelflow::pixel::PixelProcessor::BYTES);
    vec![
        Statement::new("PFL-MEM", "The whole screen of 40 regions takes 280 bytes of a pixel processor.", Rule::Equals)
            .unit("bytes")
            .paper([280.0])
            .found(Origin::Formula, [bytes]),
        Statement::new("PFL-MEM", "They fit into the 384 bytes that a processor has.", Rule::AtMost)
            .unit("bytes")
            .paper([processor])
            .found(Origin::Formula, [bytes]),
    ]
}

/// A comparison of two systems, each at some latencies.
struct Versus<'a> {
    found: &'a Found,
    one: Case,
    other: Case,
}

impl Versus<'_> {
    fn at(latencies: &[f64]) -> impl Iterator<Item = (String, f64)> {
        latencies.iter().map(|latency| (format!("{latency} ms"), *latency))
    }

    /// Primitives of one system over those of the other, by the paper's formula.
    fn by_formula(&self, latencies: &[f64]) -> Vec<(String, f64)> {
        let of = |case: &Case, latency| case.formula().primitives_within(latency);
        Versus::at(latencies).map(|(at, latency)| (at, of(&self.one, latency) / of(&self.other, latency))).collect()
    }

    fn by_model(&self, latencies: &[f64]) -> Vec<(String, f64)> {
        let of = |case: Case, latency| Some(self.found.curve(case).within(latency)? as f64);
        let ratio = |(at, latency): (String, f64)| Some((at, of(self.one, latency)? / of(self.other, latency)?));
        Versus::at(latencies).filter_map(ratio).collect()
    }
}

fn explained(statement: Statement, why: Option<reasons::Why>) -> Statement {
    match why {
        Some(why) => statement.because(why),
        None => statement,
    }
}

/// The two ways to shade eight samples.
const WAYS: [(Shades, &str); 2] =
    [(Shades::OncePerPixel, "model that shades a pixel once"), (Shades::EverySample, "model that shades every sample")];

/// C1 to C6: figure 3.
fn conclusions(found: &Found) -> Vec<Statement> {
    let (base, sorted, plain) = (System::Base, System::PreSort, System::NonTexturing);
    let mut statements = Vec::new();
    let least = |case: Case| (case.formula().latency(0.0), found.curve(case).least());
    let mut compare_least = |fact: &str, text: &str, rule: Rule, one: (System, u32), other: (System, u32)| {
        let of = |(system, shaders), shades| least(Plan::case(system, shaders, EIGHT, shades));
        let formula = of(one, Shades::OncePerPixel).0 / of(other, Shades::OncePerPixel).0;
        let mut state = |how: &str, origin: Origin, value: f64| {
            let text = format!("{text}: {how}.");
            let why = reasons::of_comparison(fact, &text);
            let statement = Statement::new(fact, text, rule.clone()).unit("least latency, over the other’s");
            statements.push(explained(statement.paper([1.0]).found(origin, [value]), why));
        };
        state("formula", Origin::Formula, formula);
        for (shades, how) in WAYS {
            state(how, found.origin(), of(one, shades).1 / of(other, shades).1);
        }
    };
    compare_least(
        "PFL C1",
        "With eight samples the non-texturing system has a greater least latency than a base system with 4 shaders",
        Rule::AtLeast,
        (plain, 0),
        (base, 4),
    );
    compare_least("PFL C3", "With eight samples 4 shaders lower the least latency", Rule::AtMost, (base, 4), (base, 1));

    let mut compare = |fact: &str, text: &str, rule: Rule, paper: f64, one: (System, u32), other: (System, u32)| {
        let versus = |shades| Versus {
            found,
            one: Plan::case(one.0, one.1, EIGHT, shades),
            other: Plan::case(other.0, other.1, EIGHT, shades),
        };
        let mut state = |how: &str, origin: Origin, values: Vec<(String, f64)>| {
            let text = format!("{text}: {how}.");
            let why = reasons::of_comparison(fact, &text);
            let statement = Statement::new(fact, text, rule.clone()).unit("times the primitives");
            statements.push(explained(statement.paper([paper]).found(origin, values), why));
        };
        state("formula", Origin::Formula, versus(Shades::OncePerPixel).by_formula(&GOAL));
        for (shades, how) in WAYS {
            state(how, found.origin(), versus(shades).by_model(&GOAL));
        }
    };
    compare(
        "PFL C2",
        "At 30 to 40 ms the non-texturing system draws fewer primitives than the base system with 1 shader",
        Rule::AtMost,
        1.0,
        (plain, 0),
        (base, 1),
    );
    compare("PFL C4", "At 30 to 40 ms 1 shader draws more primitives than 4", Rule::AtLeast, 1.0, (base, 1), (base, 4));
    compare("PFL C5", "At 30 to 40 ms pre-sorting gains at least 10 %", Rule::AtLeast, 1.10, (sorted, 1), (base, 1));
    compare("PFL C5", "At 30 to 40 ms pre-sorting gains at most 15 %", Rule::AtMost, 1.15, (sorted, 1), (base, 1));
    compare(
        "PFL C5",
        "At 30 to 40 ms pre-sorting with 4 shaders gains at most 15 % beside the base system with 1",
        Rule::AtMost,
        1.15,
        (sorted, 4),
        (base, 1),
    );

    let gap = |curve: [&Curve; 2]| {
        let of = |(at, latency): (String, f64)| {
            Some((at, curve[0].within(latency)? as f64 - curve[1].within(latency)? as f64))
        };
        Versus::at(&LATENCIES).filter_map(of).collect::<Vec<_>>()
    };
    let grows = |how: &str, origin: Origin, values: Vec<(String, f64)>| {
        Statement::new(
            "PFL C6",
            format!("The gain of pre-sorting grows with latency: {how}."),
            Rule::Increases { with: "latency".to_owned() },
        )
        .unit("primitives more")
        .found(origin, values)
    };
    let by_formula = Versus::at(&LATENCIES).map(|(at, latency)| {
        let of = |system| Plan::case(system, 1, EIGHT, Shades::OncePerPixel).formula().primitives_within(latency);
        (at, of(sorted) - of(base))
    });
    statements.push(grows("formula", Origin::Formula, by_formula.collect()));
    for (shades, how) in WAYS {
        let curves = [sorted, base].map(|system| found.curve(Plan::case(system, 1, EIGHT, shades)));
        statements.push(grows(how, found.origin(), gap(curves)));
    }
    statements
}

/// D1, D2 and PFL-600K: figure 4.
fn without_samples(found: &Found) -> Vec<Statement> {
    let of = |system, shaders| Plan::case(system, shaders, Samples::One, Shades::EverySample);
    let (base, sorted, plain) = (of(System::Base, 1), of(System::PreSort, 1), of(System::NonTexturing, 0));
    let both = |fact: &str, text: &str, rule: Rule, one: Case, other: Case| {
        let versus = Versus { found, one, other };
        [("formula", Origin::Formula, versus.by_formula(&GOAL)), ("model", found.origin(), versus.by_model(&GOAL))].map(
            |(how, origin, values)| {
                let statement = Statement::new(fact, format!("{text}: {how}."), rule.clone());
                let statement = statement.unit("times the primitives").paper([1.0]).found(origin, values);
                explained(statement, (fact == "PFL D1").then_some(SECOND_PASS))
            },
        )
    };
    let most = "The non-texturing system draws over 600 thousand primitives in 30 ms without antialiasing";
    let within = |how: &str, origin: Origin, value: Option<f64>| {
        Statement::new("PFL-600K", format!("{most}: {how}."), Rule::AtLeast)
            .unit("primitives")
            .paper([600_000.0])
            .found(origin, value)
    };
    both("PFL D1", "Without antialiasing pre-sorting has no advantage at 30 to 40 ms", Rule::AtMost, sorted, base)
        .into_iter()
        .chain(both(
            "PFL D2",
            "Without antialiasing the non-texturing system has a large advantage at 30 to 40 ms",
            Rule::AtLeast,
            plain,
            base,
        ))
        .chain([
            within("formula", Origin::Formula, Some(plain.formula().primitives_within(30.0))),
            within("model", found.origin(), found.curve(plain).within(30.0).map(|it| it as f64)),
        ])
        .collect()
}

/// With more shading, more shaders are better.
fn crossovers() -> Vec<Statement> {
    let at = |factor: f64| {
        let software = |shaders| {
            let software = Software::paper(System::Base, Nodes::paper(shaders), Samples::One);
            let costs = Costs {
                look_up: factor * software.costs.look_up,
                addresses: factor * software.costs.addresses,
                ..software.costs
            };
            Software { costs, ..software }
        };
        Some((format!("{factor} times"), crossover(&software(1), &software(4))?))
    };
    vec![
        Statement::new(
            "PFL C4",
            "If shading takes longer, the crossover between 1 and 4 shaders shifts to more primitives: formula, without antialiasing.",
            Rule::Increases { with: "the time of shading".to_owned() },
        )
        .unit("primitives at which both take as long")
        .found(Origin::Formula, [1.0, 2.0, 4.0, 8.0].into_iter().filter_map(at)),
    ]
}

/// Checks that the model agrees with the formula where its assumptions are true, up to the filling of a region; and the circuit's times.
pub fn checks(found: &Found, plan: &Plan) -> Verdicts {
    let balanced = |case: Case| {
        let software = Software { overlap: 1.0, ..case.formula_of_all() };
        let regions = software.regions_drawn();
        let primitives = 300;
        let workload =
            Workload::balanced(software.nodes.rasterizers as usize, regions as u16, primitives, software.draws());
        let latency = software.simulate(&workload, case.choices).latency;
        (latency, software.latency(workload.primitives() as f64))
    };
    let name = |case: &Case| {
        let samples = if case.samples == Samples::One { "one sample" } else { "eight samples" };
        format!("{}, {samples}", case.name())
    };
    let cases: Vec<Case> = Plan::all_cases().filter(|case| case.choices.shades == Shades::EverySample).collect();
    let values =
        |of: fn((f64, f64)) -> f64| cases.iter().map(move |case| (name(case), of(balanced(*case)))).collect::<Vec<_>>();
    let of_formula = values(|(_, formula)| formula);
    Verdicts::new("checks", "Checks")
        .state(
            Statement::new(
                "PFL-LAT1",
                "In perfect balance the model takes as long as the formula, up to the filling of a region. The formula gets the actual numbers of composed and shaded regions; a rasterizer has 300 primitives a region.",
                Rule::Within { percent: 4.0 },
            )
            .unit("ms")
            .formula(of_formula.clone())
            .found(Origin::model([]), values(|(model, _)| model)),
        )
        .state(
            Statement::new("PFL-LAT1", "The model never takes less time than that formula.", Rule::AtLeast)
                .unit("ms")
                .formula(of_formula.into_iter().map(|(at, value)| (at, value * (1.0 - 1e-9))))
                .found(Origin::model([]), values(|(model, _)| model)),
        )
        .states(frames::checks(&found.frames, plan))
}

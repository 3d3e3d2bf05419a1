//! Adaptive parallel rasterization: sections 4.2 and 5.2, Figure 9.

use super::super::found::Found;
use super::super::plan::{BLANKINGS, CAPACITIES, Capacity, Case, THRESHOLD};
use super::super::run::{CLOCK, Timed};
use super::reasons::{DEALT, REFRESHES};
use super::{ALMOST_LEAST, LITTLE, WITHIN_10, named};
use tilewright_report::{Rule, Statement};
use tilewright_rtl::gfb::Blanking;

/// The time with the paper's best threshold over that without (VC1-F9).
const LEFT: f64 = 0.75;
/// The greatest share of the area test in all computing (VC1-APR).
const AREA_TEST: f64 = 0.03;

pub fn statements(found: &Found) -> Vec<Statement> {
    let mut statements = figure_9(found);
    statements.push(area_test(found));
    statements
}

/// The machine of Figure 9 at a threshold. The text does not state its memory, so it is the paper's machine.
fn paper(found: &Found, apr: Option<u32>) -> Case {
    found.plan.at_threshold(Capacity::Paper, Blanking::AtStart, apr)
}

fn figure_9(found: &Found) -> Vec<Statement> {
    let plan = &found.plan;
    let time = |it: &Timed| it.time;
    let usual = Some(THRESHOLD);
    let all = || plan.thresholds().filter_map(|apr| found.of(paper(found, apr)).map(|it| (apr, it)));
    let least = all().map(|(_, it)| it.time).reduce(f64::min);
    let best = found.of(paper(found, usual)).zip(least).map(|(it, least)| it.time / least);
    let mut statements = vec![
        Statement::new(
            "VC1-F9",
            "The most appropriate threshold for the table with 16 processing elements is 500: T(500) over the least T.",
            Rule::AtMost,
        )
        .paper([ALMOST_LEAST])
        .found(found.model(), best),
    ];
    for capacity in CAPACITIES {
        statements.extend(BLANKINGS.map(|blanking| {
            let cases = [usual, None].map(|apr| plan.at_threshold(capacity, blanking, apr));
            let when = if blanking == Blanking::AtStart { "at its start" } else { "anywhere in it" };
            let text = format!(
                "A threshold of 500 pixels reduces the time to 75 % of that without: {} of the screen, swaps in the blanking {when}.",
                capacity.name()
            );
            Statement::new("VC1-F9", text, WITHIN_10)
                .unit("T(500) / T(off)")
                .paper([LEFT])
                .found(found.model(), found.ratio(String::new(), cases, time).map(|it| it.1))
                .because(REFRESHES)
        }));
    }
    let first = plan.thresholds().next().flatten();
    let ends = [first, None]
        .into_iter()
        .filter_map(|apr| found.ratio(named(apr), [apr, usual].map(|apr| paper(found, apr)), time));
    let along = |text: &str, unit: &str, rule: fn(String) -> Rule, of: fn(&Timed) -> f64| {
        let found_here = all().map(|(apr, it)| (named(apr), of(it)));
        Statement::new("VC1-F9", text, rule("the threshold".to_owned())).unit(unit).found(found.model(), found_here)
    };
    let grows = |with| Rule::NeverDecreases { with };
    statements.extend([
        Statement::new(
            "VC1-F9",
            "There is a minimum between a small and a large threshold: T of both over T(500).",
            Rule::AtLeast,
        )
        .paper([LITTLE])
        .found(found.model(), ends),
        along(
            "As the threshold becomes larger, load balancing becomes worse.",
            "the busiest over the mean",
            grows,
            |it| it.imbalance,
        )
        .because(DEALT),
        along("As the threshold becomes larger, overflows increase.", "overflows a frame", grows, |it| it.overflows),
        along(
            "As the threshold becomes smaller, communication increases.",
            "words broadcast a frame",
            |with| Rule::NeverIncreases { with },
            |it| it.words,
        ),
        gain(found),
    ]);
    statements
}

/// With pages for all patches, only balance saves time.
fn gain(found: &Found) -> Statement {
    let saved = |capacity: Capacity| {
        let [with, without] = [Some(THRESHOLD), None]
            .map(|apr| found.of(found.plan.at_threshold(capacity, Blanking::AtStart, apr)).map(|it| it.time));
        without.zip(with).map(|(without, with)| without - with)
    };
    let more = CAPACITIES.into_iter().filter_map(|capacity| {
        let (all, by_balance) = (saved(capacity)?, saved(Capacity::Part(1))?);
        Some((capacity.name(), all - 2.0 * by_balance))
    });
    Statement::new(
        "VC1-F9",
        "The main effect of a threshold is fewer overflows, not balance: time saved by fewer overflows, less time saved with pages for all patches.",
        Rule::AtLeast,
    )
    .unit("ms")
    .paper([0.0])
    .found(found.model(), more)
}

fn area_test(found: &Found) -> Statement {
    let plan = &found.plan;
    let share = |scene: &&'static str| {
        let case = plan.case(scene, 16);
        let timed = found.of(case)?;
        let computing: f64 = ["geometry", "raster", "sending", "receiving"].iter().map(|name| timed.class(name)).sum();
        let area = f64::from(timed.polygons) * case.costs.area as f64 / 16.0 * CLOCK;
        Some(((*scene).to_owned(), area / computing))
    };
    Statement::new("VC1-APR", "The area of polygons takes less than 3 % of the total computation time.", Rule::AtMost)
        .unit("of computing")
        .paper([AREA_TEST])
        .found(found.model(), plan.scenes().iter().filter_map(share))
}

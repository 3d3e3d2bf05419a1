//! Section 5.1, Figure 7: time by the number of processing elements.

use super::super::found::Found;
use super::super::plan::Plan;
use super::super::run::Timed;
use super::reasons::{COSTS, OVERFLOWS};
use super::{FLOOR, GUARDS, WITHIN_1, WITHIN_10, place};
use tilewright_report::{Rule, Statement};

/// The paper's numbers for ter250, and what follows from them: the polygons of the scene over the rate, and 190 times the floor.
const POLYGONS: f64 = 203_522.0;
const THOUSANDS_WITH_16: f64 = 514.0;
const MILLIONS_WITH_256: f64 = 6.1;
const SPEED_UP: f64 = 190.0;

/// Times of ter250 that follow from the paper's rates, in milliseconds: with 1, 16 and 256 processing elements.
pub fn derived() -> [(u32, f64); 3] {
    let with_256 = POLYGONS / MILLIONS_WITH_256 / 1e3;
    [(1, SPEED_UP * with_256), (16, POLYGONS / THOUSANDS_WITH_16), (256, with_256)]
}

pub fn statements(found: &Found) -> Vec<Statement> {
    let plan = &found.plan;
    let time = |it: &Timed| it.time;
    let scenes = || plan.scenes().iter().copied();
    let everywhere = || scenes().flat_map(|scene| plan.processors().iter().map(move |n| (scene, *n)));
    let times = everywhere().filter_map(|(scene, n)| found.at(place(scene, n), plan.case(scene, n), time));
    let with_256 = |hertz: &str, slower: bool| {
        let of = |scene: &'static str| {
            let case = plan.case(scene, 256);
            found.at(scene.to_owned(), if slower { Plan::slower(case) } else { case }, time)
        };
        let text = format!(
            "With 256 processing elements the rendering time is 33.3 ms for every scene: with {hertz} refreshes a second."
        );
        let fact = if slower { "VC1-59" } else { "VC1-F7" };
        Statement::new(fact, text, WITHIN_1).unit("ms").paper([FLOOR]).found(found.model(), scenes().filter_map(of))
    };
    let proportional = everywhere().filter(|(_, n)| *n > 1).filter_map(|(scene, n)| {
        let [one, several] = [found.of(plan.case(scene, 1))?, found.of(plan.case(scene, n))?];
        (several.time > GUARDS).then(|| (place(scene, n), f64::from(n) * several.time / one.time))
    });
    let fastest = |n: u32| scenes().filter_map(|scene| found.of(plan.case(scene, n))).map(Timed::rate).reduce(f64::max);
    let estimate = |from: u32, to: u32| {
        let some = found.estimated.iter().filter(|it| (from..=to).contains(&it.processors));
        let ratios = some.filter_map(|it| Some((place(it.scene, it.processors), it.of_time(found)?)));
        let text = format!("The two-pass estimate coincides with the time: n = {from} to {to}.");
        Statement::new("VC1-EST", text, WITHIN_1).unit("estimate / T").paper([1.0]).found(found.model(), ratios)
    };
    let ter250 = [plan.case("ter250", 1), plan.case("ter250", 256)];
    vec![
        Statement::new("VC1-33", "The rendering time is never below 33.3 ms.", Rule::AtLeast)
            .unit("ms")
            .paper([FLOOR])
            .found(found.model(), times),
        with_256("60", false),
        with_256("59.94", true),
        Statement::new(
            "VC1-F7",
            "The rendering time decreases in inverse proportion to the number of processing elements: n T(n) / T(1), where T(n) is above 42.1 ms.",
            WITHIN_10,
        )
        .paper([1.0])
        .found(found.model(), proportional)
        .because(OVERFLOWS),
        Statement::new("VC1-F7", "256 processing elements draw ter250 190 times as fast as one.", WITHIN_10)
            .unit("times")
            .paper([SPEED_UP])
            .found(found.model(), found.ratio(String::new(), ter250, time).map(|it| it.1))
            .because(COSTS),
        estimate(1, 16),
        estimate(32, 256),
        Statement::new("VC1-RATE", "16 processing elements draw 514,000 polygons a second at most.", WITHIN_10)
            .unit("thousand polygons/s, of the fastest scene")
            .paper([THOUSANDS_WITH_16])
            .found(found.model(), fastest(16).map(|millions| 1e3 * millions))
            .because(COSTS),
        Statement::new("VC1-RATE", "256 processing elements draw 6.1 million polygons a second at most.", WITHIN_1)
            .unit("million polygons/s, of the fastest scene")
            .paper([MILLIONS_WITH_256])
            .found(found.model(), fastest(256)),
        Statement::new("VC1-RATE", "The times of ter250 with 1 and with 16 processing elements are those of the paper’s rates.", WITHIN_10)
            .unit("ms")
            .formula(derived()[..2].iter().map(|(n, time)| (format!("n = {n}"), *time)))
            .found(
                found.model(),
                [1, 16].into_iter().filter_map(|n| found.at(format!("n = {n}"), plan.case("ter250", n), time)),
            )
            .because(COSTS),
    ]
}

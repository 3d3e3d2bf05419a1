//! Image memory: Figure 8, clusters (section 4.1) and locality (section 6).

use super::super::counted::PROCESSORS;
use super::super::found::Found;
use super::super::plan::CLUSTERS;
use super::super::run::Timed;
use super::reasons::BORDERS;
use super::{LITTLE, WITHIN_5, WITHIN_10};
use tilewright_report::{Rule, Statement};

pub fn statements(found: &Found) -> Vec<Statement> {
    let mut statements = figure_8(found);
    statements.extend(clusters(found));
    statements.extend(locality(found));
    statements
}

fn figure_8(found: &Found) -> Vec<Statement> {
    let plan = &found.plan;
    let time = |it: &Timed| it.time;
    let enough = |n: u32, part: u32| {
        let of = |scene: &&'static str| {
            let cases = [part, 1].map(|part| plan.in_memory(scene, n, part));
            found.ratio((*scene).to_owned(), cases, time)
        };
        let text = format!(
            "With {n} processing elements 1/{part} of the screen is enough for all scenes without significant degradation: T(1/{part}) / T(1)."
        );
        Statement::new("VC1-F8", text, Rule::AtMost)
            .paper([LITTLE])
            .found(found.model(), plan.scenes().iter().filter_map(of))
    };
    let mut statements = vec![enough(16, 8), enough(256, 32)];
    for &n in plan.figure_8() {
        statements.extend(plan.scenes().iter().map(|scene| {
            let of = |part: &u32| found.at(format!("1/{part}"), plan.in_memory(scene, n, *part), time);
            let text = format!("The time increases as image memory decreases: {scene}, n = {n}.");
            Statement::new("VC1-F8", text, Rule::NeverDecreases { with: "less memory".to_owned() })
                .unit("ms")
                .found(found.model(), plan.capacities().iter().filter_map(of))
        }));
    }
    statements
}

fn clusters(found: &Found) -> Vec<Statement> {
    let counted = &found.counted;
    let imbalance =
        CLUSTERS.iter().filter_map(|w| found.at(format!("w = {w}"), found.plan.clustered(*w), |it| it.imbalance));
    let pages = |w: u32| counted.clusters.iter().find(|it| it.polygons == w).map(|it| it.pages);
    vec![
        Statement::new(
            "VC1-CLU",
            "Single polygons balance the load better than clusters: ter1k, n = 16.",
            Rule::Increases { with: "w".to_owned() },
        )
        .unit("the busiest over the mean")
        .found(found.model(), imbalance),
        Statement::new(
            "VC1-CLU",
            "With larger clusters fewer vertices are transformed twice.",
            Rule::Decreases { with: "w".to_owned() },
        )
        .unit("vertices transformed")
        .found(counted.origin(), counted.clusters.iter().map(|it| (format!("w = {}", it.polygons), it.vertices))),
        Statement::new("VC1-CLU", "Single polygons take more pages: w = 1 over w = 32.", Rule::AtLeast)
            .paper([LITTLE])
            .found(counted.origin(), pages(1).zip(pages(32)).map(|(one, other)| one / other)),
    ]
}

fn locality(found: &Found) -> Vec<Statement> {
    let counted = &found.counted;
    let beside = |of: fn(&super::super::counted::Share) -> f64| {
        let [many, few] = ["ter250", "ter1k"].map(|scene| counted.share(scene, 16).map(of));
        many.zip(few).map(|(many, few)| many / few)
    };
    let mut statements = vec![
        Statement::new(
            "VC1-LOC",
            "The pixels of a processing element are a p / n, whatever the number of polygons: ter250 beside ter1k.",
            WITHIN_5,
        )
        .paper([1.0])
        .found(counted.origin(), beside(|it| it.pixels)),
        Statement::new(
            "VC1-LOC",
            "The memory that processing elements need does not depend on the number of polygons: pages of ter250 beside ter1k.",
            WITHIN_10,
        )
        .paper([1.0])
        .found(counted.origin(), beside(|it| it.pages))
        .because(BORDERS),
    ];
    statements.extend(["ter1k", "ter250"].map(|scene| {
        let of = |n| counted.share(scene, n).map(|it| (format!("n = {n}"), it.pages));
        let text = format!("The memory that each needs decreases as the number of processing elements grows: {scene}.");
        Statement::new("VC1-LOC", text, Rule::Decreases { with: "n".to_owned() })
            .unit("pages of each")
            .found(counted.origin(), PROCESSORS.into_iter().filter_map(of))
    }));
    statements
}

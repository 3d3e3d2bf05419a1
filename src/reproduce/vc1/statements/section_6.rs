//! Section 6: larger machines.

use super::super::found::Found;
use super::super::plan::Plan;
use super::super::run::Timed;
use super::reasons::{COMMAND, EQUALS};
use super::{FLOOR, WITHIN_1, WITHIN_2};
use tilewright_report::{Origin, Rule, Statement};
use tilewright_scenes::Size;

/// The threshold with the least T; if several have it, that with the least D.
pub fn best(found: &Found, machine: (u32, u32)) -> Option<&Timed> {
    let all = found.plan.thresholds().filter_map(|apr| found.of(found.plan.in_section_6(machine, apr)));
    all.min_by(|one, other| {
        (one.time, one.drawing).partial_cmp(&(other.time, other.drawing)).expect("times are numbers")
    })
}

pub fn statements(found: &Found) -> Vec<Statement> {
    let plan: &Plan = &found.plan;
    let bests = || plan.section_6().filter_map(|machine| Some((machine.0, best(found, machine)?)));
    // No packet is larger than the screen, so this means no threshold.
    let screen = Size::VGA.pixels() as f64;
    let thresholds = bests().map(|(n, it)| (format!("n = {n}"), it.case.apr.map_or(screen, f64::from)));
    let areas =
        bests().filter_map(|(n, it)| Some((format!("n = {n}"), found.counted.mean_area(it.case.config(plan).apr)?)));
    let bus = bests().filter(|(n, _)| *n == 256).map(|(_, it)| it.bus);
    let immediate = |n| found.of(plan.immediate(n));
    let merging = found.circuit.merging.map(|clocks| clocks as f64);
    let with = || "n".to_owned();
    vec![
        Statement::new(
            "VC1-THRN",
            "With more processing elements, and memory from 1/4 down to 1/32, the threshold should be lowered: the best one for the table.",
            Rule::NeverIncreases { with: with() },
        )
        .unit("pixels")
        .found(found.model(), thresholds),
        Statement::new(
            "VC1-THRN",
            "The polygons that are sent become smaller: their mean area with the best threshold.",
            Rule::Decreases { with: with() },
        )
        .unit("pixels")
        .found(found.counted.origin(), areas)
        .because(EQUALS),
        Statement::new(
            "VC1-THRN",
            "The bus is no serious limitation: its time with 256 and the best threshold.",
            Rule::AtMost,
        )
        .unit("ms a frame")
        .paper([FLOOR])
        .found(found.model(), bus),
        Statement::new(
            "VC1-IMM",
            "If the host sends the whole scene for each frame, the bus is the bottleneck: its time for ter250, n = 256.",
            Rule::AtLeast,
        )
        .unit("ms a frame")
        .paper([FLOOR])
        .found(found.model(), immediate(256).map(|it| it.bus)),
        Statement::new("VC1-IMM", "In immediate mode the machine is no longer scalable: T(64) / T(256) of ter250.", WITHIN_1)
            .paper([1.0])
            .found(found.model(), immediate(64).zip(immediate(256)).map(|(few, many)| few.time / many.time))
            .because(COMMAND),
        Statement::new(
            "VC1-33",
            "The merger has to be faster in proportion to the pixels: T_m of 1280x960 pixels over that of 640x480.",
            WITHIN_2,
        )
        .paper([4.0])
        .found(Origin::rtl([]), [merging[1] / merging[0]]),
    ]
}

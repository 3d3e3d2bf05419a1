//! The claim of each figure, a sentence with numbers.

use super::found::Found;
use super::plan::{Capacity, Case, SPLITS, THRESHOLD};
use super::run::Timed;
use super::statements::best as best_of;
use crate::reproduce::words::{percent, short};
use tilewright_rtl::gfb::Blanking;

/// The claim of a quick look without enough points.
const NOTHING: &str = "A quick look has too few points to show anything.";

fn or_nothing(claim: Option<String>) -> String {
    claim.unwrap_or_else(|| NOTHING.to_owned())
}

/// The largest scene with the fewest and with the most processing elements.
fn ends(found: &Found) -> Option<(&'static str, [u32; 2], [&Timed; 2])> {
    let plan = &found.plan;
    let scene = *plan.scenes().last()?;
    let ends = [*plan.processors().first()?, *plan.processors().last()?];
    let [few, many] = ends.map(|n| found.of(plan.case(scene, n)));
    Some((scene, ends, [few?, many?]))
}

pub fn time(found: &Found) -> String {
    or_nothing(ends(found).map(|(scene, [few, many], times)| {
        let [one, other] = times.map(|it| short(it.time));
        format!("From {few} to {many} processing elements T of {scene} shrinks from {one} to {other} ms.")
    }))
}

pub fn drawing(found: &Found) -> String {
    or_nothing(ends(found).map(|(scene, [few, many], times)| {
        let [one, other] = times.map(|it| short(it.drawing));
        format!("From {few} to {many} processing elements D of {scene} shrinks from {one} to {other} ms, whatever the refresh.")
    }))
}

pub fn estimate(found: &Found) -> String {
    let off = found.estimated.iter().filter_map(|it| Some((it.of_time(found)? - 1.0).abs()));
    match off.fold(0.0, f64::max) {
        0.0 => "Each estimate is T itself.".to_owned(),
        off => format!("No estimate is further from T than {}.", percent(off)),
    }
}

/// The share of the clocks that waits for the end of a frame.
pub fn waiting(found: &Found, scene: &'static str) -> String {
    let share = |n: u32| {
        let timed = found.of(found.plan.case(scene, n))?;
        Some(percent(timed.class("swap") / (timed.clocks.iter().sum::<f64>() * super::run::CLOCK)))
    };
    let ends = found.plan.processors().first().zip(found.plan.processors().last());
    or_nothing(ends.and_then(|(few, many)| {
        let (one, other) = (share(*few)?, share(*many)?);
        Some(format!("Waiting for the swap at the end of a frame takes {one} of the clocks with n = {few}, and {other} with n = {many}."))
    }))
}

/// The cost of the least memory.
pub fn memory(found: &Found, n: u32, label: &str, of: fn(&Timed) -> f64) -> String {
    let plan = &found.plan;
    let most = |part: u32| {
        let ratio =
            |scene: &&'static str| found.ratio(String::new(), [part, 1].map(|part| plan.in_memory(scene, n, part)), of);
        plan.scenes().iter().filter_map(ratio).map(|it| it.1).reduce(f64::max)
    };
    or_nothing(plan.capacities().iter().max().and_then(|part| {
        let most = short(most(*part)?);
        Some(format!("With 1/{part} of the screen {label} is at most {most} times that with pages for all patches."))
    }))
}

fn paper(found: &Found, apr: Option<u32>) -> Case {
    found.plan.at_threshold(Capacity::Paper, Blanking::AtStart, apr)
}

/// The time with the paper's threshold over that without.
pub fn saved(found: &Found) -> String {
    let left = found.ratio(String::new(), [Some(THRESHOLD), None].map(|apr| paper(found, apr)), |it| it.time);
    or_nothing(left.map(|(_, left)| {
        format!(
            "With 1/4.7 of the screen a threshold of {THRESHOLD} pixels reduces T to {} of that without.",
            percent(left)
        )
    }))
}

/// A threshold in words.
fn threshold(apr: Option<u32>) -> String {
    apr.map_or_else(|| "no threshold".to_owned(), |pixels| format!("a threshold of {pixels} pixels"))
}

/// The threshold with the least D.
pub fn least(found: &Found) -> String {
    let all = found.plan.thresholds().filter_map(|apr| Some((apr, found.of(paper(found, apr))?.drawing)));
    or_nothing(
        all.min_by(|one, other| one.1.total_cmp(&other.1))
            .map(|(apr, drawing)| format!("D is least, {} ms, with {}.", short(drawing), threshold(apr))),
    )
}

/// The effect of the split of the clocks at the paper's threshold.
pub fn splits(found: &Found) -> String {
    let all = || SPLITS.iter().filter_map(|set_up| found.of(found.plan.with_split(*set_up, Some(THRESHOLD))));
    let ends = all().map(|it| it.drawing).reduce(f64::min).zip(all().map(|it| it.drawing).reduce(f64::max));
    or_nothing(ends.map(|(least, most)| {
        format!(
            "With a threshold of {THRESHOLD} pixels D is {} to {} ms, however the clocks are split.",
            short(least),
            short(most)
        )
    }))
}

/// The best thresholds of the smallest and of the largest machine.
pub fn best(found: &Found) -> String {
    let mut bests =
        found.plan.section_6().filter_map(|machine| Some((machine.0, threshold(best_of(found, machine)?.case.apr))));
    let ends = bests.next().zip(bests.last());
    or_nothing(ends.map(|((few, one), (many, other))| {
        format!("{few} processing elements are fastest with {one}, and {many} with {other}.")
    }))
}

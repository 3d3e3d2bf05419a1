//! Verdicts can change: another cost, page count or refresh changes a verdict of each kind of rule.

use super::super::figure_6::{Figure6, PAGES};
use super::super::found::Found;
use super::super::plan::{CLUSTERS, Capacity, Case, Plan, Usual};
use super::*;
use crate::reproduce::effort::Effort;
use tilewright_machines::Watch;
use tilewright_machines::vc1::CostTable;
use tilewright_report::Statement;
use tilewright_rtl::gfb::Blanking;

fn refresh(refresh: f64) -> Usual {
    Usual { refresh, ..Usual::default() }
}

fn pages(pages: f64) -> Usual {
    Usual { pages, ..Usual::default() }
}

fn costs(costs: CostTable) -> Usual {
    Usual { costs, ..Usual::default() }
}

/// The verdict on the statement that contains these words.
fn verdict(statements: Vec<Statement>, words: &str) -> String {
    let is_it = |it: &&Statement| format!("{it:?}").contains(words);
    statements.iter().find(is_it).unwrap_or_else(|| panic!("nothing says {words}")).verdict().to_string()
}

/// The verdict is true for the first machine, and differs for the second.
#[track_caller]
fn turns(
    [before, after]: [Usual; 2],
    cases: impl Fn(&Plan) -> Vec<Case>,
    of: fn(&Found) -> Vec<Statement>,
    words: &str,
) {
    let [before, after] = [before, after].map(|usual| {
        let plan = Plan { effort: Effort { seed: 1, most: Some(1) }, usual };
        verdict(of(&Found::of_cases(&plan, &cases(&plan))), words)
    });
    assert_eq!(before, "holds");
    assert!(after.starts_with("differs by "), "{after}");
}

#[test]
fn another_refresh_turns_what_is_at_least_the_floor() {
    let cases = |plan: &Plan| vec![plan.case("teapot", 16)];
    turns([refresh(60.0), refresh(70.0)], cases, scaling::statements, "never below 33.3 ms");
}

#[test]
fn another_page_count_turns_what_is_within_the_papers_time() {
    let cases = |plan: &Plan| plan.views().map(|view| plan.vlfb(view)).collect();
    turns([pages(4.0), pages(1.0)], cases, table_1::statements, "ter1k takes 33.4 ms");
}

#[test]
fn another_page_count_turns_what_is_enough_at_most() {
    let cases = |plan: &Plan| [1, 8].map(|part| plan.in_memory("teapot", 16, part)).to_vec();
    turns([pages(8.0), pages(1.0)], cases, memory::statements, "1/8 of the screen is enough");
}

#[test]
fn another_cost_turns_what_is_at_most_a_part_of_all() {
    let slower = CostTable { area: 100, ..CostTable::default() };
    turns(
        [costs(CostTable::default()), costs(slower)],
        |plan| vec![plan.case("teapot", 16)],
        apr::statements,
        "less than 3 %",
    );
}

#[test]
fn another_page_count_turns_the_order_of_figure_6() {
    let order = |pages| Figure6::ran(pages, &mut Watch::default()).expect("it runs").statement().verdict().to_string();
    assert_eq!(order(PAGES), "holds");
    assert_eq!(order(2 * PAGES), "cannot be compared: nothing was found at 6.");
}

#[test]
fn another_cost_turns_what_increases() {
    let pixels = CostTable { vertex: 0, polygon: 0, area: 0, clip: 0, set_up: 0, row: 0, ..CostTable::default() };
    let cases = |plan: &Plan| CLUSTERS.map(|w| plan.clustered(w)).to_vec();
    turns([costs(CostTable::default()), costs(pixels)], cases, memory::statements, "Single polygons balance");
}

#[test]
fn another_page_count_turns_what_never_decreases() {
    let cases =
        |plan: &Plan| plan.thresholds().map(|apr| plan.at_threshold(Capacity::Paper, Blanking::AtStart, apr)).collect();
    turns([pages(1.0), pages(0.1)], cases, apr::statements, "overflows increase");
}

#[test]
fn another_page_count_turns_what_decreases() {
    let words = CostTable { send: 100, receive: 100, ..CostTable::default() };
    let of = |pages| Usual { pages, ..costs(words) };
    let cases = |plan: &Plan| {
        let at = |apr| plan.section_6().map(move |machine| plan.in_section_6(machine, apr));
        plan.thresholds().flat_map(at).collect()
    };
    turns([of(0.03), of(1.0)], cases, section_6::statements, "polygons that are sent become smaller");
}

/// Only four processing elements have few pages and need a threshold; sixteen need none.
#[test]
fn another_page_count_turns_what_never_increases() {
    let found = |usual: Usual, which: usize| {
        let plan = Plan { effort: Effort { seed: 1, most: Some(1) }, usual };
        let machine = plan.section_6().nth(which).expect("two machines");
        let cases: Vec<Case> = plan.thresholds().map(|apr| plan.in_section_6(machine, apr)).collect();
        Found::of_cases(&plan, &cases)
    };
    let of = |few: f64, many: f64| {
        let both = found(pages(few), 0).and(found(pages(many), 1));
        verdict(section_6::statements(&both), "the threshold should be lowered")
    };
    assert_eq!(of(1.0, 1.0), "holds");
    let after = of(0.02, 4.0);
    assert!(after.starts_with("differs by "), "{after}");
}

//! The checks without which the page is worthless: the three programs agree, and frames are right.

use super::found::Found;
use tilewright_machines::quadtree::model::OnHardware;
use tilewright_report::{Cell, Rule, Section, Statement, Table, Verdicts};

/// The section of the checks.
pub fn section(found: &Found) -> Section {
    let numbers: u64 = found.ran.outcomes.iter().filter_map(|it| it.hardware.as_ref()).map(|it| it.numbers).sum();
    Section::new("Checks of the measurements")
        .paragraph(format!(
            "The circuit, the transaction model and the plain count are three programs. Where the circuit ran, the other two got the same rectangles, and {numbers} counters and clocks were compared \
             one by one."
        ))
        .part(verdicts(found))
        .part(samples(found))
}

/// The number of rectangles of each area.
fn samples(found: &Found) -> Table {
    let columns = ["area S, pixels", "plain count", "transaction model", "RTL"];
    let table = Table::new("samples", "Random rectangles of each area", columns);
    found.ran.outcomes.iter().filter(|it| it.matrix.p == 1).fold(table, |table, ran| {
        let counted = &found.counted.at(0, ran.sample.area).sample;
        let on_hardware = if ran.hardware.is_some() { ran.sample.polygons } else { 0 };
        let numbers = [counted.polygons, ran.sample.polygons, on_hardware].map(|polygons| polygons as f64);
        table.row([counted.area].into_iter().chain(numbers).map(Cell::from))
    })
}

fn verdicts(found: &Found) -> Verdicts {
    let ran = |of: fn(&OnHardware) -> u64| {
        found.ran.outcomes.iter().filter_map(move |outcome| {
            let (k, area) = (outcome.matrix.p.ilog2(), outcome.sample.area);
            Some((format!("k = {k}, S = {area}"), of(outcome.hardware.as_ref()?) as f64))
        })
    };
    Verdicts::new("checks", "Checks")
        .state(
            Statement::new(
                "E2",
                "The hardware’s counters, and the clocks in which it takes packets or is idle, are those of the transaction-level model.",
                Rule::Zero,
            )
            .unit("numbers that differ")
            .found(found.ran.rtl(), ran(|it| it.differs_from_model)),
        )
        .state(
            Statement::new(
                "MPG-EQ5",
                "The windows and busy clocks of each level, and the pixels, are those of the plain count in each video processor.",
                Rule::Zero,
            )
            .unit("numbers that differ")
            .found(found.ran.rtl(), ran(|it| it.differs_from_count)),
        )
        .states(super::frames::checks(&found.frames))
}

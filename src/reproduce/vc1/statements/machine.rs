//! The hardware: the merger, the local frame buffers, the bus.

use super::super::found::Found;
use super::super::idle::Idle;
use super::super::plan::Capacity;
use super::reasons::SWAPS;
use super::{FLOOR, WITHIN_1, WITHIN_2, WITHIN_HALF};
use tilewright_report::{Origin, Rule, Statement};
use tilewright_rtl::clocks::{MERGE, PE};
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::vc1::OVERHEAD;

pub fn statements(found: &Found) -> Vec<Statement> {
    let circuit = &found.circuit;
    let [merging, _] = circuit.merging.map(|clocks| clocks as f64);
    let round = f64::from((Screen::VC1.width + OVERHEAD) * Screen::VC1.height);
    let [page, no_page] = circuit.accesses.map(|clocks| clocks as f64);
    let megahertz = 1e6 / PE.period.picoseconds() as f64;
    let rtl = || Origin::rtl([]);
    vec![
        Statement::new(
            "VC1-TM",
            "T_m, the time to merge a full screen, is 25.3 ms with 16 processing elements.",
            WITHIN_HALF,
        )
        .unit("ms")
        .paper([25.3])
        .found(rtl(), [merging * MERGE.period.picoseconds() as f64 / 1e9]),
        Statement::new("VC1-TM", "T_m is (M + β) N + 4 n clocks of the merger.", Rule::Equals)
            .unit("clocks")
            .formula([round + 64.0])
            .found(rtl(), [merging]),
        Statement::new(
            "VC1-FREE",
            "The scan restarts immediately at its end: rounds follow each other in (M + β) N clocks.",
            Rule::Equals,
        )
        .unit("clocks")
        .formula([round])
        .found(rtl(), [circuit.round as f64]),
        Statement::new(
            "VC1-ACC",
            "An access to the local frame buffer follows another after 3 clocks, or after 4 if its patch has no page yet.",
            Rule::Equals,
        )
        .unit("clocks")
        .paper([("with a page", 3.0), ("without one", 4.0)])
        .found(rtl(), [("with a page", page), ("without one", no_page)]),
        Statement::new("VC1-PT", "An image memory of 4096 pages holds 1/4.7 of the screen.", WITHIN_1)
            .unit("of the screen")
            .paper([1.0 / 4.7])
            .found(Origin::count([]), [Capacity::Paper.share()]),
        Statement::new("VC1-NET", "The peak bandwidth of the broadcast bus is 27 Mbyte/s.", WITHIN_2)
            .unit("Mbyte/s")
            .paper([27.0])
            .found(rtl(), [circuit.bus * megahertz]),
        Statement::new(
            "VC1-CLR2",
            "After each swap the processor clears its patch table by software; here an entry takes 3 clocks.",
            Rule::Equals,
        )
        .unit("ms")
        .found(found.model(), found.of(found.plan.case("teapot", 16)).map(|it| it.class("clearing")))
        .cannot_be_compared("the paper gives no number"),
        found.figure_6.statement(),
        idle(found, "if the buffers swapped in a blanking before", |it| it.in_blanking),
        idle(found, "if all swapped together before, at any time", |it| it.together),
        idle(found, "in any case", |it| it.any.max(it.together).max(it.in_blanking)),
    ]
}

/// The longest wait of an overflow.
fn idle(found: &Found, when: &str, of: fn(&Idle) -> f64) -> Statement {
    let text = format!("A processor’s worst-case idle time upon an overflow is 33.3 ms: {when}.");
    let statement = Statement::new("VC1-SW4", text, Rule::AtMost).unit("ms").paper([FLOOR]);
    statement.found(found.model(), [of(&found.idle)]).because(SWAPS)
}

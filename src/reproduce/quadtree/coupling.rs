//! Running matrices with their waits, and the loss by queues of packets. The paper assumes that processors work equally long and are coupled
//! loosely (MPG-LIM).

use super::by_formula;
use super::curves::figure;
use super::found::{Coupled, Found};
use crate::reproduce::words::{percent, short};
use tilewright_machines::quadtree::model::Measured;
use tilewright_report::{Axis, Chart, Section, Series};

/// The running matrix beside the formulas, which leave out waits; then the loss.
pub fn section(found: &Found) -> Section {
    let section = Section::new("As it runs: waits, and depth of queues")
        .paragraph(
            "The figures above follow from the clocks in which units work. A running matrix also waits: a packet goes to all video processors at once, so a full queue of one stalls the others. \
             The points are polygons over all clocks until the matrix is idle, with queues of 16 packets before each processor. The lines are the formulas, which leave out waits.",
        )
        .figure(
            as_ran(found, "stacks", by_formula(4, AREA).p_s, |it| it.stacks_ran),
            figure(found, ("stacks-as-run", "Performance of stacks as they ran, over P_max", true), |it| it.p_s, None, |it| it.stacks_ran),
        )
        .figure(
            as_ran(found, "pipelines", by_formula(4, AREA).p_p, |it| it.pipes_ran),
            figure(found, ("pipelines-as-run", "Performance of pipelines as they ran, over P_max", true), |it| it.p_p, None, |it| it.pipes_ran),
        )
        .paragraph(
            "The waits depend on the queues. The loss compares the matrix with its mean processor if none had to wait for another. It is the share of the clocks by which the matrix takes longer. Deeper \
             queues win back one part of it. The other part stays: some processors have more work than others.",
        );
    section
        .figure(lost(&found.coupled, "stack", "stacks"), by_matrix(&found.coupled, "stack", "stacks"))
        .figure(lost_by_area(&found.coupled), by_area(&found.coupled))
        .paragraph(
            "A pipeline needs no such queues, because its stages and the queues of windows between them store several packets. Below, depth is that of the window queues, and the loss is the share \
             of the clocks in which the slowest level is idle.",
        )
        .figure(lost(&found.coupled, "pipe", "pipelines"), by_matrix(&found.coupled, "pipe", "pipelines"))
        .figure(idle(&found.coupled), by_windows(&found.coupled))
}

/// The performance of the largest running matrix, beside the formula.
fn as_ran(found: &Found, name: &str, formula: f64, of: fn(&Measured) -> f64) -> String {
    let ran = found.ran.on_model(4, of).into_iter().find(|(area, _)| *area == AREA).expect("that area ran");
    format!(
        "With all waits, 256 {name} reach {} of the formula’s performance at {AREA} pixels.",
        percent(ran.1 / formula)
    )
}

/// The loss with the shortest and with the deepest queues of packets.
fn lost(coupled: &Coupled, form: &str, name: &str) -> String {
    let all = coupled.loss(4, form, AREA);
    let [(shallow, one), (deep, other)] = [all[0], all[all.len() - 1]];
    let (one, other) = (percent(one), percent(other));
    format!(
        "At {AREA} pixels 256 {name} lose {one} with queues of {shallow} packet, and {other} with queues of {deep}."
    )
}

/// The loss with the deepest queues, by area.
fn lost_by_area(coupled: &Coupled) -> String {
    let of = |area: f64| coupled.loss(4, "stack", area).last().map(|(depth, loss)| (area, *depth, *loss));
    let all: Vec<(f64, f64, f64)> = coupled.areas().into_iter().filter_map(of).collect();
    let [least, most] = [all[0], all[all.len() - 1]];
    format!(
        "With queues of {} packets 256 stacks still lose {} at S = {}, and {} at S = {}.",
        least.1,
        percent(least.2),
        short(least.0),
        percent(most.2),
        short(most.0)
    )
}

/// The idle share with the shortest and with the deepest queues of windows.
fn idle(coupled: &Coupled) -> String {
    let all = coupled.idling(4);
    let [(shallow, one), (deep, other)] = [all[0], all[all.len() - 1]];
    format!(
        "The slowest level of 256 pipelines is idle in {} of the clocks with queues of {shallow} window, and in {} with queues of {deep}.",
        percent(one),
        percent(other)
    )
}

/// The area at which matrices are compared.
const AREA: f64 = 100.0;

fn by_matrix(coupled: &Coupled, form: &str, name: &str) -> Chart {
    let title = format!("Loss of {name} by depth of packet queues, rectangles of {AREA} pixels");
    (0..=4).fold(chart(format!("loss-{name}"), title, PACKETS, LOSS), |chart, k| {
        chart.series(Series::new(format!("k = {k}"), coupled.origin(), coupled.loss(k, form, AREA)))
    })
}

fn by_area(coupled: &Coupled) -> Chart {
    let title = "Loss of 16 x 16 stacks by depth of packet queues".to_owned();
    coupled.areas().into_iter().fold(chart("loss-by-area".to_owned(), title, PACKETS, LOSS), |chart, area| {
        chart.series(Series::new(format!("S = {area}"), coupled.origin(), coupled.loss(4, "stack", area)))
    })
}

fn by_windows(coupled: &Coupled) -> Chart {
    let title = format!("Idle share of the slowest level by depth of window queues, rectangles of {AREA} pixels");
    (0..=4).fold(
        chart("idle-pipelines".to_owned(), title, "windows in each queue", "idle share of the clocks"),
        |chart, k| chart.series(Series::new(format!("k = {k}"), coupled.origin(), coupled.idling(k))),
    )
}

const PACKETS: &str = "packets in each queue";
const LOSS: &str = "loss, share of the clocks";

fn chart(id: String, title: String, depth: &str, what: &str) -> Chart {
    Chart::new(id, title, Axis::log(depth), Axis::linear(what))
}

//! Matrices as they run, with their waits, and what queues of packets lose: the paper's assumption that processors work equally long and
//! are coupled loosely (MPG-LIM).

use super::curves::figure;
use super::found::{Coupled, Found};
use tilewright_report::{Axis, Chart, Section, Series};

/// As it ran, beside the formulas, which know no waits; then the loss.
pub fn section(found: &Found) -> Section {
    let section = Section::new("As it runs: waits, and depth of queues")
        .paragraph(
            "The figures above follow from the clocks in which units work. A running matrix also waits: a packet goes to all video \
             processors at once, so one whose queue is full holds up the others. These points are polygons over all clocks until the matrix \
             is idle, with queues of 16 packets before each processor; the lines are the formulas, which know no waits.",
        )
        .part(figure(found, ("stacks-as-run", "Performance of stacks as they ran, in parts of P_max", true), |it| it.p_s, None, |it| it.stacks_ran))
        .part(figure(found, ("pipelines-as-run", "Performance of pipelines as they ran, in parts of P_max", true), |it| it.p_p, None, |it| it.pipes_ran))
        .paragraph(
            "How much that is depends on the queues. The loss is the part of the clocks by which a matrix takes longer than its processors \
             would on the mean, if none had to wait for another. It has two parts: what deeper queues win back, and that one processor has more \
             to do than another, which no queue does.",
        );
    section
        .part(by_matrix(&found.coupled, "stack", "stacks"))
        .part(by_area(&found.coupled))
        .paragraph(
            "A pipeline takes packets in without such queues: its stages and the queues of windows between them hold several. There the \
             depth is that of the queues of windows, and the loss the part of the clocks in which its slowest level has nothing to do.",
        )
        .part(by_matrix(&found.coupled, "pipe", "pipelines"))
        .part(by_windows(&found.coupled))
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
    let title = format!("Idle part of the slowest level by depth of window queues, rectangles of {AREA} pixels");
    (0..=4).fold(
        chart("idle-pipelines".to_owned(), title, "windows in each queue", "idle part of the clocks"),
        |chart, k| chart.series(Series::new(format!("k = {k}"), coupled.origin(), coupled.idling(k))),
    )
}

const PACKETS: &str = "packets in each queue";
const LOSS: &str = "loss, part of the clocks";

fn chart(id: String, title: String, depth: &str, what: &str) -> Chart {
    Chart::new(id, title, Axis::log(depth), Axis::linear(what))
}

//! Matrices as they run, with their waits, and what queues of packets lose: the paper's assumption that processors work equally long and
//! are coupled loosely (MPG-LIM).

use super::curves::figure;
use super::found::{Coupled, Found};
use tilewright_report::{Axis, Chart, Section, Series};

/// Forms as the sweep names them, and as the page does.
const FORMS: [(&str, &str); 2] = [("pipe", "pipelines"), ("stack", "stacks")];

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
    FORMS.into_iter().fold(section, |section, (form, name)| {
        section.part(by_matrix(&found.coupled, form, name)).part(by_area(&found.coupled, form, name))
    })
}

fn by_matrix(coupled: &Coupled, form: &str, name: &str) -> Chart {
    let title = format!("Loss of {name} by depth, rectangles of 100 pixels");
    (0..=4).fold(loss(format!("loss-{name}"), title), |chart, k| {
        chart.series(Series::new(format!("k = {k}"), coupled.origin(), coupled.loss(k, form, 100.0)))
    })
}

fn by_area(coupled: &Coupled, form: &str, name: &str) -> Chart {
    let title = format!("Loss of 16 x 16 {name} by depth");
    coupled.areas().into_iter().fold(loss(format!("loss-{name}-by-area"), title), |chart, area| {
        chart.series(Series::new(format!("S = {area}"), coupled.origin(), coupled.loss(4, form, area)))
    })
}

fn loss(id: String, title: String) -> Chart {
    Chart::new(id, title, Axis::log("packets in each queue"), Axis::linear("loss"))
}

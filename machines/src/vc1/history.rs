//! What a VC-1 did in the time of its frames.

use tilewright_rtl::clocks::{MERGE, PE};

use super::processor::Processor;
use super::report::{Report, Times};
use crate::history::{History, Lane, Painting};

/// The history from taken pixels, from processing elements that were logged since that edge, and from the report.
pub(super) fn of(painting: Painting, processors: &[Processor], begun: u64, report: &Report) -> History {
    let names: Vec<String> = (0..processors.len()).map(|number| format!("PE {number}")).collect();
    let of_processor = |(name, it): (&String, &Processor)| processor(name, it, begun);
    let lanes = names.iter().zip(processors).map(of_processor).chain([merger(report), display(report)]).collect();
    painting.into_history(names, lanes)
}

fn processor(name: &str, processor: &Processor, begun: u64) -> Lane {
    let period = PE.period.picoseconds();
    let mut lane = Lane::of_clocks(name, period, 1);
    let mut clock = begun;
    for &(class, clocks) in processor.runs() {
        lane.add(class.name(), clock * period, (clock + clocks) * period, clocks);
        clock += clocks;
    }
    lane
}

/// From the last swap of a frame until it is stored.
fn merger(report: &Report) -> Lane {
    let period = MERGE.period.picoseconds();
    let mut lane = Lane::of_clocks("merger", period, 1);
    for Times { swapped, merged, .. } in report.frames.iter().map(|frame| frame.times) {
        let (from, to) = (swapped.unwrap_or_default(), merged.unwrap_or_default());
        lane.add("merging", from, to, (to - from) / period);
    }
    lane
}

/// The time from which on each frame is shown.
fn display(report: &Report) -> Lane {
    let period = MERGE.period.picoseconds();
    let mut lane = Lane::of_clocks("display", period, 1);
    for Times { merged, shown, .. } in report.frames.iter().map(|frame| frame.times) {
        let (from, to) = (merged.unwrap_or_default(), shown.unwrap_or_default());
        lane.add("waiting for the blanking", from, to, (to - from) / period);
    }
    lane
}

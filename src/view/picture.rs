//! A frame of a machine with its history, as the page reads it.

use crate::engine::EngineArguments;
use crate::machine::{Machine, Run, Viewed, Visitor, visit};
use crate::pictures::times;
use crate::shell::{Failure, progress};
use crate::trace::TraceOptions;
use crate::verdict::Golden;
use tilewright_machines::{History, Recorder};
use tilewright_report::palette;
use tilewright_scenes::Scene;
use tilewright_scenes::frame::{depth_of, rgb_of};
use tilewright_view::{Clock, Kind, Lane, Part, Picture, Unit, Write};

/// A scene drawn by a machine as `render` draws it without options, and compared with the golden image.
///
/// # Errors
/// The machine cannot draw the scene; Ctrl-C.
pub fn drawn(scene: &Scene, machine: Machine) -> Result<Picture, Failure> {
    visit(scene, machine, Drawing { scene, machine })
}

struct Drawing<'a> {
    scene: &'a Scene,
    machine: Machine,
}

impl Visitor for Drawing<'_> {
    type Output = Picture;

    fn visit(self, job: &impl Viewed) -> Result<Picture, Failure> {
        picture(self.scene, self.machine, job)
    }
}

fn picture(scene: &Scene, machine: Machine, job: &impl Viewed) -> Result<Picture, Failure> {
    let golden = Golden::Rendered(job.golden()?);
    let (recorder, filters) = (Recorder::default(), TraceOptions::default());
    let run = Run { recorder: Some(&recorder), ..Run::new(EngineArguments::default(), &filters) };
    progress::phase("building");
    let (frame, report) = job.render(&run)?;
    let verdict = golden.judge(&frame);
    let history = recorder.take().expect("a recorded machine has a history");
    let clock = job.clock(&report);
    let picture = Picture {
        machine: machine.name().to_owned(),
        title: scene.name.clone(),
        size: [frame.size().width(), frame.size().height()],
        background: history.background,
        end: end(&history).div_ceil(clock.picoseconds),
        units: units(&history),
        grids: job.grid().into_iter().collect(),
        identical: verdict.identical,
        verdict: verdict.to_string(),
        writes: writes(&history, &clock),
        kinds: Vec::new(),
        lanes: Vec::new(),
        clock,
    };
    Ok(with_lanes(picture, &history))
}

/// The end of the last activity, in picoseconds.
fn end(history: &History) -> u64 {
    let spans = history.lanes.iter().filter_map(|lane| Some(lane.spans.last()?.to));
    spans.chain(history.writes.last().map(|write| write.time)).max().unwrap_or(0)
}

fn units(history: &History) -> Vec<Unit> {
    let unit = |(number, name): (u32, &String)| Unit { name: name.clone(), colour: palette::colour(number) };
    (0..).zip(&history.painters).map(unit).collect()
}

fn writes(history: &History, clock: &Clock) -> Vec<Write> {
    let write = |write: &tilewright_machines::Write| Write {
        clock: u32::try_from(write.time / clock.picoseconds).unwrap_or(u32::MAX),
        pixel: write.pixel,
        unit: write.painter,
        depth: depth_of(write.word),
        colour: rgb_of(write.word),
    };
    history.writes.iter().map(write).collect()
}

/// Adds what each unit did.
fn with_lanes(picture: Picture, history: &History) -> Picture {
    let (names, working) = times::kinds(history);
    let kind = |(number, name): (usize, &&str)| Kind { name: (*name).to_owned(), waits: number >= working };
    let kinds = names.iter().enumerate().map(kind).collect();
    let period = picture.clock.picoseconds;
    let place = |name: &str| names.iter().position(|it| *it == name).expect("it has all names");
    let lane = |lane: &tilewright_machines::Lane| {
        let parts = times::parts(lane, &names, end(history)).into_iter().map(|(from, to, shares)| {
            Part(from / period, to / period, shares.into_iter().map(|(name, share)| (place(name), share)).collect())
        });
        Lane { name: lane.name.clone(), parts: parts.collect() }
    };
    Picture { lanes: history.lanes.iter().map(lane).collect(), kinds, ..picture }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::ValueEnum;
    use tilewright_scenes::{Frame, Size, frame::word};

    /// What the page has at the end is the golden image, on each machine, and its clocks are those of the history.
    #[test]
    fn the_last_changes_are_the_frame() {
        let scene = Scene { size: Size::new(32, 24).unwrap(), ..Scene::builtin("star").unwrap() };
        for machine in Machine::value_variants() {
            let picture = drawn(&scene, *machine).unwrap();
            assert_eq!((picture.identical, picture.verdict.as_str()), (true, "identical to the golden image"));
            let mut frame = Frame::blank(scene.size, picture.background);
            for write in &picture.writes {
                frame.words[write.pixel as usize] = word(write.depth, write.colour);
            }
            let golden = visit(&scene, *machine, Golden).unwrap();
            assert!(frame == golden, "{}", machine.name());
            let clocks: Vec<u32> = picture.writes.iter().map(|write| write.clock).collect();
            assert!(clocks.is_sorted() && u64::from(clocks[clocks.len() - 1]) <= picture.end, "{}", machine.name());
            assert!(
                picture
                    .lanes
                    .iter()
                    .all(|lane| lane.parts.iter().all(|Part(from, to, _)| from <= to && *to <= picture.end))
            );
        }
    }

    struct Golden;

    impl Visitor for Golden {
        type Output = Frame;

        fn visit(self, job: &impl Viewed) -> Result<Frame, Failure> {
            job.golden()
        }
    }
}

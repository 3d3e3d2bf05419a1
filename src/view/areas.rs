//! The areas that units of a machine work on, as the page lays them over the picture.

use crate::engine::EngineArguments;
use crate::machine::{Machine, Run, Viewed, Visitor, visit};
use crate::shell::{Failure, progress};
use crate::trace::TraceOptions;
use std::sync::atomic::AtomicBool;
use tilewright_machines::Recorder;
use tilewright_scenes::Scene;
use tilewright_view::{Area, Areas};

/// What the areas of a machine are, if it has some.
pub fn name(machine: Machine) -> Option<&'static str> {
    match machine {
        Machine::Vc1 => Some("patches that have a page"),
        Machine::Quadtree => Some("windows being divided"),
        Machine::PixelPlanes | Machine::PixelFlow => None,
    }
}

/// Draws the scene again, and records the areas of its units. It stops soon after `cancel` becomes true, if there is such a flag.
///
/// # Errors
/// The machine cannot draw the scene, or it was stopped.
pub fn areas(scene: &Scene, machine: Machine, cancel: Option<&AtomicBool>) -> Result<Areas, Failure> {
    visit(scene, machine, Asked { machine, cancel })
}

struct Asked<'a> {
    machine: Machine,
    cancel: Option<&'a AtomicBool>,
}

impl Visitor for Asked<'_> {
    type Output = Areas;

    fn visit(self, job: &impl Viewed) -> Result<Areas, Failure> {
        let (recorder, filters) = (Recorder::with_areas(), TraceOptions::default());
        let run =
            Run { recorder: Some(&recorder), cancel: self.cancel, ..Run::new(EngineArguments::default(), &filters) };
        progress::phase("building");
        let (_, report) = job.render(&run)?;
        let history = recorder.take().expect("a recorded machine has a history");
        let period = job.clock(&report).picoseconds;
        let clock = |time: u64| u32::try_from(time / period).unwrap_or(u32::MAX);
        // Sides of a screen have at most 16 bits.
        let short = |pair: [u32; 2]| pair.map(|it| u16::try_from(it).unwrap_or(u16::MAX));
        let area = |it: &tilewright_machines::Area| Area {
            from: clock(it.from),
            to: clock(it.to),
            unit: it.painter,
            level: it.level,
            place: short(it.place),
            size: short(it.size),
        };
        Ok(Areas {
            name: name(self.machine).unwrap_or_default().to_owned(),
            levels: history.areas.iter().map(|it| it.level).max().unwrap_or(0),
            list: history.areas.iter().map(area).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::picture::drawn;
    use tilewright_scenes::Size;

    /// Every pixel of a unit is written within an area of that unit: in a patch that has a page, and in a window of its own at that time.
    #[test]
    fn pixels_are_drawn_within_areas() {
        let scene = Scene { size: Size::new(32, 24).unwrap(), ..Scene::builtin("star").unwrap() };
        for machine in [Machine::Vc1, Machine::Quadtree] {
            let (areas, picture) = (areas(&scene, machine, None).unwrap(), drawn(&scene, machine).unwrap());
            assert!(areas.list.is_sorted_by_key(|it| it.from) && areas.list.iter().all(|it| it.from <= it.to));
            assert!(areas.list.iter().all(|it| it.place[0] < 32 && it.place[1] < 24), "{}", machine.name());
            for write in &picture.writes {
                let at = [write.pixel % 32, write.pixel / 32];
                let is_in = |it: &&Area| {
                    it.unit == write.unit
                        && it.from <= write.clock
                        && (0..2).all(|axis| {
                            let begin = u32::from(it.place[axis]);
                            (begin..begin + u32::from(it.size[axis])).contains(&at[axis])
                        })
                };
                let around: Vec<&Area> = areas.list.iter().filter(is_in).collect();
                match machine {
                    // A pixel is taken while its patch has a page.
                    Machine::Vc1 => assert!(around.iter().any(|it| write.clock < it.to), "{write:?}"),
                    // It has gone through a window of each level.
                    _ => assert!((0..=areas.levels).all(|level| around.iter().any(|it| it.level == level))),
                }
            }
        }
    }
}

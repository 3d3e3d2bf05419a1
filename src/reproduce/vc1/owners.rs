//! Figure 12: the processing element of each pixel, from the accesses that local frame buffers took.

use super::frames::background;
use super::observed::observed;
use super::plan::Plan;
use crate::pictures::owners;
use crate::reproduce::words::short;
use std::collections::BTreeSet;
use tilewright_machines::vc1::{Machine, Shown};
use tilewright_machines::{Error, Recorder, Watch};
use tilewright_report::{HeatMap, Origin, Picture, Rule, Section, Statement};
use tilewright_rtl::clocks::PE;
use tilewright_scenes::{Frame, Size};

const SCENE: &str = "table";
const PROCESSORS: u32 = 16;

/// A frame with the accesses of each local frame buffer.
pub struct Owners {
    frame: Frame,
    /// By pixel: the processing element of its word, as the machine reports it.
    owners: Vec<Option<u32>>,
    taken: Taken,
    /// The numbers of pixels that processing elements count.
    drawn: Vec<u64>,
}

/// The accesses, pixel by pixel.
struct Taken {
    size: Size,
    /// By pixel: the least word and its processing element.
    least: Vec<Option<(u64, u32)>>,
    /// By patch: the processing elements with a page for it.
    pages: Vec<BTreeSet<u32>>,
    /// By processing element: the number of pixels.
    count: Vec<u64>,
}

/// The signals of an access, in this sequence.
const SIGNALS: [&str; 5] = ["valid", "ready", "x", "y", "word"];

impl Taken {
    fn new(size: Size) -> Taken {
        Taken {
            size,
            least: vec![None; size.pixels()],
            pages: vec![BTreeSet::new(); size.pixels() / 16],
            count: vec![0; PROCESSORS as usize],
        }
    }

    /// The values of the signals before an edge of the processing elements' clock.
    fn edge(&mut self, values: &[u64]) {
        for (number, values) in (0..).zip(values.chunks(SIGNALS.len())) {
            let [valid, ready, x, y, word] = values else { unreachable!("they are {SIGNALS:?}") };
            if (*valid, *ready) == (1, 1) {
                let (x, y) = (*x as usize, *y as usize);
                let width = self.size.width() as usize;
                let least = &mut self.least[y * width + x];
                *least = Some(least.map_or((*word, number), |it| it.min((*word, number))));
                self.pages[y / 4 * (width / 4) + x / 4].insert(number);
                self.count[number as usize] += 1;
            }
        }
    }
}

impl Owners {
    /// Draws the frame.
    ///
    /// # Errors
    /// The simulator's; Ctrl-C.
    pub fn drawn(plan: &Plan, watch: &mut Watch) -> Result<Owners, Error> {
        let case = plan.case(SCENE, PROCESSORS);
        let view = case.view(plan, 0)?;
        let mut taken = Taken::new(view.size);
        let signals = (0..PROCESSORS).flat_map(|k| SIGNALS.map(|name| format!("processors_{k}_request_{name}")));
        let signals: Vec<String> = signals.collect();
        let seen = |time: u64, values: &[u64]| {
            if time.is_multiple_of(PE.period.picoseconds()) {
                taken.edge(values);
            }
        };
        let (mut views, mut frame) = (Some((*view).clone()), None);
        let shown = |shown: Shown| {
            frame = Some(shown.frame);
            true
        };
        let recorder = Recorder::default();
        let report = observed(Machine::new(case.config(plan))?.recorded(&recorder), &signals, seen, |machine| {
            machine.render_frames(background(&case), watch, || views.take(), shown)
        })?;
        let drawn = report.frames[0].processors.iter().map(|it| it.pixels).collect();
        let owners = recorder.take().map_or_else(Vec::new, |history| history.owners());
        Ok(Owners { frame: frame.expect("a view has a frame"), owners, taken, drawn })
    }

    /// The checks: pixels whose word is not the least that was taken, and processing elements whose pixels were not all taken.
    fn astray(&self) -> [u64; 2] {
        let taken = self.frame.words.iter().zip(&self.taken.least);
        let pixels = taken.filter(|(word, least)| least.is_some_and(|(least, _)| least != **word)).count();
        let processors = self.drawn.iter().zip(&self.taken.count).filter(|(drawn, taken)| drawn != taken).count();
        [pixels as u64, processors as u64]
    }

    pub fn checks(&self) -> [Statement; 2] {
        let zero = |fact: &str, text: &str, unit: &str, found: u64| {
            Statement::new(fact, text, Rule::Zero).unit(unit).found(Origin::rtl([]), [(SCENE, found as f64)])
        };
        let [pixels, processors] = self.astray();
        [
            zero(
                "VC1-MU",
                "The merger chose the least word that a local frame buffer took.",
                "pixels that differ",
                pixels,
            ),
            zero(
                "VC1-PE",
                "Local frame buffers took all pixels that were drawn.",
                "processing elements that differ",
                processors,
            ),
        ]
    }

    pub fn section(&self, section: Section) -> Section {
        let all = &self.taken.pages;
        let mean = all.iter().map(BTreeSet::len).sum::<usize>() as f64 / all.len() as f64;
        section
            .figure("All processing elements share a large polygon; each draws its own lines.", self.picture())
            .figure(
                format!("On the mean {} of {PROCESSORS} local frame buffers have a page for a patch.", short(mean)),
                self.pages(),
            )
    }

    /// A colour for each processing element, as light as the frame.
    fn picture(&self) -> Picture {
        let picture = owners::picture(&self.frame, &self.owners, None);
        let alt =
            format!("the scene {SCENE} in {PROCESSORS} colours: the top of the table in lines, each object in patches");
        Picture::new("figure-12", "Figure 12: the table in the colours of the processing elements", alt, picture.to_png()).note(
            "The colour is that of the processing element whose word the merger chose, observed as its local frame buffer took it.",
        )
    }

    /// Pages by place, as means over squares of patches if there are many.
    fn pages(&self) -> HeatMap {
        let (columns, rows) = (self.taken.size.width() as usize / 4, self.taken.size.height() as usize / 4);
        let side = columns.div_ceil(40);
        let cell = |row: usize, column: usize| {
            let patches =
                (row..(row + side).min(rows)).flat_map(|y| (column..(column + side).min(columns)).map(move |x| (x, y)));
            let counts: Vec<usize> = patches.map(|(x, y)| self.taken.pages[y * columns + x].len()).collect();
            counts.iter().sum::<usize>() as f64 / counts.len() as f64
        };
        let rows =
            (0..rows).step_by(side).map(|row| (0..columns).step_by(side).map(|column| cell(row, column)).collect());
        let title = format!(
            "Pages by place: how many of {PROCESSORS} local frame buffers have a page for a patch of the {SCENE}"
        );
        HeatMap::new("table-pages", title, "pages a patch", Origin::rtl([]), rows)
            .note(format!("Means over squares of {side}x{side} patches. With local frame buffers of the whole screen the number would be {PROCESSORS} everywhere."))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::effort::Effort;

    #[test]
    fn what_was_taken_is_the_frame_and_what_was_not_is_seen() {
        let plan = Plan::new(Effort { seed: 1, most: Some(1) });
        let mut owners = Owners::drawn(&plan, &mut Watch::default()).expect("it is drawn");
        let all = owners.taken.least.iter().flatten().count();
        assert!(all > 1000, "{all}");
        let who: BTreeSet<u32> = owners.taken.least.iter().flatten().map(|(_, number)| *number).collect();
        assert_eq!((owners.astray(), who.len()), ([0, 0], PROCESSORS as usize));
        let least: Vec<Option<u32>> = owners.taken.least.iter().map(|it| it.map(|(_, number)| number)).collect();
        assert_eq!(owners.owners, least, "what stands on the signals is what the machine tells");
        let at = owners.taken.least.iter().position(Option::is_some).expect("something is drawn");
        owners.frame.words[at] ^= 1;
        owners.taken.count[3] -= 1;
        assert!(owners.checks().iter().all(|check| check.verdict().to_string().starts_with("differs by 1")));
    }
}

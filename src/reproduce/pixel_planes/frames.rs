//! Frames that the hardware has drawn: pictures with the renderer of each region, and the load of each renderer.

use super::loads::Load;
use super::owners::owners;
use super::plan::{Plan, RENDERERS};
use super::scenes::Which;
use crate::reproduce::right;
use crate::reproduce::words::{percent, short};
use crate::shell::Failure;
use tilewright_machines::Watch;
use tilewright_machines::pixel_planes::{Machine, Regions, RendererReport, Report};
use tilewright_report::{HeatMap, Origin, Picture, Rule, Section, Statement, Table};
use tilewright_scenes::Frame;

/// A frame of the hardware.
pub struct Drawn {
    pub load: Load,
    pub report: Report,
    regions: Regions,
    frame: Frame,
    /// Pixels that differ from the golden image.
    differing: u64,
}

impl Drawn {
    /// Draws all frames.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Vec<Drawn>, Failure> {
        plan.frames().into_iter().map(|which| Drawn::of(which, plan, watch)).collect()
    }

    fn of(which: Which, plan: &Plan, watch: &mut Watch) -> Result<Drawn, Failure> {
        let (subject, regions) = (which.subject(plan)?, plan.regions());
        let load = Load::of(&subject, &regions);
        let (frame, report) = Machine::new(plan.config())?.render(&subject.scene, subject.background, watch)?;
        let differing = right::differing(&frame, &subject.scene, subject.background)?;
        Ok(Drawn { load, report, regions, frame, differing })
    }

    pub fn origin(&self) -> Origin {
        Origin::rtl(self.load.seeds.clone())
    }

    /// P_w over the mean load.
    pub fn imbalance(&self) -> f64 {
        self.report.worst_load() as f64 * self.report.renderers.len() as f64 / self.report.binned() as f64
    }

    /// Regions that were not drawn exactly once.
    fn astray(&self) -> u64 {
        let mut times = vec![0_u64; self.regions.count()];
        self.report.regions.iter().for_each(|it| times[it.region] += 1);
        times.into_iter().filter(|times| *times != 1).count() as u64
    }

    /// Regions whose number of primitives in the circuit differs from the count of their bin.
    fn miscounted(&self) -> u64 {
        let is_wrong =
            |it: &&tilewright_machines::pixel_planes::RegionReport| it.primitives != self.load.bins[it.region];
        self.report.regions.iter().filter(is_wrong).count() as u64
    }
}

/// The checks of the frames.
pub fn checks(frames: &[Drawn]) -> [Statement; 3] {
    let of = |of: fn(&Drawn) -> u64| frames.iter().map(move |it| (it.load.name.to_owned(), of(it)));
    let zero = |text: &str, unit: &str, wrong: fn(&Drawn) -> u64| {
        let found = of(wrong).map(|(name, wrong)| (name, wrong as f64));
        Statement::new("PP5-ARCH", text, Rule::Zero).unit(unit).found(Origin::rtl([]), found)
    };
    [
        right::statement("PP5-ARCH", of(|it| it.differing)),
        zero("Each region is drawn once, by one renderer.", "regions that differ", Drawn::astray),
        zero(
            "Renderers get the number of primitives of each region that the plain count finds.",
            "regions that differ",
            Drawn::miscounted,
        ),
    ]
}

/// The section of the frames.
pub fn section(frames: &[Drawn]) -> Section {
    let first = frames.first().map(|it| it.report.machine.clone());
    let machine = first.map_or(String::new(), |it| {
        format!(
            "{} renderers with regions of {side}x{side} pixels, on a screen of {}x{}",
            it.renderers,
            it.width,
            it.height,
            side = it.side
        )
    });
    let section = Section::new("Frames").paragraph(format!(
        "The circuit drew these scenes, clock by clock: {machine}. The tint and the number of each region show the renderer that drew it. The machine itself counts the \
             clocks."
    ));
    frames
        .iter()
        .enumerate()
        .fold(section, |section, (number, drawn)| {
            let name = drawn.load.name;
            let primitives = drawn.report.primitives;
            let ms = short(milliseconds(drawn.report.drawn));
            let section = match number {
                0 => section.figure(format!("{primitives} primitives are drawn in {ms} ms."), picture(drawn)),
                _ => section,
            };
            let worst = match drawn.imbalance() {
                1.0 => format!("{name}: all renderers have the same load."),
                worst => format!("{name}: the busiest renderer has {} times the mean load.", short(worst)),
            };
            let all = || drawn.report.renderers.iter().map(|it| it.working() as f64 / drawn.report.drawn.max(1) as f64);
            let [least, most] = [all().fold(1.0, f64::min), all().fold(0.0, f64::max)].map(percent);
            section
                .figure(worst, regions(drawn))
                .figure(format!("{name}: renderers work in {least} to {most} of the clocks."), load(drawn))
        })
        .part(table(frames))
}

/// The frame alone.
fn picture(drawn: &Drawn) -> Picture {
    let Drawn { load: Load { name, .. }, frame, .. } = drawn;
    let alt = format!("the scene {name}, {} pixels", frame.size());
    Picture::new(format!("{name}-frame"), format!("{name}, as the circuit drew it"), alt, frame.to_png())
        .note(right::in_words(drawn.differing))
}

/// The frame with its regions.
fn regions(drawn: &Drawn) -> Picture {
    let Drawn { load: Load { name, .. }, report, regions, frame, .. } = drawn;
    let alt =
        format!("the scene {name}, with {} regions in the colours of {} renderers", report.regions.len(), RENDERERS);
    let title = format!("{name}: the renderer of each region");
    Picture::new(format!("{name}-regions"), title, alt, owners(frame, regions, report).to_png()).note(format!(
        "{} {} primitives, {} in all bins. The last one is drawn after {} clocks, {:.3} ms.",
        right::in_words(drawn.differing),
        report.primitives,
        report.binned(),
        report.drawn,
        milliseconds(report.drawn)
    ))
}

fn milliseconds(clocks: u64) -> f64 {
    clocks as f64 * tilewright_machines::pixel_planes::PERIOD / 1e6
}

/// Renderers in a row of the heat map.
const ROW: usize = 8;

/// The load of each renderer.
fn load(drawn: &Drawn) -> HeatMap {
    let Drawn { load: Load { name, .. }, report, .. } = drawn;
    let working = |it: &RendererReport| 100.0 * it.working() as f64 / report.drawn.max(1) as f64;
    let rows = report.renderers.chunks(ROW).map(|row| row.iter().map(|it| working(it).round()).collect());
    let title = format!("{name}: load of each renderer");
    HeatMap::new(format!("{name}-load"), title, "% of the clocks", drawn.origin(), rows).note(format!(
        "Clocks in which a renderer waits neither for an instruction nor for a region to be sent. Renderers 0 to {} stand above the others. The busiest renderer has {} \
         primitives; the mean is {:.0}.",
        ROW - 1,
        report.worst_load(),
        report.binned() as f64 / report.renderers.len() as f64
    ))
}

fn table(frames: &[Drawn]) -> Table {
    let columns = [
        "scene",
        "primitives",
        "in bins",
        "P_w",
        "P_w over the mean",
        "clocks a primitive",
        "balance of clocks, %",
        "drawn after, ms",
        "sent after, ms",
    ];
    let table = Table::new("frames", "What the frames took", columns)
        .note("Clocks a primitive are those of all renderers; they include the clocks that a region takes without primitives.");
    frames.iter().fold(table, |table, drawn| {
        let report = &drawn.report;
        let numbers = [
            report.primitives as f64,
            report.binned() as f64,
            report.worst_load() as f64,
            drawn.imbalance(),
            report.clocks_per_primitive(),
            100.0 * report.balance(),
            milliseconds(report.drawn),
            milliseconds(report.sent),
        ];
        table.row([drawn.load.name.into()].into_iter().chain(numbers.map(Into::into)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::effort::Effort;

    /// The checks accept a frame, and refuse it against another one.
    #[test]
    fn wrong_frames_and_regions_are_found() {
        let plan = Plan { effort: Effort { seed: 1, most: Some(40) } };
        let drawn = || Drawn::of(Which::Vectors(40), &plan, &mut Watch::default()).expect("it can be drawn");
        let verdicts = |drawn: Drawn| checks(&[drawn]).map(|check| check.verdict().to_string());
        assert_eq!(verdicts(drawn()), ["holds", "holds", "holds"]);
        let mut twice = drawn();
        twice.differing = 3;
        twice.report.regions[1] = twice.report.regions[0];
        twice.report.regions[2].primitives += 1;
        let verdicts = verdicts(twice);
        assert_eq!(
            verdicts,
            ["differs by 3 from 0 (vectors)", "differs by 2 from 0 (vectors)", "differs by 1 from 0 (vectors)"]
        );
    }
}

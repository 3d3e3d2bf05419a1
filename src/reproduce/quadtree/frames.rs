//! Frames that the hardware has drawn: pictures, the processor of each pixel, and the load.

use super::plan::config;
use crate::pictures::owners;
use crate::reproduce::effort::Effort;
use crate::reproduce::right;
use crate::reproduce::words::{percent, short};
use crate::scene::polygons;
use crate::shell::Failure;
use tilewright_machines::Watch;
use tilewright_machines::quadtree::{Machine, ProcessorReport, Report, Search, UnitReport};
use tilewright_report::{HeatMap, Origin, Picture, Rule, Section, Statement};
use tilewright_scenes::{Frame, Polygons, Scene, Size};

/// A frame of the hardware.
pub struct Drawn {
    scene: &'static str,
    frame: Frame,
    report: Report,
    background: [u8; 3],
    /// Pixels that differ from the golden image.
    differing: u64,
    /// Video processors whose number of drawn pixels differs from that of the polygons in their raster.
    strayed: u64,
}

/// Draws all frames.
pub fn drawn(effort: Effort, watch: &mut Watch) -> Result<Vec<Drawn>, Failure> {
    effort.frames().iter().map(|&(scene, side)| draw(scene, side, effort.frame_size(), watch)).collect()
}

fn draw(name: &'static str, side: u32, size: Size, watch: &mut Watch) -> Result<Drawn, Failure> {
    let scene = Scene::builtin(name).expect("a built-in scene");
    let scene = Scene { size, ..scene };
    let polygons = polygons(&scene)?;
    let config = config(&polygons, side);
    let search = Search::new(config.windows().map_err(tilewright_machines::Error::from)?);
    let search = search.map_err(tilewright_machines::Error::from)?;
    let (frame, report) = Machine::new(config)?.render(&polygons.polygons, scene.background, watch)?;
    Ok(Drawn {
        scene: name,
        differing: right::differing(&frame, &polygons, scene.background)?,
        strayed: strayed(&report, &search, &polygons),
        background: scene.background,
        frame,
        report,
    })
}

fn strayed(report: &Report, search: &Search, polygons: &Polygons) -> u64 {
    let counted = |place| polygons.polygons.iter().map(|polygon| search.windows(polygon, place).fragments).sum::<u64>();
    let wrong = search.processors().zip(&report.processors).filter(|(place, it)| it.fragments != counted(*place));
    wrong.count() as u64
}

impl Drawn {
    fn place(&self) -> String {
        format!("{}, {}x{} processors", self.scene, self.report.machine.p, self.report.machine.q)
    }

    /// Its name in files.
    fn id(&self, kind: &str) -> String {
        format!("{}-{}-{kind}", self.scene, self.report.machine.p)
    }
}

/// The checks of the frames.
pub fn checks(frames: &[Drawn]) -> [Statement; 2] {
    [
        right::statement("MPG-ARCH", frames.iter().map(|it| (it.place(), it.differing))),
        Statement::new(
            "MPG-SPR",
            "Each video processor draws the number of pixels that the polygons have on its every p-th column and q-th row.",
            Rule::Zero,
        )
        .unit("processors that differ")
        .found(Origin::rtl([]), frames.iter().map(|it| (it.place(), it.strayed as f64))),
    ]
}

/// The section of the frames.
pub fn section(frames: &[Drawn]) -> Section {
    let section = Section::new("Frames").paragraph(
        "The hardware drew these scenes, clock by clock. The processors have pipelines whose tests have an adder for each edge. The hardware itself counts the clocks.",
    );
    frames.iter().enumerate().fold(section, |section, (number, drawn)| {
        let section = section.figure(speed(drawn), picture(drawn));
        // 256 processors are too many for a picture of pattern and levels.
        match number {
            0 => section
                .figure("Neighbouring pixels belong to different video processors.", who(drawn))
                .figure(balance(drawn), busy(drawn))
                .figure(busiest(drawn, "works", |it| it.busy), stages(drawn, "busy", |it| it.busy))
                .figure(busiest(drawn, "is stalled", |it| it.stalled), stages(drawn, "stalled", |it| it.stalled)),
            _ => section.figure(balance(drawn), busy(drawn)),
        }
    })
}

/// The clocks of the frame.
fn speed(Drawn { report, .. }: &Drawn) -> String {
    let clocks = short(report.drawing_clocks() as f64);
    let (polygons, each) = (report.packets, short(report.clocks_per_packet()));
    format!("{polygons} polygons take {clocks} clocks, {each} for each.")
}

/// The busiest video processor, beside the mean.
fn balance(drawn: &Drawn) -> String {
    let all: Vec<u64> = drawn.report.processors.iter().map(clocks).collect();
    let most = all.iter().max().copied().unwrap_or_default() as f64 * all.len() as f64;
    let more = most / (all.iter().sum::<u64>().max(1) as f64) - 1.0;
    format!("The busiest of {} video processors works {} longer than the mean.", all.len(), percent(more))
}

/// The stage of which a number is greatest, over all video processors.
fn busiest(drawn: &Drawn, does: &str, of: fn(&UnitReport) -> u64) -> String {
    let sum = |level: &usize| drawn.report.processors.iter().map(|it| of(&it.units[*level])).sum::<u64>();
    match (0..=drawn.report.machine.levels as usize).rev().max_by_key(sum) {
        Some(level @ 1..) => format!("Level {level} {does} longest of all stages."),
        _ => format!("The set-up {does} longest of all stages."),
    }
}

/// Clocks in which the levels of a video processor work.
fn clocks(it: &ProcessorReport) -> u64 {
    it.units.iter().skip(1).map(|unit| unit.busy).sum()
}

fn picture(drawn: &Drawn) -> Picture {
    let Drawn { scene, report, differing, .. } = drawn;
    let verdict = right::in_words(*differing);
    let title = format!("{scene}, drawn by {}x{} processors", report.machine.p, report.machine.q);
    let alt = format!("the scene {scene}, {} pixels", drawn.frame.size());
    Picture::new(drawn.id("frame"), title, alt, drawn.frame.to_png())
        .note(format!("{verdict} The load of the processors is balanced to {:.1} %.", 100.0 * report.balance()))
}

/// The size of the part of a frame that shows the processor of each pixel.
const PART: (u32, u32) = (40, 30);

/// The part of the frame around its first pixel: a colour for each video processor.
fn who(drawn: &Drawn) -> Picture {
    let (size, (p, q)) = (drawn.frame.size(), (drawn.report.machine.p, drawn.report.machine.q));
    let (width, height) = (PART.0.min(size.width()), PART.1.min(size.height()));
    let nothing = tilewright_scenes::frame::blank(drawn.background);
    let first = drawn.frame.words.iter().position(|word| *word != nothing).unwrap_or(0) as u32;
    let (x, y) = (first % size.width(), first / size.width());
    let left = x.saturating_sub(width / 2).min(size.width() - width);
    let top = y.saturating_sub(height / 6).min(size.height() - height);
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (left + x, top + y)));
    let owner = |(x, y): (u32, u32)| (drawn.frame.word(x, y) != nothing).then_some(x % p + p * (y % q));
    let words = places.clone().map(|(x, y)| drawn.frame.word(x, y)).collect();
    let part = Frame::from_words(Size::new(width, height).expect("in range"), words).expect("a word for each pixel");
    let part = owners::picture(&part, &places.map(owner).collect::<Vec<_>>(), None);
    let title = format!("The video processor of each pixel: the top of {}", drawn.scene);
    let alt = format!("a pattern of {p} x {q} colours where there are polygons");
    Picture::new(drawn.id("owners"), title, alt, part.to_png()).note(format!(
        "Each of the {p}x{q} video processors has a colour; dark pixels have no polygon. The video controller reads each pixel from the buffer of the processor that drew it, so the place determines \
             the processor. The checks below show that each processor drew the right number of pixels."
    ))
}

/// Busy clocks of each video processor, arranged as in the matrix.
fn busy(drawn: &Drawn) -> HeatMap {
    let rows = drawn.report.processors.chunks(drawn.report.machine.p as usize);
    let rows = rows.map(|row| row.iter().map(|it| clocks(it) as f64).collect());
    let title = format!("Busy clocks of each video processor: {}", drawn.place());
    HeatMap::new(drawn.id("load"), title, "clocks", Origin::rtl([]), rows)
        .note("The sum over all levels, with the processors arranged as in the matrix.")
}

/// A number for each stage and each video processor.
fn stages(drawn: &Drawn, what: &str, of: fn(&UnitReport) -> u64) -> HeatMap {
    let levels = drawn.report.machine.levels as usize;
    let row = |level: usize| drawn.report.processors.iter().map(|it| of(&it.units[level]) as f64).collect();
    let title = format!("{} clocks of each stage: {}", if what == "busy" { "Busy" } else { "Stalled" }, drawn.place());
    HeatMap::new(drawn.id(what), title, "clocks", Origin::rtl([]), (0..=levels).map(row)).note(
        "From top to bottom: the set-up and the levels, from the first to the last. From left to right: the video processors, row by row of the \
         matrix.",
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_scenes::project_polygons;

    /// The checks accept a frame, and refuse it against another one.
    #[test]
    fn wrong_frames_and_stray_pixels_are_found() -> Result<(), Box<dyn std::error::Error>> {
        let scene = Scene { size: Size::new(16, 12)?, ..Scene::builtin("teapot").ok_or("a built-in scene")? };
        let polygons = project_polygons(&scene, scene.size)?;
        let config = config(&polygons, 2);
        let search = Search::new(config.windows()?)?;
        let mut machine = Machine::new(config)?;
        let (_, mut report) = machine.render(&polygons.polygons, scene.background, &mut Watch::default())?;
        assert_eq!(strayed(&report, &search, &polygons), 0);
        report.processors[1].fragments += 1;
        assert_eq!(strayed(&report, &search, &polygons), 1);

        let drawn = |differing, strayed| Drawn {
            scene: "teapot",
            frame: Frame::blank(scene.size, scene.background),
            report: report.clone(),
            background: scene.background,
            differing,
            strayed,
        };
        let verdicts = |drawn: Drawn| checks(&[drawn]).map(|check| check.verdict().to_string());
        assert_eq!(verdicts(drawn(0, 0)), ["holds", "holds"]);
        assert!(verdicts(drawn(3, 1)).iter().all(|verdict| verdict.starts_with("differs")));
        Ok(())
    }
}

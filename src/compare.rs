//! `tilewright compare`: one scene on all machines, and a table of clocks, state and load.

use crate::engine::EngineArguments;
use crate::golden;
use crate::machine::{ENTRANTS, Entrant, Figures, Machine, Run};
use crate::names;
use crate::pictures::{Paint, Painted, all_on_a_sheet, animation, check_film, sheet};
use crate::scene::{SceneArguments, triangles};
use crate::shell::output::{Output, write_all};
use crate::shell::place::{beside, check_distinct};
use crate::shell::text::legible;
use crate::shell::{Exit, Failure, progress, terminal};
use crate::trace::TraceOptions;
use crate::verdict::{DIFFERENCE, Golden, Verdict, leave_difference};
use clap::Args;
use serde::Serialize;
use std::fmt;
use std::path::{Path, PathBuf};
use tilewright_machines::{History, Recorder};
use tilewright_scenes::golden::render_watched;
use tilewright_scenes::{Frame, Projection, Scene, Size};

/// Renders a scene on all machines, compares the frames, and prints a table of the machines
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright compare star --size 64x48
  tilewright compare teapot --size 160x120 --machine vc1 --machine quadtree -o frame.png
  tilewright compare star --size 64x48 --json
  tilewright compare star --size 64x48 --owners owners.png --animate frame.png

Each machine is built as `render` builds it without options, but a VC-1 gets as many pages as the scene needs. `render` has options for each machine, and prints its whole report.

The clocks are those of a frame; the lines below the table say what they include. \"Tested\" counts the pixels that processors test for some polygon,
\"drawn\" those that the polygon covers. A pixel counts once for each such polygon. \"At work\" is the mean share of the time in which the processors work;
for a pipe, that of its busiest part. \"Limited by\" names what takes longest, with its share of the frame's time.
Faces are cut into triangles for all machines, because not all of them draw polygons.

--owners and --animate show the machines side by side, each as `render` shows it. In an animation each machine takes its own time, from its first pixel to its last.

Exit code 1 means that a frame differs from the golden image. The picture of -o is the frame of the first machine, or of the first that differs.
A picture of the differences is then written beside it, as by `render`.")]
pub struct Compare {
    #[command(flatten)]
    scene: SceneArguments,
    /// Render on this machine only; may be repeated [default: all machines]
    #[arg(long = "machine", value_name = "MACHINE", value_parser = names::of::<Machine>("machine"))]
    machines: Vec<Machine>,
    /// The frame, a PNG file; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// A PNG file (`-`: standard output) that shows which unit drew each pixel on each machine
    #[arg(long, value_name = "FILE")]
    owners: Option<PathBuf>,
    /// An animated PNG file (`-`: standard output) of the frame being drawn on each machine, in the colours of its units
    #[arg(long, value_name = "FILE")]
    animate: Option<PathBuf>,
    #[command(flatten)]
    engine: EngineArguments,
    /// Print the table as JSON
    #[arg(long)]
    json: bool,
}

/// The result for a scene.
#[derive(Serialize)]
pub struct Comparison {
    format: u32,
    scene: String,
    /// Columns and rows of pixels.
    size: [u32; 2],
    polygons: u32,
    /// Whether all frames are the golden image.
    identical: bool,
    machines: Vec<Row>,
    /// The first frame, or the first that differs.
    #[serde(skip)]
    frame: Option<Frame>,
    /// What each machine did, if that is recorded, and its frame.
    #[serde(skip)]
    histories: Vec<(&'static str, History, Frame)>,
}

/// A machine's line of the table.
#[derive(Serialize)]
struct Row {
    machine: &'static str,
    #[serde(flatten)]
    figures: Figures,
    megahertz: f64,
    milliseconds: f64,
    golden: Verdict,
}

impl Compare {
    /// Renders, compares, writes the frame and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        let scene = self.scene.load()?;
        self.check_distinct(&scene.files)?;
        check_film(self.animate.as_deref())?;
        let at = |path: &Option<PathBuf>| path.as_deref().map(Output::at).transpose();
        let [output, owners, animate] = [at(&self.output)?, at(&self.owners)?, at(&self.animate)?];
        let is_asked = |it: &Entrant| self.machines.is_empty() || self.machines.contains(&it.machine);
        let entrants: Vec<Entrant> = ENTRANTS.into_iter().filter(is_asked).collect();
        let recorder = (owners.is_some() || animate.is_some()).then(Recorder::default);
        if recorder.is_some() {
            check_room(scene.size, entrants.len())?;
        }
        let (filters, recorder) = (&TraceOptions::default(), recorder.as_ref());
        let run = Run { recorder, ..Run::new(self.engine, filters) };
        let comparison = Comparison::of(&scene, &entrants, &run)?;

        let painted = comparison.painted();
        let frame = output.zip(comparison.frame.as_ref()).map(|(output, frame)| (output, frame.to_png()));
        let owners = owners.map(|output| (output, all_on_a_sheet(&painted).to_png()));
        let animate = animate.map(|output| (output, animation(&painted)));
        write_all([frame, owners, animate].into_iter().flatten())?;
        if let Some(path) = &self.output {
            leave_difference(path, comparison.differing().and_then(|row| row.golden.picture.as_ref()));
        }
        match (self.json, comparison.identical) {
            (true, _) => terminal::print_json(&comparison)?,
            (false, true) => terminal::report(&comparison.to_string())?,
            // A failure is reported in any case.
            (false, false) => terminal::print(&legible(&comparison.to_string()))?,
        }
        Ok(comparison.exit())
    }

    /// Checks that no file is written twice, or both read and written.
    fn check_distinct(&self, scene: &[PathBuf]) -> Result<(), Failure> {
        let difference = self.output.as_ref().and_then(|path| beside(path, DIFFERENCE));
        let written = self.output.iter().chain(&difference).chain(&self.owners).chain(&self.animate);
        let written: Vec<&Path> = written.map(PathBuf::as_path).collect();
        check_distinct(&written, &scene.iter().map(PathBuf::as_path).collect::<Vec<_>>())
    }
}

impl Comparison {
    /// Renders a scene on those machines, one after another.
    ///
    /// # Errors
    /// The scene cannot be set up, or a machine cannot draw it; Ctrl-C.
    pub fn of(scene: &Scene, entrants: &[Entrant], run: &Run) -> Result<Comparison, Failure> {
        let scene = &in_triangles(scene)?;
        let Projection { size, triangles, counts, .. } = triangles(scene)?;
        let image = golden::draw(|watch| render_watched(size, &triangles, scene.background, watch))?;
        let golden = Golden::Rendered(image);
        let mut comparison = Comparison {
            format: 1,
            scene: scene.name.clone(),
            size: [size.width(), size.height()],
            polygons: counts.polygons,
            identical: true,
            machines: Vec::new(),
            frame: None,
            histories: Vec::new(),
        };
        for Entrant { machine, draw } in entrants {
            progress::phase("building");
            let drawn = draw(scene, run);
            let (frame, figures) = drawn.map_err(|failure| failure.of(machine.name()))?;
            let verdict = golden.judge(&frame);
            if let Some(history) = run.recorder.and_then(Recorder::take) {
                comparison.histories.push((machine.name(), history, frame.clone()));
            }
            if comparison.frame.is_none() || comparison.identical && !verdict.identical {
                comparison.frame = Some(frame);
            }
            comparison.identical &= verdict.identical;
            let (megahertz, milliseconds) = (figures.megahertz(), figures.milliseconds());
            let machine = machine.name();
            comparison.machines.push(Row { machine, figures, megahertz, milliseconds, golden: verdict });
        }
        Ok(comparison)
    }

    /// What each machine painted, if that was recorded.
    fn painted<'a>(&'a self) -> Vec<Painted<'a>> {
        let painted = |(name, history, frame): &'a (&str, History, Frame)| Painted {
            history,
            frame,
            paint: Paint::Owners,
            label: Some(name),
        };
        self.histories.iter().map(painted).collect()
    }

    /// The first machine whose frame is not the golden image.
    fn differing(&self) -> Option<&Row> {
        self.machines.iter().find(|row| !row.golden.identical)
    }

    /// The scene's name.
    pub fn scene(&self) -> &str {
        &self.scene
    }

    /// The frame that all machines drew, or the first that differs.
    pub fn frame(&self) -> Option<&Frame> {
        self.frame.as_ref()
    }

    /// By machine: its name, the pixels of its frame that differ from the golden image, and its figures.
    pub fn machines(&self) -> impl Iterator<Item = (&'static str, u64, &Figures)> {
        self.machines.iter().map(|row| (row.machine, row.golden.differing(), &row.figures))
    }

    fn exit(&self) -> Exit {
        if self.identical { Exit::Done } else { Exit::CheckFailed }
    }

    fn write_table(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let rows = self.machines.iter().map(Row::cells);
        let rows: Vec<[String; COLUMNS.len()]> = std::iter::once(COLUMNS.map(str::to_owned)).chain(rows).collect();
        let widths: [usize; COLUMNS.len()] =
            std::array::from_fn(|column| rows.iter().map(|row| row[column].len()).max().unwrap_or(0));
        for row in &rows {
            let cells = row.iter().zip(widths).enumerate().map(|(column, (cell, wide))| match IS_TEXT[column] {
                true => format!("{cell:wide$}"),
                false => format!("{cell:>wide$}"),
            });
            writeln!(f, "{}", cells.collect::<Vec<_>>().join("  ").trim_end())?;
        }
        Ok(())
    }
}

/// Checks that the pictures of all machines fit on a sheet.
fn check_room(size: Size, machines: usize) -> Result<(), Failure> {
    if sheet(size, machines).is_some() {
        return Ok(());
    }
    let sentence = format!(
        "{machines} pictures of {size} pixels are too large for one: pass a smaller --size, such as 640x480, or fewer machines"
    );
    Err(Failure::new(Exit::BadInput, sentence))
}

/// The scene with each triangle as a face. A machine that draws polygons takes a larger face as one polygon if its corners are within a unit of depth of
/// a plane. Its depths may then differ by a unit from those of its triangles, which are all that other machines draw.
fn in_triangles(scene: &Scene) -> Result<Scene, Failure> {
    let mesh = scene.mesh.clone();
    let singles = vec![1; mesh.triangles().len()];
    Ok(Scene { mesh: mesh.with_faces(singles)?, ..scene.clone() })
}

/// The columns of the table, and which of them contain words.
const COLUMNS: [&str; 11] = [
    "machine",
    "processors",
    "registers",
    "memories",
    "clocks",
    "MHz",
    "ms",
    "tested",
    "drawn",
    "at work",
    "limited by",
];
const IS_TEXT: [bool; COLUMNS.len()] = [true, true, false, false, false, false, false, false, false, false, true];

impl Row {
    fn cells(&self) -> [String; COLUMNS.len()] {
        let it = &self.figures;
        [
            self.machine.to_owned(),
            format!("{} {}", it.processors, it.processor),
            it.register_bits.to_string(),
            it.memory_bits.to_string(),
            it.clocks.to_string(),
            format!("{:.0}", self.megahertz),
            format!("{:.3}", self.milliseconds),
            it.tested.to_string(),
            it.drawn.to_string(),
            format!("{:.1} %", 100.0 * it.at_work),
            format!("{}, {:.0} %", it.limit, 100.0 * it.limit_share),
        ]
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Comparison { scene, size: [width, height], polygons, machines, .. } = self;
        writeln!(f, "{scene}: {width}x{height} pixels, {polygons} polygons\n")?;
        self.write_table(f)?;
        writeln!(
            f,
            "\nRegisters and memories are in bits; tested and drawn are pixels. The clocks of a frame are, of"
        )?;
        for Row { machine, figures, .. } in machines {
            writeln!(f, "  {machine}: {}", figures.time)?;
        }
        writeln!(f)?;
        if self.identical {
            return match machines.len() {
                1 => writeln!(f, "identical to the golden image"),
                count => writeln!(f, "all {count} frames are identical to the golden image"),
            };
        }
        machines.iter().try_for_each(|Row { machine, golden, .. }| writeln!(f, "{machine}: {golden}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn star_on(entrants: &[Entrant]) -> Comparison {
        let scene = Scene { size: Size::new(32, 24).unwrap(), ..Scene::builtin("star").unwrap() };
        let (engine, filters) = (EngineArguments::default(), TraceOptions::default());
        Comparison::of(&scene, entrants, &Run::new(engine, &filters)).unwrap()
    }

    #[test]
    fn a_frame_that_differs_is_told_with_its_machine_and_exit_code_1() {
        let broken = Entrant {
            draw: |scene, run| {
                let (mut frame, figures) = (ENTRANTS[1].draw)(scene, run)?;
                let pixel = frame.index(3, 2);
                frame.words[pixel] ^= 1 << 30;
                Ok((frame, figures))
            },
            ..ENTRANTS[1]
        };
        let right = star_on(&ENTRANTS);
        assert_eq!((right.identical, right.exit()), (true, Exit::Done));
        assert!(right.to_string().ends_with("\nall 4 frames are identical to the golden image\n"), "{right}");

        let wrong = star_on(&[ENTRANTS[0], broken, ENTRANTS[2]]);
        assert_eq!((wrong.identical, wrong.exit()), (false, Exit::CheckFailed));
        let (text, row) = (wrong.to_string(), wrong.differing().expect("one differs"));
        assert!(
            text.contains(
                "\nvc1: identical to the golden image\nquadtree: NOT identical to the golden image: 1 of 768"
            ),
            "{text}"
        );
        assert!(text.contains("the first is (3, 2)"), "{text}");
        assert_eq!(row.machine, "quadtree");
        // The frame is that of the machine that differs.
        let [kept, golden] = [&wrong, &right].map(|it| it.frame.as_ref().expect("there is one").words.clone());
        assert_eq!(kept.iter().zip(golden).filter(|(kept, golden)| *kept != golden).count(), 1);
    }

    #[test]
    fn each_machine_draws_the_same_pixels() {
        let all = star_on(&ENTRANTS);
        let first = all.machines[0].figures.drawn;
        assert!(first > 0);
        for Row { machine, figures, .. } in &all.machines {
            assert_eq!(figures.drawn, first, "{machine}");
            assert!(figures.tested >= first, "{machine}");
            assert!(figures.at_work > 0.0 && figures.at_work <= 1.0, "{machine}: {figures:?}");
            assert!(figures.limit_share > 0.0 && figures.limit_share <= 1.0, "{machine}: {figures:?}");
        }
    }
}

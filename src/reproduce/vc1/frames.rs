//! Frames that the circuit has drawn: pictures, times and checks.

use super::beside::Beside;
use super::plan::{Capacity, Case, Plan, THRESHOLD};
use super::run::CLOCK;
use crate::golden;
use crate::reproduce::right;
use crate::reproduce::words::short;
use crate::shell::Failure;
use tilewright_machines::Watch;
use tilewright_machines::vc1::{FrameReport, Machine, ProcessorReport, Report, Shown};
use tilewright_report::{Cell, HeatMap, Origin, Picture, Rule, Section, Statement, Table};
use tilewright_rtl::gfb::Blanking;
use tilewright_scenes::golden::render_watched;
use tilewright_scenes::{Frame, Scene, compare};

/// A still view to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    pub name: String,
    pub case: Case,
    frames: usize,
}

/// The drawn frames.
pub struct Drawn {
    pub spec: Spec,
    pub report: Report,
    /// The last one.
    frame: Frame,
    /// Pixels of all frames that differ from the golden image.
    differing: u64,
    /// The factor by which everything is faster than on the paper's screen.
    hurry: f64,
    beside: Beside,
}

/// All that the circuit draws.
pub fn specs(plan: &Plan) -> Vec<Spec> {
    let scenes =
        plan.scenes().iter().map(|scene| Spec { name: (*scene).to_owned(), case: plan.case(scene, 16), frames: 2 });
    let table = [Some(THRESHOLD), None].map(|apr| Spec {
        name: format!("table, 1/8, threshold {}", super::statements::named(apr)),
        case: plan.at_threshold(Capacity::Part(8), Blanking::AtStart, apr),
        frames: 4,
    });
    let larger = (!plan.is_quick()).then(|| Spec {
        name: "ter1k, n = 256".to_owned(),
        case: plan.case("ter1k", 256),
        frames: 2,
    });
    let slower = Spec { name: "teapot, 59.94 Hz".to_owned(), case: Plan::slower(plan.case("teapot", 16)), frames: 2 };
    scenes.chain(table).chain(larger).chain([slower]).collect()
}

impl Drawn {
    /// Draws all; `None` if interrupted.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Option<Vec<Drawn>>, Failure> {
        let (specs, cancel) = (specs(plan), watch.cancel);
        let draw = |spec: &Spec| Drawn::of(spec, plan, &mut Watch { progress: None, cancel });
        let Some(drawn) = watch.each("drawing", &specs, draw) else { return Ok(None) };
        Ok(Some(drawn.into_iter().collect::<Result<_, _>>()?))
    }

    fn of(spec: &Spec, plan: &Plan, watch: &mut Watch) -> Result<Drawn, Failure> {
        let view = spec.case.view(plan, 0)?;
        let background = background(&spec.case);
        let golden = golden::draw(|watch| render_watched(view.size, &view.triangles, background, watch))?;
        let (mut left, mut differing, mut frame) = (spec.frames, 0, None);
        let next = || {
            let is_more = left > 0;
            left = left.saturating_sub(1);
            is_more.then(|| (*view).clone())
        };
        let seen = |shown: Shown| {
            differing += compare(&shown.frame, &golden).differing;
            frame = Some(shown.frame);
            true
        };
        let report = Machine::new(spec.case.config(plan))?.render_frames(background, watch, next, seen)?;
        let beside = Beside::of(&spec.case.config(plan), &view, &report)?;
        Ok(Drawn {
            spec: spec.clone(),
            report,
            frame: frame.expect("a view has a frame"),
            differing,
            hurry: plan.hurry(spec.case.processors),
            beside,
        })
    }

    /// Clearing and drawing of the busiest processing element in the last frame, in ms: D.
    pub fn drawing(&self) -> f64 {
        let last = self.report.frames.last().expect("there are frames");
        last.processors.iter().map(|it| it.clocks.busy()).max().unwrap_or_default() as f64 * CLOCK * self.hurry
    }

    /// Words that a processing element did not receive as they were sent.
    fn astray(&self) -> u64 {
        let sent: u64 = self.report.frames.iter().map(|frame| frame.words).sum();
        let receive = self.spec.case.costs.receive;
        let received = |number: usize| -> u64 {
            self.report.frames.iter().map(|frame| frame.processors[number].clocks.receiving / receive).sum()
        };
        (0..self.report.machine.processors as usize).map(|number| received(number).abs_diff(sent)).sum()
    }

    /// Frames without a refresh that was compared with the frame buffer.
    fn unseen(&self) -> u64 {
        (self.report.frames.len() as u64).saturating_sub(self.report.judged)
    }
}

pub fn background(case: &Case) -> [u8; 3] {
    Scene::builtin(case.scene).expect("a built-in scene").background
}

/// The checks that frames are right, and that nothing is lost on the way.
pub fn checks(frames: &[Drawn]) -> Vec<Statement> {
    let zero = |fact: &str, text: &str, unit: &str, of: fn(&Drawn) -> u64| {
        let found = frames.iter().map(|it| (it.spec.name.clone(), of(it) as f64));
        Statement::new(fact, text, Rule::Zero).unit(unit).found(Origin::rtl([]), found)
    };
    vec![
        zero(
            "E1",
            "Circuit and model agree in every number of a frame. The first different event would end the command.",
            "frames that differ",
            |it| it.beside.differing,
        ),
        zero(
            "E1",
            "The clocks of all classes add up to those between the swaps of a processing element.",
            "sums that differ",
            |it| it.beside.unaccounted,
        ),
        right::statement("VC1-GFB", frames.iter().map(|it| (it.spec.name.clone(), it.differing))),
        zero(
            "VC1-GFB",
            "Each frame is also compared in the first refresh that shows it. A different colour would end the command.",
            "frames that are not compared",
            Drawn::unseen,
        ),
        zero("VC1-NET", "Each processing element receives each word that the bus carries.", "words", Drawn::astray),
    ]
}

/// The frames of Figure 13, and the times of all frames.
pub fn section(section: Section, frames: &[Drawn]) -> Section {
    let pictures = frames.iter().filter(|it| it.spec.name == it.spec.case.scene);
    let section = pictures.fold(section, |section, drawn| section.figure(took(drawn), picture(drawn)));
    let overflowing = frames.iter().filter(|it| it.report.frames.iter().any(|frame| frame.overflows() > 0));
    overflowing.fold(section, |section, drawn| section.figure(overflowed(drawn), overflows(drawn))).part(table(frames))
}

/// The drawing time of the scene.
fn took(drawn: &Drawn) -> String {
    let polygons = drawn.report.polygons;
    format!("{polygons} polygons keep the busiest processing element busy for {} ms.", short(drawn.drawing()))
}

fn overflowed(drawn: &Drawn) -> String {
    let frames = &drawn.report.frames;
    let overflows: u64 = frames.iter().map(|frame| frame.overflows()).sum();
    format!("{} frames have {overflows} overflows.", frames.len())
}

fn picture(drawn: &Drawn) -> Picture {
    let (scene, size) = (drawn.spec.case.scene, drawn.frame.size());
    let alt = format!("the scene {scene}, {size} pixels");
    let title = format!("Figure 13: {scene}, {} polygons", drawn.report.polygons);
    Picture::new(format!("{scene}-frame"), title, alt, drawn.frame.to_png()).note(right::in_words(drawn.differing))
}

/// Overflows of each processing element, frame by frame.
fn overflows(drawn: &Drawn) -> HeatMap {
    let row = |frame: &FrameReport| frame.processors.iter().map(|it| it.overflows as f64).collect();
    let id = drawn.spec.name.replace("1/8", "8").replace(|c: char| !c.is_ascii_alphanumeric(), "-").replace("--", "-");
    let title = format!("Overflows of each processing element: {}", drawn.spec.name);
    HeatMap::new(format!("{id}-overflows"), title, "overflows", Origin::rtl([]), drawn.report.frames.iter().map(row))
        .note("Rows are frames, columns are processing elements.")
}

/// The numbers of the last frame of each run.
fn table(frames: &[Drawn]) -> Table {
    let columns = [
        "frame",
        "polygons",
        "packets",
        "pixels",
        "sent to all",
        "overflows",
        "most pages",
        "busiest, ms",
        "refreshes",
        "from command to display, ms",
        "events compared",
    ];
    let table = Table::new("frames", "The last frame of each run", columns)
        .note("A frame is drawn while the one before is merged. So the time from its command to the display is longer than that from frame to frame.");
    frames.iter().fold(table, |table, drawn| {
        let last = drawn.report.frames.last().expect("there are frames");
        let most = |of: fn(&ProcessorReport) -> u32| last.processors.iter().map(of).max().unwrap_or_default();
        let numbers = [
            f64::from(drawn.report.polygons),
            last.packets as f64,
            last.pixels() as f64,
            last.broadcast() as f64,
            last.overflows() as f64,
            f64::from(most(|it| it.pages)),
            drawn.drawing(),
            last.refreshes as f64,
            last.picoseconds() as f64 / 1e9 * drawn.hurry,
            drawn.report.compared as f64,
        ];
        table.row([Cell::from(drawn.spec.name.as_str())].into_iter().chain(numbers.map(Cell::Number)))
    })
}

//! Frames that the hardware has drawn: pictures, the time of each stage, and thousands of random triangles.

use super::plan::Plan;
use crate::golden;
use crate::reproduce::right;
use crate::reproduce::words::short;
use crate::shell::Failure;
use tilewright_machines::pixelflow::milliseconds;
use tilewright_machines::pixelflow::{Config, Machine, Report, Samples, Shades, Software, Stereo, System, Triangles};
use tilewright_machines::{Error, Watch};
use tilewright_report::{Axis, Cell, Chart, Origin, Picture, Rule, Section, Series, Statement, Table};
use tilewright_scenes::deferred::{self, Deferred, Shader, project_deferred};
use tilewright_scenes::golden::{render_deferred_watched, render_watched};
use tilewright_scenes::{Frame, Polygons, Scene, compare, project_polygons};

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Which {
    /// A built-in scene with one or eight samples a pixel.
    BuiltIn(&'static str, u32),
    /// That number of random triangles in boxes of 10 x 10 pixels.
    Triangles(u64),
}

/// A frame to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spec {
    pub which: Which,
    pub system: System,
    /// The shaders; 0 for the non-texturing system.
    pub shaders: u32,
    /// Whether it has half of the nodes, for one of two eyes.
    pub is_half: bool,
}

/// A frame of the hardware.
pub struct Drawn {
    pub spec: Spec,
    pub report: Report,
    frame: Frame,
    /// Pixels that differ from the golden image.
    differing: u64,
}

/// What a system draws.
enum Subject {
    Deferred(Deferred),
    /// With the background.
    Plain(Polygons, [u8; 3]),
}

impl Spec {
    fn subject(&self, plan: &Plan) -> Result<Subject, Failure> {
        let size = plan.size();
        let triangles = |seed| Triangles::new(size, plan.box_side(), seed).map_err(Error::from);
        Ok(match (self.which, self.system) {
            (Which::BuiltIn(name, samples), System::Base | System::PreSort) => {
                let samples = if samples == 8 {
                    deferred::Samples::Eight(deferred::Shading::EachSample)
                } else {
                    deferred::Samples::One
                };
                Subject::Deferred(project_deferred(&built_in(name), size, samples)?)
            }
            (Which::BuiltIn(name, _), System::NonTexturing) => {
                let scene = built_in(name);
                Subject::Plain(project_polygons(&scene, size)?, scene.background)
            }
            (Which::Triangles(count), System::Base | System::PreSort) => {
                Subject::Deferred(triangles(plan.effort.seed)?.deferred(count, shader(plan)?))
            }
            (Which::Triangles(count), System::NonTexturing) => {
                Subject::Plain(triangles(plan.effort.seed)?.polygons(count), [0; 3])
            }
        })
    }

    /// The system and its shaders, as in other figures.
    pub fn name(&self) -> &'static str {
        Plan::case(self.system, self.shaders, Samples::One, Shades::EverySample).name()
    }

    fn place(&self) -> String {
        let (system, what) = (self.name(), self.what());
        let half = if self.is_half { " on half of the nodes" } else { "" };
        format!("{what}: {system}{half}")
    }

    fn what(&self) -> String {
        match self.which {
            Which::BuiltIn(name, 1) => name.to_owned(),
            Which::BuiltIn(name, samples) => format!("{name} with {samples} samples"),
            Which::Triangles(count) => format!("{count} triangles"),
        }
    }

    pub fn seeds(&self, plan: &Plan) -> Vec<u64> {
        if matches!(self.which, Which::Triangles(_)) { vec![plan.effort.seed] } else { Vec::new() }
    }
}

fn built_in(name: &str) -> Scene {
    Scene::builtin(name).expect("a built-in scene")
}

/// The shader of random triangles: with lights and textures.
fn shader(plan: &Plan) -> Result<Shader, Failure> {
    Ok(project_deferred(&built_in("textured"), plan.size(), deferred::Samples::One)?.shader)
}

impl Drawn {
    /// Draws all frames.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Vec<Drawn>, Failure> {
        let machine = Machine::new(Config { array: plan.array(), ..Config::new(plan.size()) })?;
        plan.frames().into_iter().map(|spec| Drawn::of(spec, &machine, plan, watch)).collect()
    }

    fn of(spec: Spec, machine: &Machine, plan: &Plan, watch: &mut Watch) -> Result<Drawn, Failure> {
        let pre_sort = spec.system == System::PreSort;
        let config = Config { shaders: spec.shaders, array: plan.array(), pre_sort, ..Config::new(plan.size()) };
        let stereo = if spec.is_half { Stereo::Halved } else { Stereo::Sequential };
        let machine = machine.another(stereo.eye(&config).map_err(Error::from)?)?;
        let ((frame, report), golden) = match spec.subject(plan)? {
            Subject::Deferred(deferred) => {
                (machine.render(&deferred, watch)?, golden::draw(|watch| render_deferred_watched(&deferred, watch))?)
            }
            Subject::Plain(scene, background) => (
                machine.render_resident(&scene, background, watch)?,
                golden::draw(|watch| render_watched(scene.size, &scene.polygons, background, watch))?,
            ),
        };
        let differing = compare(&frame, &golden).differing;
        Ok(Drawn { spec, report, frame, differing })
    }

    /// The share of clocks in which a rasterizer works.
    fn rasterizing(&self) -> u64 {
        self.report.rasterizers.iter().map(|node| node.busy).sum()
    }

    /// The paper's formula for the same number of regions per primitive.
    pub fn software(&self) -> Software {
        let case = Plan::case(self.spec.system, self.spec.shaders, Samples::One, Shades::EverySample);
        let overlap = self.report.drawn as f64 / (self.report.primitives as f64).max(1.0);
        Software { overlap, ..case.formula() }
    }

    /// Its milliseconds for the same number of primitives.
    fn formula(&self) -> f64 {
        self.software().latency(self.report.primitives as f64)
    }
}

/// The frames of random triangles on the same system and the same number of nodes, each with its thousands of triangles.
pub fn of_triangles(frames: &[Drawn], spec: Spec) -> impl Iterator<Item = (f64, &Drawn)> {
    frames.iter().filter_map(move |it| match it.spec.which {
        Which::Triangles(count) if it.spec == (Spec { which: it.spec.which, ..spec }) => {
            Some((count as f64 / 1000.0, it))
        }
        _ => None,
    })
}

/// The time of a triangle in a region, in microseconds, or `None` if none were drawn. It is what the base system's arrays take longer for additional triangles.
pub fn measured(frames: &[Drawn], system: System) -> Option<f64> {
    let is_of = |spec: &Spec| spec.system == system && !spec.is_half && matches!(spec.which, Which::Triangles(_));
    let mut of = frames.iter().filter(|it| is_of(&it.spec));
    let first = of.next()?;
    let last = of.rfind(|it| it.spec.shaders == first.spec.shaders)?;
    let (clocks, drawn) =
        (last.rasterizing().checked_sub(first.rasterizing())?, last.report.drawn - first.report.drawn);
    (drawn > 0).then(|| clocks as f64 / drawn as f64 / 100.0)
}

/// The circuit's times for which the paper has numbers, and the checks that frames are right.
pub fn checks(frames: &[Drawn], plan: &Plan) -> Vec<Statement> {
    let found = |value: Option<f64>| value.map(|it| ("our circuit".to_owned(), it));
    let triangle = |fact: &str, text: &str, paper: f64, system: System| {
        Statement::new(fact, text, Rule::AtMost)
            .unit("µs")
            .paper([("our circuit", paper)])
            .found(Origin::rtl([plan.effort.seed]), found(measured(frames, system)))
    };
    vec![
        right::statement("PFL-TYPES", frames.iter().map(|it| (it.spec.place(), it.differing))),
        triangle(
            "PFL-TRAST",
            "A triangle with all appearance parameters takes no longer in a region than in the paper: extra time of additional triangles.",
            0.83,
            System::Base,
        ),
        triangle(
            "PFL-NT",
            "A triangle of z and colour takes no longer in a region than in the paper: extra time of additional triangles.",
            0.62,
            System::NonTexturing,
        ),
    ]
}

/// The section of the frames.
pub fn section(frames: &[Drawn], plan: &Plan) -> Section {
    let [width, height] = plan.array();
    let section = Section::new("Frames").paragraph(format!(
        "The circuit drew these frames, clock by clock, on 20 nodes with arrays of {width}x{height} pixel processors. Rasterizers, network, shaders, texture units and frame buffer are simulated; \
             the front end takes the paper’s time. Each random triangle fills half of a box."
    ));
    let pictures = frames.iter().filter(|it| matches!(it.spec.which, Which::BuiltIn(..)));
    let section = pictures.fold(section, |section, drawn| section.figure(took(drawn), picture(drawn)));
    section.figure(sooner(frames, plan), curves(frames, plan)).part(table(frames))
}

/// The time of a frame.
fn took(Drawn { report, .. }: &Drawn) -> String {
    format!("{} primitives are on the screen after {} ms.", report.primitives, short(milliseconds(report.latency())))
}

/// The most triangles, beside the formula.
fn sooner(frames: &[Drawn], plan: &Plan) -> String {
    let (thousands, last) = of_triangles(frames, plan.stereo()).last().expect("triangles are drawn");
    let [circuit, formula] = [milliseconds(last.report.latency()), last.formula()].map(short);
    format!(
        "{} triangles take {circuit} ms on the base system with 4 shaders, and {formula} ms by the formula.",
        short(1000.0 * thousands)
    )
}

fn picture(drawn: &Drawn) -> Picture {
    let Which::BuiltIn(name, samples) = drawn.spec.which else { unreachable!("random triangles are no picture") };
    let id = format!("{name}-{samples}");
    let system = match drawn.spec.system {
        System::NonTexturing => "in the colours of vertices",
        _ => "shaded pixel by pixel",
    };
    let size = drawn.frame.size();
    Picture::new(
        id,
        format!("{}, {system}", drawn.spec.what()),
        format!("the scene {name}, {size} pixels"),
        drawn.frame.to_png(),
    )
    .note(format!(
        "{} The primitives are {} in all regions together.",
        right::in_words(drawn.differing),
        drawn.report.drawn
    ))
}

/// Latency of thousands of triangles beside the paper's formula.
fn curves(frames: &[Drawn], plan: &Plan) -> Chart {
    let chart = Chart::new(
        "frames-latency",
        "Latency of random triangles in the circuit",
        Axis::linear("thousand primitives"),
        Axis::linear("latency, ms"),
    )
    .note("The formula has the paper’s time of a triangle, which is longer, and the overlap of the same triangles.");
    plan.curves().into_iter().fold(chart, |chart, spec| {
        let formula = of_triangles(frames, spec).map(|(at, it)| (at, it.formula()));
        let found = of_triangles(frames, spec).map(|(at, it)| (at, milliseconds(it.report.latency())));
        chart.series(Series::new(spec.name(), Origin::Formula, formula)).series(Series::new(
            spec.name(),
            Origin::rtl(spec.seeds(plan)),
            found,
        ))
    })
}

/// What each stage of each frame took.
fn table(frames: &[Drawn]) -> Table {
    let stages = ["rasterizing", "composing", "shading", "sending colours", "frame buffer"];
    let columns =
        ["frame", "primitives", "in regions", "front end", "second pass"].into_iter().chain(stages).chain(["latency"]);
    let table = Table::new("frames", "What the stages of each frame were busy with, in ms", columns)
        .note("Of several nodes, the one that is busy longest. The front end’s time is the paper’s.");
    frames.iter().fold(table, |table, drawn| {
        let report = &drawn.report;
        let busy = |name: &str| {
            let stage = report.stages().into_iter().find(|stage| stage.name == name);
            stage.map_or(Cell::from("–"), |stage| Cell::Number(milliseconds(stage.busy)))
        };
        let counts = [report.primitives as f64, report.drawn as f64, milliseconds(report.front)];
        let second = if report.second > 0 { Cell::Number(milliseconds(report.second)) } else { Cell::from("–") };
        let cells = [Cell::from(drawn.spec.place())].into_iter().chain(counts.map(Cell::Number)).chain([second]);
        table.row(cells.chain(stages.map(busy)).chain([Cell::Number(milliseconds(report.latency()))]))
    })
}

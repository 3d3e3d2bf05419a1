//! The run of a case: a still view, frame after frame, and its times.

use super::plan::{Case, FIRST, FRAMES, Plan, STEP};
use std::sync::Arc;
use tilewright_machines::Error;
use tilewright_machines::vc1::model::Model;
use tilewright_machines::vc1::{Clocks, Config, FrameReport, Report};
use tilewright_rtl::clocks::PE;
use tilewright_scenes::{Projection, Scene, project};

/// The numbers of a case, as means over the timed frames. Times are in milliseconds.
#[derive(Clone, Debug)]
pub struct Timed {
    pub case: Case,
    /// From frame to frame on the display: T.
    pub time: f64,
    /// Clearing and drawing of the busiest processing element, waiting left out: D.
    pub drawing: f64,
    /// The busiest processing element over their mean.
    pub imbalance: f64,
    /// Clocks of a processing element by class, in the sequence of [`Clocks::NAMES`].
    pub clocks: [f64; 10],
    pub overflows: f64,
    /// Words on the bus, and their time on it.
    pub words: f64,
    pub bus: f64,
    pub polygons: u32,
}

/// A case to run. Pages that its views do not need make no difference and are left out, so that many cases are equal.
pub struct Job {
    pub case: Case,
    config: Config,
}

/// Nanoseconds of a clock of the processing elements, in milliseconds.
pub const CLOCK: f64 = PE.period.picoseconds() as f64 / 1e9;

/// T: the mean interval between changes of the display, in ms.
pub fn interval(report: &Report) -> f64 {
    let shown = |number: usize| report.frames[number - 1].times.shown.unwrap_or_default() as f64 / 1e9;
    (shown(FRAMES) - shown(FIRST)) / (FRAMES - FIRST) as f64
}

impl Timed {
    /// The same for an equivalent case.
    pub fn of_case(&self, case: Case) -> Timed {
        Timed { case, ..self.clone() }
    }

    fn from(case: Case, config: &Config, report: &Report, hurry: f64) -> Timed {
        let clock = CLOCK * hurry;
        let frames = &report.frames[FIRST..FRAMES];
        let count = frames.len() as f64;
        let mean = |of: &dyn Fn(&FrameReport) -> f64| frames.iter().map(of).sum::<f64>() / count;
        let busiest =
            |frame: &FrameReport| frame.processors.iter().map(|it| it.clocks.busy()).max().unwrap_or_default() as f64;
        let words = mean(&|frame| frame.words as f64);
        let mut clocks = Clocks::default();
        frames.iter().flat_map(|frame| &frame.processors).for_each(|it| clocks += it.clocks);
        Timed {
            case,
            time: interval(report) * hurry,
            drawing: mean(&busiest) * clock,
            imbalance: mean(&|frame| {
                let sum: u64 = frame.processors.iter().map(|it| it.clocks.busy()).sum();
                busiest(frame) * frame.processors.len() as f64 / sum as f64
            }),
            clocks: clocks.all().map(|sum| sum as f64 * hurry / (count * f64::from(case.processors))),
            overflows: mean(&|frame| frame.overflows() as f64),
            words,
            bus: words * f64::from(config.word_clocks) * clock,
            polygons: report.polygons,
        }
    }

    /// Milliseconds of a class of clocks, by its name in [`Clocks::NAMES`].
    pub fn class(&self, name: &str) -> f64 {
        let class = Clocks::NAMES.iter().position(|it| *it == name).expect("a class has that name");
        self.clocks[class] * CLOCK
    }

    /// Millions of polygons a second.
    pub fn rate(&self) -> f64 {
        f64::from(self.polygons) / self.time / 1e3
    }
}

impl Case {
    /// The scene as the camera sees it after that number of steps.
    ///
    /// # Errors
    /// It cannot be set up.
    pub fn view(&self, plan: &Plan, step: u32) -> Result<Arc<Projection>, Error> {
        let mut scene = Scene::builtin(self.scene).expect("a built-in scene");
        if step > 0 {
            scene.camera = scene.camera.orbited(STEP * f64::from(step));
        }
        Ok(Arc::new(project(&scene, plan.size()).expect("a built-in scene can be set up from all sides")))
    }
}

impl Job {
    /// What has to run for a case.
    ///
    /// # Errors
    /// There is no such machine.
    pub fn of(case: &Case, plan: &Plan) -> Result<Job, Error> {
        let config = case.config(plan);
        let views = [0, case.view].map(|step| case.view(plan, step));
        let [first, view] = views;
        let needed = config.sufficient_pages([(*first?).clone(), (*view?).clone()])?.max(2);
        Ok(Job { case: *case, config: Config { pages: config.pages.map(|pages| pages.min(needed)), ..config } })
    }

    /// Whether one run is enough for both: they have the same machine and the same views.
    pub fn is_same(&self, other: &Job) -> bool {
        (self.case.scene, self.case.view, self.config) == (other.case.scene, other.case.view, other.config)
    }

    /// Runs it.
    ///
    /// # Errors
    /// There is no such machine.
    pub fn run(&self, plan: &Plan) -> Result<Timed, Error> {
        let Job { case, config } = self;
        let first = case.view(plan, 0)?;
        let report = match case.view {
            0 => modelled(config, &first, None)?,
            view => modelled(config, &case.view(plan, view)?, Some(&first))?,
        };
        Ok(Timed::from(*case, config, &report, plan.hurry(case.processors)))
    }
}

/// Frames of a still view on the model. Its polygons are assigned in `first`, if that is given.
fn modelled(config: &Config, view: &Arc<Projection>, first: Option<&Arc<Projection>>) -> Result<Report, Error> {
    let model = Model::new(*config)?;
    let first = first.map(|first| model.deal(first, None)).transpose()?;
    let dealt = model.deal(view, first.as_ref())?;
    Ok(model.render(std::iter::repeat_n(dealt, FRAMES)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::effort::Effort;

    #[test]
    fn pages_that_are_not_needed_make_no_difference() -> Result<(), Error> {
        let plan = Plan::new(Effort { seed: 1, most: Some(1) });
        let [all, half] = [1, 2].map(|part| Job::of(&plan.in_memory("table", 16, part), &plan));
        let (all, half) = (all?, half?);
        assert!(all.is_same(&half) && all.config.pages < all.case.config(&plan).pages, "{:?}", all.config);
        let view = all.case.view(&plan, 0)?;
        let [few, many] = [all.config, all.case.config(&plan)].map(|config| modelled(&config, &view, None));
        assert_eq!(few?.frames, many?.frames);
        // Intervals that are counted give one.
        assert!(!all.is_same(&Job::of(&plan.in_memory("table", 16, 8), &plan)?));
        Ok(())
    }
}

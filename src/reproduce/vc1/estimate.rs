//! The paper's own estimate beyond 16 processing elements (VC1-EST): each alone, in two passes.

use super::found::Found;
use super::plan::{FRAMES, Plan};
use super::run::interval;
use tilewright_machines::vc1::model::Model;
use tilewright_machines::{Error, Watch};
use tilewright_report::{Axis, Chart, Series};

/// The estimate for a scene on that number of processing elements.
pub struct Estimated {
    pub scene: &'static str,
    pub processors: u32,
    /// T of the slowest one, alone, in ms.
    pub time: f64,
}

impl Estimated {
    /// Estimates all points of Figure 7; `None` if interrupted.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Option<Result<Vec<Estimated>, Error>> {
        let all: Vec<(&'static str, u32)> =
            plan.scenes().iter().flat_map(|scene| plan.processors().iter().map(|n| (*scene, *n))).collect();
        Some(watch.each("estimating", &all, |(scene, n)| Estimated::of(plan, scene, *n))?.into_iter().collect())
    }

    fn of(plan: &Plan, scene: &'static str, processors: u32) -> Result<Estimated, Error> {
        let case = plan.case(scene, processors);
        let model = Model::new(case.config(plan))?;
        let dealt = model.deal(&case.view(plan, 0)?, None)?;
        let estimate = model.estimate(&dealt, FRAMES);
        Ok(Estimated { scene, processors, time: interval(estimate.slowest()) * plan.hurry(processors) })
    }

    /// The estimate over T, if T was timed.
    pub fn of_time(&self, found: &Found) -> Option<f64> {
        Some(self.time / found.of(found.plan.case(self.scene, self.processors))?.time)
    }
}

/// The estimate beside T.
pub fn chart(found: &Found) -> Chart {
    let chart = Chart::new(
        "figure-7-estimate",
        "The paper’s two-pass estimate over T",
        Axis::log("processing elements n"),
        Axis::linear("estimate / T"),
    )
    .note("Each processing element draws alone: first without the polygons that all draw, then with all of them. The slowest one counts.");
    found.plan.scenes().iter().fold(chart, |chart, scene| {
        let of_scene = found.estimated.iter().filter(|it| it.scene == *scene);
        let points = of_scene.filter_map(|it| Some((f64::from(it.processors), it.of_time(found)?)));
        chart.series(Series::new(*scene, found.model(), points))
    })
}

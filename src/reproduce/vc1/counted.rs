//! Counts without time: pixels, pages, vertices and areas.

use super::plan::{CLUSTERS, Case, Plan};
use tilewright_machines::Error;
use tilewright_machines::vc1::{Config, Demand, demand};
use tilewright_report::Origin;
use tilewright_scenes::Projection;

/// Numbers of processing elements for which pages are counted (VC1-LOC).
pub const PROCESSORS: [u32; 3] = [16, 64, 256];

/// All counts.
pub struct Counted {
    pub clusters: Vec<Cluster>,
    pub shares: Vec<Share>,
    /// The areas of the table's packets in pixels, unsorted.
    areas: Vec<f64>,
}

/// Clusters of that number of polygons (VC1-CLU).
pub struct Cluster {
    pub polygons: u32,
    /// Transformed vertices; a vertex counts once for each of its clusters.
    pub vertices: f64,
    /// Mean pages of a processing element, with enough for all patches.
    pub pages: f64,
}

/// The mean share of a scene for one of that number of processing elements (VC1-LOC).
pub struct Share {
    pub scene: &'static str,
    pub processors: u32,
    pub pixels: f64,
    pub pages: f64,
}

impl Counted {
    /// Counts.
    ///
    /// # Errors
    /// There is no such machine.
    pub fn all(plan: &Plan) -> Result<Counted, Error> {
        let scenes = ["ter1k", "ter250"].into_iter().filter(|scene| plan.scenes().contains(scene));
        let shares = scenes.flat_map(|scene| PROCESSORS.map(|processors| share(plan, scene, processors)));
        let table = plan.case("table", 16).view(plan, 0)?;
        Ok(Counted {
            clusters: CLUSTERS.into_iter().map(|polygons| cluster(plan, polygons)).collect::<Result<_, _>>()?,
            shares: shares.collect::<Result<_, _>>()?,
            areas: table.triangles.iter().map(|packet| packet.area()).collect(),
        })
    }

    pub fn origin(&self) -> Origin {
        Origin::count([])
    }

    /// A processing element's share of a scene, if that is counted.
    pub fn share(&self, scene: &str, processors: u32) -> Option<&Share> {
        self.shares.iter().find(|it| it.scene == scene && it.processors == processors)
    }

    /// The mean area of the table's packets above a threshold, if there are any.
    pub fn mean_area(&self, threshold: Option<u32>) -> Option<f64> {
        let threshold = f64::from(threshold?);
        let above: Vec<f64> = self.areas.iter().copied().filter(|area| *area > threshold).collect();
        (!above.is_empty()).then(|| above.iter().sum::<f64>() / above.len() as f64)
    }
}

fn cluster(plan: &Plan, polygons: u32) -> Result<Cluster, Error> {
    let case = plan.clustered(polygons);
    let (config, view) = (case.config(plan), case.view(plan, 0)?);
    let assignment = config.assignment(&view, None)?;
    let vertices: u32 = assignment.polygons.iter().flatten().map(|polygon| polygon.vertices).sum();
    Ok(Cluster { polygons, vertices: vertices.into(), pages: mean(&demands(&config, &view)?, |it| it.pages.into()) })
}

fn share(plan: &Plan, scene: &'static str, processors: u32) -> Result<Share, Error> {
    let case: Case = plan.in_memory(scene, processors, 1);
    let demands = demands(&case.config(plan), &*case.view(plan, 0)?)?;
    let pixels = mean(&demands, |it| it.pixels as f64);
    Ok(Share { scene, processors, pixels, pages: mean(&demands, |it| it.pages.into()) })
}

fn demands(config: &Config, view: &Projection) -> Result<Vec<Demand>, Error> {
    Ok(demand(&config.assignment(view, None)?, &view.triangles, &config.patches()?, config.apr))
}

fn mean(demands: &[Demand], of: impl Fn(&Demand) -> f64) -> f64 {
    demands.iter().map(of).sum::<f64>() / demands.len() as f64
}

//! The assignment of polygons to processing elements.
//!
//! Source: VC1-CLU. Clusters of w consecutive polygons tend to be neighbours on the screen. Each cluster goes to the processing element with the
//! least load so far, and between equals to the lowest number (the paper allows any). The load of a polygon is the clocks that the cost table
//! expects. Polygons are loaded into local memories before the first frame. From frame to frame only the view is sent, so the assignment of
//! the first view stays. [`Assign`] has that and two other ways.
//!
//! With 16 processing elements, the mean wait for the last one over ter1k's 48 views is 0.62 ms by `Each` and 1.01 ms by `Count`. By `Once` it
//! depends on the first view: from 1.17 to 2.46 ms, with a mean of 1.68 ms over all first views. Table 1 has 1.4 ms (VC1-T1).
//! `cargo test -p tilewright-machines each_way_of_dealing -- --ignored --nocapture` prints these.

use super::config::Config;
use super::cost::CostTable;
use serde::Serialize;
use std::collections::HashSet;
use std::ops::Range;
use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::packet::SUBPIXELS;
use tilewright_scenes::{Projection, ScreenVertex};

/// The way in which polygons are assigned to processing elements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Assign {
    /// By the expected clocks of the first view, once for all frames.
    #[default]
    Once,
    /// By the expected clocks of each frame's view, which moves polygons between local memories.
    Each,
    /// By the number of polygons alone, once for all frames.
    Count,
}

/// A polygon and its packets. It has none if it is off the screen, behind the eye or without area, and several if clipping split it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polygon {
    /// Its number in the scene.
    pub number: u32,
    /// Its packets, by index in [`Projection::triangles`].
    pub packets: Range<usize>,
    /// Its vertices that no polygon before it in its cluster has.
    pub vertices: u32,
    /// Packets that cross the border of the screen.
    pub clipped: u32,
}

/// The polygons of every processing element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// By processing element, in the sequence of submission.
    pub polygons: Vec<Vec<Polygon>>,
    /// By processing element: the clocks that the cost table expects.
    pub loads: Vec<u64>,
}

impl Config {
    /// The polygons of a frame for the processing elements; `first` is the assignment of the first frame, unless this is it.
    ///
    /// ```
    /// use tilewright_machines::vc1::Config;
    /// use tilewright_scenes::Scene;
    ///
    /// let mut scene = Scene::builtin("teapot").expect("a built-in scene");
    /// let config = Config::new(scene.size);
    /// let first = config.assignment(&scene.project()?, None)?;
    /// scene.camera = scene.camera.orbited(7.5);
    /// let second = config.assignment(&scene.project()?, Some(&first))?;
    /// // By default each polygon stays on its processing element, though its clocks may change.
    /// let numbers = |k: usize| [&first, &second].map(|it| it.polygons[k].iter().map(|it| it.number).collect::<Vec<_>>());
    /// assert!((0..16).all(|k| numbers(k)[0] == numbers(k)[1]));
    /// assert_ne!(first.loads, second.loads);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Assignment::in_view`].
    pub fn assignment(
        &self,
        projection: &Projection,
        first: Option<&Assignment>,
    ) -> Result<Assignment, ParameterError> {
        let Config { processors, cluster, costs, .. } = self;
        match (self.assign, first) {
            (Assign::Once | Assign::Count, Some(first)) => first.in_view(projection, costs),
            (Assign::Once, None) | (Assign::Each, _) => Ok(Assignment::new(projection, *processors, *cluster, costs)),
            (Assign::Count, None) => Ok(Assignment::by_count(projection, *processors, *cluster, costs)),
        }
    }
}

impl Assignment {
    /// Assigns clusters of `cluster` polygons to `processors` processing elements by their expected clocks.
    pub fn new(projection: &Projection, processors: u32, cluster: u32, costs: &CostTable) -> Assignment {
        let clusters = clusters(projection, cluster);
        let loads = clusters.iter().map(|cluster| cluster.iter().map(|it| load(projection, it, costs)).sum()).collect();
        Assignment::dealt(clusters, loads, processors, projection, costs)
    }

    /// Assigns clusters of `cluster` polygons to `processors` processing elements by the number of polygons.
    pub fn by_count(projection: &Projection, processors: u32, cluster: u32, costs: &CostTable) -> Assignment {
        let clusters = clusters(projection, cluster);
        let counts = clusters.iter().map(|cluster| cluster.len() as u64).collect();
        Assignment::dealt(clusters, counts, processors, projection, costs)
    }

    /// The same polygons on the same processing elements in another view of the scene.
    ///
    /// # Errors
    /// The scene of the projection has another number of polygons.
    pub fn in_view(&self, projection: &Projection, costs: &CostTable) -> Result<Assignment, ParameterError> {
        let dealt: usize = self.polygons.iter().map(Vec::len).sum();
        let there = projection.counts.polygons;
        if dealt != there as usize {
            let problem = format!("an assignment of {dealt} polygons for a scene of {there}: assign the scene anew");
            return Err(ParameterError(problem));
        }
        let packets = packets(projection);
        let seen = |polygon: &Polygon| {
            let packets = packets[polygon.number as usize].clone();
            Polygon { clipped: clipped(projection, packets.clone()), packets, ..*polygon }
        };
        let polygons = self.polygons.iter().map(|polygons| polygons.iter().map(seen).collect()).collect();
        Ok(Assignment::of(polygons, projection, costs))
    }

    /// Assigns each cluster to the processing element with the least sum of `weights` so far.
    fn dealt(
        clusters: Vec<Vec<Polygon>>,
        weights: Vec<u64>,
        processors: u32,
        projection: &Projection,
        costs: &CostTable,
    ) -> Assignment {
        let mut polygons = vec![Vec::new(); processors as usize];
        let mut sums = vec![0; processors as usize];
        for (cluster, weight) in clusters.into_iter().zip(weights) {
            let least = (0..sums.len()).min_by_key(|&i| sums[i]).expect("at least one processor");
            sums[least] += weight;
            polygons[least].extend(cluster);
        }
        Assignment::of(polygons, projection, costs)
    }

    /// The assignment with its loads.
    fn of(polygons: Vec<Vec<Polygon>>, projection: &Projection, costs: &CostTable) -> Assignment {
        let loads =
            polygons.iter().map(|polygons| polygons.iter().map(|it| load(projection, it, costs)).sum()).collect();
        Assignment { polygons, loads }
    }
}

/// Every polygon of the scene, in clusters of that size.
fn clusters(projection: &Projection, size: u32) -> Vec<Vec<Polygon>> {
    let all: Vec<u32> = (0..projection.counts.polygons).collect();
    let packets = packets(projection);
    let cluster = |numbers: &[u32]| {
        let mut known = HashSet::new();
        let polygon = |&number: &u32| {
            let packets = packets[number as usize].clone();
            let vertices = projection.corners[number as usize].iter().filter(|&&corner| known.insert(corner)).count();
            let clipped = clipped(projection, packets.clone());
            Polygon { number, packets, vertices: vertices as u32, clipped }
        };
        numbers.iter().map(polygon).collect()
    };
    all.chunks(size as usize).map(cluster).collect()
}

/// By polygon: its packets.
fn packets(projection: &Projection) -> Vec<Range<usize>> {
    let packets = &projection.triangles;
    let mut first = 0;
    let ranges = (0..projection.counts.polygons).map(|number| {
        let count = packets[first..].iter().take_while(|packet| packet.polygon == number).count();
        first += count;
        first - count..first
    });
    ranges.collect()
}

/// The number of those packets that cross the border of the screen.
fn clipped(projection: &Projection, packets: Range<usize>) -> u32 {
    let on_screen = |vertex: &ScreenVertex| {
        let within = |position: i32, side: u32| (0..=side as i32 * SUBPIXELS).contains(&position);
        within(vertex.x, projection.size.width()) && within(vertex.y, projection.size.height())
    };
    projection.vertices[packets].iter().filter(|vertices| !vertices.iter().all(on_screen)).count() as u32
}

fn load(projection: &Projection, polygon: &Polygon, costs: &CostTable) -> u64 {
    let packets = &projection.triangles[polygon.packets.clone()];
    let drawing: u64 = packets.iter().map(|packet| costs.estimate(packet)).sum();
    costs.geometry(polygon) + costs.preparation(polygon) + drawing
}

#[cfg(test)]
mod tests;

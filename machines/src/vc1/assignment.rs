//! Which processing element draws which polygons.
//!
//! Source: VC1-CLU. Clusters of w consecutive polygons, which tend to be neighbours on the screen, go one after another to the
//! processing element with the least load so far; of equals, to the one of the lowest number (the paper takes any). The load of a
//! polygon is what the cost table expects it to take.

use super::cost::CostTable;
use std::ops::Range;
use tilewright_scenes::Projection;

/// A polygon and its packets: none if it is off the screen, behind the eye or without area; several if clipping split it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polygon {
    /// Its number in the scene.
    pub number: u32,
    /// Its packets, by index in [`Projection::triangles`].
    pub packets: Range<usize>,
}

/// The polygons of every processing element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// By processing element, in order of submission.
    pub polygons: Vec<Vec<Polygon>>,
    /// By processing element: the clocks that the cost table expects.
    pub loads: Vec<u64>,
}

impl Assignment {
    /// Deals clusters of `cluster` polygons to `processors` processing elements.
    pub fn new(projection: &Projection, processors: u32, cluster: u32, costs: &CostTable) -> Assignment {
        let all = polygons(projection);
        let mut assignment =
            Assignment { polygons: vec![Vec::new(); processors as usize], loads: vec![0; processors as usize] };
        for cluster in all.chunks(cluster as usize) {
            let least =
                (0..assignment.loads.len()).min_by_key(|&i| assignment.loads[i]).expect("at least one processor");
            assignment.loads[least] += cluster.iter().map(|polygon| load(projection, polygon, costs)).sum::<u64>();
            assignment.polygons[least].extend_from_slice(cluster);
        }
        assignment
    }
}

/// Every polygon of the scene with its packets.
fn polygons(projection: &Projection) -> Vec<Polygon> {
    let packets = &projection.triangles;
    let mut first = 0;
    let polygons = (0..projection.counts.polygons).map(|number| {
        let count = packets[first..].iter().take_while(|packet| packet.polygon == number).count();
        first += count;
        Polygon { number, packets: first - count..first }
    });
    polygons.collect()
}

fn load(projection: &Projection, polygon: &Polygon, costs: &CostTable) -> u64 {
    let packets = &projection.triangles[polygon.packets.clone()];
    costs.geometry + packets.iter().map(|packet| costs.estimate(packet)).sum::<u64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_scenes::{Scene, Size, project};

    fn teapot() -> Projection {
        let scene = Scene::builtin("teapot").expect("a built-in scene");
        project(&scene, Size::new(160, 120).expect("in range")).expect("the teapot is in sight")
    }

    #[test]
    fn every_polygon_is_dealt_once_in_whole_clusters() {
        let assignment = Assignment::new(&teapot(), 5, 32, &CostTable::default());
        let mut clusters: Vec<Vec<u32>> = Vec::new();
        for polygons in &assignment.polygons {
            clusters.extend(polygons.chunks(32).map(|cluster| cluster.iter().map(|polygon| polygon.number).collect()));
        }
        clusters.sort();
        assert_eq!(clusters.concat(), (0..4096).collect::<Vec<_>>());
    }

    #[test]
    fn no_processor_is_ahead_by_more_than_a_cluster() {
        let projection = teapot();
        let costs = CostTable::default();
        let assignment = Assignment::new(&projection, 7, 16, &costs);
        let heaviest = polygons(&projection)
            .chunks(16)
            .map(|cluster| cluster.iter().map(|polygon| load(&projection, polygon, &costs)).sum::<u64>())
            .max();
        let (least, most) = (assignment.loads.iter().min(), assignment.loads.iter().max());
        assert!(most.unwrap() - least.unwrap() <= heaviest.unwrap(), "{:?}", assignment.loads);
    }

    #[test]
    fn of_equally_loaded_processors_the_lowest_is_taken() {
        let costs = CostTable { geometry: 1, set_up: 0, row: 0, pixel: 0, clear: 1 };
        let assignment = Assignment::new(&teapot(), 3, 1000, &costs);
        let firsts: Vec<u32> = assignment.polygons.iter().map(|polygons| polygons[0].number).collect();
        assert_eq!(firsts, [0, 1000, 2000]);
        assert_eq!(assignment.loads, [2000, 1096, 1000]);
    }
}

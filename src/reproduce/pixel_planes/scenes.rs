//! The scenes that are counted and drawn: built-in scenes, random vectors, and the two extremes of PP5-PW.

use super::plan::Plan;
use crate::scene::polygons;
use crate::shell::Failure;
use tilewright_machines::Error;
use tilewright_machines::pixel_planes::Regions;
use tilewright_scenes::{Counts, Polygon, Polygons, Scene, ScreenVertex, Size, set_up_polygon};

/// A scene on the page's screen.
pub struct Subject {
    /// Its name in texts, and its name in files.
    pub name: &'static str,
    pub scene: Polygons,
    pub background: [u8; 3],
    /// Its seed, if it is random.
    pub seeds: Vec<u64>,
}

/// Which scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Which {
    BuiltIn(&'static str),
    /// That number of random vectors of 45 degrees.
    Vectors(u64),
    /// A square in each region: the least load.
    OneEach,
    /// The same number of squares, each over the whole screen: the greatest load.
    WholeScreen,
}

impl Which {
    pub fn name(self) -> &'static str {
        match self {
            Which::BuiltIn(name) => name,
            Which::Vectors(_) => "vectors",
            Which::OneEach => "one-each",
            Which::WholeScreen => "whole-screen",
        }
    }

    /// The scene, set up.
    pub fn subject(self, plan: &Plan) -> Result<Subject, Failure> {
        let regions = plan.regions();
        let subject = |scene, background, seeds| Subject { name: self.name(), scene, background, seeds };
        Ok(match self {
            Which::BuiltIn(name) => {
                let scene = Scene { size: regions.size(), ..Scene::builtin(name).expect("a built-in scene") };
                subject(polygons(&scene)?, scene.background, vec![])
            }
            Which::Vectors(count) => {
                subject(plan.vectors().map_err(Error::from)?.polygons(count), [0; 3], vec![plan.effort.seed])
            }
            Which::OneEach => subject(one_each(&regions), [0; 3], vec![]),
            Which::WholeScreen => subject(whole_screen(&regions), [0; 3], vec![]),
        })
    }
}

/// A small square in the middle of each region.
fn one_each(regions: &Regions) -> Polygons {
    let third = regions.side() as i32 / 3;
    let corners = (0..regions.count()).map(|region| {
        let pixels = regions.pixels(region);
        [pixels.left as i32 + third, pixels.top as i32 + third]
    });
    squares(regions.size(), corners.zip(std::iter::repeat(third)))
}

/// Squares that reach beyond the screen on all sides.
fn whole_screen(regions: &Regions) -> Polygons {
    let size = regions.size();
    let side = size.width().max(size.height()) as i32 + 20;
    squares(size, (0..regions.count()).map(|_| ([-10, -10], side)))
}

/// Squares with these upper left corners and sides in pixels. Each is nearer than the one before and has another grey.
fn squares(size: Size, places: impl Iterator<Item = ([i32; 2], i32)>) -> Polygons {
    let one = |(number, ([x, y], side)): (u32, ([i32; 2], i32))| {
        let corners = [(0, 0), (side, 0), (side, side), (0, side)];
        let vertices = corners.map(|(dx, dy)| ScreenVertex {
            x: 16 * (x + dx),
            y: 16 * (y + dy),
            z: 0x80_0000 - number,
            rgb: [60 + 2 * (number % 96) as u8; 3],
        });
        let packet = set_up_polygon(&vertices, size).pop().expect("a square is on the screen");
        (Polygon { polygon: number, ..packet }, vertices.to_vec())
    };
    let (polygons, vertices): (Vec<_>, Vec<_>) = (0..).zip(places).map(one).unzip();
    let count = polygons.len() as u32;
    Polygons {
        size,
        polygons,
        vertices,
        spheres: Vec::new(),
        counts: Counts { polygons: count, drawn: count, ..Counts::default() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_machines::pixel_planes::Binner;

    #[test]
    fn the_extremes_are_in_one_region_each_and_in_all() {
        let regions = Regions::paper();
        let bins = |scene: Polygons| {
            let bins = regions.bins(&scene.vertices, Binner::Tight);
            bins.iter().map(Vec::len).collect::<Vec<_>>()
        };
        assert_eq!(bins(one_each(&regions)), [1; 80]);
        assert_eq!(bins(whole_screen(&regions)), [80; 80]);
    }
}

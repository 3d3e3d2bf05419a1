//! The rendering program of a processing element: a sequence of accesses to its local frame buffer, each after so many clocks of
//! computation.
//!
//! Source: section 4 and VC1-SW1 of the paper. After a swap the program clears its patch table, entry by entry (VC1-CLR2), then
//! takes its polygons in order of submission: geometry, area, clipping, and for each packet set-up and scan conversion. It knows nothing of
//! time: [`super::processor`] runs it.

use super::assignment::Polygon;
use super::cost::{CostTable, rows};
use super::scan_conversion::{Pixel, Pixels};
use serde::Serialize;
use std::ops::Range;
use tilewright_scenes::Triangle;

/// What a program does next, and for how long it computes before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Step {
    /// Clocks of the step, the access's own included if the local frame buffer takes it at once.
    pub clocks: u64,
    /// `None` ends the program.
    pub access: Option<Access>,
}

/// An access to the local frame buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Access {
    /// Clears the patch-table entry of a patch.
    Clear(u32),
    /// Draws a pixel.
    Draw(Pixel),
}

/// Where the clocks of a program go, stalls apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Work {
    /// Clocks of clearing the patch table.
    pub clear: u64,
    /// Clocks of geometry.
    pub geometry: u64,
    /// Clocks of areas, clipping, set-up, rows and pixels (VC1-CLIP).
    pub rasterization: u64,
}

impl Work {
    /// All clocks.
    pub fn total(&self) -> u64 {
        self.clear + self.geometry + self.rasterization
    }
}

/// A program at some point of its execution.
pub(crate) struct Program<'a> {
    costs: CostTable,
    packets: &'a [Triangle],
    /// Entries of the patch table, and those that are still to be cleared.
    entries: u32,
    patches: Range<u32>,
    /// Polygons that are still to be drawn.
    polygons: std::slice::Iter<'a, Polygon>,
    /// Packets of it that are still to be drawn.
    rest: Range<usize>,
    span: Option<Spans<'a>>,
    /// What has been worked so far, the step just given out included.
    pub work: Work,
}

/// A packet being drawn.
struct Spans<'a> {
    pixels: Pixels<'a>,
    /// The row after the last one that was charged.
    row: u32,
    bottom: u32,
}

impl<'a> Program<'a> {
    /// The program that clears the table of `patches` patches and draws `polygons`, whose packets are among `packets`.
    pub fn new(costs: CostTable, packets: &'a [Triangle], polygons: &'a [Polygon], patches: u32) -> Program<'a> {
        Program {
            costs,
            packets,
            entries: patches,
            patches: 0..patches,
            polygons: polygons.iter(),
            rest: 0..0,
            span: None,
            work: Work::default(),
        }
    }

    /// Has it clear the whole table before it goes on.
    pub fn clear_again(&mut self) {
        self.patches = 0..self.entries;
    }

    /// Entries of the patch table that it has not begun to clear.
    pub fn entries_left(&self) -> usize {
        self.patches.len()
    }

    /// Polygons that it has not begun.
    pub fn polygons_left(&self) -> usize {
        self.polygons.len()
    }

    /// The next step. After the end it ends again, in 0 clocks.
    pub fn step(&mut self) -> Step {
        if let Some(patch) = self.patches.next() {
            self.work.clear += self.costs.clear;
            return Step { clocks: self.costs.clear, access: Some(Access::Clear(patch)) };
        }
        let before = self.work.total();
        let access = self.next_pixel().map(Access::Draw);
        Step { clocks: self.work.total() - before, access }
    }

    /// Works up to the next pixel, through polygons that have none; `None` at the end.
    fn next_pixel(&mut self) -> Option<Pixel> {
        loop {
            if let Some(span) = &mut self.span {
                let pixel = span.pixels.next();
                let end = pixel.map_or(span.bottom, |pixel| pixel.y) + 1;
                self.work.rasterization += u64::from(end - span.row) * self.costs.row;
                span.row = end;
                if pixel.is_some() {
                    self.work.rasterization += self.costs.pixel;
                    return pixel;
                }
                self.span = None;
            } else if let Some(packet) = self.rest.next() {
                let packet = &self.packets[packet];
                let bottom = packet.bounds.bottom;
                self.work.rasterization += self.costs.set_up;
                self.span = Some(Spans { pixels: Pixels::of(packet), row: bottom + 1 - rows(packet), bottom });
            } else {
                let polygon = self.polygons.next()?;
                self.work.geometry += self.costs.geometry(polygon);
                self.work.rasterization += self.costs.preparation(polygon);
                self.rest = polygon.packets.clone();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vc1::assignment::{Assign, Assignment};
    use crate::vc1::config::Config;
    use tilewright_scenes::{Projection, Scene, ScreenVertex, Size, project, set_up};

    /// A triangle of 3 pixels, in a box of 3 rows of which the last has none; a polygon without packets; a triangle of 1 pixel.
    #[test]
    fn every_clock_of_the_cost_table_is_charged_once() {
        let at = |x, y| ScreenVertex { x, y, z: 1, rgb: [0; 3] };
        let size = Size::new(8, 8).expect("in range");
        let packets = [
            set_up(&[at(0, 0), at(40, 0), at(0, 40)], size).expect("covers pixels"),
            set_up(&[at(0, 48), at(20, 48), at(0, 68)], size).expect("covers a pixel"),
        ];
        // The first has three vertices, the last one more and a packet that crosses the border.
        let polygons = [(0, 0..1, 3, 0), (1, 1..1, 0, 0), (2, 1..2, 1, 1)]
            .map(|(number, packets, vertices, clipped)| Polygon { number, packets, vertices, clipped });
        let costs = CostTable {
            vertex: 1_000_000,
            polygon: 20_000_000,
            area: 10_000,
            clip: 500_000,
            set_up: 1000,
            row: 100,
            pixel: 5,
            clear: 3,
        };
        let mut program = Program::new(costs, &packets, &polygons, 2);
        let mut steps = Vec::new();
        while steps.last().is_none_or(|(_, access)| *access != "end") {
            let Step { clocks, access } = program.step();
            steps.push((
                clocks,
                match access {
                    Some(Access::Clear(_)) => "clear",
                    Some(Access::Draw(_)) => "draw",
                    None => "end",
                },
            ));
        }
        let expected = [
            (3, "clear"),
            (3, "clear"),
            (23_011_105, "draw"),
            (5, "draw"),
            (105, "draw"),
            (41_521_205, "draw"),
            (0, "end"),
        ];
        assert_eq!(steps, expected);
        assert_eq!(program.work, Work { clear: 6, geometry: 64_000_000, rasterization: 532_420 });
        assert_eq!(program.step(), Step { clocks: 0, access: None });
    }

    /// The views of ter1k that Table 1 averages, 7.5 degrees apart (VC1-T1).
    fn views() -> Vec<Projection> {
        let mut scene = Scene::builtin("ter1k").expect("a built-in scene");
        let camera = scene.camera;
        let view = |number: u32| {
            scene.camera = camera.orbited(7.5 * f64::from(number));
            project(&scene, scene.size).expect("the terrain is in sight")
        };
        (0..48).map(view).collect()
    }

    /// What the program of each processing element takes, cleared tables apart.
    fn works(config: &Config, assignment: &Assignment, view: &Projection) -> Vec<Work> {
        let work = |polygons: &Vec<Polygon>| {
            let mut program = Program::new(config.costs, &view.triangles, polygons, 0);
            while program.step().access.is_some() {}
            program.work
        };
        assignment.polygons.iter().map(work).collect()
    }

    /// Milliseconds at 40 MHz for which a processing element waits for the last one, as a mean over all of them and all views.
    fn waiting(config: &Config, views: &[Projection], first: usize) -> f64 {
        let first = config.assignment(&views[first], None).expect("the first");
        let clocks = |view: &Projection| {
            let assignment = config.assignment(view, Some(&first)).expect("of the same scene");
            let each: Vec<u64> = works(config, &assignment, view).iter().map(Work::total).collect();
            let last = each.iter().max().copied().unwrap_or_default();
            each.iter().map(|clocks| last - clocks).sum::<u64>()
        };
        let all = views.iter().map(clocks).sum::<u64>() as f64;
        all / (views.len() * config.processors as usize) as f64 / 40_000.0
    }

    #[test]
    fn ter1k_takes_the_clocks_of_table_1() {
        let (mut work, mut polygons) = (Work::default(), 0);
        for view in views() {
            let config = Config::new(view.size);
            for of in works(&config, &config.assignment(&view, None).expect("the first"), &view) {
                work.geometry += of.geometry;
                work.rasterization += of.rasterization;
            }
            polygons += view.counts.polygons;
        }
        let each = [work.geometry, work.rasterization].map(|clocks| clocks as f64 / f64::from(polygons));
        assert_eq!(each.map(f64::round), [631.0, 754.0], "{each:?}");
    }

    /// The figures of [`crate::vc1::assignment`].
    #[test]
    #[ignore = "50 times 48 views of a terrain"]
    fn each_way_of_dealing_has_its_waiting_time() {
        let views = views();
        let of = |assign, first| waiting(&Config { assign, ..Config::new(views[0].size) }, &views, first);
        let (each, count) = (of(Assign::Each, 0), of(Assign::Count, 0));
        let mut once: Vec<f64> = (0..views.len()).map(|first| of(Assign::Once, first)).collect();
        print!("each {each:.2} ms, count {count:.2} ms, once {:.2} ms from the first view, ", once[0]);
        once.sort_by(f64::total_cmp);
        let mean = once.iter().sum::<f64>() / once.len() as f64;
        println!("from any view {:.2} to {:.2} ms, {mean:.2} ms as a mean", once[0], once[once.len() - 1]);
        let shown = [each, count, once[0], mean, once[once.len() - 1]].map(|it| format!("{it:.2}"));
        assert_eq!(shown, ["0.62", "1.01", "1.17", "1.68", "2.46"]);
    }
}

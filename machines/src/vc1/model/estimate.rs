//! The paper's estimate beyond 16 processing elements (VC1-EST): each alone, first without broadcast polygons, then with all of them.
//!
//! A logical processing element runs its own polygons with its own local frame buffer and the merger of the whole machine, and waits for no other.
//! In the second pass it sends its own polygons above the threshold, and the host sends those of all others after its command. The slowest one
//! counts.

use std::sync::Arc;

use super::host::Run;
use super::{Dealt, Model};
use crate::vc1::config::Config;
use crate::vc1::host::Loaded;
use crate::vc1::job::View;
use crate::vc1::program::Settings;
use crate::vc1::report::Report;
use crate::vc1::words::Message;

/// The results of the paper's two passes for a still view. A report has one processing element.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// By processing element, without the polygons that all draw.
    pub own: Vec<Report>,
    /// By processing element, with all of them.
    pub with_broadcast: Vec<Report>,
}

impl Estimate {
    /// The second pass of the processing element whose last frame is shown last; between equals, of the one that drew longest.
    ///
    /// # Panics
    /// There was no frame.
    pub fn slowest(&self) -> &Report {
        let time = |report: &&Report| {
            let last = report.frames.last().expect("a frame");
            (last.times.shown, last.processors[0].clocks.busy())
        };
        self.with_broadcast.iter().max_by_key(time).expect("a machine has a processing element")
    }
}

impl Model {
    /// The paper's estimate for frames of a still view.
    pub fn estimate(&self, view: &Dealt, frames: usize) -> Estimate {
        let numbers = || 0..self.config.processors;
        let own = Model { config: Config { apr: None, ..self.config }, ..self.clone() };
        let without = view.without_broadcast(self);
        let scene = Loaded::of(&view.0.projection);
        let with = |k| self.alone(view, scene, k, &view.broadcast(self, k), frames);
        Estimate {
            own: numbers().map(|k| own.alone(&without, scene, k, &[], frames)).collect(),
            with_broadcast: numbers().map(with).collect(),
        }
    }

    /// A processing element alone, to which the host sends those packets after each command.
    fn alone(&self, view: &Dealt, scene: Loaded, processor: u32, packets: &[Message], frames: usize) -> Report {
        let run = Run::of(self, processor..processor + 1, packets, Some(scene), |_| {});
        self.report(run, std::iter::repeat_n(view.clone(), frames))
    }
}

impl Dealt {
    /// The polygons above the threshold of all other processing elements, as packets.
    fn broadcast(&self, model: &Model, processor: u32) -> Vec<Message> {
        let Dealt(view) = self;
        let others = (0..model.config.processors).filter(|it| *it != processor);
        let packets = others.flat_map(|sender| {
            let packets = view.polygons(sender).iter().flat_map(|it| it.packets.clone());
            packets.map(move |packet| (sender, packet))
        });
        let large = packets.filter(|(_, at)| Settings::is_large(model.config.apr, &view.projection.triangles[*at]));
        large.map(|(sender, at)| Message::Polygon { sender, vertices: view.projection.vertices[at] }).collect()
    }

    /// The same view, in which polygons above the threshold have geometry but nothing to draw.
    fn without_broadcast(&self, model: &Model) -> Dealt {
        let Dealt(view) = self;
        let mut assignment = view.assignment.clone();
        for polygon in assignment.polygons.iter_mut().flatten() {
            let is_large = |at: usize| Settings::is_large(model.config.apr, &view.projection.triangles[at]);
            if polygon.packets.clone().any(is_large) {
                polygon.packets = 0..0;
            }
        }
        Dealt(Arc::new(View { assignment, projection: view.projection.clone() }))
    }
}

#[cfg(test)]
mod tests;

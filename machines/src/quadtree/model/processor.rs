//! The clocks of a video processor: its queue, its set-up and its stages (MPG-ARCH).

use super::division::{Course, Unit, Work};
use super::line::{self, Pixels, Queued, Stack, Stage};
use super::queue::Queue;
use super::record::{self, Counts, Visit};
use super::tree::Tree;
use crate::quadtree::windows::Window;
use tilewright_rtl::quadtree::raster::{Form, Part};

/// The sizes of a video processor's queues.
#[derive(Clone, Copy)]
pub(super) struct Depths {
    pub packets: usize,
    pub windows: usize,
}

/// A video processor.
pub(super) struct VideoProcessor<'a> {
    course: Course<'a>,
    root: Window,
    queue: Queue<u32>,
    set_up: Counts,
    /// The clock in which the set-up sent its last root.
    end: u64,
    visits: Option<Vec<Visit>>,
    stages: Vec<Stage>,
}

impl<'a> VideoProcessor<'a> {
    /// The fewest clocks of the set-up, one for each plane.
    const LEAST_SET_UP: u64 = Course::PARAMETERS;

    pub fn new(
        course: Course<'a>,
        form: &Form,
        root: Window,
        depths: Depths,
        keeps_visits: bool,
    ) -> VideoProcessor<'a> {
        VideoProcessor {
            course,
            root,
            queue: Queue::new(depths.packets),
            set_up: Counts::default(),
            end: 0,
            visits: keeps_visits.then(Vec::new),
            stages: stages(form, depths.windows, keeps_visits),
        }
    }

    /// The clock in which it takes a packet that is offered from a clock on.
    pub fn take(&mut self, packet: u32, offered: u64) -> u64 {
        let mut clock = offered;
        if self.queue.is_full() {
            clock = clock.max(self.set_up_oldest().map_or(0, |left| left + 1));
        }
        self.queue.push(packet, clock);
        clock
    }

    /// Takes a packet that is offered in a clock and sets it up, as if the queue were unlimited.
    pub fn take_at_once(&mut self, packet: u32, offered: u64) {
        self.queue.push(packet, offered);
        self.set_up_oldest();
    }

    /// Finishes the remaining work.
    pub fn finish(&mut self) {
        while self.set_up_oldest().is_some() {}
        line::finish(&mut self.stages, &self.course);
    }

    /// Sets up the oldest packet of the queue. Returns the clock in which its root was sent and it left the queue.
    fn set_up_oldest(&mut self) -> Option<u64> {
        let (packet, since) = self.queue.pop()?;
        let work = Work { packet, window: self.root };
        let busy = VideoProcessor::LEAST_SET_UP.max(self.course.polygon(work).edges.len() as u64);
        let taken = self.end.max(since);
        let offered = taken + busy;
        let sent = line::take(&mut self.stages, &self.course, work, offered);
        self.set_up += Counts { busy, stalled: sent - offered, results: 1 };
        self.end = sent;
        if let Some(visits) = &mut self.visits {
            visits.push(Visit { unit: 0, packet, window: self.root, taken, sent: vec![sent], ended: sent });
        }
        Some(sent)
    }

    /// The first clock after all its work.
    pub fn idle(&self) -> u64 {
        self.stages.iter().map(Stage::idle).fold(self.end + 1, u64::max)
    }

    /// Its record.
    pub fn into_record(self) -> (record::Processor, Vec<Visit>) {
        let levels = self.course.search.matrix().levels as usize;
        let mut units = vec![Counts::default(); levels + 1];
        units[0] = self.set_up;
        let (mut visits, mut fragments) = (self.visits.unwrap_or_default(), 0);
        for stage in self.stages {
            fragments += stage.hand_over(&mut units, &mut visits);
        }
        (record::Processor { units, fragments }, visits)
    }
}

/// The stages of a form, each queue of that depth, and the pixel processor.
fn stages(form: &Form, depth: usize, keeps_visits: bool) -> Vec<Stage> {
    let (mut stages, mut level) = (Vec::new(), 1);
    for part in form.parts() {
        let levels = part.levels();
        let unit = |level, levels| Unit::new(level, levels, keeps_visits);
        match part {
            Part::Stack(_) => stages.push(Stage::Stack(Stack::new(unit(level, levels)))),
            // A tree of one level is just its unit.
            Part::Pipe(_) | Part::Tree(1) => {
                stages.extend((level..level + levels).map(|level| Stage::Unit(Queued::new(depth, unit(level, 1)))));
            }
            Part::Tree(_) => stages.push(Stage::Tree(Tree::new(level, levels, depth, keeps_visits))),
        }
        level += levels;
    }
    stages.push(Stage::Pixels(Pixels::default()));
    stages
}

//! A renderer: its queue, its controller, and the backing store that sends the region before.

use tilewright_rtl::pixel_planes::fields;
use tilewright_rtl::pixel_planes::schedule::{Schedule, Step};

use super::timing::RendererTiming;

pub(super) struct Renderer<'a> {
    queue: usize,
    /// Planes of a region.
    planes: usize,
    /// Clocks from the first bit of a save until the first plane can be sent.
    save_to_plane: u64,
    controller: Schedule,
    /// The instructions that its region still has to receive, and the clock in which it got the region.
    steps: std::slice::Iter<'a, Step>,
    given: u64,
    /// The save of its region, once it has arrived, with the first clock in which it is taken if the store is free.
    save: Option<(&'a Step, u64)>,
    /// Planes of the last saved region that are not sent yet.
    to_send: usize,
    /// The first clock in which the store is free, if nothing is left to send.
    free: u64,
    pub timing: RendererTiming,
}

impl<'a> Renderer<'a> {
    /// A renderer with pixels `lag` clocks behind its controller.
    pub fn new(side: u32, queue: u32, lag: u32, side_by_side: bool) -> Renderer<'a> {
        let word = fields::WORD.bits;
        Renderer {
            queue: queue as usize,
            planes: (side * word) as usize,
            // Its bits have passed the pixels' pipeline, and the first plane is read.
            save_to_plane: u64::from(lag + word + 1),
            controller: Schedule::new(side_by_side),
            steps: [].iter(),
            given: 0,
            save: None,
            to_send: 0,
            free: 0,
            timing: RendererTiming::default(),
        }
    }

    /// Gets a region in that clock.
    pub fn begin(&mut self, region: usize, steps: &'a [Step], now: u64) {
        self.steps = steps.iter();
        self.given = now;
        self.timing.begin(region, now);
    }

    /// The first clock in which its queue has space for the next instruction of its region, if there is one.
    pub fn room(&self) -> Option<u64> {
        if self.steps.len() == 0 {
            return None;
        }
        let RendererTiming { arrived, taken, .. } = &self.timing;
        let behind = arrived.last().map_or(0, |clock| clock + 1);
        let leaves = arrived.len().checked_sub(self.queue).map_or(0, |oldest| taken[oldest] + 1);
        Some(behind.max(leaves))
    }

    /// The next instruction arrives in that clock, and is visible in the next one.
    pub fn receive(&mut self, now: u64) {
        let step = self.steps.next().expect("there was one to send");
        // The first instruction of a region cannot be visible sooner.
        let ready = self.controller.ready(step).max(self.given + 2);
        self.timing.arrive(now, ready);
        let could = ready.max(now + 1);
        if step.saves {
            self.save = Some((step, could));
        } else {
            self.take(step, could);
        }
    }

    fn take(&mut self, step: &Step, clock: u64) -> u64 {
        let times = self.controller.take_at(step, clock);
        self.timing.take(times);
        times.begins
    }

    /// If the save of its region has arrived and the store is free: the clock in which the first plane can be sent, and the one from which on it can
    /// get another region.
    pub fn save(&mut self) -> Option<(u64, u64)> {
        let (step, could) = self.save.take_if(|_| self.to_send == 0)?;
        let clock = could.max(self.free);
        let shown = self.take(step, clock) + self.save_to_plane;
        self.to_send = self.planes;
        let idle = self.controller.idle();
        self.timing.end(clock - could, shown, idle);
        Some((shown, idle))
    }

    /// Sends the next plane in that clock; true if a line ends with it.
    pub fn send(&mut self, now: u64) -> bool {
        self.timing.planes.push(now);
        self.to_send -= 1;
        self.free = now + 1;
        self.to_send.is_multiple_of(fields::WORD.bits as usize)
    }

    /// There are planes to send.
    pub fn is_sending(&self) -> bool {
        self.to_send > 0
    }
}

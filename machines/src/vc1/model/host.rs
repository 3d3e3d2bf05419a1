//! The host's program, and the sequence of all events. No event comes before its causes.
//!
//! At an edge with several events, the bus comes first, because it sees the processing elements' offers before that edge.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;

use tilewright_rtl::swap::SwapState;

use super::Model;
use super::bus::Bus;
use super::due::Due;
use super::event::{Event, Place, What};
use super::lfb::Lfb;
use super::merger::{Merger, Showing};
use super::processor::Element;
use super::timing::PE_PERIOD;
use crate::vc1::host::Loaded;
use crate::vc1::job::{View, Views};
use crate::vc1::processor::{Processor, Shared};
use crate::vc1::program::Settings;
use crate::vc1::report::{FrameReport, ProcessorReport, Times};
use crate::vc1::words::{Message, Word};

mod ahead;

/// A run of the model.
pub(crate) struct Run<'a, S> {
    model: &'a Model,
    views: Views,
    elements: Vec<Element>,
    /// The next edges of processing elements, except of those that lag.
    due: Due,
    /// The number that have drawn their frame.
    ready: usize,
    bus: Bus,
    merger: Merger,
    /// T_m in clocks of the processing elements.
    merge_clocks: u64,
    /// Words after each command.
    packets: Vec<Word>,
    /// Words of the current command, after the one that the host offers.
    words: VecDeque<Word>,
    /// The last edge at which the bus did something.
    carried: u64,
    /// The polygons that are in the queues.
    polygons: VecDeque<Shared>,
    scene: Option<Loaded>,
    /// Frames that are commanded and not shown yet.
    frames: VecDeque<Frame>,
    commanded: u32,
    /// The edge at which the host may command the next frame.
    may_command: Option<u64>,
    /// The frame that is shown next.
    showing: Option<Showing>,
    /// The refresh of the last frame that was shown.
    refresh: u64,
    /// The last edge of the current part of the run.
    until: u64,
    pub shown: VecDeque<FrameReport>,
    seen: S,
}

/// A frame from its command until it is shown.
struct Frame {
    number: u32,
    view: Arc<View>,
    times: Times,
    pages: Vec<u32>,
    words: u64,
}

impl<'a, S: FnMut(Event)> Run<'a, S> {
    /// A run that begins after the reset.
    pub fn new(model: &'a Model, seen: S) -> Run<'a, S> {
        Run::of(model, 0..model.config.processors, &[], None, seen)
    }

    /// A run of these processing elements, in a machine without waits for others. The host sends those packets after each command. `scene` is
    /// that of the views, if it has been counted.
    pub(super) fn of(
        model: &'a Model,
        numbers: Range<u32>,
        packets: &[Message],
        scene: Option<Loaded>,
        seen: S,
    ) -> Run<'a, S> {
        let config = &model.config;
        let (patches, views) = (model.vc1.lfb.patches, Views::default());
        let reset = model.reset / PE_PERIOD;
        let element = |number| {
            let settings = Settings::of(config, number, patches.count());
            let lfb = Lfb::new(patches.count(), model.vc1.lfb.pages);
            Element::new(number, Processor::new(settings, views.clone()), lfb, patches, config.costs.clear, reset)
        };
        let elements: Vec<Element> = numbers.map(element).collect();
        let mut due = Due::new(elements.len());
        elements.iter().zip(0..).for_each(|(it, k)| due.set(k, it.due));
        let merger = Merger::new(&model.vc1, elements.len() as u32, config.accumulate);
        Run {
            due,
            bus: Bus::new(elements.len(), config.queue, config.word_clocks),
            merge_clocks: model.vc1.lfb_swap().merge_clocks,
            model,
            views,
            elements,
            ready: 0,
            merger,
            packets: packets.iter().flat_map(Message::words).collect(),
            words: VecDeque::new(),
            carried: 0,
            polygons: VecDeque::new(),
            scene,
            frames: VecDeque::new(),
            commanded: 0,
            may_command: Some(reset),
            showing: None,
            refresh: 0,
            until: 0,
            shown: VecDeque::new(),
            seen,
        }
    }

    pub fn scene(&self) -> Loaded {
        self.scene.unwrap_or_default()
    }

    /// The command of a frame of that view, if the host may command one by now.
    pub fn command(&mut self, view: Arc<View>) {
        let edge = self.may_command.take().expect("the frame before is drawn");
        let scene = *self.scene.get_or_insert_with(|| Loaded::of(&view.projection));
        let number = self.commanded;
        let packets = Message::begin(number, self.model.config.immediate.then_some(scene.words));
        self.words = packets.iter().flat_map(Message::words).chain(self.packets.iter().copied()).collect();
        // At the first command the display's clock may have an edge after the last one of the processing elements.
        let time = if number == 0 { self.model.reset } else { edge * PE_PERIOD };
        let times = Times { command: time, ..Times::default() };
        self.views.insert(number, view.clone());
        self.frames.push_back(Frame { number, view, times, pages: Vec::new(), words: self.words.len() as u64 });
        self.commanded += 1;
        self.offer_command(edge);
    }

    fn offer_command(&mut self, edge: u64) {
        if let Some(word) = self.words.pop_front() {
            self.bus.offer(self.elements.len(), word, edge);
        }
    }

    /// Whether the host waits only for another view.
    pub fn may_command(&self) -> bool {
        self.may_command.is_some()
    }

    /// The edge just before the end of a blanking, not before that one; and that of the first pixel after it.
    pub fn refresh_from(&self, edge: u64) -> (u64, u64) {
        self.merger.display.dawn_from(edge)
    }

    /// Runs all events until that edge, or with `pauses` until the host may command a frame.
    pub fn advance(&mut self, until: u64, pauses: bool) {
        self.until = until;
        while !(pauses && self.may_command()) {
            let due = self.due.edge();
            let line = self.line();
            let shows = self.showing.map_or(u64::MAX, |it| it.shown);
            let edge = due.min(line).min(self.bus.next).min(shows);
            if edge > until || edge == u64::MAX {
                let mut goes_on = false;
                for k in 0..self.elements.len() {
                    goes_on |= self.catch_up(k);
                }
                if !goes_on {
                    return;
                }
                continue;
            }
            if self.bus.next == edge {
                self.carry(edge);
            } else if due == edge {
                self.process(self.due.first());
            } else if line == edge {
                self.end_frame(edge);
            } else {
                self.show();
            }
        }
    }

    /// The edge at which all see the sync line, unless something happens before.
    fn line(&self) -> u64 {
        if self.ready < self.elements.len() || !self.bus.is_idle() {
            return u64::MAX;
        }
        let last = self.elements.iter().map(Element::lets_go).max().unwrap_or_default();
        last.max(self.carried + 1)
    }

    /// An edge at which the bus does something.
    fn carry(&mut self, edge: u64) {
        let carried = self.bus.go();
        self.carried = edge;
        let host = self.elements.len();
        if let Some((sender, word)) = carried.takes {
            let what = What::Carries(sender as u32, word.word);
            (self.seen)(Event { clock: edge, place: Place::Bus, what });
            if sender == host {
                self.offer_command(edge);
            } else {
                self.take_from(sender, edge);
            }
        }
        if carried.delivers {
            self.share();
            self.wake();
        }
    }

    /// The bus takes the word that a processing element offers.
    fn take_from(&mut self, k: usize, edge: u64) {
        let until = std::mem::replace(&mut self.until, edge - 1);
        self.catch_up(k);
        self.until = until;
        if self.elements[k].waits_for_bus() {
            self.go(k, edge, false, true);
        } else {
            self.elements[k].program.taken_by_bus();
            self.plan(k);
        }
    }

    /// Finds the next edge of a processing element.
    fn plan(&mut self, k: usize) {
        let element = &mut self.elements[k];
        element.plan(self.bus.coming(k, 0).map(|(_, came)| came));
        let is_early = element.program.is_unseen() || !self.bus.is_complete(k);
        element.lags = element.may_lag() && is_early && self.bus.knows_room();
        self.due.set(k, if element.lags { u64::MAX } else { element.due });
    }

    /// An edge of a processing element, with all its effects.
    fn go(&mut self, k: usize, edge: u64, is_due: bool, sent: bool) {
        self.pass(k, edge, is_due, sent);
        self.plan(k);
    }

    /// An edge of a processing element, with all its effects except its next edge.
    fn pass(&mut self, k: usize, edge: u64, is_due: bool, sent: bool) {
        let element = &mut self.elements[k];
        let was_ready = element.is_ready();
        let [front, _] = self.bus.queue(k, edge - 1);
        element.program.see(front);
        let done = element.go(edge, is_due, sent, self.bus.queue(k, edge), &mut self.seen);
        if done.received {
            self.bus.receive(k, edge);
        }
        if let Some(word) = done.offers {
            self.bus.offer(k, word, edge);
        }
        if done.cleared {
            element.clear_ahead(self.until, &mut self.seen);
        }
        let is_ready = element.is_ready();
        self.ready = self.ready + usize::from(is_ready) - usize::from(was_ready);
        match done.swapped {
            Some(state) => self.swapped(k, edge, state),
            None => self.allow_swap(k, edge + 1),
        }
    }

    /// A processing element has swapped.
    fn swapped(&mut self, k: usize, edge: u64, state: SwapState) {
        let element = &mut self.elements[k];
        element.waited = edge + 1 + self.merge_clocks;
        element.sent = self.merger.sent(element.number, edge);
        if state != SwapState::Due {
            return;
        }
        element.frames += 1;
        let Some(showing) = self.merger.end(edge) else { return };
        let frame = self.frames.front_mut().expect("its frame ends");
        frame.times.swapped = Some(edge * PE_PERIOD);
        self.showing = Some(showing);
        for k in 0..self.elements.len() {
            self.allow_swap(k, edge + 1);
            self.plan(k);
        }
    }

    /// Finds the swap of a waiting processing element, from that clock on, if all its conditions are known.
    fn allow_swap(&mut self, k: usize, clock: u64) {
        let element = &mut self.elements[k];
        if element.is_halted() && element.swap.is_none() && element.frames == self.merger.shown {
            let guards = element.waited.max(element.sent).max(self.merger.shown_from);
            element.swap = Some(clock.max(guards));
        }
    }

    /// All have drawn the frame.
    fn end_frame(&mut self, edge: u64) {
        for k in 0..self.elements.len() {
            self.go(k, edge, true, false);
        }
        let frame = self.frames.back_mut().expect("a frame was commanded");
        frame.times.drawn = Some(edge * PE_PERIOD);
        frame.pages = self.elements.iter().map(|it| it.lfb.used).collect();
        self.may_command = Some(edge);
    }

    /// The banks change.
    fn show(&mut self) {
        let showing = self.showing.take().expect("a frame is shown");
        let frame = self.frames.pop_front().expect("a frame is shown");
        let what = What::Shows(frame.number + 1);
        for what in [what, What::Restarts] {
            (self.seen)(Event { clock: showing.edge, place: Place::Merger, what });
        }
        let [merged, shown] = [showing.merged, showing.shown].map(|edge| Some(edge * PE_PERIOD));
        let averaged = showing.averaged.map(|edge| edge * PE_PERIOD);
        let times = Times { merged, shown, averaged, ..frame.times };
        let refreshes = showing.refresh - std::mem::replace(&mut self.refresh, showing.refresh);
        let processor = |(element, pages): (&Element, u32)| {
            let tally = &element.program.frames()[frame.number as usize];
            ProcessorReport::of(&frame.view, element.number, tally, pages)
        };
        let processors = self.elements.iter().zip(frame.pages).map(processor).collect();
        self.views.remove(frame.number);
        self.shown.push_back(FrameReport::of(&frame.view, frame.words, times, refreshes, processors));
    }
}

//! Processing elements ahead of the others, or behind.
//!
//! A processing element goes ahead while all its inputs are known, and its actions do not matter to others. Then it draws, or receives and sets up
//! packets in its queue. A processing element that waits for a word stays behind until the word matters to others. That is so if
//!
//! - the bus has to know whether its queue has space,
//! - the bus takes the word that it offers,
//! - or a packet has arrived completely, and the processing element has more work in its frame.

use super::{Event, Run};
use crate::vc1::processor::Shared;
use crate::vc1::words::{Message, POLYGON_WORDS};

impl<S: FnMut(Event)> Run<'_, S> {
    /// Notes the polygon that has completely arrived in the queues, if there is one.
    pub(super) fn share(&mut self) {
        while self.polygons.front().is_some_and(|it| !self.bus.keeps(it.first)) {
            self.polygons.pop_front();
        }
        if let Some((first, words)) = self.bus.last_packet(POLYGON_WORDS)
            && let Some(Message::Polygon { sender, vertices }) = Message::of_words(&words)
            && let Some(packet) = self.views.set_up(&vertices, self.model.config.size)
        {
            let (top, bottom) = (packet.bounds.top, packet.bounds.bottom);
            self.polygons.push_back(Shared { first, sender, top, bottom, came: self.carried });
        }
    }

    /// A word has arrived in all queues: processing elements to which it matters go on.
    pub(super) fn wake(&mut self) {
        let (knows_room, is_packet) = (self.bus.knows_room(), self.bus.was_last());
        for k in 0..self.elements.len() {
            let is_only_one = self.bus.has_one(k);
            if knows_room && !is_packet && !is_only_one {
                continue;
            }
            let element = &self.elements[k];
            let goes_on = match element.lags {
                true if element.program.is_unseen() => !knows_room,
                true => !knows_room || is_packet,
                false => is_only_one && element.looks_at_queue(),
            };
            if goes_on {
                self.plan(k);
                if self.elements[k].due < self.carried {
                    self.process(k);
                }
            }
        }
    }

    /// Advances a processing element that is behind, to the time of the others. Returns whether it did.
    pub(super) fn catch_up(&mut self, k: usize) -> bool {
        let mut goes_on = false;
        if self.elements[k].lags {
            self.plan(k);
            while self.elements[k].due <= self.until && self.elements[k].due < u64::MAX {
                self.process(k);
                goes_on = true;
            }
        }
        goes_on
    }

    /// Runs the next edge of a processing element, and then all edges that follow from known data, until that edge at most.
    pub(super) fn process(&mut self, k: usize) {
        loop {
            if !self.receive_ahead(k) {
                self.pass(k, self.elements[k].due, false, false);
                self.go_ahead(k);
                self.receive_ahead(k);
            }
            let element = &mut self.elements[k];
            element.plan(self.bus.coming(k, 0).map(|(_, came)| came));
            let is_known = |words| self.bus.coming(k, words - 1).is_some();
            let is_seen = element.due > self.until || element.due >= self.bus.takes_from(k);
            if is_seen || !element.looks_ahead().is_some_and(is_known) {
                break;
            }
        }
        self.plan(k);
    }

    /// Advances a processing element while it is independent of others.
    fn go_ahead(&mut self, k: usize) {
        let element = &mut self.elements[k];
        element.plan(None);
        while element.is_by_itself() && element.due <= self.until {
            let front = element.program.front();
            let done = element.go(element.due, false, false, [front; 2], &mut self.seen);
            if done.cleared {
                element.clear_ahead(self.until, &mut self.seen);
            }
            element.plan(None);
        }
    }

    /// A processing element receives the words in its queue. Returns whether it does.
    fn receive_ahead(&mut self, k: usize) -> bool {
        let (element, before) = (&mut self.elements[k], self.bus.next_of(k));
        element.skip_ahead(&mut self.bus, k, &self.polygons, self.until, &mut self.seen);
        element.receive_ahead(&mut self.bus, k, self.until, &mut self.seen);
        self.bus.next_of(k) > before
    }
}

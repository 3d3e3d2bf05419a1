//! A processing element: the machine's own program, event-driven, with a local frame buffer of the model.

use std::collections::VecDeque;

use tilewright_rtl::lfb::Patches;
use tilewright_rtl::swap::SwapState;

use super::bus::Bus;
use super::event::{Event, Place, What};
use super::lfb::{CLEAR_CLOCKS, Lfb};
use crate::vc1::processor::{Edge, Now, Processor, Shared};
use crate::vc1::program::Access;
use crate::vc1::words::{POLYGON_WORDS, Word};

/// A processing element with its local frame buffer.
pub(super) struct Element {
    pub number: u32,
    pub program: Processor,
    pub lfb: Lfb,
    patches: Patches,
    /// The binary logarithm of a patch's side, and the patches in a row.
    edge: u32,
    columns: u32,
    /// Clocks of a cleared entry.
    clear_clocks: u64,
    /// Its last edge so far.
    at: u64,
    /// Whether its next edges do not matter to others until a packet has arrived completely, so that it may be behind.
    pub lags: bool,
    /// The next edge at which more happens than the passing of a clock.
    pub due: u64,
    /// The edge of its swap, once that is known.
    pub swap: Option<u64>,
    /// The first clock in which T_m has passed since its last swap, and the first in which it knows that its back buffer is sent.
    pub waited: u64,
    pub sent: u64,
    /// The number of frames that it has ended.
    pub frames: u32,
    /// The edge since which it says that it has drawn its frame.
    pub ended: Option<u64>,
}

/// The actions of a processing element at an edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Done {
    /// It took a word from its queue.
    pub received: bool,
    /// It offers another word to the bus.
    pub offers: Option<Word>,
    /// It cleared an entry, except the last one.
    pub cleared: bool,
    /// It swapped, at the end of a frame or in an overflow.
    pub swapped: Option<SwapState>,
}

impl Element {
    /// A processing element after a reset until that edge.
    pub fn new(number: u32, program: Processor, lfb: Lfb, patches: Patches, clear_clocks: u64, at: u64) -> Element {
        let mut element = Element {
            number,
            program,
            lfb,
            edge: patches.edge().ilog2(),
            columns: patches.columns(),
            patches,
            clear_clocks,
            at,
            lags: false,
            due: u64::MAX,
            swap: None,
            waited: 0,
            sent: 0,
            frames: 0,
            ended: None,
        };
        element.plan(None);
        element
    }

    /// Whether it waits for a swap.
    pub fn is_halted(&self) -> bool {
        self.program.is_halted()
    }

    /// Whether it has drawn its frame, and nothing delays that.
    pub fn is_ready(&self) -> bool {
        self.ended.is_some() && self.lfb.overflows.is_none()
    }

    /// The first clock in which it releases the sync line.
    pub fn lets_go(&self) -> u64 {
        self.ended.map_or(u64::MAX, |edge| (edge + 1).max(self.lfb.idle_from()))
    }

    /// Whether a word in its empty queue changes its actions.
    pub fn looks_at_queue(&self) -> bool {
        let looks = matches!(self.program.now(), Now::Waiting | Now::Accessing(Access::Send(_) | Access::Receive));
        looks && !self.is_halted()
    }

    /// Whether it reacts at once when the bus takes its word.
    pub fn waits_for_bus(&self) -> bool {
        matches!(self.program.now(), Now::Waiting | Now::Accessing(Access::Send(_))) && !self.is_halted()
    }

    /// Whether its next edge does not matter to others, nor the actions of others to it.
    pub fn is_by_itself(&self) -> bool {
        !self.is_halted() && self.lfb.overflows.is_none() && self.program.is_by_itself()
    }

    /// The number of words of its queue that have to be known for its next edge, if that edge needs nothing else and does not matter to others.
    pub fn looks_ahead(&self) -> Option<u64> {
        let words = match self.program.now() {
            Now::Waiting | Now::Computing(_, _, None) => 1,
            Now::Accessing(Access::Send(_)) if self.program.offered().is_some() => 1,
            Now::Computing(_, _, Some(Access::Receive)) | Now::Accessing(Access::Receive) => 2,
            _ => return None,
        };
        let is_seen = self.is_halted() || self.lfb.overflows.is_some();
        (!is_seen).then_some(words)
    }

    /// Finds its next edge. `came` is the edge at which its next word arrived in the queue, if it has.
    pub fn plan(&mut self, came: Option<u64>) {
        let next = self.at + 1;
        let word = came.map_or(u64::MAX, |edge| edge.max(next));
        let due = match self.program.now() {
            _ if self.is_halted() => self.swap.unwrap_or(u64::MAX),
            Now::Waiting => word,
            Now::Computing(left, _, Some(Access::Clear(_))) => self.lfb.takes_clear(next + left),
            Now::Computing(left, _, Some(Access::Draw(_))) => self.lfb.takes_draw(next + left),
            Now::Computing(left, ..) => self.at + left,
            Now::Accessing(Access::Clear(_)) => self.lfb.takes_clear(next),
            Now::Accessing(Access::Draw(_)) => self.lfb.takes_draw(next),
            Now::Accessing(Access::Send(_)) if self.program.offered().is_none() || self.program.may_serve() => next,
            Now::Accessing(Access::Send(_)) if self.program.front().is_some() => u64::MAX,
            Now::Accessing(Access::Send(_)) => word,
            Now::Accessing(Access::Receive) => came.map_or(u64::MAX, |edge| next.max(edge + 1)),
        };
        self.due = due.min(self.lfb.overflows.unwrap_or(u64::MAX));
    }

    /// Runs an edge. `is_due`: the sync line is high. `sent`: the bus takes its word. `queue`: the first two words of its queue, after the action of
    /// the bus at this edge.
    pub fn go(
        &mut self,
        edge: u64,
        is_due: bool,
        sent: bool,
        queue: [Option<Word>; 2],
        seen: &mut impl FnMut(Event),
    ) -> Done {
        let mut tell = |what| seen(Event { clock: edge, place: Place::Processor(self.number), what });
        self.program.pass(edge - self.at - 1);
        self.at = edge;
        let (before, access) = (self.program.may(), self.program.access());
        let mut done = Done::default();
        let mut may = before;
        let mut taken = false;
        match access {
            Some(Access::Draw(pixel)) if self.lfb.takes_draw(edge) == edge => {
                taken = true;
                let patch = (pixel.y >> self.edge) * self.columns + (pixel.x >> self.edge);
                self.lfb.draw(edge, patch);
                tell(What::Draws(pixel.y * self.patches.screen().width + pixel.x));
            }
            Some(Access::Clear(patch)) if self.lfb.takes_clear(edge) == edge => {
                taken = true;
                self.lfb.clear(edge);
                tell(What::Clears(patch));
                if patch + 1 == self.patches.count() {
                    may = SwapState::Draw;
                    self.lfb.resume(edge);
                    tell(What::Resumes);
                } else {
                    done.cleared = true;
                }
            }
            _ => {}
        }
        if self.lfb.overflows == Some(edge) {
            self.lfb.overflows = None;
            may = SwapState::Overflow;
            tell(What::Overflows);
        } else if is_due {
            may = SwapState::Due;
            tell(What::Due);
        } else if self.swap == Some(edge) {
            self.swap = None;
            self.lfb.swap(edge);
            may = SwapState::Clear;
            done.swapped = Some(before);
            tell(What::Swaps);
        }
        done.received = self.program.receives() && self.program.front().is_some();
        if done.received {
            tell(What::Receives(queue[0].map_or(0, |word| word.word)));
        }
        let offered = self.program.offered().filter(|_| !sent);
        self.program.edge(Edge { taken, sent, may, front: queue[usize::from(done.received)] });
        done.offers = self.program.offered().filter(|_| offered.is_none());
        let has_ended = self.program.done();
        if has_ended && self.ended.is_none() {
            tell(What::Ends);
        }
        self.ended = has_ended.then(|| self.ended.unwrap_or(edge));
        done
    }

    /// Whether its actions do not matter to others before it has received a packet.
    pub fn may_lag(&self) -> bool {
        let receives = match self.program.now() {
            Now::Waiting | Now::Accessing(Access::Receive) | Now::Computing(_, _, Some(Access::Receive)) => true,
            Now::Accessing(Access::Send(_)) => self.program.offered().is_some(),
            _ => false,
        };
        receives && !self.is_halted() && self.lfb.overflows.is_none()
    }

    /// The first clock in which it would receive a word, if it is about to.
    fn receives_from(&self) -> Option<u64> {
        match self.program.now() {
            _ if self.is_halted() || self.lfb.overflows.is_some() => None,
            Now::Accessing(Access::Receive) => Some(self.at + 1),
            Now::Computing(left, _, Some(Access::Receive)) => Some(self.at + left + 1),
            _ => None,
        }
    }

    /// Receives at once the words of a packet in the queue of processing element `k`, except the last one, and none after that edge.
    pub fn receive_ahead(&mut self, bus: &mut Bus, k: usize, until: u64, seen: &mut impl FnMut(Event)) {
        let Some(clock) = self.receives_from() else { return };
        let (begin, place) = (self.at, Place::Processor(self.number));
        let every = self.program.receive_clocks();
        let packet = self.program.packet();
        let before = packet.len();
        bus.receive_ahead(k, clock, every, until, |word, clock| {
            seen(Event { clock, place, what: What::Receives(word) });
            packet.push(word);
            self.at = clock;
        });
        let words = packet.len() - before;
        if words > 0 {
            self.program.receive_ahead(words as u64, self.at - begin);
        }
    }

    /// Receives at once the rest of a polygon that has arrived completely and in which it has no row; nothing after that edge.
    pub fn skip_ahead(
        &mut self,
        bus: &mut Bus,
        k: usize,
        polygons: &VecDeque<Shared>,
        until: u64,
        seen: &mut impl FnMut(Event),
    ) {
        let Some(clock) = self.receives_from() else { return };
        let taken = self.program.packet().len() as u64;
        let first = bus.next_of(k) - taken;
        let next = polygons.partition_point(|it| it.first < first);
        let skips = |it: &&Shared| it.first == first && self.program.skips(it);
        let Some(polygon) = polygons.get(next).filter(skips) else { return };
        let every = self.program.receive_clocks();
        let receives = (POLYGON_WORDS as u64 - 1 - taken) * every;
        if clock.max(polygon.came + 1) + receives <= until {
            let place = Place::Processor(self.number);
            let last = bus.receive_packet(k, clock, every, |word, clock| {
                seen(Event { clock, place, what: What::Receives(word) });
            });
            self.program.skip_ahead(clock - self.at + receives, last - self.at);
            self.at = last;
        }
    }

    /// Runs at once the clears after the one that it has just done, except the last one, and none after that edge.
    pub fn clear_ahead(&mut self, until: u64, seen: &mut impl FnMut(Event)) {
        let (Now::Computing(.., Some(Access::Clear(patch))) | Now::Accessing(Access::Clear(patch))) =
            self.program.now()
        else {
            return;
        };
        let every = self.clear_clocks.max(CLEAR_CLOCKS);
        let entries = u64::from(self.patches.count() - 1 - patch).min(until.saturating_sub(self.at) / every) as u32;
        for entry in 0..entries {
            let (clock, what) = (self.at + u64::from(entry + 1) * every, What::Clears(patch + entry));
            seen(Event { clock, place: Place::Processor(self.number), what });
        }
        if entries > 0 {
            self.program.clear_ahead(entries, every);
            self.at += u64::from(entries) * every;
            self.lfb.clear(self.at);
        }
    }
}

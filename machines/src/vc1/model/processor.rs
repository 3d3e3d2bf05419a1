//! A processing element: the machine's own program, run from event to event against a local frame buffer of the model.

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
    /// The binary logarithm of a patch's edge, and the patches side by side.
    edge: u32,
    columns: u32,
    /// Clocks of a cleared entry.
    clear_clocks: u64,
    /// The last edge that it has gone through.
    at: u64,
    /// Its next edges are of account to nobody until all of a packet has come, so that it may be behind the others.
    pub lags: bool,
    /// The next edge at which more happens to it than that a clock goes by.
    pub due: u64,
    /// The edge at which it swaps, once that is known.
    pub swap: Option<u64>,
    /// The first clocks in which T_m has passed since its last swap, and in which it knows that its back buffer is sent.
    pub waited: u64,
    pub sent: u64,
    /// Frames that it has ended.
    pub frames: u32,
    /// Since which edge it says that it has drawn its frame.
    pub ended: Option<u64>,
}

/// What a processing element did at an edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Done {
    /// It took a word from its queue.
    pub received: bool,
    /// It offers another word to the bus.
    pub offers: Option<Word>,
    /// It cleared an entry, and not the last one.
    pub cleared: bool,
    /// It swapped, at the end of a frame or in an overflow.
    pub swapped: Option<SwapState>,
}

impl Element {
    /// One that has gone through the reset until that edge.
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

    /// Whether it has drawn its frame, and nothing holds that back.
    pub fn is_ready(&self) -> bool {
        self.ended.is_some() && self.lfb.overflows.is_none()
    }

    /// The first clock in which it lets the sync line go.
    pub fn lets_go(&self) -> u64 {
        self.ended.map_or(u64::MAX, |edge| (edge + 1).max(self.lfb.idle_from()))
    }

    /// Whether a word that comes to its empty queue changes what it does.
    pub fn looks_at_queue(&self) -> bool {
        let looks = matches!(self.program.now(), Now::Waiting | Now::Accessing(Access::Send(_) | Access::Receive));
        looks && !self.is_halted()
    }

    /// Whether it would do something about a word that the bus takes from it, at once.
    pub fn waits_for_bus(&self) -> bool {
        matches!(self.program.now(), Now::Waiting | Now::Accessing(Access::Send(_))) && !self.is_halted()
    }

    /// Whether its next edge is of account to nobody else, and nothing that others do to it.
    pub fn is_by_itself(&self) -> bool {
        !self.is_halted() && self.lfb.overflows.is_none() && self.program.is_by_itself()
    }

    /// How many words of its queue have to be known for its next edge, if nothing else has to be, and nobody looks at what it does there.
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

    /// Finds its next edge. `came`: when the first word that it has not taken came to its queue, if it did.
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

    /// Goes through an edge. `is_due`: the line is high. `sent`: the bus takes the word that it offers. `queue`: the two words at the front of
    /// its queue, behind what the bus does at this edge.
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

    /// Whether nobody sees what it does before it has received a packet.
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

    /// Receives at once the words of a packet that are in its queue, the `k`-th one, but the last; none after that edge.
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

    /// Receives at once what is left of a polygon that has come as a whole, if it has no row of it; nothing after that edge.
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

    /// Goes at once through the clears that are ahead of it behind one that it has just done, but the last, none after that edge.
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

//! The broadcast bus and the receive queues (VC1-NET).

use std::collections::VecDeque;

use super::senders::Senders;
use crate::vc1::words::{POLYGON_WORDS, Word};

/// The bus, with the queues of all processing elements.
#[derive(Clone, Debug)]
pub(super) struct Bus {
    word_clocks: u64,
    queue: u64,
    /// By sender, its offer; the host comes after the processing elements.
    offers: Vec<Option<Word>>,
    /// The senders with an offer.
    offering: Senders,
    /// Whether a packet has begun and not ended.
    is_open: bool,
    sender: usize,
    /// The word on the bus, and the edge at which it goes to the queues if they have space.
    word: Option<(Word, u64)>,
    /// The last words that went to the queues, at most the size of a queue, and the number of the first of them.
    delivered: VecDeque<Delivered>,
    first: u64,
    /// The number after the last word that ended a packet.
    complete: u64,
    /// By processing element, the number of words that it has taken.
    received: Vec<u64>,
    /// The last edge at which the bus did something.
    at: u64,
    /// The next edge at which the bus does something, unless something else happens before.
    pub next: u64,
}

/// A word that went to the queues.
#[derive(Clone, Copy, Debug)]
struct Delivered {
    word: Word,
    came: u64,
    /// The number of processing elements that have taken it, and the last edge of that.
    takers: usize,
    taken: u64,
}

impl Delivered {
    fn take(&mut self, edge: u64) {
        self.takers += 1;
        self.taken = edge.max(self.taken);
    }
}

/// The action of the bus at an edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Carried {
    /// A word goes to all queues.
    pub delivers: bool,
    /// The bus takes a word from that sender.
    pub takes: Option<(usize, Word)>,
}

impl Bus {
    pub fn new(processors: usize, queue: u32, word_clocks: u32) -> Bus {
        Bus {
            word_clocks: word_clocks.into(),
            queue: queue.into(),
            offers: vec![None; processors + 1],
            offering: Senders::new(processors + 1),
            is_open: false,
            sender: processors,
            word: None,
            delivered: VecDeque::new(),
            first: 0,
            complete: 0,
            received: vec![0; processors],
            at: 0,
            next: u64::MAX,
        }
    }

    /// Notes a sender's offer from the clock after that edge on.
    pub fn offer(&mut self, sender: usize, word: Word, edge: u64) {
        self.offers[sender] = Some(word);
        self.offering.insert(sender);
        if self.word.is_none() && self.chosen().is_some() {
            self.next = self.next.min(edge + 1);
        }
    }

    /// The sender whose word the bus takes next.
    fn chosen(&self) -> Option<usize> {
        if self.is_open || self.offering.is_empty() {
            return Some(self.sender).filter(|sender| self.offering.contains(*sender));
        }
        self.offering.next_behind(self.sender)
    }

    /// The edge before which the bus takes no word from that processing element, because whole polygons of others come first; `u64::MAX` if
    /// nothing is offered.
    pub fn takes_from(&self, k: usize) -> u64 {
        if !self.offering.contains(k) {
            return u64::MAX;
        }
        let next = self.word.map_or(self.at, |(_, arrives)| arrives);
        let others = if self.is_open && self.sender == k { 0 } else { self.offering.between(self.sender, k) };
        let host = u64::from(self.offering.contains(self.received.len()));
        next + others.saturating_sub(host) * POLYGON_WORDS as u64 * self.word_clocks
    }

    fn end(&self) -> u64 {
        self.first + self.delivered.len() as u64
    }

    /// The edge after which no queue is full, if all reads before it are known.
    fn room(&self) -> Option<u64> {
        if (self.delivered.len() as u64) < self.queue {
            return Some(0);
        }
        let oldest = self.delivered.front()?;
        (oldest.takers == self.received.len()).then_some(oldest.taken)
    }

    /// Whether the time at which all queues have space is known.
    pub fn knows_room(&self) -> bool {
        self.room().is_some()
    }

    /// Does the action at the edge [`Bus::next`].
    pub fn go(&mut self) -> Carried {
        let edge = self.next;
        self.at = edge;
        let mut carried = Carried::default();
        if let Some((word, _)) = self.word.take() {
            if self.delivered.len() as u64 == self.queue {
                self.delivered.pop_front();
                self.first += 1;
            }
            self.delivered.push_back(Delivered { word, came: edge, takers: 0, taken: 0 });
            carried.delivers = true;
            if word.last {
                self.complete = self.end();
            }
        }
        if let Some(sender) = self.chosen() {
            let word = self.offers[sender].take().expect("it offers");
            self.offering.remove(sender);
            (self.sender, self.is_open) = (sender, !word.last);
            self.word = Some((word, edge + self.word_clocks));
            carried.takes = Some((sender, word));
        }
        self.look();
        carried
    }

    /// Finds the next edge of the bus, unless something else happens before.
    fn look(&mut self) {
        self.next = match (self.word, self.room()) {
            (Some((_, arrives)), Some(room)) => arrives.max(room + 1),
            _ => u64::MAX,
        };
    }

    /// The first two words of a queue after that edge.
    pub fn queue(&self, processor: usize, edge: u64) -> [Option<Word>; 2] {
        [0, 1].map(|place| self.coming(processor, place).filter(|(_, came)| *came <= edge).map(|(word, _)| word))
    }

    /// The n-th of the words that a processing element still has to take, and the edge at which it arrived in its queue.
    pub fn coming(&self, processor: usize, place: u64) -> Option<(Word, u64)> {
        let at = self.received[processor] - self.first + place;
        self.delivered.get(at as usize).map(|it| (it.word, it.came))
    }

    /// The number of the word that a processing element takes next.
    pub fn next_of(&self, processor: usize) -> u64 {
        self.received[processor]
    }

    /// Whether the word of that number is still stored.
    pub fn keeps(&self, number: u64) -> bool {
        number >= self.first
    }

    /// The packet whose last word has just arrived, if it has this number of words and they are stored; and the number of the first word.
    pub fn last_packet(&self, words: usize) -> Option<(u64, Vec<u32>)> {
        let first = self.delivered.len().checked_sub(words).filter(|_| self.was_last())?;
        let packet = self.delivered.range(first..).map(|it| it.word);
        let is_one = packet.clone().rev().skip(1).all(|word| !word.last);
        is_one.then(|| (self.first + first as u64, packet.map(|it| it.word).collect()))
    }

    /// Whether the packet that a processing element receives next, or is receiving, is completely in its queue.
    pub fn is_complete(&self, processor: usize) -> bool {
        self.received[processor] < self.complete
    }

    /// Whether the word that went to the queues last ended a packet.
    pub fn was_last(&self) -> bool {
        self.complete == self.end()
    }

    /// Whether a queue has one word.
    pub fn has_one(&self, processor: usize) -> bool {
        self.received[processor] + 1 == self.end()
    }

    /// A processing element takes the first word at that edge.
    pub fn receive(&mut self, processor: usize, edge: u64) {
        self.delivered[(self.received[processor] - self.first) as usize].take(edge);
        self.received[processor] += 1;
        if self.next == u64::MAX {
            self.look();
        }
    }

    /// A processing element takes words of a packet, except the last one. It takes the first from that clock on, each following one at least `every`
    /// clocks after the one before, and none after the edge `until`. `took` gets each word and its edge.
    pub fn receive_ahead(&mut self, k: usize, mut clock: u64, every: u64, until: u64, mut took: impl FnMut(u32, u64)) {
        let first = (self.received[k] - self.first) as usize;
        for it in self.delivered.range_mut(first..) {
            let edge = clock.max(it.came + 1);
            if it.word.last || edge > until {
                break;
            }
            it.take(edge);
            took(it.word.word, edge);
            self.received[k] += 1;
            clock = edge + every;
        }
        if self.next == u64::MAX {
            self.look();
        }
    }

    /// A processing element takes a packet that has arrived completely, as in [`Bus::receive_ahead`]. Returns the edge of the last word.
    pub fn receive_packet(&mut self, k: usize, clock: u64, every: u64, mut took: impl FnMut(u32, u64)) -> u64 {
        let mut last = clock;
        self.receive_ahead(k, clock, every, u64::MAX, |word, edge| {
            took(word, edge);
            last = edge + every;
        });
        let (word, came) = self.coming(k, 0).expect("all of it has come");
        let edge = last.max(came + 1);
        took(word.word, edge);
        self.receive(k, edge);
        edge
    }

    /// Whether no word is offered or on the bus, no packet is unfinished, and all queues are empty.
    pub fn is_idle(&self) -> bool {
        self.word.is_none()
            && self.offering.is_empty()
            && !self.is_open
            && self.received.iter().all(|it| *it == self.end())
    }
}

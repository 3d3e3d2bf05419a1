//! The broadcast bus and the receive queues (VC1-NET).

use std::collections::VecDeque;

use super::senders::Senders;
use crate::vc1::words::{POLYGON_WORDS, Word};

/// The bus, with the queues of all processing elements.
#[derive(Clone, Debug)]
pub(super) struct Bus {
    word_clocks: u64,
    queue: u64,
    /// By sender, the host behind the processing elements: what it offers.
    offers: Vec<Option<Word>>,
    /// Those who do.
    offering: Senders,
    /// A packet is begun and unfinished.
    is_open: bool,
    sender: usize,
    /// The word on the bus, and the edge at which it goes to the queues if they have room.
    word: Option<(Word, u64)>,
    /// The last words that went to the queues, as many as one has room for; the first of them is of that number.
    delivered: VecDeque<Delivered>,
    first: u64,
    /// The number behind the last word that ended a packet.
    complete: u64,
    /// By processing element: words that it has taken.
    received: Vec<u64>,
    /// The last edge at which it did something.
    at: u64,
    /// The next edge at which it does something, if nothing else happens before.
    pub next: u64,
}

/// A word that went to the queues.
#[derive(Clone, Copy, Debug)]
struct Delivered {
    word: Word,
    came: u64,
    /// How many have taken it, and the last edge at which one did.
    takers: usize,
    taken: u64,
}

impl Delivered {
    fn take(&mut self, edge: u64) {
        self.takers += 1;
        self.taken = edge.max(self.taken);
    }
}

/// What the bus does at an edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Carried {
    /// A word goes to all queues.
    pub delivers: bool,
    /// It takes a word from that sender.
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

    /// What a sender offers from the clock behind that edge on.
    pub fn offer(&mut self, sender: usize, word: Word, edge: u64) {
        self.offers[sender] = Some(word);
        self.offering.insert(sender);
        if self.word.is_none() && self.chosen().is_some() {
            self.next = self.next.min(edge + 1);
        }
    }

    /// The sender whose word it takes next.
    fn chosen(&self) -> Option<usize> {
        if self.is_open || self.offering.is_empty() {
            return Some(self.sender).filter(|sender| self.offering.contains(*sender));
        }
        self.offering.next_behind(self.sender)
    }

    /// It takes no word from that processing element before that edge, or none at all as far as nothing is offered: whole polygons of
    /// others come before.
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

    /// The edge behind which no queue is full, if all that makes room is known.
    fn room(&self) -> Option<u64> {
        if (self.delivered.len() as u64) < self.queue {
            return Some(0);
        }
        let oldest = self.delivered.front()?;
        (oldest.takers == self.received.len()).then_some(oldest.taken)
    }

    /// Whether it is known when there is room in all queues.
    pub fn knows_room(&self) -> bool {
        self.room().is_some()
    }

    /// Does what it does at the edge [`Bus::next`].
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

    /// Says when it does something next, if nothing else happens before.
    fn look(&mut self) {
        self.next = match (self.word, self.room()) {
            (Some((_, arrives)), Some(room)) => arrives.max(room + 1),
            _ => u64::MAX,
        };
    }

    /// The words at the front of a queue and behind that, behind that edge.
    pub fn queue(&self, processor: usize, edge: u64) -> [Option<Word>; 2] {
        [0, 1].map(|place| self.coming(processor, place).filter(|(_, came)| *came <= edge).map(|(word, _)| word))
    }

    /// The so many-th of the words that a processing element has still to take, and when it came to its queue.
    pub fn coming(&self, processor: usize, place: u64) -> Option<(Word, u64)> {
        let at = self.received[processor] - self.first + place;
        self.delivered.get(at as usize).map(|it| (it.word, it.came))
    }

    /// The number of the word that a processing element takes next.
    pub fn next_of(&self, processor: usize) -> u64 {
        self.received[processor]
    }

    /// Whether the word of that number is kept.
    pub fn keeps(&self, number: u64) -> bool {
        number >= self.first
    }

    /// The packet of which the last word has just come, if it has so many words and they are kept; and the number of the first.
    pub fn last_packet(&self, words: usize) -> Option<(u64, Vec<u32>)> {
        let first = self.delivered.len().checked_sub(words).filter(|_| self.was_last())?;
        let packet = self.delivered.range(first..).map(|it| it.word);
        let is_one = packet.clone().rev().skip(1).all(|word| !word.last);
        is_one.then(|| (self.first + first as u64, packet.map(|it| it.word).collect()))
    }

    /// Whether the packet that a processing element receives next, or is receiving, is in its queue as a whole.
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

    /// A processing element takes the word at the front at that edge.
    pub fn receive(&mut self, processor: usize, edge: u64) {
        self.delivered[(self.received[processor] - self.first) as usize].take(edge);
        self.received[processor] += 1;
        if self.next == u64::MAX {
            self.look();
        }
    }

    /// A processing element takes words of a packet, but not the last one. It takes the first from that clock on, each other one `every` clocks
    /// after the one before at the earliest, and none after the edge `until`. `took` gets each, and the edge.
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

    /// A processing element takes a packet, all of which has come, as [`Bus::receive_ahead`] says; the edge of the last word.
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

    /// No word is offered or on the bus, no packet is unfinished, and all queues are empty.
    pub fn is_idle(&self) -> bool {
        self.word.is_none()
            && self.offering.is_empty()
            && !self.is_open
            && self.received.iter().all(|it| *it == self.end())
    }
}

//! The broadcast bus and the receive queues (VC1-NET).

use std::collections::VecDeque;

use crate::vc1::words::Word;

/// The bus, with the queues of all processing elements.
#[derive(Clone, Debug)]
pub(super) struct Bus {
    word_clocks: u64,
    queue: u64,
    /// By sender, the host behind the processing elements: what it offers.
    offers: Vec<Option<Word>>,
    /// How many do.
    offering: u32,
    /// A packet is begun and unfinished.
    is_open: bool,
    sender: usize,
    /// The word on the bus, and the edge at which it goes to the queues if they have room.
    word: Option<(Word, u64)>,
    /// Words that went to the queues, and when; the first one is of that number.
    delivered: VecDeque<(Word, u64)>,
    first: u64,
    /// The number behind the last word that ended a packet.
    complete: u64,
    /// By processing element: words that it has taken.
    received: Vec<u64>,
    /// No processing element has taken fewer words.
    oldest: u64,
    /// The next edge at which it does something, if nothing else happens before.
    pub next: u64,
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
            offering: 0,
            is_open: false,
            sender: processors,
            word: None,
            delivered: VecDeque::new(),
            first: 0,
            complete: 0,
            received: vec![0; processors],
            oldest: 0,
            next: u64::MAX,
        }
    }

    /// What a sender offers from the clock behind that edge on.
    pub fn offer(&mut self, sender: usize, word: Word, edge: u64) {
        self.offers[sender] = Some(word);
        self.offering += 1;
        if self.word.is_none() && self.chosen().is_some() {
            self.next = self.next.min(edge + 1);
        }
    }

    /// The sender whose word it takes next.
    fn chosen(&self) -> Option<usize> {
        let offers = |sender: &usize| self.offers[*sender].is_some();
        if self.is_open || self.offering == 0 {
            return Some(self.sender).filter(offers);
        }
        (self.sender + 1..self.offers.len()).chain(0..=self.sender).find(offers)
    }

    fn end(&self) -> u64 {
        self.first + self.delivered.len() as u64
    }

    /// Whether no queue is full.
    pub fn has_room(&mut self) -> bool {
        if self.end() - self.oldest >= self.queue {
            self.oldest = self.received.iter().min().copied().unwrap_or_default();
        }
        self.end() - self.oldest < self.queue
    }

    /// Does what it does at the edge [`Bus::next`].
    pub fn go(&mut self) -> Carried {
        let edge = self.next;
        let mut carried = Carried::default();
        if let Some((word, _)) = self.word.take() {
            self.delivered.push_back((word, edge));
            carried.delivers = true;
            if word.last {
                self.complete = self.end();
            }
        }
        if let Some(sender) = self.chosen() {
            let word = self.offers[sender].take().expect("it offers");
            self.offering -= 1;
            (self.sender, self.is_open) = (sender, !word.last);
            self.word = Some((word, edge + self.word_clocks));
            carried.takes = Some((sender, word));
        }
        self.look(edge);
        carried
    }

    /// Says when it does something next, seen from that edge, behind which words may have gone from queues.
    fn look(&mut self, edge: u64) {
        let arrives = self.word.map_or(u64::MAX, |(_, arrives)| arrives);
        self.next = if self.has_room() { arrives.max(edge + 1) } else { u64::MAX };
    }

    /// The words at the front of a queue and behind that, behind that edge.
    pub fn queue(&self, processor: usize, edge: u64) -> [Option<Word>; 2] {
        [0, 1].map(|place| self.coming(processor, place).filter(|(_, came)| *came <= edge).map(|(word, _)| word))
    }

    /// The so many-th of the words that a processing element has still to take, and when it came to its queue.
    pub fn coming(&self, processor: usize, place: u64) -> Option<(Word, u64)> {
        let at = self.received[processor] - self.first + place;
        self.delivered.get(at as usize).copied()
    }

    /// Whether the packet that a processing element receives next, or is receiving, is in its queue as a whole.
    pub fn is_complete(&self, processor: usize) -> bool {
        self.received[processor] < self.complete
    }

    /// Whether there is room for certain in that processing element's queue until that edge, seen from another one, if it takes nothing.
    pub fn has_room_until(&self, processor: usize, now: u64, edge: u64) -> bool {
        let coming = edge.saturating_sub(now) / self.word_clocks + 2;
        self.end() - self.received[processor] + coming <= self.queue
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
        self.received[processor] += 1;
        if self.word.is_some() && self.next == u64::MAX {
            self.look(edge);
        }
        // Now and then what all have received is forgotten.
        if self.delivered.len() > 2 * self.queue as usize {
            self.oldest = self.received.iter().min().copied().unwrap_or_default();
            self.delivered.drain(..(self.oldest - self.first) as usize);
            self.first = self.oldest;
        }
    }

    /// No word is offered or on the bus, no packet is unfinished, and all queues are empty.
    pub fn is_idle(&self) -> bool {
        self.word.is_none() && self.offering == 0 && !self.is_open && self.received.iter().all(|it| *it == self.end())
    }
}

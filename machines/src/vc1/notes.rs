//! The circuit's events, observed at its ports, with which the model's events are compared.

use tilewright_rtl::swap::SwapState;

use super::model::{Event, Place, What};
use super::pages::Pages;
use super::program::Access;
use super::words::Word;
use crate::history::{Painting, Write};

/// The noted events; those at each place are sorted by time.
pub(crate) struct Notes {
    pub events: Vec<Event>,
    /// Pixels of a row of the screen.
    width: u32,
    shown: bool,
    /// The number of changes of the banks.
    changes: u32,
    first_round: bool,
    /// The recorded pixels of local frame buffers, if they are recorded.
    pub painting: Option<Painting>,
    /// The patches that have a page in the buffer being drawn, if they are recorded.
    pub pages: Option<Pages>,
    /// A change of events, for a test that the comparison finds it.
    #[cfg(test)]
    pub falsify: Option<Box<dyn Fn(Event) -> Option<Event>>>,
}

/// The transfers at the ports of a processing element at an edge.
pub(crate) struct Handshakes {
    /// The access that its local frame buffer took.
    pub taken: Option<Access>,
    /// The word that the bus took.
    pub sent: Option<Word>,
    /// The word that left its queue.
    pub received: Option<Word>,
    /// The swap control's signals before and after it.
    pub may: [SwapState; 2],
    /// Whether the program ended with it.
    pub ends: bool,
}

impl Notes {
    pub fn new(width: u32) -> Notes {
        Notes {
            events: Vec::new(),
            width,
            shown: false,
            changes: 0,
            first_round: true,
            painting: None,
            pages: None,
            #[cfg(test)]
            falsify: None,
        }
    }

    /// Notes an edge of a processing element, in the model's sequence.
    pub fn processor(&mut self, clock: u64, number: u32, at: Handshakes) {
        let place = Place::Processor(number);
        match at.taken {
            Some(Access::Draw(pixel)) => {
                if let Some(pages) = &mut self.pages {
                    pages.draws(clock * Event::PE_PERIOD, number, [pixel.x, pixel.y]);
                }
                let at = pixel.y * self.width + pixel.x;
                self.add(clock, place, What::Draws(at));
                self.paint(Write { time: clock * Event::PE_PERIOD, pixel: at, painter: number, word: pixel.word });
            }
            Some(Access::Clear(patch)) => self.add(clock, place, What::Clears(patch)),
            _ => {}
        }
        if let Some(pages) = &mut self.pages {
            pages.swap(clock * Event::PE_PERIOD, number, at.may);
        }
        match at.may {
            [SwapState::Clear, SwapState::Draw] => self.add(clock, place, What::Resumes),
            [SwapState::Draw, SwapState::Due] => self.add(clock, place, What::Due),
            [SwapState::Draw, SwapState::Overflow] => self.add(clock, place, What::Overflows),
            [before, after] if before != after => self.add(clock, place, What::Swaps),
            _ => {}
        }
        if let Some(word) = at.received {
            self.add(clock, place, What::Receives(word.word));
        }
        if at.ends {
            self.add(clock, place, What::Ends);
        }
        if let Some(word) = at.sent {
            self.bus(clock, number, word);
        }
    }

    /// Records a pixel. The merger chooses the least word, and between equal words the first drawn counts, as they cannot be distinguished.
    fn paint(&mut self, write: Write) {
        if let Some(painting) = &mut self.painting {
            painting.draw(write, |new, kept| new < kept);
        }
    }

    /// Notes that the bus took a word of that sender.
    pub fn bus(&mut self, clock: u64, sender: u32, word: Word) {
        self.add(clock, Place::Bus, What::Carries(sender, word.word));
    }

    /// Notes the merger's signals: whether the banks have changed, and whether the round is the first one of its scan.
    pub fn merger(&mut self, clock: u64, shown: bool, first_round: bool) {
        if shown != std::mem::replace(&mut self.shown, shown) {
            self.changes += 1;
            self.add(clock, Place::Merger, What::Shows(self.changes));
        }
        if !std::mem::replace(&mut self.first_round, first_round) && first_round {
            self.add(clock, Place::Merger, What::Restarts);
        }
    }

    fn add(&mut self, clock: u64, place: Place, what: What) {
        let event = Some(Event { clock, place, what });
        #[cfg(test)]
        let event = self.falsify.as_ref().map_or(event, |falsify| event.and_then(falsify));
        self.events.extend(event);
    }
}
